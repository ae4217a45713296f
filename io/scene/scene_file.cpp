// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_file.h"

#include <algorithm>
#include <cmath>

#include "io/scene/check_keep.h"
#include "io/scene/fabrics.h"
#include "io/scene/motion_settings.h"
#include "io/scene/settings_table.h"
#include "io/scene/wrinkle_settings.h"

namespace furrow::io {
namespace {

class SceneReader {
 public:
  SceneReader(const TomlDocument& document, std::filesystem::path folder)
      : document_(document), folder_(std::move(folder)) {}

  Scene read() {
    SettingsTable root(document_);
    root.read("title", scene_.title);
    root.choose("unit", scene_.unit, words({"m", "cm", "mm", "inch"}));
    root.choose("up", scene_.up, words({"y", "z"}));
    read_garment(root);
    read_lines(root);
    if (auto body = root.table("body")) read_body(*body);
    if (auto material = root.table("material")) read_material(*material);
    for (SettingsTable& pins : root.tables("pins")) read_pins(pins);
    if (auto forces = root.table("forces")) read_forces(*forces);
    if (auto simulation = root.table("simulation")) read_simulation(*simulation);
    if (auto output = root.table("output")) read_output(*output);
    root.finish();
    check_keep(scene_, document_);
    return std::move(scene_);
  }

 private:
  static std::vector<std::pair<std::string, std::optional<std::string>>> words(
      std::initializer_list<const char*> list) {
    std::vector<std::pair<std::string, std::optional<std::string>>> pairs;
    for (const char* word : list) pairs.emplace_back(word, word);
    return pairs;
  }

  void read_path(SettingsTable& table, const char* key, std::filesystem::path& path) {
    std::string text;
    table.read(key, text);
    if (text.empty()) return;
    const bool from_file = document_.is_of_file(table.path_of(key));
    path = from_file && text != "-" ? (folder_ / text).lexically_normal() : std::filesystem::path(text);
  }

  void read_garment(SettingsTable& root) {
    auto garment = root.table("garment");
    if (!garment) return;
    read_path(*garment, "mesh", scene_.garment);
    garment->read("subdivide", scene_.subdivide, 0, 4);
    garment->choose<bool>("rest", scene_.keep, {{"stored", false}, {"keep", true}});
    garment->finish();
  }

  void read_lines(SettingsTable& root) {
    for (SettingsTable& table : root.tables("lines")) {
      SceneLines lines;
      read_path(table, "strokes", lines.strokes);
      if (lines.strokes.empty()) table.fail("strokes", "is missing: name a stroke file");
      table.read("time", lines.time, not_negative("s"));
      table.read("height", lines.height, any("m"));
      table.read("fade", lines.fade, {0, no_limit, true, "s", true});
      table.read("without", lines.without);
      read_wrinkle_options(table, lines);
      table.finish();
      if (!scene_.lines.empty() && lines.time < scene_.lines.back().time)
        table.fail("time", "is before that of the lines above; write rounds of lines in their order");
      scene_.lines.push_back(std::move(lines));
    }
  }

  void read_body(SettingsTable& table) {
    SceneBody& body = scene_.body.emplace();
    read_path(table, "mesh", body.mesh);
    read_path(table, "field", body.field);
    read_path(table, "frames", body.frames);
    if (body.mesh.empty()) table.fail("mesh", "is missing: name the body's mesh");
    table.read("fps", body.fps, positive("1/s"));
    table.read("tolerance", body.options.tolerance, positive("m"));
    table.choose<physics::GradientRule>("gradient", body.options.gradient,
                                        {{"exact", physics::GradientRule::exact_derivative},
                                         {"interpolated", physics::GradientRule::interpolated_corners}});
    if (!body.field.empty() && (table.has("tolerance") || table.has("gradient")))
      table.fail("field", "has its own tolerance and gradient; leave those settings away");
    table.choose<bool>("collider", body.depth_maps, {{"field", false}, {"depth-maps", true}});
    if (body.depth_maps && body.frames.empty())
      table.fail("collider", "is for frames: a rigid body's field is built once, and right everywhere");
    if (body.depth_maps && (table.has("tolerance") || table.has("gradient")))
      table.fail("collider", "has no tolerance and no gradient; leave those settings away");
    if (!body.field.empty() && !body.frames.empty())
      table.fail("field", "is that of a rigid body; frames have a field each");
    read_motion(table, body.motion);
    if (!body.frames.empty() && !physics::at_rest(body.motion))
      table.fail("frames", "move the body already; leave its motion away");
    table.finish();
  }

