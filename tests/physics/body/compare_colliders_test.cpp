// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/body/compare_colliders.h"

#include <catch2/catch.hpp>

#include "physics/body/depth_map_collider.h"
#include "physics/body/distance_field.h"
#include "tests/physics/body/field_inputs.h"

namespace {

using namespace furrow::physics;

/// The exact distance, off by `shift`, its sign turned where x > border.
struct Wrong : Collider {
  const ExactDistance& exact;
  double shift, border;
  Wrong(const ExactDistance& e, double s, double b = 1e9) : exact(e), shift(s), border(b) {}
  SignedDistance at(const Vec3& x) const override {
    SignedDistance d = exact.at(x);
    d.value += shift;
    if (x[0] > border) d.value = -d.value;
    return d;
  }
};

DepthMapOptions maps(DepthMaps which) {
  DepthMapOptions options;
  options.maps = which;
  return options;
}

/// A ball behind a plate: of the ball's lower front neither front, back nor top see anything.
TriangleMesh plate_before_ball() {
  TriangleMesh m = furrow::tests::sphere(30, 0.1);
  furrow::tests::append(m, furrow::tests::box({-0.2, -0.2, 0.14}, {0.2, 0.2, 0.15}));
  return m;
}

}  // namespace

TEST_CASE("compare_colliders: known errors are found as they are") {
  const TriangleMesh m = furrow::tests::sphere(30, 0.2);
  const ExactDistance exact(m);
  const ColliderComparison same = compare_colliders(exact, exact, m);
  CHECK(same.outside > 3500);  // 15 of 20 mm beyond the margin
  CHECK(same.inside > 3800);   // 8 of 10 mm
  CHECK(same.false_inside + same.false_outside == 0);
  CHECK(same.push_out.p99 == 0);
  CHECK(same.near.p99 == 0);
  CHECK(same.angle.p99 == 0);
  CHECK_FALSE(same.disagrees());

  const ColliderComparison high = compare_colliders(Wrong(exact, 5e-4), exact, m);
  CHECK(high.false_inside + high.false_outside == 0);
  CHECK(high.push_out.median == Approx(5e-4));
  CHECK(high.near.p99 == Approx(5e-4));
  CHECK(high.overestimate.median == Approx(5e-4));
  CHECK(compare_colliders(Wrong(exact, -5e-4), exact, m).overestimate.p99 == 0);

  const ColliderComparison half = compare_colliders(Wrong(exact, 0, 0), exact, m);
  CHECK(half.false_inside_share() == Approx(0.5).margin(0.05));
  CHECK(half.false_outside_share() == Approx(0.5).margin(0.05));
  CHECK(half.push_out.p99 == 0);  // of those that both call inside
  CHECK(half.disagrees());
}

TEST_CASE("compare_colliders: the same input gives the same answer, another seed other points") {
  const TriangleMesh m = furrow::tests::sphere(12, 0.2);
  const ExactDistance exact(m);
  const DepthMapCollider collider(m);
  CompareOptions options;
  options.points = 999;
  const ColliderComparison a = compare_colliders(collider, exact, m, options),
                           b = compare_colliders(collider, exact, m, options);
  CHECK(a.push_out.p95 == b.push_out.p95);
  CHECK(a.near.median == b.near.median);
  options.seed = 2;
  CHECK(compare_colliders(collider, exact, m, options).near.median != a.near.median);
}

TEST_CASE("compare_colliders: depth maps of a ball agree, those of a ball behind a plate do not",
          "[release]") {
  const TriangleMesh ball = furrow::tests::sphere(30, 0.2), hidden = plate_before_ball();
  const ExactDistance exact_ball(ball), exact_hidden(hidden);
  const auto test = [&](DepthMaps which, const TriangleMesh& m, const ExactDistance& exact) {
    return compare_colliders(DepthMapCollider(m, maps(which)), exact, m);
  };
  for (const DepthMaps which : {DepthMaps::front_back, DepthMaps::front_back_top, DepthMaps::six})
    CHECK_FALSE(test(which, ball, exact_ball).disagrees());
  const ColliderComparison two = test(DepthMaps::front_back, hidden, exact_hidden),
                           three = test(DepthMaps::front_back_top, hidden, exact_hidden),
                           six = test(DepthMaps::six, hidden, exact_hidden);
  CHECK(two.disagrees());
  CHECK(three.disagrees());
  CHECK_FALSE(six.disagrees());
  CHECK(two.false_inside > 2 * three.false_inside);
  CHECK(three.false_inside_share() > 0.01);
  CHECK(six.push_out.p95 < three.push_out.p95);
  CHECK_FALSE(compare_colliders(DistanceField::build(exact_hidden), exact_hidden, hidden).disagrees());
}

TEST_CASE("compare_colliders: bad options are refused by name") {
  const TriangleMesh m = furrow::tests::sphere(6, 0.2);
  const ExactDistance exact(m);
  const auto refuse = [&](const char* name, auto change) {
    CompareOptions options;
    change(options);
    CHECK_THROWS_WITH(compare_colliders(exact, exact, m, options), Catch::Contains(name));
  };
  refuse("points = 1", [](auto& o) { o.points = 1; });
  refuse("outside = ", [](auto& o) { o.outside = o.outside_margin; });
  refuse("inside = ", [](auto& o) { o.inside = -1; });
  refuse("inside_margin = ", [](auto& o) { o.inside_margin = -1; });
  refuse("near = ", [](auto& o) { o.near = 0; });
  CHECK_THROWS_AS(compare_colliders(exact, exact, TriangleMesh{}), std::invalid_argument);
}
