// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "physics/linear/block_matrix.h"
#include "tests/physics/cloth/test_cloths.h"

namespace furrow::tests {

using physics::BlockMatrix;

/// Blocks between neighbours on a sheet of columns x rows and `links` more anywhere; dominant diagonal.
inline Eigen::MatrixXd symmetric(int columns, int rows, int links) {
  const int n = columns * rows;
  Noise noise(3);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  const auto join = [&](int i, int j) {
    if (i == j) return;
    Eigen::Matrix3d b;
    for (int e = 0; e < 3; ++e) b.col(e) = noise.vector();
    a.block<3, 3>(3 * i, 3 * j) += b;
    a.block<3, 3>(3 * j, 3 * i) += b.transpose();
  };
  for (int i = 0; i < n; ++i) {
    if (i % columns > 0) join(i, i - 1);
    if (i >= columns) join(i, i - columns);
  }
  for (int l = 0; l < links; ++l) join(int((noise() + 1) * 0.5 * n), int((noise() + 1) * 0.5 * n));
  const Eigen::VectorXd sums = a.cwiseAbs().rowwise().sum();
  a.diagonal() = sums.array() + 0.1;
  for (int i = 0; i < n; ++i) a(3 * i + 1, 3 * i) = a(3 * i, 3 * i + 1) = 0.05;
  return a;
}

/// Its lower triangle by whole blocks.
inline BlockMatrix::Sparse lower(const Eigen::MatrixXd& a) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int c = 0; c < a.cols(); ++c) {
    for (int r = c; r < a.rows(); ++r) {
      if (r / 3 == c / 3 || !a.block<3, 3>(r / 3 * 3, c / 3 * 3).isZero(0))
        entries.emplace_back(r, c, a(r, c));
    }
  }
  BlockMatrix::Sparse s(a.rows(), a.cols());
  s.setFromTriplets(entries.begin(), entries.end());
  return s;
}

}  // namespace furrow::tests
