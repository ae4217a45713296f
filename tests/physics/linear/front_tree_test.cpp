// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/linear/front_tree.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("front_tree: parents of the elimination tree are those that a dense factorisation shows") {
  Noise noise(1);
  for (const int links : {0, 10, 25, 60}) {
    constexpr int n = 25;
    std::vector<std::vector<int>> below(n);
    Eigen::MatrixXd a = 100 * Eigen::MatrixXd::Identity(n, n);
    for (int l = 0; l < links; ++l) {
      const int i = int((noise() + 1) * 0.5 * n), j = int((noise() + 1) * 0.5 * n);
      if (i >= j || a(i, j) != 0) continue;
      below[i].push_back(j);
      a(i, j) = a(j, i) = 1 + 0.1 * noise();
    }
    const Eigen::MatrixXd factor = a.llt().matrixL();
    const std::vector<int> parent = elimination_tree(ColumnRows(below));
    for (int c = 0; c < n; ++c) {
      int first = -1;
      for (int r = n - 1; r > c; --r) {
        if (factor(r, c) != 0) first = r;
      }
      CHECK(parent[c] == first);
    }
  }
}

TEST_CASE("postorder: a permutation with each node right behind its descendants") {
  //       6          7
  //     /   \        |
  //    2     5       3
  //   / \    |
  //  0   1   4
  const std::vector<int> parent{2, 2, 6, 7, 5, 6, -1, -1};
  CHECK(postorder(parent) == std::vector<int>{0, 1, 2, 6, 3, 4, 5, 7});
  CHECK(postorder({}).empty());
}
