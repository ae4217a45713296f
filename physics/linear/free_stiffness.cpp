// SPDX-License-Identifier: MIT
#include "physics/linear/free_stiffness.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "physics/base/cancel_scope.h"
#include "physics/base/vector_sums.h"
#include "physics/linear/negative_pivots.h"

namespace furrow::physics {
namespace {

constexpr int chunk = 1024;  // elements whose blocks stay in the caches
constexpr int piece = 128;   // elements that a thread does at once
constexpr int buckets = 32;  // of columns

std::uint64_t hash_of(const std::vector<std::array<int, 2>>& pairs) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const auto& pair : pairs)
    for (const int i : pair) hash = (hash ^ std::uint64_t(i)) * 0x100000001b3;
  return hash;
}

}  // namespace

FreeStiffness::FreeStiffness(const Cloth& cloth, bool narrow) : narrow_(narrow) {
  if (cloth.particles.inv_mass.size() != cloth.particles.size()) {
    throw std::invalid_argument("FreeStiffness: " + std::to_string(cloth.particles.size()) +
                                " positions, but " + std::to_string(cloth.particles.inv_mass.size()) +
                                " inverse masses");
  }
  particles_ = cloth.particles.size();
  counts_ = count_elements(cloth, {0, narrow_});
  const Pairs pairs = block_pairs(cloth, {0, narrow_});
  throw_if_cancelled("stiffness");
  pattern_ = hash_of(pairs);
  matrix_ = BlockMatrix(cloth.particles.inv_mass, pairs);
  throw_if_cancelled("stiffness");
  place_blocks(pairs);
}

void FreeStiffness::couple(Pairs pairs) {
  if (own_.rows() == 0) {
    own_ = matrix_;
    for (const Addend& a : addends_) own_places_.push_back(a.place);
  }
  matrix_ = BlockMatrix(own_, pairs);
  for (std::size_t i = 0; i < addends_.size(); ++i) addends_[i].place = matrix_.carried(own_places_[i], own_);
  coupled_ = std::move(pairs);
  analysed_ = false;
}

void FreeStiffness::order_for(Pairs pairs) {
  couple(std::move(pairs));
  if (matrix_.rows() > 0) analyse(true);
}

bool FreeStiffness::belongs_to(const Cloth& cloth) const {
  if (cloth.particles.size() != particles_ || !fits(counts_, cloth)) return false;
  for (std::size_t i = 0; i < particles_; ++i)
    if ((cloth.particles.inv_mass[i] > 0) != (matrix_.row(int(i)) >= 0)) return false;
  return hash_of(block_pairs(cloth, {0, narrow_})) == pattern_;
}

/// Where each block goes; in each chunk those of a bucket of columns follow each other in the elements'
/// order.
void FreeStiffness::place_blocks(const Pairs& pairs) {
  const int elements = counts_.total();
  buckets_.assign(1, 0);
  for (int begin = 0; begin < elements; begin += chunk) {
    const int first = first_block(counts_, begin),
              end = first_block(counts_, std::min(begin + chunk, elements));
    blocks_.resize(std::max(blocks_.size(), std::size_t(end - first)));
    std::array<std::vector<Addend>, buckets> sorted;
    for (int b = first; b < end; ++b) {
      const auto [i, j] = pairs[std::size_t(b)];
      const int column = std::min(matrix_.row(i), matrix_.row(j));
      if (column < 0) continue;
      sorted[std::size_t(std::int64_t(buckets) * column / matrix_.rows())].push_back(
          {b - first, matrix_.place(i, j)});
    }
    for (const auto& bucket : sorted) {
      addends_.insert(addends_.end(), bucket.begin(), bucket.end());
      buckets_.push_back(addends_.size());
    }
  }
}

/// Adds a chunk's blocks to a bucket's columns.
void FreeStiffness::sum(int number, int bucket) {
  const std::size_t first = std::size_t(number) * buckets + std::size_t(bucket);
  for (std::size_t a = buckets_[first]; a < buckets_[first + 1]; ++a)
    matrix_.add(addends_[a].place, blocks_[std::size_t(addends_[a].block)]);
}

