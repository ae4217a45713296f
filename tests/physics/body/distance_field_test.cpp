// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/body/distance_field.h"

#include <rapidcheck.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "tests/physics/body/field_inputs.h"
#include "tests/test_paths.h"

namespace {

using namespace furrow::physics;
using furrow::tests::on_surface;
using furrow::tests::uniform;

DistanceFieldOptions with_tolerance(double tolerance) {
  DistanceFieldOptions options;
  options.tolerance = tolerance;
  return options;
}

Vec3 random_direction(std::mt19937_64& random) {
  Vec3 v;
  do v = {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
  while (v.norm() > 1 || v.norm() < 0.1);
  return v.normalized();
}

/// Largest jump of the value across planes of the finest lattice, at random points of the cube.
double largest_jump(const DistanceField& field, int points) {
  std::mt19937_64 random(11);
  double largest = 0;
  const double unit = field.size() / 1024;
  for (int i = 0; i < points; ++i) {
    Vec3 x;
    for (int k = 0; k < 3; ++k) x[k] = field.low()[k] + field.size() * uniform(random, 0.001, 0.999);
    for (int k = 0; k < 3; ++k)  // on a face, and often on an edge or a corner
      if (k == i % 3 || random() % 2)
        x[k] = field.low()[k] + unit * std::round((x[k] - field.low()[k]) / unit);
    const Vec3 delta = 1e-11 * field.size() * random_direction(random);
    largest = std::max(largest, std::abs(field.at(x + delta).value - field.at(x - delta).value));
  }
  return largest;
}

struct Errors {
  std::vector<double> in_tolerance;  ///< sorted
  double in_allow = 0;
  int wrong_signs = 0;  ///< where |d| > 1.5 allow(d)
  double at(double quantile) const {
    return in_tolerance[static_cast<std::size_t>(quantile * static_cast<double>(in_tolerance.size() - 1))];
  }
};

/// At points of the band around the surface.
Errors band_errors(const DistanceField& field, const ExactDistance& exact, const TriangleMesh& m, int count) {
  std::mt19937_64 random(12);
  Errors e;
  for (int i = 0; i < count; ++i) {
    const Vec3 x = on_surface(m, random) + uniform(random, -0.03, 0.03) * random_direction(random);
    const double d = exact.at(x).value, psi = field.at(x).value, allow = field.allowed_error(d);
    e.wrong_signs += std::abs(d) > 1.5 * allow && (d < 0) != (psi < 0);
    e.in_allow = std::max(e.in_allow, std::abs(psi - d) / allow);
    if (d > -0.02) e.in_tolerance.push_back(std::abs(psi - d) / field.report().tolerance);
  }
  std::sort(e.in_tolerance.begin(), e.in_tolerance.end());
  return e;
}

void check_surface(const DistanceField& field, const TriangleMesh& m, int count) {
  std::mt19937_64 random(13);
  double largest = 0;
  for (int i = 0; i < count; ++i)
    largest = std::max(largest, std::abs(field.at(on_surface(m, random)).value));
  CHECK(largest <= 1.5 * field.report().tolerance);
}

void check_gradient_inside_cells(const DistanceField& field, int count) {
  std::mt19937_64 random(14);
  const double unit = field.size() / 1024, h = 0.05 * unit;
  double largest = 0;
  for (int i = 0; i < count; ++i) {
    Vec3 x;  // in the middle half of a finest cell, so that x +- h lies in one leaf
    for (int k = 0; k < 3; ++k)
      x[k] = field.low()[k] + unit * (static_cast<double>(random() % 1024) + uniform(random, 0.25, 0.75));
    const Vec3 gradient = field.at(x).gradient;
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = h * Vec3::Unit(k);
      largest = std::max(
          largest, std::abs((field.at(x + step).value - field.at(x - step).value) / (2 * h) - gradient[k]));
    }
  }
  CHECK(largest < 1e-5);
}

void check_against_samples(const char* mesh, const char* csv) {
  const auto meshes = furrow::tests::shared_dir() / "meshes";
  const TriangleMesh m = furrow::tests::read_obj(meshes / mesh);
  const ExactDistance exact(m);
  const DistanceField field = DistanceField::build(exact, with_tolerance(1e-3 * exact.diagonal()));
  double largest = 0;
  int wrong = 0;
  for (const auto& row : furrow::tests::read_distances(meshes / csv)) {
    const double psi = field.at(row.x).value, allow = field.allowed_error(row.distance);
    largest = std::max(largest, std::abs(psi - row.distance) / allow);
    wrong += std::abs(row.distance) > 1.5 * allow && (psi < 0) != (row.distance < 0);
  }
  CHECK(largest <= 1.5);
  CHECK(wrong == 0);
  check_surface(field, m, 20000);
  const Errors errors = band_errors(field, exact, m, 50000);
  CHECK(errors.at(1) <= 1.5);
  CHECK(errors.at(0.999) <= 1.1);
  CHECK(errors.in_allow <= 1.5);
  CHECK(errors.wrong_signs == 0);
  CHECK(largest_jump(field, 50000) < 1e-6 * exact.diagonal());
}

}  // namespace

