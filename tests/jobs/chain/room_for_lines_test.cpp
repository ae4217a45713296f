// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/chain/room_for_lines.h"

#include <catch2/catch.hpp>

#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/sheet.h"
#include "io/mesh/mesh_file.h"

using namespace furrow;

namespace {

/// All below z = 0.
struct HalfSpace : physics::Collider {
  physics::SignedDistance at(const physics::Vec3& x) const override { return {x.z(), {0, 0, 1}}; }
};

/// A sheet this far above it [m], with a ridge and a valley of 8 mm.
io::MeshFile sheet_with_lines(double above) {
  io::MeshFile file;
  file.mesh = geometry::equilateral_sheet(0.4, 0.4, 0.02);
  for (const geometry::Vertex v : file.mesh->vertices()) {
    const geometry::Point& p = file.mesh->point(v);
    file.mesh->point(v) = {p.x(), p.y(), above};
  }
  std::vector<geometry::Stroke> lines(2);
  io::WrinkleRecord record;
  for (const int i : {0, 1}) {
    lines[i].name = i == 0 ? "up" : "down";
    lines[i].height = i == 0 ? 0.008 : -0.008;
    const double x = i == 0 ? -0.1 : 0.1;
    lines[i].points = {{x, 0.05, above}, {x, 0.3, above}};
    record.lines.push_back({lines[i].name, lines[i].height, 0, 0, 0});
  }
  geometry::wrinkle(file.mesh, lines);
  io::set_wrinkle_record(file, record);
  return file;
}

}  // namespace

TEST_CASE(
    "lines_without_room: a valley deeper than the cloth lies off the body is named with what can stand") {
  const HalfSpace body;
  constexpr double gap = 0.003;
  CHECK_FALSE(jobs::lines_without_room(sheet_with_lines(0.02), body, gap));
  CHECK_FALSE(jobs::lines_without_room(sheet_with_lines(0.011), body, gap));  // it ends at the gap
  const auto near = jobs::lines_without_room(sheet_with_lines(0.0055), body, gap);
  REQUIRE(near);
  CHECK(near->code == "lines_without_room");
  CHECK(near->where == "down");
  CHECK_THAT(near->text, Catch::Contains("'down' about 4.1 of 8 mm") && !Catch::Contains("'up'"));
  io::MeshFile bare;
  bare.mesh = geometry::equilateral_sheet(0.4, 0.4, 0.02);
  CHECK_FALSE(jobs::lines_without_room(bare, body, gap));
}
