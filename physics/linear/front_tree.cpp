// SPDX-License-Identifier: MIT
#include "physics/linear/front_tree.h"

#include <algorithm>
#include <numeric>

#include "physics/base/cancel_scope.h"
#include "physics/linear/nested_dissection.h"

namespace furrow::physics {
namespace {

using Front = FrontTree::Front;
using Lists = std::vector<std::vector<int>>;

constexpr double together = 0.7;  // share of their speed that threads keep on one front
constexpr int most_splits = 8;    // a thread

/// Rows of blocks below the diagonal, of each column of blocks.
Lists blocks_below(const Eigen::SparseMatrix<double>& lower) {
  Lists below(std::size_t(lower.cols() / 3));
  for (std::size_t c = 0; c < below.size(); ++c) {
    for (int v = lower.outerIndexPtr()[3 * c] + 3; v < lower.outerIndexPtr()[3 * c + 1]; v += 3)
      below[c].push_back(lower.innerIndexPtr()[v] / 3);
  }
  return below;
}

/// The same after a permutation, each list ascending.
Lists permuted(const Lists& below, const std::vector<int>& position) {
  Lists result(below.size());
  for (std::size_t c = 0; c < below.size(); ++c) {
    for (const int r : below[c]) {
      const auto [low, high] = std::minmax(position[c], position[r]);
      result[low].push_back(high);
    }
  }
  for (auto& list : result) std::sort(list.begin(), list.end());
  return result;
}

/// How much of a joined panel may be zeros.
double most_zeros(int width) { return width <= 4 ? 0.6 : width <= 16 ? 0.25 : 0.08; }

/// One front for each run of columns whose parents follow each other and whose rows agree.
std::vector<Front> make_fronts(Lists& below) {
  const int columns = int(below.size());
  std::vector<Front> fronts;
  const std::vector<int> parent = elimination_tree(below);
  std::vector<int> front_of(below.size());
  for (int c = 0; c < columns; ++c) {  // below becomes the structure of L: a column's rows go to its parent
    if (parent[c] < 0) continue;
    std::vector<int>& rows = below[parent[c]];
    std::vector<int> all;
    std::set_union(rows.begin(), rows.end(), below[c].begin() + 1, below[c].end(), std::back_inserter(all));
    rows = std::move(all);
  }
  for (int c = 0; c < columns; ++c) {
    const bool follows = c > 0 && parent[c - 1] == c && below[c - 1].size() == below[c].size() + 1;
    if (!follows) fronts.emplace_back().first = c;
    ++fronts.back().width;
    fronts.back().rows = below[c];
    front_of[c] = int(fronts.size()) - 1;
  }
  for (Front& f : fronts) f.parent = f.rows.empty() ? -1 : front_of[f.rows[0]];
  return fronts;
}

/// Joins a front with the parent right behind it while few zeros come in.
void join_parents(std::vector<Front>& fronts) {
  std::vector<Front> kept;
  std::vector<double> zeros;
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    Front f = std::move(fronts[i]);
    double filled = 0;
    while (!kept.empty() && kept.back().parent == int(i)) {
      const Front& child = kept.back();
      const double rows = f.width + double(f.rows.size());
      const double extra = child.width * (rows - double(child.rows.size())) + zeros.back() + filled;
      const int width = child.width + f.width;
      if (extra > most_zeros(width) * width * (child.width + rows)) break;
      f.first = child.first;
      f.width = width;
      filled = extra;
      kept.pop_back();
      zeros.pop_back();
    }
    kept.push_back(std::move(f));
    zeros.push_back(filled);
  }
  fronts = std::move(kept);
}

/// Of each column the front that eliminates it.
std::vector<int> front_of_columns(const std::vector<Front>& fronts) {
  std::vector<int> front_of;
  for (std::size_t i = 0; i < fronts.size(); ++i)
    front_of.insert(front_of.end(), std::size_t(fronts[i].width), int(i));
  return front_of;
}

/// Where a row of blocks stands in a front.
int place_in(const Front& f, int row) {
  if (row < f.first + f.width) return row - f.first;
  return f.width + int(std::lower_bound(f.rows.begin(), f.rows.end(), row) - f.rows.begin());
}

/// Orders the columns of each front, which costs nothing, so that what a branch leaves lies in few runs:
/// those that its first branches reach come first, those that its last ones reach last.
void order_columns(FrontTree& tree) {
  const std::vector<Front>& fronts = tree.fronts;
  std::vector<int> first(tree.position.size(), int(fronts.size())), last(tree.position.size(), 0);
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    for (const int r : fronts[i].rows) {
      first[std::size_t(r)] = std::min(first[std::size_t(r)], int(i));
      last[std::size_t(r)] = int(i);
    }
  }
  std::vector<int> order(tree.position.size()), place(tree.position.size());
  std::iota(order.begin(), order.end(), 0);
  const auto sooner = [&](int a, int b) {
    return first[std::size_t(a)] + last[std::size_t(a)] < first[std::size_t(b)] + last[std::size_t(b)];
  };
  for (const Front& f : fronts)
    std::stable_sort(order.begin() + f.first, order.begin() + f.first + f.width, sooner);
  for (std::size_t i = 0; i < order.size(); ++i) place[std::size_t(order[i])] = int(i);
  for (int& p : tree.position) p = place[std::size_t(p)];
  for (Front& f : tree.fronts) {
    for (int& r : f.rows) r = place[std::size_t(r)];
    std::sort(f.rows.begin(), f.rows.end());
  }
}

