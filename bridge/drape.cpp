// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/drape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "bridge/convert.h"
#include "bridge/energy_parts.h"
#include "bridge/gather.h"
#include "bridge/place_noise.h"
#include "geometry/refine/subdivide.h"
#include "physics/base/require.h"
#include "physics/base/thread_pool.h"
#include "physics/pairs/cloth_contact.h"
#include "physics/rest/hinge_friction.h"
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
  require(me, "self.on", o.settle.self.on, !(o.settle.self.on && o.plain),
          "false, as the plain scheme needs it");
  require(me, "bending_friction", o.bending_friction,
          o.bending_friction >= 0 && !(o.bending_friction > 0 && o.plain),
          o.plain ? "0, as the plain scheme needs it" : ">= 0");
}

/// Noise at places of the garment as it was given.
struct Disturbance {
  const std::vector<Vec3>& places;  ///< one a particle [m]
  const PlaceNoise& noise;
  double by;  ///< [m]
};

/// Moves each free particle along its normal by the noise at its place. Creases begin so, and the cloth is
/// hardly strained.
void disturb(physics::Cloth& cloth, const Disturbance& d) {
  std::vector<Vec3>& x = cloth.particles.x;
  std::vector<Vec3> normal(x.size(), Vec3::Zero());
  for (const auto& [a, b, c] : cloth.triangles) {
    const Vec3 n = (x[b] - x[a]).eval().cross((x[c] - x[a]).eval());
    for (const int corner : {a, b, c}) normal[std::size_t(corner)] += n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double length = normal[i].norm();
    if (cloth.particles.inv_mass[i] > 0 && length > 0)
      x[i] += d.by * d.noise(d.places[i]) / length * normal[i];
  }
}

/// How deep cloth at rest may lie inside the gap: moving it out would only strain it.
double rest_depth(double gap) { return std::min(gap / 6, 5e-4); }

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

constexpr int most_soft_iterations = 50;
constexpr double least_slip = 2e-3;  // rad
constexpr int most_rounds = 60;

struct WornRest {
  physics::SettleReport settle;  ///< of all rounds together
  int rounds = 0;                ///< after which hinges gave way
  double slip = 0;               ///< of a hinge in the last of them [rad]
};
/// Finds rest on the last level, again while hinges give way; their friction stands at the end of the cloth's
/// hinges.
WornRest give_way(physics::Cloth& cloth, const physics::Collider* body, double moment,
                  const physics::SettleOptions& o, const physics::SettleObserver& observer) {
  const physics::HingeFriction friction = physics::add_hinge_friction(cloth, {.moment = moment});
  WornRest rest;
  do {
    const physics::SettleReport before = rest.settle;
    rest.settle = physics::settle(cloth, body, o, observer);
    const bool converged = rest.settle.converged;
    rest.settle.iterations += before.iterations;
    rest.settle.factorisations += before.factorisations;
    rest.settle.followers += before.followers;
    if (!converged) break;
    rest.slip = physics::update_friction(cloth, friction);
  } while (rest.slip > least_slip && ++rest.rounds < most_rounds);
  return rest;
}

