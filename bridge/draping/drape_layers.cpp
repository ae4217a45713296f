// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/drape_layers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather.h"
#include "bridge/draping/energy_parts.h"
#include "bridge/draping/level_start.h"
#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"
#include "physics/base/require.h"
#include "physics/cloth/join_cloths.h"
#include "physics/rest/settle.h"

namespace furrow::bridge {
namespace {

using physics::Vec3;
using Positions = std::vector<Vec3>;

void check_layers(std::span<const LayerGarment> garments, const DrapeOptions& o) {
  using physics::require;
  constexpr const char* me = "drape_layers";
  require(me, "garments", int(garments.size()), !garments.empty(), ">= 1");
  for (const LayerGarment& g : garments) require(me, "thickness", g.thickness, g.thickness >= 0, ">= 0");
  require(me, "refinements", o.refinements, o.refinements >= 0 && o.refinements <= 6, "in [0, 6]");
  require(me, "coarse_tolerance", o.coarse_tolerance, o.coarse_tolerance > 0, "> 0");
  require(me, "disturbance", o.disturbance, o.disturbance >= 0, ">= 0");
  require(me, "self.on", o.settle.self.on, o.settle.self.on, "true");
  require(me, "plain", o.plain, !o.plain, "false");
  require(me, "soft_start", o.soft_start, o.soft_start == 1, "1");
  require(me, "bending_friction", o.bending_friction, o.bending_friction == 0, "0");
}

void append(Positions& all, const Positions& more) { all.insert(all.end(), more.begin(), more.end()); }

Positions positions_of_all(std::span<const LayerGarment> garments) {
  Positions all;
  for (const LayerGarment& g : garments) append(all, positions_of(g.mesh));
  return all;
}

/// What the first level begins with.
struct Start {
  Positions places;  ///< of all particles, as they were given [m]
  const PlaceNoise& noise;
  double disturbance;  ///< [m]
  std::function<bool(const physics::SettleProgress&, const physics::Cloth&)> go_on;
};

/// What the level before ended with, on meshes that are refined by this.
struct Ended {
  std::vector<Positions> coarse;  ///< by garment
  Positions fine;
};

/// One level's cloths of all garments, and as one.
struct LevelCloth {
  std::vector<geometry::Mesh> made;
  physics::Cloth joined;
  Positions drawn;  ///< as they were made, each far from the others, where only its own may be near
  std::vector<double> thickness;  ///< by particle [m]
  std::vector<int> group;         ///< by particle: 0 what touches
  DrapeLevel report;
};

double thickness_of(const LayerGarment& garment, const DrapeOptions& o) {
  return garment.thickness > 0 ? garment.thickness : o.settle.self.thickness;
}

LevelCloth make_level(std::span<LayerGarment> garments, const DrapeOptions& o) {
  const physics::CancelScope way_up(cancels_way_up(o));
  LevelCloth level;
  std::vector<physics::Cloth> cloths;
  double shift = 0;
  for (LayerGarment& g : garments) {
    level.made.push_back(g.mesh);
    g.cloth = g.make_cloth(level.made.back());
    cloths.push_back(g.cloth);
    level.thickness.insert(level.thickness.end(), g.cloth.particles.size(), thickness_of(g, o));
    level.group.insert(level.group.end(), g.cloth.particles.size(), g.touches ? 0 : int(cloths.size()));
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();
    for (const Vec3& x : g.cloth.particles.x) low = low.cwiseMin(x), high = high.cwiseMax(x);
    shift += 1 - low.x();
    for (const Vec3& x : g.cloth.particles.x) level.drawn.push_back(x + Vec3(shift, 0, 0));
    shift += high.x();
  }
  level.joined = physics::join_cloths(cloths);
  return level;
}

void rest_alone(physics::Cloth& own, const physics::Collider* body, const DrapeOptions& o, const Start& start,
                DrapeLevel& told) {
  const physics::SettleReport rest = physics::settle(
      own, body, level_options(o, false, told.soft.stopped),
      [&](const physics::SettleProgress& p) { return told.soft.stopped || start.go_on(p, own); });
  told.soft.iterations += rest.iterations;
  told.soft.factorisations += rest.factorisations;
  told.soft.stopped = told.soft.stopped || rest.stopped;
}

/// Of all garments as one cloth; it refers to the level.
physics::SelfContact self_contact_of(const LevelCloth& level, const DrapeOptions& o) {
  physics::SelfContact self = o.settle.self;
  self.drawn = level.drawn;
  self.thicknesses = level.thickness;
  self.groups = level.group;
  return self;
}

/// Of all garments together.
void add_garment(const physics::ContourReport& now, physics::ContourReport& all) {
  all.at_start += now.at_start;
  all.left += now.left;
  all.rounds += now.rounds;
  all.farthest = std::max(all.farthest, now.farthest);
  all.lines.insert(all.lines.end(), now.lines.begin(), now.lines.end());
}

/// Puts each garment by itself where the level begins, as far from the body as those below it need. On the
/// first level it also comes near to where it rests: what is far from rest would have to find its way between
/// other cloth. Adds to `told`.
void begin_alone(std::span<LayerGarment> garments, const Ended& ended, const physics::Collider* body,
                 const DrapeOptions& asked, const Start& start, DrapeLevel& told) {
  std::ptrdiff_t first = 0;
  double below = 0;  // what the layers below take [m]
  for (std::size_t rank = 0; rank < garments.size(); ++rank) {
    physics::Cloth& own = garments[rank].cloth;
    const auto count = std::ptrdiff_t(own.particles.size());
    const auto part = [first, count](const Positions& all) {
      return Positions(all.begin() + first, all.begin() + first + count);
    };
    DrapeOptions o = asked;
    o.settle.self.thickness = thickness_of(garments[rank], asked);
    if (rank > 0) below += 0.5 * (thickness_of(garments[rank - 1], asked) + o.settle.self.thickness);
    o.settle.gap += below;
    const Positions drawn = own.particles.x, places = part(start.places);
    o.settle.self.drawn = drawn;
    Carried carried;
    if (!ended.coarse.empty()) carried = {lay_on_coarse(ended.coarse[rank], own), part(ended.fine)};
    DrapeLevel level;
    begin_level(own, carried, {places, start.noise, start.disturbance}, body, o, level);
    told.pushed.moved += level.pushed.moved;
    told.pushed.farthest = std::max(told.pushed.farthest, level.pushed.farthest);
    told.pushed.still_inside += level.pushed.still_inside;
    told.stopped += level.stopped;
    add_garment(level.untangled, told.untangled);
    if (ended.coarse.empty()) rest_alone(own, body, o, start, told);
    first += count;
  }
}

/// Puts the garments together, and takes them apart where they cross.
physics::UntangleReport part_layers(std::span<const LayerGarment> garments, physics::Cloth& joined,
                                    const physics::SelfContact& self) {
  physics::ClothLayers layers;
  Positions& x = joined.particles.x;
  x.clear();
  for (std::size_t rank = 0; rank < garments.size(); ++rank) {
    const LayerGarment& g = garments[rank];
    layers.turned.push_back(g.turned);
    layers.of_vertex.insert(layers.of_vertex.end(), g.cloth.particles.size(), int(rank));
    append(x, g.cloth.particles.x);
  }
  physics::PairMesh mesh = physics::pair_mesh(joined, self.thickness, self.thicknesses);
  mesh.group.assign(self.groups.begin(), self.groups.end());
  return physics::untangle_layers(x, mesh, layers);
}

/// Of all levels together: what crossed at the first, what is left on the last.
void add_untangled(const physics::UntangleReport& now, physics::UntangleReport& all) {
  if (all.rounds == 0 && all.at_start == 0) all.at_start = now.at_start;
  all.left = now.left;
  all.near = now.near;
  all.rounds += now.rounds;
  all.farthest = std::max(all.farthest, now.farthest);
}

/// Gives each garment its own part of what was found.
void share_out(std::span<LayerGarment> garments, const physics::Particles& found) {
  std::size_t first = 0;
  for (LayerGarment& g : garments) {
    physics::Particles& own = g.cloth.particles;
    const auto copy = [&](const Positions& all, Positions& part) {
      std::copy_n(all.begin() + std::ptrdiff_t(first), part.size(), part.begin());
    };
    copy(found.x, own.x);
    copy(found.v, own.v);
    first += own.size();
  }
}

Ended refine_all(std::span<LayerGarment> garments, const DrapeOptions& o) {
  Ended ended;
  for (LayerGarment& g : garments) {
    ended.coarse.push_back(g.cloth.particles.x);
    append(ended.fine, refine_level(ended.coarse.back(), g.mesh, o));
  }
  return ended;
}

void finish(std::span<LayerGarment> garments, std::vector<geometry::Mesh>& made, const Vec3& gravity) {
  for (std::size_t i = 0; i < garments.size(); ++i) {
    LayerGarment& g = garments[i];
    g.energy = energy_parts(g.cloth, gravity, positions_of(g.mesh));
    g.mesh = std::move(made[i]);
    scatter(g.cloth.particles, g.mesh);
  }
}

/// The first level, or the next one. Adds what crossed to `untangled`.
LevelCloth go_up(std::span<LayerGarment> garments, bool first, const Start& start,
                 const physics::Collider* body, const DrapeOptions& o, physics::UntangleReport& untangled) {
  const Ended ended = first ? Ended{} : refine_all(garments, o);
  Start here = start;
  here.places = positions_of_all(garments);
  LevelCloth now = make_level(garments, o);
  now.report.vertices = now.joined.particles.size();
  if (first && body)
    for (LayerGarment& g : garments)
      g.turned = looks_inwards({g.cloth.particles.x, g.cloth.triangles}, *body);
  begin_alone(garments, ended, body, o, here, now.report);
  add_untangled(part_layers(garments, now.joined, self_contact_of(now, o)), untangled);
  return now;
}

/// Of all garments as one cloth. Notes in the report whether it was stopped.
void come_to_rest(LevelCloth& now, int number, const physics::Collider* body, const DrapeOptions& asked,
                  const DrapeObserver& go_on, LayersReport& report) {
  report.stopped = report.stopped || now.report.soft.stopped;
  const auto observer = [&](const physics::SettleProgress& progress) {
    return !go_on || report.stopped || go_on(number, progress, now.joined);
  };
  DrapeOptions o = asked;
  o.settle.self = self_contact_of(now, asked);
  const physics::SettleOptions settle = level_options(o, number == o.refinements, report.stopped);
  now.report.settle = settle_level(now.joined, body, settle, o, observer);
  report.stopped = report.stopped || now.report.settle.stopped;
}

}  // namespace

bool looks_inwards(const physics::TriangleMesh& cloth, const physics::Collider& body) {
  double out = 0;
  for (const auto& t : cloth.triangles) {
    const Vec3 &a = cloth.vertices[std::size_t(t[0])], &b = cloth.vertices[std::size_t(t[1])],
               &c = cloth.vertices[std::size_t(t[2])];
    out += (b - a).eval().cross((c - a).eval()).dot(body.at((a + b + c) / 3).gradient);
  }
  return out < 0;
}

LayersReport drape_layers(std::span<LayerGarment> garments, const physics::Collider* body,
                          const DrapeOptions& o, const DrapeObserver& go_on) {
  check_layers(garments, o);
  LayersReport report;
  const PlaceNoise noise(positions_of_all(garments), o.seed);
  const auto alone = [&](const physics::SettleProgress& p, const physics::Cloth& cloth) {
    return !go_on || go_on(-1, p, cloth);
  };
  LevelCloth now;
  for (int level = 0; level <= o.refinements; ++level) {
    const double disturbance = std::ldexp(report.stopped ? 0 : o.disturbance * noise.diagonal(), -level);
    const std::vector<LayerGarment> below(garments.begin(), garments.end());
    try {
      LevelCloth next =
          go_up(garments, level == 0, {{}, noise, disturbance, alone}, body, o, report.untangled);
      come_to_rest(next, level, body, o, go_on, report);
      now = std::move(next);
    } catch (const physics::Cancelled&) {
      if (level == 0) throw;
      std::copy(below.begin(), below.end(), garments.begin());
      report.stopped = true;
      break;
    }
    report.disturbance = disturbance;
    report.levels.push_back(now.report);
    share_out(garments, now.joined.particles);
    if (report.stopped && cancels_way_up(o)()) break;
  }
  finish(garments, now.made, o.settle.gravity);
  report.contact_energy = now.report.settle.contact_energy;
  return report;
}

}  // namespace furrow::bridge
