// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/follow_body.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "bridge/arrays/convert.h"
#include "tests/test_meshes.h"

using namespace furrow;
using physics::Vec3;

namespace {

constexpr double radius = 0.3;

physics::TriangleMesh ball() {
  const geometry::Mesh mesh = tests::icosphere(4, radius);
  return {bridge::positions_of(mesh), bridge::triangles_of(mesh)};
}

/// Each vertex by `share` of its place, where a bump of 10 cm about +x lets it.
std::vector<Vec3> growth(const physics::TriangleMesh& body, double share, bool bump) {
  std::vector<Vec3> moves;
  for (const Vec3& x : body.vertices) {
    const double off = (x - Vec3(radius, 0, 0)).norm() / 0.1;
    moves.emplace_back(share * (bump ? std::exp(-off * off) : 1) * x);
  }
  return moves;
}

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

}  // namespace

TEST_CASE(
    "follow_body: cloth on the skin goes as the skin does, and mixtures of shapes are mixtures of moves") {
  const physics::TriangleMesh body = ball();
  const geometry::Mesh garment = tests::icosphere(3, radius + 0.002);
  const bridge::BodyFollower follower(garment, body);
  const std::vector<Vec3> still(body.vertices.size(), Vec3::Zero()),
      to_side(body.vertices.size(), Vec3(0.1, 0.2, 0));
  CHECK(farthest(follower.follow(still), std::vector<Vec3>(garment.num_vertices(), Vec3::Zero())) < 1e-15);
  CHECK(farthest(follower.follow(to_side), std::vector<Vec3>(garment.num_vertices(), Vec3(0.1, 0.2, 0))) <
        1e-12);
  const std::vector<Vec3> larger = growth(body, 0.2, false), bump = growth(body, 0.3, true);
  const std::vector<Vec3> a = follower.follow(larger), b = follower.follow(bump);
  for (const geometry::Vertex v : garment.vertices()) {
    const Vec3 wanted = 0.2 / (1 + 0.002 / radius) * bridge::to_eigen(garment.point(v));
    CHECK((a[v] - wanted).norm() < 0.002);  // of 60 mm
  }
  std::vector<Vec3> both = larger, sum = a;
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = 0.5 * larger[i] + 0.25 * bump[i];
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = 0.5 * a[i] + 0.25 * b[i];
  CHECK(farthest(follower.follow(both), sum) < 1e-12);
}

TEST_CASE("follow_body: what comes through is pushed out, and what lay inside goes no deeper") {
  const physics::TriangleMesh body = ball();
  for (const double off : {0.003, -0.002}) {
    const geometry::Mesh garment =
        tests::icosphere(3, radius + off);  // its faces lie deeper than its vertices
    const bridge::BodyFollower follower(garment, body, {.reach = 0.05});
    const std::vector<Vec3> bump = growth(body, 0.3, true);
    std::vector<Vec3> moves = follower.follow(bump);
    const double before = follower.deepest(moves, bump);
    CHECK(before > 0.002);  // so wide a patch does not follow a bump
    follower.push_out(moves, bump);
    CHECK(follower.deepest(moves, bump) < 1e-4);
    const std::vector<Vec3> still(body.vertices.size(), Vec3::Zero());
    std::vector<Vec3> none(moves.size(), Vec3::Zero());
    follower.push_out(none, still);
    CHECK(farthest(none, std::vector<Vec3>(moves.size(), Vec3::Zero())) == 0);
    CHECK(follower.deepest(none, still) < 1e-12);
  }
}

TEST_CASE("follow_body: what cannot be is refused") {
  const geometry::Mesh garment = tests::icosphere(2, radius + 0.01);
  CHECK_THROWS_AS(bridge::BodyFollower(garment, ball(), {.reach = 0}), std::invalid_argument);
  CHECK_THROWS_AS(bridge::BodyFollower(garment, ball(), {.gap = -1}), std::invalid_argument);
  CHECK_THROWS_AS(bridge::BodyFollower(geometry::Mesh(), ball()), std::invalid_argument);
  CHECK_THROWS_AS(bridge::BodyFollower(garment, ball()).follow({}), std::invalid_argument);
}
