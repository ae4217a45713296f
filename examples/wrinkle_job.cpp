// SPDX-License-Identifier: GPL-3.0-or-later
// A whole job: a ridge is drawn on a garment, the result is written, and the report printed.
//   wrinkle_job garment.obj wrinkled.ply
#include <iostream>
#include <nlohmann/json.hpp>

#include "jobs/chain/wrinkle.h"

/// Prints warnings as they come.
struct Talker : furrow::jobs::Listener {
  void warn(const furrow::jobs::Warning& w) override { std::cerr << w.code << ": " << w.text << "\n"; }
};

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  furrow::io::DrawnStroke ridge;
  ridge.stroke = {.name = "ridge", .height = 0.01, .points = {{-0.1, 0.3, 0}, {0.1, 0.3, 0}}};  // [m], y up
  furrow::jobs::WrinkleJob job;
  job.garment = std::filesystem::path(argv[1]);
  job.strokes = std::vector{ridge};  // or the path of a stroke file
  job.output = argv[2];
  Talker talker;
  std::cout << to_json(furrow::jobs::wrinkle(job, talker)).dump(2) << "\n";
}
