// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/wrinkle.h"

#include <map>
#include <set>
#include <stdexcept>

#include "geometry/bending_springs.h"
#include "geometry/displace_line.h"
#include "geometry/errors.h"
#include "geometry/line_height.h"
#include "geometry/masses.h"
#include "geometry/property_names.h"
#include "geometry/rest_angles.h"
#include "geometry/rest_metric.h"
#include "geometry/stiffness.h"
#include "geometry/two_ring.h"

namespace furrow::geometry {
namespace {

/// The vertices of all lines, each with the displacement of the last line that has it.
std::vector<Displacement> displacements(const std::vector<InsertedLine>& lines,
                                        std::span<const Stroke> strokes, const std::set<Vertex>& held) {
  std::map<Vertex, Displacement> last;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const LineVertex& v : lines[i].vertices) last[v.vertex] = {v.vertex, v.normal, strokes[i].height};
  std::vector<Displacement> list;
  for (const auto& [vertex, displacement] : last)
    if (!held.count(vertex)) list.push_back(displacement);
  return list;
}

std::vector<InsertedLine> insert_lines(Mesh& mesh, std::span<const Stroke> strokes,
                                       const WrinkleOptions& options, WrinkleReport& report) {
  InsertionOptions insertion = options.insertion;
  if (!insertion.mean_edge) insertion.mean_edge = report.mean_structural_length;
  std::vector<InsertedLine> lines;
  for (const Stroke& stroke : strokes) {
    const int id = options.first_line + static_cast<int>(lines.size());
    Insertion one = insert_along_stroke(mesh, stroke, id, insertion);
    report.insertion += one.report;
    report.lines.push_back({stroke.name, stroke.height, 0, 0, 0, one.line.chains});
    lines.push_back(std::move(one.line));
  }
  return lines;
}

/// Heights of `count` lines from id `first` on; NaN for a line whose vertices all went to later lines.
std::vector<double> heights(const Mesh& mesh, int first, std::size_t count) {
  std::vector<double> by_id(count, kUnset);
  for (const LineHeight& h : line_heights(mesh))
    if (h.line >= first && static_cast<std::size_t>(h.line - first) < count) by_id[h.line - first] = h.height;
  return by_id;
}

void smooth(Mesh& mesh, std::span<const Displacement> lines, const WrinkleOptions& options,
            const std::set<Vertex>& held) {
  std::vector<Vertex> region(mesh.vertices().begin(), mesh.vertices().end());
  if (options.region == SmoothingRegion::two_ring) {
    std::vector<Vertex> centres;
    for (const Displacement& d : lines)
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
  if (!(options.density > 0)) throw std::invalid_argument("wrinkle: density must be > 0 kg/m^2");
  if (options.first_line < 0)
    throw std::invalid_argument("wrinkle: first_line must be >= 0, not " +
                                std::to_string(options.first_line));
  for (const auto& r_avg : {options.mean_structural_length, options.mean_bending_length})
    if (r_avg && !(*r_avg > 0)) throw std::invalid_argument("wrinkle: a mean rest length must be > 0 m");
  check(options.insertion);
  const std::set<Vertex> held(options.held.begin(), options.held.end());
  if (!held.empty() && (*held.rbegin()).idx() >= mesh.num_vertices())
    throw std::invalid_argument("wrinkle: held vertex " + std::to_string((*held.rbegin()).idx()) +
                                " is not in the mesh");
  const auto tell = [&](Stage stage, const Mesh& m) {
    if (observer) observer(stage, m);
  };
  Mesh work = mesh;
  WrinkleReport report;
  ensure_rest_lengths(work);
  ensure_bending_springs(work);
  ensure_rest_angles(work);
  report.mean_structural_length = options.mean_structural_length.value_or(mean_rest_length(work));
  report.mean_bending_length = options.mean_bending_length.value_or(mean_bending_rest_length(work));
  report.rest_area_before = rest_area(work);

  const std::vector<InsertedLine> lines = insert_lines(work, strokes, options, report);
  rebuild_bending_springs(work, report.insertion.changed_faces);
  ensure_rest_angles(work);
  tell(Stage::inserted, work);

  const RestSnapshot before = take_rest_snapshot(work);
  const std::vector<Displacement> moves = displacements(lines, strokes, held);
  const std::vector<double> base = heights(work, options.first_line, lines.size());
  displace_line(work, moves);
  const std::vector<double> drawn = heights(work, options.first_line, lines.size());
  tell(Stage::displaced, work);

  smooth(work, moves, options, held);
  apply_rest_rule(work, before, options.rest);
  const std::vector<double> smoothed = heights(work, options.first_line, lines.size());
  report.total_mass = lump_masses(work, options.density);
  report.rest_area_after = rest_area(work);
  report.structural_springs = work.number_of_edges();
  report.bending_springs = bending_springs(work).size();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    report.lines[i].base_height = base[i];
    report.lines[i].drawn_height = drawn[i] - base[i];
    report.lines[i].smoothed_height = smoothed[i] - base[i];
  }
  tell(Stage::smoothed, work);
  mesh = std::move(work);
  return report;
}

}  // namespace furrow::geometry
