// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/drape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather.h"
#include "bridge/arrays/place_noise.h"
#include "bridge/draping/energy_parts.h"
#include "bridge/draping/level_start.h"
#include "geometry/mesh/preconditions.h"
#include "physics/base/require.h"
#include "physics/rest/give_way.h"
#include "physics/rest/settle.h"

namespace furrow::bridge {
namespace {

using physics::Vec3;

void check(const DrapeOptions& o) {
  using physics::require;
  constexpr const char* me = "drape";
  const double depth = o.settle.contact_depth;
  require(me, "refinements", o.refinements, o.refinements >= 0 && o.refinements <= 6, "in [0, 6]");
  require(me, "coarse_tolerance", o.coarse_tolerance, o.coarse_tolerance > 0, "> 0");
  require(me, "disturbance", o.disturbance, o.disturbance >= 0, ">= 0");
  require(me, "soft_start", o.soft_start, o.soft_start >= 1, ">= 1");
  require(me, "contact_depth", std::min(depth, 1e300), !o.plain || std::isinf(depth),
          "left out, as the plain scheme needs it");
  require(me, "bending_friction", o.bending_friction,
          o.bending_friction >= 0 && !(o.bending_friction > 0 && o.plain),
          o.plain ? "0, as the plain scheme needs it" : ">= 0");
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
  options.self = o.self;
  options.threads = o.threads;
  const physics::DisplaceReport r = physics::displace_by_force(cloth, body, options, observer);
  physics::SettleReport report;
  report.iterations = r.passes;
  report.residual = r.residual;
  report.converged = r.outcome == physics::DisplaceOutcome::converged;
  report.stopped = r.outcome == physics::DisplaceOutcome::stopped;
  report.touching = r.touching;
  report.self = r.self;
  return report;
}

constexpr int most_soft_iterations = 50;
/// Where the cloth comes to rest, roughly, with triangles that are softer: a start for its own search.
physics::SettleReport settle_softly(physics::Cloth& cloth, const physics::Collider* body,
                                    const DrapeOptions& o, const physics::SettleObserver& observer) {
  physics::SettleOptions rough = o.settle;
  rough.tolerance = std::max(rough.tolerance, o.coarse_tolerance);
  rough.contact_depth = std::numeric_limits<double>::infinity();
  rough.faces = {};
  rough.work = o.work ? &o.work->levels[0] : nullptr;
  rough.max_iterations = std::min(rough.max_iterations, most_soft_iterations);
  rough.self.max_iterations = 0;
  const std::vector<physics::MembraneTriangle> own = cloth.membrane;
  for (physics::MembraneTriangle& t : cloth.membrane) {
    t.lambda /= o.soft_start;
    t.mu /= o.soft_start;
    t.threads.warp /= o.soft_start;
    t.threads.weft /= o.soft_start;
  }
  const physics::SettleReport report = physics::settle(cloth, body, rough, observer);
  cloth.membrane = own;
  return report;
}

constexpr double far = 0.25;  // [m] from the body, where cloth that nothing holds has fallen past it

/// Whether cloth that touches nothing on a coarse level falls past the body, which no finer level would mend:
/// all of it, or all that was not laid aside. As a rough rest may lie above what the cloth comes to lie on, a
/// copy looks for rest to the end; it takes the cloth's place if it falls.
bool falls_past(physics::Cloth& cloth, const physics::Collider* body, const DrapeOptions& o,
                const physics::SettleObserver& observer, physics::SettleReport& rest) {
  const std::vector<double>& inv_mass = cloth.particles.inv_mass;
  const auto held = std::count(inv_mass.begin(), inv_mass.end(), 0);
  const bool carried = held > 0 && (!o.held_aside || held == std::ssize(inv_mass));
  if (!body || o.plain || carried || o.settle.gravity.isZero() || rest.stopped || rest.touching > 0)
    return false;
  physics::SettleOptions fine = level_options(o, false, false);
  fine.tolerance = o.settle.tolerance;
  physics::Cloth copy = cloth;
  const physics::SettleReport end = physics::settle(copy, body, fine, observer);
  bool falls = end.touching == 0 && !end.stopped;
  for (std::size_t i = 0; falls && i < inv_mass.size(); ++i)
    falls = !(inv_mass[i] > 0) || body->at(copy.particles.x[i]).value > far;
  rest.stopped = end.stopped;
  if (falls) cloth = std::move(copy), rest = end;
  return falls;
}

}  // namespace

DrapeReport drape(geometry::Mesh& garment, physics::Cloth& cloth, const physics::Collider* body,
                  const DrapeOptions& asked, const MakeCloth& make_cloth, const DrapeObserver& go_on) {
  check(asked);
  geometry::check_mesh(garment, "drape");
  DrapeOptions o = asked;
  DrapeReport report;
  Carried carried;
  const PlaceNoise noise(positions_of(garment), o.seed);
  DrapeWork* const work = o.work;
  if (work) work->levels.resize(std::size_t(o.refinements) + 1);
  for (int level = 0; level <= o.refinements; ++level) {
    if (level > 0) carried = {cloth.particles.x, refine_level(cloth.particles.x, garment)};
    const bool last = level == o.refinements;
    const std::vector<Vec3> places = positions_of(garment);
    geometry::Mesh made = garment;
    cloth = make_cloth(made);
    if (!carried.coarse.empty()) carried.coarse = lay_on_coarse(carried.coarse, cloth);
    const std::vector<Vec3> drawn = cloth.particles.x;
    o.settle.self.drawn = drawn;
    report.disturbance = std::ldexp(report.stopped ? 0 : o.disturbance * noise.diagonal(), -level);
    DrapeLevel& now = report.levels.emplace_back();
    now.vertices = cloth.particles.size();
    begin_level(cloth, carried, {places, noise, report.disturbance}, body, o, now);
    const auto observer = [&](const physics::SettleProgress& progress) {
      return !go_on || report.stopped || go_on(level, progress, cloth);
    };
    if (level == 0 && o.soft_start > 1 && !o.plain && !cloth.membrane.empty()) {
      now.soft = settle_softly(cloth, body, o, observer);
      report.stopped = now.soft.stopped;
    }
    physics::SettleOptions settle = level_options(o, last, report.stopped);
    settle.work = work ? &work->levels[std::size_t(level)] : nullptr;
    if (last && o.bending_friction > 0 && !report.stopped) {
      const physics::GivenWay rest =
          physics::settle_giving_way(cloth, body, o.bending_friction, settle, observer);
      now.settle = rest.settle;
      report.friction_rounds = rest.rounds;
      report.slip = rest.slip;
    } else {
      now.settle = find_rest(cloth, body, o.plain, settle, observer);
    }
    report.falls = !last && falls_past(cloth, body, o, observer, now.settle);
    report.stopped = report.stopped || now.settle.stopped;
    if (!last && !report.falls) continue;
    report.energy = energy_parts(cloth, o.settle.gravity, places);
    report.energy.contact = now.settle.contact_energy;
    garment = std::move(made);
    scatter(cloth.particles, garment);
    break;
  }
  return report;
}

}  // namespace furrow::bridge
