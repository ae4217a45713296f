// SPDX-License-Identifier: GPL-3.0-or-later
// What the charts were measured on: processor and compiler.
#include "bench/accuracy_table.h"
#include "bench/charts/charts.h"

namespace furrow::bench {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

#if defined(__clang__)
constexpr const char* compiler = "clang++ " __clang_version__;
#else
constexpr const char* compiler = "g++ " __VERSION__;
#endif

}  // namespace

void chart_machine(const std::string& folder, Effort) {
  Table table(folder + "/machine.csv", "What the charts were measured on.", "processor,compiler");
  table.row('"' + processor() + '"', '"' + std::string(compiler) + '"');
}

}  // namespace furrow::bench
