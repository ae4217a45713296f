// SPDX-License-Identifier: MIT
#include "physics/rest/hinge_friction.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "physics/cloth/dihedral.h"
#include "physics/cloth/hinge_forces.h"

namespace furrow::physics {
namespace {

[[noreturn]] void fail(const std::string& what) { throw std::invalid_argument("hinge friction: " + what); }

}  // namespace

HingeFriction add_hinge_friction(Cloth& cloth, const HingeFrictionOptions& o) {
  if (!(o.stiffness > 0) || !std::isfinite(o.stiffness))
    fail("stiffness = " + std::to_string(o.stiffness) + " is not > 0");
  if (!(o.moment >= 0) || !std::isfinite(o.moment))
    fail("moment = " + std::to_string(o.moment) + " is not >= 0");
  if (cloth.hinge_law != HingeLaw::linear) fail("needs linear hinges");
  for (const Hinge& h : cloth.hinges) check(h, cloth.particles.size());
  HingeFriction friction{int(cloth.hinges.size()), {}};
  const std::vector<Vec3>& x = cloth.particles.x;
  for (int i = 0; i < friction.first; ++i) {
    Hinge h = cloth.hinges[i];
    h.stiffness *= o.stiffness;
    friction.limit.push_back(o.moment * (x[h.vertices[1]] - x[h.vertices[0]]).norm());
    cloth.hinges.push_back(h);
  }
  return friction;
}

double update_friction(Cloth& cloth, const HingeFriction& friction) {
  const std::size_t n = friction.limit.size();
  if (friction.first < 0 || cloth.hinges.size() < std::size_t(friction.first) + n ||
      cloth.hinge_law != HingeLaw::linear)
    fail("is that of another cloth");
  const std::vector<Vec3>& x = cloth.particles.x;
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    Hinge& h = cloth.hinges[std::size_t(friction.first) + i];
    check(h, x.size());
    if (h.stiffness == 0) continue;
    const auto& v = h.vertices;
    const double theta = dihedral_angle(x[v[0]], x[v[1]], x[v[2]], x[v[3]]);
    const double phi = bend(theta, h.rest_angle), most = friction.limit[i] / h.stiffness;
    if (!(std::abs(phi) > most)) continue;
    h.rest_angle = bend(theta, std::copysign(most, phi));
    largest = std::max(largest, std::abs(phi) - most);
  }
  return largest;
}

FrictionReport settle_with_friction(Cloth& cloth, const HingeFriction& friction, const StaticOptions& options,
                                    double slip_tolerance, int max_rounds) {
  if (!(slip_tolerance > 0)) fail("slip_tolerance = " + std::to_string(slip_tolerance) + " is not > 0");
  if (max_rounds < 1) fail("max_rounds = " + std::to_string(max_rounds) + " is not >= 1");
  FrictionReport report;
  while (report.rounds < max_rounds && !report.settled) {
    report.last = find_static_equilibrium(cloth, options);
    report.slip = update_friction(cloth, friction);
    ++report.rounds;
    report.settled = report.slip <= slip_tolerance && report.last.converged;
  }
  return report;
}

}  // namespace furrow::physics
