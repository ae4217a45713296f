// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/shade.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

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

/// Points that fill the unit disk evenly, in bundles of 16 that lie together: a sunflower's seeds, by angle.
std::vector<std::vector<Eigen::Vector2d>> disk_points(int bundles) {
  const int n = 16 * bundles;
  std::vector<std::pair<double, double>> seeds;  // angle in turns, radius
  for (int i = 0; i < n; ++i) {
    const double turns = i * (std::numbers::phi - 1);
    seeds.emplace_back(turns - std::floor(turns), std::sqrt((i + 0.5) / n));
  }
  std::sort(seeds.begin(), seeds.end());
  std::vector<std::vector<Eigen::Vector2d>> points(bundles);
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * seeds[i].first;
    points[i / 16].push_back(seeds[i].second * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

/// An orthonormal frame whose z axis is the unit vector n, which changes slowly with it (Duff et al. 2017)
/// but where n is opposite to `back`. `camera`: rows right, up, back.
Eigen::Matrix3d frame_about(const Vector3d& normal, const Eigen::Matrix3d& camera) {
  const Vector3d n = camera * normal;
  const double a = 1 / std::max(1 + n.z(), 1e-9), b = -n.x() * n.y() * a;
  Eigen::Matrix3d frame;
  frame << 1 - n.x() * n.x() * a, b, n.x(), b, 1 - n.y() * n.y() * a, n.y(), -n.x(), -n.y(), n.z();
  return camera.transpose() * frame;
}

/// Of the sky's light: what comes from a level direction, and by how much more comes from straight above.
constexpr double level_sky = 0.56, sky_rise = 0.44;

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

/// A surface at a hit, turned to the eye.
struct Surface {
  Vector3d point, normal, colour;
};

Surface surface_at(const PreparedMesh& mesh, const SurfaceHit& hit, const Vector3d& direction) {
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

Shader::Shader(const PreparedScene& scene, const RayScene& rays, int bundles, double key_radius)
    : scene_(scene), rays_(rays), key_radius_(key_radius) {
  const PreparedCamera& c = scene.camera;
  camera_ << c.right.transpose(), c.up.transpose(), -c.forward.transpose();
  key_direction_ = camera_.transpose() * Vector3d(-0.75, 0.58, 0.36).normalized();
  fill_direction_ = camera_.transpose() * Vector3d(0.9, -0.15, 0.25).normalized();
  const Eigen::Matrix3d key_frame = frame_about(key_direction_, camera_);
  for (const auto& points : disk_points(bundles)) {
    Bundle key_bundle, sky_bundle;
    for (int i = 0; i < 16; ++i) {
      const Eigen::Vector2d& q = points[i];
      const Vector3d to_key(key_radius * q.x(), key_radius * q.y(), 1);
      key_bundle.row(i) = (key_frame * to_key.normalized()).cast<float>();
      sky_bundle.row(i) << float(q.x()), float(q.y()), float(std::sqrt(1 - q.squaredNorm()));
    }
    key_rays_.push_back(key_bundle);
    sky_rays_.push_back(sky_bundle);
  }
}

/// The mean of the cosine over a round light. The mean of 1 / sqrt(1 + r^2) over a disk of radius R is
/// 2 / (sqrt(1 + R^2) + 1), and of the part of x + t above 0 over the unit disk what stands below.
double Shader::key_light(const Vector3d& normal) const {
  const double height = normal.dot(key_direction_), mean = 2 / (std::sqrt(1 + key_radius_ * key_radius_) + 1);
  const double reach = key_radius_ * std::sqrt(std::max(0.0, 1 - height * height));
  if (std::abs(height) >= reach) return std::max(0.0, height) * mean;
  const double t = height / reach, s = std::sqrt(1 - t * t);
  return reach * mean * (t * (std::numbers::pi / 2 + std::asin(t)) + s * (2 + t * t) / 3) / std::numbers::pi;
}

/// The mean of a direction over the hemisphere, weighted by the cosine, is 2/3 of the normal.
Seen Shader::see(const Vector3d& direction, const SurfaceHit& hit) const {
  const PreparedMesh& mesh = scene_.meshes[hit.mesh];
  const Surface surface = surface_at(mesh, hit, direction);
  const Vector3d& n = surface.normal;
  Vector3d reflected = surface.colour;
  if (mesh.style == Style::cloth) {
    const double grazing = 1 - std::max(0.0, -n.dot(direction));
    reflected += sheen * grazing * grazing * grazing * grazing * (Vector3d::Ones() - surface.colour);
  }
  return {hit.mesh,
          surface.point,
          n,
          reflected,
          key * key_light(n),
          sky * (level_sky + sky_rise * (2.0 / 3 * n.dot(scene_.camera.up))),
          fill_light * std::max(0.0, n.dot(fill_direction_))};
}

LightShares Shader::shares(const Seen& seen) const {
  const Eigen::Vector3f n = seen.normal.cast<float>(), up = scene_.camera.up.cast<float>();
  constexpr float least = 1e-3f;  // where the light has set, none of it is hidden
  float all = least, lost = 0;
  for (const Bundle& bundle : key_rays_) {
    const BundleValues cosines = (bundle * n).array().max(0);
    const float sum = cosines.sum();
    if (!(sum > 0)) continue;
    all += sum;
    lost += (cosines * rays_.blocked(seen.point, bundle, std::numeric_limits<float>::infinity())).sum();
  }
  LightShares shares{1 - lost / all, 1};
  const Eigen::Matrix3f frame = frame_about(seen.normal, camera_).cast<float>();
  all = lost = 0;
  for (const Bundle& local : sky_rays_) {
    const Bundle bundle = local * frame.transpose();
    const BundleValues light = float(level_sky) + float(sky_rise) * (bundle * up).array();
    all += light.sum();
    lost += (light * rays_.blocked(seen.point, bundle, sky_distance)).sum();
  }
  shares.sky = 1 - (1 - bounce) * lost / all;
  return shares;
}

Vector3d Shader::light(const Seen& seen, const LightShares& shares) const {
  const Vector3d light =
      seen.key * shares.key * key_tint + seen.sky * shares.sky * sky_tint + Vector3d::Constant(seen.fill);
  return light.cwiseProduct(seen.reflected);
}

Vector3d Shader::line(const Vector3d& direction, const LineHit& hit) const {
  const double facing = std::max(0.0, -hit.normal.dot(direction));
  return (0.7 + 0.3 * facing) * scene_.segments[hit.segment].colour;
}

}  // namespace furrow::io
