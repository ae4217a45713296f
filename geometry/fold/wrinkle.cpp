// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/wrinkle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "geometry/fold/displace_line.h"
#include "geometry/fold/fold_lines.h"
#include "geometry/fold/line_profile.h"
#include "geometry/fold/line_region.h"
#include "geometry/fold/wrinkle_steps.h"
#include "geometry/insert/insert_along_stroke.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/tangent_frames.h"
#include "geometry/mesh/two_ring.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/stroke/placed_stroke.h"

namespace furrow::geometry {
namespace {

void check_all(const Mesh& mesh, std::span<const Stroke> strokes, const WrinkleOptions& options) {
  if (!(options.density > 0 && std::isfinite(options.density)))
    refuse("wrinkle", "density must be > 0 kg/m^2");
  if (options.first_line < 0 || options.first_line > most_lines)
    refuse("wrinkle", "first_line must be in [0, " + std::to_string(most_lines) + "], not " +
                          std::to_string(options.first_line));
  for (const auto& r_avg : {options.mean_structural_length, options.mean_bending_length})
    if (r_avg && !(*r_avg > 0 && std::isfinite(*r_avg)))
      refuse("wrinkle", "a mean rest length must be > 0 m");
  check(options.insertion);
  for (const Stroke& stroke : strokes)
    if (const std::string fault = shape_fault(stroke); !fault.empty())
      throw ContentError("stroke \"" + stroke.name + "\": " + fault);
  check_mesh(mesh, "wrinkle");
  require_vertices(mesh, std::vector<Vertex>(options.held.begin(), options.held.end()), "wrinkle: held");
}

struct Moves {
  std::vector<Displacement> lines;     ///< of lines without a width; smoothed
  std::vector<Displacement> profiles;  ///< of lines with one, on top of that; as they are
};

/// What lines with a width raise: the highest ridge and the deepest valley of each vertex, added.
std::map<Vertex, double> profiled_heights(const Mesh& mesh, const std::vector<Insertion>& lines,
                                          std::span<const Stroke> strokes) {
  std::map<Vertex, std::array<double, 2>> extremes;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!strokes[i].width) continue;
    std::vector<Vertex> own;
    for (const LineVertex& v : lines[i].line.vertices) own.push_back(v.vertex);
    for (const Lift& lift : lift_by_profile(mesh, own, lines[i].path, strokes[i])) {
      auto& [lowest, highest] = extremes[lift.vertex];
      lowest = std::min(lowest, lift.height);
      highest = std::max(highest, lift.height);
    }
  }
  std::map<Vertex, double> heights;
  for (const auto& [vertex, both] : extremes) heights[vertex] = both[0] + both[1];
  return heights;
}

/// The vertices of lines without a width, each with the displacement of the last such line that has it, and
/// what lines with a width raise.
Moves displacements(const Mesh& mesh, const std::vector<Insertion>& lines, std::span<const Stroke> strokes,
                    const std::set<Vertex>& held) {
  std::map<Vertex, Displacement> last;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!strokes[i].width)
      for (const LineVertex& v : lines[i].line.vertices)
        last[v.vertex] = {v.vertex, v.normal, strokes[i].height};
  Moves moves;
  for (const auto& [vertex, displacement] : last)
    if (!held.count(vertex)) moves.lines.push_back(displacement);
  const std::map<Vertex, double> profiled = profiled_heights(mesh, lines, strokes);
  const std::vector<Vector> normals = profiled.empty() ? std::vector<Vector>{} : vertex_normals(mesh);
  for (const auto& [vertex, height] : profiled)
    if (!held.count(vertex) && normals[vertex.idx()].squared_length() > 0)
      moves.profiles.push_back({vertex, normals[vertex.idx()], height});
  return moves;
}

std::vector<std::string> warnings_of_coarse(const Mesh& mesh, const std::vector<Insertion>& lines,
                                            std::span<const Stroke> strokes) {
  std::vector<std::string> warnings;
  const std::vector<double> lengths = lengths_before_lines(mesh);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!strokes[i].width) continue;
    std::vector<Vertex> own;
    for (const LineVertex& v : lines[i].line.vertices) own.push_back(v.vertex);
    const double width = *strokes[i].width;
    const double coarse = coarseness(mesh, line_region(mesh, own, width, lengths), width, lengths);
    if (coarse > 1)
      warnings.push_back("stroke \"" + strokes[i].name + "\": its width of " + length_text(width) +
                         " is less than three edges of the mesh there (" + length_text(coarse * width / 3) +
                         "); subdivide the garment, or draw the fold wider");
  }
  return warnings;
}

