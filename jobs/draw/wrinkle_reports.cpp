// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/wrinkle_reports.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "geometry/mesh/property_names.h"
#include "geometry/rest/rest_state.h"
#include "io/mesh/mesh_file.h"
#include "jobs/base/kept_shape.h"

namespace furrow::jobs {

namespace {

Json to_json(const geometry::FoldReport& r) {
  return {{"angle_defect_before", r.angle_defect_before},
          {"angle_defect_after", r.angle_defect_after},
          {"min_angle_before_deg", r.min_angle_before_deg},
          {"min_angle_after_deg", r.min_angle_deg},
          {"lateral", r.lateral},
          {"snapped_vertices", r.snapped},
          {"unsmoothed_vertices", r.unsmoothed_vertices},
          {"reshaped_faces", r.reshaped_faces},
          {"invalid_rest_faces", r.invalid_faces}};
}

}  // namespace

Json to_json(const geometry::InsertionReport& r, const geometry::Mesh& mesh) {
  return to_json(r, geometry::audit_rest_metric(mesh));
}

Json to_json(const geometry::InsertionReport& r, const geometry::RestMetricAudit& audit) {
  Json refused = Json::object();
  for (const auto& [reason, count] : r.refused_flips) refused[geometry::to_string(reason)] = count;
  Json missing = Json::array();
  for (const geometry::MissingLineEdge& m : r.missing_edges)
    missing.push_back(
        {{"from", m.from.idx()}, {"to", m.to.idx()}, {"reason", geometry::to_string(m.reason)}});
  return {{"inserted", r.inserted},
          {"split_edges", r.split_edges.size()},
          {"flipped", r.flipped},
          {"delaunay_flips", r.delaunay_flips},
          {"refused_flips", refused},
          {"reused", r.reused},
          {"snapped", r.snapped},
          {"line_edges_missing", missing},
          {"inverted_faces", audit.inverted_faces},
          {"duplicate_edges", audit.duplicate_edges},
          {"min_angle_deg", audit.min_angle_deg}};
}

Json to_json(const bridge::DrawMoreReport& r, double time) {
  const auto list = [](const physics::Vec3& v) { return Json{v.x(), v.y(), v.z()}; };
  return {{"time", time},
          {"mean_strain", r.mean_strain},
          {"momentum_before", list(r.momentum_before)},
          {"momentum_after", list(r.momentum_after)},
          {"largest_force_jump", r.largest_jump}};
}

int next_line(const geometry::Mesh& mesh) {
  int next = 0;
  if (const auto line = geometry::find_map(mesh, geometry::attribute::line))
    for (geometry::Vertex v : mesh.vertices()) next = std::max(next, (*line)[v] + 1);
  return next;
}

Json to_json(const geometry::WrinkleReport& r, const geometry::Mesh& mesh, int first_line) {
  return to_json(r, geometry::audit_rest_metric(mesh), first_line);
}

Json to_json(const geometry::WrinkleReport& r, const geometry::RestMetricAudit& rest, int first_line) {
  Json report = to_json(r.insertion, rest);
  report["structural_springs"] = r.structural_springs;
  report["bending_springs"] = r.bending_springs;
  report["rest_area_before"] = r.rest_area_before;
  report["rest_area_after"] = r.rest_area_after;
  report["total_mass"] = r.total_mass;
  report["max_deviation"] = r.insertion.max_deviation;
  if (r.fold) report["fold"] = to_json(*r.fold);
  report["lines"] = Json::array();
  for (std::size_t i = 0; i < r.lines.size(); ++i) {
    const geometry::WrinkledLine& line = r.lines[i];
    Json item{{"id", first_line + static_cast<int>(i)},
              {"name", line.name},
              {"parts", line.chains.size()},
              {"height", line.height},
              {"base_height", line.base_height},
              {"drawn_height", line.drawn_height},
              {"smoothed_height", line.smoothed_height}};
    if (line.crest_height) item["crest_height"] = *line.crest_height;
    if (line.width) item["width"] = *line.width, item["sharpness"] = line.sharpness;
    if (line.press != 1) item["press"] = line.press;
    if (line.gather) item["gather"] = *line.gather;
    report["lines"].push_back(std::move(item));
  }
  return report;
}

Json to_json(const DrawnRound& r) {
  Json json = to_json(r.round.report, r.rest, r.round.first_line);
  if (r.round.moving) json["moving"] = to_json(*r.round.moving, r.time);
  if (r.kept) json["kept"] = to_json(*r.kept);
  return json;
}

}  // namespace furrow::jobs
