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
#include "physics/base/thread_pool.h"

namespace furrow::io {
namespace {

using Eigen::Vector3d;

constexpr double wire_darkness = 0.45;  // what is left of the light on an edge

struct RayCounts {
  int side;           // side × side rays a pixel
  int sky;            // rays to the sky from each hit
  double key_radius;  // tangent of half the key light's angle: soft shadows take many rays
};

RayCounts ray_counts(Quality quality) {
  switch (quality) {
    case Quality::draft:
      return {2, 1, 0.10};
    case Quality::normal:
      return {4, 2, 0.30};
    case Quality::fine:
      return {6, 4, 0.30};
  }
  throw std::invalid_argument("render: quality " + std::to_string(int(quality)) + " is not known");
}

/// Everything that the rows share; nothing of it changes while the picture is made.
class Picture {
 public:
  Picture(const RenderScene& scene, const RenderOptions& options)
      : width_(options.width),
        height_(options.height),
        counts_(ray_counts(options.quality)),
        scene_(prepare(scene, options)),
        rays_(scene_),
        shader_(scene_, rays_, counts_.side * counts_.side, counts_.sky, counts_.key_radius),
        wire_pixels_(options.wire_pixels) {}

  void draw_row(int row, std::uint8_t* rgb) const {
    const Colour c = background_colour(row, height_);
    const Vector3d background(linear_light(c[0]), linear_light(c[1]), linear_light(c[2]));
    for (int column = 0; column < width_; ++column) {
      const Vector3d light = pixel(column, row, background);
      for (int i = 0; i < 3; ++i) {
        *rgb++ = std::uint8_t(std::lround(255 * srgb(std::clamp(light[i], 0.0, 1.0))));
      }
    }
  }

 private:
  Vector3d pixel(int column, int row, const Vector3d& background) const {
    const PixelShift shift = pixel_shift(column, row);
    const int n = counts_.side;
    Vector3d sum = Vector3d::Zero();
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        // n² places in n² columns and n² rows of the pixel, which give the smoothest edges that so many rays
        // can.
        const double x = column + (i + (j + 0.5) / n) / n, y = row + (j + (i + 0.5) / n) / n;
        sum += light_along(x, y, j * n + i, shift, background);
      }
    }
    return sum / (n * n);
  }

  struct Sight {
    Vector3d eye, direction;
  };
  Sight sight(double x, double y) const {
    const PreparedCamera& c = scene_.camera;
    const double a = (x - width_ / 2.0) * 2 / height_ * c.slope, b = (1 - 2 * y / height_) * c.slope;
    const Vector3d aside = a * c.right + b * c.up;
    if (c.parallel) return {c.eye + aside, c.forward};
    return {c.eye, (c.forward + aside).normalized()};
  }

  /// The place of a point in the picture [pixels].
  Eigen::Vector2d place(const Vector3d& p) const {
    const PreparedCamera& c = scene_.camera;
    const Vector3d d = p - c.eye;
    const double scale = height_ / 2.0 / c.slope / (c.parallel ? 1 : std::max(c.forward.dot(d), 1e-6));
    return {width_ / 2.0 + scale * c.right.dot(d), height_ / 2.0 - scale * c.up.dot(d)};
  }

  /// Whether an edge of the cloth's mesh passes close by. Rims have no edges of their own.
  bool is_on_wire(double x, double y, const SurfaceHit& hit) const {
    const PreparedMesh& mesh = scene_.meshes[hit.mesh];
    if (mesh.style != Style::cloth || (mesh.first_rim >= 0 && hit.triangle >= mesh.first_rim)) return false;
    const auto& t = mesh.triangles[hit.triangle];
    const Eigen::Vector2d p(x, y);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d a = place(mesh.vertices[t[i]]), side = place(mesh.vertices[t[(i + 1) % 3]]) - a;
      const double length2 = side.squaredNorm();
      const double along = length2 > 0 ? std::clamp((p - a).dot(side) / length2, 0.0, 1.0) : 0;
      if ((a + along * side - p).norm() < wire_pixels_) return true;
    }
    return false;
  }

  Vector3d light_along(double x, double y, int sample, const PixelShift& shift,
                       const Vector3d& background) const {
    const auto [eye, ray] = sight(x, y);
    const auto hit = rays_.nearest_surface(eye, ray);
    // Half a radius in front of the surface: neither the sides of a valley nor the thickness of the cloth may
    // swallow its line.
    const double reach =
        hit ? hit->distance + 0.5 * scene_.line_radius.at(hit->distance) + 1.5 * scene_.half_thickness
            : std::numeric_limits<double>::infinity();
    const auto line = rays_.nearest_line(eye, ray, reach);
    if (line) return shader_.line(ray, *line);
    if (!hit) return background;
    const Vector3d light = shader_.surface(ray, *hit, sample, shift);
    return wire_pixels_ > 0 && is_on_wire(x, y, *hit) ? Vector3d(wire_darkness * light) : light;
  }

  int width_, height_;
  RayCounts counts_;
  PreparedScene scene_;
  RayScene rays_;
  Shader shader_;
  double wire_pixels_;
};

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
  const Picture picture(scene, options);
  Image image{options.width, options.height, {}};
  const std::size_t row_size = std::size_t{3} * options.width;
  image.rgb.resize(row_size * options.height);
  physics::ThreadPool pool(options.threads);
  pool.share(options.height, [&](int row, int) {  // who draws a row does not change it
    picture.draw_row(row, image.rgb.data() + std::size_t(row) * row_size);
  });
  return image;
}

}  // namespace furrow::io
