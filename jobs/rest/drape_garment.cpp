// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/drape_garment.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include "geometry/refine/local_refinement.h"
#include "io/animation/animation_file.h"
#include "jobs/base/part_names.h"
#include "jobs/base/read_inputs.h"
#include "jobs/base/seam_ties.h"
#include "jobs/rest/drape_plan.h"
#include "jobs/rest/drape_starts.h"
#include "jobs/rest/fall_watch.h"
#include "jobs/rest/garment_maker.h"
#include "jobs/rest/loose_parts.h"
#include "jobs/rest/touch_garment.h"
#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"

namespace furrow::jobs {
namespace {

/// The way to rest, a frame an iteration of the finest level.
class WayRecorder {
 public:
  WayRecorder(const std::filesystem::path& path, int last_level, const Context& context)
      : path_(path), last_level_(last_level), context_(context) {}
  void observe(int level, const physics::Cloth& cloth) {
    if (path_.empty() || level < last_level_) return;
    if (!writer_) {
      geometry::Mesh mesh;
      for (const physics::Vec3& x : cloth.particles.x) mesh.add_vertex({x.x(), x.y(), x.z()});
      for (const auto& t : cloth.triangles)
        mesh.add_face(geometry::Vertex(t[0]), geometry::Vertex(t[1]), geometry::Vertex(t[2]));
      io::AnimationOptions options;
      options.frame = write_options(context_.frame);
      writer_ = std::make_unique<io::AnimationWriter>(path_, mesh, options);
    }
    writer_->add(cloth.particles.x);
  }
  /// Whether there is anything to see.
  bool close() {
    if (writer_) writer_->close();
    return writer_ != nullptr;
  }

