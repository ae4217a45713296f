// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_file.h"

#include <nlohmann/json.hpp>

#include "io/scene/fabrics.h"
#include "io/scene/scene_rules.h"
#include "io/scene/settings_schema.h"

namespace furrow::io {
namespace {

/// Of a fabric that has them.
void take_threads(SettingsTable& table, const Fabric& fabric, Scene& scene) {
  SceneMaterial& m = scene.material;
  read_setting(table, "material.warp", scene);
  if (!fabric.threads.any()) return;
  const FabricThreads& t = fabric.threads;
  m.warp_stretch = t.warp, m.weft_stretch = t.weft, m.thread_shear = t.shear, m.thread_poisson = t.poisson;
  m.warp_rigidity = t.bend_warp, m.weft_rigidity = t.bend_weft, m.bias_rigidity = t.bend_bias;
}

/// A fabric is a plate in SI units: what the file says beside it is read later, and goes before it.
void take_fabric(SettingsTable& table, Scene& scene) {
  SceneMaterial& m = scene.material;
  read_setting(table, "material.preset", scene);
  if (m.preset.empty()) return;
  const Fabric& fabric = fabric_named(m.preset);
  m.density = fabric.density;
  m.membrane = bridge::Membrane::triangles;
  m.bending_law = bridge::Bending::plate;
  take_threads(table, fabric, scene);
  if (!table.has("stiffness")) m.stretch = fabric.stretch;
  m.rigidity = fabric.rigidity;
  m.shear = shear_ratio(fabric);
  scene.simulation.spring_damping = fabric.damping;
  scene.simulation.friction = fabric.friction;
}

using Begin = void (*)(SettingsTable&, Scene&);
using Check = void (*)(SettingsTable&, const Scene&);

/// One table, or each of a list: `begin` makes what is read into, `check` holds what its settings need of
/// each other.
struct Part {
  const char* name;
  bool is_list = false;
  Begin begin = [](SettingsTable&, Scene&) {};
  Check check = [](SettingsTable&, const Scene&) {};
};

const Part parts[] = {{"garment"},
                      {"lines", true, [](SettingsTable&, Scene& s) { s.lines.emplace_back(); }, check_lines},
                      {"body", false, [](SettingsTable&, Scene& s) { s.body.emplace(); }, check_body},
                      {"material", false, take_fabric, check_material},
                      {"pins", true, [](SettingsTable&, Scene& s) { s.pins.emplace_back(); }, check_pins},
                      {"forces"},
                      {.name = "simulation", .check = check_simulation},
                      {"output"}};

void read_part(SettingsTable& table, const Part& part, Scene& scene) {
  part.begin(table, scene);
  read_settings(table, part.name, scene);
  part.check(table, scene);
  table.finish();
}

}  // namespace

Scene read_scene(const TomlDocument& document, const std::filesystem::path& folder) {
  Scene scene;
  SettingsTable root(document, folder);
  read_settings(root, "", scene);
  for (const Part& part : parts) {
    if (part.is_list)
      for (SettingsTable& table : root.tables(part.name)) read_part(table, part, scene);
    else if (auto table = root.table(part.name))
      read_part(*table, part, scene);
  }
  root.finish();
  // Folds that a body presses through each other do not iron out again.
  const Json given = document.root->value("simulation", Json::object());
  if (scene.body && !scene.body->frames.empty() && !given.contains("self_contact"))
    scene.simulation.self.on = true;
  if (scene.integrator) scene.simulation.integrator = *scene.integrator;
  check_settle(scene, document);
  check_keep(scene, document);
  return scene;
}

}  // namespace furrow::io
