// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sketch/sketch_lines.h"

#include <CGAL/Polygon_mesh_processing/compute_normal.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "geometry/stroke/project_onto_surface.h"

namespace furrow::jobs {
namespace {

using geometry::Point;
using geometry::Vector;

constexpr double share_of_width = 1.2;
const double usual_height = io::SceneLines{}.height;

const Json& points_of_stroke(const Json& stroke) {
  const auto found = stroke.find("points");
  if (found == stroke.end())
    throw std::invalid_argument(
        "this line is given by vertices of the garment, not by points: draw it by hand");
  return *found;
}

/// The width of a stroke's fold [m]: its own, else five times its height, as a fold that names none has.
double width_of_stroke(const Json& stroke) {
  const auto number = [&](const char* key, double other) {
    const auto found = stroke.find(key);
    return found != stroke.end() && found->is_number() ? found->get<double>() : other;
  };
  return number("width", 5 * std::abs(number("height", usual_height)));
}

std::vector<Point> path_of(const Json& stroke) {
  std::vector<Point> path;
  for (const Json& p : points_of_stroke(stroke))
    path.emplace_back(p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>());
  return path;
}

/// The path moved sideways, and the mean distance by which that misses the cloth [m].
std::pair<std::vector<Point>, double> shifted(const geometry::Mesh& mesh,
                                              const geometry::SurfaceProjector& surface,
                                              const std::vector<Point>& path, double distance) {
  std::vector<Point> moved;
  double missed = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vector along = path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : 0];
    const geometry::SurfaceHit here = surface.closest(path[i]);
    const Vector normal = CGAL::Polygon_mesh_processing::compute_face_normal(here.point.face, mesh);
    const Vector side = CGAL::cross_product(along, normal);
    const double length = std::sqrt(side.squared_length());
    const Point wanted = length > 0 ? path[i] + side * (distance / length) : path[i];
    const geometry::SurfaceHit hit = surface.closest(wanted);
    missed += hit.beyond_border / double(path.size());
    moved.push_back(hit.position);
  }
  return {moved, missed};
}

}  // namespace

double middle_of(const Sketch& sketch) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const geometry::Mesh& mesh = sketch.body ? sketch.body->mesh : sketch.garment.mesh;
  for (const geometry::Vertex v : mesh.vertices()) {
    low = std::min(low, mesh.point(v).x());
    high = std::max(high, mesh.point(v).x());
  }
  return (low + high) / 2;
}

Json mirrored(const Json& stroke, double middle) {
  points_of_stroke(stroke);
  Json other = stroke;
  for (Json& point : other["points"]) point[0] = 2 * middle - point.at(0).get<double>();
  return other;
}

bool lies_in_middle(const Json& stroke, double middle) {
  if (!stroke.contains("points")) return false;
  const double reach = width_of_stroke(stroke) / 2;
  const Json& points = stroke["points"];
  return std::all_of(points.begin(), points.end(),
                     [&](const Json& point) { return std::abs(point.at(0).get<double>() - middle) < reach; });
}

Json beside(const Sketch& sketch, const Json& stroke) {
  const std::vector<Point> path = path_of(stroke);
  const geometry::SurfaceProjector surface(sketch.garment.mesh);
  const double distance = share_of_width * width_of_stroke(stroke);
  auto [right, missed_right] = shifted(sketch.garment.mesh, surface, path, distance);
  if (missed_right > 0) {
    auto [left, missed_left] = shifted(sketch.garment.mesh, surface, path, -distance);
    if (missed_left < missed_right) right = std::move(left);
  }
  Json other = stroke;
  other["points"] = Json::array();
  for (const Point& p : right) other["points"].push_back({p.x(), p.y(), p.z()});
  return other;
}

}  // namespace furrow::jobs
