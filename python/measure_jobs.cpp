// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/quality.h"
#include "jobs/mesh/doctor.h"
#include "jobs/rest/fit.h"
#include "python/mesh_job.h"

/// Jobs that measure meshes: fit, doctor, quality.
namespace furrow::python {
namespace {

// ---- fit

Outcome fit(const py::list& inputs, Call& call) {
  jobs::FitJob job;
  take_keywords(call, job);
  for (const py::handle worn : inputs) take(Value{"worn", worn}, job.worn.emplace_back());
  if (job.bodies.empty()) throw std::invalid_argument("body: name the body that wears the garment");
  jobs::FitJobReport report = without_lock(job, call, jobs::fit);
  Outcome outcome{jobs::to_json(report)};
  note_written(outcome.report, job.output);
  for (std::size_t i = 0; i < report.garments.size(); ++i)
    outcome.meshes.push_back({std::move(report.garments[i].garment), name_of(inputs[i])});
  return outcome;
}

// ---- doctor

Outcome doctor(const py::list& inputs, Call& call) {
  jobs::DoctorJob job;
  take_keywords(call, job);
  take(Value{"mesh", inputs[0]}, job.mesh);
  jobs::DoctorReport report = without_lock(job, call, jobs::doctor);
  Outcome outcome{jobs::to_json(report)};
  note_written(outcome.report, job.output);
  outcome.succeeded = report.well();
  outcome.meshes.push_back({std::move(report.mesh), name_of(inputs[0])});
  return outcome;
}

// ---- quality

Outcome quality(const py::list& inputs, Call& call) {
  jobs::QualityJob job;
  take_keywords(call, job);
  take(Value{"mesh", inputs[0]}, job.mesh);
  const jobs::QualityReport report = without_lock(job, call, jobs::quality);
  Outcome outcome{jobs::to_json(report)};
  outcome.succeeded = report.met();
  return outcome;
}

}  // namespace

void add_measure_jobs(std::vector<Runner>& runners) {
  runners.push_back({"fit", words_of_card<jobs::FitJob>(), fit});
  runners.push_back({"doctor", words_of_card<jobs::DoctorJob>(), doctor});
  runners.push_back({"quality", words_of_card<jobs::QualityJob>(), quality});
}

}  // namespace furrow::python
