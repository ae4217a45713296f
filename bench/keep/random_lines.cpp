// SPDX-License-Identifier: GPL-3.0-or-later
// How far the verdicts of bridge::keep_lines can be trusted: 200 lines at random on 80 coarse garments. A
// line that is called held must keep 95 to 105 % of the told height in another run than the verdict's own,
// and after gusts to four sides; for one that cannot hold all help is tried that there is.
// random_lines [CSV [threads [first [end [word ...]]]]]. Words: plate, their bending is one; leapfrog, runs
// of a verdict by leapfrog; ornate, lines over the hem, half circles and rings; quick, what "cannot hold" is
// not tried harder.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "bridge/arrays/gather.h"
#include "bridge/keeping/keep_trial.h"
#include "bridge/keeping/line_help.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/two_ring.h"
#include "physics/cloth/struts.h"
#include "physics/plate/press.h"
#include "physics/rest/rigid_imbalance.h"
#include "tests/cases/random_garments.h"

namespace furrow::bench {
namespace {

using bridge::KeptLine;
using bridge::Verdict;
using cases::RandomGarment;

constexpr double most = 0.05;  // a line may lose or win [-]
constexpr const char* names[] = {"held",     "press",       "struts",   "lowered",
                                 "may hold", "cannot hold", "not known"};

struct Help {
  double press = 0, struts = 0, height = 0;
  bool alone = false;  ///< no other line has it
  double kept = NAN, kept_gust = NAN;
};
struct Row {
  KeptLine line;
  double check = NAN;  ///< share of the told height that the other run kept [-]
  double blown = NAN;  ///< the same after gusts to four sides [-]
  Help help;           ///< with which a line that "cannot hold" does
};
struct Judged {
  RandomGarment garment;
  std::vector<Row> rows;
};

/// At whatever height.
bool stands(Verdict verdict) { return verdict < Verdict::may_hold; }

bool keeps(double share) { return std::abs(share - 1) <= most; }

/// A garment with this help for one line (-1: for all), in balance.
struct Helped {
  RandomGarment garment;
  physics::Cloth cloth;
  double residual = 0;
};
Helped helped(const RandomGarment& g, const Help& help, int only, const bridge::KeepOptions& o) {
  Helped result{g, g.cloth()};
  physics::Cloth& cloth = result.cloth;
  const auto id = *geometry::find_map(g.mesh, geometry::attribute::line);
  std::vector<bridge::HelpedLine> lines;
  for (int line = 0; line < int(g.lines.size()); ++line) {
    if (only >= 0 && line != only) continue;
    std::vector<geometry::Vertex> on;
    for (const geometry::Vertex v : g.mesh.vertices())
      if (id[v] == line) on.push_back(v);
    lines.push_back({line, {}, 0});
    lines.back().height = help.height;
    for (const geometry::Vertex v : geometry::two_ring(g.mesh, on)) lines.back().patch.push_back(int(v));
  }
  const physics::Particles drawn = cloth.particles;
  bridge::place_lines(lines, g.mesh, drawn, cloth.particles);
  physics::Cloth turned = cloth;
  if (physics::balance_rigidly(turned, o.run.gravity) <= o.largest_turn) cloth = turned;
  std::vector<int> patch;
  for (const auto& line : lines) patch.insert(patch.end(), line.patch.begin(), line.patch.end());
  physics::press(cloth, patch, help.press);
  if (help.struts > 0)
    for (const auto& line : lines) physics::add_struts(cloth, line.patch, {.stiffness = help.struts});
  bridge::scatter(cloth.particles, result.garment.mesh);
  physics::PrestressOptions bounds = o.bounds;
  bounds.gravity = o.run.gravity;
  result.residual = physics::prestress(cloth, bounds).residual;
  return result;
}

/// Tries all presses, struts and some heights, for all lines and for each alone, strongest first. Help that
/// keeps a line in the other run and in the verdict's own, with its gust, would have held it.
class TryHarder {
 public:
  TryHarder(Judged& j, const bridge::KeepOptions& o, std::uint64_t seed) : j_(j), o_(o), seed_(seed) {
    o_.pushes = 1;
    for (Row& row : j.rows)
      if (!stands(row.line.verdict)) open_.push_back(&row);
  }

