// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "bridge/arrays/gather.h"
#include "bridge/draping/standing_body.h"
#include "bridge/keeping/keep.h"
#include "bridge/keeping/keep_trial.h"
#include "bridge/keeping/keep_verdicts.h"
#include "bridge/keeping/line_help.h"
#include "bridge/keeping/try_statics.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "physics/base/progress.h"
#include "physics/cloth/check_cloth.h"
#include "physics/cloth/riders.h"
#include "physics/rest/settle.h"

namespace furrow::bridge {
namespace {

using physics::Vec3;

constexpr double share_of_search = 0.05;  // of a trial, as its progress is told
// A line that is off by so much is given two steps of help at once [-], as one is that had help before.
constexpr double far_off = 0.2;

/// What it took so far.
struct Tally {
  int trials = 0, runs = 0;
  int helped = 0;    ///< lines with more help than in the trial before
  double drift = 0;  ///< of any vertex in the last trial [m]
  bool interrupted = false;
};

/// Of one that is off by so much and may be by `most` [-].
char steps_more(double off, double most) {
  if (off <= most) return 0;
  return off > far_off ? 2 : 1;  // not a number: 1
}

bool any(const LineFlags& flags) {
  return std::any_of(flags.begin(), flags.end(), [](char flag) { return flag != 0; });
}

/// Goes from plan to plan; the members are what all of them have in common.
class Keeper {
 public:
  Keeper(const geometry::Mesh& mesh, const physics::Cloth& start, const physics::World& world,
         const KeepOptions& options, LineMeter& meter, const KeepObserver& go_on)
      : mesh_(mesh), start_(start), world_(world), o_(options), meter_(meter), go_on_(go_on) {}

  TriedPlan found_by(const KeepPlan& plan, Tally& tally) const {
    KeepOutcome outcome = solve(plan, tally);
    return {plan, std::move(outcome)};
  }

  /// More help for what needs it to rest, until nothing does or all is given; then motion tries it. What
  /// moves without a gust needs help again.
  TriedPlan help(KeepPlan plan, Tally& tally) const {
    for (std::optional<TriedPlan> last;;) {
      // Cancelled before there is any rest state, it comes out.
      std::optional<TriedPlan> solved = last ? try_solve(plan, tally) : found_by(plan, tally);
      if (!solved) return std::move(*last);
      TriedPlan& found = last.emplace(std::move(*solved));
      if (hangs_wrong(found.outcome)) return std::move(found);
      Steps weak = weak_by_certificate(found);
      const bool rest = rest_needs_help(found);
      if (!any(weak) && !rest) weak = weak_at_rest(found, tally);
      if (!any(weak) && !rest && !tally.interrupted) {
        if (failing(found) > 0) found = help_what_is_left(std::move(found), tally);
        if (!tally.interrupted) weak = weak_in_motion(found, tally);
      }
      if ((!any(weak) && !rest) || tally.interrupted) return std::move(found);
      plan = found.plan;
      // A line that gives way lets the next one go. All lines get help then, which saves trials.
      const bool one_by_one = tally.trials > 1 && fails_anew(weak, plan.lines);
      tally.helped = add_help(weak, one_by_one ? 1 : 0, o_, plan.lines);
      plan.rest_step += rest ? 1 : 0;
    }
  }

  /// For the report: trials need to know only whether there are any.
  void count_negative_eigenvalues(TriedPlan& found) const {
    if (found.outcome.shape.certificate.stable()) return;
    found.outcome.shape.certificate = certify_kept(found.outcome.cloth, world_, bounds(), true);
  }

 private:
  /// Nothing, and that is noted, if it was broken off.
  std::optional<TriedPlan> try_solve(const KeepPlan& plan, Tally& tally) const try {
    return found_by(plan, tally);
  } catch (const physics::Cancelled&) {
    tally.interrupted = true;
    return std::nullopt;
  }

  physics::PrestressOptions bounds() const {
    physics::PrestressOptions bounds = o_.bounds;
    bounds.work = &exact_work_;
    return bounds;
  }

  KeepOutcome solve(const KeepPlan& plan, Tally& tally) const {
    const std::vector<double> unknown(plan.lines.size(), NAN);
    KeepOutcome outcome{.cloth = start_,
                        .shape = {},
                        .rest_press = plan.rest_step > 0 ? o_.presses[plan.rest_step - 1] : 1,
                        .kept = unknown,
                        .kept_gust = unknown};
    place_lines(plan.lines, mesh_, start_.particles, outcome.cloth.particles);
    stiffen_lines(plan.lines, o_, outcome.rest_press, outcome.cloth);
    outcome.shape = keep_shape(outcome.cloth, world_, bounds(), o_.largest_turn, false);
    ++tally.trials;
    return outcome;
  }

