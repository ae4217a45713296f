// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "io/picture/prepared_scene.h"
#include "io/picture/ray_scene.h"

namespace furrow::io {

/// A turn about an axis, different in every pixel. All pixels use the same rays, but turned, so that too few
/// of them show as fine grain and not as bands.
struct PixelTurn {
  double cosine, sine;
};
PixelTurn pixel_turn(std::uint32_t column, std::uint32_t row);

/// The lights of a picture, which stand still relative to the camera, so that wrinkles can be read from every
/// side: a soft key light from the upper left, raking over the surface; a sky that is bright above; a weak
/// fill light from the right that casts no shadow.
class Shader {
 public:
  /// Keeps references to both. `samples`: rays a pixel, ≥ 1; `sky_rays`: rays from each hit to the sky, ≥ 1.
  Shader(const PreparedScene& scene, const RayScene& rays, int samples, int sky_rays);

  /// Linear light that comes back from what a pixel's ray number `sample` along `direction` (unit) hit.
  Eigen::Vector3d surface(const Eigen::Vector3d& direction, const SurfaceHit& hit, int sample,
                          const PixelTurn& turn) const;
  /// The same from a line's tube: nearly flat, so that its colour can be told at a glance.
  Eigen::Vector3d line(const Eigen::Vector3d& direction, const LineHit& hit) const;

 private:
  double key_light(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, int sample,
                   const PixelTurn& turn) const;
  double sky_light(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, int sample,
                   const PixelTurn& turn) const;
  const PreparedScene& scene_;
  const RayScene& rays_;
  int sky_rays_;
  Eigen::Vector3d key_direction_, fill_direction_;
  std::array<Eigen::Vector3d, 2> key_across_;
  std::vector<Eigen::Vector3d> key_samples_;  ///< unit vectors about z, as wide as the key light
  std::vector<Eigen::Vector3d> sky_samples_;  ///< a hemisphere about z whose density is the cosine
};

}  // namespace furrow::io
