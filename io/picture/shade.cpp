// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/shade.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace furrow::io {
namespace {

using Eigen::Vector3d;

// In units of the scene's diagonal.
constexpr double ray_offset = 1e-4;    // a ray starts this far above the surface it leaves
constexpr double sky_distance = 0.12;  // what lies farther away does not hide the sky
constexpr double key_radius = 0.10;    // tangent of half the key light's angle: soft shadows
// Strength of the lights.
constexpr double key = 1.02, sky = 0.52, fill = 0.24;
constexpr double bounce = 0.15;  // of the sky's light, from whatever hides it
// Cloth.
constexpr double cavity = 0.34;  // how much darker a sharp valley is painted, and lighter a sharp ridge
const Vector3d back_tint(0.66, 0.54, 0.48);

/// Points of the unit disk, evenly spread however many are taken: the additive recurrence of the plastic
/// number (Roberts 2018), bent to the disk.
Eigen::Vector2d disk_point(int i) {
  const double x = (i + 0.5) * 0.7548776662466927, y = (i + 0.5) * 0.5698402909980532;
  const double radius = std::sqrt(x - std::floor(x)), angle = 2 * std::numbers::pi * (y - std::floor(y));
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Two unit vectors that are orthogonal to the unit vector n and to each other.
std::array<Vector3d, 2> across(const Vector3d& n) {
  const Vector3d axis = std::abs(n.x()) < 0.7 ? Vector3d::UnitX() : Vector3d::UnitY();
  const Vector3d u = axis.cross(n).normalized();
  return {u, n.cross(u)};
}

/// d, which is given about z, turned about z as the pixel says and then to lie about n.
Vector3d turned(const Vector3d& d, const PixelTurn& turn, const Vector3d& n,
                const std::array<Vector3d, 2>& uv) {
  const double x = turn.cosine * d.x() - turn.sine * d.y(), y = turn.sine * d.x() + turn.cosine * d.y();
  return x * uv[0] + y * uv[1] + d.z() * n;
}

/// The point of a curved surface above the hit on its flat triangle: the corners' tangent planes blended.
/// Rays that leave from it do not see the facets at the edge of the shadow (Hanika 2021, "Hacking the shadow
/// terminator"). All normals point to the side that is looked at.
Vector3d raised_point(const Vector3d& p, const std::array<Vector3d, 3>& corners,
                      const std::array<Vector3d, 3>& normals, const std::array<double, 3>& weights) {
  Vector3d raised = Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const double below = std::min(0.0, normals[i].dot(p - corners[i]));
    raised += weights[i] * (p - below * normals[i]);
  }
  return raised;
}

/// Linear light of a texture at (u, v), between the middles of its pixels.
Vector3d texel(const Image& image, double u, double v) {
  static const std::array<double, 256> light = [] {
    std::array<double, 256> table;
    for (int i = 0; i < 256; ++i) table[i] = linear_light(i / 255.0);
    return table;
  }();
  const double x = (u - std::floor(u)) * image.width - 0.5,
               y = (1 - (v - std::floor(v))) * image.height - 0.5;
  const int column = int(std::floor(x)), row = int(std::floor(y));
  Vector3d sum = Vector3d::Zero();
  for (int k = 0; k < 4; ++k) {
    const int i = (column + k % 2 + image.width) % image.width,
              j = (row + k / 2 + image.height) % image.height;
    const double weight = (k % 2 ? x - column : column + 1 - x) * (k / 2 ? y - row : row + 1 - y);
    const std::uint8_t* rgb = &image.rgb[3 * (std::size_t(j) * image.width + i)];
    sum += weight * Vector3d(light[rgb[0]], light[rgb[1]], light[rgb[2]]);
  }
  return sum;
}

/// The texture's colour at a hit, or `colour` where the triangle has no coordinates.
Vector3d painted(const PreparedMesh& mesh, const SurfaceHit& hit, const std::array<double, 3>& weights,
                 const Vector3d& colour) {
  if (!mesh.texture) return colour;
  double uv[2] = {0, 0};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 2; ++k) uv[k] += weights[i] * mesh.texture_coordinates[hit.triangle][i][k];
  constexpr double largest_value = 1e6;  // squares from the first; false for NaN
  return std::abs(uv[0]) < largest_value && std::abs(uv[1]) < largest_value
             ? texel(*mesh.texture, uv[0], uv[1])
             : colour;
}

/// What is seen at a hit, turned to the eye.
struct Seen {
  Vector3d point, normal, colour;
};

