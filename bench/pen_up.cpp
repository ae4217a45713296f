// SPDX-License-Identifier: GPL-3.0-or-later
// What it takes the studio to show a line when the pen goes up: pen_up. Thirty ridges of 12 cm on a sheet,
// whose folds do not meet, drawn one after the other. A row a sheet: vertices before and after, processor
// time of the first line and of the thirtieth, each the best of three drawings, and their ratio. Then that of
// all thirty at once.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>

#include "bench/cpu_seconds.h"
#include "geometry/mesh/self_intersections.h"
#include "geometry/mesh/sheet.h"
#include "jobs/base/measure_crossings.h"
#include "jobs/sketch/sketch.h"

namespace {

using namespace furrow;
using jobs::Json;

jobs::Sketch sketch_of(double edge) {
  jobs::Sketch sketch;
  sketch.garment.mesh = geometry::equilateral_sheet(1.5, 1.5, edge);
  sketch.crossed = std::make_shared<const jobs::CrossedStart>(jobs::crossed_start(sketch.garment.mesh));
  sketch.crossings = std::make_shared<geometry::CrossingMemory>();
  sketch.options.memory = geometry::make_fold_memory();
  return sketch;
}

Json ridge(int i) {
  const double x = -0.6 + 0.24 * (i % 6), y = 0.15 + 0.3 * (i / 6);
  return {{"name", "ridge " + std::to_string(i)},
          {"height", 0.008},
          {"width", 0.06},
          {"points", Json::array({{x, y, 0}, {x + 0.01, y + 0.06, 0}, {x, y + 0.12, 0}})}};
}

double seconds(const jobs::Sketch& sketch, const Json& strokes, std::size_t& vertices) {
  jobs::Listener nobody;
  const double start = bench::cpu_seconds();
  vertices = jobs::draw_sketch(sketch, strokes, nobody).file.mesh->num_vertices();
  return bench::cpu_seconds() - start;
}

void print_row(double edge) {
  double first = 1e9, last = 1e9, together = 1e9;
  std::size_t vertices = 0;
  for (int run = 0; run < 3; ++run) {
    const jobs::Sketch sketch = sketch_of(edge);
    Json strokes = Json::array();
    for (int i = 0; i < 30; ++i) {
      strokes.push_back(ridge(i));
      const double time = seconds(sketch, strokes, vertices);
      if (i == 0) first = std::min(first, time);
      if (i == 29) last = std::min(last, time);
    }
    together = std::min(together, seconds(sketch_of(edge), strokes, vertices));
  }
  std::printf("| %zu | %zu | %.3f | %.3f | %.2f | %.3f |\n",
              std::size_t(sketch_of(edge).garment.mesh->num_vertices()), vertices, first, last, last / first,
              together);
}

}  // namespace

int main() try {
  std::printf("| vertices | with lines | first [s] | thirtieth [s] | ratio | at once [s] |\n");
  for (const double edge : {0.036, 0.029, 0.0145}) print_row(edge);
} catch (const std::exception& e) {
  std::fprintf(stderr, "error: %s\n", e.what());
  return 1;
}
