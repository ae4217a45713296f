// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/smooth.h"

#include <nlohmann/json.hpp>

#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "physics/base/cancel_scope.h"

namespace furrow::jobs {

SmoothReport smooth(const SmoothJob& job, Listener& listener) {
  const physics::CancelScope cancelling([&listener] { return listener.cancelled(); });
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

Json to_json(const SmoothReport& r) {
  return {{"vertices", r.mesh.mesh->number_of_vertices()}, {"iterations", r.iterations}};
}

}  // namespace furrow::jobs
