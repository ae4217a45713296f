// SPDX-License-Identifier: GPL-3.0-or-later
// Cases V11 and V12 of docs/figures.md: sheets that a lid crushes, from many seeds, and a towel that is
// wrung. handled_cases [crush|wring [columns [seeds or turns [word …]]]]. Words: implicit; without, no
// contact; short, steps of a third; smooth, no friction of cloth on cloth.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/cases/handled_sheets.h"

namespace {

using namespace furrow;
using physics::Integrator;

const char* name_of(Integrator i) { return i == Integrator::implicit ? "implicit" : "leapfrog"; }

void print(const std::string& what, const cases::Handling& how, const cases::Handled& h) {
  std::printf(
      "| %s | %s%s | %d | %d | %d | %d | %.3f | %.4f%% | %lld | %d | %.1f |", what.c_str(),
      name_of(how.integrator), how.self_contact ? "" : ", without", h.vertices, h.looked, h.most_crossings,
      h.report.self.pairs, 1e3 * h.report.self.nearest,
      100.0 * double(h.report.cut_moves) / (double(h.vertices) * std::max(1.0, double(h.report.steps))),
      static_cast<long long>(h.report.open_steps), int(h.report.outcome), h.report.cpu_seconds);
  if (h.torques[0] != 0) std::printf(" %.4g %.4g |", h.torques[0], h.torques[1]);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** arguments) {
  const auto word = [&](int i, const char* missing) {
    return std::string(count > i ? arguments[i] : missing);
  };
  const std::string what = word(1, "crush");
  const int columns = std::atoi(word(2, "40").c_str()), many = std::atoi(word(3, "20").c_str());
  cases::Handling how;
  how.columns = columns;
  for (int i = 4; i < count; ++i) {
    if (word(i, "") == "implicit") how.integrator = Integrator::implicit, how.look = 1;
    if (word(i, "") == "without") how.self_contact = false;
    if (word(i, "") == "smooth") how.friction = 0;
    if (word(i, "") == "short") how.dt_factor = 0.3;
  }
  std::printf(
      "| case | steps | vertices | looked at | most edges through faces | pairs at the end | nearest [mm] | "
      "moves cut | steps not solved | outcome | seconds |\n| --- | --- | --- | --- | --- | --- | --- | --- | "
      "--- | --- | --- |\n");
  if (what == "wring") {
    how.seconds = 2.5;
    print("towel, " + std::to_string(many) + " turns", how, cases::wring(many, how));
  } else {
    for (int seed = 1; seed <= many; ++seed)
      print("crush, seed " + std::to_string(seed), how, cases::crush(std::uint64_t(seed), how));
  }
}
