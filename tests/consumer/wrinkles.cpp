// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/gather.h"
#include "geometry/wrinkle.h"
#include "io/mesh_file.h"

/// Reads a mesh, draws one ridge into it, and gathers springs: wrinkles MESH.
int main(int argc, char** argv) {
  using namespace furrow;
  if (argc != 2) return 2;
  io::MeshFile file = io::read_mesh(argv[1]);
  geometry::Stroke ridge;
  ridge.points = {{-0.2, 0.5, 0}, {0.2, 0.5, 0}};
  const std::size_t edges = file.mesh.number_of_edges();
  const geometry::WrinkleReport report = geometry::wrinkle(file.mesh, std::span(&ridge, 1));
  const physics::Cloth cloth =
      bridge::gather(file.mesh, {1000, 10, report.mean_structural_length, report.mean_bending_length});
  return cloth.structural.size() == edges + 3 * report.insertion.inserted ? 0 : 1;
}
