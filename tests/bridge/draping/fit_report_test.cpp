// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/fit_report.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bridge/arrays/convert.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/vertex_attributes.h"
#include "tests/bridge/test_body.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::tests;

namespace {

void set_rest(geometry::Mesh& mesh) {
  auto rest = geometry::ensure_map(mesh, geometry::attribute::rest_length);
  for (auto e : mesh.edges()) rest[e] = geometry::spatial_length(mesh, e);
}

geometry::Mesh tube(double radius, double from, double to) {
  geometry::Mesh mesh = cylinder(radius, to - from, 64, 40);
  for (auto v : mesh.vertices()) mesh.point(v) = mesh.point(v) + geometry::Vector(0, from, 0);
  return mesh;
}

const geometry::VertexMap<double> attribute(const geometry::Mesh& mesh, const std::string& name) {
  for (const auto& a : geometry::vertex_attributes(mesh))
    if (a.name == name) return a.values;
  throw std::logic_error("no attribute " + name);
}

}  // namespace

TEST_CASE("fit_report: a tube around a cylinder has the known distances, contact and ease") {
  const Body body(cylinder(0.15, 1.7, 64, 17));  // repair closes it
  geometry::Mesh garment = tube(0.17, 0.7, 1.3);
  const bridge::FitReport r = bridge::fit_report(garment, body.triangles, body.distance);
  CHECK_FALSE(r.strain);  // nobody told its rest
  CHECK(r.tight.empty());
  const double gap = 0.02 * std::cos(std::acos(-1.0) / 64);  // vertices of both lie on the same rays
  CHECK(r.distance.min == Approx(0.02).epsilon(0.01));
  CHECK(r.distance.min >= gap);
  CHECK(r.distance.median == Approx(r.distance.min).epsilon(1e-6));
  CHECK(r.distance.share_in_contact == 0);
  CHECK(r.distance.deepest_penetration == 0);
  CHECK(r.area == Approx(2 * 64 * 0.17 * std::sin(std::acos(-1.0) / 64) * 0.6).epsilon(1e-9));
  REQUIRE(r.ease.size() == 3);
  for (const bridge::FitEase& e : r.ease)
    if (e.ease) CHECK(*e.ease == Approx(128 * std::sin(std::acos(-1.0) / 64) * 0.02).epsilon(0.01));
  CHECK(r.ease[1].ease);  // the waist
  for (auto v : garment.vertices())
    CHECK(attribute(garment, "fit_distance")[v] == Approx(r.distance.min).epsilon(1e-6));
  CHECK_THROWS(attribute(garment, "strain"));
  bridge::FitOptions near;
  near.contact_distance = 0.021;
  near.loose_distance = 0.015;
  const bridge::FitReport n = bridge::fit_report(garment, body.triangles, body.distance, near);
  CHECK(n.distance.share_in_contact == Approx(1));
  REQUIRE(n.loose.size() == 1);
  CHECK(n.loose[0].area == Approx(n.area));
  CHECK(n.loose[0].side == "around");
  CHECK(n.loose[0].height_share == Approx(1.0 / 1.7).epsilon(1e-6));
}

TEST_CASE("fit_report: a garment stretched by 8 % around the waist is tight there and nowhere else") {
  const Body body(cylinder(0.15, 1.7, 64, 17));
  geometry::Mesh garment = tube(0.155, 0.6, 1.4);
  set_rest(garment);
  const auto in_belt = [](double y) { return y > 0.95 - 1e-9 && y < 1.15 + 1e-9; };
  for (auto v : garment.vertices())
    if (auto p = garment.point(v); in_belt(p.y())) garment.point(v) = {1.08 * p.x(), p.y(), 1.08 * p.z()};
  const bridge::FitReport r = bridge::fit_report(garment, body.triangles, body.distance);
  REQUIRE(r.strain);
  CHECK(r.strain->p50 == Approx(0).margin(1e-9));
  CHECK(r.strain->max >= 0.08 - 1e-9);
  CHECK(r.strain->unknown_faces == 0);
  CHECK(r.strain->share_over == Approx(0.2 / 0.8).epsilon(0.25));
  REQUIRE(r.tight.size() == 1);
  CHECK(r.tight[0].side == "around");
  CHECK(r.tight[0].centre.y() == Approx(1.05).margin(0.02));
  CHECK(r.tight[0].height_share == Approx(1.05 / 1.7).margin(0.012));
  CHECK(r.tight[0].peak > 0.08);  // at its edges the cloth is drawn outwards, too
  CHECK(r.tight[0].peak < 0.18);
  const auto strain = attribute(garment, "strain");
  for (auto v : garment.vertices()) {
    const double y = garment.point(v).y();
    if (y > 0.98 && y < 1.12) CHECK(strain[v] == Approx(0.08).epsilon(1e-6));
    if (y < 0.90 || y > 1.20) CHECK(strain[v] == Approx(0).margin(1e-9));
  }
  // The waist's ease is larger than at rest by what the cloth is stretched.
  bridge::FitOptions options;
  options.sections.waist = 1.05;
  const auto ease = bridge::fit_report(garment, body.triangles, body.distance, options).ease;
  CHECK(*ease[1].garment_girth / *ease[1].rest_girth == Approx(1.08).epsilon(1e-9));
}

