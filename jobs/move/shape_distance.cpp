// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/shape_distance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/mesh/border_loops.h"
#include "jobs/body/world_body.h"
#include "physics/body/triangle_bvh.h"
#include "physics/cloth/cloth.h"
#include "physics/cloth/elements.h"

namespace furrow::jobs {

using physics::Vec3;

ShapeMeter::ShapeMeter(const geometry::Mesh& mesh, const physics::Cloth& cloth, const Vec3& gravity)
    : mass_(cloth.particles.mass),
      triangles_(cloth.triangles),
      groups_(1),
      gravity_(gravity),
      size_(box_of(cloth.particles.x).diagonal().norm()) {
  constexpr double standard_gravity = 9.81;  // [m/s^2]
  const double g = gravity.norm() > 0 ? gravity.norm() : standard_gravity;
  weight_ = g * std::accumulate(mass_.begin(), mass_.end(), 0.0);
  for (std::size_t i = 0; i < mass_.size(); ++i)
    if (mass_[i] > 0) groups_[0].push_back(static_cast<int>(i));
  for (const geometry::BorderLoop& loop : geometry::border_loops(mesh)) {
    std::vector<int>& group = groups_.emplace_back();
    for (geometry::Vertex v : loop.vertices) group.push_back(static_cast<int>(v));
  }
}

Shape ShapeMeter::shape_of(physics::Cloth cloth) const {
  const physics::Particles& p = cloth.particles;
  double energy = physics::potential_energy(cloth, p.x) + physics::kinetic_energy(p);
  for (std::size_t i = 0; i < p.size(); ++i) energy -= p.mass[i] * gravity_.dot(p.x[i]);
  return {std::move(cloth.particles.x), energy};
}

std::vector<ShapeMeter::Ball> ShapeMeter::balls(const std::vector<Vec3>& x) const {
  std::vector<Ball> balls;
  for (const std::vector<int>& group : groups_) {
    Vec3 sum = Vec3::Zero();
    double total = 0, squares = 0;
    for (int i : group) sum += mass_[i] * x[i], total += mass_[i];
    const Vec3 centre = sum / total;
    for (int i : group) squares += mass_[i] * (x[i] - centre).squaredNorm();
    balls.push_back({centre, std::sqrt(squares / total)});
  }
  return balls;
}

/// Mean of the squared distances of x, each for the area around it [m^2].
double ShapeMeter::to_surface(const std::vector<Vec3>& x, const std::vector<Vec3>& surface) const {
  const physics::TriangleBvh tree({surface, triangles_});
  double squares = 0, total = 0;
  int triangle = 0;
  for (int i : groups_[0]) {
    const physics::ClosestPoint closest = tree.closest(x[i], triangle);
    triangle = closest.triangle;
    squares += mass_[i] * closest.squared_distance;
    total += mass_[i];
  }
  return squares / total;
}

ShapeDistance ShapeMeter::between(const Shape& a, const Shape& b) const {
  double squares = 0, total = 0, farthest = 0;
  for (int i : groups_[0]) {
    const double square = (a.x[i] - b.x[i]).squaredNorm();
    if (!std::isfinite(square)) return infinitely_far;
    squares += mass_[i] * square;
    total += mass_[i];
    farthest = std::max(farthest, square);
  }
  ShapeDistance d;
  d.rms = std::sqrt(squares / total) / size_;
  d.max = std::sqrt(farthest) / size_;
  d.surface = std::sqrt((to_surface(a.x, b.x) + to_surface(b.x, a.x)) / 2) / size_;
  d.energy = std::abs(a.energy - b.energy) / (weight_ * size_);
  const std::vector<Ball> of_a = balls(a.x), of_b = balls(b.x);
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    const double centre = (of_a[i].centre - of_b[i].centre).norm() / size_,
                 extent = std::abs(of_a[i].radius - of_b[i].radius) / size_;
    if (i == 0)
      d.centre = centre, d.extent = extent;
    else
      d.borders = std::max({d.borders, centre, extent});
  }
  return d;
}

}  // namespace furrow::jobs
