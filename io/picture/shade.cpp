// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/shade.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/picture/blue_noise.h"

namespace furrow::io {
namespace {

using Eigen::Vector3d;

// In units of the scene's diagonal.
constexpr double ray_offset = 1e-4;    // a ray starts this far above the surface it leaves
constexpr double sky_distance = 0.35;  // what lies farther away does not hide the sky
// Strength of the lights.
constexpr double key = 1.02, sky = 0.52, fill_light = 0.24;
constexpr double bounce = 0.15;  // of the sky's light, from whatever hides it
const Vector3d key_tint(1.03, 1, 0.96), sky_tint(0.95, 0.985, 1.04);
// Cloth.
constexpr double cavity = 0.15;  // how much darker a sharp valley is painted, and lighter a sharp ridge
constexpr double sheen = 0.12;   // of the light, where cloth is seen along its surface
const Vector3d back_tint(0.66, 0.54, 0.48);

/// A point of a lattice bent to the unit disk, evenly.
Eigen::Vector2d disk_point(const Lattice& lattice, int i, const PixelShift& shift) {
  const Eigen::Vector2d p = lattice.point(i, shift.u, shift.v);
  const double radius = std::sqrt(p.x()), angle = 2 * std::numbers::pi * p.y();
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Two unit vectors that are orthogonal to the unit vector n and to each other.
std::array<Vector3d, 2> across(const Vector3d& n) {
  const Vector3d axis = std::abs(n.x()) < 0.7 ? Vector3d::UnitX() : Vector3d::UnitY();
  const Vector3d u = axis.cross(n).normalized();
  return {u, n.cross(u)};
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
  const auto& n = mesh.corners.empty() ? t : mesh.corners[hit.triangle];
  const std::array<double, 3> weights{std::max(0.0, 1 - hit.u - hit.v), hit.u, hit.v};
  const std::array<Vector3d, 3> corners{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
  Vector3d flat = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  const bool behind = flat.dot(direction) > 0;
  const bool inner =
      mesh.first_inner >= 0 && hit.triangle >= mesh.first_inner && hit.triangle < mesh.first_rim;
  const double side = behind ? -1 : 1;
  flat *= side;
  std::array<Vector3d, 3> normals;
  Vector3d p = Vector3d::Zero(), smooth = p, colour = p;
  for (int i = 0; i < 3; ++i) {
    normals[i] = side * mesh.normals[n[i]];
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
    if (behind != inner) colour = colour.cwiseProduct(back_tint);
  }
  return {raised_point(p, corners, normals, weights) + ray_offset * flat, smooth.normalized(), colour};
}

}  // namespace

PixelShift pixel_shift(int column, int row) {
  return {blue_noise(column, row), blue_noise(column + 37, row + 23)};  // far apart in the tile
}

Shader::Shader(const PreparedScene& scene, const RayScene& rays, int samples, int sky_rays, double key_radius)
    : scene_(scene),
      rays_(rays),
      sky_rays_(sky_rays),
      key_radius_(key_radius),
      key_lattice_(samples),
      sky_lattice_(samples * sky_rays) {
  const PreparedCamera& c = scene.camera;
  key_direction_ = (-0.75 * c.right + 0.58 * c.up - 0.36 * c.forward).normalized();
  key_across_ = across(key_direction_);
  fill_direction_ = (0.9 * c.right - 0.15 * c.up - 0.25 * c.forward).normalized();
}

/// Where all of the light is above the horizon, what it gives without anything in the way is known; the rays
/// only tell what is lost, so that what is lit has no grain.
double Shader::key_light(const Vector3d& p, const Vector3d& normal, int sample,
                         const PixelShift& shift) const {
  const double height = normal.dot(key_direction_), hypotenuse = std::sqrt(1 + key_radius_ * key_radius_);
  const double horizon = key_radius_ / hypotenuse;  // sine of half the light's angle
  if (height < -horizon) return 0;
  const Eigen::Vector2d q = key_radius_ * disk_point(key_lattice_, sample, shift);
  const Vector3d d = (q.x() * key_across_[0] + q.y() * key_across_[1] + key_direction_).normalized();
  const double cosine = std::max(0.0, normal.dot(d));
  if (height < horizon) return cosine > 0 && !rays_.is_blocked(p, d) ? cosine : 0;
  // The mean of 1 / sqrt(1 + r^2) over a disk of radius R is 2 / (sqrt(1 + R^2) + 1).
  return height * 2 / (hypotenuse + 1) - (rays_.is_blocked(p, d) ? cosine : 0);
}

/// The same: the mean of d over the hemisphere, weighted by the cosine, is 2/3 of the normal.
double Shader::sky_light(const Vector3d& p, const Vector3d& normal, int sample,
                         const PixelShift& shift) const {
  const auto brightness = [&](const Vector3d& d) { return 0.56 + 0.44 * d.dot(scene_.camera.up); };
  const std::array<Vector3d, 2> uv = across(normal);
  double lost = 0;
  for (int i = 0; i < sky_rays_; ++i) {
    const Eigen::Vector2d q = disk_point(sky_lattice_, sample * sky_rays_ + i, {shift.v, shift.u});
    const Vector3d d = q.x() * uv[0] + q.y() * uv[1] + std::sqrt(std::max(0.0, 1 - q.squaredNorm())) * normal;
    if (rays_.is_blocked(p, d, sky_distance)) lost += (1 - bounce) * brightness(d);
  }
  return brightness(2.0 / 3 * normal) - lost / sky_rays_;
}

Vector3d Shader::surface(const Vector3d& direction, const SurfaceHit& hit, int sample,
                         const PixelShift& shift) const {
  const PreparedMesh& mesh = scene_.meshes[hit.mesh];
  const Seen seen = see(mesh, hit, direction);
  const Vector3d light = key * key_light(seen.point, seen.normal, sample, shift) * key_tint +
                         sky * sky_light(seen.point, seen.normal, sample, shift) * sky_tint +
                         Vector3d::Constant(fill_light * std::max(0.0, seen.normal.dot(fill_direction_)));
  Vector3d reflected = seen.colour;
  if (mesh.style == Style::cloth) {
    const double grazing = 1 - std::max(0.0, -seen.normal.dot(direction));
    reflected += sheen * std::pow(grazing, 4) * (Vector3d::Ones() - seen.colour);
  }
  return light.cwiseProduct(reflected);
}

Vector3d Shader::line(const Vector3d& direction, const LineHit& hit) const {
  const double facing = std::max(0.0, -hit.normal.dot(direction));
  return (0.7 + 0.3 * facing) * scene_.segments[hit.segment].colour;
}

}  // namespace furrow::io
