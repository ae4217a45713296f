// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/torso_levels.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/geometry/figure/triangle_soup.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

struct Soup : TriangleSoup {
  double low = INFINITY, high = -INFINITY;
  explicit Soup(const Mesh& mesh) : TriangleSoup(mesh) {
    for (const Point& p : points) {
      low = std::min(low, p.y());
      high = std::max(high, p.y());
    }
  }
};

/// A turned figure 1.7 m high with the radius given by the share of its height.
template <class Radius>
Mesh turned(const Radius& radius, double shift_x = 0) {
  Mesh mesh = cylinder(1, 1.7, 64, 400);
  for (Vertex v : mesh.vertices()) {
    const Point p = mesh.point(v);
    const double r = radius(p.y() / 1.7);
    mesh.point(v) = {shift_x + r * p.x(), p.y(), r * p.z()};
  }
  return mesh;
}

/// Widest at 0.5 and 0.73, narrow at 0.62.
double figure(double share) { return 0.13 + 0.03 * std::cos((share - 0.62) * 2 * std::numbers::pi / 0.23); }

}  // namespace

TEST_CASE(
    "torso_levels: the levels of a turned figure follow its radius, and chest, waist and hip are where they "
    "should") {
  const Soup body(turned(figure));
  const auto levels = torso_levels(body.points, body.triangles);
  REQUIRE(levels.size() == 91);  // from 40 to 85 % in steps of 0.5 %
  CHECK(levels.front().height == Approx(0.40 * 1.7));
  CHECK(levels.back().height == Approx(0.85 * 1.7));
  for (const TorsoLevel& level : levels)
    CHECK(level.girth ==
          Approx(128 * std::sin(std::numbers::pi / 64) * figure(level.height / 1.7)).epsilon(0.01));
}

TEST_CASE(
    "torso_levels: the waist is where the girth is least, chest and hip above and below where it is most") {
  const Soup body(turned([](double share) { return 0.26 - figure(share); }));  // narrow at 0.5 and 0.73
  const Soup hourglass(turned([](double s) { return 0.12 + 0.7 * (s - 0.6) * (s - 0.6); }));
  const auto levels = torso_levels(hourglass.points, hourglass.triangles);
  const auto heights = torso_heights(levels, hourglass.low, hourglass.high);
  REQUIRE(heights);
  CHECK(heights->waist == Approx(0.6 * 1.7).margin(0.0086));
  CHECK(heights->chest == Approx(0.78 * 1.7).margin(0.0086));
  CHECK(heights->hip == Approx(0.40 * 1.7).margin(0.0086));
  // The body with a belly has its least girth at the end of the range in which a waist is looked for.
  const auto belly = torso_heights(torso_levels(body.points, body.triangles), body.low, body.high);
  REQUIRE(belly);
  CHECK(belly->waist >= 0.545 * 1.7);
  CHECK(belly->waist <= 0.705 * 1.7);
  CHECK_FALSE(torso_heights({}, 0, 1));
}

TEST_CASE("torso_levels: arms that hang apart are others, and the torso ends where they grow together",
          "[long]") {
  Mesh figure_mesh = turned([](double) { return 0.15; });
  append(figure_mesh, turned([](double) { return 0.05; }, 0.4));
  append(figure_mesh, turned([](double) { return 0.05; }, -0.4));
  const Soup body(figure_mesh);
  const auto levels = torso_levels(body.points, body.triangles);
  REQUIRE(levels.size() == 91);
  const auto section = torso_section(body.points, body.triangles, levels, 1.0);
  REQUIRE(section);
  CHECK(section->others.size() == 2);
  CHECK(tape_measure(section->torso) == Approx(128 * std::sin(std::numbers::pi / 64) * 0.15));
  CHECK_FALSE(torso_section(body.points, body.triangles, levels, 2.0));
  // A sudden belt of arms at 0.75 ends the levels.
  const Soup fused(turned([](double s) { return s < 0.75 ? 0.15 : 0.2; }));
  const auto up_to_arms = torso_levels(fused.points, fused.triangles);
  REQUIRE_FALSE(up_to_arms.empty());
  CHECK(up_to_arms.back().height == Approx(0.75 * 1.7).margin(0.0086));
}

TEST_CASE("torso_levels: arms that are stretched out sideways are left out, where they begin to grow",
          "[long]") {
  for (const double growth : {0.05, 0.08, 0.12}) {  // of the breadth in a step, from 72 % of the height on
    const auto hourglass = [](double share) { return 0.12 + 0.7 * (share - 0.6) * (share - 0.6); };
    Mesh mesh = turned(hourglass);
    for (Vertex v : mesh.vertices()) {
      const Point p = mesh.point(v);
      const double steps = std::max(0.0, p.y() / 1.7 - 0.72) / 0.005;
      mesh.point(v) = {p.x() * std::min(8.0, std::pow(1 + growth, steps)), p.y(), p.z()};
    }
    const Soup body(mesh);
    const auto levels = torso_levels(body.points, body.triangles);
    INFO(growth);
    REQUIRE_FALSE(levels.empty());
    CHECK(levels.back().height == Approx(0.72 * 1.7).margin(0.0172));
    const auto heights = torso_heights(levels, body.low, body.high);
    REQUIRE(heights);
    const double girth =
        tape_measure(torso_section(body.points, body.triangles, levels, heights->chest)->torso);
    CHECK(girth == Approx(2 * std::numbers::pi * hourglass(0.72)).epsilon(0.03));
  }
}

TEST_CASE("torso_levels: what is no standing person has no levels") {
  const Soup ball(icosphere(3, 0.3));
  CHECK(torso_levels(ball.points, ball.triangles).empty());
  const Soup cone(turned([](double s) { return s < 0.65 ? 0.2 : 0.02; }));
  CHECK(torso_levels(cone.points, cone.triangles).empty());
}

TEST_CASE("torso_levels: of real bodies chest, waist and hip lie where a tailor would measure", "[long]") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  struct Case {
    const char* file;
    double chest, waist, hip;  // girths [m], read off once from a slicer of our own in another language
  };
  for (const Case& c : {Case{"pairs/mh_male/body.obj", 0.983, 0.747, 0.943},
                        Case{"pairs/mh_female/body.obj", 0.842, 0.653, 0.946},
                        Case{"bodies/gc_mean_all.obj", 1.024, 0.841, 1.038}}) {
    INFO(c.file);
    const Soup body(read_plain_obj(shared_dir() / "meshes" / c.file));
    const auto levels = torso_levels(body.points, body.triangles);
    const auto heights = torso_heights(levels, body.low, body.high);
    REQUIRE(heights);
    const double tall = body.high - body.low;
    CHECK((heights->chest - body.low) / tall == Approx(0.74).margin(0.02));
    CHECK((heights->waist - body.low) / tall == Approx(0.635).margin(0.02));
    CHECK((heights->hip - body.low) / tall == Approx(0.485).margin(0.015));
    CHECK((levels.front().height - body.low) / tall == Approx(0.47).margin(0.02));  // crotch
    CHECK((levels.back().height - body.low) / tall == Approx(0.755).margin(0.01));  // armpits
    const auto girth = [&](double height) {
      return tape_measure(torso_section(body.points, body.triangles, levels, height)->torso);
    };
    CHECK(girth(heights->chest) == Approx(c.chest).epsilon(0.01));
    CHECK(girth(heights->waist) == Approx(c.waist).epsilon(0.01));
    CHECK(girth(heights->hip) == Approx(c.hip).epsilon(0.01));
    CHECK(torso_section(body.points, body.triangles, levels, heights->chest)->others.size() == 2);
  }
}
