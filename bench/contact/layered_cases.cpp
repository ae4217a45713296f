// SPDX-License-Identifier: GPL-3.0-or-later
// The table of docs/figures.md: cloth on cloth at rest against closed forms, at two resolutions. For
// bench/contact/run.
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

#include "tests/cases/layered.h"

namespace {

using namespace furrow;

void print(const std::string& name, const cases::LayeredCase& c) {
  for (const cases::LayeredNumber& n : c.numbers) {
    std::printf("| %s | %d | %s | %.6g | %.6g | %.2g%s | %s | %d | %d%s |\n", name.c_str(), c.vertices,
                n.what.c_str(), n.answer, n.found, n.relative ? 100 * n.tolerance : n.tolerance,
                n.relative ? " %" : "", n.holds() ? "yes" : "**no**", c.crossings, c.iterations,
                c.rests ? "" : ", not at rest");
  }
  std::fflush(stdout);
}

/// Share of what friction can bear at which cloth begins to slide, to two thousandths.
void print_slide(const std::string& name, const std::function<cases::LayeredCase(double)>& at,
                 double tolerance) {
  double low = 0.9, high = 1.1;
  cases::LayeredCase held;
  while (high - low > 2e-3) {
    const double middle = (low + high) / 2;
    const cases::LayeredCase c = at(middle);
    if (c.rests) held = c;
    (c.rests ? low : high) = middle;
  }
  held.numbers = {{"load that it bears, over that of the closed form", 1, (low + high) / 2, tolerance}};
  print(name, held);
}

}  // namespace

int main(int count, char** arguments) {
  const std::string only = count > 1 ? arguments[1] : "";
  const auto asked = [&](const char* name) { return only.empty() || only == name; };
  std::printf("| case | vertices | number | answer | found | tolerance | holds | crossings | iterations |\n");
  std::printf("| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const bool fine : {false, true}) {
    if (asked("V1")) print("V1 sheet on a sheet", cases::stacked_sheets(1, fine ? 24 : 12));
    if (asked("V2"))
      for (const int n : {4, 10})
        print("V2 stack of " + std::to_string(n), cases::stacked_sheets(n, fine ? 18 : 9));
    if (asked("V3") && !fine)
      for (const bool edges : {false, true})
        for (const double load : {0.01, 0.25, 1.0})
          print(std::string("V3 ") + (edges ? "edges" : "vertex and face"), cases::pressed_pair(edges, load));
    if (asked("V4"))
      print_slide(
          "V4 sheet on an incline", [&](double s) { return cases::on_incline(s, fine ? 40 : 20); }, 5e-3);
    if (asked("V5"))
      print_slide(
          "V5 sheet pulled out", [&](double s) { return cases::pulled_sheet(s, fine ? 40 : 20); }, 0.02);
    if (asked("V6"))
      print_slide(
          "V6 strip over a sleeve", [&](double s) { return cases::capstan_on_sleeve(s, fine ? 96 : 48); },
          0.03);
    if (asked("V7")) print("V7 heavy fold", cases::heavy_fold(0.025, fine ? 16 : 8));
    if (asked("V8")) print("V8 coil in a tube", cases::coil_in_tube(fine ? 96 : 48));
    if (asked("V15"))
      for (const cases::CrossingStart start : cases::crossing_starts)
        print(std::string("V15, V16 ") + cases::name_of(start), cases::untangled(start, fine ? 40 : 20));
    if (asked("V9")) print("V9 sleeve over a sleeve", cases::sleeve_over_sleeve(fine ? 128 : 96));
  }
}
