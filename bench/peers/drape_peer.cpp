// SPDX-License-Identifier: GPL-3.0-or-later
// What a draped shape is worth, whoever made it: a line of CSV.
//   drape_peer REST WORN BODY [GAP]
// REST and WORN are one mesh. Strain of faces as `furrow fit` and of edges as `furrow simulate` tell it, how
// deep the body comes through, and, as cotton, the residual force (physics/contact/residual_force.h): contact
// acts within GAP [m] (0.003).
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather.h"
#include "bridge/draping/fit_report.h"
#include "geometry/figure/repair_body.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/fabrics.h"
#include "physics/cloth/cloth.h"
#include "physics/contact/residual_force.h"
#include "tests/cases/garment_pair.h"

namespace furrow::bench {
namespace {

void judge(const std::string& rest, const std::string& worn, const std::string& body, double gap) {
  const cases::GarmentPair pair = cases::read_pair(rest, body);
  geometry::Mesh mesh = pair.garment;
  physics::Cloth cloth = cases::make_cotton(pair)(mesh);
  const geometry::Mesh shape = io::read_mesh(worn).mesh;
  if (bridge::triangles_of(shape) != bridge::triangles_of(mesh))
    throw std::invalid_argument(worn + " and " + rest + " are not one mesh");
  cloth.particles.x = bridge::positions_of(shape);
  for (const geometry::Vertex v : mesh.vertices()) mesh.point(v) = shape.point(v);

  const auto triangles = bridge::to_triangle_mesh(geometry::repair_body(io::read_mesh(body).mesh));
  const bridge::FitReport fit = bridge::fit_report(mesh, triangles, pair.exact);
  const physics::StrainStatistics edges = physics::strain_statistics(cloth);
  const double residual = physics::residual_force(cloth, physics::SettleOptions{}.gravity, &pair.field,
                                                  io::fabric_named("cotton").friction, gap);
  std::printf("%.3f,%.3f,%.3f,%.3f,%.3f,%.2f,%.2f,%zu,%.2g\n", 100 * fit.strain->p50, 100 * fit.strain->p99,
              100 * fit.strain->max, 100 * edges.p99, 100 * edges.max, 1e3 * fit.distance.min,
              1e3 * fit.distance.deepest_penetration, fit.piercing.faces, residual);
}

}  // namespace
}  // namespace furrow::bench

int main(int count, char** words) {
  try {
    if (count < 4 || count > 5) throw std::invalid_argument("REST WORN BODY [GAP]");
    furrow::bench::judge(words[1], words[2], words[3], count > 4 ? std::stod(words[4]) : 0.003);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "drape_peer: %s\n", e.what());
    return 2;
  }
}
