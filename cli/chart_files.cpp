// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/chart_files.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/judge_report.h"
#include "io/lower_case.h"

namespace furrow::cli {
namespace {

constexpr double kLeastError = 1e-8;  // drawn there if below, also 0

std::string ending(const std::string& path) {
  return io::lower_case(std::filesystem::path(path).extension().string());
}

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

double drawn_error(const JudgedCandidate& c) { return 100 * std::max(c.error, kLeastError); }

struct Range {
  double low = INFINITY, high = 0;
  void take(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

/// A data block of cost, error and name for what `wanted` takes.
template <class Wanted>
void block(std::ostream& out, const char* name, const Judgement& j, double top, Wanted wanted) {
  out << "$" << name << " << END\n";
  for (const JudgedCandidate& c : j.candidates)
    if (wanted(c))
      out << c.cost << " " << (c.fate == Fate::done ? drawn_error(c) : top) << " \"" << c.candidate.name
          << "\"\n";
  out << "END\n";
}

void write_blocks(std::ostream& out, const Judgement& j, double top) {
  const JudgedCandidate& reference = j.candidates.back();
  const JudgedCandidate* chosen = j.chosen < 0 ? nullptr : &j.candidates[static_cast<std::size_t>(j.chosen)];
  const auto known = [&](const JudgedCandidate& c) {
    return c.fate == Fate::done && std::isfinite(c.error) && &c != &reference;
  };
  block(out, "explicit", j, top, [&](const JudgedCandidate& c) {
    return known(c) && !physics::is_unconditionally_stable(c.candidate.integrator);
  });
  block(out, "implicit", j, top, [&](const JudgedCandidate& c) {
    return known(c) && physics::is_unconditionally_stable(c.candidate.integrator);
  });
  block(out, "reference", j, top, [&](const JudgedCandidate& c) {
    return &c == &reference && c.fate == Fate::done && std::isfinite(c.error);
  });
  block(out, "diverged", j, top, [&](const JudgedCandidate& c) { return c.fate == Fate::diverged; });
  block(out, "chosen", j, top, [&](const JudgedCandidate& c) { return &c == chosen; });
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
  out << (ending(path) == ".svg" ? "set terminal svg size 800,520 font 'sans,13' background 'white'\n"
                                 : "set terminal pngcairo size 1000,650 font 'sans,13'\n")
      << "set output " << quoted(path) << "\nset title " << quoted(title) << " noenhanced\n"
      << "set logscale xy\nset format y '%g %%'\nset grid\nset key outside bottom center horizontal\n"
      << "set xlabel 'predicted seconds a simulated second'\n"
      << "set ylabel 'error / size of the garment, " << (j.by_bulk ? "bulk" : "RMS of positions") << "'\n"
      << "set xrange [" << x.low / 2 << ":" << x.high * 6 << "]\n"
      << "set yrange [" << y.low / 3 << ":" << top << "]\n";
  write_blocks(out, j, top);
  const char* label = " using 1:2:3 with labels left offset 1,0.4 font ',10' noenhanced notitle";
  out << "plot " << 100 * j.options.tolerance << " with lines dt 2 lw 2 lc 'red' title 'tolerance', "
      << "$explicit with points pt 7 ps 1.2 lc 'blue' title 'explicit', $explicit" << label
      << ", $implicit with points pt 5 ps 1.2 lc 'dark-green' title 'implicit', $implicit" << label
      << ", $reference with points pt 8 ps 1.4 lc 'black' title 'reference, its own estimate', $reference"
      << label << ", $diverged with points pt 2 ps 1.6 lc 'red' title 'diverged', $diverged" << label
      << ", $chosen with points pt 6 ps 3 lw 2 lc 'orange' title 'chosen'\n";
  return out.str();
}

}  // namespace

void write_chart_csv(const std::string& path, const Judgement& j) {
  std::ofstream out(path, std::ios::binary);
  out.precision(9);
  out << "name,integrator,dt,cost,error,rms,max,bulk,verdict\n";
  for (const JudgedCandidate& c : j.candidates) {
    const bool known = std::isfinite(c.error) && c.fate == Fate::done;
    out << '"' << c.candidate.name << "\"," << name_of(c.candidate.integrator) << "," << c.dt << ","
        << c.cost;
    if (known)
      out << "," << c.error << "," << c.off.rms << "," << c.off.max << "," << c.off.bulk << ","
          << (j.meets(c) ? "meets" : "misses") << "\n";
    else
      out << ",,,,," << name_of(c.fate) << "\n";
  }
  out.close();
  if (!out) throw std::runtime_error(path + ": cannot be written; is the disk full?");
}

void check_chart_picture(const std::string& path) {
  if (ending(path) != ".svg" && ending(path) != ".png")
    throw UsageError("--output: " + path +
                     ": charts are drawn as SVG or PNG; let the name end in .svg or .png");
  check_folder(path);
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0)
    throw std::runtime_error(path +
                             ": gnuplot, which draws charts, is not installed; install it (Debian's "
                             "gnuplot-nox), or ask for the numbers alone with --csv");
}

void draw_chart(const std::string& path, const Judgement& j, const std::string& title) {
  const std::string text = script(path, j, title);
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  std::FILE* gnuplot = popen("gnuplot >/dev/null 2>&1", "w");
  if (gnuplot) std::fwrite(text.data(), 1, text.size(), gnuplot);
  const int status = gnuplot ? pclose(gnuplot) : -1;
  std::signal(SIGPIPE, before);
  if (status != 0) throw std::runtime_error(path + ": gnuplot could not draw it; --csv has the numbers");
}

}  // namespace furrow::cli
