// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>

#include "io/picture/prepared_scene.h"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace furrow::io {

/// Where a ray meets a mesh: p = (1−u−v) p0 + u p1 + v p2 of the triangle.
struct SurfaceHit {
  int mesh;
  int triangle;
  double u, v;
  double distance;
};

/// Where a ray meets the tube of a line; the normal is of unit length and points outward.
struct LineHit {
  int segment;
  double distance;
  Eigen::Vector3d normal;
};

/// Directions that are asked for together, one a row: rays that run alike share their way through the tree.
using Bundle = Eigen::Matrix<float, 16, 3>;
using BundleValues = Eigen::Array<float, 16, 1>;

/// A line or an edge of the mesh that passes a pixel's corner this near may be missed by all four [pixels].
constexpr double thin_reach = 0.75;

/// The rays' view of a prepared scene: Embree trees of the meshes and of the lines' tubes. One
/// thread builds the trees, so that the same scene gives the same hits. Directions are of unit length; all
/// coordinates are finite (Debian's Embree aborts on a NaN). Several threads may query at once.
class RayScene {
 public:
  /// Throws std::runtime_error if Embree cannot start.
  explicit RayScene(const PreparedScene& scene);

  std::optional<SurfaceHit> nearest_surface(const Eigen::Vector3d& origin,
                                            const Eigen::Vector3d& direction) const;
  /// The nearest tube before `max_distance`.
  std::optional<LineHit> nearest_line(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                      double max_distance) const;
  /// Whether one passes by at less than thin_reach: so it is at a corner of each pixel that a line covers.
  bool is_line_near(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                    double max_distance) const;
  /// 1 for each direction in which a mesh lies in the way before `max_distance`, else 0. Lines cast no
  /// shadow.
  BundleValues blocked(const Eigen::Vector3d& origin, const Bundle& directions, float max_distance) const;

 private:
  struct Release {
    void operator()(RTCDeviceTy* device) const;
    void operator()(RTCSceneTy* scene) const;
  };
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> surfaces_;
  std::unique_ptr<RTCSceneTy, Release> lines_, wide_lines_;  ///< empty without segments
  std::size_t tubes_ = 0;                                    ///< segments that are no balls
};

}  // namespace furrow::io