  /// A step for each line that gives way without effort, or that the rest state's bounds leave no balance.
  Steps weak_by_certificate(const TriedPlan& found) const {
    Steps weak = loose_lines(found);
    for (std::size_t i = 0; i < weak.size(); ++i)
      weak[i] =
          can_be_helped(found.plan.lines[i]) && (weak[i] || is_bound(found.plan.lines[i], found.outcome));
    return weak;
  }

  /// Notes what the lines keep at rest, as a search finds it; steps of help for those that do not hold there.
  Steps weak_at_rest(TriedPlan& found, Tally& tally) const {
    if (found.plan.lines.empty()) return {};  // all were refused
    const StaticTrial trial =
        try_statics(found.outcome.cloth, world_, o_, meter_, search_work_, [&] { return go_on(0, tally); });
    tally.drift = trial.drift;
    tally.interrupted = tally.interrupted || trial.stopped;
    found.outcome.kept = trial.kept;
    return weak_lines(found);
  }

  /// Notes what the lines keep in motion, without gusts and after them; steps of help for those that gave way
  /// without.
  Steps weak_in_motion(TriedPlan& found, Tally& tally) const {
    if (found.plan.lines.empty()) return {};
    const bool stable = found.outcome.shape.certificate.stable();
    tally.runs += stable ? 1 : o_.pushes;
    Steps early(found.plan.lines.size(), 0);
    const auto in_vain = [&](const std::vector<double>& kept) {
      for (std::size_t i = 0; i < early.size(); ++i)
        early[i] = can_be_helped(found.plan.lines[i]) ? steps_more(std::abs(kept[i] - 1), 2 * (1 - o_.kept))
                                                      : char(0);
      return any(early);
    };
    KeepTrial trial = try_shape(found.outcome.cloth, stable, world_, o_, meter_, in_vain, [&](double share) {
      return go_on(share_of_search + (1 - share_of_search) * share, tally);
    });
    found.outcome.kept = std::move(trial.kept);
    found.outcome.kept_gust = std::move(trial.kept_gust);
    found.outcome.blown = o_.gust > 0;
    tally.drift = trial.drift;
    tally.interrupted = tally.interrupted || trial.stopped;
    return any(early) ? early : weak_lines(found);
  }

  /// Of those that may be helped and do not hold without gusts.
  Steps weak_lines(const TriedPlan& found) const {
    Steps weak(found.plan.lines.size(), 0);
    for (std::size_t i = 0; i < weak.size(); ++i)
      if (can_be_helped(found.plan.lines[i]))
        weak[i] = steps_more(std::abs(found.outcome.kept[i] - 1), may_lose(found.outcome, o_.kept));
    return weak;
  }

  /// Where stiffness alone does not hold all lines: all help for all of them, then lower heights.
  TriedPlan help_what_is_left(TriedPlan found, Tally& tally) const {
    found = help_all(std::move(found), tally);
    const bool has_base = geometry::find_map(mesh_, geometry::attribute::rest_position).has_value();
    if (tally.interrupted || o_.height_trials == 0 || !has_base || failing(found) == 0) return found;
    return help_by_height(std::move(found), tally);
  }

  /// Gives all help to all lines, since a neighbour that holds by itself can let a line go. The help stays if
  /// more lines hold.
  TriedPlan help_all(TriedPlan least, Tally& tally) const {
    const auto is_helped = [&](const HelpedLine& line) { return !can_be_helped(line); };
    if (std::all_of(least.plan.lines.begin(), least.plan.lines.end(), is_helped)) return least;
    const double drift = tally.drift;
    KeepPlan plan = least.plan;
    for (HelpedLine& line : plan.lines) line.step = help_steps(o_);
    tally.helped = int(plan.lines.size());
    std::optional<TriedPlan> most = try_at_rest(plan, tally);
    if (!most) return least;
    if (tally.interrupted || failing(*most) < failing(least)) return std::move(*most);
    tally.drift = drift;
    return least;
  }

  /// Bisects the heights of all lines at once that fail at rest.
  TriedPlan help_by_height(TriedPlan found, Tally& tally) const {
    const LineFlags good = lines_at_rest(found, o_.kept);
    std::vector<std::size_t> lines;
    for (std::size_t i = 0; i < good.size(); ++i)
      if (!good[i]) lines.push_back(i);
    tally.helped = int(lines.size());
    const double drift = tally.drift;
    KeepPlan plan = found.plan;
    std::vector<double> low(lines.size(), 0), high(lines.size(), 1);  // low: the greatest that held
    for (int trial = 0; trial < o_.height_trials && !tally.interrupted; ++trial) {
      for (std::size_t i = 0; i < lines.size(); ++i) plan.lines[lines[i]].height = (low[i] + high[i]) / 2;
      const std::optional<TriedPlan> tried = try_at_rest(plan, tally);
      if (!tried) return found;
      const LineFlags now = lines_at_rest(*tried, o_.kept);
      for (std::size_t i = 0; i < lines.size(); ++i)
        (now[lines[i]] ? low[i] : high[i]) = plan.lines[lines[i]].height;
    }
    if (tally.interrupted) return found;
    if (std::all_of(low.begin(), low.end(), [](double height) { return height == 0; })) {
      tally.drift = drift;  // nothing lower holds: what was found stands
      return found;
    }
    for (std::size_t i = 0; i < lines.size(); ++i) plan.lines[lines[i]].height = low[i] > 0 ? low[i] : 1;
    return try_at_rest(plan, tally).value_or(std::move(found));
  }

