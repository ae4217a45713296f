// SPDX-License-Identifier: MIT
#include "physics/rest/hinge_friction.h"

#include <algorithm>
#include <cmath>

#include "physics/base/require.h"
#include "physics/cloth/dihedral.h"
#include "physics/cloth/hinge_forces.h"

namespace furrow::physics {
namespace {

constexpr const char* me = "hinge friction";

}  // namespace

HingeFriction add_hinge_friction(Cloth& cloth, const HingeFrictionOptions& o) {
  require(me, "stiffness", o.stiffness, o.stiffness > 0, "> 0");
  require(me, "moment", o.moment, o.moment >= 0, ">= 0");
  if (cloth.hinge_law != HingeLaw::linear) refuse(me, "needs linear hinges");
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
    refuse(me, "is that of another cloth");
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

}  // namespace furrow::physics
