// SPDX-License-Identifier: MIT
#include "physics/linear/block_matrix.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace furrow::physics {
namespace {

using Eigen::Index;

std::string name(int i, int j) { return "block (" + std::to_string(i) + ", " + std::to_string(j) + ")"; }

}  // namespace

/// Rows below the diagonal, of each column: ascending, without repetition.
BlockMatrix::Lists BlockMatrix::below_by(std::span<const std::array<int, 2>> pairs) const {
  Lists below(static_cast<std::size_t>(rows_));
  for (const auto& [i, j] : pairs) {
    if (i < 0 || j < 0 || std::size_t(std::max(i, j)) >= row_.size())
      throw std::invalid_argument("BlockMatrix: " + name(i, j) + " of " + std::to_string(row_.size()) +
                                  " particles");
    const int column = std::min(row(i), row(j)), r = std::max(row(i), row(j));
    if (column >= 0 && column != r) below[std::size_t(column)].push_back(r);
  }
  for (std::vector<int>& rows : below) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  }
  return below;
}

void BlockMatrix::lay_out(std::span<const int> outer, std::span<const int> inner) {
  const std::vector<double> zeros(inner.size(), 0.0);
  lower_ = Eigen::Map<const Sparse>(3 * rows_, 3 * rows_, Index(inner.size()), outer.data(), inner.data(),
                                    zeros.data());
}

BlockMatrix::BlockMatrix(std::span<const double> inv_mass, std::span<const std::array<int, 2>> pairs) {
  for (const double w : inv_mass) row_.push_back(w > 0 ? rows_++ : -1);
  const Lists below = below_by(pairs);
  std::vector<int> outer{0}, inner;
  for (int c = 0; c < rows_; ++c)
    for (int e = 0; e < 3; ++e) {
      for (int f = e; f < 3; ++f) inner.push_back(3 * c + f);
      for (const int r : below[std::size_t(c)]) inner.insert(inner.end(), {3 * r, 3 * r + 1, 3 * r + 2});
      outer.push_back(int(inner.size()));
    }
  lay_out(outer, inner);
}

BlockMatrix::BlockMatrix(const BlockMatrix& fewer, std::span<const std::array<int, 2>> more)
    : rows_(fewer.rows_), row_(fewer.row_) {
  Lists below = below_by(more);
  std::vector<int> outer{0}, inner, all;
  inner.reserve(std::size_t(fewer.lower_.nonZeros()) + 9 * more.size());
  for (int c = 0; c < rows_; ++c) {
    std::vector<int>& rows = below[std::size_t(c)];
    std::erase_if(rows, [&](int r) { return fewer.find_below(c, r) >= 0; });
    for (int e = 0; e < 3; ++e) {
      const int *const old = fewer.lower_.outerIndexPtr() + 3 * c + e,
                       *const begin = fewer.lower_.innerIndexPtr() + old[0],
                       *const end = fewer.lower_.innerIndexPtr() + old[1];
      const std::size_t whole = inner.size() + std::size_t(3 - e);
      inner.insert(inner.end(), begin, end);
      for (const int r : rows) inner.insert(inner.end(), {3 * r, 3 * r + 1, 3 * r + 2});
      if (!rows.empty()) std::sort(inner.begin() + std::ptrdiff_t(whole), inner.end());
      outer.push_back(int(inner.size()));
    }
  }
  lay_out(outer, inner);
}

int BlockMatrix::find_below(int column, int r) const {
  const int begin = begin_of(column), length = length_of(column);
  const int* rows = lower_.innerIndexPtr() + begin;  // by threes, the diagonal block first
  int low = 1, high = length / 3;
  while (low < high) {
    const int middle = (low + high) / 2;
    if (rows[3 * middle] < 3 * r)
      low = middle + 1;
    else
      high = middle;
  }
  return low >= length / 3 || rows[3 * low] != 3 * r ? -1 : begin + 3 * low;
}

bool BlockMatrix::has(int i, int j) const {
  const int column = std::min(row(i), row(j)), r = std::max(row(i), row(j));
  return column < 0 || r == column || find_below(column, r) >= 0;
}

BlockMatrix::Place BlockMatrix::place(int i, int j) const {
  const int column = std::min(row(i), row(j)), r = std::max(row(i), row(j));
  if (column < 0) return {};
  const int length = length_of(column);
  if (r == column) return {begin_of(column), length, column, Place::diagonal};
  const int value = find_below(column, r);
  if (value < 0) throw std::invalid_argument("BlockMatrix: there is no " + name(i, j));
  return {value, length, column, row(i) > row(j) ? Place::below : Place::above};
}

BlockMatrix::Place BlockMatrix::carried(const Place& place, const BlockMatrix& fewer) const {
  if (place.value < 0) return place;
  const int c = place.column, length = length_of(c);
  if (place.part != Place::diagonal && length != place.column_length)
    return {find_below(c, fewer.lower_.innerIndexPtr()[place.value] / 3), length, c, place.part};
  return {place.value - fewer.begin_of(c) + begin_of(c), length, c, place.part};
}

Eigen::VectorXd BlockMatrix::gather(std::span<const Vec3> v) const {
  Eigen::VectorXd rows(3 * rows_);
  for (std::size_t i = 0; i < v.size(); ++i)
    if (row_[i] >= 0) rows.segment<3>(3 * row_[i]) = v[i];
  return rows;
}

void BlockMatrix::scatter(const Eigen::VectorXd& rows, std::span<Vec3> v) const {
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = row_[i] >= 0 ? Vec3(rows.segment<3>(3 * row_[i])) : Vec3::Zero();
}

}  // namespace furrow::physics
