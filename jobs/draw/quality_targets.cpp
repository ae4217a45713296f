// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/quality_targets.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "io/picture/fit_colours.h"
#include "io/picture/render_scene.h"
#include "jobs/base/finite_report.h"

namespace furrow::jobs {
namespace {

using geometry::LineQuality;
using Value = std::optional<double>;

constexpr double short_line = 5, gentle = 0.2, steep = 0.3;  ///< length, and height, in widths

double slope_of(const LineQuality& line) { return line.width > 0 ? std::abs(line.asked) / line.width : 0; }
bool is_short(const LineQuality& line) { return line.length < short_line * line.width; }

/// The line that is farthest above its target, or nearest to it.
QualityMeasure worst_line(const QualityReport& report, const std::string& name, const std::string& id,
                          const std::string& why, const std::function<Value(const LineQuality&)>& value,
                          const std::function<double(const LineQuality&)>& at_most) {
  QualityMeasure worst{name, id, {}, {}, {}, "", why};
  for (const LineQuality& line : report.lines) {
    const Value v = value(line);
    if (!v) {
      if (worst.why.empty() && !line.missing.empty()) worst.why = line.missing.back();
      continue;
    }
    if (worst.value && *v / at_most(line) <= *worst.value / *worst.at_most) continue;
    worst.value = v, worst.at_most = at_most(line);
    worst.line = line.name.empty() ? "line " + std::to_string(line.line) : line.name;
  }
  if (worst.value) worst.why.clear();
  return worst;
}

/// A target allows for what the garment had before its folds: without it, a miss is no verdict.
QualityMeasure open_without_base(QualityMeasure m, const QualityReport& report) {
  if (report.before || m.met()) return m;
  m.at_most.reset();
  m.at_least.reset();
  m.why = "no verdict without the garment before its folds, `base`";
  return m;
}

QualityMeasure knobs_of(const QualityReport& report) {
  QualityMeasure m{"angle_defect", "B6", report.whole.angle_defect, 40, {}, "", ""};
  if (report.before) m.at_most = std::max(40.0, 2 * report.before->angle_defect + 10);
  return open_without_base(m, report);
}

QualityMeasure thin_faces_of(const QualityReport& report) {
  QualityMeasure m{"min_angle_deg", "B7", {}, {}, 15, "", ""};
  m.value = std::min(report.whole.min_angle_deg, report.whole.min_rest_angle_deg);
  const auto is_steep = [](const LineQuality& line) { return slope_of(line) > steep; };
  if (std::any_of(report.lines.begin(), report.lines.end(), is_steep)) m.at_least = 10;
  if (report.before) {
    const double own = std::min(report.before->min_angle_deg, report.before->min_rest_angle_deg);
    m.at_least = std::min(*m.at_least, own - 2);
  }
  return open_without_base(m, report);
}

Value worst_hem(const geometry::MeshQuality& mesh) {
  Value worst;
  for (const geometry::HemTurn& hem : mesh.hems)
    if (std::isfinite(hem.turn_deg)) worst = std::max(worst.value_or(0), hem.turn_deg);
  return worst;
}

/// Folds that were not measured over what was before them have been worn: their hems may turn a little more.
QualityMeasure hems_of(const QualityReport& report) {
  QualityMeasure m{
      "hem_turn_deg", "B8", worst_hem(report.whole), report.lines.empty() ? 12.0 : 10.0, {}, "", ""};
  if (!m.value) m.why = "the mesh has no border of more than 6 mm";
  if (report.before)
    if (const Value own = worst_hem(*report.before)) m.at_most = std::max(*m.at_most, *own);
  return m;
}

QualityMeasure vertices_of(const QualityReport& report, bool is_fine) {
  QualityMeasure m{"vertex_ratio", "B9", {}, is_fine ? 6.0 : 3.0, {}, "", ""};
  if (report.before && report.before->vertices)
    m.value = static_cast<double>(report.whole.vertices) / static_cast<double>(report.before->vertices);
  else
    m.why = "the garment before its folds is not known";
  return m;
}

Json json_of(const QualityMeasure& m) {
  Json json{{"name", m.name}, {"id", m.id}, {"value", or_null(m.value)}};
  if (m.at_most) json["at_most"] = *m.at_most;
  if (m.at_least) json["at_least"] = *m.at_least;
  json["met"] = m.met();
  if (!m.line.empty()) json["line"] = m.line;
  if (!m.why.empty()) json["why"] = m.why;
  return json;
}

Json json_of(const LineQuality& line) {
  return {{"id", line.line},
          {"name", line.name},
          {"length", line.length},
          {"width", line.width},
          {"height", line.asked},
          {"sections", line.sections},
          {"crest_height", or_null(line.crest_height)},
          {"crest_ripple", or_null(line.crest_ripple)},
          {"lateral", or_null(line.lateral)},
          {"sweep", or_null(line.sweep)},
          {"normals_deg", or_null(line.normals_deg)},
          {"fit", or_null(line.fit)},
          {"fitted_height", or_null(line.fitted_height)},
          {"fitted_width", or_null(line.fitted_width)},
          {"missing", line.missing}};
}

Json json_of(const geometry::MeshQuality& q) {
  Json hems = Json::array();
  for (const geometry::HemTurn& hem : q.hems)
    hems.push_back({{"length", hem.length},
                    {"turn_deg", std::isfinite(hem.turn_deg) ? Json(hem.turn_deg) : Json(nullptr)},
                    {"x", hem.centre.x()},
                    {"y", hem.centre.y()},
                    {"z", hem.centre.z()}});
  return {{"vertices", q.vertices},
          {"angle_defect", q.angle_defect},
          {"min_angle_deg", q.min_angle_deg},
          {"min_rest_angle_deg", q.min_rest_angle_deg},
          {"hems", hems}};
}

}  // namespace

std::vector<QualityMeasure> judged(const QualityReport& report, const std::string& why, bool is_fine) {
  const auto ripple = [](const LineQuality& line) { return is_short(line) ? 0.01 : 0.003; };
  const auto sweep = [](const LineQuality& line) { return is_short(line) ? 0.01 : 0.005; };
  const auto normals = [](const LineQuality& line) { return slope_of(line) <= gentle ? 2.0 : 5.0; };
  const auto fit = [](const LineQuality& line) { return is_short(line) ? 0.05 : 0.01; };
  const auto lateral = [](const LineQuality&) { return 0.005; };
  return {worst_line(report, "crest_ripple", "B1", why, &LineQuality::crest_ripple, ripple),
          worst_line(report, "lateral", "B2", why, &LineQuality::lateral, lateral),
          worst_line(report, "sweep", "B3", why, &LineQuality::sweep, sweep),
          worst_line(report, "normals_deg", "B4", why, &LineQuality::normals_deg, normals),
          worst_line(report, "fit", "B5", why, &LineQuality::fit, fit),
          knobs_of(report),
          thin_faces_of(report),
          hems_of(report),
          vertices_of(report, is_fine)};
}

Json to_json(const QualityReport& report) {
  Json measures = Json::array(), lines = Json::array(), knobs = Json::array();
  for (const QualityMeasure& m : report.measures) measures.push_back(json_of(m));
  for (const LineQuality& line : report.lines) lines.push_back(json_of(line));
  for (const Knob& k : report.knobs)
    knobs.push_back({{"x", k.place.x()}, {"y", k.place.y()}, {"z", k.place.z()}, {"angle_defect", k.defect}});
  Json json{{"met", report.met()},
            {"measures", measures},
            {"lines_from", report.lines_from},
            {"base_from", report.base_from},
            {"mesh", json_of(report.whole)}};
  if (report.before) json["before"] = json_of(*report.before);
  json["lines"] = lines;
  json["worst_places"] = knobs;
  return json;
}

io::RenderScene quality_scene(const QualityReport& report) {
  geometry::Mesh mesh = report.mesh.mesh;
  io::colour_by_fit(mesh, report.defects, {io::FitQuantity::strain, quality_colour_limit, 0});
  io::RenderScene scene;
  scene.meshes.push_back(io::render_mesh_from(mesh, io::Style::cloth));
  for (const Knob& k : report.knobs)
    if (std::abs(k.defect) > quality_colour_limit)
      scene.lines.push_back({{{k.place.x(), k.place.y(), k.place.z()}}, io::mark_colour, 2});
  return scene;
}

}  // namespace furrow::jobs
