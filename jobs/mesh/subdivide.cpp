// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/subdivide.h"

#include <nlohmann/json.hpp>

#include "geometry/insert/insert_along_stroke.h"
#include "geometry/insert/insert_in_faces.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/vertex_attributes.h"
#include "geometry/refine/subdivide.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/stroke/placed_stroke.h"
#include "io/stroke/resolve_strokes.h"
#include "io/stroke/stroke_file.h"
#include "jobs/base/card.h"
#include "jobs/base/gate.h"
#include "jobs/base/max_weights.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "jobs/base/seam_ties.h"
#include "jobs/draw/wrinkle_reports.h"
#include "physics/base/cancel_scope.h"

namespace furrow::jobs {
namespace {

/// Springs follow the new edges; masses are lumped anew by whatever needs them.
void conclude(geometry::InsertionReport report, SubdivideReport& result) {
  geometry::Mesh& mesh = result.mesh.mesh;
  if (geometry::find_map(mesh, geometry::attribute::bending_rest_length))
    geometry::rebuild_bending_springs(
        mesh, std::vector<geometry::Face>(report.changed_faces.begin(), report.changed_faces.end()));
  if (auto mass = geometry::find_map(mesh, geometry::attribute::mass)) mesh.remove_property_map(*mass);
  result.rest = geometry::audit_rest_metric(mesh);
  result.insertion = std::move(report);
}

void insert_strokes(const SubdivideJob& job, SubdivideReport& result, const Context& context) {
  geometry::InsertionReport sum;
  int id = next_line(result.mesh.mesh);
  const auto* path = std::get_if<std::filesystem::path>(&job.strokes);
  const auto drawn =
      path ? io::read_drawn_strokes(*path, geometry::Stroke{}.height, read_options(context.frame))
           : std::get<std::vector<io::DrawnStroke>>(job.strokes);
  const io::ResolvedStrokes resolved = io::resolve_strokes(drawn, result.mesh, job.options.max_distance);
  for (const std::string& w : resolved.warnings) context.warn("drawing", w, "strokes");
  geometry::StrokeFaults faults;
  for (const geometry::Stroke& stroke : resolved.strokes) try {
      sum += geometry::insert_along_stroke(result.mesh.mesh, stroke, id++, job.options).report;
    } catch (const geometry::ContentError& e) {
      faults.add(e.what());
    }
  faults.raise();
  for (const std::string& w : sum.warnings) context.warn("drawing", w, "strokes");
  conclude(std::move(sum), result);
}

/// Step by step, since each doubles the ties.
void refine_tied(geometry::Mesh& mesh, const SubdivideJob& job, SeamTies& ties) {
  for (int step = 0; step < job.steps; ++step) {
    ties = refined_ties(mesh, ties);
    job.refinement == Refinement::loop ? geometry::loop_subdivide(mesh, 1)
                                       : void(geometry::midpoint_subdivide(mesh, 1));
  }
}

/// The ties follow what refines the whole mesh into four; where vertices are only added, they stay.
void refine(const SubdivideJob& job, SubdivideReport& result, SeamTies& ties, const Context& context) {
  geometry::Mesh& mesh = result.mesh.mesh;
  if (job.refinement == Refinement::loop || job.refinement == Refinement::linear)
    require_refinement(mesh.number_of_faces(), 4, job.steps,
                       job.refinement == Refinement::loop ? "subdivide" : "linear", context);
  if (job.refinement == Refinement::sqrt3)
    require_refinement(mesh.number_of_faces(), 3, job.steps, "sqrt3", context);
  switch (job.refinement) {
    case Refinement::strokes:
      return insert_strokes(job, result, context);
    case Refinement::everywhere: {
      std::vector<geometry::FacePoint> centroids;
      for (geometry::Face f : mesh.faces()) centroids.push_back({f, {1. / 3, 1. / 3, 1. / 3}});
      return conclude(geometry::insert_in_faces(mesh, centroids, job.options), result);
    }
    case Refinement::sqrt3:
      return geometry::sqrt3_subdivide(mesh, job.steps);
    case Refinement::loop:
      if (ties.empty()) return geometry::loop_subdivide(mesh, job.steps);
      [[fallthrough]];
    case Refinement::linear:
      if (ties.empty()) return void(geometry::midpoint_subdivide(mesh, job.steps));
      refine_tied(mesh, job, ties);
  }
}

}  // namespace

SubdivideReport subdivide(const SubdivideJob& job, Listener& listener) {
  const physics::CancelScope cancelling([&listener] { return listener.cancelled(); });
  check_card(job);
  const std::string output = job.output.string();
  if (!output.empty()) check_output(output);
  const auto* strokes = std::get_if<std::filesystem::path>(&job.strokes);
  check_replaced({output}, {name_of(job.mesh, ""), strokes ? strokes->string() : ""}, listener);
  SubdivideReport report{{}, {}, {}, job.frame};
  take_noted_frame(report.frame, {name_of(job.mesh, "")});
  const Context context{report.frame, listener};
  report.mesh = read_mesh(job.mesh, context);
  stop_if_cancelled(context);
  SeamTies ties = all_ties(report.mesh, name_of(job.mesh, "the mesh"), context);
  refine(job, report, ties, context);
  if (!ties.empty()) {
    set_seam_ties(report.mesh.mesh, ties, {});
    close_seam_ties(report.mesh.mesh);
  }
  if (job.max_weights) geometry::normalize_skin_weights(report.mesh.mesh, *job.max_weights);
  stop_if_cancelled(context);
  warn_of_lost_ties(report.mesh.mesh, job.output, listener);
  if (!output.empty() && output != "-") write_mesh(job.output, report.mesh, context);
  return report;
}

std::vector<CardRow> card(SubdivideJob& job) {
  const auto steps = [&job](Refinement refinement) {
    return Whole{[&job, refinement](int n) {
      job.steps = n;
      job.refinement = refinement;
    }};
  };
  return {
      {"output", &job.output, "mesh to write: " + io::mesh_formats()},
      {"strokes", &job.strokes, "insert lines: JSON, or the l elements of an OBJ file"},
      {"all", Flag{[&job](bool is_on) {
         if (is_on) job.refinement = Refinement::everywhere;
       }},
       "insert a vertex in every face and flip every edge"},
      {"subdivide", steps(Refinement::loop), between(0, 6), "so many steps of Loop subdivision"},
      {"sqrt3", steps(Refinement::sqrt3), between(0, 6), "steps of sqrt(3) subdivision"},
      {"linear", steps(Refinement::linear), between(0, 6),
       "steps of cutting every triangle into four; the surface stays"},
      max_weights_row(job.max_weights),
      {"rule",
       choice(job.options.rule,
              {{"safe", geometry::InsertionRule::safe}, {"paper", geometry::InsertionRule::paper}}),
       "of `strokes` and `all`"},
      {"max_distance", &job.options.max_distance, positive, "how far a stroke may lie from the surface [m]"},
  };
}

Json to_json(const SubdivideReport& r) {
  Json json = Json::object();
  if (r.insertion) json = to_json(*r.insertion, *r.rest);
  json["vertices"] = r.mesh.mesh->number_of_vertices();
  json["faces"] = r.mesh.mesh->number_of_faces();
  return json;
}

}  // namespace furrow::jobs
