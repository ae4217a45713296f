// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "physics/base/arrays.h"

namespace furrow::cases {

/// Joints of the left arm (x > 0) of a figure that looks along z [m]; the right arm is its mirror image.
struct Arm {
  physics::Vec3 shoulder, elbow, wrist;
  double radius;  ///< of its thickest part, with a little more [m]
};
/// The arm of meshes/mannequin.obj.
Arm mannequin_arm();

/// Where an arm points: unit directions from shoulder to elbow and from elbow to wrist, of a left arm.
struct ArmPose {
  physics::Vec3 upper, fore;
};
ArmPose a_pose(double degrees);  ///< stretched out sideways, so far below the horizontal
/// Bent so that the forearm lies across the belly, free of it. `high`: over the other one, else under it.
ArmPose bent_in_front(bool high);

/// The figure with its arms turned. Each vertex turns about the elbow, then about the shoulder, by its share
/// of the angle; the shares run smoothly from 0 to 1 over a joint. The same triangles. Cost O(V + T).
/// Throws std::invalid_argument if a direction has no length.
physics::TriangleMesh posed(const physics::TriangleMesh& figure, const Arm& arm, const ArmPose& left,
                            const ArmPose& right);

/// The mannequin with both forearms before its belly, where they hide it.
physics::TriangleMesh arms_in_front(const physics::TriangleMesh& mannequin);

}  // namespace furrow::cases
