// SPDX-License-Identifier: MIT
#include "physics/rest/plate_friction.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "physics/base/require.h"
#include "physics/plate/plate_bending.h"

namespace furrow::physics {
namespace {

using Eigen::Vector3d;
constexpr const char* plate_friction = "plate friction";

/// Of moments (M11, M22, M12): that of the tensor.
double size_of(const Vector3d& m) { return std::sqrt(m.x() * m.x() + m.y() * m.y() + 2 * m.z() * m.z()); }

/// Moves k_p of one triangle; returns by how much.
double give_way(const Eigen::Matrix3d& stiffness, double most, const Vector3d& k, Vector3d& at_rest) {
  const Vector3d beyond = k - at_rest;
  const double moment = size_of(stiffness * beyond);
  if (!(moment > most)) return 0;
  const double share = most / moment;
  at_rest = k - share * beyond;
  return (1 - share) * beyond.norm();
}

}  // namespace

PlateFriction add_plate_friction(Cloth& cloth, const HingeFrictionOptions& o) {
  require(plate_friction, "stiffness", o.stiffness, o.stiffness > 0, "> 0");
  require(plate_friction, "moment", o.moment, o.moment >= 0, ">= 0");
  PlateFriction friction{{}, o.moment};
  for (std::size_t i = 0, own = cloth.energies.size(); i < own; ++i) {
    const auto* plate = dynamic_cast<const PlateBending*>(cloth.energies[i].get());
    if (!plate) continue;
    Plate second = plate->plate();
    for (Eigen::Matrix3d& d : second.stiffness) d *= o.stiffness;
    friction.energies.push_back(cloth.energies.size());
    cloth.energies.push_back(std::make_shared<PlateBending>(std::move(second), *plate, nullptr));
  }
  return friction;
}

double update_friction(Cloth& cloth, const PlateFriction& friction) {
  for (const std::size_t i : friction.energies)
    if (i >= cloth.energies.size() || !dynamic_cast<const PlateBending*>(cloth.energies[i].get()))
      refuse(plate_friction, "is that of another cloth");
  double largest = 0;
  for (const std::size_t i : friction.energies) {
    const auto& old = dynamic_cast<const PlateBending&>(*cloth.energies[i]);
    const Plate& plate = old.plate();
    const std::vector<Vector3d> k = old.curvatures(cloth.particles.x);
    std::vector<Vector3d> at_rest = plate.at_rest;
    at_rest.resize(k.size(), Vector3d::Zero());
    double moved = 0;
    for (std::size_t t = 0; t < k.size(); ++t) {
      const double by = give_way(plate.stiffness[t], friction.limit * plate.area[t], k[t], at_rest[t]);
      moved = std::max(moved, by * std::sqrt(2 * plate.area[t]));
    }
    if (moved == 0) continue;
    auto next = std::make_shared<PlateBending>(old);
    next->put_at_rest(std::move(at_rest));
    cloth.energies[i] = std::move(next);
    largest = std::max(largest, moved);
  }
  return largest;
}

}  // namespace furrow::physics
