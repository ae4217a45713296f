// SPDX-License-Identifier: MIT
#include "physics/body/depth_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace furrow::physics {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr double steepest = 12;      // texels a texel: where a surface falls faster it has a rim
constexpr std::int8_t no_rim = 127;  // in Offset; farther than any
constexpr int steps[8][2] = {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}};

}  // namespace

DepthMap::DepthMap(int axis, int side)
    : axis_(axis),
      across_(side > 0 ? (axis + 1) % 3 : (axis + 2) % 3),  // right-handed with the direction to the viewer:
      along_(side > 0 ? (axis + 2) % 3 : (axis + 1) % 3),   // faces towards him are counter-clockwise
      side_(side) {}

void DepthMap::draw(std::span<const Vec3> vertices, std::span<const std::array<int, 3>> triangles,
                    const DepthRaster& raster) {
  low_across_ = raster.low[across_], low_along_ = raster.low[along_];
  per_metre_ = 1 / raster.texel;
  columns_ = int(std::ceil((raster.high[across_] - low_across_) * per_metre_));
  rows_ = int(std::ceil((raster.high[along_] - low_along_) * per_metre_));
  texels_.assign(std::size_t(columns_) * std::size_t(rows_), {-infinite, none, none, infinite});
  const auto place = [&](int v) {
    const Vec3& x = vertices[std::size_t(v)];
    return Vec3((x[across_] - low_across_) * per_metre_, (x[along_] - low_along_) * per_metre_, height(x));
  };
  for (std::size_t t = 0; t < triangles.size(); ++t)
    draw_triangle(int(t), place(triangles[t][0]), place(triangles[t][1]), place(triangles[t][2]));
  find_rims();
  spread_rims(raster.reach);
}

/// Corners: column, row, height. A texel is the triangle's where its centre is.
void DepthMap::draw_triangle(int face, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const double area = ab.x() * ac.y() - ab.y() * ac.x();
  if (!(area > 0)) return;
  const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  const int first_column = std::max(0, int(std::ceil(low.x() - 0.5))),
            last_column = std::min(columns_ - 1, int(std::floor(high.x() - 0.5))),
            first_row = std::max(0, int(std::ceil(low.y() - 0.5))),
            last_row = std::min(rows_ - 1, int(std::floor(high.y() - 0.5)));
  // Edge functions over the area: the weights of b and c; that of a is the rest.
  const double b_u = ac.y() / area, b_v = -ac.x() / area, c_u = -ab.y() / area, c_v = ab.x() / area;
  for (int row = first_row; row <= last_row; ++row) {
    const double v = row + 0.5 - a.y();
    Texel* texels = &texels_[std::size_t(row) * std::size_t(columns_)];
    for (int column = first_column; column <= last_column; ++column) {
      const double u = column + 0.5 - a.x(), wb = b_u * u + b_v * v, wc = c_u * u + c_v * v;
      if (wb < 0 || wc < 0 || wb + wc > 1) continue;
      const auto h = float(a.z() + wb * ab.z() + wc * ac.z());
      if (h > texels[column].height) texels[column] = {h, face, none, infinite};
    }
  }
}

/// A rim: a texel with a neighbour that lies much deeper, or is background.
void DepthMap::find_rims() {
  rims_.assign(texels_.size(), {no_rim, no_rim});
  front_.clear();
  const auto fall = float(steepest / per_metre_);
  for (int row = 1; row + 1 < rows_; ++row)  // the margin is background
    for (int column = 1; column + 1 < columns_; ++column) {
      const auto i = std::size_t(row * columns_ + column), width = std::size_t(columns_);
      Texel& texel = texels_[i];
      const float least = texel.height - fall;
      if (texel.face == none || !(texels_[i - 1].height < least || texels_[i + 1].height < least ||
                                  texels_[i - width].height < least || texels_[i + width].height < least))
        continue;
      texel.rim = texel.face, texel.rim_away = 0;
      rims_[i] = {0, 0};
      front_.push_back(int(i));
    }
}

/// Texels up to `reach` away learn of the nearest rim from their neighbours (dead reckoning).
void DepthMap::spread_rims(int reach) {
  constexpr double rounding =
      2;  // texels: between a point and its texel's centre, twice, and of the reckoning
  for (int round = 0; round < reach && !front_.empty(); ++round, front_.swap(next_)) {
    next_.clear();
    for (const int i : front_) {
      const Offset from = rims_[std::size_t(i)];
      const int column = i % columns_, row = i / columns_;
      for (const auto& [du, dv] : steps) {
        if (column + du < 0 || column + du >= columns_ || row + dv < 0 || row + dv >= rows_) continue;
        const int to = i + dv * columns_ + du, across = from.across - du, along = from.along - dv;
        Offset& known = rims_[std::size_t(to)];
        const int square = across * across + along * along;
        if (square >= known.across * known.across + known.along * known.along) continue;
        known = {std::int8_t(across), std::int8_t(along)};
        Texel& texel = texels_[std::size_t(to)];
        texel.rim = texels_[std::size_t(i)].rim;
        texel.rim_away = float(std::max(std::sqrt(double(square)) - rounding, 0.0) / per_metre_);
        next_.push_back(to);
      }
    }
  }
}

const DepthMap::Texel& DepthMap::texel_at(const Vec3& x) const {
  const int column = int(std::clamp((x[across_] - low_across_) * per_metre_, 0.0, columns_ - 1.0)),
            row = int(std::clamp((x[along_] - low_along_) * per_metre_, 0.0, rows_ - 1.0));
  return texels_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)];
}

DepthPlace DepthMap::nearest(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) const {
  // Seen from x, in the map.
  const double u[3] = {a[across_] - x[across_], b[across_] - x[across_], c[across_] - x[across_]},
               v[3] = {a[along_] - x[along_], b[along_] - x[along_], c[along_] - x[along_]};
  const double wa = u[1] * v[2] - v[1] * u[2], wb = u[2] * v[0] - v[2] * u[0], wc = u[0] * v[1] - v[0] * u[1],
               area = wa + wb + wc;
  if (wa >= 0 && wb >= 0 && wc >= 0 && area > 0) return {{wa / area, wb / area, wc / area}, 0};
  DepthPlace best{{}, std::numeric_limits<double>::infinity()};
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    const double du = u[l] - u[k], dv = v[l] - v[k], length = du * du + dv * dv;
    const double s = length > 0 ? std::clamp(-(u[k] * du + v[k] * dv) / length, 0.0, 1.0) : 0.0;
    const double eu = u[k] + s * du, ev = v[k] + s * dv, square = eu * eu + ev * ev;
    if (square >= best.away) continue;
    best = {{}, square};
    best.weights[std::size_t(k)] = 1 - s, best.weights[std::size_t(l)] = s;
  }
  best.away = std::sqrt(best.away);
  return best;
}

}  // namespace furrow::physics
