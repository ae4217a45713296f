// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "physics/base/arrays.h"
#include "physics/body/exact_distance.h"

namespace furrow::physics {

/// Where a body is at a time.
struct Keyframe {
  double time;                      ///< [s]; may be negative
  Vec3 translation = Vec3::Zero();  ///< [m]
  Vec3 rotation =
      Vec3::Zero();  ///< rotation vector: axis times angle [rad]; beyond pi: more than half a turn
};

/// A rotation about a fixed axis. Its rate is 0 until `start`, grows linearly over `ramp` and stays.
struct Spin {
  Vec3 centre = Vec3::Zero();  ///< [m]
  Vec3 axis = Vec3::UnitY();   ///< any length but 0
  double rate = 0;             ///< [rad/s], counter-clockwise seen against the axis
  double start = 0;            ///< [s]
  double ramp = 0;             ///< [s]; >= 0
};
double spin_rate(const Spin& spin, double time);   ///< [rad/s]
double spin_angle(const Spin& spin, double time);  ///< its integral from `start` [rad]

/// From the frame that a body's mesh is given in to the world: x -> rotation x + translation.
struct Pose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Vec3 translation = Vec3::Zero();  ///< [m]
  Vec3 to_world(const Vec3& x) const { return rotation * x + translation; }
  Vec3 to_body(const Vec3& x) const { return rotation.conjugate() * (x - translation); }
};

/// How keyframes begin and end.
enum class EndSpeeds {
  rest,  ///< with speed 0: the velocity has no jumps
  free   ///< with the slope of the parabola through the three keyframes at that end, cut to stay monotone;
         ///< with two keyframes at a uniform speed: the velocity jumps there from 0 and to 0
};

/// The motion of something rigid: the spin turns it in its own frame, then the keyframes turn it about the
/// pivot and move it, the spin's axis with it.
///
/// Each coordinate of the translation and of the rotation vector runs through the keyframes on a monotone
/// cubic (slopes after Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304): dense keyframes are
/// passed without a halt, and no coordinate leaves the range of two neighbours, as Catmull-Rom does. Before
/// the first keyframe and after the last the pose is held; `ends` says with which speed they are met.
struct RigidMotion {
  std::vector<Keyframe> keyframes;  ///< by time, strictly increasing; none: no such motion
  EndSpeeds ends = EndSpeeds::rest;
  Vec3 pivot = Vec3::Zero();  ///< of the keyframes' rotations, in the body's frame [m]
  std::optional<Spin> spin;
};

/// Throw std::invalid_argument for a number that is not finite or out of range, or times that do not
/// increase.
void check(const Spin& spin);
void check(const RigidMotion& motion);

/// Whether the pose is the same at all times, and whether that is the identity: the body is where its mesh
/// is.
bool at_rest(const RigidMotion& motion);
bool is_identity(const RigidMotion& motion);
/// Needs check(motion). Cost: a few sines.
Pose pose(const RigidMotion& motion, double time);

class DepthMapCollider;

/// Frames of one triangle mesh whose vertices move.
struct BodyFrames {
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside; the same in all frames
  std::vector<double> times;                  ///< [s]; at least two, strictly increasing
  /// The vertices of frame i [m]; frames are read once and in order while time goes forward, 0 in any case.
  std::function<std::vector<Vec3>(int)> vertices;
};

enum class DepthMaps {
  front_back,
  front_back_top,  ///< the paper's
  six              ///< front, back, top, bottom and both sides
};

struct DepthMapOptions {
  DepthMaps maps = DepthMaps::front_back_top;
  int size = 512;   ///< texels along the longest edge of the body's box; 16 ... 4096
  int up = 1;       ///< the coordinate that grows to the top; 0 ... 2
  int front = 2;    ///< the coordinate that grows to the front; 0 ... 2, not `up`
  int threads = 1;  ///< of a build, at most one a map; 1 ... 256; the result does not depend on it
};

