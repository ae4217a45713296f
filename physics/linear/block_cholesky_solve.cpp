// SPDX-License-Identifier: MIT
#include <algorithm>

#include "physics/linear/block_cholesky.h"

namespace furrow::physics {

/// What a front's rows lose goes up the tree from front to front: a branch writes nothing beyond itself.
void BlockCholesky::forward(int front, Eigen::VectorXd& x, std::vector<double>& left) const {
  const DenseFront a = dense(front);
  const FrontTree::Front& f = tree_.fronts[std::size_t(front)];
  thread_local std::vector<double> own;
  own.assign(std::size_t(a.stride), 0.0);
  std::copy_n(x.data() + 3 * f.first, a.width, own.begin());
  for (const int child : f.children) {
    const double* lost = left.data() + left_[std::size_t(child)];
    for (const FrontTree::Run& run : tree_.fronts[std::size_t(child)].runs)
      for (int i = 0; i < run.length; ++i) own[std::size_t(run.to + i)] += lost[run.from + i];
  }
  substitute_forward(a, own.data());
  std::copy_n(own.begin(), a.width, x.data() + 3 * f.first);
  std::copy_n(own.begin() + a.width, a.height - a.width,
              left.begin() + std::ptrdiff_t(left_[std::size_t(front)]));
}

void BlockCholesky::backward(int front, Eigen::VectorXd& x) const {
  const DenseFront a = dense(front);
  const FrontTree::Front& f = tree_.fronts[std::size_t(front)];
  thread_local std::vector<double> own;
  own.assign(std::size_t(a.stride), 0.0);
  std::copy_n(x.data() + 3 * f.first, a.width, own.begin());
  for (std::size_t r = 0; r < f.rows.size(); ++r)
    std::copy_n(x.data() + 3 * f.rows[r], 3, own.begin() + a.width + 3 * std::ptrdiff_t(r));
  substitute_backward(a, own.data());
  std::copy_n(own.begin(), a.width, x.data() + 3 * f.first);
}

void BlockCholesky::solve(Eigen::VectorXd& b, ThreadPool* pool) const {
  Eigen::VectorXd x(b.size());
  std::vector<double> left(left_.back());
  for (std::size_t i = 0; i < tree_.position.size(); ++i)
    x.segment<3>(3 * tree_.position[i]) = b.segment<3>(3 * Eigen::Index(i));
  const auto each_branch = [&](const auto& work) {
    const int n = int(division_.branches.size());
    const auto branch = [&](int i, int) { work(division_.branches[std::size_t(i)]); };
    if (pool) return pool->share(n, branch);
    for (int i = 0; i < n; ++i) branch(i, 0);
  };
  each_branch([&](const std::array<int, 2>& range) {
    for (int i = range[0]; i < range[1]; ++i) forward(i, x, left);
  });
  for (const int i : division_.trunk) forward(i, x, left);
  for (auto i = division_.trunk.rbegin(); i != division_.trunk.rend(); ++i) backward(*i, x);
  each_branch([&](const std::array<int, 2>& range) {
    for (int i = range[1]; i-- > range[0];) backward(i, x);
  });
  for (std::size_t i = 0; i < tree_.position.size(); ++i)
    b.segment<3>(3 * Eigen::Index(i)) = x.segment<3>(3 * tree_.position[i]);
}

}  // namespace furrow::physics
