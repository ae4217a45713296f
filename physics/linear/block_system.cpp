// SPDX-License-Identifier: MIT
#include "physics/linear/block_system.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <stdexcept>
#include <string>

namespace furrow::physics {
namespace {

using Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;
using Factor = Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>>;

/// For each row its place in the order of elimination, -1 if it is not free.
std::vector<int> eliminate(std::span<const char> is_free, std::span<const std::array<int, 2>> pairs) {
  std::vector<int> free_rows, number(is_free.size(), -1);
  for (std::size_t i = 0; i < is_free.size(); ++i) {
    if (!is_free[i]) continue;
    number[i] = int(free_rows.size());
    free_rows.push_back(int(i));
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < int(free_rows.size()); ++i) entries.emplace_back(i, i, 1);
  for (const auto& [a, b] : pairs) {
    const int i = number[std::size_t(a)], j = number[std::size_t(b)];
    if (i < 0 || j < 0 || i == j) continue;
    entries.emplace_back(i, j, 1);
    entries.emplace_back(j, i, 1);
  }
  Sparse graph{Index(free_rows.size()), Index(free_rows.size())};
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  if (!free_rows.empty()) Eigen::AMDOrdering<int>()(graph, order);
  std::vector<int> position(is_free.size(), -1);
  for (int k = 0; k < int(free_rows.size()); ++k)
    position[std::size_t(free_rows[std::size_t(order.indices()[k])])] = k;
  return position;
}

}  // namespace

struct BlockSystem::Matrix {
  std::vector<int> position;              // of each row in the order of elimination, or -1
  std::vector<int> begin;                 // first block of each block column in `rows`, and the end
  std::vector<int> rows;                  // block rows, ascending, the diagonal first
  std::vector<std::array<int, 3>> start;  // of each block: where its columns begin among the values
  std::vector<char> whole;                // of each block: not a diagonal one
  Sparse values;
  Factor factor;

  void make_columns(std::span<const std::array<int, 2>> pairs);
  void make_pattern();
};

void BlockSystem::Matrix::make_columns(std::span<const std::array<int, 2>> pairs) {
  const auto n = std::size_t(std::count_if(position.begin(), position.end(), [](int p) { return p >= 0; }));
  std::vector<std::vector<int>> columns(n);
  for (std::size_t c = 0; c < n; ++c) columns[c].push_back(int(c));
  for (const auto& [a, b] : pairs) {
    const auto [column, row] = std::minmax(position[std::size_t(a)], position[std::size_t(b)]);
    if (column >= 0) columns[std::size_t(column)].push_back(row);
  }
  begin.push_back(0);
  for (std::vector<int>& column : columns) {
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
    rows.insert(rows.end(), column.begin(), column.end());
    begin.push_back(int(rows.size()));
  }
}

/// The lower triangle, column by column: of a diagonal block only its own lower triangle.
void BlockSystem::Matrix::make_pattern() {
  const int n = int(begin.size()) - 1;
  std::vector<int> outer{0}, inner;
  start.resize(rows.size());
  whole.resize(rows.size());
  for (int c = 0; c < n; ++c) {
    for (int e = 0; e < 3; ++e) {
      for (int k = begin[std::size_t(c)]; k < begin[std::size_t(c) + 1]; ++k) {
        start[std::size_t(k)][std::size_t(e)] = int(inner.size());
        whole[std::size_t(k)] = rows[std::size_t(k)] != c;
        const int first = whole[std::size_t(k)] ? 0 : e;
        for (int f = first; f < 3; ++f) inner.push_back(3 * rows[std::size_t(k)] + f);
      }
      outer.push_back(int(inner.size()));
    }
  }
  const std::vector<double> zeros(inner.size(), 0.0);
  values =
      Eigen::Map<const Sparse>(3 * n, 3 * n, Index(inner.size()), outer.data(), inner.data(), zeros.data());
  factor.analyzePattern(values);
}

BlockSystem::BlockSystem(std::span<const char> is_free, std::span<const std::array<int, 2>> pairs)
    : matrix_(std::make_unique<Matrix>()) {
  for (const auto& [a, b] : pairs) {
    if (a < 0 || b < 0 || std::size_t(a) >= is_free.size() || std::size_t(b) >= is_free.size()) {
      throw std::invalid_argument("BlockSystem: block (" + std::to_string(a) + ", " + std::to_string(b) +
                                  ") of " + std::to_string(is_free.size()) + " rows");
    }
  }
  matrix_->position = eliminate(is_free, pairs);
  matrix_->make_columns(pairs);
  matrix_->make_pattern();
}

BlockSystem::~BlockSystem() = default;

int BlockSystem::place(int i, int j) const {
  const Matrix& m = *matrix_;
  const int row = m.position[std::size_t(i)], column = m.position[std::size_t(j)];
  if (row < 0 || column < 0 || row < column) return -1;
  const auto first = m.rows.begin() + m.begin[std::size_t(column)],
             last = m.rows.begin() + m.begin[std::size_t(column) + 1];
  const auto found = std::lower_bound(first, last, row);
  if (found == last || *found != row) {
    throw std::invalid_argument("BlockSystem: no block (" + std::to_string(i) + ", " + std::to_string(j) +
                                ")");
  }
  return int(found - m.rows.begin());
}

void BlockSystem::set_zero() { std::fill_n(matrix_->values.valuePtr(), matrix_->values.nonZeros(), 0.0); }

void BlockSystem::add(int place, const Mat3& block) {
  if (place < 0) return;
  const std::array<int, 3>& start = matrix_->start[std::size_t(place)];
  double* values = matrix_->values.valuePtr();
  const bool whole = matrix_->whole[std::size_t(place)];
  for (int e = 0; e < 3; ++e) {
    double* to = values + start[std::size_t(e)] - (whole ? 0 : e);
    for (int f = whole ? 0 : e; f < 3; ++f) to[f] += block(f, e);
  }
}

bool BlockSystem::factorise() {
  matrix_->factor.factorize(matrix_->values);
  return matrix_->factor.info() == Eigen::Success;
}

void BlockSystem::solve(std::vector<Vec3>& b) const {
  const std::vector<int>& position = matrix_->position;
  Eigen::VectorXd y(matrix_->values.rows());
  for (std::size_t i = 0; i < b.size(); ++i)
    if (position[i] >= 0) y.segment<3>(3 * position[i]) = b[i];
  if (y.size() > 0) y = matrix_->factor.solve(y).eval();
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (position[i] >= 0) {
      b[i] = y.segment<3>(3 * position[i]);
    } else {
      b[i].setZero();
    }
  }
}

}  // namespace furrow::physics
