// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/ends_on_cloth.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/figure/attached_parts.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "geometry/mesh/struts.h"
#include "geometry/refine/subdivide.h"

using namespace furrow::geometry;

namespace {

/// A sheet, and one of its own above it.
Mesh two_sheets(double width, double off) {
  Mesh mesh = equilateral_sheet(0.4, 0.4, 0.02);
  const Mesh upper = equilateral_sheet(width, width, 0.02);
  std::vector<Vertex> now;
  for (const Vertex v : upper.vertices())
    now.push_back(mesh.add_vertex(upper.point(v) + Vector(0.05, 0.05, off)));
  for (const Face f : upper.faces()) {
    std::vector<Vertex> corners;
    for (const Vertex v : upper.vertices_around_face(upper.halfedge(f))) corners.push_back(now[v.idx()]);
    mesh.add_face(corners);
  }
  return mesh;
}

/// A strip along x of the length [m], wound about the y-axis once and as much farther as it is longer than
/// that; each turn lies `off` outside the one before.
Mesh wound(double length, double height, double off) {
  constexpr double radius = 0.1;
  Mesh mesh = equilateral_sheet(length, height, 0.012);
  for (const Vertex v : mesh.vertices()) {
    const Point p = mesh.point(v);
    const double angle = p.x() / radius, r = radius + off * angle / (2 * M_PI);
    mesh.point(v) = Point(r * std::cos(angle), p.y(), r * std::sin(angle));
  }
  return mesh;
}

/// The vertices of both ends of a wound strip, upwards.
std::array<std::vector<Vertex>, 2> ends_of(const Mesh& strip) {
  std::array<std::vector<Vertex>, 2> ends;
  for (const Vertex v : strip.vertices())
    if (const double z = strip.point(v).z(); strip.point(v).x() < -0.09 && std::abs(z) < 0.0011)
      ends[z > 0].push_back(v);
  for (auto& end : ends)
    std::sort(end.begin(), end.end(),
              [&](Vertex a, Vertex b) { return strip.point(a).y() < strip.point(b).y(); });
  return ends;
}

constexpr double once = 0.2 * M_PI;  // [m] around

}  // namespace

TEST_CASE("find_ends_on_cloth: a front that is wrapped over another one is an end, and so is the one below") {
  const Mesh wrapped = wound(once + 0.05, 0.2, 0.002);
  const auto ends = find_ends_on_cloth(wrapped);
  REQUIRE(ends.size() > 20);
  for (const EndOnCloth& end : ends) {
    CHECK(wrapped.is_border(end.vertex));
    CHECK(end.distance == Approx(0.002).margin(5e-4));
  }
  CHECK(find_ends_on_cloth(wound(once + 0.05, 0.2, 0.006)).empty());  // too far off
  CHECK(find_ends_on_cloth(wound(once - 0.05, 0.2, 0.002)).empty());  // it does not reach
}

TEST_CASE("find_ends_on_cloth: ends that meet are tied, sides of a slit are not") {
  const Mesh strap = wound(once - 0.001, 0.05, 0);
  CHECK(find_ends_on_cloth(strap).size() == 2 * 6);
  Mesh slit = strap;  // it meets at its top
  const auto [left, right] = ends_of(slit);
  REQUIRE(left.size() == right.size());
  const std::size_t n = left.size();
  const Face a = slit.add_face(left[n - 1], right[n - 1], right[n - 2]);
  const Face b = slit.add_face(left[n - 1], right[n - 2], left[n - 2]);
  REQUIRE(a != Mesh::null_face());
  REQUIRE(b != Mesh::null_face());
  CHECK(find_ends_on_cloth(slit).empty());
  CHECK(find_ends_on_cloth(wound(once - 0.006, 0.05, 0)).empty());
}

TEST_CASE("find_ends_on_cloth: the rim of a small part that is cloth is tied, a layer and a rider are not") {
  Mesh mesh = two_sheets(0.1, 0.003);
  const auto rim = find_ends_on_cloth(mesh);
  REQUIRE(!rim.empty());
  const Parts parts = find_parts(mesh);
  std::size_t border = 0;
  for (const Vertex v : mesh.vertices()) border += parts.of_vertex[v.idx()] == 1 && mesh.is_border(v);
  CHECK(rim.size() == border);
  CHECK(find_ends_on_cloth(two_sheets(0.28, 0.003)).empty());
  CHECK(find_ends_on_cloth(two_sheets(0.1, 5e-5)).empty());  // a seam
  Mesh rides = mesh;
  set_rides(rides, parts, find_attached(rides, parts));
  CHECK(find_ends_on_cloth(rides).empty());
  tie_ends(mesh, rim, 100);
  CHECK(struts(mesh).size() == 3 * rim.size());
  for (const Strut& s : struts(mesh)) {
    CHECK(parts.of_vertex[s.a.idx()] != parts.of_vertex[s.b.idx()]);
    CHECK(s.rest_length == Approx(std::sqrt(CGAL::squared_distance(mesh.point(s.a), mesh.point(s.b)))));
    CHECK(s.stiffness == 100);
  }
  CHECK(find_ends_on_cloth(mesh).empty());  // tied already
}

TEST_CASE("find_ends_on_cloth: places are those of the garment as it was made") {
  Mesh mesh = two_sheets(0.1, 0.003);
  const auto before = find_ends_on_cloth(mesh);
  const auto rest = ensure_map(mesh, attribute::rest_position);
  for (const Vertex v : mesh.vertices()) {
    rest[v] = {mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()};
    mesh.point(v) = Point(mesh.point(v).x(), mesh.point(v).y(), 50 * mesh.point(v).z());
  }
  const auto after = find_ends_on_cloth(mesh);
  REQUIRE(after.size() == before.size());
  for (std::size_t i = 0; i < after.size(); ++i) CHECK(after[i].face == before[i].face);
  loop_subdivide(mesh, 1);
  CHECK(find_ends_on_cloth(mesh).size() > before.size());  // one level finer
}