TEST_CASE("distance_field: the field of a real body that crosses itself keeps its error bounds",
          "[release]") {
  if (!furrow::tests::have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  check_against_samples("pairs/mh_male/body.obj", "accuracy/mh_male_body_sdf.csv");
}

TEST_CASE("distance_field: the field of a torus keeps its error bounds") {
  if (!furrow::tests::have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  check_against_samples("closed/torus.obj", "accuracy/torus_sdf.csv");
}

TEST_CASE(
    "distance_field: the field of a sphere is continuous, close to the analytic one, and its gradient is its "
    "slope",
    "[long]") {
  const TriangleMesh m = furrow::tests::sphere(48, 0.5, {1, 2, 3});
  const DistanceField field = DistanceField::build(m, with_tolerance(1e-3));
  CHECK(field.report().sign.rule == SignRule::pseudonormal);
  CHECK(field.report().largest_repair > 0);  // there was something to repair
  CHECK(largest_jump(field, 20000) < 1e-6);
  check_surface(field, m, 5000);
  check_gradient_inside_cells(field, 5000);
  std::mt19937_64 random(15);
  double value_error = 0, gradient_error = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 n = random_direction(random);
    const double r = uniform(random, 0.49, 0.525);
    const SignedDistance d = field.at(Vec3(1, 2, 3) + r * n);
    value_error = std::max(value_error, std::abs(d.value - (r - 0.5)));
    gradient_error = std::max(gradient_error, (d.gradient - n).norm());
  }
  CHECK(value_error < 1.5e-3 + 0.5 * (1 - std::cos(3.15 / 96)) * 2);  // the facets' sag, twice
  CHECK(gradient_error < 0.2);
}

TEST_CASE("distance_field: the field of a box is close to the analytic one and exact on its sides",
          "[release]") {
  const Vec3 low(-0.2, -0.1, 0), high(0.2, 0.15, 0.3);
  const DistanceField field = DistanceField::build(furrow::tests::box(low, high), with_tolerance(5e-4));
  CHECK(rc::check([&] {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    const Vec3 x(uniform(random, -0.23, 0.23), uniform(random, -0.13, 0.18), uniform(random, -0.03, 0.33));
    const Vec3 beyond = (low - x).cwiseMax(x - high);
    const double d = beyond.cwiseMax(0).norm() + std::min(0.0, beyond.maxCoeff());
    RC_ASSERT(std::abs(field.at(x).value - d) <= 1.5 * field.allowed_error(d));
  }));
  CHECK(field.at({0, 0.02, 0.31}).value == Approx(0.01).epsilon(1e-6));
  CHECK((field.at({0, 0.02, 0.31}).gradient - Vec3(0, 0, 1)).norm() < 1e-5);
}

TEST_CASE("distance_field: a finer tolerance means a smaller error", "[release]") {
  const TriangleMesh m = furrow::tests::box({-0.2, -0.1, 0}, {0.2, 0.15, 0.3});
  const ExactDistance exact(m);
  double before = 1;
  for (double tolerance : {4e-3, 2e-3, 1e-3}) {
    const Errors errors = band_errors(DistanceField::build(exact, with_tolerance(tolerance)), exact, m, 3000);
    CHECK(errors.at(1) <= 1.5);
    CHECK(errors.at(1) * tolerance < before);
    before = errors.at(1) * tolerance;
  }
}

TEST_CASE("distance_field: outside the cube the value goes on continuously and the gradient points away") {
  const DistanceField field = DistanceField::build(furrow::tests::sphere(16, 0.3), with_tolerance(2e-3));
  CHECK(rc::check([&] {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    const int axis = static_cast<int>(random() % 3);
    Vec3 on;
    for (int k = 0; k < 3; ++k) on[k] = field.low()[k] + field.size() * uniform(random, 0, 1);
    on[axis] = field.low()[axis] + field.size();
    const double border = field.at(on).value;
    RC_ASSERT(std::abs(field.at(on - 1e-10 * Vec3::Unit(axis)).value - border) < 1e-8);
    RC_ASSERT(std::abs(field.at(on + 1e-10 * Vec3::Unit(axis)).value - border) < 1e-8);
    const double far = uniform(random, 0.01, 100);
    const SignedDistance out = field.at(on + far * Vec3::Unit(axis));
    RC_ASSERT(std::abs(out.value - (border + far)) < 1e-9);
    RC_ASSERT((out.gradient - Vec3::Unit(axis)).norm() < 1e-9);
  }));
  CHECK(std::isnan(field.at({0, std::numeric_limits<double>::quiet_NaN(), 0}).value));
  CHECK(field.at({1e6, 1e6, -1e6}).value == Approx(std::sqrt(3.0) * 1e6).epsilon(1e-3));
}

TEST_CASE("distance_field: interpolated corner gradients are continuous and near the exact direction",
          "[long]") {
  DistanceFieldOptions options = with_tolerance(1e-3);
  options.gradient = GradientRule::interpolated_corners;
  const TriangleMesh m = furrow::tests::sphere(32, 0.4);
  const DistanceField field = DistanceField::build(m, options);
  const DistanceField plain = DistanceField::build(m, with_tolerance(1e-3));
  CHECK(field.memory() > 2 * plain.memory() - (1 << 21));
  std::mt19937_64 random(16);
  const double unit = field.size() / 1024;
  double jump = 0, plain_jump = 0, error = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 n = random_direction(random);
    Vec3 x = uniform(random, 0.385, 0.425) * n;
    REQUIRE(field.at(x).value == plain.at(x).value);
    error = std::max(error, (field.at(x).gradient - n).norm());
    x[0] = field.low()[0] + unit * std::round((x[0] - field.low()[0]) / unit);
    const Vec3 delta = 1e-12 * Vec3::Unit(0);
    jump = std::max(jump, (field.at(x + delta).gradient - field.at(x - delta).gradient).norm());
    plain_jump = std::max(plain_jump, (plain.at(x + delta).gradient - plain.at(x - delta).gradient).norm());
  }
  CHECK(jump < 1e-5);
  CHECK(plain_jump > 1e-3);
  CHECK(error < 0.2);
}

