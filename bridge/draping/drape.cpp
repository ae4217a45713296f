// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/drape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather.h"
#include "bridge/arrays/place_noise.h"
#include "bridge/draping/energy_parts.h"
#include "bridge/draping/level_start.h"
#include "bridge/draping/refine_where.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/preconditions.h"
#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"
#include "physics/base/require.h"
#include "physics/cloth/patch_membrane.h"
#include "physics/cloth/riders.h"
#include "physics/rest/give_way.h"
#include "physics/rest/settle.h"

namespace furrow::bridge {
namespace {

using physics::Vec3;

void check(const RefineWhere& where) {
  using physics::require;
  require("drape", "where.finest", where.finest, where.finest >= 0, ">= 0");
  require("drape", "where.bend", where.bend, where.bend > 0, "> 0");
  require("drape", "where.seen", where.seen, where.seen > 0, "> 0");
}

void check(const DrapeOptions& o) {
  if (o.where) check(*o.where);
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

/// Shared with other drapes whose levels have the same mesh.
physics::StiffnessWork* work_of(const DrapeOptions& o, int level) {
  return o.work && !o.where ? &o.work->levels[std::size_t(level)] : nullptr;
}

constexpr int most_soft_iterations = 50;
/// Where the cloth comes to rest, roughly, with triangles that are softer: a start for its own search.
physics::SettleReport settle_softly(physics::Cloth& cloth, const physics::Collider* body,
                                    const DrapeOptions& o, const physics::SettleObserver& observer) {
  physics::SettleOptions rough = o.settle;
  rough.tolerance = std::max(rough.tolerance, o.coarse_tolerance);
  rough.contact_depth = std::numeric_limits<double>::infinity();
  rough.faces = {};
  rough.work = work_of(o, 0);
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
/// all of it, or all that was not laid aside. As a rough rest may lie above what the cloth comes to lie on,
/// it looks for rest to the end; interrupted, it stays at the rough one.
bool falls_past(physics::Cloth& cloth, const physics::Collider* body, const DrapeOptions& o,
                const physics::SettleObserver& observer, physics::SettleReport& rest) {
  const std::vector<double>& inv_mass = cloth.particles.inv_mass;
  const auto held = std::count(inv_mass.begin(), inv_mass.end(), 0) - std::ssize(cloth.riders);
  const bool carried = held > 0 && (!o.held_aside || held == std::ssize(inv_mass) - std::ssize(cloth.riders));
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
  if (!end.stopped) cloth = std::move(copy), rest = end;
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

/// As the cloth lies.
geometry::Mesh lying(const Level& level) {
  geometry::Mesh mesh = level.made;
  for (const geometry::Vertex v : mesh.vertices()) mesh.point(v) = to_cgal(level.cloth.particles.x[v.idx()]);
  return mesh;
}

/// The meshes of a drape, coarse to fine.
class Meshes {
 public:
  Meshes(geometry::Mesh& garment, const DrapeOptions& o) : garment_(garment), o_(o) {
    if (!o.where) return;
    const physics::CancelScope way_up(cancels_way_up(o));
    local_.emplace(garment, o.refinements, *o.where);
    garment_ = local_->mesh();
  }
  const geometry::Mesh& mesh() const { return garment_; }

  /// The next finer mesh, unless the cloth asks for none; notes where its vertices lie, as the cloth does
  /// now.
  bool refine(const Level& below, bool stopped) {
    if (!local_) {
      carried_ = {below.cloth.particles.x, refine_level(below.cloth.particles.x, garment_, o_)};
      return true;
    }
    if (stopped) return false;
    const physics::CancelScope way_up(cancels_way_up(o_));
    const geometry::Mesh at_rest = lying(below);
    if (!local_->refine(at_rest)) return false;
    garment_ = local_->mesh();
    carried_ = local_->carry(at_rest, garment_);
    return true;
  }
  /// Where the cloth of the mesh begins.
  Carried carried(const physics::Cloth& cloth) const {
    Carried from = carried_;
    if (!local_ && !from.coarse.empty()) from.coarse = lay_on_coarse(from.coarse, cloth);
    if (local_)
      for (std::size_t i = 0; i < from.coarse.size(); ++i)
        if (!(cloth.particles.inv_mass[i] > 0)) from.coarse[i] = cloth.particles.x[i];
    return from;
  }
  void note(const Level& end, DrapeReport& report) const {
    if (!local_) return;
    report.uniform_vertices = local_->uniform_vertices();
    report.ran_out = local_->ran_out() || (!report.stopped && local_->out_of_cuts(lying(end)));
  }

 private:
  geometry::Mesh& garment_;
  const DrapeOptions& o_;
  std::optional<LocalLevels> local_;
  Carried carried_;
};

/// The level of a mesh, where it begins. Throws Cancelled if interrupted.
Level begin(const Meshes& meshes, double disturbance, const PlaceNoise& noise, const physics::Collider* body,
            const DrapeOptions& o, const MakeCloth& make_cloth) {
  Level level{meshes.mesh(), {}, positions_of(meshes.mesh()), {}, {}};
  level.cloth = make_on_way_up(make_cloth, level.made, o);
  const Carried carried = meshes.carried(level.cloth);
  level.drawn = level.cloth.particles.x;
  level.report.vertices = level.cloth.particles.size();
  DrapeOptions here = o;
  here.settle.self.drawn = level.drawn;
  begin_level(level.cloth, carried, {level.places, noise, disturbance}, body, here, level.report);
  physics::place_riders(level.cloth);
  const physics::CancelScope way_up(cancels_way_up(o));
  physics::throw_if_cancelled("drape");
  return level;
}

/// Looks for rest on a level: the first one with softer cloth before, if asked, the last one to the end.
/// Notes in the report whether it was stopped, or falls.
void come_to_rest(Level& now, int number, bool last, const physics::Collider* body, const DrapeOptions& asked,
                  const DrapeObserver& go_on, DrapeReport& report) {
  DrapeOptions o = asked;
  o.settle.self.drawn = now.drawn;
  const auto observer = [&](const physics::SettleProgress& progress) {
    return !go_on || report.stopped || go_on(number, progress, now.cloth);
  };
  if (number == 0 && o.soft_start > 1 && !o.plain && !now.cloth.membrane.empty()) {
    now.report.soft = settle_softly(now.cloth, body, o, observer);
    report.stopped = now.report.soft.stopped;
  }
  physics::SettleOptions settle = level_options(o, last, report.stopped);
  settle.work = work_of(o, number);
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
  Meshes meshes(garment, o);
  Level now;
  for (int level = 0; level <= o.refinements; ++level) {
    const double disturbance = std::ldexp(report.stopped ? 0 : o.disturbance * noise.diagonal(), -level);
    try {
      if (level > 0 && !meshes.refine(now, report.stopped)) {
        come_to_rest(now, o.refinements, true, body, o, go_on, report);
        report.levels.back() = now.report;
        if (!meshes.refine(now, report.stopped)) break;  // what a rough rest does not ask for, this one may
      }
      Level next = begin(meshes, disturbance, noise, body, o, make_cloth);
      come_to_rest(next, level, level == o.refinements, body, o, go_on, report);
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
  meshes.note(now, report);
  report.energy = energy_parts(now.cloth, o.settle.gravity, now.places);
  report.energy.contact = now.report.settle.contact_energy;
  garment = std::move(now.made);
  cloth = std::move(now.cloth);
  scatter(cloth.particles, garment);
  return report;
}

}  // namespace furrow::bridge
