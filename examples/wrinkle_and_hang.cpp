// SPDX-License-Identifier: GPL-3.0-or-later
// wrinkle_and_hang GARMENT BODY OUT.ply: draws a ridge across a garment, and lets it hang and fall on a body
// for a second.
#include "bridge/arrays/gather.h"
#include "geometry/figure/repair_body.h"
#include "geometry/fold/wrinkle.h"
#include "io/mesh/mesh_file.h"
#include "physics/body/distance_field.h"
#include "physics/motion/simulate.h"

int main(int argc, char** argv) {
  using namespace furrow;
  if (argc != 4) return 2;
  io::MeshFile garment = io::read_mesh(argv[1]);
  geometry::Stroke ridge{.name = "chest", .height = 0.02, .points = {{-0.2, 0.5, 0}, {0.2, 0.5, 0}}};
  const geometry::WrinkleReport made = geometry::wrinkle(garment.mesh, {&ridge, 1});

  const geometry::Body body = geometry::repair_body(io::read_mesh(argv[2]).mesh);
  const physics::DistanceField field = physics::DistanceField::build(bridge::to_triangle_mesh(body));
  physics::Cloth cloth =
      bridge::gather(garment.mesh, {1000, 10, made.mean_structural_length, made.mean_bending_length});
  physics::SimulateOptions options;
  options.seconds = 1;
  const physics::SimulateReport run = physics::simulate(cloth, &field, options);

  bridge::scatter(cloth.particles, garment.mesh);
  io::write_mesh(argv[3], garment);
  return run.outcome == physics::Outcome::finished ? 0 : 4;
}
