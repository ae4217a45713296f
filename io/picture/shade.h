// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>

#include "io/picture/lattice.h"
#include "io/picture/prepared_scene.h"
#include "io/picture/ray_scene.h"

namespace furrow::io {

/// How far a pixel shifts the lattices of rays that all pixels share: two numbers of blue noise in [0, 1), so
/// that too few rays show as fine grain and not as bands.
struct PixelShift {
  double u, v;
};
PixelShift pixel_shift(int column, int row);

/// The lights of a picture, which stand still relative to the camera, so that wrinkles can be read from every
/// side: a soft key light from the upper left, raking over the surface; a sky that is bright above; a weak
/// fill light from the right that casts no shadow.
class Shader {
 public:
  /// Keeps references to both. `samples`: rays a pixel, ≥ 1; `sky_rays`: rays from each hit to the sky, ≥ 1;
  /// `key_radius`: tangent of half the angle of the key light, > 0.
  Shader(const PreparedScene& scene, const RayScene& rays, int samples, int sky_rays, double key_radius);

  /// Linear light that comes back from what a pixel's ray number `sample` along `direction` (unit) hit.
  Eigen::Vector3d surface(const Eigen::Vector3d& direction, const SurfaceHit& hit, int sample,
                          const PixelShift& shift) const;
  /// The same from a line's tube: nearly flat, so that its colour can be told at a glance.
  Eigen::Vector3d line(const Eigen::Vector3d& direction, const LineHit& hit) const;

 private:
  double key_light(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, int sample,
                   const PixelShift& shift) const;
  double sky_light(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, int sample,
                   const PixelShift& shift) const;
  const PreparedScene& scene_;
  const RayScene& rays_;
  int sky_rays_;
  double key_radius_;
  Lattice key_lattice_, sky_lattice_;
  Eigen::Vector3d key_direction_, fill_direction_;
  std::array<Eigen::Vector3d, 2> key_across_;
};

}  // namespace furrow::io
