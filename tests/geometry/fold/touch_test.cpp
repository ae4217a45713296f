// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/touch.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/rest_metric.h"
#include "tests/test_meshes.h"

namespace furrow::tests {
namespace {

using namespace geometry;

Touch touch_at(const Point& at, TouchKind kind, double radius, double strength = 1) {
  return {kind, at, radius, strength, {0, 0, 0}};
}

/// A sheet of a metre with waves of that length and height across it [m], at rest as it lies.
Mesh wavy_sheet(double length, double height, int cells = 80) {
  Mesh mesh = grid(cells, cells);
  lift(mesh, [&](double x, double) { return height * std::sin(2 * std::numbers::pi * (x - 0.5) / length); });
  ensure_rest_lengths(mesh);
  ensure_rest_angles(mesh);
  rebuild_bending_springs(mesh);
  return mesh;
}

void do_touch(Mesh& mesh, const Touch& touch) { apply_touch(mesh, touch, touch_weights(mesh, touch)); }

/// The highest of the cloth within so far of the middle [m].
double highest(const Mesh& mesh, double within) {
  double most = 0;
  for (const Vertex v : mesh.vertices())
    if (std::hypot(mesh.point(v).x() - 0.5, mesh.point(v).y() - 0.5) < within)
      most = std::max(most, std::abs(mesh.point(v).z()));
  return most;
}

bool all_triangles_proper(const Mesh& mesh) {
  const auto rest = find_map(mesh, attribute::rest_length).value();
  return std::all_of(mesh.faces().begin(), mesh.faces().end(),
                     [&](Face f) { return is_proper_triangle(rest_lengths_of(mesh, rest, f)); });
}

}  // namespace

TEST_CASE("touch: ironing takes out what is narrower than it, and leaves what is wider") {
  for (const auto& [length, least, most] :
       {std::array{0.06, 0.0, 0.05}, std::array{0.1, 0.0, 0.1}, std::array{1.0, 0.97, 1.02}}) {
    CAPTURE(length);
    Mesh mesh = wavy_sheet(length, 0.01);
    const double before = highest(mesh, 0.08);
    do_touch(mesh, touch_at({0.5, 0.5, 0}, TouchKind::iron, 0.2));
    CHECK(highest(mesh, 0.08) <= most * before);
    CHECK(highest(mesh, 0.08) >= least * before);
  }
}

TEST_CASE("touch: a tube that is ironed all over, again and again, keeps its breadth") {
  Mesh tube = cylinder(0.1, 0.6, 48, 40);
  ensure_rest_lengths(tube);
  for (int round = 0; round < 3; ++round)
    for (int i = 0; i < 12; ++i)
      for (const double y : {0.0, 0.15, 0.3, 0.45, 0.6}) {
        const double a = 2 * std::numbers::pi * i / 12;
        do_touch(tube, touch_at({0.1 * std::cos(a), y, 0.1 * std::sin(a)}, TouchKind::iron, 0.08));
      }
  for (const Point& p : tube.points()) CHECK(std::hypot(p.x(), p.z()) == Approx(0.1).epsilon(0.1));
}

TEST_CASE(
    "touch: what was ironed is as long and as bent at rest as it lies then, half as much at half strength") {
  Mesh whole = wavy_sheet(0.08, 0.01), half = whole;
  const Mesh before = whole;
  do_touch(whole, touch_at({0.5, 0.5, 0}, TouchKind::iron, 0.2));
  do_touch(half, touch_at({0.5, 0.5, 0}, TouchKind::iron, 0.2, 0.5));
  const auto rest = find_map(whole, attribute::rest_length).value();
  const auto angle = find_map(whole, attribute::rest_angle).value();
  for (const Edge e : whole.edges()) {
    CHECK(rest[e] == Approx(spatial_length(whole, e)).epsilon(1e-12));
    if (!whole.is_border(e)) CHECK(std::abs(angle[e] - dihedral_angle(whole, e)) < 1e-12);
  }
  for (const BendingSpring& s : bending_springs(whole))
    CHECK(s.rest_length ==
          Approx(std::sqrt(CGAL::squared_distance(whole.point(s.a), whole.point(s.b)))).epsilon(1e-12));
  for (const Vertex v : whole.vertices())
    CHECK((half.point(v) - before.point(v) - 0.5 * (whole.point(v) - before.point(v))).squared_length() <
          1e-24);
}

TEST_CASE("touch: ironing leaves a plane, strained cloth and what lies beyond the radius as they are") {
  Mesh plane = jittered(30, 30, 0.2, 7);
  ensure_rest_lengths(plane);
  const Mesh flat = plane;
  do_touch(plane, touch_at({0.5, 0.5, 0}, TouchKind::iron, 0.3));
  for (const Vertex v : plane.vertices()) CHECK((plane.point(v) - flat.point(v)).squared_length() < 1e-20);
  Mesh wavy = wavy_sheet(0.08, 0.01);
  auto rest = find_map(wavy, attribute::rest_length).value();
  for (const Edge e : wavy.edges()) rest[e] *= 0.98;
  const Mesh before = wavy;
  const Touch touch = touch_at({0.5, 0.5, 0}, TouchKind::iron, 0.15);
  do_touch(wavy, touch);
  const auto old = find_map(before, attribute::rest_length).value();
  for (const Edge e : wavy.edges()) CHECK(rest[e] == Approx(0.98 * spatial_length(wavy, e)).epsilon(1e-12));
  for (const Vertex v : wavy.vertices())
    if (CGAL::squared_distance(before.point(v), Point(touch.at)) > 0.15 * 0.15)
      CHECK(wavy.point(v) == before.point(v));
  for (const Edge e : wavy.edges()) {
    const auto far = [&](Vertex v) {
      return CGAL::squared_distance(before.point(v), Point(touch.at)) > 0.0225;
    };
    if (far(wavy.vertex(e, 0)) && far(wavy.vertex(e, 1))) CHECK(rest[e] == old[e]);
  }
}

TEST_CASE("touch: hinges that a fold bends are not bent to the other side where it is ironed") {
  Mesh mesh = wavy_sheet(0.08, 0.01);
  auto angle = find_map(mesh, attribute::rest_angle).value();
  for (const Edge e : mesh.edges()) angle[e] = 0;  // flat at rest, folded as it lies
  const Mesh before = mesh;
  do_touch(mesh, touch_at({0.5, 0.5, 0}, TouchKind::iron, 0.2));
  for (const Edge e : mesh.edges()) {
    if (mesh.is_border(e)) continue;
    const double bent = std::abs(dihedral_angle(mesh, e) - angle[e]),
                 was = std::abs(dihedral_angle(before, e));
    CHECK(bent <= was + 1e-12);
  }
}

TEST_CASE("touch: steam lets cloth keep its shape, as far as it is strong, and moves nothing") {
  Mesh mesh = wavy_sheet(0.2, 0.02, 40);
  auto rest = find_map(mesh, attribute::rest_length).value();
  auto angle = find_map(mesh, attribute::rest_angle).value();
  for (const Edge e : mesh.edges()) rest[e] *= 0.9, angle[e] = 0;
  const Mesh before = mesh;
  const Touch touch = touch_at({0.5, 0.5, 0}, TouchKind::steam, 0.3, 0.5);
  const std::vector<double> weights = touch_weights(mesh, touch);
  apply_touch(mesh, touch, weights);
  for (const Edge e : mesh.edges()) {
    const double share = 0.25 * (weights[mesh.vertex(e, 0).idx()] + weights[mesh.vertex(e, 1).idx()]);
    CHECK(rest[e] == Approx((0.9 + 0.1 * share) * spatial_length(mesh, e)).epsilon(1e-12));
    if (!mesh.is_border(e)) CHECK(std::abs(angle[e] - share * dihedral_angle(mesh, e)) < 1e-12);
  }
  CHECK(std::equal(mesh.points().begin(), mesh.points().end(), before.points().begin()));
}

TEST_CASE("touch: a pinch shortens cloth, most in the middle, and leaves every triangle its area") {
  Mesh mesh = wavy_sheet(10, 0, 40);
  do_touch(mesh, touch_at({0.5, 0.5, 0}, TouchKind::pinch, 0.3, 0.4));
  const auto rest = find_map(mesh, attribute::rest_length).value();
  for (const Edge e : mesh.edges()) {
    const double share = rest[e] / spatial_length(mesh, e);
    CHECK(share >= 0.6 - 1e-12);
    CHECK(share <= 1);
    const Point middle = CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)));
    if (CGAL::squared_distance(middle, Point(0.5, 0.5, 0)) < 0.01) CHECK(share == Approx(0.6));
  }
  for (const unsigned seed : {1u, 2u, 3u}) {
    Mesh thin = jittered(20, 20, 0.24, seed, 1, 0.1);
    ensure_rest_lengths(thin);
    do_touch(thin, touch_at({0.5, 0.05, 0}, TouchKind::pinch, 0.1, 1));
    CHECK(all_triangles_proper(thin));
  }
}

