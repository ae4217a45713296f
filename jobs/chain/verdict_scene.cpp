// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/chain/verdict_scene.h"

#include <algorithm>

#include "geometry/mesh/property_names.h"
#include "io/picture/render_scene.h"

namespace furrow::jobs {
namespace {

using bridge::KeptLine;
using bridge::Verdict;

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
    case Verdict::may_hold:
      return {0.50f, 0.20f, 0.70f};
    case Verdict::cannot_hold:
      return {0.75f, 0.05f, 0.10f};
    case Verdict::not_known:
      return {0.45f, 0.45f, 0.45f};
  }
  return {};
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

io::RenderScene verdict_scene(const geometry::Mesh& mesh, const bridge::KeepReport& report) {
  io::RenderScene scene{{io::render_mesh_from(mesh)}, {}};
  int last = -1;
  for (const KeptLine& line : report.lines) last = std::max(last, line.line);
  const std::vector<double> heights(std::size_t(last + 1), 0.0);
  for (const Verdict verdict : {Verdict::held, Verdict::pressed, Verdict::strutted, Verdict::lowered,
                                Verdict::may_hold, Verdict::cannot_hold, Verdict::not_known}) {
    io::LineColours colours;
    colours.other = colour_of(verdict);
    const auto lines = io::render_lines_from(lines_of(mesh, report.lines, verdict), heights, colours);
    scene.lines.insert(scene.lines.end(), lines.begin(), lines.end());
  }
  return scene;
}

}  // namespace furrow::jobs
