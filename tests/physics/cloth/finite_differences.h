// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

#include "physics/cloth/elements.h"
#include "tests/physics/cloth/test_cloths.h"

namespace furrow::tests {

using Positions = std::vector<Vec3>;

inline Eigen::VectorXd stacked(const Positions& x) {
  return Eigen::Map<const Eigen::VectorXd>(x.data()->data(), Eigen::Index(3 * x.size()));
}

inline Positions moved(const Positions& x, const Eigen::VectorXd& u) {
  Positions y = x;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += u.segment<3>(Eigen::Index(3 * i));
  return y;
}

inline Eigen::VectorXd forces(const Cloth& cloth, const Positions& x) {
  Positions force(x.size(), Vec3::Zero());
  physics::add_forces(cloth, x, force);
  return stacked(force);
}

inline Eigen::MatrixXd stiffness_matrix(const Cloth& cloth, const Positions& x,
                                        physics::Stiffness stiffness) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(Eigen::Index(3 * x.size()), Eigen::Index(3 * x.size()));
  physics::add_stiffness(cloth, x, stiffness, [&](int i, int j, const physics::Mat3& block) {
    matrix.block<3, 3>(3 * i, 3 * j) += block;
  });
  return matrix;
}

/// Central differences of order four with step h [m] in each coordinate.
template <typename Function>
Eigen::MatrixXd differences(const Positions& x, double h, const Function& f) {
  Eigen::MatrixXd result;
  for (Eigen::Index c = 0; c < Eigen::Index(3 * x.size()); ++c) {
    const auto at = [&](double s) {
      Eigen::VectorXd u = Eigen::VectorXd::Zero(Eigen::Index(3 * x.size()));
      u[c] = s * h;
      return f(moved(x, u));
    };
    const Eigen::VectorXd d = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
    if (c == 0) result.resize(d.size(), Eigen::Index(3 * x.size()));
    result.col(c) = d;
  }
  return result;
}

struct DerivativeErrors {
  double force, stiffness, symmetry;  ///< largest differences relative to the largest entry [-]
};

inline DerivativeErrors derivative_errors(const Cloth& cloth, const Positions& x, double h) {
  const Eigen::MatrixXd gradient = differences(x, h, [&](const Positions& y) {
    return Eigen::VectorXd::Constant(1, physics::potential_energy(cloth, y));
  });
  const Eigen::MatrixXd jacobian = differences(x, h, [&](const Positions& y) { return forces(cloth, y); });
  const Eigen::VectorXd f = forces(cloth, x);
  const Eigen::MatrixXd k = stiffness_matrix(cloth, x, physics::Stiffness::exact);
  const double f_scale = f.cwiseAbs().maxCoeff(), k_scale = k.cwiseAbs().maxCoeff();
  return {(gradient.transpose() + f).cwiseAbs().maxCoeff() / f_scale,
          (jacobian + k).cwiseAbs().maxCoeff() / k_scale,
          (k - k.transpose()).cwiseAbs().maxCoeff() / k_scale};
}

inline double least_eigenvalue(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

}  // namespace furrow::tests