TEST_CASE("touch: a pull moves the middle by its whole way, or as much of it as it is strong") {
  Mesh mesh = wavy_sheet(10, 0, 40);
  Touch touch = touch_at({0.5, 0.5, 0}, TouchKind::pull, 0.2);
  touch.by = {0.01, 0, 0.03};
  const std::vector<double> weights = touch_weights(mesh, touch);
  const Mesh before = mesh;
  apply_touch(mesh, touch, weights);
  for (const Vertex v : mesh.vertices())
    CHECK((mesh.point(v) - before.point(v) - weights[v.idx()] * Vector(touch.by)).squared_length() < 1e-24);
  CHECK(*std::max_element(weights.begin(), weights.end()) == 1);
  Mesh half = before;
  touch.strength = 0.5;
  apply_touch(half, touch, weights);
  for (const Vertex v : half.vertices())
    CHECK((half.point(v) - before.point(v) - 0.5 * (mesh.point(v) - before.point(v))).squared_length() <
          1e-24);
}

TEST_CASE("touch: a sheet beside the touched one is left alone, and so are buttons") {
  Mesh mesh = grid(20, 20), other = grid(20, 20);
  for (const Vertex v : other.vertices()) other.point(v) = other.point(v) + Vector(0, 0, -0.005);
  const std::size_t first = mesh.number_of_vertices();
  append(mesh, other);
  const Touch touch = touch_at({0.5, 0.5, 0.001}, TouchKind::steam, 0.2);
  const std::vector<double> weights = touch_weights(mesh, touch);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const bool near =
        CGAL::squared_distance(mesh.point(Vertex(Vertex::size_type(i))), Point(touch.at)) < 0.039;
    CHECK((weights[i] > 0) == (i < first && near));
  }
  auto rides = ensure_map(mesh, attribute::rides);
  for (const Face f : mesh.faces()) rides[f] = f.idx() < mesh.number_of_faces() / 2;
  const std::vector<double> below = touch_weights(mesh, touch);
  CHECK(std::all_of(below.begin(), below.begin() + std::ptrdiff_t(first), [](double w) { return w == 0; }));
  CHECK(below[first + 20 * 10] >= 0);
  CHECK(*std::max_element(below.begin(), below.end()) == 1);
}

