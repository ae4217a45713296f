// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/prepared_scene.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "io/picture/thicken.h"

namespace furrow::io {
namespace {

using Eigen::Vector3d;

constexpr double largest = 1e9;  // [m]; far below what single precision loses

Vector3d vector(const Position& p) { return {p[0], p[1], p[2]}; }

[[noreturn]] void refuse(const std::string& text) { throw std::invalid_argument("render: " + text); }

void check_positions(const std::vector<Position>& positions, const std::string& owner) {
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (double x : positions[i]) {
      if (!(std::abs(x) <= largest)) {
        refuse(owner + ", point " + std::to_string(i) + ": coordinate " + std::to_string(x) +
               " is not a number of at most 1e9 m");
      }
    }
  }
}

void check_colour(const Colour& colour, const std::string& owner) {
  for (float c : colour) {
    if (!(c >= 0 && c <= 1)) refuse(owner + ": colour value " + std::to_string(c) + " is not in [0, 1]");
  }
}

void check_texture(const RenderMesh& mesh, const std::string& owner) {
  if (!mesh.texture) return;
  const Image& image = *mesh.texture;
  const std::size_t pixels = std::size_t(std::max(image.width, 0)) * std::size_t(std::max(image.height, 0));
  if (pixels == 0 || image.rgb.size() != 3 * pixels)
    refuse(owner + ": the pixels of its texture do not match its sides");
  if (mesh.texture_coordinates.size() != mesh.triangles.size())
    refuse(owner + ": texture coordinates of " + std::to_string(mesh.texture_coordinates.size()) +
           " triangles for " + std::to_string(mesh.triangles.size()));
}

void check_mesh(const RenderMesh& mesh, const std::string& owner) {
  if (mesh.vertices.empty() || mesh.triangles.empty()) refuse(owner + " is empty: no triangles to draw");
  check_positions(mesh.vertices, owner);
  const int count = int(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) {
    for (int v : triangle) {
      if (v < 0 || v >= count) {
        refuse(owner + ": a triangle names vertex " + std::to_string(v) + " of " + std::to_string(count));
      }
    }
  }
  if (!mesh.vertex_colours.empty() && mesh.vertex_colours.size() != mesh.vertices.size()) {
    refuse(owner + ": " + std::to_string(mesh.vertex_colours.size()) + " colours for " +
           std::to_string(count) + " vertices");
  }
  check_texture(mesh, owner);
  if (!mesh.triangle_colours.empty() && mesh.triangle_colours.size() != mesh.triangles.size()) {
    refuse(owner + ": " + std::to_string(mesh.triangle_colours.size()) + " colours for " +
           std::to_string(mesh.triangles.size()) + " triangles");
  }
  check_colour(mesh.colour, owner);
  for (const Colour& colour : mesh.triangle_colours) check_colour(colour, owner);
  for (const Colour& colour : mesh.vertex_colours) check_colour(colour, owner);
}

/// Middle and diagonal of the box around what the triangles use.
struct Frame {
  Vector3d middle;
  double diagonal;
  Vector3d operator()(const Position& p) const { return (vector(p) - middle) / diagonal; }
};

Frame frame_of(const RenderScene& scene) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const RenderMesh& mesh : scene.meshes) {
    for (const auto& triangle : mesh.triangles) {
      for (int v : triangle) {
        low = low.cwiseMin(vector(mesh.vertices[v]));
        high = high.cwiseMax(vector(mesh.vertices[v]));
      }
    }
  }
  const double diagonal = (high - low).norm();
  if (!(diagonal > 1e-9)) refuse("the meshes have no extent: nothing to draw");
  return {(low + high) / 2, diagonal};
}

Vector3d linear(const Colour& c) { return {linear_light(c[0]), linear_light(c[1]), linear_light(c[2])}; }

/// Adds a triangle's unit normal to its corners, each weighted by its angle (Thürmer and Wüthrich 1998).
void add_normals(const std::array<int, 3>& t, const Vector3d& normal, PreparedMesh& mesh) {
  for (int i = 0; i < 3; ++i) {
    const Vector3d a = mesh.vertices[t[(i + 1) % 3]] - mesh.vertices[t[i]];
    const Vector3d b = mesh.vertices[t[(i + 2) % 3]] - mesh.vertices[t[i]];
    mesh.normals[t[i]] += std::atan2(a.cross(b).norm(), a.dot(b)) * normal;
  }
}

