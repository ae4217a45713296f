// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insert/insertion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "geometry/mesh/measures.h"
#include "geometry/mesh/preconditions.h"

namespace furrow::geometry {

const char* to_string(Refusal refusal) {
  constexpr std::array words{"border",     "seam",    "line edge", "duplicate edge",
                             "not convex", "valence", "layer",     "quality"};
  return words[static_cast<std::size_t>(refusal)];
}

void check(const InsertionOptions& options) {
  if (!(options.max_distance > 0))
    refuse("insertion", "max_distance must be > 0 m, not " + length_text(options.max_distance));
  if (!(options.min_barycentric >= 0 && options.min_barycentric <= 1.0 / 3))
    refuse("insertion",
           "min_barycentric must be in [0, 1/3], not " + std::to_string(options.min_barycentric));
  if (!(options.min_angle_deg >= 0 && options.min_angle_deg <= 30))
    refuse("insertion", "min_angle_deg must be in [0, 30], not " + std::to_string(options.min_angle_deg));
  if (options.mean_edge && !(*options.mean_edge > 0 && std::isfinite(*options.mean_edge)))
    refuse("insertion", "mean_edge must be > 0 m, not " + std::to_string(*options.mean_edge));
}

InsertionReport& operator+=(InsertionReport& sum, const InsertionReport& line) {
  for (auto count : {&InsertionReport::inserted, &InsertionReport::flipped, &InsertionReport::delaunay_flips,
                     &InsertionReport::folded_flips, &InsertionReport::reused, &InsertionReport::snapped,
                     &InsertionReport::too_small, &InsertionReport::routed, &InsertionReport::nudges})
    sum.*count += line.*count;
  sum.attempts = std::max(sum.attempts, line.attempts);
  for (const auto& [reason, count] : line.refused_flips) sum.refused_flips[reason] += count;
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(sum.split_edges, line.split_edges);
  append(sum.missing_edges, line.missing_edges);
  append(sum.warnings, line.warnings);
  const bool first = sum.changed_faces.empty();
  append(sum.changed_faces, line.changed_faces);
  std::sort(sum.changed_faces.begin(), sum.changed_faces.end());
  sum.changed_faces.erase(std::unique(sum.changed_faces.begin(), sum.changed_faces.end()),
                          sum.changed_faces.end());
  sum.min_angle_deg = first ? line.min_angle_deg : std::min(sum.min_angle_deg, line.min_angle_deg);
  sum.max_deviation = std::max(sum.max_deviation, line.max_deviation);
  return sum;
}

}  // namespace furrow::geometry