TEST_CASE("touch: what cannot be is refused, and the mesh stays") {
  Mesh mesh = grid(5, 5);
  const auto refused = [&](Touch touch) {
    CHECK_THROWS_AS(touch_weights(mesh, touch), std::invalid_argument);
  };
  refused(touch_at({0.5, 0.5, 0}, TouchKind::iron, 0));
  refused(touch_at({0.5, 0.5, 0}, TouchKind::iron, -1));
  refused(touch_at({0.5, 0.5, 0}, TouchKind::iron, 0.3, 0));
  refused(touch_at({0.5, 0.5, 0}, TouchKind::iron, 0.3, 1.5));
  refused(touch_at({0.5, 0.5, 0}, TouchKind::iron, std::numeric_limits<double>::infinity()));
  refused(touch_at({0.5, 0.5, 2}, TouchKind::iron, 0.3));
  const Touch good = touch_at({0.5, 0.5, 0}, TouchKind::pinch, 0.3);
  CHECK_THROWS_AS(apply_touch(mesh, good, {1, 0}), std::invalid_argument);
  CHECK_FALSE(find_map(mesh, attribute::rest_length));
}

TEST_CASE("touch: three hundred random touches leave sound cloth, and the same again") {
  const auto all = [] {
    std::mt19937 random(58);
    const auto in = [&](double low, double high) {
      return low + (high - low) * double(random()) / 4294967295.0;
    };
    Mesh mesh = jittered(24, 24, 0.2, 3);
    lift(mesh, [](double x, double y) { return 0.03 * std::sin(9 * x) * std::cos(7 * y); });
    ensure_rest_lengths(mesh);
    ensure_rest_angles(mesh);
    rebuild_bending_springs(mesh);
    for (int i = 0; i < 300; ++i) {
      Touch touch = touch_at({in(0, 1), in(0, 1), 0}, TouchKind(random() % 4), in(0.05, 0.4), in(0.05, 1));
      if (touch.kind == TouchKind::pinch) touch.strength *= 0.2;
      touch.by = {in(-0.02, 0.02), in(-0.02, 0.02), in(-0.05, 0.05)};
      try {
        do_touch(mesh, touch);
      } catch (const std::invalid_argument&) {
      }  // the cloth has been moved away from there
    }
    return mesh;
  };
  const Mesh mesh = all(), again = all();
  CHECK(std::equal(mesh.points().begin(), mesh.points().end(), again.points().begin()));
  for (const Vertex v : mesh.vertices())
    for (int k = 0; k < 3; ++k) CHECK(std::isfinite(mesh.point(v)[k]));
  const auto rest = find_map(mesh, attribute::rest_length).value();
  const auto angle = find_map(mesh, attribute::rest_angle).value();
  for (const Edge e : mesh.edges()) {
    CHECK(rest[e] > 0);
    if (!mesh.is_border(e)) CHECK(std::abs(angle[e]) <= std::numbers::pi);
  }
  for (const BendingSpring& s : bending_springs(mesh)) CHECK(s.rest_length > 0);
}

}  // namespace furrow::tests