/// The mean over a vertex's triangle sides of `value(from, to)`, a side of two triangles counted twice.
template <class Value>
std::vector<double> mean_over_sides(const PreparedMesh& mesh, const Value& value) {
  std::vector<double> sums(mesh.vertices.size(), 0), counts(mesh.vertices.size(), 0);
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      for (int other : {t[(i + 1) % 3], t[(i + 2) % 3]}) {
        sums[t[i]] += value(t[i], other);
        ++counts[t[i]];
      }
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v) sums[v] /= std::max(counts[v], 1.0);
  return sums;
}

/// Twice the mean of the normal curvature along the sides (change of the normal over the length), which is
/// about the sum of the principal curvatures. It is averaged again over the neighbours, so that single
/// vertices do not speckle, and bent into (−1, 1).
std::vector<double> bulges(const PreparedMesh& mesh) {
  constexpr double sharp = 1.0 / 100;  // radius, of the scene's diagonal
  const std::vector<double> curvature = mean_over_sides(mesh, [&](int a, int b) {
    const Vector3d side = mesh.vertices[b] - mesh.vertices[a];
    return side.dot(mesh.normals[b] - mesh.normals[a]) / side.squaredNorm();
  });
  std::vector<double> result =
      mean_over_sides(mesh, [&](int a, int b) { return curvature[a] + curvature[b]; });
  for (double& x : result) x = sharp * x / (1 + std::abs(sharp * x));
  return result;
}

/// Half of the cloth's thickness in the rays' units: never so much that a small scene is all hem.
double half_thickness(const Frame& frame, const RenderOptions& options) {
  constexpr double most = 1.0 / 200;  // of the scene's diagonal
  return 0.5 * std::min(options.thickness / frame.diagonal, most);
}

PreparedMesh prepare_mesh(const RenderMesh& mesh, const Frame& frame, double half) {
  PreparedMesh result;
  result.style = mesh.style;
  for (const Position& p : mesh.vertices) result.vertices.push_back(frame(p));
  result.normals.assign(mesh.vertices.size(), Vector3d::Zero());
  result.texture = mesh.texture;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const Vector3d a = result.vertices[t[1]] - result.vertices[t[0]];
    const Vector3d b = result.vertices[t[2]] - result.vertices[t[0]];
    const Vector3d cross = a.cross(b);
    if (!(cross.norm() > 1e-15)) continue;  // degenerate: no normal, nothing to see
    result.triangles.push_back(t);
    if (mesh.texture) result.texture_coordinates.push_back(mesh.texture_coordinates[i]);
    if (!mesh.triangle_colours.empty()) result.triangle_colours.push_back(linear(mesh.triangle_colours[i]));
    add_normals(t, cross.normalized(), result);
  }
  for (Vector3d& n : result.normals) n = n.norm() > 1e-6 ? Vector3d(n.normalized()) : Vector3d(0, 0, 0);
  for (const Colour& c : mesh.vertex_colours) result.colours.push_back(linear(c));
  if (result.colours.empty()) result.colours.push_back(linear(mesh.colour));
  if (mesh.style != Style::cloth) return result;
  result.bulges = bulges(result);
  split_normals(result);
  if (half > 0) thicken(result, half);
  return result;
}

PreparedCamera prepare_camera(const Camera& camera, const Frame& frame, int height) {
  if (!vector(camera.eye).allFinite() || !vector(camera.target).allFinite() || !vector(camera.up).allFinite())
    refuse("camera: a coordinate of eye, target or up is not finite");
  if (!(camera.field_of_view_deg >= 1 && camera.field_of_view_deg <= 150))
    refuse("camera: field_of_view_deg " + std::to_string(camera.field_of_view_deg) + " is not in [1, 150]");
  const Vector3d eye = frame(camera.eye);
  if (!(eye.norm() <= 1e5)) refuse("camera: the eye is more than 100,000 scene diagonals away");
  const Vector3d sight = (vector(camera.target) - vector(camera.eye)) / frame.diagonal;
  const Vector3d up = vector(camera.up);
  if (!(sight.norm() > 1e-9)) refuse("camera: eye and target are at one place");
  if (!(sight.normalized().cross(up).norm() > 1e-6 * up.norm()))
    refuse("camera: up is zero or lies along the line of sight");
  if (camera.parallel_height && !(*camera.parallel_height > 0 && std::isfinite(*camera.parallel_height)))
    refuse("camera: parallel_height " + std::to_string(*camera.parallel_height) + " m is not > 0");
  PreparedCamera result;
  result.eye = eye;
  result.forward = sight.normalized();
  result.right = result.forward.cross(up).normalized();
  result.up = result.right.cross(result.forward);
  result.parallel = camera.parallel_height.has_value();
  result.slope = result.parallel ? *camera.parallel_height / 2 / frame.diagonal
                                 : std::tan(camera.field_of_view_deg / 2 * std::numbers::pi / 180);
  result.pixel = 2 * result.slope / height;
  return result;
}

