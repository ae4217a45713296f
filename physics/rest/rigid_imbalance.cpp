// SPDX-License-Identifier: MIT
#include "physics/rest/rigid_imbalance.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "physics/cloth/kinds.h"

namespace furrow::physics {
namespace {

constexpr double collinear = 1e-6;  // of the piece's size

/// Disjoint sets of particles.
class Pieces {
 public:
  explicit Pieces(const Cloth& cloth) : parent_(cloth.particles.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for_each_kind(cloth, [&](const auto& kind, auto...) {
      for (const auto& e : kind)
        for (const int v : vertices(e)) join(vertices(e)[0], v);
    });
  }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

 private:
  void join(int a, int b) {
    for (const int i : {a, b}) {
      if (i >= 0 && std::size_t(i) < parent_.size()) continue;
      throw std::invalid_argument("rigid_imbalances: an element names particle " + std::to_string(i) +
                                  " of " + std::to_string(parent_.size()));
    }
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);  // the root is the first particle
  }
  std::vector<int> parent_;
};

/// Finds point, axis and freedoms that pins leave.
void find_freedoms(const Particles& p, const std::vector<int>& pins, RigidImbalance& r) {
  Eigen::AlignedBox3d box;
  for (const int i : r.piece) box.extend(p.x[i]);
  for (const int i : pins) box.extend(p.x[i]);
  const double tolerance = collinear * box.diagonal().norm();
  r.freedoms = 6;
  if (pins.empty()) {
    double mass = 0;
    for (const int i : r.piece) r.point += p.mass[i] * p.x[i], mass += p.mass[i];
    r.point /= mass;
    return;
  }
  r.freedoms = 3;
  const auto farthest_from = [&](const auto& distance) {
    return *std::max_element(pins.begin(), pins.end(),
                             [&](int i, int j) { return distance(i) < distance(j); });
  };
  r.point = p.x[pins[0]];
  const auto from_point = [&](int i) { return (p.x[i] - r.point).norm(); };
  const int far = farthest_from(from_point);
  if (from_point(far) <= tolerance) return;
  r.freedoms = 1;
  r.axis = (p.x[far] - r.point).normalized();
  const auto from_axis = [&](int i) { return r.axis.cross(p.x[i] - r.point).norm(); };
  if (from_axis(farthest_from(from_axis)) > tolerance) r.freedoms = 0;
}

/// Solves I a = moment where I has a stiffness; a particle's own motion along a line of masses is none.
Vec3 solve_inertia(const Mat3& inertia, const Vec3& moment) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
  const Vec3 values = solver.eigenvalues(), part = solver.eigenvectors().transpose() * moment;
  Vec3 result = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (values[i] > 1e-12 * values[2]) result += part[i] / values[i] * solver.eigenvectors().col(i);
  }
  return result;
}

void find_load(const Particles& p, std::span<const Vec3> load, RigidImbalance& r) {
  Mat3 inertia = Mat3::Zero();
  double mass = 0;
  for (const int i : r.piece) {
    const Vec3 arm = p.x[i] - r.point;
    r.force += load[i];
    r.moment += arm.cross(load[i]);
    inertia += p.mass[i] * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
    mass += p.mass[i];
  }
  if (r.freedoms == 6) r.acceleration = r.force / mass;
  if (r.freedoms != 6) r.force.setZero();
  if (r.freedoms == 1) {
    r.moment = r.axis.dot(r.moment) * r.axis;
    const double about = r.axis.dot(inertia * r.axis);
    if (about > 0) r.angular_acceleration = r.moment / about;
  } else {
    r.angular_acceleration = solve_inertia(inertia, r.moment);
    if (r.moment.norm() > 0) r.axis = r.moment.normalized();
  }
  for (const int i : r.piece) {
    const Vec3 a = r.acceleration + r.angular_acceleration.cross(p.x[i] - r.point);
    r.largest = std::max(r.largest, a.norm());
  }
}

}  // namespace

std::vector<RigidImbalance> rigid_imbalances(const Cloth& cloth, std::span<const Vec3> load) {
  const Particles& p = cloth.particles;
  if (p.mass.size() != p.size() || p.inv_mass.size() != p.size() || load.size() != p.size()) {
    throw std::invalid_argument("rigid_imbalances: " + std::to_string(p.size()) +
                                " positions, but arrays of other lengths");
  }
  Pieces pieces(cloth);
  std::vector<std::vector<int>> free(p.size()), pinned(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    (p.inv_mass[i] > 0 ? free : pinned)[pieces.root(int(i))].push_back(int(i));
  std::vector<RigidImbalance> result;
  for (std::size_t root = 0; root < p.size(); ++root) {
    if (free[root].empty()) continue;
    RigidImbalance r;
    r.piece = std::move(free[root]);
    find_freedoms(p, pinned[root], r);
    if (r.freedoms == 0) continue;
    find_load(p, load, r);
    result.push_back(std::move(r));
  }
  return result;
}

void remove_rigid_load(const Cloth& cloth, const RigidImbalance& r, std::span<Vec3> load) {
  const Particles& p = cloth.particles;
  for (const int i : r.piece)
    load[i] -= p.mass[i] * (r.acceleration + r.angular_acceleration.cross(p.x[i] - r.point));
}

double balance_rigidly(Cloth& cloth, const Vec3& gravity) {
  Particles& p = cloth.particles;
  const std::vector<Vec3> nothing(p.size(), Vec3::Zero());
  double largest = 0;
  for (const RigidImbalance& r : rigid_imbalances(cloth, nothing)) {
    if (r.freedoms == 6) continue;
    Vec3 arm = Vec3::Zero(), down = gravity;
    double mass = 0;
    for (const int i : r.piece) arm += p.mass[i] * (p.x[i] - r.point), mass += p.mass[i];
    arm /= mass;
    if (r.freedoms == 1) {
      arm -= r.axis.dot(arm) * r.axis;
      down -= r.axis.dot(down) * r.axis;
    }
    if (!(arm.norm() > 0) || !(down.norm() > 1e-12 * gravity.norm())) continue;
    Vec3 about = r.freedoms == 1 ? r.axis : Vec3(arm.cross(down));
    if (!(about.norm() > 0)) about = arm.unitOrthogonal();  // upside down or in balance
    about.normalize();
    const double angle = std::atan2(about.dot(arm.cross(down)), arm.dot(down));
    const Mat3 turn = Eigen::AngleAxisd(angle, about).toRotationMatrix();
    for (const int i : r.piece) p.x[i] = r.point + turn * (p.x[i] - r.point);
    largest = std::max(largest, std::abs(angle));
  }
  return largest;
}

}  // namespace furrow::physics
