// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/linear/block_matrix.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

const std::vector<double> inv_mass{1, 0, 2, 1, 0.5};
const std::vector<std::array<int, 2>> pairs{{4, 0}, {0, 2}, {2, 0}, {1, 3}, {3, 3}, {4, 3}};

Mat3 some_block(Noise& noise) {
  Mat3 block;
  for (int c = 0; c < 3; ++c) block.col(c) = noise.vector();
  return block;
}

Eigen::MatrixXd whole(const BlockMatrix& m) {
  const Eigen::MatrixXd lower = m.lower();
  Eigen::MatrixXd all = lower.selfadjointView<Eigen::Lower>();
  return all;
}

}  // namespace

TEST_CASE("block_matrix: blocks come in where a dense matrix has them, and their mirror images with them") {
  BlockMatrix matrix(inv_mass, pairs);
  REQUIRE(matrix.rows() == 4);
  CHECK(matrix.row(1) == -1);
  CHECK(matrix.row(4) == 3);
  CHECK(matrix.lower().nonZeros() == 4 * 6 + 3 * 9);
  Noise noise(2);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(12, 12);
  for (const auto& [i, j] :
       {std::array{0, 0}, {0, 4}, {4, 0}, {2, 0}, {3, 4}, {3, 3}, {4, 4}, {2, 2}, {1, 3}, {1, 1}, {0, 4}}) {
    Mat3 block = some_block(noise);
    if (i == j) block = (block + block.transpose()).eval();
    matrix.add(matrix.place(i, j), block);
    const int r = matrix.row(i), c = matrix.row(j);
    if (r < 0 || c < 0) continue;
    dense.block<3, 3>(3 * r, 3 * c) += block;
    if (r != c) dense.block<3, 3>(3 * c, 3 * r) += block.transpose();
  }
  CHECK((whole(matrix) - dense).cwiseAbs().maxCoeff() == 0);
  matrix.set_zero();
  CHECK(whole(matrix).isZero(0));
  CHECK(matrix.lower().nonZeros() == 4 * 6 + 3 * 9);
}

TEST_CASE(
    "block_matrix: with more pairs it has the blocks of a matrix of all pairs, and places are carried over") {
  const BlockMatrix fewer(inv_mass, pairs);
  const std::vector<std::array<int, 2>> more{{3, 0}, {4, 0}, {1, 2}, {2, 4}, {0, 3}};
  std::vector<std::array<int, 2>> all = pairs;
  all.insert(all.end(), more.begin(), more.end());
  BlockMatrix grown(fewer, more), whole_one(inv_mass, all);
  CHECK(grown.lower().nonZeros() == whole_one.lower().nonZeros());
  Noise noise(3);
  for (const auto& [i, j] : {std::array{0, 0}, {0, 4}, {4, 0}, {2, 0}, {3, 4}, {3, 3}, {1, 3}, {2, 2}}) {
    Mat3 block = some_block(noise);
    if (i == j) block = (block + block.transpose()).eval();
    grown.add(grown.carried(fewer.place(i, j), fewer), block);
    whole_one.add(whole_one.place(i, j), block);
  }
  for (const auto& [i, j] : more) {
    const Mat3 block = some_block(noise);
    grown.add(grown.place(i, j), block);
    whole_one.add(whole_one.place(i, j), block);
  }
  CHECK(whole(grown) == whole(whole_one));
  CHECK(whole(BlockMatrix(grown, {})).rows() == 12);
  CHECK(BlockMatrix(grown, {}).lower().nonZeros() == grown.lower().nonZeros());
  CHECK_THROWS_AS(BlockMatrix(fewer, std::vector<std::array<int, 2>>{{0, 5}}), std::invalid_argument);
}

TEST_CASE("block_matrix: vectors of particles and of rows") {
  const BlockMatrix matrix(inv_mass, pairs);
  std::vector<Vec3> v(5);
  for (int i = 0; i < 5; ++i) v[std::size_t(i)] = Vec3(i, 10 * i, 100 * i);
  const Eigen::VectorXd rows = matrix.gather(v);
  REQUIRE(rows.size() == 12);
  CHECK(rows.segment<3>(3) == v[2]);
  std::vector<Vec3> back(5, Vec3::Ones());
  matrix.scatter(rows, back);
  v[1].setZero();
  CHECK(back == v);
}

TEST_CASE("block_matrix: nothing free, and pairs that are out of range or were not announced") {
  const std::vector<double> held(3, 0.0);
  const BlockMatrix none(held, std::vector<std::array<int, 2>>{{0, 2}});
  CHECK(none.rows() == 0);
  CHECK(none.place(0, 2).value == -1);
  CHECK(none.gather(std::vector<Vec3>(3, Vec3::Ones())).size() == 0);
  const BlockMatrix matrix(inv_mass, pairs);
  CHECK_THROWS_AS(matrix.place(2, 3), std::invalid_argument);
  CHECK_THROWS_AS(matrix.place(4, 2), std::invalid_argument);
  CHECK(matrix.place(1, 2).value == -1);
  CHECK_THROWS_AS(BlockMatrix(held, std::vector<std::array<int, 2>>{{0, 3}}), std::invalid_argument);
  CHECK_THROWS_AS(BlockMatrix(held, std::vector<std::array<int, 2>>{{-1, 0}}), std::invalid_argument);
}
