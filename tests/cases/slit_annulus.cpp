// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/slit_annulus.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "physics/cloth/patch_membrane.h"
#include "physics/rest/settle.h"
#include "tests/cases/plates.h"

namespace furrow::cases {
namespace {

using namespace physics;

constexpr double inner_radius = 6, outer_radius = 10, plate_young = 21e6, plate_thickness = 0.03,
                 full_load = 0.8;
constexpr double way_around =
    2 * std::numbers::pi * 0.5 * (inner_radius + outer_radius);  // length of the flat sheet

/// Forces that stay as they are, along z.
class DeadLoad : public Energy {
 public:
  DeadLoad(std::vector<int> particles, std::vector<double> force)
      : particles_(std::move(particles)), force_(std::move(force)) {}
  double energy(std::span<const Vec3> x) const override {
    double sum = 0;
    for (std::size_t i = 0; i < force_.size(); ++i) sum -= force_[i] * x[std::size_t(particles_[i])].z();
    return sum;
  }
  void add_forces(std::span<const Vec3>, std::span<Vec3> force) const override {
    for (std::size_t i = 0; i < force_.size(); ++i) force[std::size_t(particles_[i])].z() += force_[i];
  }
  bool add_stiffness(std::span<const Vec3>, Stiffness, const BlockSink&) const override { return true; }

 private:
  std::vector<int> particles_;
  std::vector<double> force_;
};

Cloth flat_sheet(SheetKind kind, int columns, int rows) {
  const double high = outer_radius - inner_radius;
  switch (kind) {
    case SheetKind::one_diagonal:
      return right_sheet(way_around, high, columns, rows);
    case SheetKind::union_jack:
      return right_sheet(way_around, high, columns, rows, 0.1, true);
    case SheetKind::by_row:
      return row_sheet(way_around, high, columns, rows);
    case SheetKind::cut_jittered:
      return jittered_right_sheet(way_around, high, columns, rows);
    case SheetKind::equilateral:
      return triangular_sheet(way_around, high, columns, rows);
    case SheetKind::jittered:
      return triangular_sheet(way_around, high, columns, rows, 0.1, 0.2);
    default:
      throw std::invalid_argument("slit_annulus: no such mesh");
  }
}

/// Holds the particles at x = 0 and puts a held triangle behind each edge of theirs: a plate takes it for a
/// clamp.
void clamp_side(Cloth& cloth, double h) {
  Particles& p = cloth.particles;
  const auto is_held = [&](int i) {
    return p.x[std::size_t(i)].x() < 1e-9 && p.x[std::size_t(i)].x() > -1e-9;
  };
  for (const EdgeApexes& e : edges_of(cloth.triangles)) {
    if (!is_held(e.a) || !is_held(e.b)) continue;
    const bool up = e.left >= 0;
    cloth.triangles.push_back({up ? e.b : e.a, up ? e.a : e.b, int(p.size())});
    p.inv_mass[std::size_t(e.a)] = p.inv_mass[std::size_t(e.b)] = 0;
    p.x.push_back(0.5 * (p.x[std::size_t(e.a)] + p.x[std::size_t(e.b)]) - Vec3(h, 0, 0));
    p.v.push_back(Vec3::Zero());
    p.mass.push_back(1e-3);
    p.inv_mass.push_back(0);
  }
}

}  // namespace

SlitAnnulus slit_annulus(SheetKind kind, int columns, int rows, bool patches) {
  SlitAnnulus a{flat_sheet(kind, columns, rows), {}, {}};
  Particles& p = a.cloth.particles;
  a.cloth.structural.clear();
  for (int i = 0; i < int(p.size()); ++i)
    if (p.x[std::size_t(i)].x() > way_around * (1 - 1e-9)) a.lifted.push_back(i);
  std::ranges::sort(a.lifted, {}, [&](int i) { return p.x[std::size_t(i)].y(); });
  a.load.assign(a.lifted.size(), 0);
  for (std::size_t i = 0; i + 1 < a.lifted.size(); ++i) {
    const double length = (p.x[std::size_t(a.lifted[i + 1])] - p.x[std::size_t(a.lifted[i])]).norm();
    a.load[i] += 0.5 * full_load * length, a.load[i + 1] += 0.5 * full_load * length;
  }
  clamp_side(a.cloth, way_around / columns);
  for (Vec3& x : p.x) {
    const double angle = -x.x() / way_around * 2 * std::numbers::pi, r = inner_radius + x.y();
    x = {r * std::cos(angle), r * std::sin(angle), 0};
  }
  add_flat_membrane(a.cloth, plate_young * plate_thickness, 0);
  if (patches) join_patches(a.cloth);
  add_plate(a.cloth, isotropic_plate(plate_young * std::pow(plate_thickness, 3) / 12));
  a.cloth.energies.push_back(nullptr);
  return a;
}

AnnulusRest lift(SlitAnnulus& a, double share) {
  std::vector<double> force = a.load;
  for (double& f : force) f *= share;
  a.cloth.energies.back() = std::make_shared<DeadLoad>(a.lifted, std::move(force));
  SettleOptions options;
  options.gravity = Vec3::Zero();
  options.tolerance = 1e-5;
  options.longest_move = 1;
  options.max_iterations = 1000;
  const SettleReport report = settle(a.cloth, nullptr, options);
  const auto& x = a.cloth.particles.x;
  return {x[std::size_t(a.lifted.front())].z(), x[std::size_t(a.lifted.back())].z(), report.iterations,
          report.factorisations, report.converged};
}

}  // namespace furrow::cases
