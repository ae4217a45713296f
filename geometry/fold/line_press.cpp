// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/line_press.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/fold/line_region.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/press_map.h"
#include "geometry/mesh/property_names.h"

namespace furrow::geometry {

std::vector<double> presses_of_lines(const Mesh& mesh, const std::vector<double>& presses,
                                     const std::vector<double>& widths) {
  for (std::size_t i = 0; i < presses.size(); ++i)
    if (!(presses[i] >= 1) || !std::isfinite(presses[i]))
      refuse("presses_of_lines",
             "press of line " + std::to_string(i) + " is " + std::to_string(presses[i]) + ", not >= 1");
  const auto id = find_map(mesh, attribute::line);
  std::vector<std::vector<Vertex>> lines(presses.size());
  if (id)
    for (Vertex v : mesh.vertices())
      if ((*id)[v] >= 0 && std::size_t((*id)[v]) < lines.size() && presses[(*id)[v]] > 1)
        lines[(*id)[v]].push_back(v);
  if (std::all_of(lines.begin(), lines.end(), [](const auto& line) { return line.empty(); })) return {};
  const std::vector<double> lengths = lengths_before_lines(mesh);
  std::vector<double> factors(mesh.num_edges(), 1);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].empty()) continue;
    std::vector<char> inside(mesh.num_vertices(), 0);
    for (Vertex v : line_region(mesh, lines[i], i < widths.size() ? widths[i] : unset_value, lengths))
      inside[v.idx()] = 1;
    for (Edge e : mesh.edges())
      if (inside[mesh.vertex(e, 0).idx()] && inside[mesh.vertex(e, 1).idx()])
        factors[e.idx()] = std::max(factors[e.idx()], presses[i]);
  }
  return factors;
}

std::vector<double> hinge_presses(const Mesh& mesh, const std::vector<double>& presses,
                                  const std::vector<double>& widths) {
  std::vector<double> factors = presses_of_lines(mesh, presses, widths);
  const auto own = find_map(mesh, attribute::press);
  if (!own) return factors;
  factors.resize(mesh.num_edges(), 1);
  for (Edge e : mesh.edges()) {
    const double press = (*own)[e];
    if (std::isnan(press)) continue;
    if (!(press >= 0) || !std::isfinite(press))
      throw ContentError("edge " + std::to_string(mesh.vertex(e, 0).idx()) + "-" +
                         std::to_string(mesh.vertex(e, 1).idx()) + " has the press " + std::to_string(press) +
                         "; it must be >= 0 and finite, or unset (nan)");
    factors[e.idx()] = press;
  }
  return factors;
}

}  // namespace furrow::geometry
