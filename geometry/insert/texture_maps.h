// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cmath>
#include <optional>

#include "geometry/mesh/property_names.h"

namespace furrow::geometry {

/// The texture coordinates of a corner, in the first map and the second; (0, 0) in one that the mesh lacks.
using CornerTexture = std::array<TextureCoordinate, 2>;

/// The texture maps that a mesh has, as one.
class TextureMaps {
 public:
  explicit TextureMaps(const Mesh& mesh)
      : maps_{find_map(mesh, attribute::texture), find_map(mesh, attribute::second_texture)} {}

  explicit operator bool() const { return maps_[0] || maps_[1]; }
  bool has(std::size_t map) const { return maps_[map].has_value(); }
  CornerTexture at(Halfedge h) const {
    CornerTexture corner{};
    for (std::size_t m = 0; m < 2; ++m)
      if (maps_[m]) corner[m] = (*maps_[m])[h];
    return corner;
  }
  void set(Halfedge h, const CornerTexture& corner) {
    for (std::size_t m = 0; m < 2; ++m)
      if (maps_[m]) (*maps_[m])[h] = corner[m];
  }

 private:
  std::array<std::optional<HalfedgeMap<TextureCoordinate>>, 2> maps_;
};

/// The sum of corners by weights; a corner of weight 0 does not count.
inline CornerTexture blend_corners(const std::array<CornerTexture, 3>& corners,
                                   const std::array<double, 3>& weights) {
  CornerTexture sum{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t m = 0; m < 2 && weights[i] != 0; ++m)
      for (std::size_t k = 0; k < 2; ++k) sum[m][k] += weights[i] * corners[i][m][k];
  return sum;
}

/// Equal, where NaN equals NaN.
inline bool same_texture(const CornerTexture& a, const CornerTexture& b) {
  const auto equal = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  for (std::size_t m = 0; m < 2; ++m)
    if (!equal(a[m][0], b[m][0]) || !equal(a[m][1], b[m][1])) return false;
  return true;
}

}  // namespace furrow::geometry