  void run() {
    for (const double height : {1.0, 0.5, 0.2})
      for (const double press : {100.0, 30.0, 10.0, 1.0})
        for (const double struts : {30.0, 3.0, 0.3, 0.0}) {
          if (open_.empty()) return;
          attempt({press, struts, height}, -1);
          for (const Row* row : std::vector<Row*>(open_))
            if (j_.garment.lines.size() > 1) attempt({press, struts, height}, row->line.line);
        }
  }

 private:
  /// Rows whose lines keep their heights.
  std::vector<Row*> keeping(const std::vector<double>& kept, std::vector<Row*> of, double within) const {
    std::erase_if(of, [&](const Row* row) { return !(std::abs(kept[row->line.line] - 1) <= within); });
    return of;
  }

  void attempt(Help help, int only) {
    std::vector<Row*> rows = open_;
    if (only >= 0) std::erase_if(rows, [&](const Row* row) { return row->line.line != only; });
    const Helped h = helped(j_.garment, help, only, o_);
    if (rows.empty() || h.residual > 0.1) return;
    const std::vector<double> told = cases::heights_of(h.garment);
    const auto after = [&](double seconds) {
      std::vector<double> kept = cases::heights_after(h.garment, h.cloth, o_.run, seed_, seconds);
      for (std::size_t i = 0; i < kept.size(); ++i) kept[i] /= told[i];
      return kept;
    };
    rows = keeping(after(0.25), rows, 2 * most);
    if (rows.empty()) return;
    const std::vector<double> kept = after(2);
    rows = keeping(kept, rows, most);
    if (rows.empty()) return;
    bridge::LineMeter meter(h.garment.mesh, h.garment.base(), {});
    const bridge::KeepTrial trial = bridge::try_shape(h.cloth, false, {}, o_, meter, {}, {});
    help.alone = only >= 0;
    for (Row* row : rows) {
      const auto at = std::find(meter.lines().begin(), meter.lines().end(), row->line.line);
      if (at == meter.lines().end()) continue;
      const std::size_t i = std::size_t(at - meter.lines().begin());
      help.kept = kept[row->line.line];
      help.kept_gust = trial.kept_gust[i];
      const bool held = keeps(trial.kept[i]) && keeps(trial.kept_gust[i]);
      if (held || !std::isfinite(row->help.kept)) row->help = help;
      if (held) std::erase(open_, row);
    }
  }

