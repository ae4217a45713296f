// SPDX-License-Identifier: GPL-3.0-or-later
// charts FOLDER quick|full [NAME ...] : writes the data of the charts of speed against accuracy into CSV
// files in the folder; by default all. bench/charts/run calls it and draws.
#include "bench/charts/charts.h"

#include <algorithm>
#include <exception>
#include <iostream>

int main(int argc, char** argv) {
  using namespace furrow::bench;
  const std::pair<std::string, void (*)(const std::string&, Effort)> charts[] = {
      {"machine", chart_machine},        {"laws", chart_laws},         {"bending", chart_bending},
      {"work", chart_work_precision},    {"implicit", chart_implicit}, {"stability", chart_stability},
      {"damping", chart_damping},        {"contact", chart_contact},   {"equilibria", chart_equilibria},
      {"metamorphic", chart_metamorphic}};
  const std::string effort = argc > 2 ? argv[2] : "";
  if (effort != "quick" && effort != "full") {
    std::cerr << "charts FOLDER quick|full";
    for (const auto& chart : charts) std::cerr << " [" << chart.first << ']';
    std::cerr << '\n';
    return 2;
  }
  try {
    for (const auto& [name, write] : charts) {
      const bool wanted = argc == 3 || std::find(argv + 3, argv + argc, name) != argv + argc;
      if (wanted) write(argv[1], effort == "quick" ? Effort::quick : Effort::full);
    }
  } catch (const std::exception& fault) {
    std::cerr << fault.what() << '\n';
    return 1;
  }
}
