// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/linear/lanczos.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

LinearOperator by(const MatrixXd& a) {
  return [&a](const VectorXd& q, VectorXd& product) { product = a * q; };
}

VectorXd noise_vector(int n) {
  furrow::tests::Noise noise(5);
  VectorXd v(n);
  for (double& x : v) x = noise();
  return v;
}

/// 2 on the diagonal, -1 beside it: the largest eigenvalue is 2 + 2 cos(pi / (n + 1)).
MatrixXd chain(int n) {
  MatrixXd a = 2 * MatrixXd::Identity(n, n);
  a.diagonal(1).setConstant(-1);
  a.diagonal(-1).setConstant(-1);
  return a;
}

}  // namespace

TEST_CASE("lanczos: the largest eigenvalue of a chain and its vector") {
  const int n = 60;
  const MatrixXd a = chain(n);
  const LanczosResult found =
      largest_eigenvalue(by(a), noise_vector(n), {.tolerance = 1e-12, .most_steps = n});
  const double exact = 2 + 2 * std::cos(std::numbers::pi / (n + 1));
  CHECK(found.value == Approx(exact).epsilon(1e-13));
  const VectorXd y = found.vector();
  CHECK(y.norm() == Approx(1).epsilon(1e-12));
  CHECK((a * y - found.value * y).norm() < 1e-11);
}

TEST_CASE("lanczos: the residual is that of the vector, and an eigenvalue lies that near") {
  const int n = 40;
  const MatrixXd a = chain(n);
  const double exact = 2 + 2 * std::cos(std::numbers::pi / (n + 1));
  for (const int steps : {1, 3, 7, 20}) {
    const LanczosResult found =
        largest_eigenvalue(by(a), noise_vector(n), {.tolerance = 1e-15, .most_steps = steps});
    const VectorXd y = found.vector();
    CAPTURE(steps, found.value, found.residual);
    CHECK(found.steps() == steps);
    CHECK((a * y - found.value * y).norm() == Approx(found.residual).epsilon(1e-9));
    CHECK(found.value <= exact * (1 + 1e-14));
    const VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(a).eigenvalues();
    CHECK((values.array() - found.value).abs().minCoeff() <= found.residual * (1 + 1e-9));
  }
}

TEST_CASE("lanczos: it ends where the start's directions are exhausted, and looks when it is told to") {
  const MatrixXd a = VectorXd::LinSpaced(12, 1, 12).asDiagonal();
  VectorXd start = VectorXd::Zero(12);
  start[2] = start[4] = start[7] = 1;  // eigenvalues 3, 5 and 8 alone
  const LanczosResult found = largest_eigenvalue(
      by(a), start, {.tolerance = 1e-14, .most_steps = 12, .least_steps = 9, .nothing = 1e-9});
  CHECK(found.steps() == 3);
  CHECK(found.value == Approx(8).epsilon(1e-13));
  const LanczosResult late = largest_eigenvalue(
      by(a), noise_vector(12), {.tolerance = 1, .most_steps = 12, .least_steps = 5, .steps_a_look = 4});
  CHECK(late.steps() == 8);
  CHECK(largest_eigenvalue(by(a), noise_vector(12), {.tolerance = 1, .most_steps = 12}).steps() == 1);
}

TEST_CASE("lanczos: it ends at once where numbers are beyond what can be computed with") {
  for (const double factor :
       {1e300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    const MatrixXd a = factor * chain(60);
    LanczosOptions options;
    options.tolerance = 1e-9;
    options.most_steps = 60;
    int products = 0;
    const auto counted = [&](const VectorXd& q, VectorXd& product) { ++products, product = a * q; };
    const LanczosResult result = largest_eigenvalue(counted, noise_vector(60), options);
    CAPTURE(factor);
    CHECK(std::isnan(result.value));
    CHECK(products <= 2);
    CHECK(result.vector().size() == 60);
  }
}

TEST_CASE("lanczos: options out of their ranges and a start that says nothing are refused") {
  const MatrixXd a = chain(3);
  const VectorXd one = VectorXd::Ones(3);
  CHECK_THROWS_AS(largest_eigenvalue(by(a), one, {.tolerance = 0, .most_steps = 3}), std::invalid_argument);
  CHECK_THROWS_AS(largest_eigenvalue(by(a), one, {.tolerance = 1, .most_steps = 0}), std::invalid_argument);
  CHECK_THROWS_AS(largest_eigenvalue(by(a), one, {.tolerance = 1, .most_steps = 3, .steps_a_look = 0}),
                  std::invalid_argument);
  CHECK_THROWS_AS(largest_eigenvalue(by(a), one, {.tolerance = 1, .most_steps = 3, .nothing = -1}),
                  std::invalid_argument);
  CHECK_THROWS_AS(largest_eigenvalue(by(a), 0 * one, {.tolerance = 1, .most_steps = 3}),
                  std::invalid_argument);
  CHECK_THROWS_AS(largest_eigenvalue(by(a), one / 0.0, {.tolerance = 1, .most_steps = 3}),
                  std::invalid_argument);
}