Seen see(const PreparedMesh& mesh, const SurfaceHit& hit, const Vector3d& direction) {
  const auto& t = mesh.triangles[hit.triangle];
  const std::array<double, 3> weights{std::max(0.0, 1 - hit.u - hit.v), hit.u, hit.v};
  const std::array<Vector3d, 3> corners{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
  Vector3d flat = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  const bool back = flat.dot(direction) > 0;
  const double side = back ? -1 : 1;
  flat *= side;
  std::array<Vector3d, 3> normals;
  Vector3d p = Vector3d::Zero(), smooth = p, colour = p;
  for (int i = 0; i < 3; ++i) {
    normals[i] = side * mesh.normals[t[i]];
    if (normals[i].dot(flat) < 0.1) normals[i] = flat;  // a fold, or triangles that cancel
    p += weights[i] * corners[i];
    smooth += weights[i] * normals[i];
    colour += weights[i] * mesh.colours[mesh.colours.size() == 1 ? 0 : t[i]];
  }
  colour = painted(mesh, hit, weights, colour);
  if (!mesh.triangle_colours.empty()) colour = mesh.triangle_colours[hit.triangle];
  if (mesh.style == Style::cloth) {
    double bulge = 0;
    for (int i = 0; i < 3; ++i) bulge += weights[i] * mesh.bulges[t[i]];
    colour *= 1 + cavity * side * bulge;
    if (back) colour = colour.cwiseProduct(back_tint);
  }
  return {raised_point(p, corners, normals, weights) + ray_offset * flat, smooth.normalized(), colour};
}

std::uint32_t mixed(std::uint32_t h) {
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  return h ^ (h >> 16);
}

}  // namespace

PixelTurn pixel_turn(std::uint32_t column, std::uint32_t row) {
  const double angle = 2 * std::numbers::pi * 0x1p-32 * mixed(column + mixed(row + 1));
  return {std::cos(angle), std::sin(angle)};
}

Shader::Shader(const PreparedScene& scene, const RayScene& rays, int samples, int sky_rays)
    : scene_(scene), rays_(rays), sky_rays_(sky_rays) {
  const PreparedCamera& c = scene.camera;
  key_direction_ = (-0.75 * c.right + 0.58 * c.up - 0.36 * c.forward).normalized();
  key_across_ = across(key_direction_);
  fill_direction_ = (0.9 * c.right - 0.15 * c.up - 0.25 * c.forward).normalized();
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector2d p = key_radius * disk_point(i);
    key_samples_.push_back(Vector3d(p.x(), p.y(), 1).normalized());
  }
  for (int i = 0; i < samples * sky_rays; ++i) {
    const Eigen::Vector2d p = disk_point(i);
    sky_samples_.emplace_back(p.x(), p.y(), std::sqrt(std::max(0.0, 1 - p.squaredNorm())));
  }
}

double Shader::key_light(const Vector3d& p, const Vector3d& normal, int sample, const PixelTurn& turn) const {
  const Vector3d d = turned(key_samples_[sample], turn, key_direction_, key_across_);
  const double cosine = normal.dot(d);
  return cosine > 0 && !rays_.is_blocked(p, d) ? cosine : 0;
}

double Shader::sky_light(const Vector3d& p, const Vector3d& normal, int sample, const PixelTurn& turn) const {
  const std::array<Vector3d, 2> uv = across(normal);
  double sum = 0;
  for (int i = 0; i < sky_rays_; ++i) {
    const Vector3d d = turned(sky_samples_[sample * sky_rays_ + i], turn, normal, uv);
    const double brightness = 0.56 + 0.44 * d.dot(scene_.camera.up);
    sum += brightness * (rays_.is_blocked(p, d, sky_distance) ? bounce : 1);
  }
  return sum / sky_rays_;
}

Vector3d Shader::surface(const Vector3d& direction, const SurfaceHit& hit, int sample,
                         const PixelTurn& turn) const {
  const Seen seen = see(scene_.meshes[hit.mesh], hit, direction);
  const double light = key * key_light(seen.point, seen.normal, sample, turn) +
                       sky * sky_light(seen.point, seen.normal, sample, turn) +
                       fill * std::max(0.0, seen.normal.dot(fill_direction_));
  return light * seen.colour;
}

Vector3d Shader::line(const Vector3d& direction, const LineHit& hit) const {
  const double facing = std::max(0.0, -hit.normal.dot(direction));
  return (0.7 + 0.3 * facing) * scene_.segments[hit.segment].colour;
}

}  // namespace furrow::io
