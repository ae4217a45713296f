// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "physics/base/particles.h"

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

/// The motion of something rigid: the spin turns it in its own frame, then the keyframes turn it about the
/// pivot and move it, the spin's axis with it.
///
/// Each coordinate of the translation and of the rotation vector runs through the keyframes on a monotone
/// cubic (slopes after Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304; 0 at both ends): the
/// velocity has no jumps, dense keyframes are passed without a halt, and no coordinate leaves the range of
/// two neighbours, as Catmull-Rom does. Before the first keyframe and after the last the pose is held.
struct RigidMotion {
  std::vector<Keyframe> keyframes;  ///< by time, strictly increasing; none: no such motion
  Vec3 pivot = Vec3::Zero();        ///< of the keyframes' rotations, in the body's frame [m]
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

}  // namespace furrow::physics
