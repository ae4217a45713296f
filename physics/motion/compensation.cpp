// SPDX-License-Identifier: MIT
#include "physics/motion/compensation.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "physics/cloth/elements.h"

namespace furrow::physics {
namespace {

constexpr double least_share = 1e-9;

std::vector<Vec3> loads(const Cloth& cloth, const Vec3& gravity) {
  std::vector<Vec3> force(cloth.particles.size(), Vec3::Zero());
  add_forces(cloth, cloth.particles.x, force);
  for (std::size_t i = 0; i < force.size(); ++i) force[i] += cloth.particles.mass[i] * gravity;
  return force;
}

}  // namespace

void check(const Compensation& compensation, std::size_t particles) {
  const auto refuse = [](const std::string& what) { throw std::invalid_argument("compensation: " + what); };
  if (!compensation.force.empty() && compensation.force.size() != particles) {
    refuse(std::to_string(compensation.force.size()) + " forces for " + std::to_string(particles) +
           " particles");
  }
  for (const Vec3& f : compensation.force)
    if (!f.allFinite()) refuse("a force is not finite");
  if (!(compensation.time_constant > 0)) {
    refuse("time constant = " + std::to_string(compensation.time_constant) + " is not > 0");
  }
  if (!std::isfinite(compensation.start)) refuse("the start is not finite");
}

double share_left(const Compensation& compensation, double time) {
  if (compensation.force.empty()) return 0;
  if (time <= compensation.start) return 1;
  const double share = std::exp(-(time - compensation.start) / compensation.time_constant);
  return share < least_share ? 0 : share;
}

std::vector<Vec3> force_jump(const Cloth& before, const Cloth& after, const Vec3& gravity) {
  if (after.particles.size() < before.particles.size()) {
    throw std::invalid_argument("force_jump: " + std::to_string(after.particles.size()) +
                                " particles after, but " + std::to_string(before.particles.size()) +
                                " before");
  }
  std::vector<Vec3> jump = loads(after, gravity);
  const std::vector<Vec3> old = loads(before, gravity);
  for (std::size_t i = 0; i < old.size(); ++i) jump[i] -= old[i];
  return jump;
}

void add(Compensation& compensation, const std::vector<Vec3>& jump, double time) {
  if (jump.size() < compensation.force.size()) {
    throw std::invalid_argument("compensation: a jump of " + std::to_string(jump.size()) +
                                " particles after one of " + std::to_string(compensation.force.size()));
  }
  const double share = share_left(compensation, time);
  std::vector<Vec3> force = jump;
  for (std::size_t i = 0; i < compensation.force.size(); ++i) force[i] += share * compensation.force[i];
  compensation.force = std::move(force);
  compensation.start = time;
}

Vec3 net_force(const Compensation& compensation, double time) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& f : compensation.force) sum -= f;
  return share_left(compensation, time) * sum;
}

}  // namespace furrow::physics
