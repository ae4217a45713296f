// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/fit.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "io/base/figure_path.h"
#include "jobs/base/card.h"
#include "jobs/base/gate.h"
#include "jobs/base/measure_crossings.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "jobs/body/world_body.h"
#include "jobs/rest/fit_picture.h"
#include "physics/base/cancel_scope.h"

namespace furrow::jobs {
namespace {

NamedNumbers section_list(bridge::SectionHeights& heights) {
  return {"section", "height", "write a section and its height [m]: `section=chest=1.25`",
          [&heights](const std::string& name, double height) {
            if (name != "chest" && name != "waist" && name != "hip")
              throw std::invalid_argument("'" + name + "' is none of chest, waist and hip");
            (name == "chest" ? heights.chest : name == "waist" ? heights.waist : heights.hip) = height;
          }};
}

void check(const FitJob& job, Listener& listener) {
  if (job.worn.empty()) throw std::invalid_argument("fit: there is no garment");
  if (job.bodies.empty() || (job.bodies.size() > 1 && job.bodies.size() != job.worn.size()))
    throw std::invalid_argument("`body`: " + std::to_string(job.bodies.size()) + " bodies for " +
                                std::to_string(job.worn.size()) + " garments; give one, or one for each");
  const std::string output = job.output.string();
  if (!output.empty() && job.worn.size() > 1)
    throw std::invalid_argument("`output` writes one garment, not those of `compare`");
  if (job.rest && job.worn.size() > 1) throw std::invalid_argument("`rest_shape` is that of one garment");
  if (job.body_unit && !is_unit(*job.body_unit))
    throw std::invalid_argument("`body_unit`: '" + *job.body_unit + "' is not m, cm, mm or inch");
  check_card(job);
  if (!output.empty()) check_output(output);
  std::vector<std::string> outputs{output}, inputs = job.more_inputs;
  outputs.insert(outputs.end(), job.more_outputs.begin(), job.more_outputs.end());
  for (const MeshInput& input : job.worn) inputs.push_back(name_of(input, ""));
  for (const MeshInput& input : job.bodies) inputs.push_back(name_of(input, ""));
  if (job.rest) inputs.push_back(name_of(*job.rest, ""));
  check_replaced(outputs, inputs, listener);
}

/// Rest lengths as the edges are long in a mesh with the same vertices.
void take_rest(geometry::Mesh& mesh, const FitJob& job, const Context& context) {
  const io::MeshFile rest = read_mesh(*job.rest, context);
  if (rest.mesh->num_vertices() != mesh.num_vertices())
    throw geometry::ContentError(name_of(*job.rest, "the rest") + ": has " +
                                 std::to_string(rest.mesh->num_vertices()) + " vertices, but " +
                                 name_of(job.worn[0], "the garment") + " has " +
                                 std::to_string(mesh.num_vertices()));
  auto lengths = geometry::ensure_map(mesh, geometry::attribute::rest_length);
  for (geometry::Edge e : mesh.edges())
    lengths[e] = std::sqrt(
        CGAL::squared_distance(rest.mesh->point(mesh.vertex(e, 0)), rest.mesh->point(mesh.vertex(e, 1))));
}

struct Body {
  physics::TriangleMesh triangles;
  physics::ExactDistance distance;
  BodyOutline outline;
};

Body read_wearer(const MeshInput& input, const FitJob& job, const Context& context) {
  BodyOutline outline;
  physics::TriangleMesh triangles =
      read_body(input, {with_unit(context.frame, job.body_unit), context.listener, context.memory}, &outline);
  physics::ExactDistance distance(triangles);
  return {std::move(triangles), std::move(distance), outline};
}

FittedGarment measure(const MeshInput& worn, const Body& body, const FitJob& job, const Context& context) {
  const std::string path = name_of(worn, "garment");
  FittedGarment fitted{path, io::stem_of(path), read_garment(worn, context), {}, job.options, {}};
  geometry::Mesh& mesh = fitted.garment.mesh;
  heed(faults_of_pair(mesh, body.outline, job.body_unit.has_value()), path, context);
  if (job.rest) take_rest(mesh, job, context);
  if (mesh.number_of_edges() > 0)
    fitted.options.contact_distance =
        job.contact ? *job.contact : contact_distance(fitted.garment, body.distance);
  fitted.report = bridge::fit_report(mesh, body.triangles, body.distance, fitted.options);
  fitted.crossings = measure_crossings(fitted.garment);
  if (fitted.crossings.pairs) context.warn("cloth_crosses", path + ": " + words(fitted.crossings), path);
  if (!fitted.report.strain)
    context.warn(
        "strain_unknown",
        path +
            ": has no rest lengths, so its strain is not known; `rest_shape` takes the garment as it was "
            "made" +
            (job.worn.size() > 1 ? " (a second body needs a `body` of its own)" : ""),
        path, "rest");
  if (fitted.report.ease.empty())
    context.warn("sections_not_found",
                 "no chest, waist and hips were found on the body; `section=chest=1.25` tells their heights",
                 "", "sections");
  return fitted;
}

/// The quantity that is asked for, or strain where all garments know theirs.
FitColour shown_colour(const std::vector<FittedGarment>& all, const std::optional<FitColour>& wanted) {
  const auto without =
      std::find_if(all.begin(), all.end(), [](const FittedGarment& f) { return !f.report.strain; });
  if (wanted == FitColour::strain && without != all.end())
    throw geometry::ContentError(without->name +
                                 ": has no rest lengths, so no strain can be shown; give `rest_shape`, or "
                                 "`colour=distance`");
  return wanted == FitColour::distance || without != all.end() ? FitColour::distance : FitColour::strain;
}

Json to_json(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json to_json(const std::vector<bridge::FitZone>& zones) {
  Json rows = Json::array();
  for (const bridge::FitZone& z : zones)
    rows.push_back({{"side", z.side},
                    {"height_share", z.height_share},
                    {"area", z.area},
                    {"peak", z.peak},
                    {"x", z.centre.x()},
                    {"y", z.centre.y()},
                    {"z", z.centre.z()}});
  return rows;
}

Json to_json(const std::vector<bridge::FitEase>& list) {
  Json rows = Json::array();
  for (const bridge::FitEase& e : list) {
    rows.push_back({{"section", e.name},
                    {"height", e.height},
                    {"garment_height", to_json(e.garment_height)},
                    {"body_girth", to_json(e.body_girth)},
                    {"garment_girth", to_json(e.garment_girth)},
                    {"ease", to_json(e.ease)},
                    {"rest_girth", to_json(e.rest_girth)},
                    {"rest_ease", to_json(e.rest_ease)},
                    {"note", e.note}});
  }
  return rows;
}

}  // namespace

FitJobReport fit(const FitJob& job, Listener& listener) {
  check(job, listener);
  const physics::CancelScope cancelling([&listener] { return listener.cancelled(); });
  FitJobReport report;
  report.frame = job.frame;
  std::vector<std::string> names;
  for (const MeshInput& input : job.worn) names.push_back(name_of(input, ""));
  take_noted_frame(report.frame, names);
  const Context context{report.frame, listener};
  std::vector<Body> bodies;
  for (const MeshInput& input : job.bodies) bodies.push_back(read_wearer(input, job, context));
  for (std::size_t i = 0; i < job.worn.size(); ++i) {
    stop_if_cancelled(context);
    report.garments.push_back(measure(job.worn[i], bodies[bodies.size() > 1 ? i : 0], job, context));
  }
  report.shown = shown_colour(report.garments, job.colour);
  const io::FitScale scale = fit_scale(report.shown, job.options, job.range);
  for (FittedGarment& fitted : report.garments) colour_garment(fitted.garment.mesh, scale);
  stop_if_cancelled(context);
  if (!job.output.empty() && job.output != "-") write_mesh(job.output, report.garments[0].garment, context);
  return report;
}

Json to_json(const bridge::FitReport& r, const bridge::FitOptions& o) {
  Json json{{"area", r.area}, {"body_height", r.on_body ? Json(r.body_high - r.body_low) : Json(nullptr)}};
  if (r.strain)
    json["strain"] = {{"share_over", r.strain->share_over},
                      {"over", o.tight_strain},
                      {"p50", r.strain->p50},
                      {"p99", r.strain->p99},
                      {"max", r.strain->max},
                      {"unknown_faces", r.strain->unknown_faces}};
  else
    json["strain"] = nullptr;
  json["distance"] = nullptr;
  if (r.on_body)
    json["distance"] = {{"min", r.distance.min},
                        {"median", r.distance.median},
                        {"p95", r.distance.p95},
                        {"share_in_contact", r.distance.share_in_contact},
                        {"contact", o.contact_distance},
                        {"vertices_inside", r.distance.vertices_inside},
                        {"pierced_faces", r.piercing.faces},
                        {"deepest_penetration", r.distance.deepest_penetration}};
  if (!r.piercing.corners.empty()) json["distance"]["pierced_corners"] = r.piercing.corners;
  json["ease"] = to_json(r.ease);
  json["tight_zones"] = to_json(r.tight);
  json["loose_zones"] = to_json(r.loose);
  json["pierced_zones"] = to_json(r.piercing.zones);
  json["loose_over"] = o.loose_distance;
  json["zones_left_out"] = r.left_out;
  return json;
}

std::vector<CardRow> card(FitJob& job) {
  bridge::FitOptions& o = job.options;
  return {
      {"body", &job.bodies,
       "the body that wears it, as it stands there; of several garments one, or one for each, in their "
       "order"},
      {"body_unit", unit_choice(job.body_unit), "unit of the bodies' files, where it is not the garments'"},
      {"rest_shape", &job.rest,
       "the garment as it was made, with the same vertices, where the worn one has no rest lengths"},
      {"output", &job.output,
       "mesh to write with colours; PLY keeps the columns fit_distance [m] and strain [-], too"},
      {"colour", choice(job.colour, {{"strain", FitColour::strain}, {"distance", FitColour::distance}}),
       "of the cloth; default strain, where it is known"},
      {"range", &job.range, positive,
       "where the colours end: strain [-] or distance [m]; default 2 x `tight`, 1.2 x `loose`"},
      {"tight", &o.tight_strain, positive, "cloth strained more is tight [-]"},
      {"loose", &o.loose_distance, positive, "cloth farther from the body is loose [m]"},
      {"contact", &job.contact, not_negative,
       "cloth nearer lies on the body [m]; default 1.2 times the gap that the garment kept, or would keep"},
      {"smallest_zone", &o.smallest_zone, not_negative, "zones with less area are left out [m^2]"},
      {"section", section_list(o.sections),
       "heights of sections in place of what is found on the body [m]: chest=1.25; chest, waist or hip"},
  };
}

Json to_json(const FitJobReport& report) {
  const std::vector<FittedGarment>& all = report.garments;
  const auto one = [](const FittedGarment& fitted) {
    Json json = to_json(fitted.report, fitted.options);
    json["crossings"] = to_json(fitted.crossings);
    return json;
  };
  if (all.size() == 1) return one(all[0]);
  Json garments = Json::array();
  for (const FittedGarment& fitted : all) {
    garments.push_back({{"garment", fitted.path}});
    garments.back().update(one(fitted));
  }
  return {{"garments", garments}};
}

}  // namespace furrow::jobs