TEST_CASE("distance_field: one triangle has one, as a sheet without an inside") {
  TriangleMesh m;
  m.vertices = {{0, 0, 0}, {0.3, 0, 0}, {0, 0.3, 0}};
  m.triangles = {{0, 1, 2}};
  DistanceFieldOptions options = with_tolerance(2e-3);
  options.max_depth = 8;
  const DistanceField field = DistanceField::build(m, options);
  CHECK(field.at({0.1, 0.1, 0.02}).value == Approx(0.02).margin(3e-3));
  CHECK(largest_jump(field, 2000) < 1e-6);
}

TEST_CASE("distance_field: the default tolerance is the thousandth part of the diagonal, at most 2 mm") {
  DistanceFieldOptions options;
  options.max_depth = 5;
  options.band_depth = 5;
  const DistanceField small = DistanceField::build(furrow::tests::box({0, 0, 0}, {0.1, 0.2, 0.2}), options);
  CHECK(small.report().tolerance == Approx(3e-4));
  CHECK(small.report().leaves_at_max_depth > 0);
  CHECK(DistanceField::build(furrow::tests::box({0, 0, 0}, {10, 10, 10}), options).report().tolerance ==
        2e-3);
}

TEST_CASE("distance_field: bad options and bodies are refused by name") {
  const TriangleMesh m = furrow::tests::box({0, 0, 0}, {1, 1, 1});
  const auto refused = [&](auto change, const char* name) {
    DistanceFieldOptions options;
    change(options);
    CHECK_THROWS_WITH(DistanceField::build(m, options), Catch::Contains(name));
  };
  refused([](auto& o) { o.tolerance = 0; }, "tolerance");
  refused([](auto& o) { o.tolerance = std::numeric_limits<double>::quiet_NaN(); }, "tolerance");
  refused([](auto& o) { o.outer_band = -1; }, "outer_band");
  refused([](auto& o) { o.inner_band = -1; }, "inner_band");
  refused([](auto& o) { o.far_slope = 2; }, "far_slope");
  refused([](auto& o) { o.margin = 0; }, "margin");
  refused([](auto& o) { o.max_depth = 13; }, "max_depth");
  refused([](auto& o) { o.band_depth = 11; }, "band_depth");
  refused([](auto& o) { o.threads = 0; }, "threads");
  CHECK_THROWS_AS(DistanceField::build(TriangleMesh{}), std::invalid_argument);
}
