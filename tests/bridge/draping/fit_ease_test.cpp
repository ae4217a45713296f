// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/fit_ease.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "bridge/arrays/convert.h"
#include "bridge/draping/fit_report.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/property_names.h"
#include "tests/cases/posed_body.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::tests;

namespace {

struct MeasuredBody {
  std::vector<geometry::Point> points;
  std::vector<std::array<int, 3>> triangles;
  explicit MeasuredBody(const geometry::Mesh& mesh) : triangles(bridge::triangles_of(mesh)) {
    for (auto v : mesh.vertices()) points.push_back(mesh.point(v));
  }
  bridge::FitBody view() const { return {points, triangles, {}}; }
};

double ngon(double radius, int n) { return 2 * n * radius * std::sin(std::numbers::pi / n); }

geometry::Mesh moved(geometry::Mesh mesh, double x, double y) {
  for (auto v : mesh.vertices()) mesh.point(v) = mesh.point(v) + geometry::Vector(x, y, 0);
  return mesh;
}

/// A torso of radius 0.15 with arms of radius 0.05 at 0.35.
geometry::Mesh torso_with_arms() {
  geometry::Mesh figure = cylinder(0.15, 1.7, 64, 17);
  append(figure, moved(cylinder(0.05, 1.7, 32, 17), 0.35, 0));
  append(figure, moved(cylinder(0.05, 1.7, 32, 17), -0.35, 0));
  return figure;
}

}  // namespace

TEST_CASE("fit_ease: around a tube in a tube it is the difference of two polygons") {
  const MeasuredBody body(cylinder(0.15, 1.7, 64, 17));
  const geometry::Mesh garment = moved(cylinder(0.16, 0.6, 48, 6), 0, 0.8);  // from 0.8 to 1.4
  const auto ease = bridge::measure_ease(garment, body.view(), {1.3, 1.0, 0.7});
  REQUIRE(ease.size() == 3);
  for (int i : {0, 1}) {  // both at rings of vertices
    CHECK(*ease[i].body_girth == Approx(ngon(0.15, 64)).epsilon(1e-9));
    CHECK(*ease[i].garment_girth == Approx(ngon(0.16, 48)).epsilon(1e-9));
    CHECK(*ease[i].ease == Approx(ngon(0.16, 48) - ngon(0.15, 64)).epsilon(1e-6));
    CHECK_FALSE(ease[i].rest_girth);
    CHECK(ease[i].note.empty());
  }
  CHECK(ease[0].name == "chest");
  CHECK(ease[2].name == "hip");
  CHECK_FALSE(ease[2].garment_girth);
  CHECK(ease[2].body_girth);
  CHECK(ease[2].note.find("does not reach") != std::string::npos);
  CHECK(bridge::measure_ease(garment, body.view(), {}).empty());
  const auto above = bridge::measure_ease(garment, body.view(), {3.0, {}, {}});
  CHECK(above[0].note.find("no torso") != std::string::npos);
}

TEST_CASE("fit_ease: folds count for the garment, the tape measure goes over hollows of the body") {
  geometry::Mesh star = cylinder(0.15, 1.7, 64, 17), folds = cylinder(0.3, 1.7, 64, 17);
  for (auto* mesh : {&star, &folds})
    for (auto v : mesh->vertices())
      if (v.idx() % 2)
        mesh->point(v) = {0.9 * mesh->point(v).x(), mesh->point(v).y(), 0.9 * mesh->point(v).z()};
  const MeasuredBody body(star);
  const auto ease = bridge::measure_ease(folds, body.view(), {{}, 1.0, {}});
  REQUIRE(ease.size() == 1);
  CHECK(*ease[0].body_girth == Approx(ngon(0.15, 32)).epsilon(1e-9));
  const double r = 0.3, step = std::numbers::pi / 32;
  CHECK(*ease[0].garment_girth ==
        Approx(64 * std::hypot(0.9 * r * std::cos(step) - r, 0.9 * r * std::sin(step))).epsilon(1e-9));
}

