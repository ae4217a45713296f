// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/attached_parts.h"

#include <catch2/catch.hpp>

#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "geometry/mesh/struts.h"
#include "geometry/refine/subdivide.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;

namespace {

constexpr double side = 0.4;  // of the sheet that all lies on [m]

/// A sheet of its own, moved; turned: it faces the other way.
void add_sheet(Mesh& mesh, double width, double height, double edge, const Vector& moved,
               bool turned = false) {
  const Mesh sheet = equilateral_sheet(width, height, edge);
  std::vector<Vertex> now;
  for (const Vertex v : sheet.vertices()) now.push_back(mesh.add_vertex(sheet.point(v) + moved));
  for (const Face f : sheet.faces()) {
    std::vector<Vertex> corners;
    for (const Vertex v : sheet.vertices_around_face(sheet.halfedge(f))) corners.push_back(now[v.idx()]);
    turned ? mesh.add_face(corners[0], corners[2], corners[1])
           : mesh.add_face(corners[0], corners[1], corners[2]);
  }
}

Mesh sheet_with(double width, double edge, double off, bool turned = false) {
  Mesh mesh;
  add_sheet(mesh, side, side, 0.02, {0, 0, 0});
  add_sheet(mesh, width, width, edge, {0.05, 0.05, off}, turned);
  return mesh;
}

std::vector<AttachedPart> attached(const Mesh& mesh) { return find_attached(mesh, find_parts(mesh)); }

}  // namespace

TEST_CASE("find_attached: a button is rigid, a pocket goes place by place, what is far off is neither") {
  const auto button = attached(sheet_with(0.02, 0.01, 0.003));
  REQUIRE(button.size() == 1);
  CHECK(button[0].part == 1);
  CHECK(button[0].ride == Ride::rigid);
  CHECK(button[0].reach == Approx(0.003));
  const auto pocket = attached(sheet_with(0.1, 0.02, 0.003));
  REQUIRE(pocket.size() == 1);
  CHECK(pocket[0].ride == Ride::by_place);
  CHECK(attached(sheet_with(0.1, 0.02, 0.02)).empty());
  CHECK(attached(sheet_with(0.02, 0.01, 0.2)).empty());
  CHECK(attached(sheet_with(0.1, 0.02, 0.003, true)).size() == 1);  // whichever way it faces
}

TEST_CASE("find_attached: what is chosen overrides what is found") {
  const Mesh mesh = sheet_with(0.1, 0.02, 0.003), far = sheet_with(0.1, 0.02, 0.2);
  const std::vector<Ride> free{Ride::none, Ride::by_itself}, held{Ride::none, Ride::by_place};
  const auto by_itself = find_attached(mesh, find_parts(mesh), free);
  REQUIRE(by_itself.size() == 1);
  CHECK(by_itself[0].ride == Ride::by_itself);
  const auto pocket = find_attached(far, find_parts(far), held);
  REQUIRE(pocket.size() == 1);
  CHECK(pocket[0].ride == Ride::by_place);
  const Mesh button = sheet_with(0.02, 0.01, 0.2);
  CHECK(find_attached(button, find_parts(button), held).at(0).ride == Ride::rigid);
  Mesh two = sheet_with(0.02, 0.01, 0.05);
  add_sheet(two, 0.02, 0.02, 0.01, {0.09, 0.05, 0.05});
  const auto other = find_attached(two, find_parts(two), free);  // it is nearer to the free one than to cloth
  REQUIRE(other.size() == 2);
  CHECK(other[1].ride == Ride::rigid);
  Mesh noted = mesh;
  set_rides(noted, find_parts(noted), by_itself);
  const std::vector<Ride> rides = rides_of(noted);
  CHECK(std::count(rides.begin(), rides.end(), Ride::none) == std::ssize(rides));
  CHECK(find_map(noted, attribute::rides).has_value());
}

TEST_CASE("find_attached: a layer as large as what it lies on rides only if it faces the other way") {
  CHECK(attached(sheet_with(0.28, 0.02, -0.0015)).empty());
  const auto inner = attached(sheet_with(0.28, 0.02, -0.0015, true));
  REQUIRE(inner.size() == 1);
  CHECK(inner[0].ride == Ride::by_place);
  Mesh half = sheet_with(0.28, 0.02, -0.0015, true);
  for (const Vertex v : half.vertices())  // a part of it hangs over
    if (half.point(v).z() < 0) half.point(v) = half.point(v) + Vector(0.2, 0, 0);
  CHECK(attached(half).empty());
}

TEST_CASE("find_attached: what is sewn on, or drawn on, stays cloth, and no part rides on a rider") {
  Mesh sewn = sheet_with(0.1, 0.02, 0.003);
  const Parts parts = find_parts(sewn);
  Vertex of_pocket;
  for (const Vertex v : sewn.vertices())
    if (parts.of_vertex[v.idx()] == 1) of_pocket = v;
  const Strut tie{Vertex(0), of_pocket, 1e-7, 100};
  set_struts(sewn, std::span(&tie, 1));
  CHECK(attached(sewn).empty());
  Mesh drawn = sheet_with(0.1, 0.02, 0.003);
  ensure_map(drawn, attribute::line)[of_pocket] = 0;
  CHECK(attached(drawn).empty());
  Mesh both = sheet_with(0.1, 0.02, 0.003);
  add_sheet(both, 0.02, 0.01, 0.01, {0.08, 0.08, 0.005});
  const auto found = attached(both);
  REQUIRE(found.size() == 2);
  CHECK(found[1].ride == Ride::rigid);
  CHECK(found[1].reach == Approx(0.005));  // of the sheet, not of the pocket
  Mesh belt = sheet_with(0.15, 0.02, 0.003);
  add_sheet(belt, 0.06, 0.06, 0.02, {0.08, 0.08, 0.006});  // a loop, which only the belt is within reach of
  REQUIRE(attached(belt).size() == 2);
  CHECK(attached(belt)[1].ride == Ride::by_place);
}

TEST_CASE(
    "find_attached: looks at where the garment was made, and rides stay with the faces of a finer mesh") {
  Mesh mesh = sheet_with(0.1, 0.02, 0.003);
  const auto made = ensure_map(mesh, attribute::rest_position);
  for (const Vertex v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    made[v] = {p.x(), p.y(), p.z()};
    if (p.z() > 0) mesh.point(v) = p + Vector(0, 0, 1);
  }
  const Parts parts = find_parts(mesh);
  set_rides(mesh, parts, find_attached(mesh, parts));
  loop_subdivide(mesh, 1);
  const std::vector<Ride> rides = rides_of(mesh);
  REQUIRE(rides.size() == mesh.number_of_faces());
  const Parts finer = find_parts(mesh);
  for (const Face f : mesh.faces())
    CHECK((rides[f.idx()] == Ride::by_place) == (finer.of_face[f.idx()] == 1));
  set_rides(mesh, finer, {});
  CHECK(rides_of(mesh).empty());
}
