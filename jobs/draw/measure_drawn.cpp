// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/measure_drawn.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/quality/fold_quality.h"
#include "jobs/base/finite_report.h"

namespace furrow::jobs {
namespace {

constexpr double width_of_height = 5;  ///< of a line that names no width

Eigen::Vector3d eigen_of(const geometry::Point& p) { return {p.x(), p.y(), p.z()}; }

geometry::LinePath path_of_line(const geometry::WrinkledLine& line) {
  geometry::LinePath path;
  for (const auto& [a, b] : line.path) path.push_back({eigen_of(a), eigen_of(b)});
  return path;
}

void take_line(const geometry::FoldSurface& surface, const geometry::WrinkledLine& line, ShapeQuality& q) {
  const double width = line.width.value_or(width_of_height * std::abs(line.height));
  if (!(width > 0) || line.height == 0) return;
  const geometry::LinePath path = path_of_line(line);
  for (const auto& drawn : line.chains) {
    const std::vector<geometry::Vertex> chain(drawn.begin(), drawn.end());
    if (chain.size() < 2) continue;
    const geometry::FoldCurve curve = geometry::curve_of_chain(surface, chain, width, line.height);
    if (curve.points.size() < 2) continue;
    const geometry::LineQuality found = geometry::measure_line(surface, curve, path, true);
    if (found.crest_ripple && *found.crest_ripple >= q.crest_ripple.value_or(0)) {
      q.crest_ripple = found.crest_ripple;
      q.worst_line = line.name;
    }
    if (found.lateral) q.lateral = std::max(q.lateral.value_or(0), *found.lateral);
  }
}

Json json_of_shape(const ShapeQuality& q) {
  return {{"crest_ripple", or_null(q.crest_ripple)},
          {"lateral", or_null(q.lateral)},
          {"angle_defect", q.angle_defect},
          {"min_angle_deg", q.min_angle_deg}};
}

}  // namespace

ShapeQuality quality_before(const geometry::Mesh& mesh) {
  const geometry::MeshQuality whole = geometry::measure_quality(mesh, false);
  ShapeQuality q;
  q.angle_defect = whole.angle_defect;
  q.min_angle_deg = std::min(whole.min_angle_deg, whole.min_rest_angle_deg);
  return q;
}

ShapeQuality quality_of_lines(const geometry::Mesh& mesh, const geometry::WrinkleReport& report) {
  ShapeQuality q = quality_before(mesh);
  if (report.undisplaced.size() != mesh.num_vertices()) return q;
  const geometry::FoldSurface surface = geometry::surface_over(
      mesh, std::vector<geometry::Point>(report.undisplaced.begin(), report.undisplaced.end()));
  for (const geometry::WrinkledLine& line : report.lines) take_line(surface, line, q);
  return q;
}

ShapeQuality quality_of_lines(const geometry::Mesh& mesh, const std::vector<geometry::Point>& places,
                              const geometry::WrinkleReport& report) {
  geometry::Mesh there;  // no maps: they would cost more than all of this
  for (const geometry::Point& p : places) there.add_vertex(p);
  for (geometry::Face f : mesh.faces()) {
    const auto c = geometry::corners_of(mesh, f);
    there.add_face(c[0], c[1], c[2]);
  }
  return quality_of_lines(there, report);
}

Json to_json(const DrawnQuality& quality) {
  Json json{{"before", json_of_shape(quality.before)},
            {"drawn", json_of_shape(quality.drawn)},
            {"after", json_of_shape(quality.after)}};
  if (!quality.after.worst_line.empty()) json["after"]["worst_line"] = quality.after.worst_line;
  return json;
}

}  // namespace furrow::jobs
