// SPDX-License-Identifier: MIT
#include "physics/linear/front_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "physics/base/cancel_scope.h"
#include "physics/linear/nested_dissection.h"

namespace furrow::physics {
namespace {

using Front = FrontTree::Front;

constexpr double together = 0.7;  // share of their speed that threads keep on one front
constexpr int most_splits = 8;    // a thread

ColumnRows blocks_below(const FrontTree::Sparse& lower) {
  ColumnRows below;
  const int columns = int(lower.cols()) / 3, *outer = lower.outerIndexPtr();
  below.rows.reserve(std::size_t(lower.nonZeros()) / 9);
  for (int c = 0; c < columns; ++c) {
    for (int v = outer[3 * c] + 3; v < outer[3 * c + 1]; v += 3)
      below.rows.push_back(lower.innerIndexPtr()[v] / 3);
    below.first.push_back(below.rows.size());
  }
  return below;
}

/// Sorts pairs by their second part into columns that hold the first, in the order of the pairs. each(f)
/// calls f(first, second) for each pair.
template <class Each>
ColumnRows gathered(int columns, Each each) {
  ColumnRows result;
  result.first.assign(std::size_t(columns) + 1, 0);
  each([&](int, int second) { ++result.first[std::size_t(second) + 1]; });
  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
  result.rows.resize(result.first.back());
  std::vector<std::size_t> end(result.first.begin(), result.first.end() - 1);
  each([&](int first, int second) { result.rows[end[std::size_t(second)]++] = first; });
  return result;
}

/// Of each row the columns before it.
ColumnRows transposed(const ColumnRows& below) {
  return gathered(below.columns(), [&](const auto& take) {
    for (int c = 0; c < below.columns(); ++c)
      for (const int r : below.of(c)) take(c, r);
  });
}

/// The same after a permutation.
ColumnRows permuted(const ColumnRows& below, const std::vector<int>& position) {
  const ColumnRows before = gathered(below.columns(), [&](const auto& take) {
    for (int c = 0; c < below.columns(); ++c)
      for (const int r : below.of(c)) {
        const auto [low, high] = std::minmax(position[std::size_t(c)], position[std::size_t(r)]);
        take(low, high);
      }
  });
  return transposed(before);  // row by row, so that each column's rows ascend
}

/// How much of a joined panel may be zeros.
double most_zeros(int width) { return width <= 4 ? 0.6 : width <= 16 ? 0.25 : 0.08; }

/// The rows of each column of the factor. Most columns have those of one child, which are not copied.
class FactorRows {
 public:
  FactorRows(const ColumnRows& below, std::span<const int> parent)
      : below_(below), parts_(parent.size()), stamp_(parent.size(), -1) {
    std::vector<int> first(parent.size(), -1), next(parent.size(), -1);  // lists of children
    for (int c = 0; c < int(parent.size()); ++c) {
      find(c, first[std::size_t(c)], next);
      const int p = parent[std::size_t(c)];
      if (p < 0) continue;
      next[std::size_t(c)] = first[std::size_t(p)];
      first[std::size_t(p)] = c;
    }
  }
  std::span<const int> of(int column) const {
    const Part& part = parts_[std::size_t(column)];
    return {rows_.data() + part.begin, part.size};
  }

 private:
  struct Part {
    std::size_t begin = 0, size = 0;
  };

  void find(int column, int child, const std::vector<int>& next) {
    int largest = -1;
    for (int k = child; k >= 0; k = next[std::size_t(k)])
      if (largest < 0 || of(k).size() > of(largest).size()) largest = k;
    Part part;  // of the largest child, behind the column
    if (largest >= 0) part = {parts_[std::size_t(largest)].begin + 1, parts_[std::size_t(largest)].size - 1};
    for (std::size_t i = 0; i < part.size; ++i) stamp_[std::size_t(rows_[part.begin + i])] = column;
    more_.clear();
    const auto take = [&](int row) {
      if (row == column || std::exchange(stamp_[std::size_t(row)], column) == column) return;
      more_.push_back(row);
    };
    for (const int row : below_.of(column)) take(row);
    for (int k = child; k >= 0; k = next[std::size_t(k)])
      if (k != largest)
        for (const int row : of(k)) take(row);
    parts_[std::size_t(column)] = more_.empty() ? part : merged(part);
  }

  Part merged(const Part& part) {
    std::sort(more_.begin(), more_.end());
    const std::size_t begin = rows_.size();
    rows_.resize(begin + part.size + more_.size());
    const auto old = rows_.begin() + std::ptrdiff_t(part.begin);
    std::merge(old, old + std::ptrdiff_t(part.size), more_.begin(), more_.end(),
               rows_.begin() + std::ptrdiff_t(begin));
    return {begin, part.size + more_.size()};
  }

