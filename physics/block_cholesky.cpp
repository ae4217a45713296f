// SPDX-License-Identifier: MIT
#include "physics/block_cholesky.h"

#include <Eigen/Cholesky>
#include <Eigen/OrderingMethods>
#include <algorithm>

#include "physics/elimination_tree.h"

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
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int c = 0; c < blocks_; ++c) {
    entries.emplace_back(c, c, 1);
    for (const int r : below[c]) entries.insert(entries.end(), {{r, c, 1}, {c, r, 1}});
  }
  Sparse graph(blocks_, blocks_);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> elimination;
  Eigen::AMDOrdering<int>()(graph, elimination);
  position_.assign(std::size_t(blocks_), 0);
  for (int i = 0; i < blocks_; ++i) position_[elimination.indices()[i]] = i;
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
    if (!follows) fronts_.push_back({c, 0, -1, {}, {}, {}, {}, {}});
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
}

/// The matrix's own entries of a front.
void BlockCholesky::fill(const Front& f, const double* values, double shift, Eigen::MatrixXd& a) {
  for (const Block& b : f.blocks) {
    const bool diagonal = b.row == b.column;
    for (int e = 0; e < 3; ++e) {
      for (int g = diagonal ? e : 0; g < 3; ++g) {
        const double v = values[b.value[e] + g - (diagonal ? e : 0)];
        a(3 * b.row + (b.transposed ? e : g), 3 * b.column + (b.transposed ? g : e)) += v;
      }
    }
  }
  a.diagonal().head(3 * f.width).array() += shift;
}

/// Adds to a front what a child left; lower triangles.
void BlockCholesky::extend(const Front& child, const Eigen::MatrixXd& update, Eigen::MatrixXd& a) {
  for (Eigen::Index c = 0; c < update.cols(); ++c) {
    auto to = a.col(3 * child.place[std::size_t(c / 3)] + c % 3);
    for (Eigen::Index r = c; r < update.rows(); ++r)
      to[3 * child.place[std::size_t(r / 3)] + r % 3] += update(r, c);
  }
}

bool BlockCholesky::factorise(const Sparse& lower, double shift) {
  std::vector<Eigen::MatrixXd> update(fronts_.size());  // what a front leaves to its parent; lower triangle
  for (std::size_t i = 0; i < fronts_.size(); ++i) {
    Front& f = fronts_[i];
    const Eigen::Index w = 3 * f.width, n = w + 3 * Eigen::Index(f.rows.size());
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
    fill(f, lower.valuePtr(), shift, a);
    for (const int child : f.children) {
      extend(fronts_[std::size_t(child)], update[std::size_t(child)], a);
      update[std::size_t(child)].resize(0, 0);
    }
    Eigen::Ref<Eigen::MatrixXd> pivot = a.topLeftCorner(w, w);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(pivot);  // in place
    if (factor.info() != Eigen::Success || !pivot.diagonal().allFinite()) return false;
    auto side = a.bottomLeftCorner(n - w, w);
    pivot.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(side);
    if (n > w) {
      update[i] = a.bottomRightCorner(n - w, n - w);
      update[i].selfadjointView<Eigen::Lower>().rankUpdate(side, -1);
    }
    f.panel = a.leftCols(w);
  }
  return true;
}

void BlockCholesky::solve(Eigen::VectorXd& b) const {
  Eigen::VectorXd x(b.size());
  for (int i = 0; i < blocks_; ++i) x.segment<3>(3 * position_[i]) = b.segment<3>(3 * i);
  Eigen::VectorXd below;
  const auto gather = [&](const Front& f) {
    below.resize(3 * Eigen::Index(f.rows.size()));
    for (std::size_t r = 0; r < f.rows.size(); ++r)
      below.segment<3>(3 * Eigen::Index(r)) = x.segment<3>(3 * f.rows[r]);
  };
  for (const Front& f : fronts_) {
    auto own = x.segment(3 * f.first, 3 * f.width);
    f.panel.topRows(own.size()).triangularView<Eigen::Lower>().solveInPlace(own);
    gather(f);
    below.noalias() -= f.panel.bottomRows(below.size()) * own;
    for (std::size_t r = 0; r < f.rows.size(); ++r)
      x.segment<3>(3 * f.rows[r]) = below.segment<3>(3 * Eigen::Index(r));
  }
  for (auto f = fronts_.rbegin(); f != fronts_.rend(); ++f) {
    auto own = x.segment(3 * f->first, 3 * f->width);
    gather(*f);
    own.noalias() -= f->panel.bottomRows(below.size()).transpose() * below;
    f->panel.topRows(own.size()).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
  }
  for (int i = 0; i < blocks_; ++i) b.segment<3>(3 * i) = x.segment<3>(3 * position_[i]);
}

}  // namespace furrow::physics