void FreeStiffness::assemble(const Cloth& cloth, std::span<const Vec3> x, Stiffness stiffness,
                             ThreadPool* pool) {
  if (!fits(counts_, cloth))
    throw std::invalid_argument("FreeStiffness: the cloth has other numbers of elements now");
  if (x.size() != particles_)
    throw std::invalid_argument("FreeStiffness: " + std::to_string(x.size()) + " positions of " +
                                std::to_string(particles_) + " particles");
  stiffness.narrow = narrow_;
  assemble([&](int begin, int end,
               Mat3* blocks) { stiffness_blocks(cloth, counts_, x, stiffness, begin, end, blocks); },
           pool);
}

void FreeStiffness::assemble(const MakeBlocks& make, ThreadPool* pool) {
  const auto each = [pool](int n, const auto& work) {
    if (pool) return pool->share(n, [&](int i, int) { work(i); });
    for (int i = 0; i < n; ++i) work(i);
  };
  matrix_.set_zero();
  const int elements = counts_.total();
  for (int begin = 0; begin < elements; begin += chunk) {
    const int end = std::min(begin + chunk, elements), first = first_block(counts_, begin);
    each((end - begin + piece - 1) / piece, [&](int i) {
      const int from = begin + i * piece;
      make(from, std::min(from + piece, end), blocks_.data() + (first_block(counts_, from) - first));
    });
    each(buckets, [&](int bucket) { sum(begin / chunk, bucket); });
  }
}

void FreeStiffness::add(int particle, const Mat3& block) {
  matrix_.add(matrix_.place(particle, particle), block);
}

void FreeStiffness::add(int i, int j, const Mat3& block) { matrix_.add(matrix_.place(i, j), block); }

int FreeStiffness::negative_eigenvalues() const {
  return matrix_.rows() == 0 ? 0 : negative_pivots(matrix_.lower());
}

void FreeStiffness::analyse(bool anew) {
  if (analysed_) return;
  const bool kept = ordered_ && !anew && definite_.analyse_like(matrix_.lower());
  if (!kept) {
    definite_.analyse(matrix_.lower());
    ordered_for_ = coupled_;
  }
  analysed_ = ordered_ = true;
}

bool FreeStiffness::factorise_definite(double shift, ThreadPool* pool) {
  if (matrix_.rows() == 0) return true;
  analyse();
  return definite_.factorise(matrix_.lower(), shift, pool);
}

bool FreeStiffness::factorise_single(ThreadPool* pool) {
  if (matrix_.rows() == 0) return true;
  analyse();
  return definite_.factorise_single(matrix_.lower(), pool);
}

std::vector<Vec3> FreeStiffness::times(std::span<const Vec3> v) const {
  const Eigen::VectorXd product = matrix_.lower().selfadjointView<Eigen::Lower>() * matrix_.gather(v);
  std::vector<Vec3> result(v.size());
  matrix_.scatter(product, result);
  return result;
}

void FreeStiffness::solve(std::span<Vec3> b, ThreadPool* pool) const {
  Eigen::VectorXd y = matrix_.gather(b);
  if (matrix_.rows() > 0) definite_.solve(y, pool);
  matrix_.scatter(y, b);
}

bool FreeStiffness::solve_within(double least, std::span<Vec3> b, ThreadPool* pool) const {
  const std::vector<Vec3> given(b.begin(), b.end());
  const double enough = least * std::sqrt(dot(given, given));
  std::vector<Vec3> x(b.size(), Vec3::Zero()), left = given;
  for (int solves = 0; solves < 2; ++solves) {
    solve(left, pool);
    add_multiple(x, 1, left);
    left = given;
    add_multiple(left, -1, times(x));
    if (!(dot(left, left) <= enough * enough)) continue;
    std::copy(x.begin(), x.end(), b.begin());
    return true;
  }
  return false;
}

double FreeStiffness::mean_diagonal() const {
  return matrix_.rows() == 0 ? 0 : matrix_.lower().diagonal().mean();
}

}  // namespace furrow::physics
