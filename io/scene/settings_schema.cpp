// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/settings_schema.h"

#include <nlohmann/json.hpp>
#include <regex>
#include <tuple>

#include "io/mesh/mesh_file.h"
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
      .keyword = "output",
      .shown_in = used_by::all,
      .what = "the garment at the end: " + mesh_formats() + "; - is OBJ to standard output",
      .used = used_by::moving},
     path(FIELD(output.mesh))},
    {{.path = "output.state",
      .keyword = "save_state",
      .shown_in = used_by::moving,
      .what = "the state at the end (a PLY), to go on from",
      .used = used_by::moving},
     path(FIELD(output.state))},
    {{.path = "output.checkpoint",
      .what = "clock time between two states written on the way to `state`: a killed run costs no more",
      .used = used_by::moving},
     number(FIELD(output.checkpoint), positive("s"))},
    {{.path = "output.inserted",
      .what = "the garment with the lines of time 0 inserted",
      .used = used_by::moving},
     path(FIELD(output.inserted))},
    {{.path = "output.smoothed",
      .what = "the garment after the lines of time 0 were smoothed",
      .used = used_by::moving},
     path(FIELD(output.smoothed))},
    {{.path = "output.settled",
      .what = "the garment at rest, before it moves (with `settle`)",
      .used = used_by::simulate,
      .flag_in = used_by::simulate},
     path(FIELD(output.settled))},
    {{.path = "output.animation",
      .shown_in = used_by::simulate,
      .what = "its motion: pc2, mdd or glb ([animations.md](animations.md))",
      .used = used_by::moving},
     path(FIELD(output.animation))},
    {{.path = "output.body",
      .keyword = "save_body",
      .what = "the body where it is at the end: a mesh",
      .used = used_by::moving},
     path(FIELD(output.body))},
    {{.path = "output.fps",
      .shown_in = used_by::simulate,
      .what = "frames a second of the animation",
      .used = used_by::moving},
     number(FIELD(output.fps), positive("1/s"))},

    // [simulation]: its end
    {{.path = "simulation.seconds",
      .shown_in = used_by::simulate,
      .what = "the end of the simulation",
      .used = used_by::moving},
     number(FIELD(simulation.seconds), not_negative("s"))},
    {{.path = "simulation.settle",
      .shown_in = used_by::simulate,
      .what = "the garment, with the lines of time 0, comes to rest before it moves, on body and pins as "
              "they lie at time 0, as `furrow drape` does it but without contact of cloth with cloth; with "
              "`seconds` 0 that is all",
      .used = used_by::simulate | used_by::keep,
      .flag_in = used_by::simulate},
     yes_no(FIELD(settle), false, true)},
    {{.path = "simulation.starts",
      .shown_in = used_by::drape,
      .what = "looks for rest from so many starts, each with noise of its own, writes the rest with the "
              "lowest energy, and reports each number as mean and spread",
      .used = used_by::drape,
      .flag_in = used_by::drape},
     whole(FIELD(starts), 1, 1000)},
    {{.path = "simulation.stop_at",
      .shown_in = used_by::simulate,
      .what = "stops earlier, at this time, and keeps the plan in the state",
      .used = used_by::moving},
     number(FIELD(stop_at), not_negative("s"))},

    // [material]
    {{.path = "material.density",
      .what = "mass of the cloth",
      .usual = "the fabric's; of springs the file's, else 0.15"},
     number(FIELD(material.density), positive("kg/m^2"))},
    {{.path = "material.preset",
      .keyword = "fabric",
      .shown_in = used_by::all,
      .what = "a measured fabric: cotton, silk, denim, … (`furrow fabric list`), or a file of `furrow fabric "
              "fit` (.toml); the keys beside it override it",
      .usual = "what the garment's PLY notes; else cotton, where no other key says what the cloth is",
      .flag_in = used_by::all},
     choice<std::string>(FIELD(material.preset), fabric_names())},
    {{.path = "material.warp",
      .what = "where the warp of cloth with threads runs: file (the map in its PLY), texture (as v grows), "
              "texture-u, x, y or z (that axis on each face), a stroke file (the warp runs so), or none (the "
              "same in all directions) ([threads.md](threads.md))",
      .usual = "auto: the map in the garment's PLY, else the texture, else y",
      .flag_in = used_by::moving | used_by::drape},
     own(Kind::text, "text", read_warp)},
    {{.path = "material.warp_stretch",
      .keyword = "",
      .what = "Young's modulus times thickness of strips along the warp; makes cloth with threads, with the "
              "five below, of a `preset` or of all six"},
     number(FIELD(material.warp_stretch), positive("N/m"))},
    {{.path = "material.weft_stretch", .keyword = "", .what = "the same along the weft"},
     number(FIELD(material.weft_stretch), positive("N/m"))},
    {{.path = "material.thread_shear",
      .keyword = "",
      .what = "shear modulus times thickness of cloth with threads"},
     number(FIELD(material.thread_shear), positive("N/m"))},
    {{.path = "material.thread_poisson",
      .keyword = "",
      .what = "ν₁₂: how much a strip along the warp narrows as it stretches"},
     number(FIELD(material.thread_poisson), any())},
    {{.path = "material.warp_rigidity", .keyword = "", .what = "B of strips along the warp"},
     number(FIELD(material.warp_rigidity), positive("N m"))},
    {{.path = "material.weft_rigidity", .keyword = "", .what = "B of strips along the weft"},
     number(FIELD(material.weft_rigidity), positive("N m"))},
    {{.path = "material.bias_rigidity", .keyword = "", .what = "B of strips cut at 45°"},
     number(FIELD(material.bias_rigidity), positive("N m"))},
    {{.path = "material.membrane",
      .what = "what resists stretching, in place of a fabric: triangles (of constant strain, as fabrics "
              "are), patches (the same with the mean strain around each vertex, which does not lock in fine "
              "folds; drape alone), tension (quadratic and asymmetric, paper 2), or springs: paper (by the "
              "paper's law), uniform, inverse, van-gelder",
      .flag_in = used_by::all},
     choice<Membrane>(FIELD(material.membrane),
                      {std::begin(bridge::membrane_words), std::end(bridge::membrane_words)})},
    {{.path = "material.bending_law",
      .what = "what resists bending, in place of a fabric: plate (hinges coupled to one plate, as fabrics "
              "are), hinge (each edge by itself), cosine (the law of paper 2), or cross (springs across the "
              "edges) ([bending.md](bending.md))",
      .flag_in = used_by::all},
     choice<Bending>(FIELD(material.bending_law), {{"cross", Bending::cross},
                                                   {"hinge", Bending::hinge},
                                                   {"cosine", Bending::cosine},
                                                   {"plate", Bending::plate}})},
    {{.path = "material.stretch",
      .what = "Young's modulus times thickness; √3/2 of it stands in place of `stiffness`",
      .usual = "the fabric's; of springs none",
      .flag_in = used_by::all},
     number(FIELD(material.stretch), positive("N/m"))},
    {{.path = "material.poisson", .keyword = "", .what = "Poisson's ratio of `triangles`; below 1"},
     number(FIELD(material.poisson), Limits{-1, 1, true})},
    {{.path = "material.rigidity",
      .what = "bending rigidity B of hinges, or of a plate",
      .usual = "the fabric's; without one 1e-5",
      .flag_in = used_by::all},
     number(FIELD(material.rigidity), not_negative("N m"))},
    {{.path = "material.tension",
      .what = "of the membrane tension: force a metre of width at strain 1",
      .usual = "50 · `stretch`",
      .flag_in = used_by::all},
     number(FIELD(material.tension), positive("N/m"))},
    {{.path = "material.compression", .keyword = "", .what = "share of `tension` that pushes"},
     number(FIELD(material.compression), Limits{0, 1})},
    {{.path = "material.shear", .keyword = "", .what = "share of `tension` that a diagonal has"},
     number(FIELD(material.shear), Limits{0, 1})},
    {{.path = "material.stiffness",
      .what = "in place of a fabric: k_std of the structural springs",
      .flag_in = used_by::all},
     number(FIELD(material.stiffness), positive("N/m"))},
    {{.path = "material.bending", .what = "k_std of the bending springs"},
     number(FIELD(material.bending), not_negative("N/m"))},
    {{.path = "material.mass_rule",
      .keyword = "",
      .what = "mass by area, or the same for each vertex: the garment's over its vertices (paper 2)"},
     choice<MassRule>(FIELD(material.mass_rule), {{"area", MassRule::area}, {"equal", MassRule::equal}})},
    {{.path = "material.line_stretch",
      .what = "of a chain (a garment of lines without faces): Young's modulus times cross-section",
      .usual = "the file's, else 1000",
      .used = used_by::simulate,
      .flag_in = used_by::simulate},
     number(FIELD(material.line_stretch), positive("N"))},
    {{.path = "material.line_density",
      .what = "mass of a chain",
      .usual = "the file's, else 0.01",
      .used = used_by::simulate,
      .flag_in = used_by::simulate},
     number(FIELD(material.line_density), positive("kg/m"))},
    {{.path = "material.damping",
      .what = "damping of each spring, as a share of critical",
      .used = used_by::moving},
     number(FIELD(simulation.spring_damping), not_negative())},
    {{.path = "material.drag", .what = "air drag", .used = used_by::moving},
     number(FIELD(simulation.air_drag), not_negative("1/s"))},
    {{.path = "material.friction",
      .shown_in = used_by::all,
      .what = "Coulomb friction with the body",
      .usual = "the fabric's, else 0.3",
      .flag_in = used_by::all},
     number(FIELD(simulation.friction), not_negative())},
    {{.path = "material.cloth_friction",
      .what = "Coulomb friction of cloth on cloth, where layers and folds are kept apart",
      .used = used_by::drape | used_by::simulate,
      .flag_in = used_by::drape | used_by::simulate},
     number(FIELD(simulation.self.friction), not_negative())},
    {{.path = "material.gap",
      .shown_in = used_by::all,
      .what = "distance that the cloth keeps from the body; raised to what the mesh and the field need",
      .flag_in = used_by::all},
     number(FIELD(simulation.contact_gap), positive("m"))},

    // [forces]
    {{.path = "forces.gravity",
      .what = "acceleration downwards, or as a vector x,y,z",
      .usual = "9.81",
      .flag_in = used_by::all},
     own(Kind::vector, "number, or [x, y, z] [m/s^2]", read_gravity)},
    {{.path = "forces.wind",
      .shown_in = used_by::moving,
      .what = "velocity x,y,z of the air; acts through `drag`",
      .used = used_by::moving},
     vector(FIELD(wind.velocity), "m/s")},
    {{.path = "forces.gusts",
      .keyword = "",
      .what = "`[{time, factor}, …]` of the wind, linear between",
      .usual = "1",
      .used = used_by::moving},
     own(Kind::table, "tables",
         [](SettingsTable& table, const char* key, Scene& s) { read_gusts(table, key, s.wind.gusts); })},
    {{.path = "forces.swirl",
      .keyword = "",
      .what = "air that turns like a rigid body; as `spin` below",
      .used = used_by::moving},
     own(Kind::table, "table",
         [](SettingsTable& table, const char* key, Scene& s) { s.wind.swirl = read_spin(table, key); })},

    // [simulation]: its steps
    {{.path = "simulation.dt",
      .what = "time step",
      .usual = "0.9 of the limit; 1/60 with implicit and tr-bdf2, 1/1200 with xpbd, which have none",
      .used = used_by::moving},
     number(FIELD(simulation.dt), positive("s"))},
    {{.path = "simulation.force_dt",
      .what = "takes `dt` although it is above the stability limit",
      .used = used_by::moving},
     yes_no(FIELD(simulation.step_rule), StepRule::limited, StepRule::forced)},
    {{.path = "simulation.integrator",
      .shown_in = used_by::simulate,
      .what =
          "the scheme of its steps: auto (leapfrog, or implicit where that takes less than half of its time; "
          "keep: implicit), leapfrog, implicit, tr-bdf2, rk4, or xpbd",
      .used = used_by::moving},
     choice<std::optional<Integrator>>(FIELD(integrator),
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
      .what = "sweeps of xpbd over all springs a step; few make the cloth softer",
      .used = used_by::moving},
     whole(FIELD(simulation.xpbd.iterations), 1, 100000)},
    {{.path = "simulation.self_contact",
      .shown_in = used_by::moving,
      .what = "`on`: cloth keeps off cloth, and no step passes through it",
      .usual = "on where the body changes its shape, else off",
      .used = used_by::simulate,
      .flag_in = used_by::simulate},
     choice<bool>(FIELD(simulation.self.on), {{"off", false}, {"on", true}})},
    {{.path = "simulation.thickness",
      .keyword = "cloth_thickness",
      .what = "of the cloth, with `self_contact`: layers are so far apart",
      .used = used_by::simulate,
      .flag_in = used_by::simulate},
     number(FIELD(simulation.self.thickness), positive("m"))},
    {{.path = "simulation.threads",
      .what = "how many share the work; the result does not depend on them",
      .usual = "one for each 10,000 vertices, at most all cores; `furrow drape`: all cores",
      .flag_in = used_by::moving | used_by::drape},
     whole(FIELD(threads), 1, 256)},

    // [garment]
    {{.path = "garment.mesh", .keyword = "", .what = mesh_formats(true), .usual = "must be there"},
     path(FIELD(garment))},
    {{.path = "garment.subdivide",
      .shown_in = used_by::moving,
      .what = "refines the garment so many times (Loop) before the first line"},
     whole(FIELD(subdivide), 0, 4)},
    {{.path = "garment.layer",
      .keyword = "",
      .what = "of several `[[garment]]`, which one is worn over which: the innermost has the lowest number",
      .usual = "their order in the file",
      .used = used_by::drape},
     whole(FIELD(layer), 0, 1000)},
    {{.path = "garment.thickness",
      .keyword = "",
      .what = "of the cloth, where layers and folds are kept apart; `simulation.thickness` overrides it",
      .usual = "0.001",
      .used = used_by::drape},
     number(FIELD(thickness), Limits{1e-5, 0.05, false, "m"})},
    {{.path = "garment.touch",
      .keyword = "",
      .what = "of several `[[garment]]`, `false`: the others pass through it, and it through them",
      .used = used_by::drape},
     yes_no(FIELD(touch), false, true)},
    {{.path = "garment.attach",
      .keyword = "",
      .what = "`false`: what lies on other cloth (buttons, pockets, inner sides, ends of straps) is not held "
              "to it"},
     yes_no(FIELD(attach.on), false, true)},
    {{.path = "garment.attach_parts",
      .keyword = "",
      .what = "parts that go with the cloth nearest to them, however far off: names of groups, or `part 2` "
              "(`furrow info`)"},
     plain(FIELD(attach.parts), Kind::list, "text, or texts")},
    {{.path = "garment.free_parts", .keyword = "", .what = "parts that do not, whatever they lie on"},
     plain(FIELD(attach.free), Kind::list, "text, or texts")},
    {{.path = "garment.join", .keyword = "", .what = "`false`: seams that the file leaves open stay open"},
     yes_no(FIELD(join), false, true)},
    {{.path = "garment.allow_crossings",
      .what = "pairs of faces of the cloth that may cross at the end; beyond it the exit code is 4",
      .used = used_by::simulate | used_by::drape,
      .flag_in = used_by::simulate | used_by::drape},
     whole(FIELD(allow_crossings), 0, 1000000000)},
    {{.path = "garment.rest",
      .what = "`stored`: the rest state that the file has; `keep`: that which holds the shape that the "
              "garment has at time 0 ([keep.md](keep.md))",
      .used = used_by::moving},
     choice<bool>(FIELD(keep), {{"stored", false}, {"keep", true}})},
    {{.path = "garment.velocity",
      .what = "velocity x,y,z of the garment at time 0, after `settle`; pinned vertices keep theirs",
      .used = used_by::simulate,
      .flag_in = used_by::simulate},
     vector(FIELD(velocity), "m/s")},

    // [body]
    {{.path = "body.mesh",
      .keyword = "body",
      .shown_in = used_by::all,
      .what = "the body that the garment rests on",
      .usual = "must be there",
      .flag_in = used_by::all},
     path(FIELD(body->mesh))},
    {{.path = "body.unit",
      .keyword = "body_unit",
      .what =
          "unit of the body's file and its frames, where it is not that of the garment's: m, cm, mm or inch",
      .usual = "that of all files",
      .flag_in = used_by::all},
     choice<Word>(FIELD(body->unit), {{"m", "m"}, {"cm", "cm"}, {"mm", "mm"}, {"inch", "inch"}})},
    {{.path = "body.frames",
      .keyword = "body_frames",
      .what = "motion of a body that changes its shape: a PC2 or MDD file, or OBJ files as `name_####.obj`"},
     path(FIELD(body->frames))},
    {{.path = "body.fps", .keyword = "body_fps", .what = "frames a second of OBJ files", .usual = "25"},
     number(FIELD(body->fps), positive("1/s"))},
    {{.path = "body.cache",
      .what = "folder in which what is made of bodies' files (mended surface, field, skeleton) is kept for "
              "other runs ([batches.md](batches.md)); results are the same without",
      .usual = "nothing is kept",
      .flag_in = used_by::all},
     path(FIELD(body->cache))},
    {{.path = "body.tolerance",
      .what = "error of the body's distance field",
      .usual = "1/1000 of the body's diagonal, at most 0.002"},
     number(FIELD(body->options.tolerance), positive("m"))},
    {{.path = "body.gradient",
      .what = "gradient of the field: exact (of the interpolated distance) or interpolated (of the corners', "
              "as in paper 1)"},
     choice<GradientRule>(
         FIELD(body->options.gradient),
         {{"exact", GradientRule::exact_derivative}, {"interpolated", GradientRule::interpolated_corners}})},
    {{.path = "body.collider",
      .keyword = "",
      .what = "of a body with frames: exact distances, or depth maps from six sides, which do not see all "
              "([decision 18](../decisions/0018-depth-maps.md))"},
     choice<bool>(FIELD(body->depth_maps), {{"exact", false}, {"depth-maps", true}})},
    {{.path = "body.motion", .keyword = "", .what = "of a rigid body, see below"},
     own(Kind::table, "table",
         [](SettingsTable& table, const char* key, Scene& s) { read_motion(table, key, s.body->motion); })},

    // [[lines]]
    {{.path = "lines.strokes",
      .what = "strokes to draw ([strokes.md](strokes.md))",
      .usual = "must be there"},
     path(FIELD(lines.back().strokes))},
    {{.path = "lines.time", .what = "when they are drawn"},
     number(FIELD(lines.back().time), not_negative("s"))},
    {{.path = "lines.height", .what = "of strokes that name none"},
     number(FIELD(lines.back().height), any("m"))},
    {{.path = "lines.fade", .what = "how slowly the forces of lines drawn later set in; inf: never"},
     number(FIELD(lines.back().fade), Limits{0, no_limit, true, "s", true})},
    {{.path = "lines.without", .what = "names of strokes to leave out"},
     plain(FIELD(lines.back().without), Kind::list, "text, or texts")},
    {{.path = "lines.rest",
      .what = "`drawn`: lines add cloth, rest angles stay; `copied`: they turn, too; `flat`: lines only push "
              "it out; `keep`: as `drawn`, then the garment's shape is made its equilibrium "
              "([rest-state.md](rest-state.md))",
      .usual = "drawn"},
     own(Kind::choice, "`drawn`, `flat`, `copied`, `keep`", read_rest)},
    {{.path = "lines.rule", .what = as_wrinkle},
     choice<InsertionRule>(
         FIELD(lines.back().options.insertion.rule),
         {{"fold", InsertionRule::fold}, {"safe", InsertionRule::safe}, {"paper", InsertionRule::paper}})},
    {{.path = "lines.detail", .what = as_wrinkle},
     choice<Detail>(FIELD(lines.back().options.detail),
                    {{"coarse", Detail::coarse}, {"normal", Detail::normal}, {"fine", Detail::fine}})},
    {{.path = "lines.flat_base", .what = as_wrinkle},
     yes_no(FIELD(lines.back().options.flat_base), false, true)},
    {{.path = "lines.fold_iterations", .what = as_wrinkle},
     whole(FIELD(lines.back().options.fold_iterations), 0, 100000)},
    {{.path = "lines.region", .what = as_wrinkle},
     choice<SmoothingRegion>(
         FIELD(lines.back().options.region),
         {{"two-ring", SmoothingRegion::two_ring}, {"whole-mesh", SmoothingRegion::whole_mesh}})},
    {{.path = "lines.max_distance", .what = as_wrinkle},
     number(FIELD(lines.back().options.insertion.max_distance), positive("m"))},
    {{.path = "lines.iterations", .what = as_wrinkle},
     whole(FIELD(lines.back().options.smoothing.iterations), 0, 100000)},
    {{.path = "lines.lambda", .what = as_wrinkle},
     number(FIELD(lines.back().options.smoothing.lambda), positive())},
    {{.path = "lines.mu", .what = as_wrinkle},
     number(FIELD(lines.back().options.smoothing.mu), Limits{-no_limit, 0})},
    {{.path = "lines.weights", .what = as_wrinkle},
     choice<SmoothingWeights>(
         FIELD(lines.back().options.smoothing.weights),
         {{"uniform", SmoothingWeights::uniform}, {"cotangent", SmoothingWeights::cotangent}})},
    {{.path = "lines.keep_lines", .what = as_wrinkle},
     yes_no(FIELD(lines.back().options.smoothing.lines), LineRule::free, LineRule::keep)},
    {{.path = "lines.keep_border", .what = as_wrinkle},
     yes_no(FIELD(lines.back().options.smoothing.border), BorderRule::free, BorderRule::keep)},

    // [[pins]]: a flag adds a set of its own
    {{.path = "pins.box",
      .keyword = "pin_box",
      .shown_in = used_by::all,
      .what = "holds the vertices in a box x0,y0,z0,x1,y1,z1 (y up)",
      .flag_in = used_by::all},
     own(Kind::list, "6 numbers [m]",
         [](SettingsTable& table, const char* key, Scene& s) { table.read(key, s.pins.back().box, 6); })},
    {{.path = "pins.loop",
      .keyword = "pin_loop",
      .shown_in = used_by::all,
      .what = "holds a boundary loop: top, bottom, or its index (the longest is 0)",
      .flag_in = used_by::all},
     own(Kind::text, "text, or whole number",
         [](SettingsTable& table, const char* key, Scene& s) {
           table.read_name_or_index(key, s.pins.back().loop);
         })},
    {{.path = "pins.group",
      .keyword = "pin_group",
      .shown_in = used_by::all,
      .what = "holds the vertices of a group, by its name",
      .flag_in = used_by::all},
     text(FIELD(pins.back().group))},
    {{.path = "pins.vertices",
      .keyword = "pin_vertices",
      .what = "holds vertices, by their indices from 0: 0,12,40",
      .flag_in = used_by::all},
     own(Kind::list, "whole numbers",
         [](SettingsTable& table, const char* key, Scene& s) {
           table.read(key, s.pins.back().vertices, 0, 1 << 30);
         })},
    {{.path = "pins.motion", .keyword = "", .what = "see below", .usual = "held", .used = used_by::moving},
     own(Kind::table, "table",
         [](SettingsTable& table, const char* key, Scene& s) {
           read_motion(table, key, s.pins.back().motion);
         })},

    // The root
    {{.path = "title", .keyword = "", .what = "for people", .used = used_by::nobody}, text(FIELD(title))},
    {{.path = "unit",
      .what = "of the mesh and stroke files",
      .usual = "what the garment's PLY notes, else m",
      .flag_in = used_by::nobody},
     choice<Word>(FIELD(unit), {{"m", "m"}, {"cm", "cm"}, {"mm", "mm"}, {"inch", "inch"}})},
    {{.path = "up",
      .what = "their upward axis",
      .usual = "what the garment's PLY notes, else y",
      .flag_in = used_by::nobody},
     choice<Word>(FIELD(up), {{"y", "y"}, {"z", "z"}})},
};

