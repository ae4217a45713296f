// SPDX-License-Identifier: MIT
#include "physics/body/oriented_boxes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace furrow::physics {

OrientedBox fit_oriented_box(std::span<const Vec3> points) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& p : points) spread += (p - mean) * (p - mean).transpose();
  if (const double largest = spread.cwiseAbs().maxCoeff(); largest > 0) spread /= largest;
  const Eigen::Matrix3d axes =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().transpose();
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(Vec3(axes * p));
  return {axes, box.center(), box.sizes() / 2};
}

OrientedBoxes::OrientedBoxes() {
  for (int k = 0; k < 3; ++k) {
    for (Float4& a : axes[k]) a = splat(0);
    middle[k] = splat(0);
    half[k] = splat(1);
  }
}

void OrientedBoxes::set(int lane, const OrientedBox& box) {
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) axes[k][j][lane] = static_cast<float>(box.axes(k, j));
    middle[k][lane] = static_cast<float>(box.middle[k]);
    half[k][lane] = static_cast<float>(box.half[k]);
  }
}

}  // namespace furrow::physics
