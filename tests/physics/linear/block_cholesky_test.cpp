// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/linear/block_cholesky.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <limits>

#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"
#include "tests/physics/linear/block_matrices.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

Eigen::VectorXd some_vector(Eigen::Index n) {
  Noise noise(9);
  Eigen::VectorXd b(n);
  for (double& v : b) v = noise();
  return b;
}

}  // namespace

TEST_CASE(
    "block_cholesky: solutions are the dense ones, on sheets, lines, single blocks and scattered links") {
  for (const auto& [columns, rows, links] :
       {std::array{12, 11, 0}, {12, 11, 40}, {40, 1, 0}, {1, 1, 0}, {5, 1, 10}}) {
    CAPTURE(columns, rows, links);
    const Eigen::MatrixXd a = symmetric(columns, rows, links);
    BlockCholesky factor;
    const BlockCholesky::Sparse sparse = lower(a);
    factor.analyse(sparse);
    for (const double shift : {0.0, 3.0}) {
      REQUIRE(factor.factorise(sparse, shift));
      const Eigen::VectorXd b = some_vector(a.rows());
      Eigen::VectorXd x = b;
      factor.solve(x);
      Eigen::MatrixXd shifted = a;
      shifted.diagonal().array() += shift;
      CHECK((shifted * x - b).norm() < 1e-13 * b.norm() * a.rows());
      CHECK((x - shifted.llt().solve(b)).norm() < 1e-12 * x.norm());
    }
  }
}

TEST_CASE("block_cholesky: pieces that nothing joins are solved, and nothing at all") {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(60, 60);
  const Eigen::MatrixXd piece = symmetric(5, 2, 0);
  a.topLeftCorner(30, 30) = piece;
  a.bottomRightCorner(30, 30) = 2 * piece;
  BlockCholesky factor;
  factor.analyse(lower(a));
  REQUIRE(factor.factorise(lower(a), 0));
  Eigen::VectorXd x = a * Eigen::VectorXd::Ones(60);
  factor.solve(x);
  CHECK((x - Eigen::VectorXd::Ones(60)).norm() < 1e-12);
  factor.analyse(BlockCholesky::Sparse(0, 0));
  CHECK(factor.factorise(BlockCholesky::Sparse(0, 0), 0));
}

TEST_CASE(
    "block_cholesky: it says when a matrix is not positive definite, at the eigenvalue, and takes another") {
  const Eigen::MatrixXd a = symmetric(9, 9, 0);
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a).eigenvalues()[0];
  const BlockCholesky::Sparse sparse = lower(a);
  BlockCholesky factor;
  factor.analyse(sparse);
  CHECK(factor.factorise(sparse, -least + 1e-9));
  CHECK_FALSE(factor.factorise(sparse, -least - 1e-9));
  CHECK_FALSE(factor.factorise(sparse, std::numeric_limits<double>::quiet_NaN()));
  CHECK(factor.factorise(2 * sparse, 0));
  Eigen::VectorXd x = a * Eigen::VectorXd::Ones(a.rows()), y = x;
  factor.solve(x);
  CHECK((x - 0.5 * Eigen::VectorXd::Ones(a.rows())).norm() < 1e-10);
  BlockCholesky other;
  other.analyse(sparse);
  REQUIRE(other.factorise(2 * sparse, 0));
  other.solve(y);
  CHECK(x == y);
}

TEST_CASE("block_cholesky: it throws where it is cancelled, and the next call has the bits of a fresh one") {
  const Eigen::MatrixXd a = symmetric(22, 22, 40);
  const BlockCholesky::Sparse sparse = lower(a);
  BlockCholesky fresh;
  fresh.analyse(sparse);
  REQUIRE(fresh.factorise(sparse, 0));
  Eigen::VectorXd expected = some_vector(a.rows());
  fresh.solve(expected);
  for (const int threads : {1, 2}) {
    CAPTURE(threads);
    ThreadPool pool(threads);
    BlockCholesky factor;
    factor.analyse(sparse);
    const auto questions_until = [&](int last) {
      int asked = 0;
      const CancelScope scope([&] { return ++asked >= last; });
      try {
        factor.factorise(2 * sparse, 1, &pool);
      } catch (const Cancelled&) {
        CHECK(asked == last);
      }
      return asked;
    };
    CHECK(questions_until(1000000) >= (threads == 1 ? 4 : 1));
    for (const int last : {1, 2, 3}) {
      const int asked = questions_until(last);  // two threads share the work, and one of them asks
      CHECK((asked == last || (threads == 2 && last > 1 && asked < last)));
      REQUIRE(factor.factorise(sparse, 0, &pool));
      Eigen::VectorXd x = some_vector(a.rows());
      factor.solve(x, &pool);
      CHECK(x == expected);
    }
  }
}

TEST_CASE("block_cholesky: the order for one pattern serves a like one, but not one that fills its factor") {
  const Eigen::MatrixXd sheet = symmetric(20, 20, 0), like = symmetric(20, 20, 4),
                        full = symmetric(20, 20, 400);
  BlockCholesky factor;
  factor.analyse(lower(sheet));
  REQUIRE(factor.factorise(lower(sheet), 0));
  const Eigen::VectorXd b = some_vector(sheet.rows());
  const auto solved = [&](const Eigen::MatrixXd& a, bool single) {
    Eigen::VectorXd x = b;
    REQUIRE((single ? factor.factorise_single(lower(a)) : factor.factorise(lower(a), 0)));
    factor.solve(x);
    return (a * x - b).norm() / b.norm();
  };
  REQUIRE(factor.analyse_like(lower(like)));
  CHECK(solved(like, false) < 1e-12);
  CHECK(solved(like, true) < 1e-5);
  CHECK_FALSE(factor.analyse_like(lower(full)));
  CHECK(solved(like, false) < 1e-12);  // nothing was changed
  factor.analyse(lower(full));
  CHECK(solved(full, false) < 1e-11);
}
