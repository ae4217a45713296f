// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/garment_pair.h"

#include <algorithm>
#include <cmath>

#include "bridge/arrays/couple_bending.h"
#include "geometry/figure/repair_body.h"
#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/masses.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/rest/stiffness.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/fabrics.h"
#include "physics/body/collider.h"
#include "physics/cloth/pins.h"

namespace furrow::cases {
namespace {

std::vector<int> loop_through(const geometry::Mesh& mesh, int vertex) {
  for (const geometry::BorderLoop& loop : geometry::border_loops(mesh)) {
    const std::vector<int> vertices(loop.vertices.begin(), loop.vertices.end());
    if (std::find(vertices.begin(), vertices.end(), vertex) != vertices.end()) return vertices;
  }
  return {};
}

bridge::GatherOptions cotton_springs(const geometry::Mesh& mesh, const io::Fabric& cotton,
                                     bridge::Bending bending) {
  bridge::GatherOptions o;
  o.membrane = bridge::Membrane::triangles;
  o.bending = bending;
  o.stretch = cotton.stretch;
  o.rigidity = cotton.rigidity;
  o.mean_structural_length = geometry::mean_rest_length(mesh);
  o.mean_bending_length = geometry::mean_bending_rest_length(mesh);
  return o;
}

}  // namespace

GarmentPair read_pair(const std::filesystem::path& garment, const std::filesystem::path& body, int threads) {
  physics::ExactDistance exact(bridge::to_triangle_mesh(geometry::repair_body(io::read_mesh(body).mesh)));
  physics::DistanceFieldOptions options;
  options.threads = threads;
  physics::DistanceField field = physics::DistanceField::build(exact, options);
  return {io::read_mesh(garment).mesh, std::move(exact), std::move(field)};
}

double gap_of(const GarmentPair& pair, int refinements) {
  // The sag of a long edge (95th percentile) over a limb of 5 cm radius; a level makes it a quarter.
  const geometry::Mesh& mesh = pair.garment;
  std::vector<double> squares;
  for (const geometry::Edge e : mesh.edges())
    squares.push_back(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  const auto at = squares.begin() + std::ptrdiff_t(0.95 * double(squares.size() - 1));
  std::nth_element(squares.begin(), at, squares.end());
  const double sag = *at / (8 * 0.05);
  return std::max(physics::SettleOptions{}.gap,
                  sag / std::pow(4, refinements) + 1.5 * pair.field.report().tolerance);
}

int vertex_at_top(const geometry::Mesh& garment) {
  const auto loops = geometry::border_loops(garment);
  return int(loops[geometry::find_border_loop(loops, "top")].vertices.at(0));
}

bridge::MakeCloth make_cotton(const GarmentPair& pair, std::optional<int> held, bridge::Bending bending) {
  return [&pair, held, bending](geometry::Mesh& mesh) {
    const io::Fabric& cotton = io::fabric_named("cotton");
    geometry::ensure_rest_lengths(mesh);
    geometry::ensure_bending_springs(mesh);
    geometry::ensure_rest_angles(mesh);
    geometry::lump_masses(mesh, cotton.density);
    const bridge::GatherOptions springs = cotton_springs(mesh, cotton, bending);
    physics::Cloth cloth = bridge::gather(mesh, springs);
    if (held) {
      const std::vector<int> loop = loop_through(mesh, *held);
      physics::pin(cloth.particles, loop);
      physics::stiffen_clamps(cloth);
      physics::push_out(cloth.particles.x, loop, pair.exact);
    }
    bridge::couple_bending(mesh, springs, cloth);
    return cloth;
  };
}

Depth depth_of(const physics::Cloth& cloth, const physics::Collider& body, double gap) {
  Depth result;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    const double depth = gap - body.at(cloth.particles.x[i]).value;
    if (cloth.particles.inv_mass[i] == 0 || depth < -1e-5) continue;
    ++result.particles;
    result.mean += std::max(0.0, depth);
    result.largest = std::max(result.largest, depth);
  }
  if (result.particles) result.mean /= result.particles;
  return result;
}

}  // namespace furrow::cases
