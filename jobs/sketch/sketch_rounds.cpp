// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sketch/sketch_rounds.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace furrow::jobs {
namespace {

constexpr const char* strokes_name = "the drawing";  // in memory, in place of a file

/// A round of these strokes, under the options of the sketch's own round.
Json round_of(const Sketch& sketch, double time) {
  Json round = Json::object();
  for (const Json& other : sketch.scene.settings.root->value("lines", Json::array()))
    if (other.value("time", 0.0) == 0) round = other;
  round.erase("without");
  round["time"] = time;
  round["strokes"] = strokes_name;
  return round;
}

}  // namespace

void add_round(const Sketch& sketch, const Json& strokes, double time, Json rounds, SceneInput& scene) {
  if (!strokes.empty()) {
    rounds.push_back(round_of(sketch, time));
    scene.memory.strokes[scene.folder / strokes_name] =
        io::drawn_strokes_from(Json{{"strokes", strokes}}.dump(), strokes_name);
  }
  scene.settings.root["lines"] = std::move(rounds);
}

}  // namespace furrow::jobs
