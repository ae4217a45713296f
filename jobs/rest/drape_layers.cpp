// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/drape_layers.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "bridge/arrays/convert.h"
#include "bridge/draping/drape_layers.h"
#include "geometry/mesh/property_names.h"
#include "jobs/base/part_names.h"
#include "jobs/base/read_inputs.h"
#include "jobs/base/seam_ties.h"
#include "jobs/rest/drape_plan.h"
#include "jobs/rest/fall_watch.h"
#include "jobs/rest/garment_maker.h"
#include "jobs/rest/loose_parts.h"
#include "jobs/rest/measure_layers.h"
#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"

namespace furrow::jobs {
namespace {

/// Garments as they were given, all with the same number of refinements.
std::vector<GivenGarment> read_all(std::span<const io::Scene> scenes, const BodyCollider* body,
                                   const DrapeSettings& s, bool choose, const Context& context) {
  std::vector<GivenGarment> given;
  int levels = 0;
  bool has_rest = false;
  for (const io::Scene& scene : scenes) {
    given.push_back(read_given(scene, body, s, choose, context));
    levels = std::max(levels, given.back().scene.subdivide);
    has_rest = has_rest || geometry::find_map(given.back().file.mesh, geometry::attribute::rest_length);
  }
  if (choose && has_rest) levels = 0;
  for (GivenGarment& g : given) g.scene.subdivide = levels;
  return given;
}

/// A search for rest of all garments, from where they were given.
class LayerSearch {
 public:
  LayerSearch(std::span<const GivenGarment> given, const BodyCollider* body, const DrapeSettings& settings,
              const Context& context)
      : given_(given), body_(body), settings_(settings), options_(options(given, body, settings, context)) {
    for (const GivenGarment& g : given) {
      makers.push_back(std::make_unique<GarmentMaker>(g.scene, body, settings, g.file, context, g.places()));
      begun_.push_back(at_places(g.file.mesh, g.places()));
    }
    std::vector<const geometry::Mesh*> meshes;
    for (const geometry::Mesh& mesh : begun_) meshes.push_back(&mesh);
    watch_ = std::make_unique<FallWatch>(joined_mesh(meshes), body, options_.settle.gap);
  }

  /// Until nothing falls that was not known to. Cancelled before a try has a state, the one before it is what
  /// there is.
  void run(const ProgressScope& progress) {
    for (std::vector<int> falling = go(progress); !falling.empty();) {
      const std::vector<bridge::LayerGarment> fell = garments;
      const bridge::LayersReport of_fall = report;
      std::vector<std::unique_ptr<GarmentMaker>> before;
      for (const auto& maker : makers) before.push_back(std::make_unique<GarmentMaker>(*maker));
      for (const int v : falling) hold(v);
      try {
        falling = go(progress);
      } catch (const physics::Cancelled&) {
        garments = fell;
        report = of_fall;
        makers = std::move(before);
        report.stopped = true;
        return;
      }
    }
  }

  const bridge::DrapeOptions& drape_options() const { return options_; }
  /// The i-th garment where it begins.
  const geometry::Mesh& begun(std::size_t i) const { return begun_[i]; }

  std::vector<std::unique_ptr<GarmentMaker>> makers;
  std::vector<bridge::LayerGarment> garments;
  bridge::LayersReport report;

 private:
  static bridge::DrapeOptions options(std::span<const GivenGarment> given, const BodyCollider* body,
                                      const DrapeSettings& settings, const Context& context) {
    double gap = settings.gap.value_or(0);
    if (!(gap > 0))
      for (const GivenGarment& g : given) gap = std::max(gap, gap_of(g.scene, body, g.file.mesh, context));
    bridge::DrapeOptions o = drape_options_of(given[0].scene, settings, gap);
    hold_apart(o, settings);
    if (body) o.settle.faces = {&body->exact, body->field.report().tolerance};
    o.interrupted = [&context] { return context.listener.cancelled_by_user(); };
    return o;
  }

  /// What falls of all garments, joined on any level: of each, its vertices as it was given come first.
  std::vector<int> find_falling(const physics::Cloth& joined) const {
    std::vector<physics::Vec3> x;
    std::vector<char> held;
    auto first = joined.particles.x.begin();
    for (std::size_t i = 0; i < given_.size(); ++i) {
      const auto own = std::ptrdiff_t(begun_[i].number_of_vertices());
      const std::vector<char>& of_level = makers[i]->held();
      x.insert(x.end(), first, first + own);
      held.insert(held.end(), of_level.begin(), of_level.begin() + own);
      first += std::ptrdiff_t(of_level.size());
    }
    return watch_->find(x, held);
  }

  void hold(int vertex) {
    for (std::size_t i = 0; i < given_.size(); ++i) {
      const int own = int(given_[i].file.mesh->number_of_vertices());
      if (vertex < own) return makers[i]->loose.push_back(vertex);
      vertex -= own;
    }
  }

