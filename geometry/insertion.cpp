// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insertion.h"

#include <cmath>
#include <stdexcept>

namespace furrow::geometry {

const char* to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::border: return "border";
    case Refusal::seam: return "seam";
    case Refusal::line_edge: return "line edge";
    case Refusal::duplicate_edge: return "duplicate edge";
    case Refusal::not_convex: return "not convex";
    case Refusal::valence: return "valence";
    case Refusal::layer: return "layer";
    case Refusal::quality: return "quality";
  }
  return "unknown";
}

void check(const InsertionOptions& options) {
  const auto require = [](bool holds, const char* rule, double value) {
    if (!holds) throw std::invalid_argument(std::string("insertion: ") + rule + ", not " + std::to_string(value));
  };
  require(options.max_distance > 0, "max_distance must be > 0 m", options.max_distance);
  require(options.min_barycentric >= 0 && options.min_barycentric <= 1.0 / 3,
          "min_barycentric must be in [0, 1/3]", options.min_barycentric);
  require(options.min_angle_deg >= 0 && options.min_angle_deg <= 30, "min_angle_deg must be in [0, 30]",
          options.min_angle_deg);
  if (options.mean_edge) {
    require(*options.mean_edge > 0 && std::isfinite(*options.mean_edge), "mean_edge must be > 0 m",
            *options.mean_edge);
  }
}

}  // namespace furrow::geometry
