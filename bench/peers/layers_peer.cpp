// SPDX-License-Identifier: GPL-3.0-or-later
// What two garments that are worn over each other are worth, whoever draped them: a line of CSV.
//   layers_peer INNER OUTER WORN_INNER WORN_OUTER BODY
// The first two are the garments as drawn, the next two the same meshes as worn. Pairs of faces that cross or
// touch and share no place of a corner, counted exactly (geometry/mesh/crossings.h): of both garments, and of
// them of one of each. How many vertices of the outer one lie within 2 cm of the inner one, and on its outer
// side (physics/pairs/layer_order.h). Strain of the faces of both as `furrow fit` tells it, how near the body
// comes, how deep it lies inside, and the faces that it pierces.
#include <array>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather.h"
#include "bridge/draping/fit_report.h"
#include "geometry/figure/repair_body.h"
#include "geometry/mesh/crossings.h"
#include "geometry/rest/rest_metric.h"
#include "io/mesh/mesh_file.h"
#include "jobs/rest/measure_layers.h"
#include "physics/pairs/layer_order.h"

namespace furrow::bench {
namespace {

using geometry::Mesh;

constexpr double order_reach = 0.02;  // m

std::size_t crossing_pairs(const Mesh& mesh) {
  return geometry::find_crossings(mesh, geometry::find_parts(mesh)).pairs;
}

/// Whether most of a garment's faces look into the body.
bool looks_inwards(const Mesh& mesh, const physics::ExactDistance& body) {
  double out = 0;
  const auto x = bridge::positions_of(mesh);
  for (const auto& [i, j, k] : bridge::triangles_of(mesh)) {
    const physics::Vec3 &a = x[std::size_t(i)], &b = x[std::size_t(j)], &c = x[std::size_t(k)];
    out += (b - a).cross(c - a).dot(body.at((a + b + c) / 3).gradient);
  }
  return out < 0;
}

/// Two garments as one mesh; the worn shape with the rest lengths of the drawn one.
Mesh worn_as_drawn(const std::array<Mesh, 2>& drawn, const std::array<Mesh, 2>& worn) {
  const auto join = [](const std::array<Mesh, 2>& pair) {
    const std::array<const Mesh*, 2> both{&pair[0], &pair[1]};
    return jobs::joined_mesh(both);
  };
  Mesh mesh = join(drawn);
  const Mesh shape = join(worn);
  if (bridge::triangles_of(shape) != bridge::triangles_of(mesh))
    throw std::invalid_argument("the worn garments are not the meshes of the drawn ones");
  geometry::ensure_rest_lengths(mesh);
  for (const geometry::Vertex v : mesh.vertices()) mesh.point(v) = shape.point(v);
  return mesh;
}

void judge(const std::array<Mesh, 2>& drawn, const std::array<Mesh, 2>& worn, const geometry::Body& body) {
  Mesh both = worn_as_drawn(drawn, worn);
  const std::size_t all = crossing_pairs(both);
  const physics::TriangleMesh triangles = bridge::to_triangle_mesh(body);
  const physics::ExactDistance exact(triangles);
  const physics::LayerOrder order = physics::layer_order(
      bridge::positions_of(worn[1]), {bridge::positions_of(worn[0]), bridge::triangles_of(worn[0])},
      looks_inwards(drawn[0], exact), order_reach);
  const bridge::FitReport fit = bridge::fit_report(both, triangles, exact);
  std::printf("%zu,%zu,%d,%d,%.3f,%.3f,%.3f,%.2f,%.2f,%zu\n", all,
              all - crossing_pairs(worn[0]) - crossing_pairs(worn[1]), order.compared, order.outside,
              100 * fit.strain->p50, 100 * fit.strain->p99, 100 * fit.strain->max, 1e3 * fit.distance.min,
              1e3 * fit.distance.deepest_penetration, fit.piercing.faces);
}

}  // namespace
}  // namespace furrow::bench

int main(int count, char** words) {
  try {
    if (count != 6) throw std::invalid_argument("INNER OUTER WORN_INNER WORN_OUTER BODY");
    const auto mesh = [words](int i) { return furrow::io::read_mesh(words[i]).mesh; };
    furrow::bench::judge({mesh(1), mesh(2)}, {mesh(3), mesh(4)}, furrow::geometry::repair_body(mesh(5)));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "layers_peer: %s\n", e.what());
    return 2;
  }
}