  Judged& j_;
  bridge::KeepOptions o_;
  std::uint64_t seed_;
  std::vector<Row*> open_;
};

/// What the words ask for.
struct Asked {
  bridge::Bending bending = bridge::Bending::hinge;
  bool implicit = true, quick = false, ornate = false;
};

Judged judge(int number, const Asked& asked) {
  Judged j;
  j.garment = cases::random_garment(20261121 + number, asked.ornate ? 3 + number % 2 : 1 + number % 4, 0,
                                    asked.ornate);
  j.garment.springs.bending = asked.bending;
  bridge::KeepOptions o;
  o.seconds = 2;
  const physics::SimulateOptions leapfrog = o.run;
  if (asked.implicit) o.run.integrator = physics::Integrator::implicit;
  RandomGarment kept = j.garment;
  physics::Cloth cloth = kept.cloth();
  const bridge::KeepReport report = bridge::keep_lines(kept.mesh, cloth, {}, kept.base(), o);
  const std::vector<double> left = cases::heights_after(kept, cloth, leapfrog, 7 * number + 1);
  const std::vector<double> blown = cases::heights_after(kept, cloth, leapfrog, 7 * number + 3, 2, o.gust);
  for (const KeptLine& line : report.lines)
    j.rows.push_back({line, left[line.line] / line.height, blown[line.line] / line.height, {}});
  o.run = leapfrog;
  if (!asked.quick) TryHarder(j, o, 7 * number + 2).run();
  return j;
}

void write(std::FILE* file, int number, const Judged& j) {
  const auto& g = j.garment;
  for (const Row& r : j.rows) {
    const auto& line = g.lines[r.line.line];
    std::fprintf(file, "%d,%s,%.1f,%s,%.2e,%.0f,%d,%.0f,%.2f,%.1f,%s,%g,%g,%.3f,%.4f,%.4f,%.4f,%.4f", number,
                 g.kind.c_str(), 1e3 * g.edge,
                 g.springs.membrane == bridge::Membrane::triangles ? "triangles" : "van-gelder",
                 g.springs.rigidity, g.springs.stretch, r.line.line, 1e3 * line.length, line.turn,
                 1e3 * line.height, names[int(r.line.verdict)], r.line.press, r.line.struts, r.line.lowered,
                 r.line.kept, r.line.kept_gust, r.check, r.blown);
    if (std::isfinite(r.help.kept))
      std::fprintf(file, ",%g,%g,%g,%s,%.4f,%.4f", r.help.press, r.help.struts, r.help.height,
                   r.help.alone ? "alone" : "all", r.help.kept, r.help.kept_gust);
    else
      std::fprintf(file, ",,,,,,");
    std::fprintf(file, ",%s\n", r.line.reason.c_str());
  }
}

void write_header(std::FILE* file) {
  std::fprintf(file, "# Lines at random and what became of them: bench/keep/random_lines.cpp\n");
  std::fprintf(file,
               "garment,mesh,edge[mm],membrane,rigidity[N m],stretch[N/m],line,length[mm],turn[rad],"
               "height[mm],verdict,press,struts[N/m],lowered,kept,kept after gust,kept in another run,"
               "kept there after four gusts,"
               "held after all: press,struts[N/m],lowered,lines,kept,kept after gust,reason\n");
}

void summarise(const std::vector<std::optional<Judged>>& all) {
  struct Count {
    int lines = 0, wrong = 0, calm = 0, blown = 0;
    double farthest = 0;
  };
  Count counts[6];
  for (const std::optional<Judged>& j : all) {
    if (!j) continue;
    for (const Row& r : j->rows) {
      Count& c = counts[int(r.line.verdict)];
      ++c.lines;
      if (!stands(r.line.verdict)) {
        c.calm += keeps(r.help.kept);
        c.wrong += keeps(r.help.kept) && keeps(r.help.kept_gust);
        continue;
      }
      c.wrong += !keeps(r.check);
      c.blown += !keeps(r.blown);
      c.farthest = std::max(c.farthest, std::isfinite(r.check) ? std::abs(r.check - 1) : 1);
    }
  }
  for (int v = 0; v < 4; ++v)
    std::printf(
        "%s: %d lines, %d of them false, %d after four gusts, farthest from the told height %.2f %%\n",
        names[v], counts[v].lines, counts[v].wrong, counts[v].blown, 100 * counts[v].farthest);
  for (int v = 4; v < 6; ++v)
    std::printf("%s: %d lines, %d could have been held, %d without a gust\n", names[v], counts[v].lines,
                counts[v].wrong, counts[v].calm);
}

}  // namespace
}  // namespace furrow::bench

int main(int argc, char** argv) {
  using namespace furrow::bench;
  const char* path = argc > 1 ? argv[1] : "keep-random.csv";
  const auto number = [&](int i, int usual) { return argc > i ? std::atoi(argv[i]) : usual; };
  const int threads = number(2, 2), first = number(3, 0), end = number(4, 80);
  Asked asked;
  for (int i = 5; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "plate") asked.bending = furrow::bridge::Bending::plate;
    if (word == "ornate") asked.ornate = true;
    if (word == "leapfrog") asked.implicit = false;
    if (word == "quick") asked.quick = true;
  }
  std::vector<std::optional<Judged>> all(end);
  std::FILE* file = std::fopen(path, "w");
  if (!file) return std::fprintf(stderr, "error: cannot write %s\n", path), 1;
  write_header(file);
  std::atomic<int> next = first;
  std::mutex writing;
  int written = first;
  std::vector<std::thread> pool;
  for (int t = 0; t < threads; ++t)
    pool.emplace_back([&] {
      for (int i = next++; i < end; i = next++) {
        Judged judged = judge(i, asked);
        const std::lock_guard lock(writing);
        all[i] = std::move(judged);
        for (; written < end && all[written]; ++written) write(file, written, *all[written]);
        std::fflush(file);
        std::fprintf(stderr, "%d of %d\n", written, end);
      }
    });
  for (std::thread& thread : pool) thread.join();
  std::fclose(file);
  summarise(all);
}
