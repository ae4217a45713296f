// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shade.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace furrow::io {
namespace {

using Eigen::Vector3d;

// In units of the scene's diagonal.
constexpr double kRayOffset = 1e-4;    // a ray starts this far above the surface it leaves
constexpr double kSkyDistance = 0.25;  // what lies farther away does not hide the sky
constexpr double kKeyRadius = 0.10;    // tangent of half the key light's angle: soft shadows
// Strength of the lights.
constexpr double kKey = 0.85, kSky = 0.55, kFill = 0.10;
constexpr double kBounce = 0.30;  // of the sky's light, from whatever hides it

/// Corner of a square to a direction around z whose density is the cosine.
Vector3d cosine_direction(const std::array<double, 2>& at) {
  const double radius = std::sqrt(at[0]), angle = 2 * std::numbers::pi * at[1];
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(std::max(0.0, 1 - at[0]))};
}

/// d, given around z, turned to lie around the unit vector n.
Vector3d turned(const Vector3d& d, const Vector3d& n) {
  const Vector3d axis = std::abs(n.x()) < 0.7 ? Vector3d::UnitX() : Vector3d::UnitY();
  const Vector3d a = axis.cross(n).normalized(), b = n.cross(a);
  return (d.x() * a + d.y() * b + d.z() * n).normalized();
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
  if (back && mesh.style == Style::cloth) colour = colour.cwiseProduct(Vector3d(0.55, 0.42, 0.36));
  return {raised_point(p, corners, normals, weights) + kRayOffset * flat, smooth.normalized(), colour};
}

std::uint32_t mixed(std::uint32_t h) {
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  return h ^ (h >> 16);
}

}  // namespace

std::array<double, 2> SampleSequence::operator()(int i) const {
  const double x = shift_x + i * 0.7548776662466927, y = shift_y + i * 0.5698402909980532;
  return {x - std::floor(x), y - std::floor(y)};
}

SampleSequence pixel_sequence(std::uint32_t x, std::uint32_t y, std::uint32_t purpose) {
  const std::uint32_t a = mixed(x + mixed(y + mixed(purpose))), b = mixed(a + 0x9e3779b9u);
  return {a * 0x1p-32, b * 0x1p-32};
}

Shader::Shader(const PreparedScene& scene, const RayScene& rays, int sky_rays)
    : scene_(scene), rays_(rays), sky_rays_(sky_rays) {
  const PreparedCamera& c = scene.camera;
  key_direction_ = (-0.78 * c.right + 0.52 * c.up - 0.42 * c.forward).normalized();
  fill_direction_ = (0.85 * c.right + 0.1 * c.up - 0.5 * c.forward).normalized();
}

double Shader::key_light(const Vector3d& p, const Vector3d& normal, const std::array<double, 2>& at) const {
  const double radius = kKeyRadius * std::sqrt(at[0]), angle = 2 * std::numbers::pi * at[1];
  const Vector3d d =
      turned(Vector3d(radius * std::cos(angle), radius * std::sin(angle), 1).normalized(), key_direction_);
  const double cosine = normal.dot(d);
  return cosine > 0 && !rays_.is_blocked(p, d) ? cosine : 0;
}

double Shader::sky_light(const Vector3d& p, const Vector3d& normal, int sample,
                         const SampleSequence& sequence) const {
  double sum = 0;
  for (int i = 0; i < sky_rays_; ++i) {
    const Vector3d d = turned(cosine_direction(sequence(sample * sky_rays_ + i)), normal);
    const double brightness = 0.75 + 0.25 * d.dot(scene_.camera.up);
    sum += brightness * (rays_.is_blocked(p, d, kSkyDistance) ? kBounce : 1);
  }
  return sum / sky_rays_;
}

Vector3d Shader::surface(const Vector3d& direction, const SurfaceHit& hit, int sample,
                         const SampleSequence& key, const SampleSequence& sky) const {
  const Seen seen = see(scene_.meshes[hit.mesh], hit, direction);
  const double light = kKey * key_light(seen.point, seen.normal, key(sample)) +
                       kSky * sky_light(seen.point, seen.normal, sample, sky) +
                       kFill * std::max(0.0, seen.normal.dot(fill_direction_));
  return light * seen.colour;
}

Vector3d Shader::line(const Vector3d& direction, const LineHit& hit) const {
  const double facing = std::max(0.0, -hit.normal.dot(direction));
  return (0.7 + 0.3 * facing) * scene_.segments[hit.segment].colour;
}

}  // namespace furrow::io