void check_options(const RenderOptions& options) {
  const auto check = [](const char* name, double value, double low, double high) {
    if (value >= low && value <= high) return;
    refuse(std::string(name) + " " + std::to_string(value) + " is not in [" + std::to_string(low) + ", " +
           std::to_string(high) + "]");
  };
  check("width", options.width, 1, 16384);
  check("height", options.height, 1, 16384);
  check("threads", options.threads, 1, 64);
  check("oversample", options.oversample, 1, 8);
  check("line_radius_pixels", options.line_radius_pixels, 0.1, 100);
  check("thickness", options.thickness, 0, 1e6);
  check("wire_pixels", options.wire_pixels, 0, 100);
}

LineRadius line_radius(const Frame& frame, const PreparedCamera& camera, const RenderOptions& options) {
  const double pixels = options.line_radius_pixels * camera.pixel;
  if (!options.line_radius) return camera.parallel ? LineRadius{pixels, 0} : LineRadius{0, pixels};
  if (!(*options.line_radius > 0 && *options.line_radius <= frame.diagonal)) {
    refuse("line_radius " + std::to_string(*options.line_radius) + " m is not in (0, the scene's diagonal]");
  }
  return {*options.line_radius / frame.diagonal, 0};
}

std::vector<PreparedSegment> prepare_lines(const RenderScene& scene, const Frame& frame,
                                           const PreparedCamera& camera, const LineRadius& radius) {
  const auto radius_at = [&](const Vector3d& p, const RenderLine& line) {
    return line.width * radius.at(camera.depth(p));
  };
  std::vector<PreparedSegment> segments;
  for (const RenderLine& line : scene.lines) {
    if (line.points.size() == 1) {
      const Vector3d p = frame(line.points[0]);
      const double r = radius_at(p, line);
      segments.push_back({{p, p}, {r, r}, linear(line.colour)});
    }
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const Vector3d a = frame(line.points[i - 1]), b = frame(line.points[i]);
      if (!((b - a).norm() > 1e-7)) continue;
      segments.push_back({{a, b}, {radius_at(a, line), radius_at(b, line)}, linear(line.colour)});
    }
  }
  std::stable_partition(segments.begin(), segments.end(),
                        [](const PreparedSegment& s) { return !s.is_ball(); });
  return segments;
}

}  // namespace

double linear_light(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
double srgb(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; }

void check_scene(const RenderScene& scene) {
  if (scene.meshes.empty()) refuse("the scene is empty: no meshes to draw");
  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    check_mesh(scene.meshes[i], "mesh " + std::to_string(i));
  for (std::size_t i = 0; i < scene.lines.size(); ++i) {
    check_positions(scene.lines[i].points, "line " + std::to_string(i));
    check_colour(scene.lines[i].colour, "line " + std::to_string(i));
    const double width = scene.lines[i].width;
    if (!(width >= 0.01 && width <= 100))
      refuse("line " + std::to_string(i) + ": width " + std::to_string(width) + " is not in [0.01, 100]");
  }
}

PreparedScene prepare(const RenderScene& scene, const RenderOptions& options) {
  check_options(options);
  check_scene(scene);
  const Frame frame = frame_of(scene);
  PreparedScene result;
  const Camera camera = options.camera ? *options.camera : automatic_camera({&scene, 1}, options);
  result.camera = prepare_camera(camera, frame, options.height);
  result.line_radius = line_radius(frame, result.camera, options);
  result.segments = prepare_lines(scene, frame, result.camera, result.line_radius);
  result.half_thickness = half_thickness(frame, options);
  for (const RenderMesh& mesh : scene.meshes)
    result.meshes.push_back(prepare_mesh(mesh, frame, result.half_thickness));
  return result;
}

}  // namespace furrow::io
