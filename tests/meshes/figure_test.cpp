// SPDX-License-Identifier: GPL-3.0-or-later
// The committed mannequin and its clothes are what meshes/README.md says. That make_meshes writes them is the
// test `made_meshes` of CTest.
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/self_intersections.h"
#include "geometry/rest/rest_state.h"
#include "io/stroke/stroke_file.h"
#include "physics/body/exact_distance.h"
#include "tests/cases/safe_rule.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

namespace furrow::tests {

using namespace geometry;

namespace {

Mesh committed(const std::string& name) { return read_plain_obj(source_dir() / "meshes" / name); }

physics::TriangleMesh arrays(const Mesh& mesh) {
  physics::TriangleMesh out;
  for (Vertex v : mesh.vertices())
    out.vertices.emplace_back(mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z());
  for (Face f : mesh.faces()) {
    const Halfedge h = mesh.halfedge(f);
    out.triangles.push_back({static_cast<int>(mesh.source(h)), static_cast<int>(mesh.target(h)),
                             static_cast<int>(mesh.target(mesh.next(h)))});
  }
  return out;
}

/// Length of a tape around the trunk at that height [m]; the arms are farther out than 0.17 m + what hangs
/// there.
double girth(const Mesh& body, double y) {
  std::vector<Kernel::Point_2> cut, hull;
  for (Edge e : body.edges()) {
    const Point &a = body.point(body.vertex(e, 0)), &b = body.point(body.vertex(e, 1));
    if ((a.y() < y) == (b.y() < y)) continue;
    const Point p = a + (y - a.y()) / (b.y() - a.y()) * (b - a);
    if (std::abs(p.x()) < 0.185) cut.emplace_back(p.x(), p.z());
  }
  CGAL::convex_hull_2(cut.begin(), cut.end(), std::back_inserter(hull));
  double length = 0;
  for (std::size_t i = 0; i < hull.size(); ++i)
    length += std::sqrt(CGAL::squared_distance(hull[i], hull[(i + 1) % hull.size()]));
  return length;
}

/// Smallest distance between the two surfaces, seen from vertices, edges' and faces' middles of both [m];
/// what lies inside the body is negative.
double clearance(const Mesh& garment, const Mesh& body) {
  const physics::ExactDistance to_body(arrays(body)), to_garment(arrays(garment));
  double least = 1;
  const auto see = [&](const Point& p) { least = std::min(least, to_body.at({p.x(), p.y(), p.z()}).value); };
  for (Vertex v : garment.vertices()) see(garment.point(v));
  for (Edge e : garment.edges())
    see(CGAL::midpoint(garment.point(garment.vertex(e, 0)), garment.point(garment.vertex(e, 1))));
  for (Vertex v : body.vertices()) {
    const Point& p = body.point(v);
    const physics::Vec3 x(p.x(), p.y(), p.z());
    least = std::min(least, std::sqrt(to_garment.closest(x).squared_distance));
  }
  return least;
}

void check_garment(const Mesh& mesh, std::size_t loops, double edge) {
  const MeshInfo info = measure(mesh);
  CHECK(info.manifold);
  CHECK(info.components == 1);
  CHECK(info.isolated_vertices == 0);
  CHECK(info.boundary_loops == loops);
  CHECK(info.mean_edge_length == Approx(edge).epsilon(0.1));
  CHECK(info.min_angle_deg >= 20);
  CHECK(count_self_intersections(mesh) == 0);
  CHECK(clearance(mesh, committed("mannequin.obj")) >= 0.004);
}

/// > 0 if the faces wind outward, for a garment around the y axis.
double outwardness(const Mesh& mesh) {
  double sum = 0;
  for (Face f : mesh.faces()) {
    const Halfedge h = mesh.halfedge(f);
    const Point &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h)),
                &c = mesh.point(mesh.target(mesh.next(h)));
    sum += CGAL::cross_product(b - a, c - a) * Vector(a.x(), 0, a.z());
  }
  return sum;
}

}  // namespace

TEST_CASE("meshes: the mannequin is one closed solid of 1.70 m that stands on the ground") {
  const Mesh mesh = committed("mannequin.obj");
  const MeshInfo info = measure(mesh);
  CHECK(info.closed);
  CHECK(info.manifold);
  CHECK(info.components == 1);
  CHECK(info.euler_characteristic == 2);
  CHECK(info.faces > 8000);
  CHECK(info.faces < 15000);
  CHECK(info.min_angle_deg >= 20);
  CHECK(info.volume.value() > 0.050);  // of 1 kg a litre: a woman of 50 to 65 kg
  CHECK(info.volume.value() < 0.065);
  CHECK(count_self_intersections(mesh) == 0);
  CHECK(info.box_min.y() == 0);
  CHECK(info.box_max.y() == Approx(1.70).margin(0.002));
  CHECK(info.box_max.x() == Approx(-info.box_min.x()).margin(0.005));
}

TEST_CASE("meshes: the mannequin has the girths of a woman") {
  const Mesh mesh = committed("mannequin.obj");
  const auto extreme = [&](double from, double to, bool largest) {
    double value = girth(mesh, from);
    for (double y = from; y < to; y += 0.01)
      value = largest ? std::max(value, girth(mesh, y)) : std::min(value, girth(mesh, y));
    return value;
  };
  CHECK(extreme(1.20, 1.245, true) == Approx(0.88).margin(0.015));  // chest
  CHECK(extreme(1.00, 1.15, false) == Approx(0.68).margin(0.015));  // waist
  CHECK(extreme(0.80, 0.95, true) == Approx(0.95).margin(0.015));   // hip
}

TEST_CASE("meshes: the shirt has four openings and even triangles, and leaves the mannequin everywhere") {
  const Mesh mesh = committed("shirt.obj");
  check_garment(mesh, 4, 0.013);
  CHECK(outwardness(mesh) > 0);
}

TEST_CASE("meshes: the skirt has two openings and even triangles, and leaves the mannequin everywhere") {
  const Mesh mesh = committed("skirt.obj");
  check_garment(mesh, 2, 0.020);
  CHECK(outwardness(mesh) > 0);
  const std::vector<BorderLoop> loops = border_loops(mesh);
  for (Vertex v : loops.at(find_border_loop(loops, "top")).vertices) CHECK(mesh.point(v).y() == 1.055);
  for (Vertex v : loops.at(find_border_loop(loops, "bottom")).vertices) CHECK(mesh.point(v).y() == 0.49);
}

TEST_CASE("meshes: the lines for the sheet, the skirt and the shirt are drawn whole on sound meshes") {
  const auto [garment, strokes, count] =
      GENERATE(table<std::string, std::string, std::size_t>({{"sheet.obj", "round_bulge.json", 3},
                                                             {"skirt.obj", "figure_skirt.json", 10},
                                                             {"shirt.obj", "figure_shirt_left.json", 1},
                                                             {"shirt.obj", "figure_shirt_right.json", 1}}));
  CAPTURE(strokes);
  Mesh mesh = committed(garment);
  const WrinkleReport report = wrinkle(mesh, io::read_strokes(source_dir() / "meshes" / "strokes" / strokes),
                                       furrow::tests::safe_rule());
  REQUIRE(report.lines.size() == count);
  CHECK(report.insertion.max_deviation < 0.01);
  const RestMetricAudit audit = audit_rest_metric(mesh);
  CHECK(audit.inverted_faces == 0);
  CHECK(audit.min_angle_deg >= 8);
}

}  // namespace furrow::tests
