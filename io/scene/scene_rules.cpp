// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_rules.h"

#include <algorithm>

#include "geometry/mesh/errors.h"

namespace furrow::io {

namespace {

/// The first setting that asks for it, from round `first` on and, if `garment`, of the garment; or "".
std::string path_of_keep(const Scene& scene, bool garment, std::size_t first) {
  if (garment && scene.keep) return "garment.rest";
  for (std::size_t i = first; i < scene.lines.size(); ++i)
    if (scene.lines[i].keep) return "lines." + std::to_string(i) + ".rest";
  return "";
}

/// All of a fabric's threads, and nothing that is said of cloth without.
void check_threads(SettingsTable& table, const SceneMaterial& m) {
  const std::pair<const char*, bool> needed[] = {
      {"warp_stretch", m.warp_stretch.has_value()},   {"weft_stretch", m.weft_stretch.has_value()},
      {"thread_shear", m.thread_shear.has_value()},   {"warp_rigidity", m.warp_rigidity.has_value()},
      {"weft_rigidity", m.weft_rigidity.has_value()}, {"bias_rigidity", m.bias_rigidity.has_value()}};
  const auto has = [](const auto& setting) { return setting.second; };
  if (!std::any_of(std::begin(needed), std::end(needed), has)) return;
  for (const auto& [key, known] : needed)
    if (!known)
      table.fail(key,
                 "is missing: cloth with threads has all of warp_stretch, weft_stretch, "
                 "thread_shear, warp_rigidity, weft_rigidity and bias_rigidity");
  if (!m.is_woven()) return;
  for (const char* key : {"stretch", "stiffness", "rigidity"})
    if (table.has(key))
      table.fail(key,
                 "is of cloth that is the same in all directions, and this has threads: leave it out, or "
                 "say warp = \"none\" (`warp=none`)");
}

[[noreturn]] void fail(const TomlDocument& document, const std::string& path, const std::string& what) {
  throw geometry::ContentError(document.place(path) + ": " + path + " = \"keep\" " + what);
}

}  // namespace

std::vector<std::string> options_without_use(geometry::InsertionRule rule) {
  if (rule == geometry::InsertionRule::fold)
    return {"iterations", "weights", "keep_lines", "keep_border", "region"};
  return {"detail", "fold_iterations", "flat_base"};
}

void check_lines(SettingsTable& table, const Scene& scene) {
  const SceneLines& lines = scene.lines.back();
  if (lines.strokes.empty()) table.fail("strokes", "is missing: name a stroke file");
  if (scene.lines.size() > 1 && lines.time < scene.lines[scene.lines.size() - 2].time)
    table.fail("time", "is before that of the lines above; write rounds of lines in their order");
  const geometry::InsertionRule rule = lines.options.insertion.rule;
  for (const std::string& key : options_without_use(rule))
    if (table.has(key.c_str()))
      table.fail(key,
                 rule == geometry::InsertionRule::fold
                     ? "goes with rule = \"safe\" or \"paper\", which this round does not name; the rule "
                       "fold has fold_iterations"
                     : "goes with rule = \"fold\"");
}

void check_body(SettingsTable& table, const Scene& scene) {
  const SceneBody& body = *scene.body;
  const bool says_field = table.has("tolerance") || table.has("gradient");
  if (body.mesh.empty()) table.fail("mesh", "is missing: name the body's mesh");
  if (body.depth_maps && body.frames.empty())
    table.fail("collider", "is for frames: a rigid body's field is built once, and right everywhere");
  if (!body.frames.empty() && says_field)
    table.fail("frames",
               "have no tolerance and no gradient: no field is made of them; leave out those settings");
  if (!body.frames.empty() && !physics::at_rest(body.motion))
    table.fail("frames", "move the body already; leave out its motion");
}

void check_material(SettingsTable& table, const Scene& scene) {
  if (scene.material.poisson == 1) table.fail("poisson", "must be below 1");
  if (table.has("stretch") && table.has("stiffness"))
    table.fail("stretch", "stands in place of stiffness; leave out one");
  check_threads(table, scene.material);
}

void check_pins(SettingsTable& table, const Scene& scene) {
  const ScenePins& pins = scene.pins.back();
  if (pins.box.empty() && pins.loop.empty() && pins.group.empty() && pins.vertices.empty())
    table.fail("loop", "is missing: say which vertices with box, loop, group or vertices");
}

void check_simulation(SettingsTable& table, const Scene& scene) {
  if (scene.simulation.step_rule == physics::StepRule::forced && !scene.simulation.dt)
    table.fail("force_dt", "needs dt");
}

void check_settle(const Scene& scene, const TomlDocument& document) {
  if (!scene.output.settled.empty() && !scene.settle)
    throw geometry::ContentError(document.place("output.settled") +
                                 ": output.settled needs settle in [simulation] (`settle`)");
  if (scene.settle && !scene.body && scene.pins.empty())
    throw geometry::ContentError(
        document.place("simulation.settle") +
        ": simulation.settle needs what the garment rests on or hangs from: name a "
        "body (`body`), or pins (`pin_loop`, `pin_group`, `pin_box`, `pin_vertices`)");
}

void check_keep(const Scene& scene, const TomlDocument& document) {
  const std::string path = path_of_keep(scene, true, 0);
  if (!path.empty() && scene.material.bending_law == bridge::Bending::cross)
    fail(document, path,
         "needs hinges, for springs cannot tell a ridge from a valley: name a fabric (`fabric`, "
         "material.preset), or bending_law = \"hinge\" and a rigidity");
}

void check_keep_stands_still(const Scene& scene, const TomlDocument& document, int lines_drawn) {
  const std::string path =
      path_of_keep(scene, lines_drawn < 0, static_cast<std::size_t>(std::max(0, lines_drawn)));
  const bool body_moves =
      scene.body && (!scene.body->frames.empty() || !physics::at_rest(scene.body->motion));
  const bool pins_move = std::any_of(scene.pins.begin(), scene.pins.end(),
                                     [](const ScenePins& p) { return !physics::at_rest(p.motion); });
  if (!path.empty() && (body_moves || pins_move))
    fail(document, path, "needs a body and pins that stand still; move them afterwards, from a saved state");
}

}  // namespace furrow::io
