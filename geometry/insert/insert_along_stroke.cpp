// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insert/insert_along_stroke.h"

#include <algorithm>
#include <numbers>

#include "geometry/insert/improve_line.h"
#include "geometry/insert/insert_in_faces.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/rest/stiffness.h"

namespace furrow::geometry {
namespace {

constexpr int rounds = 12;

/// A round's line and how good it is.
struct Round {
  DrawnLine drawn;
  LineDeviation deviation;
  double angle;  // [rad]
};

/// Good angles first, then few samples too far away.
bool better(const Round& a, const Round& b, double least_angle) {
  const bool good_a = a.angle >= least_angle, good_b = b.angle >= least_angle;
  if (good_a != good_b) return good_a;
  return good_a ? a.deviation.samples.size() < b.deviation.samples.size() : a.angle > b.angle;
}

}  // namespace

Insertion insert_along_stroke(Mesh& mesh, const Stroke& stroke, int line_id,
                              const InsertionOptions& options) {
  check(options);
  if (line_id < 0) refuse("insertion", "line_id must be >= 0, not " + std::to_string(line_id));
  if (options.rule == InsertionRule::fold) refuse("insertion", "the rule fold is one of wrinkle() alone");
  require_triangles(mesh, "insert_along_stroke");
  const SurfaceProjector projector(mesh);
  Mesh original = mesh;
  const auto rest = ensure_rest_lengths(original);
  const double h = options.mean_edge ? *options.mean_edge : mean_rest_length(original);
  const TracedStroke traced = trace_stroke(mesh, projector, stroke, {options.max_distance, h});
  const double wanted = options.min_angle_deg * std::numbers::pi / 180;
  const double least_angle = std::min(wanted, smallest_angle_around(original, rest, traced)) - 1e-9;

  LinePlan plan;
  const auto draw = [&] {
    Round round{draw_line(original, traced, plan, line_id, h, options), {}, 0};
    round.deviation = deviation_of(round.drawn, original, rest, traced, h);
    round.angle = round.drawn.insertion.report.min_angle_deg * std::numbers::pi / 180;
    return round;
  };
  const auto good = [&](const Round& r) { return r.angle >= least_angle && r.deviation.samples.empty(); };
  Round best = draw();
  std::size_t attempts = 1;
  if (options.rule == InsertionRule::safe && !good(best)) {
    Round last = best;
    while (attempts < rounds && !good(best) && improve_plan(last.drawn, last.deviation, least_angle, plan)) {
      last = draw();
      ++attempts;
      if (better(last, best, least_angle)) best = last;
    }
  }
  InsertionReport& report = best.drawn.insertion.report;
  report.attempts = attempts;
  report.nudges = traced.nudges;
  report.warnings = traced.warnings;
  report.max_deviation = best.deviation.largest;
  best.drawn.insertion.path = stroke_path(traced);
  mesh = std::move(best.drawn.mesh);
  return std::move(best.drawn.insertion);
}

}  // namespace furrow::geometry
