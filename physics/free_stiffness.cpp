// SPDX-License-Identifier: MIT
#include "physics/free_stiffness.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace furrow::physics {

FreeStiffness::FreeStiffness(const Cloth& cloth) {
  if (cloth.particles.inv_mass.size() != cloth.particles.size()) {
    throw std::invalid_argument("FreeStiffness: " + std::to_string(cloth.particles.size()) +
                                " positions, but " + std::to_string(cloth.particles.inv_mass.size()) +
                                " inverse masses");
  }
  for (const double w : cloth.particles.inv_mass) row_.push_back(w > 0 ? free_particles_++ : -1);
  std::vector<std::array<int, 2>> sequence;
  add_stiffness(cloth, cloth.particles.x, Stiffness::positive_part, [&](int i, int j, const Mat3&) {
    sequence.push_back({row_[i], row_[j]});
  });
  make_pattern(sequence);
}

/// Columns of the lower triangle: of block column c its diagonal block from the diagonal down, then the
/// blocks below it, whole.
void FreeStiffness::make_pattern(std::span<const std::array<int, 2>> sequence) {
  std::vector<std::vector<int>> below(free_particles_);
  for (const auto& [i, j] : sequence) {
    if (i > j && j >= 0) below[j].push_back(i);
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
  for (const auto& [i, j] : sequence) {
    std::array<int, 3>& place = place_.emplace_back(std::array<int, 3>{-1, -1, -1});
    if (j < 0 || i < j) continue;
    for (int e = 0; e < 3; ++e) {
      const auto first = inner.begin() + outer[3 * j + e], last = inner.begin() + outer[3 * j + e + 1];
      // For the diagonal block this is where its row e stands; its rows above are not stored.
      place[e] = int(std::lower_bound(first, last, i == j ? 3 * j + e : 3 * i) - inner.begin());
    }
  }
}

void FreeStiffness::assemble(const Cloth& cloth, std::span<const Vec3> x, Stiffness stiffness) {
  double* values = matrix_.valuePtr();
  std::fill_n(values, matrix_.nonZeros(), 0.0);
  std::size_t next = 0;
  add_stiffness(cloth, x, stiffness, [&](int i, int j, const Mat3& block) {
    if (next == place_.size()) throw std::invalid_argument("FreeStiffness: the cloth has more elements now");
    const std::array<int, 3>& place = place_[next++];
    if (place[0] < 0) return;
    for (int e = 0; e < 3; ++e) {
      const int first = i == j ? e : 0;
      for (int f = first; f < 3; ++f) values[place[e] + f - first] += block(f, e);
    }
  });
  if (next != place_.size()) throw std::invalid_argument("FreeStiffness: the cloth has fewer elements now");
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
