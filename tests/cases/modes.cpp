// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/modes.h"

#include <Eigen/Dense>
#include <Eigen/SparseLU>
#include <cmath>
#include <stdexcept>
#include <string>

namespace furrow::cases {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using physics::Cloth;
using physics::Vec3;
using Matrix = Eigen::SparseMatrix<double>;

/// Numbers without pattern, the same on every machine.
double noise(Index i) { return std::sin(double(1 + i) * 12.9898 + 0.5 * double(i % 7)); }

Matrix scaled(const Matrix& k, const VectorXd& m) {
  const VectorXd s = m.cwiseSqrt().cwiseInverse();
  return s.asDiagonal() * k * s.asDiagonal();
}

VectorXd residual(const Cloth& cloth, const std::vector<Vec3>& x, const Unknowns& unknowns, const Vec3& g) {
  std::vector<Vec3> force(x.size(), Vec3::Zero());
  for (std::size_t i = 0; i < x.size(); ++i) force[i] = cloth.particles.mass[i] * g;
  physics::add_forces(cloth, x, force);
  VectorXd r(unknowns.count);
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      if (unknowns.of[i][c] >= 0) r[unknowns.of[i][c]] = force[i][c];
    }
  }
  return r;
}

std::vector<Vec3> moved(std::vector<Vec3> x, const Unknowns& unknowns, const VectorXd& u) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      if (unknowns.of[i][c] >= 0) x[i][c] += u[unknowns.of[i][c]];
    }
  }
  return x;
}

}  // namespace

Unknowns::Unknowns(const Cloth& cloth, const std::array<bool, 3>& axes) {
  for (const double w : cloth.particles.inv_mass) {
    of.push_back({-1, -1, -1});
    for (int c = 0; c < 3; ++c) {
      if (w > 0 && axes[c]) of.back()[c] = count++;
    }
  }
}

Matrix stiffness(const Cloth& cloth, const std::vector<Vec3>& x, const Unknowns& unknowns,
                 physics::Stiffness part) {
  std::vector<Eigen::Triplet<double>> entries;
  physics::add_stiffness(cloth, x, part, [&](int i, int j, const physics::Mat3& block) {
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        const int row = unknowns.of[i][r], column = unknowns.of[j][c];
        if (row >= 0 && column >= 0) entries.emplace_back(row, column, block(r, c));
      }
    }
  });
  Matrix k(unknowns.count, unknowns.count);
  k.setFromTriplets(entries.begin(), entries.end());
  return k;
}

VectorXd masses(const Cloth& cloth, const Unknowns& unknowns) {
  VectorXd m(unknowns.count);
  for (std::size_t i = 0; i < unknowns.of.size(); ++i) {
    for (const int row : unknowns.of[i]) {
      if (row >= 0) m[row] = cloth.particles.mass[i];
    }
  }
  return m;
}

VectorXd lowest_frequencies(const Matrix& k, const VectorXd& m, int count) {
  const Index n = k.rows();
  if (count < 1 || count > n) {
    throw std::invalid_argument("lowest_frequencies: count = " + std::to_string(count) + " of " +
                                std::to_string(n));
  }
  const Matrix a = scaled(k, m);
  if (n <= 300) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(MatrixXd(a), Eigen::EigenvaluesOnly);
    return solver.eigenvalues().head(count).cwiseSqrt();
  }
  const Eigen::SimplicialLDLT<Matrix> inverse(a);
  if (inverse.info() != Eigen::Success) throw std::runtime_error("lowest_frequencies: K is singular");
  const Index width = std::min<Index>(n, 2 * count + 8);
  MatrixXd q = MatrixXd::NullaryExpr(n, width, [](Index r, Index c) { return noise(r * 31 + c * 1013); });
  VectorXd before = VectorXd::Zero(count);
  for (int round = 0; round < 500; ++round) {
    const MatrixXd z = inverse.solve(q);
    q = Eigen::HouseholderQR<MatrixXd>(z).householderQ() * MatrixXd::Identity(n, width);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> small(q.transpose() * (a * q));
    q = q * small.eigenvectors();
    const VectorXd now = small.eigenvalues().head(count);
    if ((now - before).cwiseAbs().maxCoeff() <= 1e-11 * now[0]) return now.cwiseSqrt();
    before = now;
  }
  throw std::runtime_error("lowest_frequencies: no convergence");
}

double highest_frequency(const Matrix& k, const VectorXd& m) {
  const Matrix a = scaled(k, m);
  const Index n = a.rows();
  std::vector<VectorXd> basis{VectorXd::NullaryExpr(n, [](Index i) { return noise(i); }).normalized()};
  VectorXd alpha(n), beta(n);
  for (Index j = 0; j < n; ++j) {
    VectorXd w = a * basis.back();
    alpha[j] = w.dot(basis.back());
    for (int round = 0; round < 2; ++round) {
      for (const VectorXd& b : basis) w -= b.dot(w) * b;
    }
    beta[j] = w.norm();
    const bool last = j + 1 == n || beta[j] < 1e-14 * alpha[0];
    if (last || j % 16 == 15) {
      Eigen::SelfAdjointEigenSolver<MatrixXd> small;
      small.computeFromTridiagonal(alpha.head(j + 1), beta.head(j), Eigen::ComputeEigenvectors);
      // An eigenvalue errs by at most residual^2 / gap, and the residual itself bounds it without a gap.
      const double error = beta[j] * std::abs(small.eigenvectors()(j, j)), top = small.eigenvalues()[j];
      if (last || (j >= 47 && error <= 1e-7 * top)) return std::sqrt(top);
    }
    basis.push_back(w / beta[j]);
  }
  return 0;
}

int find_rest(Cloth& cloth, const Unknowns& unknowns, const Vec3& gravity, double tolerance) {
  std::vector<Vec3>& x = cloth.particles.x;
  VectorXd r = residual(cloth, x, unknowns, gravity);
  for (int round = 0; round < 200; ++round) {
    if (r.cwiseAbs().maxCoeff() <= tolerance) return round;
    // Not by Cholesky: K may be indefinite where something is compressed.
    Eigen::SparseLU<Matrix> solver(stiffness(cloth, x, unknowns));
    if (solver.info() != Eigen::Success) throw std::runtime_error("find_rest: K is singular");
    VectorXd step = solver.solve(r);
    for (int halving = 0;; ++halving, step /= 2) {
      std::vector<Vec3> next = moved(x, unknowns, step);
      const VectorXd after = residual(cloth, next, unknowns, gravity);
      if (!(after.norm() < r.norm()) && halving < 30) continue;
      x = std::move(next);
      r = after;
      break;
    }
  }
  throw std::runtime_error("find_rest: no rest after 200 iterations");
}

}  // namespace furrow::cases