std::vector<Insertion> insert_lines(Mesh& mesh, std::span<const Stroke> strokes,
                                    const WrinkleOptions& options, WrinkleReport& report) {
  InsertionOptions insertion = options.insertion;
  if (!insertion.mean_edge) insertion.mean_edge = report.mean_structural_length;
  std::vector<Insertion> lines;
  StrokeFaults faults;
  for (const Stroke& stroke : strokes) {
    const int id = options.first_line + static_cast<int>(lines.size());
    Insertion one;
    try {
      one = insert_along_stroke(mesh, stroke, id, insertion);
    } catch (const ContentError& e) {
      faults.add(e.what());
      continue;
    }
    report.insertion += one.report;
    WrinkledLine& drawn = report.lines.emplace_back();
    drawn.name = stroke.name, drawn.height = stroke.height, drawn.width = stroke.width;
    drawn.sharpness = stroke.sharpness.value_or(usual_sharpness), drawn.press = stroke.press;
    for (const std::vector<Vertex>& chain : one.line.chains)
      drawn.chains.emplace_back(chain.begin(), chain.end());
    for (const StrokeSegment& segment : one.path) drawn.path.push_back({segment[0], segment[1]});
    lines.push_back(std::move(one));
  }
  faults.raise();
  return lines;
}

void smooth(Mesh& mesh, const Moves& moves, const WrinkleOptions& options, const std::set<Vertex>& held) {
  std::vector<Vertex> region(mesh.vertices().begin(), mesh.vertices().end());
  if (options.region == SmoothingRegion::two_ring) {
    std::vector<Vertex> centres;
    for (const Displacement& d : moves.lines)
      if (d.height != 0) centres.push_back(d.vertex);  // a line of height 0 changes no shape
    region = two_ring(mesh, centres);
  }
  std::erase_if(region, [&](Vertex v) { return held.count(v) > 0; });
  if (region.empty()) return;
  taubin_smooth(mesh, region, options.smoothing);
}

}  // namespace

WrinkleReport wrinkle(Mesh& mesh, std::span<const Stroke> strokes, const WrinkleOptions& options,
                      const StageObserver& observer) {
  check_all(mesh, strokes, options);
  if (options.insertion.rule == InsertionRule::fold) return fold_lines(mesh, strokes, options, observer);
  const std::set<Vertex> held(options.held.begin(), options.held.end());
  const auto tell = [&](Stage stage, const Mesh& m) {
    if (observer) observer(stage, m);
  };
  Mesh work = mesh;
  WrinkleReport report = begin_wrinkling(work, options);
  const std::vector<Insertion> lines = insert_lines(work, strokes, options, report);
  const auto& changed = report.insertion.changed_faces;
  rebuild_bending_springs(work, std::vector<Face>(changed.begin(), changed.end()));
  ensure_rest_angles(work);
  report.warnings = warnings_of_coarse(work, lines, strokes);
  tell(Stage::inserted, work);

  const RestSnapshot before = take_rest_snapshot(work);
  report.undisplaced.assign(before.positions.begin(), before.positions.end());
  const Moves moves = displacements(work, lines, strokes, held);
  const std::vector<double> widths = line_shapes(strokes, options.first_line).widths;
  const std::vector<double> base = heights_from(work, options.first_line, strokes.size(), widths);
  displace_line(work, moves.lines);
  Mesh displaced = work;
  displace_line(displaced, moves.profiles);
  const std::vector<double> drawn = heights_from(displaced, options.first_line, strokes.size(), widths);
  tell(Stage::displaced, displaced);

  smooth(work, moves, options, held);
  displace_line(work, moves.profiles);
  press_stored_hinges(work, line_shapes(strokes, options.first_line));
  apply_rest_rule(work, before, options.rest);
  note_heights(report.lines, base, drawn, heights_from(work, options.first_line, strokes.size(), widths));
  end_wrinkling(work, options, report);
  tell(Stage::smoothed, work);
  mesh = std::move(work);
  return report;
}

}  // namespace furrow::geometry
