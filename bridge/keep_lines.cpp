// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/keep_lines.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bridge/keep_shape.h"
#include "bridge/keep_trial.h"
#include "bridge/line_help.h"
#include "bridge/scatter.h"
#include "geometry/fold/line_region.h"
#include "geometry/mesh/property_names.h"

namespace furrow::bridge {
namespace {

using physics::Vec3;

constexpr double share_of_mode = 0.1;  // of an unstable motion's energy that makes it a line's
constexpr double out_of_balance = 1e-6;
constexpr double reserve = 0.4;  // of what a line may lose or win, where the shape is not stable

class Keeper {
 public:
  Keeper(geometry::Mesh& mesh, physics::Cloth& cloth, const physics::World& world,
         const std::vector<double>& base, const KeepOptions& options,
         const std::function<bool(double)>& go_on)
      : mesh_(mesh),
        cloth_(cloth),
        world_(world),
        o_(options),
        go_on_(go_on),
        meter_(mesh, base, options.line_widths) {
    o_.bounds.gravity = o_.run.gravity;
    o_.bounds.friction = o_.run.friction;
    o_.bounds.gap = o_.run.contact_gap;
    start_ = cloth_;
    for (Vec3& v : start_.particles.v) v.setZero();
    const physics::PushOutReport pushed = bring_out(start_, world, o_.run.contact_gap);
    report_.pushed_out = pushed.moved;
    report_.farthest_push = pushed.farthest;
    find_lines();
  }

  KeepReport run() {
    help_by_stiffness();
    if (!report_.interrupted) help_all();
    if (!report_.interrupted && o_.height_trials > 0 &&
        geometry::find_map(mesh_, geometry::attribute::rest_position))
      help_by_height();
    scatter(solved_.particles, mesh_);
    cloth_ = solved_;
    for (const HelpedLine& line : lines_) report_.lines.push_back(verdict(line));
    for (const int id : meter_.unmeasured()) {
      KeptLine line;
      line.line = id;
      line.height = line.kept = line.kept_gust = NAN;
      line.reason =
          "its height cannot be measured: its fold leaves too little cloth around it, or runs along a border";
      report_.lines.push_back(line);
    }
    std::sort(report_.lines.begin(), report_.lines.end(),
              [](const KeptLine& a, const KeptLine& b) { return a.line < b.line; });
    return report_;
  }

 private:
  void find_lines() {
    const auto id = geometry::find_map(mesh_, geometry::attribute::line);
    const std::vector<double> drawn = meter_.heights(start_.particles),
                              lengths = geometry::lengths_before_lines(mesh_);
    const auto of_line = [](const std::vector<double>& list, int line, double missing) {
      return std::size_t(line) < list.size() ? list[line] : missing;
    };
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      std::vector<geometry::Vertex> vertices;
      for (const geometry::Vertex v : mesh_.vertices())
        if ((*id)[v] == meter_.lines()[i]) vertices.push_back(v);
      HelpedLine line{meter_.lines()[i], {}, drawn[i]};
      line.press = of_line(o_.line_presses, line.id, 1);
      const double width = of_line(o_.line_widths, line.id, NAN);
      line.width = width > 0 ? width : 0;
      for (const geometry::Vertex v : geometry::line_region(mesh_, vertices, width, lengths))
        line.patch.push_back(int(v));
      lines_.push_back(std::move(line));
    }
  }

  void solve() {
    solved_ = start_;
    place_lines(lines_, mesh_, start_.particles, solved_.particles);
    report_.rest_press = rest_step_ > 0 ? o_.presses[rest_step_ - 1] : 1;
    stiffen_lines(lines_, o_, report_.rest_press, solved_);
    KeptShape shape = keep_shape(solved_, world_, o_.bounds, o_.largest_turn);
    report_.rest = std::move(shape.rest);
    report_.certificate = std::move(shape.certificate);
    report_.turned = shape.turned;
    ++report_.trials;
    for (HelpedLine& line : lines_) line.kept = line.kept_gust = NAN;
  }

