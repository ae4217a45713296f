// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/shape_distance.h"

#include <algorithm>
#include <cmath>

#include "cli/body.h"
#include "geometry/border_loops.h"

namespace furrow::cli {

using physics::Vec3;

ShapeMeter::ShapeMeter(const geometry::Mesh& mesh, const physics::Particles& particles)
    : mass_(particles.mass), groups_(1), size_(box_of(particles.x).diagonal().norm()) {
  for (std::size_t i = 0; i < mass_.size(); ++i)
    if (mass_[i] > 0) groups_[0].push_back(static_cast<int>(i));
  for (const geometry::BorderLoop& loop : geometry::border_loops(mesh)) {
    std::vector<int>& group = groups_.emplace_back();
    for (geometry::Vertex v : loop.vertices) group.push_back(static_cast<int>(v));
  }
}

std::vector<ShapeMeter::Ball> ShapeMeter::bulk(const std::vector<Vec3>& x) const {
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

ShapeDistance ShapeMeter::between(const std::vector<Vec3>& a, const std::vector<Vec3>& b) const {
  double squares = 0, total = 0, farthest = 0;
  for (int i : groups_[0]) {
    const double square = (a[i] - b[i]).squaredNorm();
    if (!std::isfinite(square)) return {INFINITY, INFINITY, INFINITY};
    squares += mass_[i] * square;
    total += mass_[i];
    farthest = std::max(farthest, square);
  }
  double bulk_distance = 0;
  const std::vector<Ball> of_a = bulk(a), of_b = bulk(b);
  for (std::size_t i = 0; i < of_a.size(); ++i)
    bulk_distance = std::max(
        {bulk_distance, (of_a[i].centre - of_b[i].centre).norm(), std::abs(of_a[i].radius - of_b[i].radius)});
  return {std::sqrt(squares / total) / size_, std::sqrt(farthest) / size_, bulk_distance / size_};
}

}  // namespace furrow::cli
