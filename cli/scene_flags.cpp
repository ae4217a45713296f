// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/scene_flags.h"

#include <algorithm>

#include "cli/common.h"

namespace furrow::cli {
namespace {

struct Flag {
  const char* flag;
  const char* path;
  bool is_text;
  const char* help;
};

constexpr Flag flags[] = {
    {"-o,--output", "output.mesh", true, "mesh to write: obj, ply, off or stl; - is OBJ to standard output"},
    {"--save-state", "output.state", true,
     "state to write (a PLY), to go on from with --state or wrinkle --state"},
    {"--inserted", "output.inserted", true, "also write the mesh after the lines of time 0 were inserted"},
    {"--smoothed", "output.smoothed", true, "also write it after they were smoothed"},
    {"--animation", "output.animation", true, "animation to write: pc2, mdd or glb"},
    {"--save-body", "output.body", true, "also write the body where it is at the end: a mesh"},
    {"--fps", "output.fps", false, "its frames a second (default 25)"},
    {"--seconds", "simulation.seconds", false, "the end of the simulation [s] (default 2)"},
    {"--stop-at", "simulation.stop_at", false,
     "stop earlier, at this time [s], and keep the plan in the state"},
    {"--density", "material.density", false,
     "mass of the cloth [kg/m^2]; default that of the file, else 0.15"},
    {"--fabric", "material.preset", true,
     "a measured fabric: denim, interlock, rib-knit, … (docs/scenes.md)"},
    {"--membrane", "material.membrane", true,
     "what resists stretching: paper (springs of the paper's law, default), uniform, inverse, van-gelder, "
     "triangles (of constant strain), or tension (quadratic and asymmetric)"},
    {"--bending-law", "material.bending_law", true,
     "what resists bending: cross (springs, default), hinge (of a rigidity), or cosine"},
    {"--stretch", "material.stretch", false,
     "Young's modulus times thickness [N/m], in place of --stiffness"},
    {"--rigidity", "material.rigidity", false, "bending rigidity of hinges [N m] (default 1e-5)"},
    {"--tension", "material.tension", false,
     "of membrane tension: force a metre of width at strain 1 [N/m]; default that of --stretch at 2 %"},
    {"--stiffness", "material.stiffness", false, "k_std of the structural springs [N/m] (default 1000)"},
    {"--bending", "material.bending", false, "k_std of the bending springs [N/m] (default 10)"},
    {"--damping", "material.damping", false, "damping of each spring, as a share of critical (default 0.02)"},
    {"--drag", "material.drag", false, "air drag [1/s] (default 2)"},
    {"--friction", "material.friction", false, "Coulomb friction with the body (default 0.3)"},
    {"--gap", "material.gap", false,
     "distance that the cloth keeps from the body [m]; raised to what the mesh and the field need (default "
     "0.003)"},
    {"--gravity", "forces.gravity", false, "acceleration downwards [m/s^2] (default 9.81), or x,y,z"},
    {"--wind", "forces.wind", false, "velocity of the air x,y,z [m/s]; acts through the drag"},
    {"--dt", "simulation.dt", false,
     "time step [s]; default 0.9 of the limit, 1/240 with backward-euler, 1/1200 with xpbd"},
    {"--integrator", "simulation.integrator", true,
     "leapfrog (default), rk4, backward-euler, xpbd, or euler (the baseline that diverges)"},
    {"--sweeps", "simulation.sweeps", false,
     "of xpbd over all springs a step (default 10); few make the cloth softer"},
    {"--newton", "simulation.newton", false,
     "iterations of backward-euler a step, at most (default 1: linearised once)"},
    {"--threads", "simulation.threads", false,
     "threads (default: one for each 10,000 vertices, at most all cores); the result does not depend on "
     "them"},
    {"--subdivide", "garment.subdivide", false,
     "refine the garment so many times (Loop) before the first line"},
    {"--rest", "garment.rest", true,
     "stored (default): the rest state that the file has; keep: that which holds the garment's shape at time "
     "0 "
     "(docs/keep.md)"},
    {"--body", "body.mesh", true, "body that the garment rests on"},
    {"--body-frames", "body.frames", true, "its motion: a PC2 or MDD file, or OBJ files as name_####.obj"},
    {"--body-fps", "body.fps", false, "frames a second of OBJ files (default 25)"},
    {"--field", "body.field", true, "the body's distance field, saved by furrow sdf"},
    {"--tolerance", "body.tolerance", false,
     "error of the body's distance field [m]; default 1/1000 of its diagonal, at most 0.002. With a % sign, "
     "--tolerance 1%: the error of the result, as a share of the garment's diagonal; integrator and step are "
     "chosen for it first (docs/chart.md)"},
    {"--gradient", "body.gradient", true,
     "of the field: exact (of the interpolated distance, default) or interpolated (of the corners', as in "
     "the paper)"},
};

constexpr std::string_view field_tolerance = "body.tolerance";

/// Of the result, not of the field.
bool is_share(const std::string& tolerance) { return !tolerance.empty() && tolerance.back() == '%'; }

/// Whether it says what a garment hangs in that stands still.
bool is_of_rest(std::string_view path) {
  constexpr std::string_view paths[] = {"material.preset",  "material.membrane", "material.bending_law",
                                        "material.stretch", "material.rigidity", "material.stiffness",
                                        "material.tension", "material.friction", "material.gap",
                                        "forces.gravity",   "body.mesh",         "body.field"};
  return std::find(std::begin(paths), std::end(paths), path) != std::end(paths);
}

/// The flag's long name.
std::string name_of(const Flag& f) {
  const std::string names = f.flag;
  return names.substr(names.find("--"));
}

/// "1,2,3" as a list, so that vectors need no brackets.
io::Json value_of(const std::string& text, bool is_text) {
  if (is_text) return text;
  if (text.find(',') != std::string::npos && text.find('[') == std::string::npos)
    return io::parse_value("[" + text + "]");
  return io::parse_value(text);
}

void add_pins(io::TomlDocument& document, const char* kind, io::Json value, const std::string& flag) {
  const std::size_t n = document.root.contains("pins") ? document.root["pins"].size() : 0;
  io::set_value(document, "pins." + std::to_string(n), io::Json{{kind, std::move(value)}}, flag);
}

std::string quoted(const std::string& text) {
  if (!text.empty() && text.find_first_of(" \t\n'\"\\$`&|;<>()[]{}*?#~!") == std::string::npos) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// Flags or --set for the value and all below it.
void list_flags(const io::Json& value, const std::string& path, std::string& text) {
  const auto* flag =
      std::find_if(std::begin(flags), std::end(flags), [&](const Flag& f) { return path == f.path; });
  if (flag != std::end(flags)) {
    const std::string shown = value.is_string() ? value.get<std::string>() : io::value_text(value);
    text += " " + name_of(*flag) + " " + quoted(shown);
  } else if (path == "garment.mesh") {
    text = " " + quoted(value.get<std::string>()) + text;
  } else if (path == "unit" || path == "up") {
    text += " --" + path + " " + quoted(value.get<std::string>());
  } else if (path == "title") {
    // for people only
  } else if (path == "simulation.force_dt") {
    if (value == true) text += " --force-dt";
  } else if (value.is_object()) {
    for (const auto& [key, item] : value.items())
      list_flags(item, path.empty() ? key : path + "." + key, text);
  } else if (value.is_array() && !value.empty() && value[0].is_object()) {
    for (std::size_t i = 0; i < value.size(); ++i) list_flags(value[i], path + "." + std::to_string(i), text);
  } else {
    text += " --set " + quoted(path + "=" + io::value_text(value));
  }
}

bool is_tables(const io::Json& value) { return value.is_array() && !value.empty() && value[0].is_object(); }

/// What is in `now` and not, or otherwise, in `before`; lists of tables keep their length.
io::Json difference(const io::Json& now, const io::Json& before) {
  io::Json result = now;
  if (now.is_object() && before.is_object()) {
    for (const auto& [key, item] : now.items()) {
      if (!before.contains(key)) continue;
      if (item == before[key])
        result.erase(key);
      else
        result[key] = difference(item, before[key]);
    }
  } else if (is_tables(now) && is_tables(before) && now.size() == before.size()) {
    for (std::size_t i = 0; i < now.size(); ++i) result[i] = difference(now[i], before[i]);
  }
  return result;
}

}  // namespace

void SceneFlags::add_to(CLI::App& sub, bool at_rest) {
  for (const Flag& f : flags) {
    if (at_rest && !is_of_rest(f.path)) continue;
    Given& g = given_.emplace_back(Given{f.path, f.is_text, name_of(f), "", nullptr});
    g.option = sub.add_option(f.flag, g.text, f.help)->type_name(f.is_text ? "TEXT" : "NUMBER");
  }
  if (!at_rest) sub.add_flag("--force-dt", force_dt_, "take a --dt above the stability limit");
  sub.add_option("--pin-box", pin_boxes_,
                 "hold the vertices in a box x0,y0,z0,x1,y1,z1 [m, y up]; may be given again")
      ->allow_extra_args(false);
  sub.add_option("--pin-loop", pin_loops_,
                 "hold a boundary loop: top, bottom, or its index (the longest is 0)")
      ->allow_extra_args(false);
  sub.add_option("--pin-group", pin_groups_, "hold the vertices of a group, by its name")
      ->allow_extra_args(false);
  sub.add_option("--pin-vertices", pin_vertices_, "hold vertices, by their indices from 0")
      ->delimiter(',')
      ->allow_extra_args(false);
  if (at_rest) return;
  sub.add_option("--set", sets_,
                 "any setting of a scene, as key=value: --set body.motion.spin.rate=3; may be given again")
      ->allow_extra_args(false);
}

void SceneFlags::apply(io::TomlDocument& document) const {
  for (const Given& g : given_)
    if (g.option->count() && !(g.path == field_tolerance && is_share(g.text)))
      io::set_value(document, g.path, value_of(g.text, g.is_text), g.flag);
  if (force_dt_) io::set_value(document, "simulation.force_dt", true, "--force-dt");
  for (const std::string& box : pin_boxes_)
    add_pins(document, "box", parse_numbers(box, 6, "--pin-box"), "--pin-box " + box);
  for (const std::string& loop : pin_loops_) add_pins(document, "loop", loop, "--pin-loop " + loop);
  for (const std::string& group : pin_groups_) add_pins(document, "group", group, "--pin-group " + group);
  if (!pin_vertices_.empty()) add_pins(document, "vertices", pin_vertices_, "--pin-vertices");
  apply_sets(document, sets_);
}

std::string SceneFlags::first() const {
  for (const Given& g : given_)
    if (g.option->count()) return g.flag;
  if (!pin_boxes_.empty()) return "--pin-box";
  if (!pin_loops_.empty()) return "--pin-loop";
  if (!pin_groups_.empty()) return "--pin-group";
  return pin_vertices_.empty() ? "" : "--pin-vertices";
}

std::string SceneFlags::accuracy() const {
  for (const Given& g : given_)
    if (g.path == field_tolerance && is_share(g.text)) return g.text;
  return "";
}

void apply_sets(io::TomlDocument& document, const std::vector<std::string>& sets) {
  for (const std::string& text : sets) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError("--set takes key=value, not '" + text + "'");
    try {
      io::set_value(document, text.substr(0, equals), io::parse_value(text.substr(equals + 1)), "--set");
    } catch (const std::invalid_argument& e) {
      throw UsageError(std::string("--set ") + e.what());
    }
  }
}

std::string equivalent_flags(const io::Json& settings, const std::string& state, const io::Json& before) {
  std::string text;
  list_flags(state.empty() ? settings : difference(settings, before), "", text);
  return "simulate" + (state.empty() ? "" : " --state " + quoted(state)) + text;
}

}  // namespace furrow::cli
