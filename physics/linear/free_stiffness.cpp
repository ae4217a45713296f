// SPDX-License-Identifier: MIT
#include "physics/linear/free_stiffness.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace furrow::physics {
namespace {

constexpr int chunk = 4096;  // elements whose blocks stay in the caches
constexpr int piece = 128;   // elements that a thread does at once
constexpr int buckets = 32;  // of columns

}  // namespace

FreeStiffness::FreeStiffness(const Cloth& cloth) {
  if (cloth.particles.inv_mass.size() != cloth.particles.size()) {
    throw std::invalid_argument("FreeStiffness: " + std::to_string(cloth.particles.size()) +
                                " positions, but " + std::to_string(cloth.particles.inv_mass.size()) +
                                " inverse masses");
  }
  for (const double w : cloth.particles.inv_mass) row_.push_back(w > 0 ? free_particles_++ : -1);
  counts_ = count_elements(cloth);
  Pairs pairs = block_pairs(cloth);
  for (auto& pair : pairs) pair = {row_[pair[0]], row_[pair[1]]};
  place_blocks(pairs, make_pattern(pairs));
}

/// Columns of the lower triangle: of block column c its diagonal block from the diagonal down, then the
/// blocks below it, whole. Returns the rows of these.
std::vector<std::vector<int>> FreeStiffness::make_pattern(const Pairs& pairs) {
  std::vector<std::vector<int>> below(free_particles_);
  for (const auto& [i, j] : pairs) {
    if (i != j && i >= 0 && j >= 0) below[std::min(i, j)].push_back(std::max(i, j));
  }
  std::vector<int> outer{0}, inner;
  for (int c = 0; c < free_particles_; ++c) {
    std::sort(below[c].begin(), below[c].end());
    below[c].erase(std::unique(below[c].begin(), below[c].end()), below[c].end());
    for (int e = 0; e < 3; ++e) {
      for (int f = e; f < 3; ++f) inner.push_back(3 * c + f);
      for (const int r : below[c]) inner.insert(inner.end(), {3 * r, 3 * r + 1, 3 * r + 2});
      outer.push_back(int(inner.size()));
    }
  }
  const std::vector<double> zeros(inner.size(), 0);
  matrix_ = Eigen::Map<const Sparse>(3 * free_particles_, 3 * free_particles_, Eigen::Index(inner.size()),
                                     outer.data(), inner.data(), zeros.data());
  return below;
}

/// Where each block goes; in each chunk those of a bucket of columns follow each other in the elements'
/// order.
void FreeStiffness::place_blocks(const Pairs& pairs, const std::vector<std::vector<int>>& below) {
  const int elements = counts_.total();
  buckets_.assign(1, 0);
  for (int begin = 0; begin < elements; begin += chunk) {
    const int first = first_block(counts_, begin),
              end = first_block(counts_, std::min(begin + chunk, elements));
    blocks_.resize(std::max(blocks_.size(), std::size_t(end - first)));
    std::array<std::vector<Addend>, buckets> sorted;
    for (int b = first; b < end; ++b) {
      const auto [i, j] = pairs[std::size_t(b)];
      if (i < 0 || j < 0) continue;
      const auto [c, r] = std::minmax(i, j);
      const int* outer = matrix_.outerIndexPtr() + 3 * c;
      const auto at = std::lower_bound(below[c].begin(), below[c].end(), r) - below[c].begin();
      sorted[std::size_t(std::int64_t(buckets) * c / free_particles_)].push_back(
          {b - first, r == c ? outer[0] : outer[0] + 3 + 3 * int(at), outer[1] - outer[0],
           r == c  ? Addend::diagonal
           : i > j ? Addend::below
                   : Addend::transposed});
    }
    for (const auto& bucket : sorted) {
      addends_.insert(addends_.end(), bucket.begin(), bucket.end());
      buckets_.push_back(addends_.size());
    }
  }
}

