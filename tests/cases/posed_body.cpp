// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/posed_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace furrow::cases {
namespace {

using physics::TriangleMesh;
using physics::Vec3;

using std::numbers::pi;

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Averages over the neighbours, so that no crease is left where the shares begin.
void smooth(std::vector<double>& share, const TriangleMesh& mesh, int rounds) {
  std::vector<double> sum(share.size()), weight(share.size());
  for (int round = 0; round < rounds; ++round) {
    std::fill(sum.begin(), sum.end(), 0.0);
    std::fill(weight.begin(), weight.end(), 0.0);
    for (const auto& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) {
        const auto from = std::size_t(t[std::size_t(k)]), to = std::size_t(t[std::size_t((k + 1) % 3)]);
        sum[to] += share[from], sum[from] += share[to];
        weight[to] += 1, weight[from] += 1;
      }
    for (std::size_t i = 0; i < share.size(); ++i)
      if (weight[i] > 0) share[i] = 0.5 * share[i] + 0.5 * sum[i] / weight[i];
  }
}

/// 0 on the trunk, 1 on the arm from a joint on: along the axis over `blend` to both sides of the joint.
std::vector<double> shares(const TriangleMesh& mesh, const Vec3& joint, const Vec3& end, double blend,
                           double radius) {
  const Vec3 axis = (end - joint).normalized();
  std::vector<double> share;
  for (const Vec3& x : mesh.vertices) {
    const Vec3 from = x - joint;
    const double along = from.dot(axis), off = (from - along * axis).norm();
    const bool is_arm = off < radius + 0.12 * std::max(along, 0.0);  // the hand lies off the axis
    share.push_back(is_arm ? smooth_step(0.5 + along / (2 * blend)) : 0);
  }
  smooth(share, mesh, 10);
  return share;
}

void turn(TriangleMesh& mesh, const std::vector<double>& share, const Vec3& pivot,
          const Eigen::AngleAxisd& rotation) {
  for (std::size_t i = 0; i < share.size(); ++i) {
    if (share[i] == 0) continue;
    const Eigen::AngleAxisd part(share[i] * rotation.angle(), rotation.axis());
    mesh.vertices[i] = pivot + part * (mesh.vertices[i] - pivot);
  }
}

Eigen::AngleAxisd between(const Vec3& from, const Vec3& to) {
  if (!(to.norm() > 0)) throw std::invalid_argument("posed: a direction of the pose has no length");
  return Eigen::AngleAxisd(Eigen::Quaterniond::FromTwoVectors(from, to));
}

/// The shares are found on the figure as it stands, then both joints turn.
void pose_left(TriangleMesh& mesh, const Arm& arm, const ArmPose& pose) {
  const Vec3 upper = arm.elbow - arm.shoulder, fore = arm.wrist - arm.elbow;
  const Eigen::AngleAxisd at_shoulder = between(upper, pose.upper);
  const std::vector<double> whole = shares(mesh, arm.shoulder, arm.elbow, 1.3 * arm.radius, arm.radius);
  const std::vector<double> outer = shares(mesh, arm.elbow, arm.wrist, arm.radius, 1.3 * arm.radius);
  turn(mesh, outer, arm.elbow, between(fore, at_shoulder.inverse() * pose.fore));
  turn(mesh, whole, arm.shoulder, at_shoulder);
}

void mirror(TriangleMesh& mesh) {
  for (Vec3& x : mesh.vertices) x.x() = -x.x();
}

}  // namespace

Arm mannequin_arm() {  // mannequin.cpp's axis; the hand lies before it, so does the elbow a little
  const Vec3 shoulder(0.160, 1.354, -0.024), down(0.6, -0.8, 0);
  return {shoulder, shoulder + 0.27 * down, shoulder + 0.5 * down + Vec3(0, 0, 0.035), 0.05};
}

ArmPose a_pose(double degrees) {
  const Vec3 direction(std::cos(degrees * pi / 180), -std::sin(degrees * pi / 180), 0);
  return {direction, direction};
}

ArmPose bent_in_front(bool high) {
  return {Vec3(0.35, -0.75, 0.55).normalized(), Vec3(-0.92, high ? 0.3 : -0.3, 0.3).normalized()};
}

TriangleMesh posed(const TriangleMesh& figure, const Arm& arm, const ArmPose& left, const ArmPose& right) {
  TriangleMesh mesh = figure;
  pose_left(mesh, arm, left);
  mirror(mesh);
  pose_left(mesh, arm, right);
  mirror(mesh);
  return mesh;
}

TriangleMesh arms_in_front(const TriangleMesh& mannequin) {
  return posed(mannequin, mannequin_arm(), bent_in_front(true), bent_in_front(false));
}

}  // namespace furrow::cases
