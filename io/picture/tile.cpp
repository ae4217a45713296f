// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/tile.h"

#include <algorithm>
#include <cmath>
#include <deque>
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
  constexpr double least_cosine = 0.93, most_aslant = 0.5;
  return a.mesh == b.mesh && a.normal.dot(b.normal) > least_cosine &&
         std::abs((a.normal + b.normal).dot(apart)) <= 2 * most_aslant * apart.norm();
}

/// Whether two looks meet the same surface, or none. Else a border runs between them, which nothing else
/// shows where cloth lies before cloth of its colour.
bool meet_alike(const Look& a, const Look& b) {
  return bool(a.surface) == bool(b.surface) && (!a.surface || are_on_one_surface(*a.surface, *b.surface));
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
  const std::array<const Place*, 4> around{&corner(i - x, j - y), &corner(i + x, j - y),
                                           &corner(i - x, j + y), &corner(i + x, j + y)};
  const auto blended = spacing < widest ? mean_shares(seen, around) : std::nullopt;
  place.shares = blended ? *blended : shader_.shares(seen);
  place.light = shader_.light(seen, place.shares);
}

/// None unless all lie on the same surface, and agree.
std::optional<LightShares> Tile::mean_shares(const Seen& seen, const std::array<const Place*, 4>& around) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  LightShares mean{0, 0};
  for (const Place* place : around) {
    const auto& other = place->look.surface;
    if (!other || !are_on_one_surface(seen, *other)) return std::nullopt;
    const double light = seen.key * place->shares.key + seen.sky * place->shares.sky + seen.fill;
    low = std::min(low, light);
    high = std::max(high, light);
    mean.key += place->shares.key / 4;
    mean.sky += place->shares.sky / 4;
  }
  return high - low <= most_apart * high ? std::optional(mean) : std::nullopt;
}

std::optional<Vector3d> Tile::pixel(int column, int row, const Vector3d& background) const {
  const int i = column - column_, j = row - row_;
  Vector3d sum = Vector3d::Zero(), low = Vector3d::Constant(std::numeric_limits<double>::infinity()),
           high = -low;
  bool empty = true, alike = true;
  for (int k = 0; k < 4; ++k) {
    const Place& place = corner(i + k % 2, j + k / 2);
    empty = empty && !place.light;
    alike = alike && !place.look.is_near_thin && meet_alike(corner(i, j).look, place.look);
    const Vector3d& c = place.light ? *place.light : background;
    sum += c / 4;
    low = low.cwiseMin(c);
    high = high.cwiseMax(c);
  }
  if (empty && alike) return std::nullopt;
  alike = alike && ((high - low).array() <= most_contrast * high.array()).all();
  return alike ? sum : many(i, j, background);
}

/// The lines of sight run through side² places in side² columns and side² rows of the pixel, which give the
/// smoothest edges that so many can.
Vector3d Tile::many(int i, int j, const Vector3d& background) const {
  std::vector<const Place*> known{&corner(i, j), &corner(i + 1, j), &corner(i, j + 1), &corner(i + 1, j + 1)};
  std::deque<Place> found;
  const int n = side_;
  Vector3d sum = Vector3d::Zero();
  for (int b = 0; b < n; ++b)
    for (int a = 0; a < n; ++a) {
      const double x = (a + (b + 0.5) / n) / n, y = (b + (a + 0.5) / n) / n;
      const Look look = eye_.look(column_ + i + x, row_ + j + y);
      if (!look.surface) {
        sum += look.line.value_or(background);
        continue;
      }
      const Place* place = nearest(*look.surface, known);
      if (!place) {
        place = &found.emplace_back(Place{look, shader_.shares(*look.surface), {}});
        known.push_back(place);
      }
      sum += shader_.light(*look.surface, place->shares);
    }
  return sum / (n * n);
}

/// In space, so that what lies behind an edge does not lend to what lies before it; nullptr: none.
const Tile::Place* Tile::nearest(const Seen& seen, std::span<const Place* const> known) {
  const Place* result = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Place* place : known) {
    const auto& other = place->look.surface;
    if (!other || !are_on_one_surface(seen, *other)) continue;
    const double distance = (other->point - seen.point).squaredNorm();
    if (distance < least) {
      least = distance;
      result = place;
    }
  }
  return result;
}

}  // namespace furrow::io
