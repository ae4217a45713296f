// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/bake.h"
#include "jobs/doctor.h"
#include "jobs/fit.h"
#include "jobs/info.h"
#include "jobs/quality.h"
#include "jobs/smooth.h"
#include "jobs/subdivide.h"
#include "jobs/transfer.h"
#include "python/keywords.h"
#include "python/smoothing_rows.h"

/// Jobs on meshes alone: fit, transfer, bake, subdivide, smooth, doctor, quality.
namespace furrow::python {
namespace {

std::string name_of(py::handle mesh) {
  if (py::isinstance<HeldMesh>(mesh)) return py::cast<const HeldMesh&>(mesh).name;
  return std::filesystem::path(py::cast<std::string>(py::str(mesh))).stem().string();
}

template <class Job>
void take_inputs(const Keywords<Job>& rows, Call& call, Job& job) {
  call.apply(rows, job);
  call.require_all_used(words_of(rows));
  job.frame = call.frame;
}

void note_written(Json& report, const std::filesystem::path& file) {
  if (!file.empty()) report["written"] = file.string();
}

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
  take_inputs(fit_rows(), call, job);
  for (const py::handle worn : inputs) take(Value{"worn", worn}, job.worn.emplace_back());
  if (job.bodies.empty()) throw std::invalid_argument("body: name the body that wears the garment");
  jobs::FitJobReport report = without_lock(job, call, jobs::fit);
  Outcome outcome{jobs::to_json(report)};
  note_written(outcome.report, job.output);
  for (std::size_t i = 0; i < report.garments.size(); ++i)
    outcome.meshes.push_back({std::move(report.garments[i].garment), name_of(inputs[i])});
  return outcome;
}

// ---- transfer

const Keywords<jobs::TransferJob>& transfer_rows() {
  using Job = jobs::TransferJob;
  static const Keywords<Job> rows = {
      row<Job>(
          "output", "mesh to write: obj, ply, off or stl", [](auto& j) -> auto& { return j.output; }),
      row<Job>(
          "rest_shape", "the wrinkled mesh's vertices before lines and motion, if it does not know them",
          [](auto& j) -> auto& { return j.rest; }),
      row<Job>(
          "max_distance",
          "how far an original vertex may lie from the wrinkled mesh's rest surface [m], > 0; "
          "default 0.02",
          [](auto& j) -> auto& { return j.options.max_distance; }),
  };
  return rows;
}

Outcome transfer(const py::list& inputs, Call& call) {
  jobs::TransferJob job;
  take_inputs(transfer_rows(), call, job);
  take(Value{"original", inputs[0]}, job.original);
  take(Value{"wrinkled", inputs[1]}, job.wrinkled);
  jobs::TransferReport report = without_lock(job, call, jobs::transfer);
  Outcome outcome{jobs::to_json(report)};
  note_written(outcome.report, job.output);
  outcome.meshes.push_back({std::move(report.result), name_of(inputs[0])});
  return outcome;
}

// ---- bake

const Keywords<jobs::BakeJob>& bake_rows() {
  using Job = jobs::BakeJob;
  static const Keywords<Job> rows = {
      row<Job>(
          "output", "what the names of the files begin with", [](auto& j) -> auto& { return j.prefix; }),
      row<Job>(
          "texels", "width and height of the maps, in [1, 8192]; default 2048",
          [](auto& j) -> auto& { return j.options.size; }),
      row<Job>(
          "padding", "how far the charts go on beyond their borders [texels], in [0, 1024]; default 8",
          [](auto& j) -> auto& { return j.options.padding; }),
      row<Job>(
          "check", "apply the written map to the low mesh, cut so many times into four, and compare; 0 to 6",
          [](auto& j) -> auto& { return j.check; }),
      row<Job>(
          "applied", "mesh to write the result of check to", [](auto& j) -> auto& { return j.applied; }),
  };
  return rows;
}

Outcome bake(const py::list& inputs, Call& call) {
  jobs::BakeJob job;
  take_inputs(bake_rows(), call, job);
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

const Keywords<jobs::SubdivideJob>& subdivide_rows() {
  using Job = jobs::SubdivideJob;
  using jobs::Refinement;
  const auto steps = [](Refinement refinement) {
    return [refinement](const Value& v, Job& j) {
      take(v, j.steps);
      j.refinement = refinement;
    };
  };
  const auto all = [](const Value& v, Job& j) {
    bool on = false;
    take(v, on);
    if (on) j.refinement = Refinement::everywhere;
  };
  const auto strokes = [](const Value& v, Job& j) {
    take(v, j.strokes);
    j.refinement = Refinement::strokes;
  };
  static const Keywords<Job> rows = {
      row<Job>(
          "output", "mesh to write: obj, ply, off or stl", [](auto& j) -> auto& { return j.output; }),
      own<Job>("strokes", "Strokes", "insert lines; the shape stays", strokes),
      own<Job>("all", "bool", "insert a vertex in every face and flip every edge", all),
      own<Job>("subdivide", "int", "so many steps of Loop subdivision, 0 to 6", steps(Refinement::loop)),
      own<Job>("sqrt3", "int", "steps of sqrt(3) subdivision, 0 to 6", steps(Refinement::sqrt3)),
      own<Job>("linear", "int", "steps of cutting every triangle into four, 0 to 6",
               steps(Refinement::linear)),
      row<Job>(
          "max_weights", "skin weights that each vertex keeps, >= 0; default as interpolated",
          [](auto& j) -> auto& { return j.max_weights; }),
      choice<Job, geometry::InsertionRule>(
          "rule", "of strokes and all; default safe",
          {{"safe", geometry::InsertionRule::safe}, {"paper", geometry::InsertionRule::paper}},
          [](auto& j) -> auto& { return j.options.rule; }),
      row<Job>(
          "max_distance", "how far a stroke may lie from the surface [m], > 0; default 0.05",
          [](auto& j) -> auto& { return j.options.max_distance; }),
  };
  return rows;
}

Outcome subdivide(const py::list& inputs, Call& call) {
  jobs::SubdivideJob job;
  take_inputs(subdivide_rows(), call, job);
  int ways = 0;
  for (const char* way : {"strokes", "all", "subdivide", "sqrt3", "linear"}) ways += call.has(way);
  if (ways != 1)
    throw std::invalid_argument("subdivide takes one of strokes, all, subdivide, sqrt3 and linear");
  take(Value{"mesh", inputs[0]}, job.mesh);
  jobs::SubdivideReport report = without_lock(job, call, jobs::subdivide);
  Outcome outcome{jobs::to_json(report)};
  note_written(outcome.report, job.output);
  outcome.meshes.push_back({std::move(report.mesh), name_of(inputs[0])});
  return outcome;
}

// ---- smooth

const Keywords<jobs::SmoothJob>& smooth_rows() {
  using Job = jobs::SmoothJob;
  static const Keywords<Job> rows = [] {
    Keywords<Job> list = {row<Job>(
        "output", "mesh to write: obj, ply, off or stl", [](auto& j) -> auto& { return j.output; })};
    for (auto& r : smoothing_rows<Job>([](Job& j) -> geometry::TaubinOptions& { return j.options; }))
      list.push_back(r);
    return list;
  }();
  return rows;
}

Outcome smooth(const py::list& inputs, Call& call) {
  jobs::SmoothJob job;
  take_inputs(smooth_rows(), call, job);
  take(Value{"mesh", inputs[0]}, job.mesh);
  jobs::SmoothReport report = without_lock(job, call, jobs::smooth);
  Outcome outcome{jobs::to_json(report)};
  note_written(outcome.report, job.output);
  outcome.meshes.push_back({std::move(report.mesh), name_of(inputs[0])});
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
          "output", "mended mesh to write: obj, ply, off or stl", [](auto& j) -> auto& { return j.output; }),
  };
  return rows;
}

Outcome doctor(const py::list& inputs, Call& call) {
  jobs::DoctorJob job;
  take_inputs(doctor_rows(), call, job);
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
  take_inputs(quality_rows(), call, job);
  take(Value{"mesh", inputs[0]}, job.mesh);
  const jobs::QualityReport report = without_lock(job, call, jobs::quality);
  Outcome outcome{jobs::to_json(report)};
  outcome.succeeded = report.met();
  return outcome;
}

}  // namespace

void add_mesh_jobs(std::vector<Runner>& runners) {
  runners.push_back({"fit", words_of(fit_rows()), fit});
  runners.push_back({"transfer", words_of(transfer_rows()), transfer});
  runners.push_back({"bake", words_of(bake_rows()), bake});
  runners.push_back({"subdivide", words_of(subdivide_rows()), subdivide});
  runners.push_back({"smooth", words_of(smooth_rows()), smooth});
  runners.push_back({"doctor", words_of(doctor_rows()), doctor});
  runners.push_back({"quality", words_of(quality_rows()), quality});
}

}  // namespace furrow::python
