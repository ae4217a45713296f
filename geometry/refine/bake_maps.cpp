// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/refine/bake_maps.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/tangent_frames.h"
#include "geometry/refine/texture_raster.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

/// A texel beyond the border may lie this far outside of its face [barycentric].
constexpr double outside = -0.5;

/// The neighbours of a texel, those that share a side first.
constexpr int neighbours[8][2] = {{0, -1}, {-1, 0}, {1, 0}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};

TextureRaster rasterize(const Mesh& mesh, int size, const char* which) {
  check_mesh(mesh, "bake");
  if (!find_map(mesh, attribute::texture))
    throw ContentError(std::string("bake: the ") + which + " mesh has no texture coordinates");
  TextureRaster raster = rasterize_texture(mesh, size);
  if (raster.out_of_range > 0)
    throw ContentError(std::string("bake: the texture coordinates of ") +
                       std::to_string(raster.out_of_range) + " faces of the " + which +
                       " mesh leave the unit square; move its charts into it");
  return raster;
}

Barycentrics held(Barycentrics b) {
  double sum = 0;
  for (double& x : b) sum += x = std::max(x, outside);
  for (double& x : b) x /= sum;
  return b;
}

class Baker {
 public:
  Baker(const Mesh& low, const Mesh& high, const BakeOptions& options)
      : low_(low),
        high_(high),
        options_(options),
        size_(options.size),
        low_raster_(rasterize(low, size_, "low")),
        high_raster_(rasterize(high, size_, "high")),
        low_texture_(*find_map(low, attribute::texture)),
        high_texture_(*find_map(high, attribute::texture)),
        frames_(tangent_frames(low)),
        normals_(vertex_normals(high)) {
    maps_.displacement = {size_, {}};
    maps_.normal = {size_, {}};
    maps_.displacement.texels.assign(low_raster_.face.size(), {0, 0, 0});
    maps_.normal.texels.assign(low_raster_.face.size(), {0, 0, 1});
    maps_.covered = low_raster_.covered;
    maps_.overlapping = low_raster_.overlapping;
    state_.assign(low_raster_.face.size(), 0);
  }

  bool fill(const BakeObserver& observer) {
    for (int row = 0; row < size_; ++row) {
      if (observer && row % std::max(1, size_ / 100) == 0 && !observer(0.9 * row / size_)) return false;
      physics::throw_if_cancelled("bake");
      for (int column = 0; column < size_; ++column) {
        const std::size_t at = std::size_t(row) * size_ + column;
        const int low = low_raster_.face[at], high = high_raster_.face[at];
        if (low >= 0 && high >= 0) set(column, row, Face(low), Face(high));
        maps_.unmatched += low >= 0 && high < 0;
      }
    }
    if (2 * maps_.unmatched > maps_.covered)
      throw ContentError(
          "bake: the high mesh covers less than half of the low mesh's texture; do both have "
          "the same texture coordinates?");
    return true;
  }

  /// Rings of texels around what is filled: the first from the faces of a neighbour, the others copied.
  bool pad(const BakeObserver& observer) {
    for (int ring = 1; ring <= options_.padding; ++ring) {
      if (observer && !observer(0.9 + 0.1 * ring / options_.padding)) return false;
      std::vector<std::pair<std::size_t, std::size_t>> fresh;  // a texel and the neighbour that it goes by
      for (int row = 0; row < size_; ++row) {
        physics::throw_if_cancelled("bake");
        for (int column = 0; column < size_; ++column)
          if (const auto by = filled_neighbour(column, row))
            fresh.emplace_back(std::size_t(row) * size_ + column, *by);
      }
      for (const auto& [at, by] : fresh) {
        if (ring == 1) {
          set(int(at % size_), int(at / size_), Face(low_raster_.face[by]), Face(high_raster_.face[by]));
        } else {
          maps_.displacement.texels[at] = maps_.displacement.texels[by];
          maps_.normal.texels[at] = maps_.normal.texels[by];
        }
        state_[at] = 1;
      }
    }
    return true;
  }

  BakedMaps take() { return std::move(maps_); }

 private:
  std::optional<std::size_t> filled_neighbour(int column, int row) const {
    if (state_[std::size_t(row) * size_ + column]) return std::nullopt;
    for (const auto& [dx, dy] : neighbours) {
      const int x = column + dx, y = row + dy;
      if (x < 0 || y < 0 || x >= size_ || y >= size_) continue;
      if (const std::size_t at = std::size_t(y) * size_ + x; state_[at]) return at;
    }
    return std::nullopt;
  }

  void set(int column, int row, Face low, Face high) {
    const TextureCoordinate uv = texel_middle(size_, column, row);
    const Barycentrics in_low = held(texture_barycentrics(low_, low_texture_, low, uv));
    const Barycentrics in_high = held(texture_barycentrics(high_, high_texture_, high, uv));
    const InnerFrame frame = frame_inside(frames_[low.idx()], in_low), unit = orthonormal(frame);
    const Vector d = position_of(high_, {high, in_high}) - position_of(low_, {low, in_low});
    const std::size_t at = std::size_t(row) * size_ + column;
    maps_.displacement.texels[at] = {float(d * unit.tangent), float(d * unit.bitangent),
                                     float(d * unit.normal)};
    for (float x : maps_.displacement.texels[at])
      maps_.largest = std::max(maps_.largest, double(std::abs(x)));
    maps_.normal.texels[at] = normal_in(frame, high, in_high);
    state_[at] = 1;
  }

  /// x, y, z with x t + y b + z n = the normal of the high mesh, made unit: Cramer's rule.
  std::array<float, 3> normal_in(const InnerFrame& frame, Face high, const Barycentrics& weights) const {
    Vector m(0, 0, 0);
    const auto corners = corners_of(high_, high);
    for (int i = 0; i < 3; ++i) m = m + weights[i] * normals_[corners[i].idx()];
    const Vector &t = frame.tangent, &b = frame.bitangent, &n = frame.normal;
    const double whole = t * CGAL::cross_product(b, n);
    const Vector x(m * CGAL::cross_product(b, n), t * CGAL::cross_product(m, n),
                   t * CGAL::cross_product(b, m));
    const Vector unit = normalized(x / whole);
    if (!(unit.squared_length() > 0.5)) return {0, 0, 1};  // no normal there
    return {float(unit.x()), float(unit.y()), float(unit.z())};
  }

  const Mesh &low_, &high_;
  const BakeOptions& options_;
  int size_;
  TextureRaster low_raster_, high_raster_;
  HalfedgeMap<TextureCoordinate> low_texture_, high_texture_;
  TangentFrames frames_;
  std::vector<Vector> normals_;
  BakedMaps maps_;
  std::vector<char> state_;  // 1: has a value
};

}  // namespace

std::optional<BakedMaps> bake_maps(const Mesh& low, const Mesh& high, const BakeOptions& options,
                                   const BakeObserver& observer) {
  if (options.padding < 0 || options.padding > 1024)
    refuse("bake", "padding must be in [0, 1024] texels, not " + std::to_string(options.padding));
  Baker baker(low, high, options);
  if (!baker.fill(observer) || !baker.pad(observer)) return std::nullopt;
  return baker.take();
}

}  // namespace furrow::geometry
