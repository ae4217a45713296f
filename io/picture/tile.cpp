// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/tile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace furrow::io {
namespace {

using Eigen::Vector3d;

constexpr int widest = 8;               // [pixels] between corners whose shares of light are found first
constexpr double most_apart = 0.08;     // of the light at corners that agree
constexpr double most_contrast = 0.06;  // of the light at the corners of a pixel that look alike

/// Whether two places lie on one smooth surface: as on an arc, what leads from one to the other is at right
/// angles to the sum of the normals.
bool are_on_one_surface(const Seen& a, const Seen& b) {
  const Vector3d apart = b.point - a.point;
  return a.mesh == b.mesh && a.normal.dot(b.normal) > 0.93 &&
         std::abs((a.normal + b.normal).dot(apart)) <= 0.4 * apart.norm();
}

double strength(const Seen& seen, const LightShares& shares) {
  return seen.key * shares.key + seen.sky * shares.sky + seen.fill;
}

}  // namespace

Tile::Tile(const Eye& eye, const Shader& shader, int side, int column, int row)
    : eye_(eye),
      shader_(shader),
      side_(side),
      column_(column),
      row_(row),
      corners_(std::size_t(pixels + 1) * (pixels + 1)) {
  for (int j = 0; j <= pixels; ++j)
    for (int i = 0; i <= pixels; ++i) corner(i, j).look = eye.look(column + i, row + j);
  for (int spacing = widest; spacing > 0; spacing /= 2)
    for (int j = 0; j <= pixels; j += spacing)
      for (int i = 0; i <= pixels; i += spacing)
        if (spacing == widest || (i | j) & spacing) light_corner(i, j, spacing);
}

/// Those around are the corners that were found at the next wider spacing.
void Tile::light_corner(int i, int j, int spacing) {
  Place& place = corner(i, j);
  place.light = place.look.line;
  if (!place.look.surface) return;
  const Seen& seen = *place.look.surface;
  const int x = i & spacing, y = j & spacing;
  const std::array<Lender, 4> around{{{&corner(i - x, j - y), 1},
                                      {&corner(i + x, j - y), 1},
                                      {&corner(i - x, j + y), 1},
                                      {&corner(i + x, j + y), 1}}};
  const auto blended = spacing < widest ? borrowed(seen, around, 4, most_apart) : std::nullopt;
  place.shares = blended ? *blended : shader_.shares(seen);
  place.light = shader_.light(seen, place.shares);
}

/// The mean of the shares of those that lie on the same surface; none if these are too few or disagree.
std::optional<LightShares> Tile::borrowed(const Seen& seen, std::span<const Lender> lenders, double least,
                                          double apart) {
  double weights = 0, low = std::numeric_limits<double>::infinity(), high = 0;
  LightShares sum{0, 0};
  for (const auto& [place, weight] : lenders) {
    const auto& other = place->look.surface;
    if (!(weight > 0) || !other || !are_on_one_surface(seen, *other)) continue;
    const double light = strength(seen, place->shares);
    low = std::min(low, light);
    high = std::max(high, light);
    sum.key += weight * place->shares.key;
    sum.sky += weight * place->shares.sky;
    weights += weight;
  }
  if (weights < least || high - low > apart * high) return std::nullopt;
  return LightShares{sum.key / weights, sum.sky / weights};
}

std::optional<Vector3d> Tile::pixel(int column, int row, const Vector3d& background) const {
  const int i = column - column_, j = row - row_;
  Vector3d sum = Vector3d::Zero(), low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  bool empty = true;
  for (int k = 0; k < 4; ++k) {
    const auto& light = corner(i + k % 2, j + k / 2).light;
    empty = empty && !light;
    const Vector3d& c = light ? *light : background;
    sum += c / 4;
    low = low.cwiseMin(c);
    high = high.cwiseMax(c);
  }
  if (empty) return std::nullopt;
  return ((high - low).array() <= most_contrast * high.array()).all() ? sum : many(i, j, background);
}

/// The lines of sight run through side² places in side² columns and side² rows of the pixel, which give the
/// smoothest edges that so many can. They borrow from the pixel's corners, and from each other.
Vector3d Tile::many(int i, int j, const Vector3d& background) const {
  std::vector<Place> found;
  found.reserve(std::size_t(side_) * side_);
  const int n = side_;
  std::vector<Lender> lenders;
  for (int k = 0; k < 4; ++k) lenders.push_back({&corner(i + k % 2, j + k / 2), 1});
  Vector3d sum = Vector3d::Zero();
  for (int b = 0; b < n; ++b)
    for (int a = 0; a < n; ++a) {
      const double x = (a + (b + 0.5) / n) / n, y = (b + (a + 0.5) / n) / n;
      for (int k = 0; k < 4; ++k) lenders[k].weight = (k % 2 ? x : 1 - x) * (k / 2 ? y : 1 - y);
      Place place{eye_.look(column_ + i + x, row_ + j + y), {}, {}};
      if (place.look.surface) {
        const Seen& seen = *place.look.surface;
        const auto blended = borrowed(seen, lenders, 0.1, std::numeric_limits<double>::infinity());
        place.shares = blended ? *blended : shader_.shares(seen);
        sum += shader_.light(seen, place.shares);
        if (!blended) {
          found.push_back(place);
          lenders.push_back({&found.back(), 1});
        }
      } else {
        sum += place.look.line.value_or(background);
      }
    }
  return sum / (n * n);
}

}  // namespace furrow::io
