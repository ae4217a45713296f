// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/patch_test.h"

#include <cmath>
#include <numeric>

#include "tests/cases/flat_meshes.h"
#include "tests/cases/modes.h"

namespace furrow::cases {
namespace {

using Eigen::VectorXd;
using physics::Cloth;
using physics::Vec3;

constexpr double patch_young = 100;  // N/m; nothing depends on it

/// The displacement of all unknowns that is `move` on the held ones and leaves the others without force.
struct Relaxation {
  Unknowns all, inside;
  Eigen::SparseMatrix<double> k;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> inner;

  Relaxation(const Cloth& cloth, const Cloth& held)
      : all(cloth, {true, true, false}),
        inside(held, {true, true, false}),
        k(stiffness(cloth, cloth.particles.x, all)),
        inner(stiffness(cloth, cloth.particles.x, inside)) {}

  VectorXd operator()(const VectorXd& affine) const {
    const VectorXd force = -(k * affine);
    VectorXd rest(inside.count), u = affine;
    for (std::size_t i = 0; i < all.of.size(); ++i) {
      for (int c = 0; c < 2; ++c) {
        if (inside.of[i][c] >= 0) rest[inside.of[i][c]] = force[all.of[i][c]];
      }
    }
    const VectorXd correction = inner.solve(rest);
    for (std::size_t i = 0; i < all.of.size(); ++i) {
      for (int c = 0; c < 2; ++c) {
        if (inside.of[i][c] >= 0) u[all.of[i][c]] += correction[inside.of[i][c]];
      }
    }
    return u;
  }
};

Cloth with_border_held(Cloth cloth) {
  for (const EdgeApexes& e : edges_of(cloth.triangles)) {
    if (e.left >= 0 && e.right >= 0) continue;
    for (const int i : {e.a, e.b}) cloth.particles.inv_mass[i] = 0;
  }
  return cloth;
}

/// target: energy over area of the exact membrane for unit strain [N/m].
PatchAnswer answer(const Cloth& cloth, const Relaxation& relax, const Eigen::Matrix2d& strain, double h,
                   double target) {
  VectorXd affine(relax.all.count);
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    affine.segment<2>(relax.all.of[i][0]) = strain * cloth.particles.x[i].head<2>();
  }
  const VectorXd u = relax(affine);
  double farthest = 0;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    farthest = std::max(farthest, (u - affine).segment<2>(relax.all.of[i][0]).norm());
  }
  return {0.5 * u.dot(relax.k * u) / target, farthest / h};
}

}  // namespace

PatchScore patch_test(Cloth sheet, int columns, const Carrier& carrier) {
  const std::vector<double> areas = rest_areas(sheet);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double mass = std::accumulate(sheet.particles.mass.begin(), sheet.particles.mass.end(), 0.0);
  double width = 0;
  for (const Vec3& x : sheet.particles.x) width = std::max(width, x.x());
  if (carrier) {
    set_membrane_stiffness(sheet, *carrier, calibrated_stiffness(sheet, *carrier, patch_young, areas), areas);
  } else {
    sheet.structural.clear();
    add_flat_membrane(sheet, patch_young, 1.0 / 3);
  }
  const Relaxation relax(sheet, with_border_held(sheet));
  const double h = width / columns;
  const auto score = [&](double xx, double xy, double yy, double target) {
    return answer(sheet, relax, (Eigen::Matrix2d() << xx, xy, xy, yy).finished(), h, area * target);
  };
  // W = Y/(1 - nu) = 3/2 Y for e = I;  2 mu = Y/(1 + nu) = 3/4 Y for both shears.
  const PatchAnswer dilation = score(1, 0, 1, 1.5 * patch_young);
  const PatchAnswer stretch = score(1, 0, -1, 0.75 * patch_young), slide = score(0, 1, 0, 0.75 * patch_young);
  const double omega = highest_frequency(relax.k, masses(sheet, relax.all));
  return {dilation, stretch, slide, 2 / omega / (h * std::sqrt(mass / area / patch_young))};
}

}  // namespace furrow::cases