/// Where the cloth comes to rest, roughly, with triangles that are softer: a start for its own search.
physics::SettleReport settle_softly(physics::Cloth& cloth, const physics::Collider* body,
                                    const DrapeOptions& o, const physics::SettleObserver& observer) {
  physics::SettleOptions rough = o.settle;
  rough.tolerance = std::max(rough.tolerance, o.coarse_tolerance);
  rough.contact_depth = std::numeric_limits<double>::infinity();
  rough.faces = {};
  rough.work = o.work ? &o.work->levels[0] : nullptr;
  rough.max_iterations = std::min(rough.max_iterations, most_soft_iterations);
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

/// The next level's mesh. Returns where the shape that was found lies on it.
std::vector<Vec3> refine(const physics::Particles& found, geometry::Mesh& garment) {
  geometry::Mesh shape = garment;  // so that new vertices come in the same order
  scatter(found, shape);
  geometry::loop_subdivide(shape, 1);
  geometry::loop_subdivide(garment, 1);
  return positions_of(shape);
}

/// The coarse surface on the mesh that refined it: new vertices lie in the middles of old edges, so that what
/// did not cross does not cross. Held particles stay.
void lay_on_coarse(const std::vector<Vec3>& coarse, physics::Cloth& cloth) {
  std::vector<Vec3> sum(cloth.particles.size(), Vec3::Zero());
  std::vector<double> count(sum.size(), 0);
  for (const auto& t : cloth.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      for (const int other : {t[(i + 1) % 3], t[(i + 2) % 3]}) {
        if (std::size_t(other) >= coarse.size()) continue;
        sum[std::size_t(t[i])] += coarse[std::size_t(other)];
        ++count[std::size_t(t[i])];
      }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (!(cloth.particles.inv_mass[i] > 0)) continue;
    if (i < coarse.size())
      cloth.particles.x[i] = coarse[i];
    else if (count[i] > 0)
      cloth.particles.x[i] = sum[i] / count[i];
  }
}

/// A level's start, brought to where it is to begin without passing through cloth on the way. Returns how
/// many vertices did not arrive.
int keep_apart(physics::Cloth& cloth, std::vector<Vec3> from, const physics::SettleOptions& o) {
  physics::ThreadPool pool(o.threads);
  physics::ClothContact contact(cloth, {o.self.thickness, 1}, from, {}, &pool);
  const int left = contact.approach(from, cloth.particles.x, &pool);
  cloth.particles.x = std::move(from);
  return left;
}

/// Where the level before ended.
struct Carried {
  std::vector<Vec3> coarse;  ///< its positions; empty on the first level
  std::vector<Vec3> fine;    ///< refined
};

/// Puts a level's cloth where it begins: where it was carried, disturbed, and out of the body.
void begin_level(physics::Cloth& cloth, const Carried& carried, const Disturbance& disturbance,
                 const physics::Collider* body, const DrapeOptions& o, DrapeLevel& level) {
  physics::Particles& p = cloth.particles;
  std::vector<Vec3> from;
  if (o.settle.self.on) {
    const std::vector<Vec3> made = p.x;
    if (!carried.coarse.empty()) lay_on_coarse(carried.coarse, cloth);
    from = std::move(p.x);
    p.x = made;
  }
  for (std::size_t i = 0; i < carried.fine.size(); ++i)
    if (p.inv_mass[i] > 0) p.x[i] = carried.fine[i];
  if (disturbance.by > 0) disturb(cloth, disturbance);
  const double gap = o.settle.gap - (carried.fine.empty() ? 0 : rest_depth(o.settle.gap));
  if (body) level.pushed = physics::bring_out(p, *body, gap);
  if (o.settle.self.on) level.stopped = keep_apart(cloth, std::move(from), o.settle);
}

physics::SettleOptions options_of(const DrapeOptions& o, bool last, bool stopped) {
  physics::SettleOptions settle = o.settle;
  if (!last) {
    settle.tolerance = std::max(settle.tolerance, o.coarse_tolerance);
    settle.contact_depth = std::numeric_limits<double>::infinity();
    settle.faces = {};
  }
  if (stopped) settle.max_iterations = 0;
  return settle;
}

constexpr double far = 0.25;  // [m] from the body, where cloth that nothing holds has fallen past it

/// Whether cloth that touches nothing on a coarse level falls past the body, which no finer level would mend.
/// As a rough rest may lie above what the cloth comes to lie on, a copy looks for rest to the end; it takes
/// the cloth's place if it falls.
bool falls_past(physics::Cloth& cloth, const physics::Collider* body, const DrapeOptions& o,
                const physics::SettleObserver& observer, physics::SettleReport& rest) {
  const std::vector<double>& inv_mass = cloth.particles.inv_mass;
  const bool held = std::find(inv_mass.begin(), inv_mass.end(), 0) != inv_mass.end();
  if (!body || o.plain || held || o.settle.gravity.isZero() || rest.stopped || rest.touching > 0)
    return false;
  physics::SettleOptions fine = options_of(o, false, false);
  fine.tolerance = o.settle.tolerance;
  physics::Cloth copy = cloth;
  const physics::SettleReport end = physics::settle(copy, body, fine, observer);
  const bool falls = end.touching == 0 && !end.stopped &&
                     std::all_of(copy.particles.x.begin(), copy.particles.x.end(),
                                 [&](const Vec3& x) { return body->at(x).value > far; });
  rest.stopped = end.stopped;
  if (falls) cloth = std::move(copy), rest = end;
  return falls;
}

}  // namespace

DrapeReport drape(geometry::Mesh& garment, physics::Cloth& cloth, const physics::Collider* body,
                  const DrapeOptions& asked, const MakeCloth& make_cloth, const DrapeObserver& go_on) {
  check(asked);
  DrapeOptions o = asked;
  DrapeReport report;
  Carried carried;
  const PlaceNoise noise(positions_of(garment), o.seed);
  DrapeWork* const work = o.work;
  if (work) work->levels.resize(std::size_t(o.refinements) + 1);
  for (int level = 0; level <= o.refinements; ++level) {
    if (level > 0) carried = {cloth.particles.x, refine(cloth.particles, garment)};
    const bool last = level == o.refinements;
    const std::vector<Vec3> places = positions_of(garment);
    geometry::Mesh made = garment;
    cloth = make_cloth(made);
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
    physics::SettleOptions settle = options_of(o, last, report.stopped);
    settle.work = work ? &work->levels[std::size_t(level)] : nullptr;
    if (last && o.bending_friction > 0 && !report.stopped) {
      const WornRest rest = give_way(cloth, body, o.bending_friction, settle, observer);
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
