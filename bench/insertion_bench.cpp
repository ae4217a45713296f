// SPDX-License-Identifier: GPL-3.0-or-later
// How long rule `fold` takes to insert and raise lines: insertion_bench. A row a garment, the best of five
// runs, processor time: inserted (the band is refined and the lines embedded), raised (with the second pass
// of splits), smoothed (with the rest state), and the first for 10,000 new vertices.
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "bench/cpu_seconds.h"
#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/sheet.h"
#include "io/mesh/mesh_file.h"
#include "io/stroke/stroke_file.h"

namespace {

using namespace furrow;

/// Seconds of the three stages, and new vertices.
struct Times {
  std::array<double, 3> stage{};
  std::size_t vertices = 0;
};

Times best_of_five(const geometry::Mesh& garment, const std::vector<geometry::Stroke>& strokes) {
  geometry::WrinkleOptions options;
  options.insertion.max_distance = 0.5;
  Times best;
  for (int run = 0; run < 5; ++run) {
    geometry::Mesh mesh = garment;
    Times now;
    double last = bench::cpu_seconds();
    geometry::wrinkle(mesh, strokes, options, [&](geometry::Stage stage, const geometry::Mesh&) {
      const double clock = bench::cpu_seconds();
      now.stage[static_cast<std::size_t>(stage)] = clock - last;
      last = bench::cpu_seconds();
    });
    now.vertices = mesh.num_vertices() - garment.num_vertices();
    const auto whole = [](const Times& t) { return t.stage[0] + t.stage[1] + t.stage[2]; };
    if (run == 0 || whole(now) < whole(best)) best = now;
  }
  return best;
}

void print_row(const std::string& name, const geometry::Mesh& garment,
               const std::vector<geometry::Stroke>& strokes) {
  const Times t = best_of_five(garment, strokes);
  std::printf("| %s | %zu | %zu | %.3f | %.3f | %.3f | %.2f |\n", name.c_str(),
              std::size_t(garment.num_vertices()), t.vertices, t.stage[0], t.stage[1], t.stage[2],
              t.stage[0] * 1e4 / static_cast<double>(t.vertices));
}

/// Straight lines over the whole of a sheet, 12 cm apart.
std::vector<geometry::Stroke> rows_of_lines(int count, double width) {
  std::vector<geometry::Stroke> strokes;
  for (int i = 0; i < count; ++i) {
    geometry::Stroke& s = strokes.emplace_back();
    s.name = "line " + std::to_string(i + 1);
    s.height = 0.012;
    s.width = width;
    const double x = 0.12 * (i - 0.5 * (count - 1));
    s.points = {{x, 0.02, 0}, {x, 1.18, 0}};
  }
  return strokes;
}

}  // namespace

int main() try {
  std::puts(
      "| garment | vertices | new | inserted [s] | raised [s] | smoothed, rest [s] | first two a 10,000 new "
      "[s] |");
  std::puts("| --- | --- | --- | --- | --- | --- | --- |");
  for (const double edge : {0.02, 0.01})
    print_row("sheet of 1.2 m, edges of " + std::to_string(int(1000 * edge + 0.5)) + " mm",
              geometry::equilateral_sheet(1.2, 1.2, edge), rows_of_lines(8, 0.06));
  const io::MeshFile skirt = io::read_mesh(FURROW_MESHES "/skirt.obj");
  print_row("the demo's skirt", skirt.mesh, io::read_strokes(FURROW_MESHES "/strokes/figure_skirt.json"));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return 1;
}