TEST_CASE("fit_report: a bulge is loose on the side where it is, a dent lies inside the body") {
  const Body body(cylinder(0.15, 1.7, 64, 17));
  geometry::Mesh garment = tube(0.16, 0.6, 1.4);
  for (auto v : garment.vertices()) {
    const auto p = garment.point(v);
    if (p.z() > 0.08 && p.y() > 0.9 && p.y() < 1.1) garment.point(v) = {p.x(), p.y(), p.z() + 0.1};
    if (p.x() > 0.155 && p.y() > 0.9 && p.y() < 1.0) garment.point(v) = {p.x() - 0.03, p.y(), p.z()};
  }
  const bridge::FitReport r = bridge::fit_report(garment, body.triangles, body.distance);
  REQUIRE(r.loose.size() == 1);
  CHECK(r.loose[0].side == "front");
  CHECK(r.loose[0].peak == Approx(0.11).epsilon(0.05));
  CHECK(r.distance.vertices_inside > 5);
  CHECK(r.distance.deepest_penetration == Approx(0.02).epsilon(0.1));
  CHECK(r.distance.min == -r.distance.deepest_penetration);
}

TEST_CASE("fit_report: the same report twice, and to the same bits") {
  const Body body(icosphere(4, 0.9));
  geometry::Mesh a = icosphere(4, 0.95), b = a;
  set_rest(a);
  set_rest(b);
  const auto one = bridge::fit_report(a, body.triangles, body.distance);
  const auto two = bridge::fit_report(b, body.triangles, body.distance);
  CHECK(one.distance.median == two.distance.median);
  CHECK(one.strain->p99 == two.strain->p99);
  for (auto v : a.vertices()) CHECK(attribute(a, "fit_distance")[v] == attribute(b, "fit_distance")[v]);
}

TEST_CASE("fit_report: bad options and meshes are refused before anything is written") {
  const Body body(icosphere(2, 0.9));
  geometry::Mesh garment = icosphere(2, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  bridge::FitOptions o;
  const auto refused = [&](const char* name) {
    CHECK_THROWS_WITH(bridge::fit_report(garment, body.triangles, body.distance, o), Catch::Contains(name));
    o = {};
  };
  o.tight_strain = 0;
  refused("tight_strain");
  o.loose_distance = nan;
  refused("loose_distance");
  o.contact_distance = -1;
  refused("contact_distance");
  o.smallest_zone = -1;
  refused("smallest_zone");
  o.sections.hip = nan;
  refused("hip");
  CHECK(geometry::vertex_attributes(garment).empty());
  geometry::Mesh empty;
  CHECK_THROWS_AS(bridge::fit_report(empty, body.triangles, body.distance), geometry::ContentError);
  garment.point(geometry::Vertex(3)) = {nan, 0, 0};
  CHECK_THROWS_AS(bridge::fit_report(garment, body.triangles, body.distance), geometry::ContentError);
  CHECK(geometry::vertex_attributes(garment).empty());
}

TEST_CASE("fit_report: a real skirt on its body has exact distances, room at the hip, none at the chest",
          "[long]") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  const auto folder = shared_dir() / "meshes" / "pairs" / "mh_female";
  const Body body(read_plain_obj(folder / "body.obj"));
  geometry::Mesh skirt = read_plain_obj(folder / "skirt.obj");
  const bridge::FitReport r = bridge::fit_report(skirt, body.triangles, body.distance);
  // Distances of the vertices from another program (the manifest of the meshes): median 23 mm by count.
  CHECK(r.distance.min == Approx(-0.000912).margin(2e-5));
  CHECK(r.distance.vertices_inside == 4);
  REQUIRE(r.ease.size() == 3);
  CHECK(r.ease[0].note.find("does not reach") != std::string::npos);  // the chest
  CHECK(*r.ease[2].ease > 0);
  CHECK(*r.ease[2].ease < 0.1);
}
