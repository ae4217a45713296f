// SPDX-License-Identifier: MIT
#include "physics/linear/divide_fronts.h"

#include <algorithm>

namespace furrow::physics {
namespace {

constexpr double together = 0.7;  // share of their speed that threads keep on one front
constexpr int most_splits = 8;    // a thread

struct Work {
  std::vector<double> own, branch;  // of a front alone; with all below it
  std::vector<int> lowest;          // front of its branch; a branch is a range
};

Work work_of(const std::vector<FrontTree::Front>& fronts) {
  Work work{std::vector<double>(fronts.size()), std::vector<double>(fronts.size()),
            std::vector<int>(fronts.size())};
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    const double w = fronts[i].width, n = w + double(fronts[i].rows.size());
    work.own[i] = w * (n * n - n * w + w * w / 3) + 10 * n * n;  // products; moving
    work.branch[i] += work.own[i];
    work.lowest[i] = int(i);
    for (const int child : fronts[i].children)
      work.lowest[i] = std::min(work.lowest[i], work.lowest[std::size_t(child)]);
    if (fronts[i].parent >= 0) work.branch[std::size_t(fronts[i].parent)] += work.branch[i];
  }
  return work;
}

/// Until the last thread is done, where each takes the next branch when it is free.
double time_of(const std::vector<int>& branches, const Work& work, int threads) {
  std::vector<double> load(std::size_t(threads), 0.0);
  for (const int b : branches) *std::min_element(load.begin(), load.end()) += work.branch[std::size_t(b)];
  return *std::max_element(load.begin(), load.end());
}

}  // namespace

FrontDivision divide_fronts(const std::vector<FrontTree::Front>& fronts, int threads) {
  const Work work = work_of(fronts);
  const auto heavier = [&](int a, int b) {
    const double x = work.branch[std::size_t(a)], y = work.branch[std::size_t(b)];
    return x != y ? x > y : a < b;
  };
  std::vector<int> branches, trunk, best;
  for (std::size_t i = 0; i < fronts.size(); ++i)
    if (fronts[i].parent < 0) branches.push_back(int(i));
  std::sort(branches.begin(), branches.end(), heavier);
  double least = time_of(branches, work, threads), trunk_time = 0;
  std::size_t best_trunk = 0;
  best = branches;
  while (threads > 1 && !branches.empty() && int(trunk.size()) < most_splits * threads) {
    const FrontTree::Front& f = fronts[std::size_t(branches[0])];  // the heaviest is split
    if (f.children.empty()) break;
    trunk.push_back(branches[0]);
    trunk_time += work.own[std::size_t(branches[0])] / (together * threads);
    branches.erase(branches.begin());
    branches.insert(branches.end(), f.children.begin(), f.children.end());
    std::sort(branches.begin(), branches.end(), heavier);
    const double time = trunk_time + time_of(branches, work, threads);
    if (time < least) least = time, best = branches, best_trunk = trunk.size();
  }
  FrontDivision division;
  for (const int b : best) division.branches.push_back({work.lowest[std::size_t(b)], b + 1});
  division.trunk.assign(trunk.begin(), trunk.begin() + std::ptrdiff_t(best_trunk));
  std::sort(division.trunk.begin(), division.trunk.end());
  return division;
}

}  // namespace furrow::physics
