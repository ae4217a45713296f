// SPDX-License-Identifier: GPL-3.0-or-later
// A whole job: a scene is simulated, its outputs are written, and what came of it is printed.
//   simulate_job scene.toml
#include <iostream>
#include <nlohmann/json.hpp>

#include "jobs/move/simulate.h"

/// Prints progress and warnings as they come.
struct Talker : furrow::jobs::Listener {
  void progress(const std::string& what, double share) override {
    std::cerr << what << " " << int(100 * share) << " %\n";
  }
  void warn(const furrow::jobs::Warning& w) override { std::cerr << w.code << ": " << w.text << "\n"; }
};

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  Talker talker;
  furrow::jobs::SimulateJob job;
  job.scene = furrow::jobs::scene_from_file(argv[1]);
  const furrow::jobs::SimulateReport report = furrow::jobs::simulate(job, talker);
  for (const furrow::jobs::Warning& w : report.warnings) talker.warn(w);
  std::cout << furrow::jobs::to_json(report).dump(2) << "\n";
  return report.failure.empty() ? 0 : 1;
}