  /// The lines that may be helped and do not hold; with `may_end` the run ends early if one is far from it.
  std::vector<HelpedLine*> run_forward(bool may_end) {
    const bool stable = report_.certificate.stable();
    report_.runs += stable ? 1 : o_.pushes;
    const auto lost = [&](std::size_t i, double kept) {
      return lines_[i].step < help_steps(o_) && std::abs(kept - 1) > 2 * (1 - o_.kept);
    };
    std::vector<HelpedLine*> weak;
    const auto in_vain = [&](const std::vector<double>& kept) {
      for (std::size_t i = 0; may_end && i < lines_.size(); ++i)
        if (lost(i, kept[i])) weak.push_back(&lines_[i]);
      return !weak.empty();
    };
    const KeepTrial trial = try_shape(solved_, stable, world_, o_, meter_, in_vain, go_on_);
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      lines_[i].kept = trial.kept[i];
      lines_[i].kept_gust = trial.kept_gust[i];
    }
    report_.drift = trial.drift;
    report_.interrupted = report_.interrupted || trial.stopped;
    if (!weak.empty()) return weak;
    for (HelpedLine& line : lines_)
      if (line.step < help_steps(o_) && !holds(line)) weak.push_back(&line);
    return weak;
  }

  /// Shares in the motion that nothing holds back; none if there is no such motion.
  std::vector<double> loose_shares() const {
    if (report_.certificate.stable()) return std::vector<double>(lines_.size() + 1, 0.0);
    return shares_of(lines_, solved_.particles, report_.certificate.mode);
  }

  /// Lines with a good part in it.
  std::vector<HelpedLine*> lines_of_mode() {
    std::vector<HelpedLine*> found;
    const std::vector<double> shares = loose_shares();
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (shares[i] > share_of_mode) found.push_back(&lines_[i]);
    return found;
  }

  bool hangs_wrong() const {
    return report_.rest.residual > out_of_balance && !report_.rest.imbalance.empty();
  }

  bool is_bound(const HelpedLine& line) const {
    return report_.rest.residual > out_of_balance && on_bounds(line, report_.rest, solved_);
  }

  bool rest_needs_help() const {
    return o_.whole && rest_step_ < o_.presses.size() && loose_shares().back() > share_of_mode;
  }

  bool holds(const HelpedLine& line) const {
    // An unstable shape ends elsewhere each time: a run is a sample, and the next one may be worse.
    const double most = (report_.certificate.stable() ? 1 : reserve) * (1 - o_.kept);
    return std::abs(line.kept - 1) <= most && std::abs(line.kept_gust - 1) <= most;
  }

  bool good(const HelpedLine& line, const std::vector<HelpedLine*>& loose) const {
    return holds(line) && !is_bound(line) && !hangs_wrong() &&
           std::none_of(loose.begin(), loose.end(), [&](const HelpedLine* l) { return l->id == line.id; });
  }

  void help_by_stiffness() {
    for (;;) {
      solve();
      std::vector<HelpedLine*> weak = lines_of_mode();
      for (HelpedLine& line : lines_)
        if (is_bound(line) && std::find(weak.begin(), weak.end(), &line) == weak.end()) weak.push_back(&line);
      std::erase_if(weak, [&](const HelpedLine* l) { return l->step == help_steps(o_); });
      const bool rest = rest_needs_help();
      if (weak.empty() && !rest) weak = run_forward(true);
      if ((weak.empty() && !rest) || report_.interrupted || hangs_wrong()) return;
      for (HelpedLine* line : weak) ++line->step;
      rest_step_ += rest ? 1 : 0;
    }
  }

  std::size_t failing() {
    const std::vector<HelpedLine*> loose = lines_of_mode();
    return std::count_if(lines_.begin(), lines_.end(), [&](const auto& line) { return !good(line, loose); });
  }

