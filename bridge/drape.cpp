// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/drape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>

#include "bridge/convert.h"
#include "bridge/scatter.h"
#include "geometry/refine/subdivide.h"
#include "physics/rest/displace_by_force.h"
#include "physics/rest/hinge_friction.h"

namespace furrow::bridge {
namespace {

using physics::Vec3;

void check(const DrapeOptions& o) {
  const auto need = [](bool good, const char* name, double value, const char* range) {
    if (good && std::isfinite(value)) return;
    throw std::invalid_argument(std::string("drape: ") + name + " = " + std::to_string(value) + " is not " +
                                range);
  };
  need(o.refinements >= 0 && o.refinements <= 6, "refinements", o.refinements, "in [0, 6]");
  need(o.coarse_tolerance > 0, "coarse_tolerance", o.coarse_tolerance, "> 0");
  need(o.disturbance >= 0, "disturbance", o.disturbance, ">= 0");
  need(!o.plain || std::isinf(o.settle.contact_depth), "contact_depth",
       std::min(o.settle.contact_depth, 1e300), "left away, as the plain scheme needs it");
  need(o.bending_friction >= 0 && !(o.bending_friction > 0 && o.plain), "bending_friction",
       o.bending_friction, o.plain ? "0, as the plain scheme needs it" : ">= 0");
}

/// Moves each free particle along its normal, in or out, by up to so much of the mean edge, the same way in
/// every run. Creases begin so, and the cloth is hardly strained.
double disturb(physics::Cloth& cloth, double share) {
  std::vector<Vec3>& x = cloth.particles.x;
  std::vector<Vec3> normal(x.size(), Vec3::Zero());
  double sum = 0;
  for (const auto& [a, b, c] : cloth.triangles) {
    sum += (x[b] - x[a]).norm() + (x[c] - x[b]).norm() + (x[a] - x[c]).norm();
    const Vec3 n = (x[b] - x[a]).eval().cross((x[c] - x[a]).eval());
    for (const int corner : {a, b, c}) normal[std::size_t(corner)] += n;
  }
  const double by = cloth.triangles.empty() ? 0 : share * sum / (3 * double(cloth.triangles.size()));
  std::mt19937_64 engine(1);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double random = double(engine() >> 11) * 0x1p-52 - 1, length = normal[i].norm();
    if (cloth.particles.inv_mass[i] > 0 && length > 0) x[i] += by * random / length * normal[i];
  }
  return by;
}

/// How deep cloth at rest may lie inside the gap: moving it out would only strain it.
double rest_depth(double gap) { return std::min(gap / 6, 5e-4); }

physics::PushOutReport bring_out(physics::Cloth& cloth, const physics::Collider* body, double gap) {
  if (!body) return {};
  std::vector<int> free;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i)
    if (cloth.particles.inv_mass[i] > 0) free.push_back(int(i));
  return physics::push_out(cloth.particles.x, free, *body, gap);
}

physics::SettleReport find_rest(physics::Cloth& cloth, const physics::Collider* body, bool plain,
                                const physics::SettleOptions& o, const physics::SettleObserver& observer) {
  if (!plain) return physics::settle(cloth, body, o, observer);
  physics::DisplaceOptions options;
  options.gravity = o.gravity;
  options.friction = o.friction;
  options.gap = o.gap;
  options.tolerance = o.tolerance;
  options.max_passes = o.max_iterations;
  const physics::DisplaceReport r = physics::displace_by_force(cloth, body, options, observer);
  physics::SettleReport report;
  report.iterations = r.passes;
  report.residual = r.residual;
  report.converged = r.outcome == physics::DisplaceOutcome::converged;
  report.stopped = r.outcome == physics::DisplaceOutcome::stopped;
  report.touching = r.touching;
  return report;
}

constexpr double least_slip = 2e-3;  // rad
constexpr int most_rounds = 60;

/// Finds rest on the last level, again while hinges give way; their friction stands at the end of the cloth's
/// hinges.
void give_way(physics::Cloth& cloth, const physics::Collider* body, double moment,
              const physics::SettleOptions& o, const physics::SettleObserver& observer,
              physics::SettleReport& settled, DrapeReport& report) {
  const physics::HingeFriction friction = physics::add_hinge_friction(cloth, {.moment = moment});
  do {
    const physics::SettleReport now = physics::settle(cloth, body, o, observer);
    const physics::SettleReport before = settled;
    settled = now;
    settled.iterations += before.iterations;
    settled.factorisations += before.factorisations;
    settled.followers += before.followers;
    if (!now.converged) return;
    report.slip = physics::update_friction(cloth, friction);
  } while (report.slip > least_slip && ++report.friction_rounds < most_rounds);
}

}  // namespace

DrapeReport drape(geometry::Mesh& garment, physics::Cloth& cloth, const physics::Collider* body,
                  const DrapeOptions& o, const MakeCloth& make_cloth, const DrapeObserver& go_on) {
  check(o);
  DrapeReport report;
  std::vector<Vec3> carried;  // positions that the level before ended at, refined
  for (int level = 0; level <= o.refinements; ++level) {
    if (level > 0) {
      geometry::Mesh shape = garment;  // so that new vertices come in the same order
      scatter(cloth.particles, shape);
      geometry::loop_subdivide(shape, 1);
      carried = positions_of(shape);
      geometry::loop_subdivide(garment, 1);
    }
    const bool last = level == o.refinements;
    geometry::Mesh made = garment;
    cloth = make_cloth(made);
    for (std::size_t i = 0; i < carried.size(); ++i)
      if (cloth.particles.inv_mass[i] > 0) cloth.particles.x[i] = carried[i];
    report.disturbance = disturb(cloth, report.stopped ? 0 : o.disturbance);
    DrapeLevel& now = report.levels.emplace_back();
    now.vertices = cloth.particles.size();
    now.pushed = bring_out(cloth, body, o.settle.gap - (carried.empty() ? 0 : rest_depth(o.settle.gap)));
    physics::SettleOptions settle = o.settle;
    if (!last) {
      settle.tolerance = std::max(settle.tolerance, o.coarse_tolerance);
      settle.contact_depth = std::numeric_limits<double>::infinity();
    }
    if (report.stopped) settle.max_iterations = 0;
    const auto observer = [&](const physics::SettleProgress& progress) {
      return !go_on || report.stopped || go_on(level, progress, cloth);
    };
    if (last && o.bending_friction > 0 && !report.stopped)
      give_way(cloth, body, o.bending_friction, settle, observer, now.settle, report);
    else
      now.settle = find_rest(cloth, body, o.plain, settle, observer);
    report.stopped = report.stopped || now.settle.stopped;
    if (last) {
      garment = std::move(made);
      scatter(cloth.particles, garment);
    }
  }
  return report;
}

}  // namespace furrow::bridge
