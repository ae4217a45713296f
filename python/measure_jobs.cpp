// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/quality.h"
#include "jobs/mesh/doctor.h"
#include "jobs/rest/fit.h"
#include "python/mesh_job.h"

/// Jobs that measure meshes: fit, doctor, quality.
namespace furrow::python {
namespace {

// ---- fit

const Keywords<jobs::FitJob>& fit_rows() {
  using Job = jobs::FitJob;
  const auto section = [](const Value& v, Job& j) {
    if (!py::isinstance<py::dict>(v.given)) v.fail("a dict such as {\"chest\": 1.25}");
    for (const auto& [name, height] : py::reinterpret_borrow<py::dict>(v.given)) {
      bridge::SectionHeights& heights = j.options.sections;
      const std::string word = py::cast<std::string>(py::str(name));
      if (word != "chest" && word != "waist" && word != "hip") v.fail("heights of chest, waist or hip");
      take(Value{v.keyword, height}, word == "chest"   ? heights.chest
                                     : word == "waist" ? heights.waist
                                                       : heights.hip);
    }
  };
  static const Keywords<Job> rows = {
      row<Job>(
          "body", "the body that wears it, as it stands there; of several garments one, or one for each",
          [](auto& j) -> auto& { return j.bodies; }),
      row<Job>(
          "body_unit", "unit of the bodies' files, where it is not the garments'",
          [](auto& j) -> auto& { return j.body_unit; }),
      row<Job>(
          "rest_shape", "the garment as it was made, with the same vertices, where it has no rest lengths",
          [](auto& j) -> auto& { return j.rest; }),
      row<Job>(
          "output", "mesh to write with colours; PLY keeps the columns fit_distance [m] and strain [-], too",
          [](auto& j) -> auto& { return j.output; }),
      choice<Job, jobs::FitColour>(
          "colour", "of the mesh; default strain, where it is known",
          {{"strain", jobs::FitColour::strain}, {"distance", jobs::FitColour::distance}},
          [](auto& j) -> auto& { return j.colour; }),
      row<Job>(
          "range", "where the colours end: strain [-] or distance [m], > 0; default 2 x tight, 1.2 x loose",
          [](auto& j) -> auto& { return j.range; }),
      row<Job>(
          "tight", "cloth strained more is tight [-], > 0; default 0.05",
          [](auto& j) -> auto& { return j.options.tight_strain; }),
      row<Job>(
          "loose", "cloth farther from the body is loose [m], > 0; default 0.05",
          [](auto& j) -> auto& { return j.options.loose_distance; }),
      row<Job>(
          "contact", "cloth nearer lies on the body [m], >= 0; default 1.2 times the gap that it kept",
          [](auto& j) -> auto& { return j.contact; }),
      row<Job>(
          "smallest_zone", "zones with less area are left out [m^2], >= 0; default 0.001",
          [](auto& j) -> auto& { return j.options.smallest_zone; }),
      own<Job>("section", "Mapping[str, float]",
               "heights of chest, waist or hip in place of what is found [m]", section),
  };
  return rows;
}

Outcome fit(const py::list& inputs, Call& call) {
  jobs::FitJob job;
  take_keywords(fit_rows(), call, job);
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

const Keywords<jobs::DoctorJob>& doctor_rows() {
  using Job = jobs::DoctorJob;
  static const Keywords<Job> rows = {
      row<Job>(
          "body", "body that the garment goes with", [](auto& j) -> auto& { return j.body; }),
      row<Job>(
          "body_unit", "unit of the body's file, where it is not the garment's",
          [](auto& j) -> auto& { return j.body_unit; }),
      row<Job>(
          "as_body", "examine the mesh as a body: closed, wound outwards",
          [](auto& j) -> auto& { return j.is_body; }),
      row<Job>(
          "repair", "mend what can be mended", [](auto& j) -> auto& { return j.repair; }),
      row<Job>(
          "output", "mended mesh to write: obj, ply, off, stl or glb",
          [](auto& j) -> auto& { return j.output; }),
  };
  return rows;
}

Outcome doctor(const py::list& inputs, Call& call) {
  jobs::DoctorJob job;
  take_keywords(doctor_rows(), call, job);
  take(Value{"mesh", inputs[0]}, job.mesh);
  jobs::DoctorReport report = without_lock(job, call, jobs::doctor);
  Outcome outcome{jobs::to_json(report)};
  note_written(outcome.report, job.output);
  outcome.succeeded = report.well();
  outcome.meshes.push_back({std::move(report.mesh), name_of(inputs[0])});
  return outcome;
}

// ---- quality

const Keywords<jobs::QualityJob>& quality_rows() {
  using Job = jobs::QualityJob;
  static const Keywords<Job> rows = {
      row<Job>(
          "strokes", "lines of its folds; default those that the mesh was made with, or carries",
          [](auto& j) -> auto& { return j.strokes; }),
      row<Job>(
          "base", "the garment before its folds; default what the mesh tells of it",
          [](auto& j) -> auto& { return j.base; }),
      row<Job>(
          "height", "of strokes that name none [m]", [](auto& j) -> auto& { return j.height; }),
      row<Job>(
          "width", "of strokes that name none [m]; default as rule fold chooses it",
          [](auto& j) -> auto& { return j.width; }),
      row<Job>(
          "max_distance", "of a stroke's point from the base [m]; default as noted, else 0.05",
          [](auto& j) -> auto& { return j.max_distance; }),
  };
  return rows;
}

Outcome quality(const py::list& inputs, Call& call) {
  jobs::QualityJob job;
  take_keywords(quality_rows(), call, job);
  take(Value{"mesh", inputs[0]}, job.mesh);
  const jobs::QualityReport report = without_lock(job, call, jobs::quality);
  Outcome outcome{jobs::to_json(report)};
  outcome.succeeded = report.met();
  return outcome;
}

}  // namespace

void add_measure_jobs(std::vector<Runner>& runners) {
  runners.push_back({"fit", words_of(fit_rows()), fit});
  runners.push_back({"doctor", words_of(doctor_rows()), doctor});
  runners.push_back({"quality", words_of(quality_rows()), quality});
}

}  // namespace furrow::python
