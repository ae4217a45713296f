// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/linear/dense_front.h"

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>
#include <vector>

#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using furrow::tests::Noise;

namespace {

/// A positive definite matrix, and a front with its first `width` columns.
struct Problem {
  Eigen::MatrixXd a;
  std::vector<double> panel;
  DenseFront front;
  Problem(int height, int width) {
    Noise noise(std::uint64_t(7 * height + width));
    Eigen::MatrixXd b(height, height);
    for (double& v : b.reshaped()) v = noise();
    a = b * b.transpose() + height * Eigen::MatrixXd::Identity(height, height);
    const int stride = padded(height);
    panel.assign(std::size_t(stride) * std::size_t(width) + 8, 0.0);
    for (int c = 0; c < width; ++c)
      for (int r = c; r < height; ++r) panel[std::size_t(c * stride + r)] = a(r, c);
    front = {panel.data(), height, width, stride};
  }
};

}  // namespace

TEST_CASE("dense_front: columns of the factor, and what is left, are right for every size") {
  for (const int width : {3, 6, 15, 18, 33, 48}) {
    for (const int rest : {0, 3, 6, 9, 12, 39}) {
      CAPTURE(width, rest);
      Problem p(width + rest, width);
      const int stride = padded(rest);
      std::vector<double> update(std::size_t(rest * stride), NAN);
      REQUIRE(eliminate(p.front));
      negative_square(p.front, update.data(), stride);
      const Eigen::MatrixXd l = p.a.llt().matrixL();
      double apart = 0;
      for (int c = 0; c < width; ++c)
        for (int r = c; r < width + rest; ++r)
          apart = std::max(apart, std::abs(p.panel[std::size_t(c * p.front.stride + r)] - l(r, c)));
      const Eigen::MatrixXd side = l.block(width, 0, rest, width), square = side * side.transpose();
      for (int c = 0; c < rest; ++c)
        for (int r = c; r < rest; ++r)
          apart = std::max(apart, std::abs(update[std::size_t(c * stride + r)] + square(r, c)));
      CHECK(apart < 1e-11 * (width + rest));
    }
  }
}

TEST_CASE("dense_front: a large one has the same bits on any number of threads", "[release]") {
  std::vector<double> first, first_update;
  for (int threads = 1; threads <= 3; ++threads) {
    Problem p(420, 150);
    const int stride = padded(420);
    ThreadPool pool(threads);
    std::vector<double> update(270 * 272, 0.0);
    REQUIRE(eliminate(p.front, threads > 1 ? &pool : nullptr));
    negative_square(p.front, update.data(), 272, threads > 1 ? &pool : nullptr);
    for (int c = 0; c < 270; ++c)
      std::fill_n(update.begin() + 272 * c, c, 0.0);  // above the diagonal: anything
    if (threads == 1) {
      const Eigen::MatrixXd l = p.a.llt().matrixL();
      CHECK(std::abs(p.panel[std::size_t(149 * stride + 419)] - l(419, 149)) < 1e-10);
      const Eigen::MatrixXd side = l.block(150, 0, 270, 150);
      CHECK(std::abs(update[100 * 272 + 269] + side.row(100).dot(side.row(269))) < 1e-9);
      first = p.panel, first_update = update;
    }
    for (int c = 0; c < 150; ++c)
      CHECK(std::equal(p.panel.begin() + stride * c + c, p.panel.begin() + stride * c + 420,
                       first.begin() + stride * c + c));
    CHECK(update == first_update);
  }
}

TEST_CASE("dense_front: substitution forward and backward solves") {
  for (const int height : {3, 9, 24, 51}) {
    Problem p(height, height);
    REQUIRE(eliminate(p.front));
    Noise noise(1);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(padded(height));
    for (double& v : b.head(height)) v = noise();
    Eigen::VectorXd x = b;
    substitute_forward(p.front, x.data());
    substitute_backward(p.front, x.data());
    CHECK((p.a * x.head(height) - b.head(height)).norm() < 1e-11);
  }
  Problem p(30, 12);
  REQUIRE(eliminate(p.front));
  const Eigen::MatrixXd l = p.a.llt().matrixL();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(padded(30));
  x.head(30).setLinSpaced(-1, 1);
  const Eigen::VectorXd before = x;
  substitute_forward(p.front, x.data());
  const auto own = l.topLeftCorner(12, 12), side = l.block(12, 0, 18, 12);
  CHECK((own * x.head(12) - before.head(12)).norm() < 1e-12);
  CHECK((before.segment(12, 18) - side * x.head(12) - x.segment(12, 18)).norm() < 1e-12);
  const Eigen::VectorXd y = x;
  substitute_backward(p.front, x.data());
  CHECK((own.transpose() * x.head(12) + side.transpose() * x.segment(12, 18) - y.head(12)).norm() < 1e-12);
}

TEST_CASE("dense_front: what is not positive definite, or no number, is told") {
  Problem p(20, 18);
  p.panel[std::size_t(17 * p.front.stride + 17)] = -1e6;
  CHECK_FALSE(eliminate(p.front));
  Problem nan(20, 18);
  nan.panel[5] = NAN;
  CHECK_FALSE(eliminate(nan.front));
}