TEST_CASE("fit_ease: the girth at rest is that of the cloth unstrained, here smaller than the body") {
  const MeasuredBody body(cylinder(0.15, 1.7, 64, 17));
  geometry::Mesh garment = cylinder(0.14, 1.7, 48, 17);
  auto rest = geometry::ensure_map(garment, geometry::attribute::rest_length);
  for (auto e : garment.edges()) rest[e] = geometry::spatial_length(garment, e);
  for (auto v : garment.vertices()) {
    const auto p = garment.point(v);
    garment.point(v) = {p.x() * 0.152 / 0.14, p.y() * 0.97, p.z() * 0.152 / 0.14};
  }
  for (double height : {1.0, 0.83, 0.511}) {
    const auto ease = bridge::measure_ease(garment, body.view(), {{}, height, {}});
    REQUIRE(ease[0].rest_girth);
    CHECK(*ease[0].rest_girth / *ease[0].garment_girth == Approx(0.14 / 0.152).epsilon(1e-9));
    CHECK(*ease[0].rest_ease < -0.05);
    CHECK(*ease[0].ease > 0.005);
  }
}

TEST_CASE("fit_ease: sleeves that have grown together with the chest are cut halfway to the arms") {
  // Gaps between torso and arms from 0.15 to 0.30, cut at 0.225.
  const MeasuredBody body(torso_with_arms());
  // A box-like garment around all: x from -0.5 to 0.5, z from -0.2 to 0.2, by a square tube.
  geometry::Mesh garment = cylinder(1, 1.7, 4, 17);
  for (auto v : garment.vertices()) {
    const auto p = garment.point(v);
    const double s = 1 / std::numbers::sqrt2;
    garment.point(v) = {0.5 * (p.x() - p.z()) * s / s, p.y(), 0.2 * (p.x() + p.z()) * s / s};
  }
  const auto ease = bridge::measure_ease(garment, body.view(), {1.0, {}, {}});
  REQUIRE(ease[0].garment_girth);
  CHECK(*ease[0].garment_girth == Approx(2 * 0.45 + 2 * 0.4).epsilon(1e-6));
  CHECK(*ease[0].body_girth == Approx(ngon(0.15, 64)).epsilon(1e-9));
}

TEST_CASE("fit_ease: where a sleeve ends at the section's height the chest is measured between the cuts") {
  // As above, but the square tube lacks the faces beyond x = 0.3: two open curves, front and back.
  const MeasuredBody body(torso_with_arms());
  geometry::Mesh sheets = grid(20, 4, 0.6, 1.7);
  for (auto v : sheets.vertices()) sheets.point(v) = sheets.point(v) + geometry::Vector(-0.3, 0, 0.2);
  const auto front_alone = bridge::measure_ease(sheets, body.view(), {1.0, {}, {}});
  CHECK_FALSE(front_alone[0].ease);  // an apron covers less than half
  geometry::Mesh back = grid(20, 4, 0.6, 1.7);
  for (auto v : back.vertices()) {
    const auto p = back.point(v);
    back.point(v) = {0.3 - p.x(), p.y(), -0.2};
  }
  append(sheets, back);
  const auto ease = bridge::measure_ease(sheets, body.view(), {1.0, {}, {}});
  REQUIRE(ease[0].garment_girth);
  CHECK(*ease[0].garment_girth == Approx(2 * 0.45 + 2 * 0.4).epsilon(1e-6));
}

TEST_CASE("fit_ease: where a section runs through sleeves the garment is measured below its armholes") {
  const MeasuredBody body(torso_with_arms());
  geometry::Mesh garment = cylinder(0.2, 0.898, 64, 9);       // the trunk, up to 0.898
  append(garment, moved(cylinder(0.5, 0.7, 64, 9), 0, 0.9));  // around the arms, too, from there on
  const auto ease = bridge::measure_ease(garment, body.view(), {1.0, 0.5, {}});
  REQUIRE(ease[0].ease);
  CHECK(*ease[0].garment_height == Approx(0.898 - 0.025).margin(1e-4));
  CHECK(*ease[0].ease == Approx(ngon(0.2, 64) - ngon(0.15, 64)).epsilon(1e-9));
  CAPTURE(ease[0].note);
  CHECK(ease[0].note.find("below its armholes, 12.7 cm lower") != std::string::npos);
  CHECK(ease[1].note.empty());
  CHECK(*ease[1].garment_height == 0.5);
}

