// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/linear/negative_pivots.h"

#include <array>
#include <catch2/catch.hpp>
#include <limits>

#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"
#include "tests/physics/linear/block_matrices.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

Eigen::MatrixXd shifted(Eigen::MatrixXd a, double shift) {
  a.diagonal().array() += shift;
  return a;
}

}  // namespace

TEST_CASE("negative_pivots: as many as the dense matrix has negative eigenvalues, at every shift",
          "[release]") {
  for (const auto& [columns, rows, links] :
       {std::array{12, 11, 0}, {12, 11, 40}, {40, 1, 0}, {1, 1, 0}, {5, 1, 10}}) {
    const Eigen::MatrixXd a = symmetric(columns, rows, links);
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a).eigenvalues();
    const Eigen::Index n = values.size();
    CHECK(negative_pivots(lower(a)) == 0);
    CHECK(negative_pivots(lower(-a)) == n);
    for (const Eigen::Index below : {Eigen::Index(1), n / 3, n / 2, n - 1}) {
      CAPTURE(columns, rows, links, below);
      CHECK(negative_pivots(lower(shifted(a, -0.5 * (values[below - 1] + values[below])))) == below);
    }
  }
}

TEST_CASE("negative_pivots: pieces that nothing joins are counted, and nothing at all") {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(60, 60);
  a.topLeftCorner(30, 30) = symmetric(5, 2, 0);
  a.bottomRightCorner(30, 30) = -2 * symmetric(5, 2, 0);
  CHECK(negative_pivots(lower(a)) == 30);
  CHECK(negative_pivots(BlockMatrix::Sparse(0, 0)) == 0);
}

TEST_CASE("negative_pivots: a pivot of 0, and one that is not a number, are told") {
  Eigen::MatrixXd a = symmetric(4, 4, 0);
  a.row(7).setZero();
  a.col(7).setZero();
  CHECK(negative_pivots(lower(a)) == -1);
  a(7, 7) = std::numeric_limits<double>::quiet_NaN();
  CHECK(negative_pivots(lower(a)) == -1);
}

TEST_CASE("negative_pivots: it asks often, and throws where it is cancelled") {
  const BlockMatrix::Sparse sparse = lower(symmetric(22, 22, 40));
  const auto questions_until = [&](int last) {
    int asked = 0;
    const CancelScope scope([&] { return ++asked >= last; });
    CHECK_THROWS_AS(negative_pivots(sparse), Cancelled);
    return asked;
  };
  for (const int last : {1, 2, 3}) CHECK(questions_until(last) == last);
}
