// SPDX-License-Identifier: GPL-3.0-or-later
// The geometry alone: a sheet of two triangles becomes fine, gets a fold, and is smoothed a little.
#include <algorithm>
#include <array>
#include <cstdio>

#include "geometry/fold/taubin_smooth.h"
#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/mesh.h"
#include "geometry/refine/subdivide.h"

int main() {
  using namespace furrow::geometry;
  Mesh sheet;  // a CGAL::Surface_mesh
  const Vertex a = sheet.add_vertex({-0.2, 0, 0}), b = sheet.add_vertex({0.2, 0, 0}),
               c = sheet.add_vertex({0.2, 0.4, 0}), d = sheet.add_vertex({-0.2, 0.4, 0});
  sheet.add_face(a, b, c);  // counter-clockwise as seen from outside
  sheet.add_face(a, c, d);
  midpoint_subdivide(sheet, 4);

  const std::array ridge{Stroke{.name = "ridge", .height = 0.012, .points = {{-0.1, 0.2, 0}, {0.1, 0.2, 0}}}};
  const WrinkleReport made = wrinkle(sheet, ridge);
  TaubinOptions gently;
  gently.iterations = 1;
  gently.border = BorderRule::keep;
  const SmoothReport smoothed = taubin_smooth(sheet, {}, gently);

  double highest = 0;
  for (const Vertex v : sheet.vertices()) highest = std::max(highest, sheet.point(v).z());
  std::printf("%zu vertices, of which %zu were smoothed; '%s' is %.1f mm high, asked for were %.1f\n",
              std::size_t(sheet.number_of_vertices()), smoothed.smoothed_vertices, made.lines[0].name.c_str(),
              1000 * highest, 1000 * made.lines[0].height);
  return highest > 0.01 && highest < 0.014 ? 0 : 1;
}