TEST_CASE("fit_ease: a garment that flares is measured at the same ring of its cloth, however it hangs") {
  const MeasuredBody body(torso_with_arms());
  // A trunk that widens by 4 mm a centimetre to its hem, joined to what runs around the arms at its top.
  geometry::Mesh garment = cylinder(0.2, 0.6, 64, 60);
  for (auto v : garment.vertices()) {
    const auto p = garment.point(v);
    const double wider = 1 + 2 * (0.6 - p.y());
    garment.point(v) = {wider * p.x(), p.y() + 0.298, wider * p.z()};
  }
  append(garment, moved(cylinder(0.5, 0.7, 64, 9), 0, 0.9));
  double girth[2] = {};
  for (const int lower : {0, 1}) {
    const auto ease = bridge::measure_ease(moved(garment, 0, -0.013 * lower), body.view(), {1.0, {}, {}});
    REQUIRE(ease[0].garment_girth);
    girth[lower] = *ease[0].garment_girth;
    CHECK(girth[lower] == Approx(1.05 * ngon(0.2, 64)).margin(3e-4));
  }
  CHECK(girth[1] == Approx(girth[0]).margin(3e-4));
}

TEST_CASE("fit_ease: a garment that is open in front has no girth") {
  const MeasuredBody body(cylinder(0.15, 1.7, 64, 17));
  geometry::Mesh coat = cylinder(0.2, 1.7, 32, 17);
  std::vector<geometry::Face> front;
  for (auto f : coat.faces()) {
    double x = 0;
    for (auto v : coat.vertices_around_face(coat.halfedge(f))) x += coat.point(v).x() / 3;
    if (x > 0.19) front.push_back(f);
  }
  REQUIRE_FALSE(front.empty());
  std::vector<geometry::Point> points;
  std::vector<std::array<int, 3>> faces;
  for (auto v : coat.vertices()) points.push_back(coat.point(v));
  const auto all = bridge::triangles_of(coat);
  for (auto f : coat.faces())
    if (std::find(front.begin(), front.end(), f) == front.end()) faces.push_back(all[f.idx()]);
  const auto ease = bridge::measure_ease(mesh_of(points, faces), body.view(), {{}, 1.0, {}});
  CHECK_FALSE(ease[0].ease);
  CHECK(ease[0].note.find("does not close") != std::string::npos);
}

TEST_CASE("fit_ease: a mannequin in T-pose has the chest that it has with its arms down") {
  const geometry::Mesh standing = read_plain_obj(source_dir() / "meshes/mannequin.obj");
  physics::TriangleMesh down;
  for (auto v : standing.vertices()) {
    const auto& p = standing.point(v);
    down.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  down.triangles = bridge::triangles_of(standing);
  const auto chest = [](const physics::TriangleMesh& body) {
    std::vector<geometry::Point> points;
    for (const auto& p : body.vertices) points.emplace_back(p.x(), p.y(), p.z());
    double low = INFINITY, high = -INFINITY;
    for (const auto& p : points) low = std::min(low, p.y()), high = std::max(high, p.y());
    const auto levels = geometry::torso_levels(points, body.triangles);
    const auto heights = geometry::torso_heights(levels, low, high);
    REQUIRE(heights);
    const auto ease = bridge::measure_ease(cylinder(0.3, 1.7, 64, 17), {points, body.triangles, levels},
                                           {heights->chest, heights->waist, heights->hip});
    REQUIRE(ease.size() == 3);
    REQUIRE(ease[0].body_girth);
    return *ease[0].body_girth;
  };
  for (const double degrees : {0.0, 10.0, 20.0, 30.0}) {
    const cases::ArmPose pose = cases::a_pose(degrees);
    INFO(degrees);
    CHECK(chest(cases::posed(down, cases::mannequin_arm(), pose, pose)) == Approx(chest(down)).margin(0.02));
  }
}