std::vector<Setting> all_settings() {
  std::vector<Setting> list;
  for (const Row<Scene>& row : rows) list.push_back(row.setting);
  for (Setting& setting : list)
    if (setting.keyword == "=") setting.keyword = setting.table() == "lines" ? "" : setting.key();
  for (const Setting& setting : settings_of_motion()) {
    list.push_back(setting);
    list.back().keyword = "";
  }
  return list;
}

/// The setting with this key that has a flag, first of all in this table; null: there is none.
const Setting* find_flag(const std::string& key, const std::string& table) {
  const Setting* found = nullptr;
  for (const Setting& s : scene_settings())
    if (!s.keyword.empty() && s.key() == key && (!found || s.table() == table)) found = &s;
  return found;
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

std::string described(const Setting& setting, const std::function<std::string(const Setting&)>& name) {
  std::string text = std::regex_replace(setting.what, std::regex(R"( \(\[[^\]]*\]\([^)]*\)\))"), "");
  if (const std::size_t unit = setting.range.rfind(" ["); unit != setting.range.npos)
    text += setting.range.substr(unit);
  if (setting.table() == "pins") text += "; may be given again";
  const std::string& usual = setting.usual;
  if (setting.kind != Kind::yes_no && usual != "none" && usual != "must be there" && !usual.starts_with('['))
    text += " (default " + usual + ")";
  std::string words;
  bool is_key = false;
  for (std::size_t at = 0, end; at < text.size(); at = end + 1, is_key = !is_key) {
    end = std::min(text.find('`', at), text.size());
    const std::string word = text.substr(at, end - at);
    const Setting* named = is_key ? find_flag(word, setting.table()) : nullptr;
    words += named ? name(*named) : word;
  }
  return words;
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
    if (!document.root->contains(table.name) || document.root[table.name].empty()) continue;
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