  std::optional<TriedPlan> try_at_rest(const KeepPlan& plan, Tally& tally) const {
    std::optional<TriedPlan> found = try_solve(plan, tally);
    if (found) weak_at_rest(*found, tally);
    return found;
  }

  bool go_on(double share, const Tally& tally) const {
    return !go_on_ || go_on_({tally.trials, tally.helped, share});
  }

  bool can_be_helped(const HelpedLine& line) const { return line.step < help_steps(o_); }

  bool rest_needs_help(const TriedPlan& found) const {
    return o_.whole && found.plan.rest_step < o_.presses.size() && rest_is_loose(found);
  }

  std::size_t failing(const TriedPlan& found) const {
    const LineFlags good = lines_at_rest(found, o_.kept);
    return std::size_t(std::count(good.begin(), good.end(), 0));
  }

  const geometry::Mesh& mesh_;
  const physics::Cloth& start_;
  const physics::World& world_;
  const KeepOptions& o_;
  LineMeter& meter_;
  const KeepObserver& go_on_;
  mutable physics::StiffnessWork exact_work_, search_work_;  // of all trials; they change no bit
};

KeepReport report_of(TriedPlan& found, const KeepOptions& o, LineMeter& meter,
                     const std::vector<LineMeter::TooLow>& low, const Tally& tally) {
  KeepReport report;
  report.lines = verdicts(found, meter.heights(found.outcome.cloth.particles), o, tally.interrupted);
  for (const int id : meter.unmeasured()) report.lines.push_back(unmeasured_line(id));
  for (const LineMeter::TooLow& line : low) report.lines.push_back(too_low_line(line, o));
  std::sort(report.lines.begin(), report.lines.end(),
            [](const KeptLine& a, const KeptLine& b) { return a.line < b.line; });
  report.rest = std::move(found.outcome.shape.rest);
  report.certificate = std::move(found.outcome.shape.certificate);
  report.rest_press = found.outcome.rest_press;
  report.turned = found.outcome.shape.turned;
  report.trials = tally.trials;
  report.runs = tally.runs;
  report.drift = tally.drift;
  report.interrupted = tally.interrupted;
  return report;
}

}  // namespace

KeepReport keep_lines(geometry::Mesh& mesh, physics::Cloth& cloth, const physics::World& world,
                      const std::vector<double>& base, const KeepOptions& options,
                      const KeepObserver& go_on) {
  if (mesh.number_of_vertices() != cloth.particles.size())
    throw std::invalid_argument("keep_lines: particles for another mesh = " +
                                std::to_string(cloth.particles.size()));
  require_legal(options);
  require_still(world);
  geometry::check_mesh(mesh, "keep_lines");
  physics::check_cloth(cloth, "keep_lines");
  KeepOptions o = options;
  o.bounds.gravity = o.run.gravity;
  o.bounds.friction = o.run.friction;
  o.bounds.gap = o.run.contact_gap;
  LineMeter meter(mesh, base, o.line_widths, o.flat_lines);
  physics::Cloth start = cloth;
  for (Vec3& v : start.particles.v) v.setZero();
  physics::PushOutReport pushed;
  if (const auto body = standing_body(world))
    pushed = physics::bring_out(start.particles, *body, o.run.contact_gap);

  const std::vector<LineMeter::TooLow> low = meter.leave_out_low(start.particles, o.least_height);

  const Keeper keeper(mesh, start, world, o, meter, go_on);
  Tally tally;
  TriedPlan found = keeper.help({helped_lines(mesh, start.particles, meter, o)}, tally);
  if (!tally.interrupted) keeper.count_negative_eigenvalues(found);

  physics::place_riders(found.outcome.cloth);
  scatter(found.outcome.cloth.particles, mesh);
  KeepReport report = report_of(found, o, meter, low, tally);
  report.pushed_out = pushed.moved;
  report.farthest_push = pushed.farthest;
  cloth = std::move(found.outcome.cloth);
  return report;
}

}  // namespace furrow::bridge
