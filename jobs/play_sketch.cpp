// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/play_sketch.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "io/scene/relocated.h"

namespace furrow::jobs {
namespace {

constexpr double rounding = 1e-6;                    // of a sum of steps [s]
constexpr const char* strokes_name = "the drawing";  // in memory, in place of a file

/// A round of these strokes, under the options of the sketch's own round.
Json round_of(const Sketch& sketch, double time) {
  Json round = Json::object();
  for (const Json& other : sketch.scene.settings.root.value("lines", Json::array()))
    if (other.value("time", 0.0) == 0) round = other;
  round.erase("without");
  round["time"] = time;
  round["strokes"] = strokes_name;
  return round;
}

/// Adds the strokes to the rounds that are in the garment already.
void add_strokes(const Sketch& sketch, const Json& strokes, double time, Json rounds, SceneInput& scene) {
  if (!strokes.empty()) {
    rounds.push_back(round_of(sketch, time));
    scene.memory.strokes[(scene.folder / strokes_name).string()] =
        io::drawn_strokes_from(Json{{"strokes", strokes}}.dump(), strokes_name);
  }
  scene.settings.root["lines"] = std::move(rounds);
}

Json rounds_drawn(const io::SavedState& state) {
  Json rounds = state.scene.value("lines", Json::array());
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

}  // namespace

PlayedSketch play_sketch(const Sketch& sketch, const Json& strokes, const PlayRequest& request,
                         Listener& listener) {
  if (!(request.seconds > 0)) throw std::invalid_argument("play: the seconds must be > 0");
  SimulateJob job;
  job.scene = sketch.scene;
  job.scene.settings.root.erase("output");
  double time = 0;
  Json rounds = Json::array();
  if (request.state) {
    job.state = io::read_state(*request.state);
    job.state_path = *request.state;
    time = job.state->simulation.time;
    rounds = rounds_drawn(*job.state);
    if (job.scene.settings.root.contains("garment")) job.scene.settings.root["garment"].erase("subdivide");
  }
  add_strokes(sketch, strokes, time, std::move(rounds), job.scene);
  if (time >= longest_play)
    throw std::invalid_argument("the cloth has moved for 600 s, which is all it can; drape it to begin anew");
  io::set_value(job.scene.settings, "simulation.seconds", longest_play, "the studio");  // so that all plays
  if (time + request.seconds < longest_play)                                            // have one step
    io::set_value(job.scene.settings, "simulation.stop_at", time + request.seconds - rounding, "the studio");
  io::set_value(job.scene.settings, "output.state", std::filesystem::absolute(request.new_state).string(),
                "the studio");
  job.outputs_below = request.new_state.parent_path();
  if (request.watch)
    job.watch = [&](double now, std::span<const physics::Vec3> x) { request.watch(now, floats(x)); };
  SimulateReport report = simulate(job, listener);
  if (!report.failure.empty()) throw std::runtime_error(report.failure);
  PlayedSketch played{std::move(report.garment), report.run.time, {}};
  for (const Fault& fault : report.faults) played.remarks.push_back(fault.told.text);
  return played;
}

}  // namespace furrow::jobs
