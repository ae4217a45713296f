// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/chart_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

#include "io/base/atomic_file.h"
#include "io/base/figure_path.h"
#include "io/base/own_mark.h"
#include "io/picture/png_file.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "jobs/move/judge_report.h"

namespace furrow::jobs {
namespace {

constexpr double least_error = 1e-8;  // drawn there if below, also 0

/// In gnuplot's single quotes.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text)
    if (c == '\'')
      result += "''";
    else if (static_cast<unsigned char>(c) >= 32)
      result += c;
  return result + "'";
}

double drawn_error(const JudgedCandidate& c) { return 100 * std::max(c.error, least_error); }

struct Range {
  double low = INFINITY, high = 0;
  void take(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

/// One colour an integrator; of one integrator, each step has another sign.
const char* colour_of(physics::Integrator integrator) {
  switch (integrator) {
    case physics::Integrator::leapfrog:
      return "#1f4e9e";
    case physics::Integrator::rk4:
      return "#7b3fa0";
    case physics::Integrator::xpbd:
      return "#c77700";
    case physics::Integrator::implicit:
      return "#b71c1c";
    case physics::Integrator::tr_bdf2:
      return "#ad1457";
  }
  return "#7a4a3a";
}

/// One point, named in the key: labels beside points would cover each other.
void plot_point(std::ostream& out, const JudgedCandidate& c, int sign, double top, bool is_reference) {
  const bool diverged = c.fate == Fate::diverged;
  const std::string name = c.candidate.name + (diverged ? " (diverged)" : is_reference ? " (reference)" : "");
  out << ", \\\n  '+' using (" << c.cost << "):(" << (diverged ? top : drawn_error(c))
      << ") every ::0::0 with points ps 1.6 lw 1.5 pt " << (diverged ? 2 : sign) << " lc rgb '"
      << (is_reference ? "black" : colour_of(c.candidate.integrator)) << "' title " << quoted(name);
}

void plot_points(std::ostream& out, const Judgement& j, double top) {
  constexpr int signs[] = {7, 5, 9, 11, 13};
  std::map<physics::Integrator, int> seen;
  for (const JudgedCandidate& c : j.candidates) {
    if (c.fate != Fate::diverged && !(c.fate == Fate::done && std::isfinite(c.error))) continue;
    const bool is_reference = &c == &j.candidates.back();
    const int sign = is_reference ? 8 : signs[seen[c.candidate.integrator]++ % 5];
    plot_point(out, c, sign, top, is_reference);
  }
  if (j.chosen < 0) return;
  const JudgedCandidate& c = j.candidates[static_cast<std::size_t>(j.chosen)];
  out << ", \\\n  '+' using (" << c.cost << "):(" << drawn_error(c)
      << ") every ::0::0 with points pt 6 ps 3.5 lw 2 lc 'red' title 'chosen'";
}

std::string script(const std::string& path, const Judgement& j, const std::string& title) {
  Range x, y;
  for (const JudgedCandidate& c : j.candidates) {
    if (c.fate != Fate::done && c.fate != Fate::diverged) continue;
    x.take(c.cost);
    if (std::isfinite(c.error)) y.take(drawn_error(c));
  }
  y.take(100 * j.options.tolerance);
  const double top = std::pow(10, std::ceil(std::log10(y.high) + 0.3));
  std::ostringstream out;
  out << (io::ending_of(path) == ".svg" ? "set terminal svg size 900,460 font 'sans,13' background 'white'\n"
                                        : "set terminal pngcairo size 1000,520 font 'sans,13'\n")
      << "set title " << quoted(title) << " noenhanced\n"
      << "set logscale xy\nset format y '%g %%'\nset grid\nset key outside right center Left reverse samplen "
         "1 font ',11'\n"
      << "set xlabel 'predicted seconds a simulated second'\n"
      << "set ylabel 'error / size of the garment, " << (j.by_shape ? "of the shape" : "RMS of positions")
      << "'\n"
      << "set xrange [" << x.low / 2 << ":" << x.high * 2 << "]\n"
      << "set yrange [" << y.low / 3 << ":" << top << "]\n";
  out << "set style line 1 dt 2 lw 2 lc 'red'\nplot " << 100 * j.options.tolerance
      << " ls 1 title 'tolerance'";
  if (std::isfinite(j.reference_error) && 100 * j.reference_error > y.low / 3)
    out << ", " << 100 * j.reference_error << " with lines dt 3 lc 'black' title 'known no better than'";
  plot_points(out, j, top);
  out << "\n";
  return out.str();
}

void write_rows(std::ostream& out, const Judgement& j) {
  out.precision(9);
  out << "name,integrator,dt,cost,error,error_is";
  for (const auto& distance : distance_columns) out << "," << distance.first;
  out << ",verdict\n";
  for (const JudgedCandidate& c : j.candidates) {
    const bool known = is_known(c);
    out << '"' << c.candidate.name << "\"," << name_of(c.candidate.integrator) << "," << c.dt << "," << c.cost
        << ",";
    if (known)
      out << c.error << "," << kind_of_error(j, c);
    else
      out << ",";
    for (const auto& distance : distance_columns) {
      out << ",";
      if (known) out << c.off.*distance.second;
    }
    out << "," << verdict_of(j, c) << "\n";
  }
}

}  // namespace

void write_chart_csv(const std::string& path, const Judgement& j) {
  io::write_atomically(path, [&](std::ostream& out) { write_rows(out, j); });
}

void check_chart_picture(const std::string& path) {
  if (io::ending_of(path) != ".svg" && io::ending_of(path) != ".png")
    throw std::invalid_argument("`output`: " + path +
                                ": charts are drawn as SVG or PNG; let the name end in .svg or .png");
  check_folder(path);
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0)
    throw std::runtime_error(path +
                             ": gnuplot, which draws charts, is not installed; install it (Debian's "
                             "gnuplot-nox), or ask for the numbers alone with `csv`");
}

void draw_chart(const std::string& path, const Judgement& j, const std::string& title) {
  io::write_atomically(path, [&](std::ostream& out) {
    const std::string command =
        "gnuplot 2>/dev/null <<'end of chart'\n" + script(path, j, title) + "end of chart\n";
    std::FILE* gnuplot = popen(command.c_str(), "r");
    std::string drawn;
    std::array<char, 4096> part;
    for (std::size_t n; gnuplot && (n = std::fread(part.data(), 1, part.size(), gnuplot)) > 0;)
      drawn.append(part.data(), n);
    if (!gnuplot || pclose(gnuplot) != 0 || drawn.empty())
      throw std::runtime_error(path + ": gnuplot could not draw it; `csv` has the numbers");
    if (io::ending_of(path) == ".svg")
      out << drawn << "<!-- " << io::own_mark << " -->\n";
    else
      out << io::marked_png(drawn);
  });
}

}  // namespace furrow::jobs
