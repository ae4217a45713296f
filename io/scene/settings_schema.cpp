// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/settings_schema.h"

#include <tuple>

#include "io/scene/fabrics.h"
#include "io/scene/motion_settings.h"
#include "io/scene/scene.h"
#include "io/scene/setting_row.h"

namespace furrow::io {

/// With one of each thing that a scene may have.
template <>
Scene fresh<Scene>() {
  Scene scene;
  scene.body.emplace();
  scene.lines.emplace_back();
  scene.pins.emplace_back();
  return scene;
}

namespace {

using bridge::Bending, bridge::MassRule, bridge::Membrane;
using geometry::BorderRule, geometry::Detail, geometry::InsertionRule, geometry::LineRule, geometry::RestRule;
using geometry::SmoothingRegion, geometry::SmoothingWeights;
using physics::GradientRule, physics::Integrator, physics::StepRule;
using Word = std::optional<std::string>;

std::vector<std::pair<std::string, std::string>> fabric_names() {
  std::vector<std::pair<std::string, std::string>> names;
  for (const Fabric& fabric : fabrics()) names.emplace_back(fabric.name, fabric.name);
  return names;
}

void read_gravity(SettingsTable& table, const char* key, Scene& scene) {
  if (table.has_list(key)) return table.read(key, scene.simulation.gravity);
  double down = 9.81;
  table.read(key, down, any("m/s^2"));
  scene.simulation.gravity = {0, -down, 0};
}

/// The rule of the rest state, and whether the shape is kept.
void read_rest(SettingsTable& table, const char* key, Scene& scene) {
  SceneLines& lines = scene.lines.back();
  std::pair rest(lines.options.rest, false);
  table.choose<std::pair<RestRule, bool>>(key, rest,
                                          {{"drawn", {RestRule::drawn, false}},
                                           {"flat", {RestRule::flat, false}},
                                           {"copied", {RestRule::copied, false}},
                                           {"keep", {RestRule::drawn, true}}});
  std::tie(lines.options.rest, lines.keep) = rest;
}

/// A word of what gives the directions, or a path.
void read_warp(SettingsTable& table, const char* key, Scene& scene) {
  std::string word;
  table.read(key, word);
  if (word.empty()) return;
  for (const char* known : {"auto", "none", "file", "texture", "texture-u", "x", "y", "z"})
    if (word == known) return void(scene.material.warp = word);
  if (word.find('.') == std::string::npos && word.find('/') == std::string::npos)
    table.fail(key,
               "is none of auto, none, file, texture, texture-u, x, y, z, nor a stroke file (.json, .obj)");
  std::filesystem::path strokes;
  table.read(key, strokes);
  scene.material.warp = strokes.string();
}

constexpr const char* as_wrinkle = "as the flag of `furrow wrinkle`";

/// One row a setting: its words, and the field that it sets with what it may be. A new setting is a row here
/// and a field in its struct; docs/scenes.md is then made anew (tests/io/scene/settings_schema_test.cpp).
const Row<Scene> rows[] = {
    // [output]
    {{.path = "output.mesh",
      .flag = "-o,--output",
      .help = "mesh to write: obj, ply, off, stl or glb; - is OBJ to standard output",
      .shown_in = used_by::all,
      .what = "the garment at the end",
      .used = used_by::moving},
     path([](auto& s) -> auto& { return s.output.mesh; })},
    {{.path = "output.state",
      .flag = "--save-state",
      .help = "state to write (a PLY), to go on from with --state or wrinkle --state",
      .shown_in = used_by::moving,
      .what = "to go on from",
      .used = used_by::moving},
     path([](auto& s) -> auto& { return s.output.state; })},
    {{.path = "output.checkpoint",
      .flag = "--checkpoint",
      .help = "write the state (--save-state) on the way, too, whenever so many seconds have passed [s]: a "
              "killed run costs no more",
      .what = "clock time between two states written on the way to `state`",
      .used = used_by::moving},
     number(
         positive("s"), [](auto& s) -> auto& { return s.output.checkpoint; })},
    {{.path = "output.inserted",
      .flag = "--inserted",
      .help = "also write the mesh after the lines of time 0 were inserted",
      .what = "the garment with the lines of time 0 inserted",
      .used = used_by::moving},
     path([](auto& s) -> auto& { return s.output.inserted; })},
    {{.path = "output.smoothed",
      .flag = "--smoothed",
      .help = "also write it after they were smoothed",
      .what = "and after they were smoothed",
      .used = used_by::moving},
     path([](auto& s) -> auto& { return s.output.smoothed; })},
    {{.path = "output.settled",
      .flag = "--settled",
      .help = "also write it at rest, before it moves (with --settle)",
      .what = "and at rest, before it moves (with `settle`)",
      .used = used_by::simulate,
      .flag_in = used_by::simulate},
     path([](auto& s) -> auto& { return s.output.settled; })},
    {{.path = "output.animation",
      .flag = "--animation",
      .help = "animation to write: pc2, mdd or glb",
      .shown_in = used_by::simulate,
      .what = "pc2, mdd or glb ([animations.md](animations.md))",
      .used = used_by::moving},
     path([](auto& s) -> auto& { return s.output.animation; })},
    {{.path = "output.body",
      .flag = "--save-body",
      .help = "also write the body where it is at the end: a mesh",
      .what = "the body where it is at the end",
      .used = used_by::moving},
     path([](auto& s) -> auto& { return s.output.body; })},
    {{.path = "output.fps",
      .flag = "--fps",
      .help = "its frames a second (default 25)",
      .shown_in = used_by::simulate,
      .what = "frames a second of the animation",
      .used = used_by::moving},
     number(
         positive("1/s"), [](auto& s) -> auto& { return s.output.fps; })},

    // [simulation]: its end
    {{.path = "simulation.seconds",
      .flag = "--seconds",
      .shown_in = used_by::simulate,
      .what = "the end of the simulation",
      .used = used_by::moving},
     number(
         not_negative("s"), [](auto& s) -> auto& { return s.simulation.seconds; })},
    {{.path = "simulation.settle",
      .flag = "--settle",
      .help = "bring the garment to rest first, on its body and its pins as they lie at time 0, as furrow "
              "drape does, but without contact of cloth with cloth; with --seconds 0 that is all",
      .shown_in = used_by::simulate,
      .what = "the garment, with the lines of time 0, comes to rest before it moves, on body and pins as "
              "they lie "
              "at time 0; with `seconds = 0` that is all",
      .used = used_by::simulate | used_by::keep,
      .flag_in = used_by::simulate},
     yes_no(
         false, true, [](auto& s) -> auto& { return s.settle; })},
    {{.path = "simulation.starts",
      .flag = "--starts",
      .help =
          "look for rest from so many starts (default 1), write the rest with the lowest energy, and tell "
          "each number as mean and spread",
      .shown_in = used_by::drape,
      .what =
          "starts of `furrow drape`, each with noise of its own: the rest with the lowest energy is taken, "
          "and numbers are told as mean and spread",
      .used = used_by::drape,
      .flag_in = used_by::drape},
     whole(
         1, 1000, [](auto& s) -> auto& { return s.starts; })},
    {{.path = "simulation.stop_at",
      .flag = "--stop-at",
      .help = "stop earlier, at this time [s], and keep the plan in the state",
      .shown_in = used_by::simulate,
      .what = "stop earlier, with the plan kept",
      .used = used_by::moving},
     number(
         not_negative("s"), [](auto& s) -> auto& { return s.stop_at; })},

    // [material]
    {{.path = "material.density",
      .flag = "--density",
      .help = "mass of the cloth [kg/m^2]; default the fabric's, of springs that of the file, else 0.15",
      .what = "mass of the cloth",
      .usual = "the fabric's; of springs the file's, else 0.15"},
     number(
         positive("kg/m^2"), [](auto& s) -> auto& { return s.material.density; })},
    {{.path = "material.preset",
      .flag = "--fabric",
      .help =
          "a measured fabric: cotton, silk, denim, … (furrow fabric list), or a file of furrow fabric fit "
          "(.toml); default what the garment's PLY notes, else cotton",
      .shown_in = used_by::all,
      .what = "a measured fabric, see below, or a file (.toml) with a `[material]`; the keys beside it go "
              "before it",
      .usual = "what the garment's PLY notes; else cotton, where no other key says what the cloth is",
      .flag_in = used_by::all},
     choice<std::string>(
         [](auto& s) -> auto& { return s.material.preset; }, fabric_names())},
    {{.path = "material.warp",
      .flag = "--warp",
      .help = "where the warp of cloth with threads runs: file (the map in its PLY), texture (as v grows), "
              "texture-u, x, y or z (that axis on each face), a stroke file (the warp runs so), or none (the "
              "same in all directions); default the map, else texture, else y",
      .what =
          "where the warp of cloth with threads runs: `auto`, `file`, `texture`, `texture-u`, `x`, `y`, `z`, "
          "`none` or a stroke file ([threads.md](threads.md))",
      .usual = "auto: the map in the garment's PLY, else the texture, else y",
      .flag_in = used_by::moving | used_by::drape},
     own(Kind::text, "text", read_warp)},
    {{.path = "material.warp_stretch",
      .what = "Young's modulus times thickness of strips along the warp; makes cloth with threads, with the "
              "five below, of a `preset` or of all six"},
     number(
         positive("N/m"), [](auto& s) -> auto& { return s.material.warp_stretch; })},
    {{.path = "material.weft_stretch", .what = "the same along the weft"},
     number(
         positive("N/m"), [](auto& s) -> auto& { return s.material.weft_stretch; })},
    {{.path = "material.thread_shear", .what = "shear modulus times thickness of cloth with threads"},
     number(
         positive("N/m"), [](auto& s) -> auto& { return s.material.thread_shear; })},
    {{.path = "material.thread_poisson",
      .what = "ν₁₂: how much a strip along the warp narrows as it stretches"},
     number(
         any(), [](auto& s) -> auto& { return s.material.thread_poisson; })},
    {{.path = "material.warp_rigidity", .what = "B of strips along the warp"},
     number(
         positive("N m"), [](auto& s) -> auto& { return s.material.warp_rigidity; })},
    {{.path = "material.weft_rigidity", .what = "B of strips along the weft"},
     number(
         positive("N m"), [](auto& s) -> auto& { return s.material.weft_rigidity; })},
    {{.path = "material.bias_rigidity", .what = "B of strips cut at 45°"},
     number(
         positive("N m"), [](auto& s) -> auto& { return s.material.bias_rigidity; })},
    {{.path = "material.membrane",
      .flag = "--membrane",
      .help = "in place of a fabric: triangles (of constant strain, as fabrics are), tension (quadratic and "
              "asymmetric), or springs: paper (by the paper's law), uniform, inverse, van-gelder",
      .what = "what resists stretching: springs by a law, triangles of constant strain, or tension (paper 2)",
      .flag_in = used_by::all},
     choice<Membrane>([](auto& s) -> auto& { return s.material.membrane; },
                      {std::begin(bridge::membrane_words), std::end(bridge::membrane_words)})},
    {{.path = "material.bending_law",
      .flag = "--bending-law",
      .help =
          "in place of a fabric: plate (of a rigidity, as fabrics are), hinge (each edge by itself), cosine, "
          "or cross (springs of the paper)",
      .what = "what resists bending: springs across the edges, a plate's hinges, the cosine law (paper 2), "
              "or hinges coupled to one plate ([bending.md](bending.md))",
      .flag_in = used_by::all},
     choice<Bending>([](auto& s) -> auto& { return s.material.bending_law; },
                     {{"cross", Bending::cross},
                      {"hinge", Bending::hinge},
                      {"cosine", Bending::cosine},
                      {"plate", Bending::plate}})},
    {{.path = "material.stretch",
      .flag = "--stretch",
      .help = "Young's modulus times thickness [N/m]; default the fabric's",
      .what = "Young's modulus times thickness, in place of `stiffness`",
      .usual = "√3/2 · `stretch` = `stiffness`",
      .flag_in = used_by::all},
     number(
         positive("N/m"), [](auto& s) -> auto& { return s.material.stretch; })},
    {{.path = "material.poisson", .what = "Poisson's ratio of `triangles`; below 1"},
     number(
         Limits{-1, 1, true}, [](auto& s) -> auto& { return s.material.poisson; })},
    {{.path = "material.rigidity",
      .flag = "--rigidity",
      .help = "bending rigidity [N m]; default the fabric's, without one 1e-5",
      .what = "B of hinges, or of a plate",
      .usual = "the fabric's; without one 1e-5",
      .flag_in = used_by::all},
     number(
         not_negative("N m"), [](auto& s) -> auto& { return s.material.rigidity; })},
    {{.path = "material.tension",
      .flag = "--tension",
      .help = "of membrane tension: force a metre of width at strain 1 [N/m]; default that of --stretch at "
              "2 %",
      .what = "of membrane `tension`: force a metre of width at strain 1",
      .usual = "50 · `stretch`",
      .flag_in = used_by::all},
     number(
         positive("N/m"), [](auto& s) -> auto& { return s.material.tension; })},
    {{.path = "material.compression", .what = "share of `tension` that pushes"},
     number(
         Limits{0, 1}, [](auto& s) -> auto& { return s.material.compression; })},
    {{.path = "material.shear", .what = "share of `tension` that a diagonal has"},
     number(
         Limits{0, 1}, [](auto& s) -> auto& { return s.material.shear; })},
    {{.path = "material.stiffness",
      .flag = "--stiffness",
      .help = "in place of a fabric: k_std of structural springs [N/m]",
      .what = "k_std of the structural springs",
      .flag_in = used_by::all},
     number(
         positive("N/m"), [](auto& s) -> auto& { return s.material.stiffness; })},
    {{.path = "material.bending", .flag = "--bending", .what = "k_std of the bending springs"},
     number(
         not_negative("N/m"), [](auto& s) -> auto& { return s.material.bending; })},
    {{.path = "material.mass_rule",
      .what = "mass by area, or the same for each vertex: the garment's over its vertices (paper 2)"},
     choice<MassRule>([](auto& s) -> auto& { return s.material.mass_rule; },
                      {{"area", MassRule::area}, {"equal", MassRule::equal}})},
    {{.path = "material.line_stretch",
      .flag = "--line-stretch",
      .help =
          "of a chain (a garment of lines without faces): Young's modulus times cross-section [N]; default "
          "that of the file, else 1000",
      .what = "of a chain, a garment of lines without faces: Young's modulus times cross-section",
      .usual = "the file's, else 1000",
      .used = used_by::simulate,
      .flag_in = used_by::simulate},
     number(
         positive("N"), [](auto& s) -> auto& { return s.material.line_stretch; })},
    {{.path = "material.line_density",
      .flag = "--line-density",
      .help = "mass of a chain [kg/m]; default that of the file, else 0.01",
      .what = "mass of a chain",
      .usual = "the file's, else 0.01",
      .used = used_by::simulate,
      .flag_in = used_by::simulate},
     number(
         positive("kg/m"), [](auto& s) -> auto& { return s.material.line_density; })},
    {{.path = "material.damping",
      .flag = "--damping",
      .what = "damping of each spring, as a share of critical",
      .used = used_by::moving},
     number(
         not_negative(), [](auto& s) -> auto& { return s.simulation.spring_damping; })},
    {{.path = "material.drag", .flag = "--drag", .what = "air drag", .used = used_by::moving},
     number(
         not_negative("1/s"), [](auto& s) -> auto& { return s.simulation.air_drag; })},
    {{.path = "material.friction",
      .flag = "--friction",
      .help = "Coulomb friction with the body; default the fabric's, else 0.3",
      .shown_in = used_by::all,
      .what = "Coulomb friction with the body",
      .flag_in = used_by::all},
     number(
         not_negative(), [](auto& s) -> auto& { return s.simulation.friction; })},
    {{.path = "material.cloth_friction",
      .flag = "--cloth-friction",
      .what = "Coulomb friction of cloth on cloth, where layers and folds are kept apart",
      .used = used_by::drape | used_by::simulate,
      .flag_in = used_by::drape | used_by::simulate},
     number(
         not_negative(), [](auto& s) -> auto& { return s.simulation.self.friction; })},
    {{.path = "material.gap",
      .flag = "--gap",
      .help = "distance that the cloth keeps from the body [m]; raised to what the mesh and the field need "
              "(default 0.003)",
      .shown_in = used_by::all,
      .what = "distance that the cloth keeps from the body; raised to what the mesh and the field need",
      .flag_in = used_by::all},
     number(
         positive("m"), [](auto& s) -> auto& { return s.simulation.contact_gap; })},

    // [forces]
    {{.path = "forces.gravity",
      .flag = "--gravity",
      .help = "acceleration downwards [m/s^2] (default 9.81), or x,y,z",
      .what = "acceleration down, or as a vector",
      .usual = "9.81",
      .flag_in = used_by::all},
     own(Kind::vector, "number, or [x, y, z] [m/s^2]", read_gravity)},
    {{.path = "forces.wind",
      .flag = "--wind",
      .help = "velocity of the air x,y,z [m/s]; acts through the drag",
      .shown_in = used_by::moving,
      .what = "velocity of the air; acts through `drag`",
      .used = used_by::moving},
     vector(
         "m/s", [](auto& s) -> auto& { return s.wind.velocity; })},
    {{.path = "forces.gusts",
      .what = "`[{time, factor}, …]` of the wind, linear between",
      .usual = "1",
      .used = used_by::moving},
     own(Kind::table, "tables",
         [](SettingsTable& table, const char* key, Scene& s) { read_gusts(table, key, s.wind.gusts); })},
    {{.path = "forces.swirl",
      .what = "air that turns like a rigid body; as `spin` below",
      .used = used_by::moving},
     own(Kind::table, "table",
         [](SettingsTable& table, const char* key, Scene& s) { s.wind.swirl = read_spin(table, key); })},

    // [simulation]: its steps
    {{.path = "simulation.dt",
      .flag = "--dt",
      .help = "time step [s]; default 0.9 of the limit, 1/60 with implicit and tr-bdf2, 1/1200 with "
              "xpbd",
      .what = "time step",
      .usual = "0.9 of the limit; 1/60 with implicit and tr-bdf2, 1/1200 with xpbd, which have none",
      .used = used_by::moving},
     number(
         positive("s"), [](auto& s) -> auto& { return s.simulation.dt; })},
    {{.path = "simulation.force_dt",
      .flag = "--force-dt",
      .help = "take a --dt above the stability limit",
      .what = "take `dt` although it is above the limit",
      .used = used_by::moving},
     yes_no(
         StepRule::limited, StepRule::forced, [](auto& s) -> auto& { return s.simulation.step_rule; })},
    {{.path = "simulation.integrator",
      .flag = "--integrator",
      .help =
          "auto (default): leapfrog, or implicit steps where those take less than half of its time (keep: "
          "implicit); leapfrog, implicit, tr-bdf2, rk4, or xpbd",
      .shown_in = used_by::simulate,
      .what = "the scheme of its steps; auto is leapfrog, or implicit where that takes less than half of its "
              "time",
      .used = used_by::moving},
     choice<std::optional<Integrator>>([](auto& s) -> auto& { return s.integrator; },
                                       {{"auto", {}},
                                        {"leapfrog", Integrator::leapfrog},
                                        {"rk4", Integrator::rk4},
                                        {"xpbd", Integrator::xpbd},
                                        {"implicit", Integrator::implicit},
                                        {"tr-bdf2", Integrator::tr_bdf2}},
                                       {{"euler",
                                         "diverges at any step and is no choice any more; write "
                                         "leapfrog, which costs as much a step"}})},
    {{.path = "simulation.sweeps",
      .flag = "--sweeps",
      .help = "of xpbd over all springs a step (default 10); few make the cloth softer",
      .what = "of xpbd over all springs a step; few make the cloth softer",
      .used = used_by::moving},
     whole(
         1, 100000, [](auto& s) -> auto& { return s.simulation.xpbd.iterations; })},
    {{.path = "simulation.self_contact",
      .flag = "--self-contact",
      .help = "on: cloth keeps off cloth, and no step passes through it (default off)",
      .shown_in = used_by::moving,
      .what = "`on`: cloth keeps off cloth, and no step passes through it",
      .used = used_by::simulate,
      .flag_in = used_by::simulate},
     choice<bool>([](auto& s) -> auto& { return s.simulation.self.on; }, {{"off", false}, {"on", true}})},
    {{.path = "simulation.thickness",
      .flag = "--cloth-thickness",
      .what = "of the cloth, with `self_contact`: layers are so far apart",
      .used = used_by::simulate,
      .flag_in = used_by::simulate},
     number(
         positive("m"), [](auto& s) -> auto& { return s.simulation.self.thickness; })},
    {{.path = "simulation.threads",
      .flag = "--threads",
      .help =
          "threads (default: one for each 10,000 vertices, at most all cores; furrow drape: all cores); the "
          "result does not depend on them",
      .what = "the result does not depend on them",
      .usual = "one for each 10,000 vertices, at most all cores",
      .flag_in = used_by::moving | used_by::drape},
     whole(
         1, 256, [](auto& s) -> auto& { return s.threads; })},

    // [garment]
    {{.path = "garment.mesh", .what = "obj, ply, off, stl, gltf or glb", .usual = "must be there"},
     path([](auto& s) -> auto& { return s.garment; })},
    {{.path = "garment.subdivide",
      .flag = "--subdivide",
      .help = "refine the garment so many times (Loop) before the first line",
      .shown_in = used_by::moving,
      .what = "Loop steps before the first line"},
     whole(
         0, 4, [](auto& s) -> auto& { return s.subdivide; })},
    {{.path = "garment.layer",
      .what = "of several `[[garment]]`, which one is worn over which: the innermost has the lowest number",
      .usual = "their order in the file",
      .used = used_by::drape},
     whole(
         0, 1000, [](auto& s) -> auto& { return s.layer; })},
    {{.path = "garment.thickness",
      .what = "of the cloth, where layers and folds are kept apart; `--cloth-thickness` goes before it",
      .usual = "0.001",
      .used = used_by::drape},
     number(
         Limits{1e-5, 0.05, false, "m"}, [](auto& s) -> auto& { return s.thickness; })},
    {{.path = "garment.touch",
      .what = "of several `[[garment]]`, `false`: the others pass through it, and it through them",
      .used = used_by::drape},
     yes_no(
         false, true, [](auto& s) -> auto& { return s.touch; })},
    {{.path = "garment.allow_crossings",
      .flag = "--allow-crossings",
      .help = "pairs of faces of the cloth that may cross at the end (default 0); beyond it the exit code "
              "is 4",
      .what = "pairs of faces of the cloth that may cross at the end; beyond it the exit code is 4",
      .used = used_by::simulate | used_by::drape,
      .flag_in = used_by::simulate | used_by::drape},
     whole(
         0, 1000000000, [](auto& s) -> auto& { return s.allow_crossings; })},
    {{.path = "garment.rest",
      .flag = "--rest",
      .help = "stored (default): the rest state that the file has; keep: that which holds the garment's "
              "shape at time 0 (docs/keep.md)",
      .what = "`stored`: the rest state that the file has; `keep`: that which holds the shape that the "
              "garment has at time 0 ([keep.md](keep.md))",
      .used = used_by::moving},
     choice<bool>([](auto& s) -> auto& { return s.keep; }, {{"stored", false}, {"keep", true}})},
    {{.path = "garment.velocity",
      .flag = "--velocity",
      .help = "velocity of the garment at time 0, x,y,z [m/s] (default 0,0,0); pinned vertices keep theirs",
      .what = "velocity at time 0, after `settle`; pinned vertices keep their own",
      .used = used_by::simulate,
      .flag_in = used_by::simulate},
     vector(
         "m/s", [](auto& s) -> auto& { return s.velocity; })},

    // [body]
    {{.path = "body.mesh",
      .flag = "--body",
      .help = "body that the garment rests on",
      .shown_in = used_by::all,
      .what = "the body that the garment rests on",
      .usual = "must be there",
      .flag_in = used_by::all},
     path([](auto& s) -> auto& { return s.body->mesh; })},
    {{.path = "body.unit",
      .flag = "--body-unit",
      .help = "unit of the body's file, where it is not that of the garment's: m, cm, mm or inch",
      .what = "of the body's file and its frames",
      .usual = "that of all files",
      .flag_in = used_by::all},
     choice<Word>([](auto& s) -> auto& { return s.body->unit; },
                  {{"m", "m"}, {"cm", "cm"}, {"mm", "mm"}, {"inch", "inch"}})},
    {{.path = "body.frames",
      .flag = "--body-frames",
      .help = "its motion: a PC2 or MDD file, or OBJ files as name_####.obj",
      .what = "a body that changes its shape: PC2, MDD, or `name_####.obj`"},
     path([](auto& s) -> auto& { return s.body->frames; })},
    {{.path = "body.fps",
      .flag = "--body-fps",
      .help = "frames a second of OBJ files (default 25)",
      .what = "frames a second of OBJ files",
      .usual = "25"},
     number(
         positive("1/s"), [](auto& s) -> auto& { return s.body->fps; })},
    {{.path = "body.field",
      .flag = "--field",
      .help = "the body's distance field, saved by furrow sdf",
      .what = "the body's distance field, saved by `furrow sdf`",
      .usual = "built",
      .flag_in = used_by::all},
     path([](auto& s) -> auto& { return s.body->field; })},
    {{.path = "body.cache",
      .flag = "--cache",
      .help = "folder in which what is made of bodies' files (mended surface, field, skeleton) is kept for "
              "other runs; results are the same without",
      .what = "folder in which what is made of bodies' files (mended surface, field, skeleton) is kept for "
              "other runs ([batches.md](batches.md)); results are the same without",
      .usual = "nothing is kept",
      .flag_in = used_by::all},
     path([](auto& s) -> auto& { return s.body->cache; })},
    {{.path = "body.tolerance",
      .flag = "--tolerance",
      .help = "error of the body's distance field [m]; default 1/1000 of its diagonal, at most 0.002",
      .what = "error of the field",
      .usual = "1/1000 of the body's diagonal, at most 0.002"},
     number(
         positive("m"), [](auto& s) -> auto& { return s.body->options.tolerance; })},
    {{.path = "body.gradient",
      .flag = "--gradient",
      .help = "of the field: exact (of the interpolated distance, default) or interpolated (of the "
              "corners', as in the paper)",
      .what = "of the field: that of the interpolated distance, or interpolated from the corners (paper 1)"},
     choice<GradientRule>(
         [](auto& s) -> auto& { return s.body->options.gradient; },
         {{"exact", GradientRule::exact_derivative}, {"interpolated", GradientRule::interpolated_corners}})},
    {{.path = "body.collider",
      .what = "of a body with frames: its distance field, or depth maps from six sides, which are redrawn "
              "faster and asked slower ([decision 18](../decisions/0018-depth-maps.md))"},
     choice<bool>([](auto& s) -> auto& { return s.body->depth_maps; },
                  {{"field", false}, {"depth-maps", true}})},
    {{.path = "body.motion", .what = "of a rigid body, see below"},
     own(Kind::table, "table",
         [](SettingsTable& table, const char* key, Scene& s) { read_motion(table, key, s.body->motion); })},

    // [[lines]]
    {{.path = "lines.strokes",
      .what = "strokes to draw ([strokes.md](strokes.md))",
      .usual = "must be there"},
     path([](auto& s) -> auto& { return s.lines.back().strokes; })},
    {{.path = "lines.time", .what = "when they are drawn"},
     number(
         not_negative("s"), [](auto& s) -> auto& { return s.lines.back().time; })},
    {{.path = "lines.height", .what = "of strokes that name none"},
     number(
         any("m"), [](auto& s) -> auto& { return s.lines.back().height; })},
    {{.path = "lines.fade", .what = "how slowly the forces of lines drawn later set in; inf: never"},
     number(
         Limits{0, no_limit, true, "s", true}, [](auto& s) -> auto& { return s.lines.back().fade; })},
    {{.path = "lines.without", .what = "names of strokes to leave out"},
     plain(
         Kind::list, "text, or texts", [](auto& s) -> auto& { return s.lines.back().without; })},
    {{.path = "lines.rest",
      .what = "`drawn`: lines add cloth, rest angles stay; `copied`: they turn, too; `flat`: lines only push "
              "it out; `keep`: as `drawn`, then the garment's shape is made its equilibrium "
              "([rest-state.md](rest-state.md))",
      .usual = "drawn"},
     own(Kind::choice, "`drawn`, `flat`, `copied`, `keep`", read_rest)},
    {{.path = "lines.rule", .what = as_wrinkle},
     choice<InsertionRule>(
         [](auto& s) -> auto& { return s.lines.back().options.insertion.rule; },
         {{"fold", InsertionRule::fold}, {"safe", InsertionRule::safe}, {"paper", InsertionRule::paper}})},
    {{.path = "lines.detail", .what = as_wrinkle},
     choice<Detail>([](auto& s) -> auto& { return s.lines.back().options.detail; },
                    {{"coarse", Detail::coarse}, {"normal", Detail::normal}, {"fine", Detail::fine}})},
    {{.path = "lines.flat_base", .what = as_wrinkle},
     yes_no(
         false, true, [](auto& s) -> auto& { return s.lines.back().options.flat_base; })},
    {{.path = "lines.fold_iterations", .what = as_wrinkle},
     whole(
         0, 100000, [](auto& s) -> auto& { return s.lines.back().options.fold_iterations; })},
    {{.path = "lines.region", .what = as_wrinkle},
     choice<SmoothingRegion>(
         [](auto& s) -> auto& { return s.lines.back().options.region; },
         {{"two-ring", SmoothingRegion::two_ring}, {"whole-mesh", SmoothingRegion::whole_mesh}})},
    {{.path = "lines.max_distance", .what = as_wrinkle},
     number(
         positive("m"), [](auto& s) -> auto& { return s.lines.back().options.insertion.max_distance; })},
    {{.path = "lines.iterations", .what = as_wrinkle},
     whole(
         0, 100000, [](auto& s) -> auto& { return s.lines.back().options.smoothing.iterations; })},
    {{.path = "lines.lambda", .what = as_wrinkle},
     number(
         positive(), [](auto& s) -> auto& { return s.lines.back().options.smoothing.lambda; })},
    {{.path = "lines.mu", .what = as_wrinkle},
     number(
         Limits{-no_limit, 0}, [](auto& s) -> auto& { return s.lines.back().options.smoothing.mu; })},
    {{.path = "lines.weights", .what = as_wrinkle},
     choice<SmoothingWeights>(
         [](auto& s) -> auto& { return s.lines.back().options.smoothing.weights; },
         {{"uniform", SmoothingWeights::uniform}, {"cotangent", SmoothingWeights::cotangent}})},
    {{.path = "lines.keep_lines", .what = as_wrinkle},
     yes_no(
         LineRule::free, LineRule::keep,
         [](auto& s) -> auto& { return s.lines.back().options.smoothing.lines; })},
    {{.path = "lines.keep_border", .what = as_wrinkle},
     yes_no(
         BorderRule::free, BorderRule::keep,
         [](auto& s) -> auto& { return s.lines.back().options.smoothing.border; })},

    // [[pins]]: a flag adds a set of its own
    {{.path = "pins.box",
      .flag = "--pin-box",
      .help = "hold the vertices in a box x0,y0,z0,x1,y1,z1 [m, y up]; may be given again",
      .shown_in = used_by::all,
      .what = "the vertices in `[x0, y0, z0, x1, y1, z1]`",
      .flag_in = used_by::all},
     own(Kind::list, "6 numbers [m]",
         [](SettingsTable& table, const char* key, Scene& s) { table.read(key, s.pins.back().box, 6); })},
    {{.path = "pins.loop",
      .flag = "--pin-loop",
      .help = "hold a boundary loop: top, bottom, or its index (the longest is 0)",
      .shown_in = used_by::all,
      .what = "a boundary loop: top, bottom or an index (the longest is 0)",
      .flag_in = used_by::all},
     own(Kind::text, "text, or whole number",
         [](SettingsTable& table, const char* key, Scene& s) {
           table.read_name_or_index(key, s.pins.back().loop);
         })},
    {{.path = "pins.group",
      .flag = "--pin-group",
      .help = "hold the vertices of a group, by its name",
      .shown_in = used_by::all,
      .what = "the vertices of a group, by its name",
      .flag_in = used_by::all},
     text([](auto& s) -> auto& { return s.pins.back().group; })},
    {{.path = "pins.vertices",
      .flag = "--pin-vertices",
      .help = "hold vertices, by their indices from 0: 0,12,40; may be given again",
      .what = "vertices, by their indices from 0",
      .flag_in = used_by::all},
     own(Kind::list, "whole numbers",
         [](SettingsTable& table, const char* key, Scene& s) {
           table.read(key, s.pins.back().vertices, 0, 1 << 30);
         })},
    {{.path = "pins.motion", .what = "see below", .usual = "held", .used = used_by::moving},
     own(Kind::table, "table",
         [](SettingsTable& table, const char* key, Scene& s) {
           read_motion(table, key, s.pins.back().motion);
         })},

    // The root
    {{.path = "title", .what = "for people", .used = used_by::nobody},
     text([](auto& s) -> auto& { return s.title; })},
    {{.path = "unit",
      .flag = "--unit",
      .what = "of the mesh and stroke files",
      .usual = "what the garment's PLY notes, else m",
      .flag_in = used_by::nobody},
     choice<Word>([](auto& s) -> auto& { return s.unit; },
                  {{"m", "m"}, {"cm", "cm"}, {"mm", "mm"}, {"inch", "inch"}})},
    {{.path = "up",
      .flag = "--up",
      .what = "their upward axis",
      .usual = "what the garment's PLY notes, else y",
      .flag_in = used_by::nobody},
     choice<Word>([](auto& s) -> auto& { return s.up; }, {{"y", "y"}, {"z", "z"}})},
};

/// "the end of the simulation [s] (default 2)", where a row says no more.
std::string usual_help(const Setting& s) {
  std::string text = s.what;
  std::erase(text, '`');
  if (const std::size_t unit = s.range.find(" ["); unit != s.range.npos) text += s.range.substr(unit);
  return text + " (default " + s.usual + ")";
}

std::vector<Setting> all_settings() {
  std::vector<Setting> list;
  for (const Row<Scene>& row : rows) list.push_back(row.setting);
  for (const Setting& setting : settings_of_motion()) list.push_back(setting);
  for (Setting& setting : list)
    if (!setting.flag.empty() && setting.help.empty()) setting.help = usual_help(setting);
  return list;
}

/// Whether the table says it; rest = "stored" is what all do.
bool is_said(const Json& table, const Setting& setting) {
  if (!table.is_object() || !table.contains(setting.key())) return false;
  return setting.path != "garment.rest" || table["rest"] == "keep";
}

}  // namespace

std::string Setting::table() const {
  const std::size_t dot = path.rfind('.');
  return dot == path.npos ? "" : path.substr(0, dot);
}

std::string Setting::key() const { return path.substr(path.rfind('.') + 1); }

std::string Setting::long_flag() const { return flag.substr(flag.find("--")); }

const std::vector<Setting>& scene_settings() {
  static const std::vector<Setting> list = all_settings();
  return list;
}

const std::vector<SettingTable>& setting_tables() {
  static const std::vector<SettingTable> list = {{"", ""},
                                                 {"garment", "[garment]"},
                                                 {"lines", "[[lines]]"},
                                                 {"body", "[body]"},
                                                 {"material", "[material]"},
                                                 {"pins", "[[pins]]"},
                                                 {"forces", "[forces]"},
                                                 {"simulation", "[simulation]"},
                                                 {"output", "[output]"},
                                                 {"motion", "motion"},
                                                 {"keyframes", ""},
                                                 {"spin", ""},
                                                 {"gusts", ""}};
  return list;
}

const Setting* find_setting(std::string_view path) {
  const auto& list = scene_settings();
  const auto found = std::find_if(list.begin(), list.end(), [&](const Setting& s) { return s.path == path; });
  return found == list.end() ? nullptr : &*found;
}

void read_settings(SettingsTable& table, const std::string& name, Scene& scene) {
  read_rows<Scene>(table, name, rows, scene);
}

void read_setting(SettingsTable& table, const std::string& path, Scene& scene) {
  for (const Row<Scene>& row : rows)
    if (row.setting.path == path) row.read(table, row.key.c_str(), scene);
}

std::string tables_of_key(std::string_view key) {
  std::string found;
  for (const SettingTable& table : setting_tables())
    if (!table.heading.empty() && find_setting(table.name + "." + std::string(key)))
      found += (found.empty() ? "" : " or ") + table.heading;
  return found;
}

std::vector<std::string> settings_without_use(const TomlDocument& document, unsigned subcommand) {
  std::vector<std::string> plain, listed;
  for (const SettingTable& table : setting_tables()) {
    if (!document.root.contains(table.name) || document.root[table.name].empty()) continue;
    const Json& node = document.root[table.name];
    bool is_used = false;
    std::vector<std::string> idle;
    for (const Setting& setting : scene_settings()) {
      if (setting.table() != table.name) continue;
      is_used = is_used || (setting.used & subcommand);
      if (setting.used & subcommand) continue;
      if (is_said(node, setting)) idle.push_back(setting.path);
      for (std::size_t i = 0; node.is_array() && i < node.size(); ++i)
        if (is_said(node[i], setting))
          listed.push_back(table.name + "." + std::to_string(i) + "." + setting.key());
    }
    if (!is_used) idle = {table.name};
    plain.insert(plain.end(), idle.begin(), idle.end());
  }
  plain.insert(plain.end(), listed.begin(), listed.end());
  return plain;
}

}  // namespace furrow::io
