// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/repair_body.h"
#include "jobs/body/body.h"
#include "jobs/mesh/bake.h"
#include "jobs/mesh/smooth.h"
#include "jobs/mesh/subdivide.h"
#include "jobs/mesh/transfer.h"
#include "python/mesh_job.h"
#include "python/smoothing_rows.h"

/// Jobs that make one mesh of another: transfer, bake, subdivide, smooth, body.
namespace furrow::python {
namespace {

// ---- transfer

const Keywords<jobs::TransferJob>& transfer_rows() {
  using Job = jobs::TransferJob;
  static const Keywords<Job> rows = {
      row<Job>(
          "output", "mesh to write: obj, ply, off, stl or glb", [](auto& j) -> auto& { return j.output; }),
      row<Job>(
          "rest_shape", "the wrinkled mesh's vertices before lines and motion, if it does not know them",
          [](auto& j) -> auto& { return j.rest; }),
      row<Job>(
          "body", "body that it is worn on, in the same frame: where it comes through the mesh is reported",
          [](auto& j) -> auto& { return j.body; }),
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
  take_keywords(transfer_rows(), call, job);
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
      own<Job>("output", "Path", "what the names of the files begin with",
               [](const Value& v, Job& j) { take(v, j.prefix); }),
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
  take_keywords(bake_rows(), call, job);
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
          "output", "mesh to write: obj, ply, off, stl or glb", [](auto& j) -> auto& { return j.output; }),
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
  take_keywords(subdivide_rows(), call, job);
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
        "output", "mesh to write: obj, ply, off, stl or glb", [](auto& j) -> auto& { return j.output; })};
    for (auto& r : smoothing_rows<Job>([](Job& j) -> geometry::TaubinOptions& { return j.options; }))
      list.push_back(r);
    return list;
  }();
  return rows;
}

Outcome smooth(const py::list& inputs, Call& call) {
  jobs::SmoothJob job;
  take_keywords(smooth_rows(), call, job);
  take(Value{"mesh", inputs[0]}, job.mesh);
  jobs::SmoothReport report = without_lock(job, call, jobs::smooth);
  Outcome outcome{jobs::to_json(report)};
  note_written(outcome.report, job.output);
  outcome.meshes.push_back({std::move(report.mesh), name_of(inputs[0])});
  return outcome;
}

// ---- body

const Keywords<jobs::BodyJob>& body_rows() {
  using Job = jobs::BodyJob;
  static const Keywords<Job> rows = {
      row<Job>(
          "output", "mesh to write: obj, ply, off, stl or glb", [](auto& j) -> auto& { return j.output; }),
      row<Job>(
          "height", "from floor to crown [m], in [0.9, 2.5]; none of the four: the body is measured",
          [](auto& j) -> auto& { return j.measures.height; }),
      row<Job>(
          "chest", "around the fullest of the chest, under the armpits [m]",
          [](auto& j) -> auto& { return j.measures.chest; }),
      row<Job>(
          "waist", "around the narrowest [m]", [](auto& j) -> auto& { return j.measures.waist; }),
      row<Job>(
          "hip", "around the fullest of the seat [m]", [](auto& j) -> auto& { return j.measures.hip; }),
  };
  return rows;
}

Outcome body(const py::list& inputs, Call& call) {
  jobs::BodyJob job;
  take_keywords(body_rows(), call, job);
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
  runners.push_back({"transfer", words_of(transfer_rows()), transfer});
  runners.push_back({"bake", words_of(bake_rows()), bake});
  runners.push_back({"subdivide", words_of(subdivide_rows()), subdivide});
  runners.push_back({"smooth", words_of(smooth_rows()), smooth});
  runners.push_back({"body", words_of(body_rows()), body});
}

}  // namespace furrow::python
