// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/body/body.h"

#include <nlohmann/json.hpp>

#include "geometry/figure/repair_body.h"
#include "geometry/mesh/self_intersections.h"
#include "jobs/base/card.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "physics/base/cancel_scope.h"

namespace furrow::jobs {
namespace {

Json measures_json(const geometry::BodyMeasures& m) {
  Json json = Json::object();
  const auto add = [&](const char* name, double value) {
    json[name] = value > 0 ? Json(value) : Json(nullptr);
  };
  add("height", m.height), add("chest", m.chest), add("waist", m.waist), add("hip", m.hip);
  return json;
}

constexpr Range of_height{0.9, 2.5, false, false, true}, of_girth{0.3, 3, false, false, true};

}  // namespace

BodyReport shape_body(const BodyJob& job, Listener& listener) {
  const physics::CancelScope cancelling([&listener] { return listener.cancelled(); });
  check_card(job);
  if (!job.output.empty()) check_output(job.output.string());
  check_replaced({job.output.string()}, {name_of(job.mesh, "")}, listener);
  BodyReport report{{}, job.measures, {}, 0, job.frame};
  take_noted_frame(report.frame, {name_of(job.mesh, "")});
  const Context context{report.frame, listener};
  report.mesh = read_mesh(job.mesh, context);
  stop_if_cancelled(context);
  geometry::Mesh& mesh = report.mesh.mesh;
  if (!job.measures.any()) {
    const geometry::Body body = geometry::repair_body(mesh);
    report.shape.before = report.shape.reached = geometry::measure_body(body.points, body.triangles);
  } else {
    const auto before = int(geometry::count_self_intersections(mesh));
    report.shape = geometry::shape_body(mesh, job.measures);
    report.new_crossings = int(geometry::count_self_intersections(mesh)) - before;
  }
  stop_if_cancelled(context);
  if (!job.output.empty() && job.output != "-") write_mesh(job.output, report.mesh, context);
  return report;
}

std::vector<CardRow> card(BodyJob& job) {
  return {
      {"output", &job.output, "mesh to write: " + io::mesh_formats()},
      {"height", &job.measures.height, of_height, "from floor to crown [m]"},
      {"chest", &job.measures.chest, of_girth, "around the fullest of the chest, under the armpits [m]"},
      {"waist", &job.measures.waist, of_girth, "around the narrowest [m]"},
      {"hip", &job.measures.hip, of_girth, "around the fullest of the seat [m]"},
  };
}

Json to_json(const BodyReport& r) {
  return {{"vertices", r.mesh.mesh->number_of_vertices()},
          {"asked", measures_json(r.asked)},
          {"before", measures_json(r.shape.before)},
          {"reached", measures_json(r.shape.reached)},
          {"farthest", r.shape.farthest},
          {"rounds", r.shape.rounds},
          {"new_crossings", r.new_crossings}};
}

}  // namespace furrow::jobs