  /// Gives all help to all lines, since a neighbour that holds by itself can let a line go. The help stays if
  /// more lines hold.
  void help_all() {
    const std::size_t before = failing();
    if (before == 0 || hangs_wrong()) return;
    if (std::all_of(lines_.begin(), lines_.end(), [&](const auto& l) { return l.step == help_steps(o_); }))
      return;
    const std::vector<HelpedLine> least = lines_;
    const KeepReport of_least = report_;
    const physics::Cloth solved = solved_;
    for (HelpedLine& line : lines_) line.step = help_steps(o_);
    solve();
    run_forward(false);
    if (report_.interrupted || failing() < before) return;
    KeepReport counted = of_least;
    counted.trials = report_.trials, counted.runs = report_.runs;
    lines_ = least, report_ = counted, solved_ = solved;
  }

  /// Bisects the heights of all lines that fail at once.
  void help_by_height() {
    std::vector<std::pair<HelpedLine*, double>> low;  // the greatest height that held
    const std::vector<HelpedLine*> loose_now = lines_of_mode();
    for (HelpedLine& line : lines_)
      if (!good(line, loose_now)) low.push_back({&line, 0});
    if (low.empty() || hangs_wrong()) return;
    std::vector<double> high(low.size(), 1);
    for (int trial = 0; trial < o_.height_trials && !report_.interrupted; ++trial) {
      for (std::size_t i = 0; i < low.size(); ++i) low[i].first->height = (low[i].second + high[i]) / 2;
      solve();
      const std::vector<HelpedLine*> loose = lines_of_mode();
      run_forward(false);
      for (std::size_t i = 0; i < low.size(); ++i) {
        HelpedLine* line = low[i].first;
        (good(*line, loose) ? low[i].second : high[i]) = line->height;
      }
    }
    for (auto& [line, height] : low) line->height = height > 0 ? height : 1;
    solve();
    run_forward(false);
  }

  KeptLine verdict(const HelpedLine& line) {
    KeptLine v;
    v.line = line.id;
    v.press = line.press * press_of(line, o_);
    v.struts = struts_of(line, o_);
    v.lowered = line.height;
    v.height = line.height * line.drawn;
    v.kept = line.kept;
    v.kept_gust = line.kept_gust;
    const std::vector<HelpedLine*> loose = lines_of_mode();
    if (!good(line, loose)) {
      const bool of_mode =
          std::any_of(loose.begin(), loose.end(), [&](const HelpedLine* l) { return l->id == line.id; });
      v.reason = reason(of_mode, is_bound(line));
      return v;
    }
    v.verdict = line.height < 1 ? Verdict::lowered
                : v.struts > 0  ? Verdict::strutted
                : line.step > 0 ? Verdict::pressed
                                : Verdict::held;
    return v;
  }

  std::string reason(bool of_mode, bool bound) const {
    if (report_.interrupted) return "interrupted";
    if (hangs_wrong()) return "nothing holds the garment in balance as it lies; see imbalance";
    if (bound) return "the bounds on strain and angle leave no balance";
    if (of_mode) return "the fold can give way without effort: the cloth bends too easily for it";
    return "the fold goes over into another shape";
  }

  geometry::Mesh& mesh_;
  physics::Cloth& cloth_;
  const physics::World& world_;
  KeepOptions o_;
  const std::function<bool(double)>& go_on_;
  LineMeter meter_;
  physics::Cloth start_, solved_;
  std::vector<HelpedLine> lines_;
  std::size_t rest_step_ = 0;  // of presses, on what lies in no line's patch
  KeepReport report_;
};

}  // namespace

KeepReport keep_lines(geometry::Mesh& mesh, physics::Cloth& cloth, const physics::World& world,
                      const std::vector<double>& base, const KeepOptions& options,
                      const std::function<bool(double)>& go_on) {
  if (mesh.number_of_vertices() != cloth.particles.size())
    throw std::invalid_argument("keep_lines: particles for another mesh = " +
                                std::to_string(cloth.particles.size()));
  require_legal(options);
  require_still(world);
  return Keeper(mesh, cloth, world, base, options, go_on).run();
}

}  // namespace furrow::bridge
