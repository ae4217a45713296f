// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/simulate_report.h"

#include <cmath>

#include "bridge/convert.h"
#include "geometry/figure/hem_folds.h"
#include "geometry/fold/line_height.h"
#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/self_intersections.h"

namespace furrow::cli {
namespace {

Json lines_to_json(const io::MeshFile& file, const io::WrinkleRecord& record,
                   const std::vector<double>& before) {
  Json lines = Json::array();
  const std::vector<double> now = line_heights_by_id(file);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!std::isfinite(now[i])) continue;  // its vertices went to later lines
    Json line{{"id", i}};
    if (i < record.lines.size()) {
      line["name"] = record.lines[i].name;
      line["drawn_height"] = record.lines[i].drawn_height;
      if (record.lines[i].width) line["width"] = *record.lines[i].width;
    }
    const bool known = i < record.lines.size() && std::isfinite(record.lines[i].smoothed_height);
    const double smoothed = known ? record.lines[i].smoothed_height : before[i];
    const double height = known ? now[i] - record.lines[i].base_height : now[i];
    line["smoothed_height"] = smoothed;
    line["height"] = height;
    // Lines so close together that smoothing made one shape of them have no height of their own to keep.
    if (std::abs(smoothed) > 0.1 * std::abs(line.value("drawn_height", smoothed)))
      line["kept"] = height / smoothed;
    else
      line["kept"] = nullptr;
    lines.push_back(line);
  }
  return lines;
}

Json centre_of_mass(const geometry::Mesh& mesh) {
  const auto mass = *geometry::find_map(mesh, geometry::attribute::mass);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0;
  for (geometry::Vertex v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;
    sum += mass[v] * bridge::to_eigen(mesh.point(v));
    total += mass[v];
  }
  sum /= total;
  return {sum.x(), sum.y(), sum.z()};
}

}  // namespace

Json borders_to_json(const geometry::Mesh& mesh) {
  Json loops = Json::array();
  for (const geometry::BorderLoop& loop : geometry::border_loops(mesh))
    loops.push_back({{"rest_length", geometry::rest_length(mesh, loop)},
                     {"length", loop.length},
                     {"mean_height", loop.mean_height},
                     {"mean_radius", loop.mean_radius},
                     {"radius_maxima", geometry::count_folds(mesh, loop)}});
  return loops;
}

std::vector<double> line_heights_by_id(const io::MeshFile& file) {
  const auto record = io::find_wrinkle_record(file);
  const std::vector<double> widths = record ? io::line_widths(*record) : std::vector<double>{};
  std::vector<double> heights;
  for (const geometry::LineHeight& h : geometry::line_heights(file.mesh, widths)) {
    heights.resize(std::max(heights.size(), static_cast<std::size_t>(h.line) + 1), geometry::unset_value);
    heights[h.line] = h.height;
  }
  return heights;
}

Json to_json(const physics::SimulateReport& r, const io::MeshFile& file, const io::WrinkleRecord& record,
             const std::vector<double>& before, const WorldBody* body, double contact_gap) {
  Json report{{"outcome", r.outcome == physics::Outcome::finished     ? "finished"
                          : r.outcome == physics::Outcome::diverged   ? "diverged"
                          : r.outcome == physics::Outcome::stopped_at ? "stopped"
                                                                      : "interrupted"},
              {"time", r.time},
              {"steps", r.steps},
              {"dt", r.dt},
              {"dt_limit", r.dt_limit},
              {"seconds", r.seconds},
              {"cpu_seconds", r.cpu_seconds},
              {"force_evaluations", r.force_evaluations},
              {"spring_evaluations", r.spring_evaluations},
              {"triangle_evaluations", r.triangle_evaluations},
              {"hinge_evaluations", r.hinge_evaluations},
              {"collider_queries", r.collider_queries},
              {"linear_solves", r.linear_solves},
              {"factorisations", r.factorisations},
              {"iterations", r.iterations},
              {"strain", {{"max", r.strain.max}, {"p99", r.strain.p99}, {"mean", r.strain.mean}}},
              {"kinetic_energy", r.kinetic_energy},
              {"residual_force", r.residual_force}};
  if (r.outcome == physics::Outcome::diverged) return report;
  report["centre"] = centre_of_mass(file.mesh);
  if (body) {
    const physics::Penetration p = body->penetration(bridge::positions_of(file.mesh), r.time);
    report["contact_gap"] = contact_gap;
    report["contacts"] = r.contacts;
    report["vertices_inside"] = p.inside;
    report["deepest_penetration"] = p.deepest;
    report["truncated_moves"] = r.truncated_moves;
    if (r.frames_built) report["body_frames"] = {{"built", r.frames_built}, {"seconds", r.frame_seconds}};
  }
  report["self_intersections"] = geometry::count_self_intersections(file.mesh);
  report["borders"] = borders_to_json(file.mesh);
  report["lines"] = lines_to_json(file, record, before);
  return report;
}

}  // namespace furrow::cli
