// SPDX-License-Identifier: MIT
#include "physics/pairs/time_of_impact.h"

#include <algorithm>
#include <cmath>

#include "physics/pairs/pair_distance.h"

namespace furrow::physics {
namespace {

constexpr double least_part = 0.1;    // of the distance at the start
constexpr double close_enough = 0.1;  // of that least distance
constexpr double touching = 1e-13;    // of the coordinates: a distance of rounding alone
constexpr int most_advances = 1000;

std::array<Vec3, 4> corners_at(const MovingPair& p, double t) {
  std::array<Vec3, 4> x;
  for (std::size_t i = 0; i < 4; ++i) x[i] = p.x[i] + t * p.move[i];
  return x;
}

/// From x on, by how much of the step [-] a plane across the shortest way parts the two by more than `least`
/// [m]: each corner of the one from each of the other. Cloth that slides along cloth comes no nearer to it.
double parted_for(const MovingPair& p, const std::array<Vec3, 4>& x, const Vec3& across, double distance,
                  double least) {
  const Vec3 n = across / distance;
  const std::size_t firsts = p.edges ? 2 : 1;
  double part = 1;
  for (std::size_t i = 0; i < firsts; ++i)
    for (std::size_t j = firsts; j < 4; ++j) {
      const double gap = n.dot(x[i] - x[j]) - least, closing = n.dot(p.move[j] - p.move[i]);
      if (!(gap > 0)) return 0;
      if (closing * part > gap) part = gap / closing;
    }
  return part;
}

/// Largest coordinate at the start [m].
double size_of(const MovingPair& p) {
  double most = 0;
  for (const Vec3& x : p.x) most = std::max(most, x.lpNorm<Eigen::Infinity>());
  return most;
}

/// How much nearer the two can come in the whole step [m].
double approach_of(const MovingPair& p) {
  const Vec3 mean = 0.25 * (p.move[0] + p.move[1] + p.move[2] + p.move[3]);
  std::array<double, 4> way;
  for (std::size_t i = 0; i < 4; ++i) way[i] = (p.move[i] - mean).squaredNorm();
  const double first = p.edges ? std::max(way[0], way[1]) : way[0];
  const double second = p.edges ? std::max(way[2], way[3]) : std::max({way[1], way[2], way[3]});
  return std::sqrt(first) + std::sqrt(second);
}

}  // namespace

double time_of_impact(const MovingPair& pair, double range) {
  std::array<Vec3, 4> x = pair.x;
  Vec3 across = distance_of(pair.edges, x).across;
  double distance = across.norm();
  const double least = least_part * std::min(distance, range), approach = approach_of(pair);
  if (!(distance > touching * size_of(pair))) return 0;
  if (approach <= distance - least) return 1;
  double t = 0;
  for (int i = 0; i < most_advances; ++i) {
    const double next =
        t + std::max((distance - least) / approach, parted_for(pair, x, across, distance, least));
    if (next >= 1) return 1;
    t = next;
    x = corners_at(pair, t);
    across = distance_of(pair.edges, x).across;
    distance = across.norm();
    if (distance - least < close_enough * least) break;
  }
  return t;
}

}  // namespace furrow::physics