/// Adds a chunk's blocks to a bucket's columns. A column is one number shorter than that before it.
void FreeStiffness::sum(int number, int bucket) {
  const std::size_t first = std::size_t(number) * buckets + std::size_t(bucket);
  for (std::size_t a = buckets_[first]; a < buckets_[first + 1]; ++a) {
    const Addend& to = addends_[a];
    const Mat3& block = blocks_[std::size_t(to.block)];
    const int n = to.column_length;
    double* v = matrix_.valuePtr() + to.place;
    if (to.kind == Addend::diagonal) {
      v[0] += block(0, 0), v[1] += block(1, 0), v[2] += block(2, 0);
      v[n] += block(1, 1), v[n + 1] += block(2, 1);
      v[2 * n - 1] += block(2, 2);
      continue;
    }
    for (int e = 0; e < 3; v += n - ++e) {
      for (int f = 0; f < 3; ++f) v[f] += to.kind == Addend::below ? block(f, e) : block(e, f);
    }
  }
}

void FreeStiffness::assemble(const Cloth& cloth, std::span<const Vec3> x, Stiffness stiffness,
                             ThreadPool* pool) {
  if (!fits(counts_, cloth))
    throw std::invalid_argument("FreeStiffness: the cloth has other numbers of elements now");
  if (x.size() != row_.size())
    throw std::invalid_argument("FreeStiffness: " + std::to_string(x.size()) + " positions of " +
                                std::to_string(row_.size()) + " particles");
  const auto each = [pool](int n, const auto& work) {
    if (pool) return pool->share(n, [&](int i, int) { work(i); });
    for (int i = 0; i < n; ++i) work(i);
  };
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  const int elements = counts_.total();
  for (int begin = 0; begin < elements; begin += chunk) {
    const int end = std::min(begin + chunk, elements), first = first_block(counts_, begin);
    each((end - begin + piece - 1) / piece, [&](int i) {
      const int from = begin + i * piece;
      stiffness_blocks(cloth, counts_, x, stiffness, from, std::min(from + piece, end),
                       blocks_.data() + (first_block(counts_, from) - first));
    });
    each(buckets, [&](int bucket) { sum(begin / chunk, bucket); });
  }
}

void FreeStiffness::add(int particle, const Mat3& block) {
  if (row_[particle] < 0) return;
  for (int e = 0; e < 3; ++e) {  // each column begins with its diagonal
    double* column = matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * row_[particle] + e];
    for (int f = e; f < 3; ++f) column[f - e] += block(f, e);
  }
}

bool FreeStiffness::factorise_definite(double shift, ThreadPool* pool) {
  is_definite_ = true;
  if (free_particles_ == 0) return true;
  if (!definite_analysed_) definite_.analyse(matrix_);
  definite_analysed_ = true;
  return definite_.factorise(matrix_, shift, pool);
}

int FreeStiffness::factorise(double shift) {
  is_definite_ = false;
  if (free_particles_ == 0) return 0;
  if (!analysed_) factor_.analyzePattern(matrix_);
  analysed_ = true;
  factor_.setShift(shift);
  factor_.factorize(matrix_);
  if (factor_.info() != Eigen::Success || !factor_.vectorD().allFinite()) return -1;
  return int((factor_.vectorD().array() < 0).count());
}

void FreeStiffness::solve(std::span<Vec3> b, ThreadPool* pool) const {
  Eigen::VectorXd y(3 * free_particles_);
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (row_[i] >= 0) y.segment<3>(3 * row_[i]) = b[i];
  }
  if (free_particles_ > 0 && is_definite_) definite_.solve(y, pool);
  if (free_particles_ > 0 && !is_definite_) y = factor_.solve(y).eval();
  for (std::size_t i = 0; i < b.size(); ++i) {
    b[i].setZero();
    if (row_[i] >= 0) b[i] = y.segment<3>(3 * row_[i]);
  }
}

double FreeStiffness::mean_diagonal() const { return free_particles_ == 0 ? 0 : matrix_.diagonal().mean(); }

}  // namespace furrow::physics
