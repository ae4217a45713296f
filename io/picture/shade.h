// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <vector>

#include "io/picture/prepared_scene.h"
#include "io/picture/ray_scene.h"

namespace furrow::io {

/// What is seen at a hit, turned to the eye.
struct Seen {
  int mesh;
  Eigen::Vector3d point, normal;
  Eigen::Vector3d reflected;  ///< share of the light that comes back to the eye
  double key, sky, fill;      ///< light that arrives if nothing is in the way
};

/// What arrives of a light, where some of it is hidden: shares in [0, 1].
struct LightShares {
  double key = 1, sky = 1;
};

/// The lights of a picture, which stand still relative to the camera, so that wrinkles can be read from every
/// side: a soft key light from the upper left, raking over the surface; a sky that is bright above; a weak
/// fill light from the right that casts no shadow. All are known but for what hides them.
class Shader {
 public:
  /// Keeps references to both. `bundles`: of rays to each of the key light and the sky, ≥ 1; `key_radius`:
  /// tangent of half the angle of the key light, > 0.
  Shader(const PreparedScene& scene, const RayScene& rays, int bundles, double key_radius);

  /// What a ray along `direction` (unit) sees at its hit.
  Seen see(const Eigen::Vector3d& direction, const SurfaceHit& hit) const;
  /// Casts the rays, the same ones everywhere, so that what they miss shows neither as grain nor as bands.
  LightShares shares(const Seen& seen) const;
  /// Linear light that comes back to the eye.
  Eigen::Vector3d light(const Seen& seen, const LightShares& shares) const;
  /// The same from a line's tube: nearly flat, so that its colour can be told at a glance.
  Eigen::Vector3d line(const Eigen::Vector3d& direction, const LineHit& hit) const;

 private:
  double key_light(const Eigen::Vector3d& normal) const;
  const PreparedScene& scene_;
  const RayScene& rays_;
  double key_radius_;
  Eigen::Matrix3d camera_;  ///< rows right, up, back
  Eigen::Vector3d key_direction_, fill_direction_;
  std::vector<Bundle> key_rays_;
  std::vector<Bundle> sky_rays_;  ///< about the z axis
};

}  // namespace furrow::io
