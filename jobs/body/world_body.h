// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <limits>
#include <memory>

#include "io/animation/animation_file.h"
#include "io/scene/scene.h"
#include "jobs/base/ends.h"
#include "jobs/base/gate.h"
#include "jobs/base/inputs.h"
#include "physics/body/collider.h"
#include "physics/body/distance_field.h"
#include "physics/body/exact_distance.h"
#include "physics/body/moving_body.h"

namespace furrow::io {
struct SavedState;
}
namespace furrow::jobs {

struct MadeFor;

/// A rigid body in its own frame.
struct BodyCollider {
  physics::TriangleMesh triangles;
  physics::ExactDistance exact;
  physics::DistanceField field;
  BodyOutline outline = {};  ///< of its file
  /// That garments are brought from before they are draped (jobs/rest/made_for.h); null: they lie about it.
  std::shared_ptr<const MadeFor> made_for = {};
};

/// The frame with another unit, where one is given.
Frame with_unit(Frame frame, const std::optional<std::string>& unit);

/// Reads and repairs a body; warns of what was repaired. `outline`: of its file. Throws
/// geometry::ContentError for one that lies as if its file had z up, unless the frame says which axis is.
physics::TriangleMesh read_body(const MeshInput& input, const Context& context,
                                BodyOutline* outline = nullptr);

/// The error of a field that leaves a gap [m] below the usual one: half of it; else infinite, the default
/// does.
double tolerance_for(double gap);
/// That lets a garment go on with the gap that its file notes, where that is below the usual one.
double tolerance_for(const io::MeshFile& worn);
/// That of the run that the state was saved by: lines drawn since then do not change it.
double tolerance_for(const io::SavedState& state);

/// The body of a file that was loaded last, for jobs after each other (MemoryFiles::shelf): a file that was
/// changed, or other options, load anew.
struct BodyShelf {
  std::string key;
  std::shared_ptr<const BodyCollider> body;
};

/// Reads and repairs a body, and builds its field or loads the saved one; shows progress. Warns of what was
/// repaired. A body that lies on the shelf is that one, without a word. Unless the body has a tolerance of
/// its own, it is `at_most` [m], but no less than a quarter of the default, which would take very long.
BodyCollider load_body(const io::SceneBody& body, const Context& context,
                       double at_most = std::numeric_limits<double>::infinity());

/// A body as a scene has it: rigid, perhaps moved, or changing its shape.
class WorldBody {
 public:
  /// at_most: of a rigid body, as load_body(). Throws geometry::ContentError for frames that are not those of
  /// the mesh, or a mesh of frames that is not closed (it cannot be repaired without losing the order of its
  /// vertices).
  WorldBody(const io::SceneBody& body, const Context& context,
            double at_most = std::numeric_limits<double>::infinity());

  void add_to(physics::World& world) const;
  /// As it lies at time 0. It must not outlive this body.
  std::unique_ptr<physics::Collider> at_start() const;
  /// The same, precisely; null: it changes its shape.
  std::unique_ptr<physics::Collider> precise_at_start() const;
  double tolerance() const { return tolerance_; }  ///< of the field [m]; 0: distances are exact
  /// Triangles of all frames that a run from time 0 to `seconds` reaches; 0: rigid.
  double triangles_until(double seconds) const;
  /// Tells one body's shape and field from another's (not its motion).
  const std::string& fingerprint() const { return fingerprint_; }
  /// Puts the points `which` that lie inside at a time onto the surface, by exact distance; rigid bodies
  /// only.
  physics::PushOutReport push_out(std::vector<physics::Vec3>& points, const std::vector<int>& which,
                                  double time) const;
  /// Of points in the world, at a time, by exact distance.
  physics::Penetration penetration(std::vector<physics::Vec3> points, double time) const;
  /// What it does to a garment that lies in the world at a time, by exact distance; gap: that was kept [m].
  BodyEnd end_of(geometry::Mesh garment, double gap, double time) const;
  /// The point that lies deepest; of none, any.
  physics::Vec3 deepest_of(const std::vector<physics::Vec3>& points, double time) const;
  /// Points that are nearer than `distance` [m] at time 0, or inside; by the field.
  int count_near(const std::vector<physics::Vec3>& points, double distance) const;
  /// Around it at a time [m].
  Eigen::AlignedBox3d box(double time) const;
  /// Its mesh as it is at a time, for writing.
  io::MeshFile at(double time, const Context& context) const;
  /// As it is in its file; of a body that moves, where it is at that time.
  BodyOutline outline(double time) const;

 private:
  void read_frames(const io::SceneBody& body, const Context& context);
  void check_maps(const Context& context) const;
  std::vector<physics::Vec3> vertices_at(double time) const;

  std::string path_, fingerprint_;
  std::optional<std::string> unit_;
  physics::RigidMotion motion_;
  double tolerance_ = 0;
  std::unique_ptr<BodyCollider> rigid_;
  std::vector<std::array<int, 3>> triangles_;  ///< of the frames
  std::unique_ptr<io::FrameSource> frames_;
  std::unique_ptr<physics::AnimatedBody> animated_;
};

/// What a body does to a garment; `exact` is of the body; gap: that was kept [m]. Cost: a distance a vertex,
/// and that of bridge::measure_piercing().
BodyEnd body_end(const geometry::Mesh& garment, const physics::TriangleMesh& body,
                 const physics::ExactDistance& exact, double gap);

Eigen::AlignedBox3d box_of(const std::vector<physics::Vec3>& points);

/// How far a garment's long edges (95th percentile at rest) cut into a limb of 5 cm radius when their ends
/// lie on it [m]. Where lines have refined the cloth in places, their many short edges would hide the long
/// ones elsewhere: there edges count by the area that they stand for.
double edge_sag(const geometry::Mesh& garment);
/// The gap that a garment keeps: at least `wanted`, and never less than edge_sag() plus 1.5 field tolerances,
/// so that faces and edges stay outside when vertices do [m]. One whose file notes the gap that it kept keeps
/// no more than that, so that it goes on where it lies, but at least edge_sag() plus one tolerance, as
/// `drape` does.
double contact_gap(double wanted, double field_tolerance, const io::MeshFile& garment);

/// Cloth nearer to the body lies on it, where cloth keeps this gap: a fifth more [m].
double contact_distance(double gap);
/// The same of a garment: by the gap that its file notes, else that it would keep by default. Its mesh has an
/// edge.
double contact_distance(const io::MeshFile& garment, const physics::ExactDistance& body);

}  // namespace furrow::jobs
