// SPDX-License-Identifier: MIT
#include "physics/pairs/tangle_moves.h"

#include <algorithm>
#include <limits>

namespace furrow::physics {
namespace {

constexpr int smoothings = 5;
constexpr double share_of_shortest = 1.0 / 3;

}  // namespace

TangleMoves::TangleMoves(std::span<Vec3> x, const PairMesh& mesh, double farthest)
    : x_(x), mesh_(mesh), farthest_(farthest), start_(x.begin(), x.end()) {
  shortest_.assign(x.size(), std::numeric_limits<double>::infinity());
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    for (const int v : mesh.edges[e])
      shortest_[std::size_t(v)] = std::min(shortest_[std::size_t(v)], mesh.rest_lengths[e]);
}

void TangleMoves::smooth_once(std::vector<Vec3>& way) const {
  std::vector<Vec3> sum(way.size(), Vec3::Zero());
  std::vector<int> count(way.size(), 0);
  for (const auto& [a, b] : mesh_.edges) {
    sum[std::size_t(a)] += way[std::size_t(b)];
    sum[std::size_t(b)] += way[std::size_t(a)];
    ++count[std::size_t(a)];
    ++count[std::size_t(b)];
  }
  for (std::size_t i = 0; i < way.size(); ++i)
    if (count[i] > 0) way[i] = 0.5 * (way[i] + sum[i] / count[i]);
}

void TangleMoves::smooth(std::vector<Vec3>& way) const {
  for (int i = 0; i < smoothings; ++i) smooth_once(way);
}

void TangleMoves::go(const std::vector<Vec3>& way, double longest) {
  double most = 0;
  for (const Vec3& w : way) most = std::max(most, w.norm());
  if (!(most > 0)) return;
  const double scale = longest / most;
  for (std::size_t i = 0; i < way.size(); ++i) step(i, scale * way[i]);
}

void TangleMoves::step(std::size_t i, Vec3 by) {
  const double length = by.norm(), most = share_of_shortest * shortest_[i];
  if (length > most) by *= most / length;
  if (!mesh_.held[i] && (x_[i] + by - start_[i]).norm() <= farthest_) x_[i] += by;
}

double TangleMoves::farthest_of(std::span<const Vec3> x) const {
  double most = 0;
  for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, (x[i] - start_[i]).norm());
  return most;
}

}  // namespace furrow::physics
