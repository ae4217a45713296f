// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/keep_lines.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bridge/keep_shape.h"
#include "bridge/keep_trial.h"
#include "bridge/line_help.h"
#include "bridge/scatter.h"
#include "geometry/property_names.h"
#include "geometry/two_ring.h"

namespace furrow::bridge {
namespace {

using physics::Vec3;

constexpr double share_of_mode = 0.1;  // of an unstable motion's energy that makes it a line's
constexpr double out_of_balance = 1e-6;
constexpr double reserve = 0.4;  // of what a line may lose or win, where the shape is not stable

void check(const geometry::Mesh& mesh, const physics::Cloth& cloth, const physics::World& world,
           const KeepOptions& o) {
  const auto need = [](bool good, const char* what, double value) {
    if (!good)
      throw std::invalid_argument("keep_lines: " + std::string(what) + " = " + std::to_string(value));
  };
  need(mesh.number_of_vertices() == cloth.particles.size(), "particles for another mesh",
       double(cloth.particles.size()));
  need(o.seconds > 0, "seconds", o.seconds);
  need(o.gust >= 0 && std::isfinite(o.gust), "gust", o.gust);
  need(o.gust_seconds > 0, "gust_seconds", o.gust_seconds);
  need(o.calm_seconds > 0, "calm_seconds", o.calm_seconds);
  need(o.pushes >= 1, "pushes", o.pushes);
  need(o.push > 0 && std::isfinite(o.push), "push", o.push);
  need(o.kept > 0 && o.kept < 1, "kept", o.kept);
  need(o.largest_turn >= 0, "largest_turn", o.largest_turn);
  need(o.height_trials >= 0, "height_trials", o.height_trials);
  double last = 1;
  for (const double factor : o.presses)
    need(factor > last, "presses do not rise above 1", factor), last = factor;
  for (const double k : o.struts) need(k > 0, "struts", k);
  require_still(world);
}

class Keeper {
 public:
  Keeper(geometry::Mesh& mesh, physics::Cloth& cloth, const physics::World& world,
         const std::vector<double>& base, const KeepOptions& options,
         const std::function<bool(double)>& go_on)
      : mesh_(mesh), cloth_(cloth), world_(world), o_(options), go_on_(go_on), meter_(mesh, base) {
    o_.bounds.gravity = o_.run.gravity;
    o_.bounds.friction = o_.run.friction;
    o_.bounds.gap = o_.run.contact_gap;
    for (Vec3& v : cloth_.particles.v) v.setZero();
    start_ = cloth_;
    find_lines();
  }

  KeepReport run() {
    help_by_stiffness();
    if (!report_.interrupted && o_.height_trials > 0 && geometry::find_map(mesh_, geometry::kRestPosition))
      help_by_height();
    scatter(solved_.particles, mesh_);
    cloth_ = solved_;
    for (const HelpedLine& line : lines_) report_.lines.push_back(verdict(line));
    return report_;
  }

 private:
  void find_lines() {
    const auto id = geometry::find_map(mesh_, geometry::kLine);
    const std::vector<double> drawn = meter_.heights(start_.particles);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      std::vector<geometry::Vertex> vertices;
      for (const geometry::Vertex v : mesh_.vertices())
        if ((*id)[v] == meter_.lines()[i]) vertices.push_back(v);
      lines_.push_back({meter_.lines()[i], {}, drawn[i]});
      for (const geometry::Vertex v : geometry::two_ring(mesh_, vertices))
        lines_.back().patch.push_back(int(v));
    }
  }

  void solve() {
    solved_ = start_;
    place_lines(lines_, mesh_, start_.particles, solved_.particles);
    stiffen_lines(lines_, o_, solved_);
    KeptShape shape = keep_shape(solved_, world_, o_.bounds, o_.largest_turn);
    report_.rest = std::move(shape.rest);
    report_.certificate = std::move(shape.certificate);
    report_.turned = shape.turned;
    ++report_.trials;
    for (HelpedLine& line : lines_) line.kept = line.kept_gust = NAN;
  }

  void run_forward() {
    const bool stable = report_.certificate.stable();
    report_.runs += stable ? 1 : o_.pushes;
    const KeepTrial trial = try_shape(solved_, stable, world_, o_, meter_, go_on_);
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      lines_[i].kept = trial.kept[i];
      lines_[i].kept_gust = trial.kept_gust[i];
    }
    report_.drift = trial.drift;
    report_.interrupted = report_.interrupted || trial.stopped;
  }

