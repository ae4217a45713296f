// SPDX-License-Identifier: MIT
#include "physics/block_cholesky.h"

#include <algorithm>

#include "physics/elimination_tree.h"
#include "physics/nested_dissection.h"

namespace furrow::physics {
namespace {

using Lists = std::vector<std::vector<int>>;

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

}  // namespace

/// Sets position_ and returns the blocks below the diagonal in the order of elimination.
Lists BlockCholesky::order(const Sparse& lower) {
  const Lists below = blocks_below(lower);
  blocks_ = int(below.size());
  position_ = nested_dissection(below);
  const std::vector<int> place = postorder(elimination_tree(permuted(below, position_)));
  for (int& p : position_) p = place[p];
  return permuted(below, position_);
}

/// One front for each run of columns whose parents follow each other and whose rows agree.
void BlockCholesky::make_fronts(Lists& below) {
  const std::vector<int> parent = elimination_tree(below);
  std::vector<int> front_of(below.size());
  for (int c = 0; c < blocks_; ++c) {  // below becomes the structure of L: a column's rows go to its parent
    if (parent[c] < 0) continue;
    std::vector<int>& rows = below[parent[c]];
    std::vector<int> all;
    std::set_union(rows.begin(), rows.end(), below[c].begin() + 1, below[c].end(), std::back_inserter(all));
    rows = std::move(all);
  }
  fronts_.clear();
  for (int c = 0; c < blocks_; ++c) {
    const bool follows = c > 0 && parent[c - 1] == c && below[c - 1].size() == below[c].size() + 1;
    if (!follows) fronts_.emplace_back().first = c;
    ++fronts_.back().width;
    fronts_.back().rows = below[c];
    front_of[c] = int(fronts_.size()) - 1;
  }
  for (Front& f : fronts_) f.parent = f.rows.empty() ? -1 : front_of[f.rows[0]];
  join_parents(fronts_);
}

/// Joins a front with the parent right behind it while few zeros come in.
void BlockCholesky::join_parents(std::vector<Front>& fronts) const {
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
  std::vector<int> front_of(static_cast<std::size_t>(blocks_));
  for (std::size_t i = 0; i < fronts.size(); ++i)
    std::fill_n(front_of.begin() + fronts[i].first, fronts[i].width, int(i));
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    Front& f = fronts[i];
    f.parent = f.rows.empty() ? -1 : front_of[std::size_t(f.rows[0])];
    if (f.parent < 0) continue;
    Front& p = fronts[std::size_t(f.parent)];
    p.children.push_back(int(i));
    for (const int r : f.rows) {
      const auto found = std::lower_bound(p.rows.begin(), p.rows.end(), r) - p.rows.begin();
      f.place.push_back(r < p.first + p.width ? r - p.first : p.width + int(found));
    }
  }
}

void BlockCholesky::find_blocks(const Sparse& lower) {
  std::vector<int> front_of(static_cast<std::size_t>(blocks_));
  for (std::size_t i = 0; i < fronts_.size(); ++i)
    std::fill_n(front_of.begin() + fronts_[i].first, fronts_[i].width, int(i));
  const int* outer = lower.outerIndexPtr();
  for (int c = 0; c < blocks_; ++c) {
    const int count = (outer[3 * c + 1] - outer[3 * c]) / 3;
    for (int b = 0; b < count; ++b) {
      const int r = lower.innerIndexPtr()[outer[3 * c] + 3 * b] / 3;
      const auto [low, high] = std::minmax(position_[c], position_[r]);
      Front& f = fronts_[std::size_t(front_of[low])];
      const auto found = std::lower_bound(f.rows.begin(), f.rows.end(), high) - f.rows.begin();
      const int row = high < f.first + f.width ? high - f.first : f.width + int(found);
      Block block{row, low - f.first, position_[r] < position_[c], {}};
      for (int e = 0; e < 3; ++e) block.value[e] = outer[3 * c + e] + 3 * b - (b > 0 ? e : 0);
      f.blocks.push_back(block);
    }
  }
}

void BlockCholesky::analyse(const Sparse& lower) {
  Lists below = order(lower);
  make_fronts(below);
  find_blocks(lower);
  share_out();
}

/// Divides the tree of fronts: branches for each thread, and the trunk that they grow from.
void BlockCholesky::share_out() {
  std::vector<double> cost(fronts_.size());
  std::vector<int> lowest(fronts_.size());  // front of its branch; a branch is a range
  for (std::size_t i = 0; i < fronts_.size(); ++i) {
    const double w = fronts_[i].width, n = w + double(fronts_[i].rows.size());
    cost[i] += w * n * n;
    lowest[i] = int(i);
    for (const int child : fronts_[i].children) lowest[i] = std::min(lowest[i], lowest[std::size_t(child)]);
    if (fronts_[i].parent >= 0) cost[std::size_t(fronts_[i].parent)] += cost[i];
  }
  const auto heavier = [&](int a, int b) { return cost[a] != cost[b] ? cost[a] > cost[b] : a < b; };
  std::vector<int> branches;
  for (std::size_t i = 0; i < fronts_.size(); ++i)
    if (fronts_[i].parent < 0) branches.push_back(int(i));
  trunk_.clear();
  for (;;) {
    std::sort(branches.begin(), branches.end(), heavier);
    if (branches.empty() || branches.size() >= most_branches || fronts_[branches[0]].children.empty()) break;
    trunk_.push_back(branches[0]);
    branches.erase(branches.begin());
    const std::vector<int>& children = fronts_[std::size_t(trunk_.back())].children;
    branches.insert(branches.end(), children.begin(), children.end());
  }
  std::sort(trunk_.begin(), trunk_.end());
  std::array<double, shares> load{};
  for (auto& share : shares_) share.clear();
  for (const int b : branches) {
    const auto lightest = std::min_element(load.begin(), load.end()) - load.begin();
    load[std::size_t(lightest)] += cost[b];
    shares_[std::size_t(lightest)].push_back({lowest[b], b + 1});
  }
}