  const ColumnRows& below_;
  std::vector<Part> parts_;
  std::vector<int> rows_, stamp_, more_;
};

/// One front for each run of columns whose parents follow each other and whose rows agree.
std::vector<Front> make_fronts(const ColumnRows& below) {
  const int columns = below.columns();
  const std::vector<int> parent = elimination_tree(below);
  const FactorRows rows(below, parent);
  std::vector<Front> fronts;
  std::vector<int> front_of(parent.size());
  for (int c = 0; c < columns; ++c) {
    const bool follows =
        c > 0 && parent[std::size_t(c) - 1] == c && rows.of(c - 1).size() == rows.of(c).size() + 1;
    if (!follows) fronts.emplace_back().first = c;
    ++fronts.back().width;
    front_of[std::size_t(c)] = int(fronts.size()) - 1;
  }
  for (Front& f : fronts) {
    const std::span<const int> left = rows.of(f.first + f.width - 1);
    f.rows.assign(left.begin(), left.end());
    f.parent = f.rows.empty() ? -1 : front_of[std::size_t(f.rows[0])];
  }
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
    std::size_t at = 0;  // among the parent's rows
    for (int r = 0; r < int(f.rows.size()); ++r) {
      const int row = f.rows[std::size_t(r)];
      if (row >= p.first + p.width)
        while (p.rows[at] != row) ++at;
      const int place = 3 * (row < p.first + p.width ? row - p.first : p.width + int(at));
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

/// Of a front alone: products; moving.
double work_of(const Front& f) {
  const double w = f.width, n = w + double(f.rows.size());
  return w * (n * n - n * w + w * w / 3) + 10 * n * n;
}

struct Work {
  std::vector<double> own, branch;  // of a front alone; with all below it
  std::vector<int> lowest;          // front of its branch; a branch is a range
};

Work work_of(const std::vector<Front>& fronts) {
  Work work{std::vector<double>(fronts.size()), std::vector<double>(fronts.size()),
            std::vector<int>(fronts.size())};
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    work.own[i] = work_of(fronts[i]);
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

std::vector<int> elimination_tree(const ColumnRows& below) {
  const ColumnRows before = transposed(below);
  const std::size_t n = std::size_t(below.columns());
  std::vector<int> parent(n, -1), ancestor(n, -1);
  for (int r = 0; r < int(n); ++r) {
    for (int c : before.of(r)) {
      while (ancestor[std::size_t(c)] >= 0 && ancestor[std::size_t(c)] != r)
        c = std::exchange(ancestor[std::size_t(c)], r);
      if (ancestor[std::size_t(c)] < 0 && c != r) ancestor[std::size_t(c)] = parent[std::size_t(c)] = r;
    }
  }
  return parent;
}

std::vector<int> postorder(std::span<const int> parent) {
  const int n = int(parent.size());
  std::vector<int> stack, place(parent.size(), -1), first(parent.size(), -1), later(parent.size(), -1);
  for (int i = n - 1; i >= 0; --i) {  // a node's children, the first one first
    const int p = parent[std::size_t(i)];
    if (p < 0) stack.push_back(i);
    if (p >= 0) later[std::size_t(i)] = std::exchange(first[std::size_t(p)], i);
  }
  int next = n;  // from the roots downwards: a node, then its children from the last to the first
  std::reverse(stack.begin(), stack.end());
  while (!stack.empty()) {
    const int i = stack.back();
    stack.pop_back();
    place[std::size_t(i)] = --next;
    for (int c = first[std::size_t(i)]; c >= 0; c = later[std::size_t(c)]) stack.push_back(c);
  }
  return place;
}

FrontTree front_tree(const FrontTree::Sparse& lower, std::vector<int> order) {
  FrontTree tree;
  const ColumnRows below = blocks_below(lower);
  tree.position = order.empty() ? nested_dissection(below) : std::move(order);
  const std::vector<int> place = postorder(elimination_tree(permuted(below, tree.position)));
  for (int& p : tree.position) p = place[std::size_t(p)];
  throw_if_cancelled("front_tree");
  tree.fronts = make_fronts(permuted(below, tree.position));
  throw_if_cancelled("front_tree");
  join_parents(tree.fronts);
  order_columns(tree);
  find_parents(tree.fronts);
  find_blocks(lower, tree);
  for (const Front& f : tree.fronts) tree.work += work_of(f);
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