  /// Lines with a good part in the motion that nothing holds back.
  std::vector<HelpedLine*> lines_of_mode() {
    std::vector<HelpedLine*> found;
    const auto& mode = report_.certificate.mode;
    if (report_.certificate.stable() || mode.empty()) return found;
    const auto& mass = solved_.particles.mass;
    double whole = 0;
    for (std::size_t i = 0; i < mode.size(); ++i) whole += mass[i] * mode[i].squaredNorm();
    for (HelpedLine& line : lines_) {
      double part = 0;
      for (const int i : line.patch) part += mass[i] * mode[i].squaredNorm();
      if (part > share_of_mode * whole) found.push_back(&line);
    }
    return found;
  }

  bool hangs_wrong() const {
    return report_.rest.residual > out_of_balance && !report_.rest.imbalance.empty();
  }

  bool is_bound(const HelpedLine& line) const {
    return report_.rest.residual > out_of_balance && on_bounds(line, report_.rest, solved_);
  }

  bool holds(const HelpedLine& line) const {
    // What is not stable ends elsewhere each time: a run is a sample, and the next one may be worse.
    const double most = (report_.certificate.stable() ? 1 : reserve) * (1 - o_.kept);
    return std::abs(line.kept - 1) <= most && std::abs(line.kept_gust - 1) <= most;
  }

  void help_by_stiffness() {
    for (;;) {
      solve();
      const auto with_room = [&](std::vector<HelpedLine*> weak) {
        std::erase_if(weak, [&](const HelpedLine* l) { return l->step == help_steps(o_); });
        return weak;
      };
      std::vector<HelpedLine*> weak = lines_of_mode();
      for (HelpedLine& line : lines_)
        if (is_bound(line) && std::find(weak.begin(), weak.end(), &line) == weak.end()) weak.push_back(&line);
      weak = with_room(weak);
      if (weak.empty()) {
        run_forward();
        for (HelpedLine& line : lines_)
          if (!holds(line)) weak.push_back(&line);
        weak = with_room(weak);
      }
      if (weak.empty() || report_.interrupted || hangs_wrong()) return;
      for (HelpedLine* line : weak) ++line->step;
    }
  }

  /// Bisects the heights of all lines that fail at once.
  void help_by_height() {
    std::vector<std::pair<HelpedLine*, double>> low;  // the greatest height that held
    for (HelpedLine& line : lines_)
      if (!holds(line) || is_bound(line)) low.push_back({&line, 0});
    if (low.empty() || hangs_wrong()) return;
    std::vector<double> high(low.size(), 1);
    for (int trial = 0; trial < o_.height_trials && !report_.interrupted; ++trial) {
      for (std::size_t i = 0; i < low.size(); ++i) low[i].first->height = (low[i].second + high[i]) / 2;
      solve();
      const std::vector<HelpedLine*> loose = lines_of_mode();
      run_forward();
      for (std::size_t i = 0; i < low.size(); ++i) {
        HelpedLine* line = low[i].first;
        const bool good =
            holds(*line) && !is_bound(*line) && std::find(loose.begin(), loose.end(), line) == loose.end();
        (good ? low[i].second : high[i]) = line->height;
      }
    }
    for (auto& [line, height] : low) line->height = height > 0 ? height : 1;
    solve();
    run_forward();
  }

  KeptLine verdict(const HelpedLine& line) {
    KeptLine v;
    v.line = line.id;
    v.press = press_of(line, o_);
    v.struts = struts_of(line, o_);
    v.lowered = line.height;
    v.height = line.height * line.drawn;
    v.kept = line.kept;
    v.kept_gust = line.kept_gust;
    const std::vector<HelpedLine*> loose = lines_of_mode();
    const bool of_mode =
        std::any_of(loose.begin(), loose.end(), [&](const HelpedLine* l) { return l->id == line.id; });
    if (!holds(line) || of_mode || is_bound(line) || hangs_wrong()) {
      v.reason = reason(of_mode, is_bound(line));
      return v;
    }
    v.verdict = line.height < 1 ? Verdict::lowered
                : v.struts > 0  ? Verdict::strutted
                : v.press > 1   ? Verdict::pressed
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
  KeepReport report_;
};

}  // namespace

KeepReport keep_lines(geometry::Mesh& mesh, physics::Cloth& cloth, const physics::World& world,
                      const std::vector<double>& base, const KeepOptions& options,
                      const std::function<bool(double)>& go_on) {
  check(mesh, cloth, world, options);
  return Keeper(mesh, cloth, world, base, options, go_on).run();
}

}  // namespace furrow::bridge