/// The matrix's own entries of a front.
void BlockCholesky::fill(const Front& f, const double* values, double shift, DenseFront a) {
  for (const Block& b : f.blocks) {
    const bool diagonal = b.row == b.column;
    for (int e = 0; e < 3; ++e) {
      for (int g = diagonal ? e : 0; g < 3; ++g) {
        const double v = values[b.value[e] + g - (diagonal ? e : 0)];
        const std::ptrdiff_t row = 3 * b.row + (b.transposed ? e : g),
                             column = 3 * b.column + (b.transposed ? g : e);
        a.panel[row + column * a.stride] += v;
      }
    }
  }
  for (std::ptrdiff_t c = 0; c < a.width; ++c) a.panel[c + c * a.stride] += shift;
}

/// Adds to a front what a child left; lower triangles.
void BlockCholesky::extend(const Front& child, DenseFront a, std::vector<double>& update) {
  const int n = 3 * int(child.rows.size()), from = padded(n), to = padded(a.height - a.width);
  for (int c = 0; c < n; ++c) {
    const int column = 3 * child.place[std::size_t(c / 3)] + c % 3;
    const double* source = child.update.data() + std::ptrdiff_t(c) * from;
    double* target = column < a.width ? a.panel + std::ptrdiff_t(column) * a.stride
                                      : update.data() + std::ptrdiff_t(column - a.width) * to - a.width;
    for (int r = c - c % 3; r < n; r += 3) {  // above the diagonal is what nobody reads
      double* t = target + 3 * child.place[std::size_t(r / 3)];
      t[0] += source[r], t[1] += source[r + 1], t[2] += source[r + 2];
    }
  }
}

bool BlockCholesky::eliminate(int number, const double* values, double shift, ThreadPool* pool) {
  Front& f = fronts_[std::size_t(number)];
  const DenseFront a = f.dense();
  const int rest = a.height - a.width;
  std::fill(f.panel.begin(), f.panel.end(), 0.0);
  f.update.assign(std::size_t(rest) * std::size_t(padded(rest)), 0.0);
  fill(f, values, shift, a);
  for (const int child : f.children) {
    extend(fronts_[std::size_t(child)], a, f.update);
    std::vector<double>().swap(fronts_[std::size_t(child)].update);  // gives the room back
  }
  if (!physics::eliminate(a, pool)) return false;
  subtract_square(a, f.update.data(), padded(rest), pool);
  return true;
}

bool BlockCholesky::factorise(const Sparse& lower, double shift, ThreadPool* pool) {
  for (Front& f : fronts_) f.panel.resize(std::size_t(f.dense().stride) * std::size_t(3 * f.width) + 4);
  std::array<char, shares> good;
  good.fill(true);
  const auto work = [&](int begin, int end) {
    for (int s = begin; s < end; ++s)
      for (const auto& [first, last] : shares_[std::size_t(s)])
        for (int i = first; i < last && good[s]; ++i)
          good[s] = eliminate(i, lower.valuePtr(), shift, nullptr);
  };
  if (pool)
    pool->run(shares, work);
  else
    work(0, shares);
  return std::count(good.begin(), good.end(), true) == shares &&
         std::all_of(trunk_.begin(), trunk_.end(),
                     [&](int i) { return eliminate(i, lower.valuePtr(), shift, pool); });
}

void BlockCholesky::solve(Eigen::VectorXd& b) const {
  Eigen::VectorXd x(b.size()), below;
  for (int i = 0; i < blocks_; ++i) x.segment<3>(3 * position_[i]) = b.segment<3>(3 * i);
  const auto gather = [&](const Front& f) {
    below.resize(3 * Eigen::Index(f.rows.size()));
    for (std::size_t r = 0; r < f.rows.size(); ++r)
      below.segment<3>(3 * Eigen::Index(r)) = x.segment<3>(3 * f.rows[r]);
  };
  for (const Front& f : fronts_) {
    gather(f);
    substitute_forward(f.dense(), x.data() + 3 * f.first, below.data());
    for (std::size_t r = 0; r < f.rows.size(); ++r)
      x.segment<3>(3 * f.rows[r]) = below.segment<3>(3 * Eigen::Index(r));
  }
  for (auto f = fronts_.rbegin(); f != fronts_.rend(); ++f) {
    gather(*f);
    substitute_backward(f->dense(), x.data() + 3 * f->first, below.data());
  }
  for (int i = 0; i < blocks_; ++i) b.segment<3>(3 * i) = x.segment<3>(3 * position_[i]);
}

}  // namespace furrow::physics