/// A body that changes its shape. Between two frames every vertex moves on a straight line at constant speed;
/// before the first frame and after the last the body is held. Only the two frames around the present time
/// are in memory, and the one that time left last, as steps that are made in halves go back to it; each with
/// its exact distance, a tree that is fitted when time reaches it to boxes of the first frame's triangles, or
/// with depth maps, whose header says what they do not see.
///
/// With u the way that the surface next to x goes from the one frame to the other, and s the share of the
/// time between them, the distance is
///   (1 - s) F0(x - s u) + s F1(x + (1 - s) u):
/// blended linearly, along with the surface, so that it is exact where the surface only shifts, however far.
/// (Blending at a fixed x thins a limb of radius r that shifts by its diameter to nothing.) "Next to x" is
/// found in the frame that is nearer in time; where parts that move differently lie about equally near, the
/// distance may be off by a part of the difference of their ways: give frames closer in time there.
class AnimatedBody : public Collider {
 public:
  /// Nothing is read yet. Throws std::invalid_argument if times or triangles are broken.
  /// maps: asked in place of exact distances.
  explicit AnimatedBody(BodyFrames frames, const std::optional<DepthMapOptions>& maps = std::nullopt);
  ~AnimatedBody() override;
  AnimatedBody(AnimatedBody&&) noexcept;
  AnimatedBody& operator=(AnimatedBody&&) noexcept;

  /// Reads and builds what the time `to` needs; from then on queries are about that time. `from`: the time
  /// before it (for travel()). Throws std::invalid_argument if a frame has another number of vertices or is
  /// no body. Cost: about 1.2 us a triangle of each frame that time reaches; the first time the first frame,
  /// too.
  void prepare(double from, double to);

  /// The surface next to a place.
  struct Beside {
    Vec3 way;      ///< that it goes between the two frames [m]
    int triangle;  ///< near there, a guess that makes searches faster
  };
  /// Distance and gradient at the prepared time, from several threads. Cost: four closest points, 4 us; at a
  /// frame's time one.
  SignedDistance at(const Vec3& x) const override;
  /// The same for a known surface next to x, in half of the time.
  SignedDistance at(const Vec3& x, const Beside& surface) const;
  Beside beside(const Vec3& x) const;
  /// Way of the surface next to x between the two frames [m].
  Vec3 way(const Vec3& x) const { return beside(x).way; }
  /// Share of that way that is covered from the time `from` to the time `to`.
  double share() const { return share_; }
  /// A bound on how far any vertex moved from `from` to `to` [m].
  double travel() const { return travel_; }

  int frames_built() const { return frames_built_; }
  double build_seconds() const { return build_seconds_; }  ///< clock time spent on reading and building [s]

 private:
  struct Frame;
  int interval_at(double time) const;
  double fraction_at(double time) const;
  std::shared_ptr<Frame> read(int index);
  std::shared_ptr<Frame> find(int index);
  void enter(int interval);
  void advance_to(double from, int last);
  void leave(std::shared_ptr<Frame> frame);
  void build(Frame& frame);
  const ExactDistance& model();
  Vec3 way_of(const ClosestPoint& point, const Frame& frame) const;

  BodyFrames frames_;
  std::optional<DepthMapOptions> maps_;
  std::optional<ExactDistance> model_;  ///< of the first frame: all others have its tree
  std::size_t vertex_count_ = 0;
  int interval_ = -1;  ///< from its frame to the next one
  std::shared_ptr<Frame> first_, second_;
  std::shared_ptr<Frame> left_;                   ///< that time left last
  std::unique_ptr<DepthMapCollider> spare_maps_;  ///< of a frame that is over: its memory serves the next one
  std::optional<ExactDistance> spare_;            ///< likewise
  double longest_way_ = 0;                        ///< of a vertex in the interval [m]
  double fraction_ = 0, share_ = 0, travel_ = 0;  ///< fraction_: of the interval, at the prepared time
  int frames_built_ = 0;
  double build_seconds_ = 0;
};

}  // namespace furrow::physics
