// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/wrinkle_steps.h"

#include "geometry/fold/line_height.h"
#include "geometry/fold/line_press.h"
#include "geometry/fold/raise_layers.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/press_map.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/masses.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/rest/stiffness.h"

namespace furrow::geometry {

WrinkleReport begin_wrinkling(Mesh& mesh, const WrinkleOptions& options) {
  ensure_rest_lengths(mesh);
  ensure_bending_springs(mesh);
  ensure_rest_angles(mesh);
  WrinkleReport report;
  report.mean_structural_length = options.mean_structural_length.value_or(mean_rest_length(mesh));
  report.mean_bending_length = options.mean_bending_length.value_or(mean_bending_rest_length(mesh));
  report.rest_area_before = rest_area(mesh);
  return report;
}

std::vector<double> heights_from(const Mesh& mesh, int first, std::size_t count,
                                 std::span<const double> widths) {
  std::vector<double> result(count, unset_value);
  for (const LineHeight& h : line_heights(mesh, widths))
    if (h.line >= first && static_cast<std::size_t>(h.line - first) < count)
      result[h.line - first] = h.height;
  return result;
}

void press_stored_hinges(Mesh& mesh, const LineShapes& shapes) {
  const auto stiffness = find_map(mesh, attribute::hinge_stiffness), press = find_map(mesh, attribute::press);
  if (!stiffness && !press) return;
  const std::vector<double> factors = presses_of_lines(mesh, shapes.presses, shapes.widths);
  if (factors.empty()) return;
  for (const auto& map : {stiffness, press})
    if (map)
      for (Edge e : mesh.edges()) (*map)[e] *= factors[e.idx()];  // unset: NaN stays
}

void note_heights(std::vector<WrinkledLine>& lines, const std::vector<double>& base,
                  const std::vector<double>& drawn, const std::vector<double>& smoothed) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i].base_height = base[i];
    lines[i].drawn_height = drawn[i] - base[i];
    lines[i].smoothed_height = smoothed[i] - base[i];
  }
}

void end_wrinkling(Mesh& mesh, const WrinkleOptions& options, WrinkleReport& report) {
  if (const RaisedLayers over = raise_layers(mesh, report.undisplaced, options.held); over.vertices > 0)
    report.warnings.push_back(std::to_string(over.vertices) +
                              " vertices of cloth that lies over lines are raised with them, by up to " +
                              length_text(over.most));
  report.total_mass = lump_masses(mesh, options.density);
  report.rest_area_after = rest_area(mesh);
  report.structural_springs = mesh.number_of_edges();
  report.bending_springs = count_bending_springs(mesh);
}

}  // namespace furrow::geometry
