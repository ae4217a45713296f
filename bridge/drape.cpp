// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/drape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "bridge/convert.h"
#include "bridge/gather.h"
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
  rough.max_iterations = std::min(rough.max_iterations, most_soft_iterations);
  const std::vector<physics::MembraneTriangle> own = cloth.membrane;
  for (physics::MembraneTriangle& t : cloth.membrane) {
    t.lambda /= o.soft_start;
    t.mu /= o.soft_start;
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

/// Puts a level's cloth where it begins: where it was carried, disturbed, and out of the body. Returns by how
/// much it was disturbed [m].
double begin_level(physics::Cloth& cloth, const Carried& carried, const physics::Collider* body,
                   const DrapeOptions& o, bool stopped, DrapeLevel& level) {
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
  const double disturbance = disturb(cloth, stopped ? 0 : o.disturbance);
  const double gap = o.settle.gap - (carried.fine.empty() ? 0 : rest_depth(o.settle.gap));
  if (body) level.pushed = physics::bring_out(p, *body, gap);
  if (o.settle.self.on) level.stopped = keep_apart(cloth, std::move(from), o.settle);
  return disturbance;
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
  for (int level = 0; level <= o.refinements; ++level) {
    if (level > 0) carried = {cloth.particles.x, refine(cloth.particles, garment)};
    const bool last = level == o.refinements;
    geometry::Mesh made = garment;
    cloth = make_cloth(made);
    const std::vector<Vec3> drawn = cloth.particles.x;
    o.settle.self.drawn = drawn;
    DrapeLevel& now = report.levels.emplace_back();
    now.vertices = cloth.particles.size();
    report.disturbance = begin_level(cloth, carried, body, o, report.stopped, now);
    const auto observer = [&](const physics::SettleProgress& progress) {
      return !go_on || report.stopped || go_on(level, progress, cloth);
    };
    if (level == 0 && o.soft_start > 1 && !o.plain && !cloth.membrane.empty()) {
      now.soft = settle_softly(cloth, body, o, observer);
      report.stopped = now.soft.stopped;
    }
    const physics::SettleOptions settle = options_of(o, last, report.stopped);
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
    garment = std::move(made);
    scatter(cloth.particles, garment);
    break;
  }
  return report;
}

}  // namespace furrow::bridge