 private:
  const std::filesystem::path& path_;
  int last_level_;
  const Context& context_;
  std::unique_ptr<io::AnimationWriter> writer_;
};

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A way to rest that was gone.
struct Gone {
  bridge::DrapeReport report;
  geometry::Mesh mesh;
  physics::Cloth cloth;
  std::vector<int> falling;  ///< a vertex of each part that fell, which ended it
};

/// Told how far one way is, in [0, 1]; returns whether to go on.
using Progress = std::function<bool(double)>;

/// watch: null: parts may fall.
Gone go(const DrapePlan& plan, std::unique_ptr<GarmentMaker>& maker, WayRecorder& way, const FallWatch* watch,
        const Progress& progress) {
  Gone gone;
  std::unique_ptr<GarmentMaker> below;
  WayToRest to_rest(plan.options.settle.tolerance);
  const auto observe = [&](int level, const physics::SettleProgress& p, const physics::Cloth& cloth) {
    way.observe(level, cloth);
    if (watch && p.iteration > 0 && p.iteration % 5 == 0)
      gone.falling = watch->find(cloth.particles.x, maker->held());
    return progress((level + to_rest.share(p)) / (plan.options.refinements + 1)) && gone.falling.empty();
  };
  bridge::DrapeOptions options = plan.options;
  options.held_aside = !maker->loose.empty() && plan.scene.pins.empty();
  gone.mesh = plan.as_read.mesh;
  gone.report = bridge::drape(gone.mesh, gone.cloth, plan.body ? &plan.body->field : nullptr, options,
                              keeping_below(maker, below), observe);
  go_back_to(gone.mesh, maker, below);
  if (watch && !gone.report.stopped) gone.falling = watch->find(gone.cloth.particles.x, maker->held());
  return gone;
}

/// Goes until nothing falls that was not known to: each time with what fell held aside. Where that would be
/// all, the garment falls, and goes its way to the end. Cancelled before a way has a state, the one before it
/// is what there is.
Gone go_with_parts(const DrapePlan& plan, std::unique_ptr<GarmentMaker>& maker,
                   std::optional<WayRecorder>& way, const FallWatch& watch, const Progress& progress,
                   const Context& context) {
  std::unique_ptr<GarmentMaker> maker_before;
  Gone gone;
  for (bool watches = plan.settings.loose != LooseUse::fall;;) {
    way.emplace(plan.settings.animation, plan.scene.subdivide, context);
    try {
      gone = go(plan, maker, *way, watches ? &watch : nullptr, progress);
    } catch (const physics::Cancelled&) {
      if (!maker_before) throw;
      maker = std::move(maker_before);
      gone.report.stopped = true;
      return gone;
    }
    if (gone.falling.empty()) return gone;
    maker_before = std::make_unique<GarmentMaker>(*maker);
    watches = maker->loose.size() + gone.falling.size() < watch.count();
    if (watches) maker->loose.insert(maker->loose.end(), gone.falling.begin(), gone.falling.end());
  }
}

void take_result(Gone gone, GarmentMaker& maker, const DrapePlan& plan, const FallWatch& watch,
                 Draped& draped) {
  draped.report = std::move(gone.report);
  draped.refinements =
      draped.report.local() ? plan.options.refinements : int(draped.report.levels.size()) - 1;
  if (!draped.report.stopped) draped.forces = maker.forces_on(gone.cloth);
  draped.file = std::move(maker.made);
  draped.file.mesh = std::move(gone.mesh);
  close_seam_ties(draped.file.mesh);
  const physics::SettleReport& last = draped.report.levels.back().settle;
  const bool uncarried = last.touching == 0 && !plan.scene.simulation.gravity.isZero() && !maker.any_held();
  draped.end.parts = watch.ends(plan.as_read, gone.cloth.particles.x, maker.held(), maker.loose,
                                plan.scene.simulation.gravity);
  draped.end.finite = std::isfinite(last.residual) && !(uncarried && is_broken(last));
  if (uncarried && draped.end.finite)
    for (PartEnd& part : draped.end.parts) part.lost = true;
  for (const int seed : maker.loose)
    draped.loose.push_back(
        name_of_part(plan.as_read, watch.parts(), watch.parts().of_vertex[std::size_t(seed)]));
}

/// What is asked for, and then the measures of what is left.
void finish_loose_parts(const DrapePlan& plan, const std::vector<int>& loose, Draped& draped) {
  if (loose.empty()) return measure_draped(plan, draped);
  draped.loose_parts = loose_parts_of(plan.as_read, loose);
  draped.loose_parts.use = plan.settings.loose;
  if (plan.settings.loose == LooseUse::hold) return carry_and_measure(plan, loose, draped);
  io::MeshFile kept = plan.as_read;
  drop_parts(kept, loose);
  drop_parts(draped.file, loose);
  geometry::drop_uniform_indices(draped.file.mesh);
  measure_draped({plan.scene, plan.body, plan.settings, kept, plan.options}, draped);
}

/// One way to rest. loose: a vertex of each part that nothing holds, where that is known; else it is found.
Draped drape_once(const DrapePlan& plan, const FallWatch& watch, std::vector<int>& loose,
                  const Progress& progress, const Context& context) {
  const double start = now();
  auto maker = std::make_unique<GarmentMaker>(plan.scene, plan.body, plan.settings, plan.as_read, context,
                                              plan.places);
  maker->loose = loose;
  Draped draped;
  std::optional<WayRecorder> way;
  Gone gone = go_with_parts(plan, maker, way, watch, progress, context);
  loose = maker->loose;
  const physics::CancelScope whole([] { return false; });  // what was reached is carried and measured, too
  take_result(std::move(gone), *maker, plan, watch, draped);
  draped.seconds = now() - start;
  draped.animated = way->close();
  way.reset();
  finish_loose_parts(plan, maker->loose, draped);
  return draped;
}

/// Searches for rest of one garment: with contact of cloth with cloth, without, or the better of both.
class GarmentSearch {
 public:
  GarmentSearch(DrapePlan plan, const FallWatch& watch) : plan_(std::move(plan)), watch_(watch) {}

  /// From the i-th start.
  Draped go(int i, const Progress& progress, const Context& context) {
    plan_.options.seed = std::uint64_t(i);
    const bool maybe = plan_.settings.self_contact == SelfContactUse::automatic && !plan_.settings.plain;
    if (!maybe) return once(plan_.settings.self_contact == SelfContactUse::on, progress, context);
    Draped with = once(true, progress, context);
    const auto& levels = with.report.levels;
    const bool acted = std::any_of(levels.begin(), levels.end(), [](const auto& l) { return l.acted(); });
    return with.report.stopped || with.succeeds() || !acted ? with : look_without(std::move(with), context);
  }

 private:
  Draped once(bool contact, const Progress& progress, const Context& context) {
    DrapePlan plan = plan_;
    if (contact) hold_apart(plan.options, plan.settings);
    return drape_once(plan, watch_, loose_[contact], progress, context);
  }