void find_parents(std::vector<Front>& fronts) {
  const std::vector<int> front_of = front_of_columns(fronts);
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    Front& f = fronts[i];
    f.parent = f.rows.empty() ? -1 : front_of[std::size_t(f.rows[0])];
    if (f.parent < 0) continue;
    Front& p = fronts[std::size_t(f.parent)];
    p.children.push_back(int(i));
    for (int r = 0; r < int(f.rows.size()); ++r) {
      const int place = 3 * place_in(p, f.rows[std::size_t(r)]);
      if (f.runs.empty() || f.runs.back().to + f.runs.back().length != place)
        f.runs.push_back({3 * r, place, 0});
      f.runs.back().length += 3;
    }
  }
}

void find_blocks(const FrontTree::Sparse& lower, FrontTree& tree) {
  const std::vector<int> front_of = front_of_columns(tree.fronts);
  const int* outer = lower.outerIndexPtr();
  for (int c = 0; c < int(tree.position.size()); ++c) {
    const int count = (outer[3 * c + 1] - outer[3 * c]) / 3;
    for (int b = 0; b < count; ++b) {
      const int r = lower.innerIndexPtr()[outer[3 * c] + 3 * b] / 3;
      const auto [low, high] = std::minmax(tree.position[c], tree.position[r]);
      Front& f = tree.fronts[std::size_t(front_of[low])];
      FrontTree::Block block{place_in(f, high), low - f.first, tree.position[r] < tree.position[c], {}};
      for (int e = 0; e < 3; ++e) block.value[e] = outer[3 * c + e] + 3 * b - (b > 0 ? e : 0);
      f.blocks.push_back(block);
    }
  }
}

struct Work {
  std::vector<double> own, branch;  // of a front alone; with all below it
  std::vector<int> lowest;          // front of its branch; a branch is a range
};

Work work_of(const std::vector<Front>& fronts) {
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

std::vector<int> elimination_tree(std::span<const std::vector<int>> below) {
  const int n = int(below.size());
  Lists before(below.size());
  for (int c = 0; c < n; ++c)
    for (const int r : below[c]) before[r].push_back(c);
  std::vector<int> parent(n, -1), ancestor(n, -1);
  for (int r = 0; r < n; ++r) {
    for (int c : before[r]) {
      while (ancestor[c] >= 0 && ancestor[c] != r) {
        const int next = ancestor[c];
        ancestor[c] = r;
        c = next;
      }
      if (ancestor[c] < 0 && c != r) ancestor[c] = parent[c] = r;
    }
  }
  return parent;
}

std::vector<int> postorder(std::span<const int> parent) {
  const int n = int(parent.size());
  Lists children(parent.size());
  std::vector<int> stack, place(n, -1);
  for (int i = n - 1; i >= 0; --i) {
    if (parent[i] < 0) stack.push_back(i);
    if (parent[i] >= 0) children[parent[i]].push_back(i);  // the last one first
  }
  int next = n;  // from the roots downwards: a node, then its children from the last to the first
  std::reverse(stack.begin(), stack.end());
  while (!stack.empty()) {
    const int i = stack.back();
    stack.pop_back();
    place[i] = --next;
    for (auto c = children[i].rbegin(); c != children[i].rend(); ++c) stack.push_back(*c);
  }
  return place;
}

FrontTree front_tree(const FrontTree::Sparse& lower) {
  FrontTree tree;
  const Lists below = blocks_below(lower);
  tree.position = nested_dissection(below);
  const std::vector<int> place = postorder(elimination_tree(permuted(below, tree.position)));
  for (int& p : tree.position) p = place[std::size_t(p)];
  throw_if_cancelled("front_tree");
  Lists factor = permuted(below, tree.position);
  tree.fronts = make_fronts(factor);
  throw_if_cancelled("front_tree");
  join_parents(tree.fronts);
  order_columns(tree);
  find_parents(tree.fronts);
  find_blocks(lower, tree);
  return tree;
}

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
