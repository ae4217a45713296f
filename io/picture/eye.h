// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>

#include "io/picture/prepared_scene.h"
#include "io/picture/ray_scene.h"
#include "io/picture/shade.h"

namespace furrow::io {

/// What is seen at a place of the picture: a surface, or else a line with its light, or else nothing.
struct Look {
  bool is_near_thin = false;  ///< a line or an edge of the mesh passes by, so near that a pixel may miss it
  std::optional<Seen> surface;
  std::optional<Eigen::Vector3d> line;
};

/// The camera, with all that it looks at.
class Eye {
 public:
  /// Keeps references to the first three.
  Eye(const PreparedScene& scene, const RayScene& rays, const Shader& shader, const RenderOptions& options);

  /// Looks through a place of the picture [pixels].
  Look look(double x, double y) const;

 private:
  struct Sight {
    Eigen::Vector3d start, direction;
  };
  Sight sight(double x, double y) const;
  Eigen::Vector2d place(const Eigen::Vector3d& p) const;
  double to_wire(double x, double y, const SurfaceHit& hit) const;

  const PreparedScene& scene_;
  const RayScene& rays_;
  const Shader& shader_;
  int width_, height_;
  double wire_pixels_;
};

}  // namespace furrow::io
