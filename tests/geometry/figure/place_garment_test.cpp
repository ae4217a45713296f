// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/place_garment.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "geometry/figure/shape_body.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "tests/geometry/figure/posed_figure.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

Mesh garment(const char* name) { return read_plain_obj(source_dir() / "meshes" / name); }

double apart(const Point& a, const Point& b) { return std::sqrt((a - b).squared_length()); }

}  // namespace

TEST_CASE("place_garment: on the body that it was made for it stays where it is") {
  const Skeleton body = skeleton_of(our_mannequin());
  for (const char* name : {"shirt.obj", "skirt.obj"}) {
    const Mesh cloth = garment(name);
    const PlacedGarment placed = place_garment(cloth, body, body);
    REQUIRE(placed.points.size() == cloth.num_vertices());
    for (const Vertex v : cloth.vertices()) CHECK(apart(placed.points[v.idx()], cloth.point(v)) < 1e-12);
    CHECK(placed.farthest_move < 1e-12);
    CHECK(placed.height_scale == 1);
    CHECK(*placed.arm_turn[0] < 1e-7);
    CHECK(placed.leg_turn[1] < 1e-7);
  }
}

TEST_CASE("place_garment: on a larger body each place is the larger one, but for the ease, which stays") {
  const double by = 1.1;
  const Skeleton from = skeleton_of(our_mannequin()), to = skeleton_of(scaled(our_mannequin(), by));
  for (const char* name : {"shirt.obj", "skirt.obj"}) {
    const Mesh cloth = garment(name);
    const PlacedGarment placed = place_garment(cloth, from, to);
    CHECK(placed.height_scale == Approx(by));
    double farthest = 0;
    for (const Vertex v : cloth.vertices()) {
      const Point larger = CGAL::ORIGIN + by * (cloth.point(v) - CGAL::ORIGIN);
      farthest = std::max(farthest, apart(placed.points[v.idx()], larger));
    }
    CHECK(farthest < 0.03);  // a tenth of the skirt's flare
  }
}

TEST_CASE("place_garment: sleeves turn with the arms, and the trunk's cloth stays") {
  const double angle = 40 * std::numbers::pi / 180;
  const Skeleton from = skeleton_of(our_mannequin()),
                 to = skeleton_of(with_raised_arms(our_mannequin(), angle));
  const Mesh skin = our_mannequin();  // the tightest garment: where it goes is known
  const PlacedGarment placed = place_garment(skin, from, to);
  CHECK(*placed.arm_turn[0] == Approx(angle).margin(0.09));
  CHECK(placed.leg_turn[0] < 0.02);
  CHECK(placed.arm_share[0] > 0.05);
  CHECK(placed.arm_share[0] == Approx(placed.arm_share[1]).margin(0.02));
  int sleeve = 0, trunk = 0;
  double off_sleeve = 0, off_trunk = 0;
  for (const Vertex v : skin.vertices()) {
    const Point p = skin.point(v), q = placed.points[v.idx()];
    for (const auto& arm : from.arms) {
      const double along = (p - arm->rings.front().centre) * arm->axis;
      if (p.x() * arm->axis.x() <= 0 || along < 0.1 || along > arm->length || std::abs(p.x()) < 0.25)
        continue;
      off_sleeve = std::max(off_sleeve, apart(q, raised(*arm, angle, p)));
      ++sleeve;
    }
    if (std::abs(p.x()) > 0.1 || p.y() > from.armpits) continue;
    off_trunk = std::max(off_trunk, apart(p, q));
    ++trunk;
  }
  CHECK(sleeve > 300);
  CHECK(trunk > 1000);
  CHECK(off_sleeve < 0.04);  // on the shoulder, where trunk and arm blend
  CHECK(off_trunk < 0.02);
}

TEST_CASE("place_garment: neither the garment nor what it is at rest is changed") {
  Mesh wide = our_mannequin();
  shape_body(wide, {1.82, 1.05, 0.9, 1.1});
  Mesh shirt = garment("shirt.obj");
  auto rest = ensure_map(shirt, attribute::rest_length);
  for (const Edge e : shirt.edges()) rest[e] = 0.01 * double(e.idx() + 1);
  const Mesh before = shirt;
  const PlacedGarment placed = place_garment(shirt, skeleton_of(our_mannequin()), skeleton_of(wide));
  CHECK(placed.mean_move > 0.05);
  for (const Vertex v : shirt.vertices()) CHECK(shirt.point(v) == before.point(v));
  for (const Edge e : shirt.edges()) CHECK(rest[e] == 0.01 * double(e.idx() + 1));
}

TEST_CASE("place_garment: what cannot be placed is refused, and says why") {
  const Mesh shirt = garment("shirt.obj"), skirt = garment("skirt.obj");
  const Skeleton body = skeleton_of(our_mannequin());
  CHECK_THROWS_WITH(skeleton_of(icosphere(3, 0.8)), Catch::StartsWith("the body has no"));
  CHECK_THROWS_AS(place_garment(Mesh(), body, body), std::invalid_argument);
  Mesh turned = our_mannequin();
  for (const Vertex v : turned.vertices()) {
    const Point p = turned.point(v);
    turned.point(v) = {-p.x(), p.y(), -p.z()};
  }
  CHECK_THROWS_WITH(place_garment(shirt, body, skeleton_of(turned)), Catch::Contains("opposite ways"));
  Skeleton armless = body;
  armless.arms[1].reset();
  CHECK_THROWS_WITH(place_garment(our_mannequin(), body, armless), Catch::Contains("sleeve"));
  CHECK_FALSE(place_garment(skirt, body, armless).arm_turn[1]);
}