  /// A vertex of each part that falls, which ended it.
  std::vector<int> go(const ProgressScope& progress) {
    std::vector<int> falling;
    garments.clear();
    std::vector<std::unique_ptr<GarmentMaker>> below(given_.size());
    for (std::size_t i = 0; i < given_.size(); ++i)
      garments.push_back({.mesh = given_[i].file.mesh,
                          .make_cloth = keeping_below(makers[i], below[i]),
                          .thickness = thickness_of(given_[i].scene, settings_),
                          .touches = given_[i].scene.touch});
    WayToRest to_rest(options_.settle.tolerance);
    const auto observe = [&](int level, const physics::SettleProgress& p, const physics::Cloth& cloth) {
      if (level >= 0 && settings_.loose != LooseUse::fall && p.iteration > 0 && p.iteration % 5 == 0)
        falling = find_falling(cloth);
      const double share = level < 0 ? 0 : (level + to_rest.share(p)) / (options_.refinements + 1);
      return progress(share) && falling.empty();
    };
    report = bridge::drape_layers(garments, body_ ? &body_->field : nullptr, options_, observe);
    for (std::size_t i = 0; i < makers.size(); ++i) go_back_to(garments[i].mesh, makers[i], below[i]);
    return falling;
  }

  std::span<const GivenGarment> given_;
  const BodyCollider* body_;
  const DrapeSettings& settings_;
  bridge::DrapeOptions options_;
  std::vector<geometry::Mesh> begun_;  ///< the garments where they begin
  std::unique_ptr<FallWatch> watch_;
};

/// What became of one of them.
Draped draped_of(LayerSearch& search, std::size_t i, const GivenGarment& given, const BodyCollider* body,
                 const DrapeSettings& settings) {
  GarmentMaker& maker = *search.makers[i];
  Draped d;
  d.report.levels = search.report.levels;
  d.report.disturbance = search.report.disturbance;
  d.report.energy = search.garments[i].energy;
  d.report.stopped = search.report.stopped;
  d.refinements = int(d.report.levels.size()) - 1;
  if (!d.report.stopped) d.forces = maker.forces_on(search.garments[i].cloth);
  d.file = std::move(maker.made);
  d.file.mesh = std::move(search.garments[i].mesh);
  close_seam_ties(d.file.mesh);
  const geometry::Parts parts = geometry::find_parts(given.file.mesh);
  const physics::SettleReport& last = d.report.levels.back().settle;
  const bool uncarried = last.touching == 0 && !given.scene.simulation.gravity.isZero();
  const bool broken = uncarried && is_broken(last);
  d.end.finite = std::isfinite(last.residual) && !broken;
  d.end.parts = FallWatch(search.begun(i), body, 0)
                    .ends(given.file, search.garments[i].cloth.particles.x, maker.held(), maker.loose,
                          given.scene.simulation.gravity);
  if ((uncarried && !broken) || maker.loose.size() == parts.list.size())
    for (PartEnd& part : d.end.parts) part.lost = true;
  if (!d.end.falls())
    for (const int seed : maker.loose)
      d.loose.push_back(name_of_part(given.file, parts, parts.of_vertex[std::size_t(seed)]));
  if (!d.loose.empty()) {
    d.loose_parts = loose_parts_of(given.file, maker.loose);
  }
  const DrapePlan plan{given.scene, body, settings, given.file, search.drape_options()};
  if (d.loose.empty())
    measure_draped(plan, d);
  else
    carry_and_measure(plan, maker.loose, d);
  if (given.placed) d.placed = given.placed->report;
  return d;
}

/// As they begin.
void require_order_of(const LayerSearch& search, std::span<const std::string> names, const BodyCollider& body,
                      std::span<const GivenGarment> given, const Context& context) {
  std::vector<Layer> layers;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const geometry::Mesh& mesh = search.begun(i);
    const bool turned =
        bridge::looks_inwards({bridge::positions_of(mesh), bridge::triangles_of(mesh)}, body.field);
    layers.push_back({&mesh, nullptr, turned, given[i].scene.touch});
  }
  require_order(layers, names, context);
}

}  // namespace

WornOver drape_worn_over(std::span<const io::Scene> scenes, std::span<const std::string> names,
                         const BodyCollider* body, const DrapeSettings& settings, bool choose,
                         const Context& context) {
  const std::vector<GivenGarment> given = read_all(scenes, body, settings, choose, context);
  const auto start = std::chrono::steady_clock::now();
  LayerSearch search(given, body, settings, context);
  if (body) require_order_of(search, names, *body, given, context);
  const ProgressScope progress(context.listener, "draping");
  search.run(progress);
  const physics::CancelScope whole([] { return false; });  // one that was stopped is measured, too
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  WornOver worn;
  const physics::UntangleReport& untangled = search.report.untangled;
  worn.layers.edges_crossed = untangled.at_start;
  worn.layers.edges_left = untangled.left;
  worn.layers.untangle_rounds = untangled.rounds;
  worn.layers.moved_most = untangled.farthest;
  worn.layers.contact_energy = search.report.contact_energy;
  std::vector<Layer> layers;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const bool turned = search.garments[i].turned;
    worn.garments.push_back(draped_of(search, i, given[i], body, settings));
    worn.garments.back().seconds = seconds.count();
    worn.garments.back().name = names[i];
    if (turned) worn.layers.turned.push_back(names[i]);
    layers.push_back({&*given[i].file.mesh, nullptr, turned, given[i].scene.touch});
  }
  for (std::size_t i = 0; i < layers.size(); ++i) layers[i].now = &*worn.garments[i].file.mesh;
  if (std::any_of(worn.garments.begin(), worn.garments.end(), [](const Draped& d) { return !d.measured; }))
    return worn;
  worn.layers.pairs = measure_layers(layers, worn.garments);
  for (Draped& d : worn.garments) take_facts(d);
  return worn;
}

}  // namespace furrow::jobs
