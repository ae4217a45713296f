// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/repair_body.h"
#include "jobs/body/body.h"
#include "jobs/mesh/bake.h"
#include "jobs/mesh/follow.h"
#include "jobs/mesh/smooth.h"
#include "jobs/mesh/subdivide.h"
#include "jobs/mesh/transfer.h"
#include "python/mesh_job.h"

/// Jobs that make one mesh of another: transfer, follow, bake, subdivide, smooth, body.
namespace furrow::python {
namespace {

// ---- transfer

Outcome transfer(const py::list& inputs, Call& call) {
  jobs::TransferJob job;
  take_keywords(call, job);
  take(Value{"original", inputs[0]}, job.original);
  take(Value{"wrinkled", inputs[1]}, job.wrinkled);
  jobs::TransferReport report = without_lock(job, call, jobs::transfer);
  Outcome outcome{jobs::to_json(report)};
  note_written(outcome.report, job.output);
  outcome.meshes.push_back({std::move(report.result), name_of(inputs[0])});
  return outcome;
}

// ---- follow

Outcome follow(const py::list& inputs, Call& call) {
  jobs::FollowJob job;
  take_keywords(call, job);
  take(Value{"garment", inputs[0]}, job.garment);
  jobs::FollowReport report = without_lock(job, call, jobs::follow);
  Outcome outcome{jobs::to_json(report)};
  note_written(outcome.report, job.output);
  outcome.meshes.push_back({std::move(report.garment), name_of(inputs[0])});
  return outcome;
}

// ---- bake

Outcome bake(const py::list& inputs, Call& call) {
  jobs::BakeJob job;
  take_keywords(call, job);
  take(Value{"low", inputs[0]}, job.low);
  take(Value{"high", inputs[1]}, job.high);
  if (job.prefix.empty()) throw std::invalid_argument("output: name what the files of the maps begin with");
  jobs::BakeReport report = without_lock(job, call, jobs::bake);
  if (!report.ran) {
    call.listener.rethrow();
    throw physics::Cancelled("cancelled");
  }
  Outcome outcome{jobs::to_json(report)};
  outcome.succeeded = !report.cancelled;
  if (report.check && !report.cancelled)
    outcome.meshes.push_back({std::move(report.check->applied), name_of(inputs[0])});
  return outcome;
}

// ---- subdivide

Outcome subdivide(const py::list& inputs, Call& call) {
  jobs::SubdivideJob job;
  take_keywords(call, job);
  int ways = 0;
  for (const char* way : {"strokes", "all", "subdivide", "sqrt3", "linear"}) ways += call.has(way);
  if (ways != 1)
    throw std::invalid_argument("subdivide takes one of strokes, all, subdivide, sqrt3 and linear");
  if (call.has("strokes")) job.refinement = jobs::Refinement::strokes;
  take(Value{"mesh", inputs[0]}, job.mesh);
  jobs::SubdivideReport report = without_lock(job, call, jobs::subdivide);
  Outcome outcome{jobs::to_json(report)};
  note_written(outcome.report, job.output);
  outcome.meshes.push_back({std::move(report.mesh), name_of(inputs[0])});
  return outcome;
}

// ---- smooth

Outcome smooth(const py::list& inputs, Call& call) {
  jobs::SmoothJob job;
  take_keywords(call, job);
  take(Value{"mesh", inputs[0]}, job.mesh);
  jobs::SmoothReport report = without_lock(job, call, jobs::smooth);
  Outcome outcome{jobs::to_json(report)};
  note_written(outcome.report, job.output);
  outcome.meshes.push_back({std::move(report.mesh), name_of(inputs[0])});
  return outcome;
}

// ---- body

Outcome body(const py::list& inputs, Call& call) {
  jobs::BodyJob job;
  take_keywords(call, job);
  take(Value{"mesh", inputs[0]}, job.mesh);
  jobs::BodyReport report = without_lock(job, call, jobs::shape_body);
  Outcome outcome{jobs::to_json(report)};
  outcome.succeeded = report.succeeds();
  note_written(outcome.report, job.output);
  outcome.meshes.push_back({std::move(report.mesh), name_of(inputs[0])});
  return outcome;
}

}  // namespace

void add_mesh_jobs(std::vector<Runner>& runners) {
  runners.push_back({"transfer", words_of_card<jobs::TransferJob>(), transfer});
  runners.push_back({"follow", words_of_card<jobs::FollowJob>(), follow});
  runners.push_back({"bake", words_of_card<jobs::BakeJob>(), bake});
  runners.push_back({"subdivide", words_of_card<jobs::SubdivideJob>(), subdivide});
  runners.push_back({"smooth", words_of_card<jobs::SmoothJob>(), smooth});
  runners.push_back({"body", words_of_card<jobs::BodyJob>(), body});
}

}  // namespace furrow::python
