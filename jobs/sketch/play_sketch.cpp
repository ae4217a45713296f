// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sketch/play_sketch.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "bridge/arrays/convert.h"
#include "jobs/base/read_inputs.h"
#include "jobs/body/body_places.h"
#include "jobs/sketch/sketch_rounds.h"

namespace furrow::jobs {
namespace {

constexpr double rounding = 1e-6;  // of a sum of steps [s]

Json rounds_drawn(const io::SavedState& state) {
  Json rounds = state.scene->value("lines", Json::array());
  while (rounds.size() > std::size_t(state.lines_drawn)) rounds.erase(rounds.size() - 1);
  return rounds;
}

std::vector<float> floats(std::span<const physics::Vec3> x) {
  std::vector<float> list;
  list.reserve(3 * x.size());
  for (const physics::Vec3& p : x)
    for (int k = 0; k < 3; ++k) list.push_back(static_cast<float>(p[k]));
  return list;
}

/// None: there is no body, or it does not move.
std::optional<BodyPlaces> places_of(const Sketch& sketch) {
  const io::Scene scene = scene_of(sketch.scene.settings, sketch.scene.folder);
  if (!scene.body || !sketch.body) return std::nullopt;
  std::optional<BodyPlaces> places;
  places.emplace(*scene.body, bridge::positions_of(sketch.body->mesh), sketch.frame);
  if (!places->moves()) places.reset();
  return places;
}

}  // namespace

std::vector<float> body_at(const Sketch& sketch, double time) {
  const std::optional<BodyPlaces> places = places_of(sketch);
  return places ? places->at(time) : std::vector<float>{};
}

PlayedSketch play_sketch(const Sketch& sketch, const Json& strokes, const PlayRequest& request,
                         Listener& listener) {
  if (!(request.seconds > 0)) throw std::invalid_argument("play: the seconds must be > 0");
  SimulateJob job;
  job.scene = sketch.scene;
  job.scene.settings.root->erase("output");
  double time = 0;
  Json rounds = Json::array();
  if (request.state) {
    job.state = io::read_state(*request.state);
    job.state_path = *request.state;
    time = job.state->simulation.time;
    rounds = rounds_drawn(*job.state);
    if (job.scene.settings.root->contains("garment")) job.scene.settings.root["garment"].erase("subdivide");
  }
  add_round(sketch, strokes, time, std::move(rounds), job.scene);
  if (time >= longest_play)
    throw std::invalid_argument("the cloth has moved for 600 s, which is all it can; drape it to begin anew");
  io::set_value(job.scene.settings, "simulation.seconds", longest_play, "the studio");  // so that all plays
  if (time + request.seconds < longest_play)                                            // have one step
    io::set_value(job.scene.settings, "simulation.stop_at", time + request.seconds - rounding, "the studio");
  io::set_value(job.scene.settings, "output.state", std::filesystem::absolute(request.new_state).string(),
                "the studio");
  job.outputs_below = request.new_state.parent_path();
  const std::optional<BodyPlaces> body = request.watch_body ? places_of(sketch) : std::nullopt;
  job.hand = request.hand;
  job.watch = [&](double now, std::span<const physics::Vec3> x) {
    if (body) request.watch_body(body->at(now));
    if (request.watch) request.watch(now, floats(x));
  };
  SimulateReport report = simulate(job, listener);
  if (!report.failure.empty()) throw std::runtime_error(report.failure);
  PlayedSketch played{std::move(report.garment), report.run.time, {}};
  for (const Fault& fault : report.faults) played.remarks.push_back(fault.told.text);
  return played;
}

}  // namespace furrow::jobs
