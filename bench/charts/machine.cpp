// SPDX-License-Identifier: GPL-3.0-or-later
// What the charts were measured on: processor, compiler, and how fast plain code runs there.
#include "bench/accuracy_table.h"
#include "bench/charts/charts.h"
#include "bench/machine_probes.h"

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
  Table table(folder + "/machine.csv",
              "STREAM triad and a step of a plain sheet of springs, one thread, processor time, median of 7.",
              "processor,compiler,triad[GB/s],plain springs[M vertex steps/s]");
  table.row('"' + processor() + '"', '"' + std::string(compiler) + '"', stream_triad(), plain_springs());
}

}  // namespace furrow::bench
