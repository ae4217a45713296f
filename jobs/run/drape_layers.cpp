// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/run/drape_layers.h"

#include <algorithm>
#include <chrono>
#include <memory>

#include "bridge/drape_layers.h"
#include "geometry/mesh/property_names.h"
#include "jobs/check/seam_ties.h"
#include "jobs/read_inputs.h"
#include "jobs/run/drape_plan.h"
#include "jobs/run/fall_watch.h"
#include "jobs/run/garment_maker.h"
#include "jobs/run/loose_parts.h"
#include "jobs/run/measure_crossings.h"
#include "jobs/run/measure_layers.h"
#include "physics/base/cancel_scope.h"

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

  /// Until nothing falls that was not known to.
  void run(const ProgressScope& progress) {
    for (std::vector<int> falling = go(progress); !falling.empty(); falling = go(progress))
      for (const int v : falling) hold(v);
  }

  const bridge::DrapeOptions& drape_options() const { return options_; }

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
    return o;
  }

  std::vector<char> held() const {
    std::vector<char> all;
    for (const auto& maker : makers) all.insert(all.end(), maker->held().begin(), maker->held().end());
    return all;
  }

  void hold(int vertex) {
    for (std::size_t i = 0; i < given_.size(); ++i) {
      const int own = int(given_[i].file.mesh.number_of_vertices());
      if (vertex < own) return makers[i]->loose.push_back(vertex);
      vertex -= own;
    }
  }

  /// A vertex of each part that falls, which ended it.
  std::vector<int> go(const ProgressScope& progress) {
    std::vector<int> falling;
    bool none_held = true;
    for (const auto& maker : makers) none_held = none_held && maker->loose.empty();
    garments.clear();
    for (std::size_t i = 0; i < given_.size(); ++i)
      garments.push_back({.mesh = given_[i].file.mesh,
                          .make_cloth = std::ref(*makers[i]),
                          .thickness = thickness_of(given_[i].scene, settings_),
                          .touches = given_[i].scene.touch});
    WayToRest to_rest(options_.settle.tolerance);
    const auto observe = [&](int level, const physics::SettleProgress& p, const physics::Cloth& cloth) {
      if (level == 0 && none_held && settings_.loose != LooseUse::fall && p.iteration > 0 &&
          p.iteration % 5 == 0)
        falling = watch_->find(cloth, held());
      const double share = level < 0 ? 0 : (level + to_rest.share(p)) / (options_.refinements + 1);
      return progress(share) && falling.empty();
    };
    report = bridge::drape_layers(garments, body_ ? &body_->field : nullptr, options_, observe);
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
  d.parts = parts.list.size();
  const physics::SettleReport& last = d.report.levels.back().settle;
  const bool uncarried = last.touching == 0 && !given.scene.simulation.gravity.isZero();
  d.broken = uncarried && is_broken(last);
  d.falls = (uncarried && !d.broken) || maker.loose.size() == d.parts;
  if (!d.falls)
    for (const int seed : maker.loose)
      d.loose.push_back(name_of_part(given.file, parts, parts.of_vertex[std::size_t(seed)]));
  if (!d.loose.empty()) {
    d.loose_parts = loose_parts_of(given.file, maker.loose);
    carry_loose_parts(d.file.mesh, given.file.mesh, d.refinements, maker.loose);
  }
  measure_draped({given.scene, body, settings, given.file, search.drape_options()}, d);
  if (given.placed) d.placed = given.placed->report;
  return d;
}

}  // namespace

WornOver drape_worn_over(std::span<const io::Scene> scenes, std::span<const std::string> names,
                         const BodyCollider* body, const DrapeSettings& settings, bool choose,
                         const Context& context) {
  const std::vector<GivenGarment> given = read_all(scenes, body, settings, choose, context);
  const auto start = std::chrono::steady_clock::now();
  LayerSearch search(given, body, settings, context);
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
    layers.push_back({&given[i].file.mesh, nullptr, turned, given[i].scene.touch});
  }
  for (std::size_t i = 0; i < layers.size(); ++i) layers[i].now = &worn.garments[i].file.mesh;
  worn.layers.pairs = measure_layers(layers, worn.garments);
  return worn;
}

}  // namespace furrow::jobs
