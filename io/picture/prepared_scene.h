// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <vector>

#include "io/picture/render.h"

namespace furrow::io {

/// A mesh in the units of the picture's rays: the scene's middle at 0, its diagonal 1. Colours are linear
/// light.
struct PreparedMesh {
  std::vector<Eigen::Vector3d> vertices;
  /// Unit, weighted by angle; 0 where the triangles cancel. First one a vertex, then those of `corners`
  /// alone.
  std::vector<Eigen::Vector3d> normals;
  std::vector<std::array<int, 3>> triangles;  ///< none degenerate
  std::vector<std::array<int, 3>> corners;    ///< indices of normals; empty: those of the vertices
  /// Of cloth with a thickness: where the triangles of its inner copy and of its rims begin; else -1.
  int first_inner = -1, first_rim = -1;
  std::vector<Eigen::Vector3d> colours;           ///< one, or one a vertex
  std::vector<Eigen::Vector3d> triangle_colours;  ///< none, or one a triangle: before `colours`
  /// How much the surface bulges at a vertex: towards 1 on a sharp ridge, −1 in a sharp valley, ±0.5 on a
  /// fold whose radius is 1/100 of the scene's diagonal. Cloth only, else empty.
  std::vector<double> bulges;
  std::shared_ptr<const Image> texture;                                   ///< none, or with coordinates
  std::vector<std::array<std::array<double, 2>, 3>> texture_coordinates;  ///< one a triangle
  Style style = Style::cloth;
};

/// One piece of a line's tube; a round cone, since the radius may grow with the distance from the eye. A line
/// of one point is a ball.
struct PreparedSegment {
  std::array<Eigen::Vector3d, 2> ends;
  std::array<double, 2> radii;
  Eigen::Vector3d colour;  ///< linear light
  bool is_ball() const { return ends[0] == ends[1]; }
};

/// The camera's frame: right, up and forward are orthonormal.
struct PreparedCamera {
  Eigen::Vector3d eye, right, up, forward;
  double slope = 0;       ///< half the picture's height: at depth 1, or everywhere if `parallel`
  double pixel = 0;       ///< a pixel's side, likewise
  bool parallel = false;  ///< all lines of sight run along `forward`
  double depth(const Eigen::Vector3d& p) const { return std::max(forward.dot(p - eye), 1e-4); }
  double pixel_at(const Eigen::Vector3d& p) const { return pixel * (parallel ? 1 : depth(p)); }
};

/// Radius of the lines' tubes: either the same everywhere, or growing with the depth.
struct LineRadius {
  double constant = 0, per_depth = 0;
  double at(double depth) const { return constant + per_depth * depth; }
};

struct PreparedScene {
  std::vector<PreparedMesh> meshes;
  std::vector<PreparedSegment> segments;  ///< balls last
  LineRadius line_radius;
  double half_thickness = 0;  ///< of cloth
  PreparedCamera camera;
};

/// Checks a scene and its options, as `render` promises, and brings everything into the rays' units.
PreparedScene prepare(const RenderScene& scene, const RenderOptions& options);

/// Checks the meshes and lines of a scene alone, without a picture's options.
void check_scene(const RenderScene& scene);

/// sRGB in [0, 1] to linear light, and back.
double linear_light(double srgb);
double srgb(double linear_light);

}  // namespace furrow::io
