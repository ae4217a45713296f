// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/smooth.h"

#include <nlohmann/json.hpp>

#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "physics/base/cancel_scope.h"

namespace furrow::jobs {

SmoothReport smooth(const SmoothJob& job, Listener& listener) {
  const physics::CancelScope cancelling([&listener] { return listener.cancelled(); });
  check_card(job);
  if (!job.output.empty()) check_output(job.output.string());
  check_replaced({job.output.string()}, {name_of(job.mesh, "")}, listener);
  SmoothReport report{{}, job.options.iterations, job.frame};
  take_noted_frame(report.frame, {name_of(job.mesh, "")});
  const Context context{report.frame, listener};
  report.mesh = read_mesh(job.mesh, context);
  stop_if_cancelled(context);
  geometry::taubin_smooth(report.mesh.mesh, {}, job.options);
  stop_if_cancelled(context);
  if (!job.output.empty() && job.output != "-") write_mesh(job.output, report.mesh, context);
  return report;
}

std::vector<CardRow> smoothing_card(geometry::TaubinOptions& o, Group group, Audience audience) {
  using namespace geometry;
  return {
      {"iterations", group, audience, &o.iterations, between(0, 100000),
       "pairs of smoothing steps, a shrinking and an inflating one; 0 = none"},
      {"lambda", group, audience, &o.lambda, "factor of the shrinking step, > 0"},
      {"mu", group, audience, &o.mu, "factor of the inflating step, < -`lambda`"},
      {"weights", group, audience,
       choice(o.weights,
              {{"uniform", SmoothingWeights::uniform}, {"cotangent", SmoothingWeights::cotangent}}),
       "cotangent: of the shape before smoothing"},
      {"keep_lines", group, audience,
       Flag{[&o](bool is_on) { o.lines = is_on ? LineRule::keep : LineRule::free; }},
       "smooth the vertices of a line among themselves only"},
      {"keep_border", group, audience,
       Flag{[&o](bool is_on) { o.border = is_on ? BorderRule::keep : BorderRule::free; }},
       "smooth the border as a curve of its own"},
  };
}

std::vector<CardRow> card(SmoothJob& job) {
  std::vector<CardRow> rows = smoothing_card(job.options);
  rows.insert(rows.begin(), {"output", &job.output, "mesh to write: " + io::mesh_formats()});
  return rows;
}

Json to_json(const SmoothReport& r) {
  return {{"vertices", r.mesh.mesh->number_of_vertices()}, {"iterations", r.iterations}};
}

}  // namespace furrow::jobs
