// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "io/base/camera.h"
#include "io/picture/png_file.h"

namespace furrow::io {

using Colour = std::array<float, 3>;  ///< red, green, blue in [0, 1], sRGB

inline constexpr Colour cloth_colour{0.66f, 0.73f, 0.82f};
inline constexpr Colour body_colour{0.80f, 0.72f, 0.66f};
inline constexpr Colour ridge_colour{0.85f, 0.22f, 0.08f};
inline constexpr Colour valley_colour{0.06f, 0.24f, 0.72f};
inline constexpr Colour mark_colour{0.93f, 0.0f, 0.78f};  ///< magenta: no colour of a fit's scales

/// Cloth has a thickness, shows its back in a darker, warmer colour and, where it is seen at a low angle, a
/// sheen. Its ridges are a little lighter and its valleys a little darker than the lights make them, so that
/// wrinkles can be read from every side; edges sharper than 60 degrees stay sharp. A body is one colour.
enum class Style { cloth, body };

/// A triangle mesh to be drawn. Degenerate triangles and vertices of no triangle are left out.
struct RenderMesh {
  std::vector<Position> vertices;             ///< [m], finite, each coordinate at most 1e9
  std::vector<std::array<int, 3>> triangles;  ///< at least one; indices into vertices; ccw from outside
  Colour colour = cloth_colour;
  std::vector<Colour> vertex_colours;    ///< empty, or one for each vertex: then `colour` is not used
  std::shared_ptr<const Image> texture;  ///< seen in place of the colours; none: nullptr
  /// (u, v) of each triangle's corners, with a texture. (0, 0) is the texture's lower left corner; it
  /// repeats. NaN: none.
  std::vector<std::array<std::array<double, 2>, 3>> texture_coordinates;
  std::vector<Colour> triangle_colours;  ///< empty, or one for each triangle: before all other colours
  Style style = Style::cloth;
  bool framed = true;  ///< the automatic camera holds it in the picture
};

/// A line drawn as a tube, hidden where a surface hides it. One point is a ball, none is nothing.
struct RenderLine {
  std::vector<Position> points;  ///< [m], finite, each coordinate at most 1e9
  Colour colour = ridge_colour;
  double width = 1;  ///< of the tube or ball, in tubes of the options [-], in [0.01, 100]
};

struct RenderScene {
  std::vector<RenderMesh> meshes;  ///< at least one
  std::vector<RenderLine> lines;
};

/// Lines of sight through a pixel on an edge: 4 / 16 / 36. Rays to each of the key light and the sky from a
/// place where light is found: 32 / 128 / 256. A draft's key light is harder.
enum class Quality { draft, normal, fine };

struct RenderOptions {
  int width = 1200;   ///< [pixels], in [1, 16384]
  int height = 1200;  ///< [pixels], in [1, 16384]
  Quality quality = Quality::normal;
  std::optional<Camera> camera;     ///< none: the automatic one of `view`
  View view;                        ///< not used with `camera`
  double line_radius_pixels = 1.8;  ///< of the tubes, in [0.1, 100] [pixels]
  std::optional<double>
      line_radius;  ///< of the tubes, > 0 and at most the scene's diagonal [m]; before the pixels
  /// Of the cloth, half before and half behind its surface; at most 1/200 of the scene's diagonal is shown.
  /// 0: none; in [0, 1e6] [m].
  double thickness = 0.0016;
  double wire_pixels = 0;  ///< cloth is darker where its edges are nearer than this; in [0, 100] [pixels]
  /// The picture is made this many times as wide and high, and each pixel is the mean of its square; in [1,
  /// 8].
  int oversample = 1;
  int threads = 2;  ///< in [1, 64]; the picture does not depend on it
};

/// The camera that `view` and the picture's sides give for the framed meshes of all the scenes together (if
/// none is framed: for all meshes). With it the pictures of several stages can be laid side by side.
Camera automatic_camera(std::span<const RenderScene> scenes, const RenderOptions& options = {});

/// The colour of the empty background in a row of the picture, sRGB: a soft grey, lighter towards the top.
/// `height` ≥ 1 rows, `row` in [0, height).
Colour background_colour(int row, int height);

/// The shaded picture of a scene, without a display, to show the stages (method S1.21). Rays (Embree) find
/// what is seen; normals are smooth; a soft key light rakes from the upper left of the picture; the light of
/// the sky is occluded. What light arrives is found by rays at places 8 pixels apart, and nearer where it
/// must be. The same scene and options give the same bits for any number of threads. Cost: by the edges and
/// the folds that are seen; 1200 × 1200 pixels of normal quality take one core 1 to 3 s. Throws
/// std::invalid_argument for a scene or option out of the ranges above, before any work.
Image render(const RenderScene& scene, const RenderOptions& options = {});

}  // namespace furrow::io