  void read_material(SettingsTable& table) {
    physics::SimulateOptions& o = scene_.simulation;
    SceneMaterial& m = scene_.material;
    read_preset(table);
    table.read("density", m.density, positive("kg/m^2"));
    table.read("stiffness", m.stiffness, positive("N/m"));
    table.read("bending", m.bending, not_negative("N/m"));
    using bridge::Bending, bridge::Membrane;
    table.choose<Membrane>("membrane", m.membrane,
                           {{"paper", Membrane::paper},
                            {"uniform", Membrane::uniform},
                            {"inverse", Membrane::inverse},
                            {"van-gelder", Membrane::van_gelder},
                            {"triangles", Membrane::triangles},
                            {"tension", Membrane::tension}});
    table.choose<Bending>(
        "bending_law", m.bending_law,
        {{"cross", Bending::cross}, {"hinge", Bending::hinge}, {"cosine", Bending::cosine}});
    table.read("stretch", m.stretch, positive("N/m"));
    table.read("poisson", m.poisson, {-1, 1, true});
    if (m.poisson == 1) table.fail("poisson", "must be below 1");
    table.read("rigidity", m.rigidity, not_negative("N m"));
    table.read("tension", m.tension, positive("N/m"));
    table.read("compression", m.compression, {0, 1});
    table.read("shear", m.shear, {0, 1});
    table.choose<bridge::MassRule>("mass_rule", m.mass_rule,
                                   {{"area", bridge::MassRule::area}, {"equal", bridge::MassRule::equal}});
    if (table.has("stretch") && table.has("stiffness"))
      table.fail("stretch", "stands in place of stiffness; leave one away");
    table.read("damping", o.spring_damping, not_negative());
    table.read("drag", o.air_drag, not_negative("1/s"));
    table.read("friction", o.friction, not_negative());
    table.read("gap", o.contact_gap, positive("m"));
    table.finish();
  }

  /// A fabric is a plate in SI units: what the file says beside it goes before it.
  void read_preset(SettingsTable& table) {
    SceneMaterial& m = scene_.material;
    std::vector<std::pair<std::string, std::string>> names;
    for (const Fabric& fabric : fabrics()) names.emplace_back(fabric.name, fabric.name);
    table.choose<std::string>("preset", m.preset, names);
    if (m.preset.empty()) return;
    const Fabric& fabric = fabric_named(m.preset);
    m.density = fabric.density;
    m.membrane = bridge::Membrane::triangles;
    m.bending_law = bridge::Bending::hinge;
    if (!table.has("stiffness")) m.stretch = fabric.stretch;
    m.rigidity = fabric.rigidity;
    m.shear = shear_ratio(fabric);
    scene_.simulation.spring_damping = fabric.damping;
    scene_.simulation.friction = fabric.friction;
  }

  void read_pins(SettingsTable& table) {
    ScenePins pins;
    table.read("box", pins.box, 6);
    table.read_name_or_index("loop", pins.loop);
    table.read("group", pins.group);
    table.read("vertices", pins.vertices, 0, 1 << 30);
    if (pins.box.empty() && pins.loop.empty() && pins.group.empty() && pins.vertices.empty())
      table.fail("loop", "is missing: say which vertices with box, loop, group or vertices");
    read_motion(table, pins.motion);
    table.finish();
    scene_.pins.push_back(std::move(pins));
  }

  void read_forces(SettingsTable& table) {
    if (table.has("gravity") && document_.root["forces"]["gravity"].is_array()) {
      table.read("gravity", scene_.simulation.gravity);
    } else {
      double down = 9.81;
      table.read("gravity", down, any("m/s^2"));
      scene_.simulation.gravity = {0, -down, 0};
    }
    table.read("wind", scene_.wind.velocity);
    scene_.wind.swirl = read_spin(table, "swirl");
    for (SettingsTable& gust : table.tables("gusts")) {
      physics::Gust g{};
      gust.read("time", g.time, not_negative("s"));
      gust.read("factor", g.factor, any());
      gust.finish();
      if (!scene_.wind.gusts.empty() && g.time <= scene_.wind.gusts.back().time)
        gust.fail("time", "must be later than that of the gust before");
      scene_.wind.gusts.push_back(g);
    }
    table.finish();
  }

  void read_simulation(SettingsTable& table) {
    physics::SimulateOptions& o = scene_.simulation;
    table.read("seconds", o.seconds, not_negative("s"));
    table.read("stop_at", scene_.stop_at, not_negative("s"));
    table.read("dt", o.dt, positive("s"));
    bool force = false;
    table.read("force_dt", force);
    o.step_rule = force ? physics::StepRule::forced : physics::StepRule::limited;
    if (force && !o.dt) table.fail("force_dt", "needs dt");
    table.choose<physics::Integrator>("integrator", o.integrator,
                                      {{"leapfrog", physics::Integrator::leapfrog},
                                       {"euler", physics::Integrator::explicit_euler},

                                       {"rk4", physics::Integrator::rk4},
                                       {"backward-euler", physics::Integrator::backward_euler},
                                       {"xpbd", physics::Integrator::xpbd}});
    table.read("sweeps", o.xpbd.iterations, 1, 100000);
    table.read("newton", o.backward_euler.newton_iterations, 1, 100000);
    table.read("threads", scene_.threads, 1, 256);
    table.finish();
  }

  void read_output(SettingsTable& table) {
    SceneOutput& o = scene_.output;
    read_path(table, "mesh", o.mesh);
    read_path(table, "state", o.state);
    read_path(table, "inserted", o.inserted);
    read_path(table, "smoothed", o.smoothed);
    read_path(table, "animation", o.animation);
    read_path(table, "body", o.body);
    table.read("fps", o.fps, positive("1/s"));
    table.finish();
  }

  const TomlDocument& document_;
  std::filesystem::path folder_;
  Scene scene_;
};

}  // namespace

Scene read_scene(const TomlDocument& document, const std::filesystem::path& folder) {
  return SceneReader(document, folder).read();
}

}  // namespace furrow::io