  /// Where contact of cloth with cloth leads to no success: the better end of that and of a search without;
  /// of equal ones the other. What was broken off on the way is no end.
  Draped look_without(Draped with, const Context& context) {
    SilentListener silent(context.listener);
    const Context quiet{context.frame, silent, context.memory};  // what was warned of is so still
    const ProgressScope progress(context.listener, "draping without contact of cloth with cloth");
    try {
      Draped without = once(false, std::ref(progress), quiet);
      with.report.stopped = without.report.stopped;
      const double seconds = with.seconds + without.seconds;
      const bool better = with.report.stopped || is_better(with.end, without.end, with.limits);
      if (better && !with.report.stopped && with.animated) with = once(true, std::ref(progress), quiet);
      Draped taken = better ? take(std::move(with), without) : take(std::move(without), with);
      taken.seconds = seconds;
      return taken;
    } catch (const physics::Cancelled&) {
      with.report.stopped = true;
      return with;
    }
  }

  static Draped take(Draped taken, const Draped& left) {
    const physics::SettleReport& last = left.report.levels.back().settle;
    DrapeOther other{left.self_contact, left.outcome(), left.crossings.pairs, 0,
                     last.residual,     left.seconds,   std::nullopt};
    for (const bridge::DrapeLevel& level : left.report.levels)
      other.iterations += level.soft.iterations + level.settle.iterations;
    if (last.self.blocked) other.blocked_at = last.self.blocked_at;
    if (left.self_contact) taken.untangled = left.untangled;
    taken.other = std::move(other);
    return taken;
  }

  DrapePlan plan_;  ///< without
  const FallWatch& watch_;
  std::vector<int> loose_[2];  ///< without and with contact: as the first start found
};

/// Goes on from the first start to all of them, and returns the best, with what all tell. start(i, context)
/// is the i-th. What is cancelled ends with the starts that there are.
template <class Start>
Draped choose_start(Draped best, int count, const Start& start, const Context& context) {
  SilentListener silent(context.listener);
  const Context quiet{context.frame, silent, context.memory};  // the first one warned
  DrapeStarts all{count, 0, {start_of(best, 0)}, {}};
  bool stopped = best.report.stopped;
  for (int i = 1; i < count && !stopped; ++i) try {
      Draped next = start(i, quiet);
      stopped = next.report.stopped;
      if (stopped) break;
      all.runs.push_back(start_of(next, std::uint64_t(i)));
      if (!is_better(all.runs.back(), all.runs[all.chosen])) continue;
      all.chosen = all.runs.size() - 1;
      best = std::move(next);
    } catch (const physics::Cancelled&) {
      stopped = true;
    }
  best.report.stopped = stopped;
  all.spread = spread_of(all.runs);
  best.seconds = 0;
  for (const DrapeStart& run : all.runs) best.seconds += run.seconds;
  best.starts = std::move(all);
  return best;
}

}  // namespace

Draped drape_garment(const io::Scene& asked, const BodyCollider* body, const DrapeSettings& s, bool choose,
                     const Context& context) {
  GivenGarment given = read_given(asked, body, s, choose, context);
  const io::Scene& scene = given.scene;
  const double gap = gap_in_use(scene, body, s, given.file.mesh, context);
  std::vector<TouchReport> touches = touch_garment(given, body, s, gap, context);
  DrapePlan plan{scene, body, s, given.file, drape_options_of(scene, s, gap), given.places()};
  plan.options.interrupted = [&context] { return context.listener.cancelled_by_user(); };
  plan.options.soft_start = soft_start_of(given.file, !scene.pins.empty());
  if (!seam_ties(given.file.mesh).empty()) plan.options.where.reset();
  if (body) plan.options.settle.faces = {&body->exact, body->field.report().tolerance};
  const FallWatch watch(at_places(given.file.mesh, given.places()), body, gap);
  const ProgressScope progress(context.listener, "draping");
  const int count = scene.starts;
  bridge::DrapeWork work;
  if (count > 1) plan.options.work = &work;
  GarmentSearch search(plan, watch);
  const auto start = [&](int i, const Context& told) {
    return search.go(
        i, [&](double share) { return progress((i + share) / count); }, told);
  };
  Draped draped = start(0, context);
  if (count > 1) draped = choose_start(std::move(draped), count, start, context);
  if (given.placed) draped.placed = given.placed->report;
  measure_remains(draped.file.mesh, touches);
  draped.touches = std::move(touches);
  geometry::drop_uniform_indices(draped.file.mesh);
  return draped;
}

}  // namespace furrow::jobs
