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
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/preconditions.h"
#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"
#include "physics/base/require.h"
#include "physics/cloth/patch_membrane.h"
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

physics::SettleReport find_rest(physics::Cloth& cloth, const physics::Collider* body,
                                const DrapeOptions& asked, const physics::SettleOptions& o,
                                const physics::SettleObserver& observer) {
  if (!asked.plain) return settle_level(cloth, body, o, asked, observer);
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
  const auto energies = cloth.energies;
  physics::soften_membrane(cloth, o.soft_start);
  const physics::SettleReport report = physics::settle(cloth, body, rough, observer);
  cloth.membrane = own;
  cloth.energies = energies;
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

/// One level of a drape.
struct Level {
  geometry::Mesh made;  ///< with the maps of make_cloth
  physics::Cloth cloth;
  std::vector<Vec3> places;  ///< of the garment, as it was made [m]
  std::vector<Vec3> drawn;   ///< of the particles, as they were made [m]
  DrapeLevel report;
};

/// The cloth of a level, unless interrupted.
physics::Cloth make_on_way_up(const MakeCloth& make_cloth, geometry::Mesh& made, const DrapeOptions& o) {
  const physics::CancelScope way_up(cancels_way_up(o));
  return make_cloth(made);
}

/// The first level, or the one above that of the cloth. Throws Cancelled if interrupted; the cloth is
/// unchanged.
Level go_up(geometry::Mesh& garment, const physics::Cloth& below, double disturbance, const PlaceNoise& noise,
            const physics::Collider* body, const DrapeOptions& o, const MakeCloth& make_cloth) {
  Carried carried;
  if (below.particles.size() > 0) carried = {below.particles.x, refine_level(below.particles.x, garment, o)};
  Level level{garment, {}, positions_of(garment), {}, {}};
  level.cloth = make_on_way_up(make_cloth, level.made, o);
  if (!carried.coarse.empty()) carried.coarse = lay_on_coarse(carried.coarse, level.cloth);
  level.drawn = level.cloth.particles.x;
  level.report.vertices = level.cloth.particles.size();
  DrapeOptions here = o;
  here.settle.self.drawn = level.drawn;
  begin_level(level.cloth, carried, {level.places, noise, disturbance}, body, here, level.report);
  const physics::CancelScope way_up(cancels_way_up(o));
  physics::throw_if_cancelled("drape");
  return level;
}

/// Looks for rest on a level: the first one with softer cloth before, if asked, the last one to the end.
/// Notes in the report whether it was stopped, or falls.
void come_to_rest(Level& now, int number, const physics::Collider* body, const DrapeOptions& asked,
                  const DrapeObserver& go_on, DrapeReport& report) {
  DrapeOptions o = asked;
  o.settle.self.drawn = now.drawn;
  const bool last = number == o.refinements;
  const auto observer = [&](const physics::SettleProgress& progress) {
    return !go_on || report.stopped || go_on(number, progress, now.cloth);
  };
  if (number == 0 && o.soft_start > 1 && !o.plain && !now.cloth.membrane.empty()) {
    now.report.soft = settle_softly(now.cloth, body, o, observer);
    report.stopped = now.report.soft.stopped;
  }
  physics::SettleOptions settle = level_options(o, last, report.stopped);
  settle.work = o.work ? &o.work->levels[std::size_t(number)] : nullptr;
  if (last && o.bending_friction > 0 && !report.stopped) {
    const physics::GivenWay rest =
        physics::settle_giving_way(now.cloth, body, o.bending_friction, settle, observer);
    now.report.settle = rest.settle;
    report.friction_rounds = rest.rounds;
    report.slip = rest.slip;
  } else {
    now.report.settle = find_rest(now.cloth, body, o, settle, observer);
  }
  report.falls = !last && falls_past(now.cloth, body, o, observer, now.report.settle);
  report.stopped = report.stopped || now.report.settle.stopped;
}

}  // namespace

DrapeReport drape(geometry::Mesh& garment, physics::Cloth& cloth, const physics::Collider* body,
                  const DrapeOptions& o, const MakeCloth& make_cloth, const DrapeObserver& go_on) {
  check(o);
  geometry::check_mesh(garment, "drape");
  DrapeReport report;
  const PlaceNoise noise(positions_of(garment), o.seed);
  if (o.work) o.work->levels.resize(std::size_t(o.refinements) + 1);
  Level now;
  for (int level = 0; level <= o.refinements; ++level) {
    const double disturbance = std::ldexp(report.stopped ? 0 : o.disturbance * noise.diagonal(), -level);
    try {
      Level next = go_up(garment, now.cloth, disturbance, noise, body, o, make_cloth);
      come_to_rest(next, level, body, o, go_on, report);
      now = std::move(next);
    } catch (const physics::Cancelled&) {
      if (level == 0) throw;
      report.stopped = true;
      break;
    }
    report.disturbance = disturbance;
    report.levels.push_back(now.report);
    if (report.falls || (report.stopped && cancels_way_up(o)())) break;
  }
  report.energy = energy_parts(now.cloth, o.settle.gravity, now.places);
  report.energy.contact = now.report.settle.contact_energy;
  garment = std::move(now.made);
  cloth = std::move(now.cloth);
  scatter(cloth.particles, garment);
  return report;
}

}  // namespace furrow::bridge
