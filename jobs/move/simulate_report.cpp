// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "jobs/base/kept_shape.h"
#include "jobs/base/read_inputs.h"
#include "jobs/draw/wrinkle_reports.h"
#include "jobs/move/candidates.h"
#include "jobs/move/judge_report.h"
#include "jobs/move/rest_stage.h"
#include "jobs/move/simulate.h"

namespace furrow::jobs {
namespace {

using jobs::to_json;  // beside those that follow

const char* name_of(physics::Outcome outcome) {
  switch (outcome) {
    case physics::Outcome::finished:
      return "finished";
    case physics::Outcome::diverged:
      return "diverged";
    case physics::Outcome::stopped_at:
      return "stopped";
    case physics::Outcome::stopped_by_observer:
      return "interrupted";
    case physics::Outcome::blocked:
      return "blocked";
  }
  return "";
}

Json to_json(const physics::LongestEdge& e) {
  return {{"strain", e.strain}, {"time", e.time}, {"at", {e.at.x(), e.at.y(), e.at.z()}}};
}

Json to_json(const physics::SimulateReport& r) {
  return {{"outcome", name_of(r.outcome)},
          {"time", r.time},
          {"steps", r.steps},
          {"dt", r.dt},
          {"dt_limit", std::isfinite(r.dt_limit) ? Json(r.dt_limit) : Json()},
          {"seconds", r.seconds},
          {"cpu_seconds", r.cpu_seconds},
          {"force_evaluations", r.force_evaluations},
          {"spring_evaluations", r.spring_evaluations},
          {"triangle_evaluations", r.triangle_evaluations},
          {"hinge_evaluations", r.hinge_evaluations},
          {"collider_queries", r.collider_queries},
          {"linear_solves", r.linear_solves},
          {"factorisations", r.factorisations},
          {"iterations", r.iterations},
          {"steps_open", r.open_steps},
          {"strain", {{"max", r.strain.max}, {"p99", r.strain.p99}, {"mean", r.strain.mean}}},
          {"longest_edge", to_json(r.longest_edge)},
          {"kinetic_energy", r.kinetic_energy},
          {"residual_force", r.residual_force}};
}

/// Where something touches, what contact took is not told apart well from what the steps did; nor what pins
/// gave that lead cloth by backward Euler.
bool is_told(const physics::EnergyBalance& e, physics::Integrator integrator) {
  const bool touches = e.to_contact != 0 || e.by_body != 0;
  return e.seconds > 0 && !touches && (integrator == physics::Integrator::tr_bdf2 || e.by_pins == 0);
}

Json to_json(const physics::EnergyBalance& e) {
  return {
      {"seconds", e.seconds},
      {"gained", {{"kinetic", e.kinetic}, {"elastic", e.elastic}, {"weight", e.weight}}},
      {"given",
       {{"air", e.by_air}, {"body", e.by_body}, {"pins", e.by_pins}, {"compensation", e.by_compensation}}},
      {"lost", {{"air", e.to_air}, {"contact", e.to_contact}, {"steps", e.to_steps()}}}};
}

Json to_json(const ReachedShape& shape, const physics::SimulateReport& run) {
  Json json{{"centre", {shape.centre.x(), shape.centre.y(), shape.centre.z()}}};
  if (shape.contact) {
    json["contact_gap"] = shape.contact->gap;
    json["contacts"] = run.contacts;
    json["vertices_inside"] = shape.contact->inside.inside;
    json["deepest_penetration"] = shape.contact->inside.deepest;
    json["truncated_moves"] = run.truncated_moves;
    if (run.frames_built) json["body_frames"] = {{"built", run.frames_built}, {"seconds", run.frame_seconds}};
  }
  if (run.self.on)
    json["self_contact"] = {{"pairs", run.self.pairs},
                            {"nearest", run.self.pairs > 0 ? Json(run.self.nearest) : Json()},
                            {"crossed_at_start", run.self.crossed_at_start},
                            {"exempt", run.self.exempt},
                            {"cut_moves", run.cut_moves}};
  json["self_intersections"] = shape.crossings.pairs;
  json["crossings"] = jobs::to_json(shape.crossings);
  json["end"] = jobs::to_json(shape.end);
  json["borders"] = to_json(shape.borders);
  json["lines"] = to_json(shape.lines);
  return json;
}

Json to_json(const AnimationReport& r) {
  return {{"file", r.file.string()}, {"start", r.start}, {"fps", r.fps}, {"frames", r.frames}};
}

Json times_json(const physics::WorkTimes& times) {
  Json json = Json::object();
  const double total = std::accumulate(times.begin(), times.end(), 0.0);
  for (std::size_t i = 0; i < times.size(); ++i)
    json[name_of(physics::WorkPart(i))] = {{"seconds", times[i]},
                                           {"share", total > 0 ? times[i] / total : 0.0}};
  return json;
}

}  // namespace

std::string SimulateReport::outcome() const {
  const bool rests = rest && run.steps == 0 && run.outcome == physics::Outcome::finished;
  std::string words = rests ? (rest->settle.converged ? "at rest" : "not at rest") : name_of(run.outcome);
  for (const Fault& fault : faults)
    if (fault.word != words)
      words = fault.word == "torn" && run.outcome == physics::Outcome::finished ? "torn"
                                                                                : words + ", " + fault.word;
  return words;
}

Json to_json(const SimulateReport& r) {
  Json json = Json::object();
  if (!r.title.empty()) json["title"] = r.title;
  json.update(to_json(r.run));
  json["outcome"] = r.outcome();
  json["integrator"] = name_of(r.integrator);
  if (r.steps)
    json["chosen_steps"] = {{"leapfrog_seconds", r.steps->leapfrog}, {"implicit_seconds", r.steps->implicit}};
  if (r.energy)
    json["energy"] = {{"kinetic", r.run.kinetic_energy},
                      {"stretch", r.energy->stretch},
                      {"bending", r.energy->bending},
                      {"ties", r.energy->ties},
                      {"weight", r.energy->weight}};
  if (r.energy && is_told(r.run.energy, r.integrator)) json["balance"] = to_json(r.run.energy);
  if (!std::isfinite(r.run.dt_limit)) json["dt_limit_why"] = "steps of any length are stable";
  if (r.shape) json.update(to_json(*r.shape, r.run));
  if (r.kept) json["kept"] = to_json(*r.kept);
  if (r.rest) json["at_rest"] = to_json(*r.rest);
  for (const DrawnRound& round : r.rounds) json["rounds"].push_back(to_json(round));
  for (const AnimationReport& animation : r.animations) json["animations"].push_back(to_json(animation));
  if (r.choice) json["choice"] = to_json(*r.choice, r.scene_dt);
  if (r.run.outcome == physics::Outcome::blocked)
    json["blocked_at"] = {r.run.blocked_at.x(), r.run.blocked_at.y(), r.run.blocked_at.z()};
  if (r.times) json["times"] = times_json(*r.times);
  return json;
}

}  // namespace furrow::jobs
