// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "io/picture/box_filter.h"
#include "io/picture/prepared_scene.h"
#include "io/picture/ray_scene.h"
#include "io/picture/shade.h"
#include "io/picture/tile.h"
#include "physics/base/thread_pool.h"

namespace furrow::io {
namespace {

using Eigen::Vector3d;

struct Effort {
  int side;           // side × side lines of sight through a pixel on an edge
  int bundles;        // of 16 rays, to the key light and to the sky
  double key_radius;  // tangent of half the key light's angle
};

Effort effort(Quality quality) {
  switch (quality) {
    case Quality::draft:
      return {2, 2, 0.10};
    case Quality::normal:
      return {4, 8, 0.30};
    case Quality::fine:
      return {6, 16, 0.30};
  }
  throw std::invalid_argument("render: quality " + std::to_string(int(quality)) + " is not known");
}

/// Writes the pixels of a tile. A background between other things is mixed in linear light.
void draw(const Tile& tile, int left, int top, Image& image) {
  const auto byte = [](double x) { return std::uint8_t(std::lround(255 * x)); };
  for (int row = top; row < std::min(top + Tile::pixels, image.height); ++row) {
    const Colour c = background_colour(row, image.height);
    const Vector3d background(linear_light(c[0]), linear_light(c[1]), linear_light(c[2]));
    std::uint8_t* rgb = &image.rgb[3 * (std::size_t(row) * image.width + left)];
    for (int column = left; column < std::min(left + Tile::pixels, image.width); ++column) {
      const auto light = tile.pixel(column, row, background);
      for (int i = 0; i < 3; ++i)
        *rgb++ = byte(light ? srgb(std::clamp((*light)[i], 0.0, 1.0)) : double(c[i]));
    }
  }
}

}  // namespace

Camera automatic_camera(std::span<const RenderScene> scenes, const RenderOptions& options) {
  std::vector<Position> framed, all;
  for (const RenderScene& scene : scenes) {
    check_scene(scene);
    for (const RenderMesh& mesh : scene.meshes) {
      for (const auto& triangle : mesh.triangles) {
        for (int v : triangle) {
          all.push_back(mesh.vertices[v]);
          if (mesh.framed) framed.push_back(mesh.vertices[v]);
        }
      }
    }
  }
  return frame_points(framed.empty() ? all : framed, double(options.width) / options.height, options.view);
}

Colour background_colour(int row, int height) {
  const float t = (float(row) + 0.5f) / float(height);
  return {0.92f - 0.085f * t, 0.925f - 0.08f * t, 0.93f - 0.07f * t};
}

/// Options of the large picture of which each pixel of the small one is a mean.
static RenderOptions enlarged(const RenderScene& scene, RenderOptions options) {
  if (!options.camera) options.camera = automatic_camera({&scene, 1}, options);
  options.width *= options.oversample;
  options.height *= options.oversample;
  options.line_radius_pixels *= options.oversample;
  options.wire_pixels *= options.oversample;
  options.oversample = 1;
  return options;
}

Image render(const RenderScene& scene, const RenderOptions& options) {
  if (options.oversample > 1 && options.oversample <= 8)
    return box_filter(render(scene, enlarged(scene, options)), options.oversample);
  const Effort spent = effort(options.quality);
  const PreparedScene prepared = prepare(scene, options);
  const RayScene rays(prepared);
  const Shader shader(prepared, rays, spent.bundles, spent.key_radius);
  const Eye eye(prepared, rays, shader, options);
  Image image{options.width, options.height, {}};
  image.rgb.resize(std::size_t{3} * options.width * options.height);
  const int across = (options.width + Tile::pixels - 1) / Tile::pixels,
            down = (options.height + Tile::pixels - 1) / Tile::pixels;
  physics::ThreadPool pool(options.threads);
  pool.share(across * down, [&](int i, int) {  // who draws a tile does not change it
    const int left = i % across * Tile::pixels, top = i / across * Tile::pixels;
    draw(Tile(eye, shader, spent.side, left, top), left, top, image);
  });
  return image;
}

}  // namespace furrow::io
