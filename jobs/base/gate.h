// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <cstdint>

#include "jobs/base/ailment.h"
#include "jobs/base/inputs.h"
#include "physics/motion/simulate.h"

/// The gate before every job: what its inputs would take, or cannot be, is said before it is spent.
namespace furrow::jobs {

/// What a job takes unasked. More of it needs a listener that allows it (`--force`).
struct Limits {
  std::int64_t field_samples = 8'000'000;  ///< of a body's field: some 10 s and 1 GB
  double faces = 8e6;                      ///< of a mesh that is refined
  double processor_seconds = 86400;        ///< that a simulation has before it, by cost_table.h
  double frames = 1e5;                     ///< of an animation
  double animation_bytes = 8e9;
  double least_size = 0.05;     ///< largest edge of the box of a body, or of a garment in a wrong unit [m]
  double least_garment = 1e-3;  ///< the same of a garment whose unit is right [m]
};
constexpr Limits limits;

/// Throws std::invalid_argument "<demand>; `force` goes on all the same" unless the listener allows it.
void require_allowed(const std::string& demand, const Context& context);

/// What is odd about the size of a mesh: taller than 10 m, wider unless it is a body, or too small, with the
/// units that would make a person's or a garment's size of it; else "". `what`: "body", "garment", …
std::string odd_size(const geometry::Mesh& mesh, const std::string& what, const Frame& frame);
/// Throws geometry::ContentError, naming the file, for an odd size that the listener does not allow.
void require_size(const geometry::Mesh& mesh, const std::string& name, const std::string& what,
                  const Context& context);

/// Throws geometry::ContentError, naming the file, for a garment all of whose faces are collapsed: nothing
/// can be drawn on it, simulated or draped.
void require_area(const geometry::Mesh& mesh, const std::string& name);

/// Whether JSON can hold it.
bool is_utf8(const std::string& text);

/// Heights are metres: throws geometry::ContentError, naming the stroke, for one that is larger than the
/// whole garment and that the listener does not allow; warns of one larger than half of it.
void require_heights(const std::vector<io::DrawnStroke>& strokes, const geometry::Mesh& garment,
                     const Context& context);

/// Of a refinement of `faces` into `children` each, `steps` times, below `limits.faces`.
void require_refinement(std::size_t faces, double children, int steps, const std::string& option,
                        const Context& context);

/// Frames and bytes of an animation of so many vertices, by the shortest layout.
void require_animation(double seconds, double fps, std::size_t vertices, const Context& context);

/// Faults of any mesh: what reading had to repair, vertices that lie where others do (a soup of loose
/// triangles, seams that are not joined), faces without area, small holes, many parts. O(F log F).
std::vector<Ailment> faults_of_mesh(const io::MeshFile& file);

/// Of a garment besides: a shell with two sides. O(F log F).
std::vector<Ailment> faults_of_garment(const geometry::Mesh& garment);

/// Of a body as its file has it: one that lies along z, as a figure of a file with z up does. `up_said`:
/// somebody said which axis is up. O(V).
std::vector<Ailment> faults_of_body(const geometry::Mesh& body, bool up_said);

/// What a body looks like from far.
struct BodyOutline {
  Eigen::AlignedBox3d box;    ///< [m]
  bool closed = true;         ///< in its file
  bool nearly_closed = true;  ///< but for eyes, a mouth, a neck
  bool figure = false;        ///< nearly closed, and fills as little of its box as a person
};
BodyOutline outline_of(const geometry::Mesh& body);

/// Of a garment beside its body: the two exchanged, or one; a body as garment, half of a garment, sizes that
/// are of two units. `unit_said`: somebody said
/// in what unit they are. O(F).
std::vector<Ailment> faults_of_pair(const geometry::Mesh& garment, const BodyOutline& body, bool unit_said);

/// Throws geometry::ContentError, with the file's name, for the first that makes the work useless and that
/// the listener does not allow; warns of the others that the reader does not tell of itself.
void heed(const std::vector<Ailment>& found, const std::string& name, const Context& context);

/// Asked on the way, as the length of steps is known only then.
class SimulationGate {
 public:
  /// `end` of the run [s]; `step_is_set`: its dt was asked for.
  SimulationGate(double end, bool step_is_set, double cost_of_step, const Context& context)
      : end_(end), step_is_set_(step_is_set), cost_of_step_(cost_of_step), context_(context) {}
  /// Throws std::invalid_argument for more processor time to come than limits.processor_seconds that the
  /// listener does not allow; once allowed, it is not asked again.
  void check(const physics::SimulateProgress& progress);

 private:
  double end_;
  bool step_is_set_;
  double cost_of_step_;
  const Context& context_;
  bool allowed_ = false;
};

}  // namespace furrow::jobs
