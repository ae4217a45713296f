// SPDX-License-Identifier: GPL-3.0-or-later
#include <rapidcheck.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "physics/body/exact_distance.h"
#include "physics/body/moving_body.h"
#include "physics/body/triangle_bvh.h"
#include "tests/physics/body/field_inputs.h"

namespace {

using namespace furrow::physics;
using furrow::tests::uniform;

/// Two balls, which overlap where `apart` is below 2.
TriangleMesh balls(double apart) {
  TriangleMesh m = furrow::tests::sphere(12, 1), other = furrow::tests::sphere(9, 1, {apart, 0, 0});
  const int n = int(m.vertices.size());
  m.vertices.insert(m.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) m.triangles.push_back({n + a, n + b, n + c});
  return m;
}

/// A smooth bend and swirl of the whole and a little noise of each vertex.
void deform(TriangleMesh& m, std::mt19937_64& random, double how_much) {
  const double bend = how_much * uniform(random, -1, 1), swirl = how_much * uniform(random, -2, 2);
  for (Vec3& x : m.vertices) {
    const double angle = swirl * x.y(), c = std::cos(angle), s = std::sin(angle);
    x = Vec3(c * x.x() - s * x.z(), x.y() + bend * x.x() * x.x(), s * x.x() + c * x.z());
    x += 0.01 * how_much * Vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
  }
}

Vec3 anywhere(std::mt19937_64& random, const TriangleMesh& m) {
  const Vec3 reach(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
  return m.vertices[random() % m.vertices.size()] + std::pow(10, uniform(random, -4, 0)) * reach;
}

/// Holds the answers of `moved` against those of a body that is built anew.
bool same_answers(const ExactDistance& moved, const TriangleMesh& m, std::mt19937_64& random) {
  const ExactDistance fresh(m);
  for (int i = 0; i < 60; ++i) {
    const Vec3 x = anywhere(random, m);
    const SignedDistance a = moved.at(x), b = fresh.at(x);
    const double guessed = moved.at(x, int(random() % m.triangles.size())).value;
    if (std::abs(a.value - b.value) > 1e-12 || std::abs(guessed - b.value) > 1e-12) return false;
  }
  const SignReport &a = moved.report(), &b = fresh.report();
  return a.closed == b.closed && a.border_edges == b.border_edges &&
         a.dropped_triangles == b.dropped_triangles && a.crossed_triangles == b.crossed_triangles &&
         a.signed_volume == b.signed_volume && (a.rule == SignRule::winding) == (b.rule == SignRule::winding);
}

}  // namespace

TEST_CASE("moved_distance: a body that was moved answers as one that is built anew") {
  CHECK(rc::check([] {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    const TriangleMesh start = *rc::gen::element(balls(3), balls(1.2), furrow::tests::sphere(14, 0.5));
    const ExactDistance model(start);
    std::optional<ExactDistance> last;
    for (int frame = 0; frame < 3; ++frame) {
      TriangleMesh m = start;
      deform(m, random, uniform(random, 0, 1.5));
      last = model.moved(m, std::move(last));
      RC_ASSERT(same_answers(*last, m, random));
    }
  }));
}

TEST_CASE("moved_distance: parts that come into each other, and out again, are told from each other") {
  const TriangleMesh apart = balls(3), together = balls(1.2);
  std::mt19937_64 random(5);
  const ExactDistance model(apart), inside(together);
  const ExactDistance moved = model.moved(together);
  CHECK(moved.report().crossed_triangles > 10);
  CHECK(moved.report().dropped_triangles > 10);
  CHECK(same_answers(moved, together, random));
  CHECK(same_answers(inside.moved(apart), apart, random));
  CHECK(inside.moved(apart).report().dropped_triangles == 0);
  CHECK(moved.at({0.6, 0, 0}).value < -0.5);  // in both: no inner wall counts
}

TEST_CASE("moved_distance: a body with a hole, and a seam that opens, are told as if built anew") {
  TriangleMesh open = furrow::tests::sphere(14, 0.5);
  open.triangles.resize(open.triangles.size() - 9);
  std::mt19937_64 random(6);
  const ExactDistance model(open);
  TriangleMesh m = open;
  deform(m, random, 1);
  CHECK(same_answers(model.moved(m), m, random));
  TriangleMesh soup;  // closed as long as corners at one place stay there
  const TriangleMesh ball = furrow::tests::sphere(10, 0.5);
  for (const auto& t : ball.triangles) {
    const int first = int(soup.vertices.size());
    for (const int v : t) soup.vertices.push_back(ball.vertices[std::size_t(v)]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const ExactDistance closed(soup);
  REQUIRE(closed.report().closed);
  TriangleMesh torn = soup;
  torn.vertices[0] += Vec3(1e-3, 0, 0);
  CHECK_FALSE(closed.moved(torn).report().closed);
  CHECK(same_answers(closed.moved(torn), torn, random));
  CHECK(ExactDistance(torn).moved(soup).report().closed);
}

TEST_CASE("moved_distance: boxes are told to be loose once their triangles have moved apart") {
  TriangleMesh start = furrow::tests::sphere(30, 1), end = start;
  std::mt19937_64 random(7);
  std::shuffle(end.vertices.begin(), end.vertices.end(),
               random);  // each triangle reaches over all of the body
  TriangleBvh tree(start);
  const double before = tree.surface_of_boxes();
  tree.move(end);
  CHECK(tree.surface_of_boxes() > 2 * before);
  CHECK(same_answers(ExactDistance(end).moved(start), start, random));
  TriangleBvh back(end);
  back.move(start);
  CHECK(back.surface_of_boxes() > 2 * before);
  const auto looked_at = [&](const TriangleBvh& bvh) {
    std::int64_t leaves = 0;
    std::mt19937_64 same(8);
    for (int i = 0; i < 200; ++i) bvh.closest(anywhere(same, start), 0, &leaves);
    return leaves;
  };
  CHECK(looked_at(back) > 2 * looked_at(TriangleBvh(start)));
}

TEST_CASE("moved_distance: another number of triangles, or a vertex that is no number, is refused") {
  const TriangleMesh m = furrow::tests::sphere(6, 1);
  const ExactDistance model(m);
  TriangleMesh less = m, broken = m;
  less.triangles.pop_back();
  broken.vertices[2].x() = std::nan("");
  CHECK_THROWS_WITH(model.moved(less), Catch::Contains("triangles instead of"));
  CHECK_THROWS_AS(model.moved(broken), std::invalid_argument);
  CHECK(model.at({0, 0, 0}).value < -0.8);
}

TEST_CASE("moved_distance: copies that share an answer keep it when its memory is offered") {
  const TriangleMesh m = furrow::tests::sphere(8, 1), small = furrow::tests::sphere(8, 0.5);
  const ExactDistance model(m);
  std::optional<ExactDistance> over = model.moved(small);
  const ExactDistance copy = *over;
  const ExactDistance next = model.moved(m, std::move(over));
  CHECK(copy.at({0.75, 0, 0}).value > 0.2);
  CHECK(next.at({0.75, 0, 0}).value < -0.2);
}

TEST_CASE("moved_distance: at a frame's time a body that changes its shape has the exact distance") {
  const TriangleMesh start = balls(1.7);
  std::mt19937_64 random(9);
  std::vector<TriangleMesh> shapes(4, start);
  for (int i = 1; i < 4; ++i) deform(shapes[std::size_t(i)], random, 0.3);
  const auto frames = [&] {
    return AnimatedBody(
        {start.triangles, {0, 1, 2, 3}, [&](int i) { return shapes[std::size_t(i)].vertices; }});
  };
  AnimatedBody whole = frames(), late = frames();
  for (const double t : {0.0, 1.0, 2.0, 3.0}) {
    whole.prepare(t, t);
    const ExactDistance exact(shapes[std::size_t(t)]);
    for (int i = 0; i < 200; ++i) {
      const Vec3 x = anywhere(random, shapes[std::size_t(t)]);
      CHECK(std::abs(whole.at(x).value - exact.at(x).value) < 1e-12);
    }
  }
  CHECK(whole.frames_built() == 4);
  whole.prepare(2.3, 2.3);
  late.prepare(2.3, 2.3);  // as after a resume: earlier frames were never reached
  CHECK(late.frames_built() == 2);
  for (int i = 0; i < 200; ++i) {
    const Vec3 x = anywhere(random, start);
    const SignedDistance a = whole.at(x), b = late.at(x), c = late.at(x, late.beside(x));
    CHECK(a.value == b.value);
    CHECK(a.gradient == b.gradient);
    CHECK(a.value == c.value);
  }
}
