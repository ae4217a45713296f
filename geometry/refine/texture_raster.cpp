// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/refine/texture_raster.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/mesh/errors.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr double on_edge = -1e-9, well_inside = 1e-6;  // barycentrics
constexpr double beyond = 1e-6;                        // of the unit square

}  // namespace

Barycentrics texture_barycentrics(const Mesh& mesh, const HalfedgeMap<TextureCoordinate>& texture, Face face,
                                  const TextureCoordinate& at) {
  const auto h = halfedges_of(mesh, face);
  const auto &a = texture[h[2]], &b = texture[h[0]], &c = texture[h[1]];
  const double x1 = b[0] - a[0], y1 = b[1] - a[1], x2 = c[0] - a[0], y2 = c[1] - a[1];
  const double x = at[0] - a[0], y = at[1] - a[1], area = x1 * y2 - x2 * y1;
  if (!(std::abs(area) > 0)) return {unset_value, unset_value, unset_value};
  const double beta = (x * y2 - x2 * y) / area, gamma = (x1 * y - x * y1) / area;
  return {1 - beta - gamma, beta, gamma};
}

TextureRaster rasterize_texture(const Mesh& mesh, int size) {
  if (size < 1 || size > 8192)
    throw std::invalid_argument("texture size must be in [1, 8192], not " + std::to_string(size));
  const auto texture = find_map(mesh, attribute::texture);
  if (!texture) throw ContentError("the mesh has no texture coordinates");
  TextureRaster raster;
  raster.size = size;
  raster.face.assign(std::size_t(size) * size, -1);
  std::vector<char> inside(raster.face.size(), 0);
  for (Face f : mesh.faces()) {
    physics::throw_if_cancelled("bake");
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY}, sum = 0;
    for (Halfedge h : halfedges_of(mesh, f))
      for (int k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], (*texture)[h][k]);
        high[k] = std::max(high[k], (*texture)[h][k]);
        sum += (*texture)[h][k];
      }
    if (!std::isfinite(sum)) continue;
    raster.out_of_range += std::min(low[0], low[1]) < -beyond || std::max(high[0], high[1]) > 1 + beyond;
    const auto texel = [&](double x) { return int(std::clamp(std::floor(x * size), 0.0, size - 1.0)); };
    for (int row = texel(1 - high[1]); row <= texel(1 - low[1]); ++row) {
      physics::throw_if_cancelled("bake");
      for (int column = texel(low[0]); column <= texel(high[0]); ++column) {
        const Barycentrics b = texture_barycentrics(mesh, *texture, f, texel_middle(size, column, row));
        const double least = std::min({b[0], b[1], b[2]});
        if (!(least >= on_edge)) continue;
        const std::size_t at = std::size_t(row) * size + column;
        raster.overlapping += inside[at] && least > well_inside;
        inside[at] = inside[at] || least > well_inside;
        if (raster.face[at] >= 0) continue;
        raster.face[at] = int(f.idx());
        ++raster.covered;
      }
    }
  }
  return raster;
}

}  // namespace furrow::geometry
