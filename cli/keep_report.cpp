// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/keep_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/mesh/property_names.h"
#include "io/picture/render_scene.h"

namespace furrow::cli {
namespace {

using bridge::KeptLine;
using bridge::Verdict;

/// A height or a share of it; null where it is not known.
Json share(double value) { return std::isfinite(value) ? Json(value) : Json(); }

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::held:
      return "held";
    case Verdict::pressed:
      return "held with press";
    case Verdict::strutted:
      return "held with struts";
    case Verdict::lowered:
      return "held lower";
    case Verdict::cannot_hold:
      return "cannot hold";
  }
  return "";
}

io::Colour colour_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::held:
      return {0.05f, 0.55f, 0.25f};
    case Verdict::pressed:
      return {0.93f, 0.78f, 0.05f};
    case Verdict::strutted:
      return {0.95f, 0.45f, 0.05f};
    case Verdict::lowered:
      return {0.10f, 0.35f, 0.85f};
    case Verdict::cannot_hold:
      return {0.75f, 0.05f, 0.10f};
  }
  return {};
}

std::string help_of(const KeptLine& line) {
  std::string text;
  if (line.press > 1) text += fmt::format("press x{:g}", line.press);
  if (line.struts > 0) text += fmt::format("{}struts of {:g} N/m", text.empty() ? "" : " and ", line.struts);
  return text;
}

Json to_json(const KeptLine& line, const io::WrinkleRecord& record) {
  Json json{{"id", line.line}};
  if (std::size_t(line.line) < record.lines.size()) json["name"] = record.lines[line.line].name;
  json.update({{"verdict", name_of(line.verdict)},
               {"height", share(line.height)},
               {"kept", share(line.kept)},
               {"kept_after_gust", share(line.kept_gust)},
               {"press", line.press},
               {"struts", line.struts},
               {"lowered", line.lowered},
               {"words", words(line)}});
  return json;
}

/// The mesh with the lines of one verdict only.
geometry::Mesh lines_of(const geometry::Mesh& mesh, const std::vector<KeptLine>& lines, Verdict verdict) {
  geometry::Mesh result = mesh;
  const auto id = geometry::ensure_map(result, geometry::attribute::line);
  const auto edge = geometry::find_map(result, geometry::attribute::line_edge);
  const auto wanted = [&](int line) {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const KeptLine& l) { return l.line == line && l.verdict == verdict; });
  };
  for (const geometry::Vertex v : result.vertices())
    if (id[v] >= 0 && !wanted(id[v])) id[v] = -1;
  if (edge)
    for (const geometry::Edge e : result.edges())
      if (id[result.vertex(e, 0)] < 0 && id[result.vertex(e, 1)] < 0) (*edge)[e] = false;
  return result;
}

}  // namespace

std::string words(const KeptLine& line) {
  const std::string help = help_of(line);
  switch (line.verdict) {
    case Verdict::held:
      return "held";
    case Verdict::pressed:
    case Verdict::strutted:
      return "held with " + help;
    case Verdict::lowered:
      return fmt::format("held at h = {:.3g} mm{}", 1e3 * line.height, help.empty() ? "" : " with " + help);
    case Verdict::cannot_hold:
      break;
  }
  return "cannot hold" + (help.empty() ? "" : ", also with " + help) + ": " + line.reason;
}

Json to_json(const physics::PrestressReport& rest, const physics::Certificate& certificate) {
  Json imbalance = Json::array();
  for (const physics::RigidImbalance& i : rest.imbalance)
    imbalance.push_back({{"vertices", i.piece.size()},
                         {"freedoms", i.freedoms},
                         {"axis", {i.axis.x(), i.axis.y(), i.axis.z()}},
                         {"point", {i.point.x(), i.point.y(), i.point.z()}},
                         {"acceleration", i.largest}});
  Json json{{"residual", certificate.residual},
            {"stable", certificate.stable()},
            {"negative_eigenvalues", certificate.negative_eigenvalues},
            {"frequency", certificate.frequency},
            {"max_strain", rest.max_strain},
            {"max_angle", rest.max_angle},
            {"bounds_active", rest.active_bounds()},
            {"touching", rest.touching.size()}};
  if (!imbalance.empty()) json["imbalance"] = imbalance;
  return json;
}

Json to_json(const bridge::KeepReport& r, const io::WrinkleRecord& record) {
  Json lines = Json::array();
  for (const KeptLine& line : r.lines) lines.push_back(to_json(line, record));
  Json json{{"lines", lines}};
  json.update(to_json(r.rest, r.certificate));
  json.update({{"drift", r.drift}, {"trials", r.trials}, {"runs", r.runs}});
  if (r.rest_press > 1)
    json["rest_of_garment"] = {{"press", r.rest_press},
                               {"words", fmt::format("pressed x{:g} between the lines", r.rest_press)}};
  if (r.turned > 0) json["turned"] = r.turned;
  if (r.pushed_out > 0) json["pushed_out"] = {{"vertices", r.pushed_out}, {"farthest", r.farthest_push}};
  return json;
}

io::RenderScene verdict_scene(const geometry::Mesh& mesh, const bridge::KeepReport& report) {
  io::RenderScene scene{{io::render_mesh_from(mesh)}, {}};
  int last = -1;
  for (const KeptLine& line : report.lines) last = std::max(last, line.line);
  const std::vector<double> heights(std::size_t(last + 1), 0.0);
  for (const Verdict verdict :
       {Verdict::held, Verdict::pressed, Verdict::strutted, Verdict::lowered, Verdict::cannot_hold}) {
    io::LineColours colours;
    colours.other = colour_of(verdict);
    const auto lines = io::render_lines_from(lines_of(mesh, report.lines, verdict), heights, colours);
    scene.lines.insert(scene.lines.end(), lines.begin(), lines.end());
  }
  return scene;
}

int exit_code_of(const bridge::KeepReport& report) {
  if (report.interrupted) return exit_interrupted;
  const bool all = std::all_of(report.lines.begin(), report.lines.end(),
                               [](const KeptLine& l) { return l.verdict != Verdict::cannot_hold; });
  return all ? exit_ok : exit_not_converged;
}

}  // namespace furrow::cli
