// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <cstdint>

#include "io/prepared_scene.h"
#include "io/ray_scene.h"

namespace furrow::io {

/// Points of the unit square that stay evenly spread however many are taken: point i of the additive
/// recurrence of the plastic number (Roberts 2018), shifted by an offset that differs from pixel to pixel.
struct SampleSequence {
  double shift_x, shift_y;  ///< in [0, 1)
  std::array<double, 2> operator()(int i) const;
};

/// The sequence of a pixel; `purpose` tells sequences of the same pixel apart.
SampleSequence pixel_sequence(std::uint32_t x, std::uint32_t y, std::uint32_t purpose);

/// The lights of a picture, which stand still relative to the camera, so that wrinkles read from every side:
/// a soft key light from the upper left, raking over the surface; a sky that is bright above; a weak fill
/// light from the right that throws no shadow.
class Shader {
 public:
  /// Keeps references to both. `sky_rays` a hit, ≥ 1.
  Shader(const PreparedScene& scene, const RayScene& rays, int sky_rays);

  /// Linear light that comes back from what a ray along `direction` (unit) hit. `sample` counts the rays of
  /// the pixel; key and sky are the pixel's sequences.
  Eigen::Vector3d surface(const Eigen::Vector3d& direction, const SurfaceHit& hit, int sample,
                          const SampleSequence& key, const SampleSequence& sky) const;
  /// The same from a line's tube: nearly flat, so that its colour is told at a glance.
  Eigen::Vector3d line(const Eigen::Vector3d& direction, const LineHit& hit) const;

 private:
  double key_light(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                   const std::array<double, 2>& at) const;
  double sky_light(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, int sample,
                   const SampleSequence& sequence) const;
  const PreparedScene& scene_;
  const RayScene& rays_;
  int sky_rays_;
  Eigen::Vector3d key_direction_, fill_direction_;
};

}  // namespace furrow::io
