// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/common.h"
#include "cli/judge_report.h"
#include "cli/recorded_material.h"
#include "cli/scene_flags.h"
#include "cli/scene_input.h"
#include "cli/scene_run.h"
#include "cli/subcommands.h"
#include "geometry/mesh/errors.h"
#include "io/animation/animation_file.h"
#include "io/scene/scene_file.h"
#include "io/scene/state_file.h"

namespace furrow::cli {
namespace {

struct SimulateArguments : CommonArguments {
  std::string in, state;
  double budget = 60;
  CLI::Option* budget_option = nullptr;
  SceneFlags flags;
};

/// Files that are read; no output may replace one, but the garment itself, by its result.
std::vector<std::string> inputs(const io::Scene& scene, const SimulateArguments& a) {
  std::vector<std::string> files;
  if (is_scene(a.in)) files.push_back(a.in);
  if (scene.body)
    for (const auto& path : {scene.body->mesh, scene.body->field, scene.body->frames})
      files.push_back(path.string());
  for (const io::SceneLines& lines : scene.lines) files.push_back(lines.strokes.string());
  std::erase(files, "");
  return files;
}

/// Folders that a scene file names are made, so that a fresh copy of it runs; those of flags must be there.
void make_folders(const io::Scene& scene, const io::TomlDocument& document) {
  const io::SceneOutput& out = scene.output;
  const std::pair<const char*, std::filesystem::path> outputs[] = {
      {"mesh", out.mesh},         {"state", out.state},         {"inserted", out.inserted},
      {"smoothed", out.smoothed}, {"animation", out.animation}, {"body", out.body}};
  for (const auto& [key, path] : outputs)
    if (!path.parent_path().empty() && document.is_of_file("output." + std::string(key)))
      std::filesystem::create_directories(path.parent_path());
}

void check_output_formats(const io::SceneOutput& out, bool has_body) {
  for (const auto& path : {out.mesh, out.inserted, out.smoothed, out.body})
    if (!path.empty()) check_output(path.string());
  for (const auto& path : {out.inserted, out.smoothed, out.body})
    if (path == "-") throw UsageError("only the garment at the end (-o) can go to standard output");
  if (!out.animation.empty() && !io::animation_format(out.animation))
    throw UsageError(out.animation.string() + ": the ending names no animation; choose pc2, mdd or glb");
  check_folder(out.animation.string());
  if (!out.state.empty() && out.state.extension() != ".ply")
    throw UsageError(out.state.string() + ": a state is a .ply file");
  if (!out.state.empty()) check_output(out.state.string());
  if (!out.body.empty() && !has_body) throw UsageError("--save-body: there is no body; name one with --body");
}

/// What can be known to fail is said before the work.
void check_outputs(const io::Scene& scene, const SimulateArguments& a) {
  const io::SceneOutput& out = scene.output;
  if (out.mesh.empty() && out.state.empty() && out.animation.empty() && (a.quiet || !is_scene(a.in)))
    throw UsageError("nothing to write: name --output, --save-state or --animation");
  check_output_formats(out, scene.body.has_value());
  const std::vector<std::string> read = inputs(scene, a);
  std::vector<std::string> written;
  for (const auto& path : {out.mesh, out.state, out.inserted, out.smoothed, out.animation, out.body}) {
    if (path.empty() || path == "-") continue;
    for (const std::string& other : read) refuse_same(path.string(), other);
    if (path != out.mesh) refuse_same(path.string(), scene.garment.string());
    if (path != out.state) refuse_same(path.string(), a.state);
    for (const std::string& other : written) refuse_same(path.string(), other);
    written.push_back(path.string());
  }
}

/// Integrator and step for --tolerance 1%: sets them in document and scene and returns the judgement. Builds
/// the scene's body, if it has one, for the run, too.
Judgement choose_setting(const SimulateArguments& a, const CommonArguments& common,
                         std::shared_ptr<WorldBody>& body, io::TomlDocument& document, io::Scene& scene,
                         const std::filesystem::path& folder) {
  const JudgeOptions options{parse_share(a.flags.accuracy(), "--tolerance"), a.budget};
  check(options);
  if (scene.body) body = std::make_shared<WorldBody>(*scene.body, common);
  CommonArguments silent = common;  // the run itself warns
  silent.quiet = true;
  const SceneCloth cloth = prepare_scene(scene, silent, body);
  const Judgement j = judge(cloth, cloth.world(scene), options, common);
  if (exit_code_of(j) != exit_ok) return j;
  set_candidate(document, j.candidates[static_cast<std::size_t>(j.chosen)].candidate);
  scene = scene_of(document, folder);
  return j;
}

int simulate(SimulateArguments& a) {
  std::optional<io::SavedState> state;
  if (!a.state.empty()) state = io::read_state(a.state);
  io::TomlDocument document = scene_settings(a.in, a.state, state, a.flags, a);
  const std::filesystem::path folder = std::filesystem::path(is_scene(a.in) ? a.in : a.state).parent_path();
  io::Scene scene = scene_of(document, folder);
  if (!state && take_recorded_material(document, scene.garment, &a)) scene = scene_of(document, folder);
  if (state && !a.flags.accuracy().empty())
    throw UsageError("--tolerance " + a.flags.accuracy() +
                     " judges a scene from its beginning; leave it or --state away");
  if (a.flags.accuracy().empty() && a.budget_option->count())
    throw UsageError("--budget bounds the choice for --tolerance 1%; give that, too, or leave --budget away");
  if (scene.garment.empty() && !state) throw UsageError(document.name + ": garment.mesh is missing");
  if (state && scene.subdivide != state->scene.value("garment", io::Json::object()).value("subdivide", 0))
    throw UsageError("--subdivide: the garment of a state is in motion; refine it before the first step");
  if (state &&
      scene.keep != (state->scene.value("garment", io::Json::object()).value("rest", "stored") == "keep"))
    throw UsageError("--rest: the garment of a state is in motion; furrow keep --state keeps its shape");
  for (const char* key : {"simulation.integrator", "simulation.dt", "simulation.sweeps", "simulation.newton"})
    if (!a.flags.accuracy().empty() && document.place(key).rfind("--", 0) == 0)
      throw UsageError("--tolerance " + a.flags.accuracy() + " chooses integrator and step, and " +
                       document.place(key) + " names one; leave one of them away");
  check_inputs(scene, document, state ? state->lines_drawn : -1);
  if (!state) take_noted_frame(scene, document);
  if (is_scene(a.in)) make_folders(scene, document);
  check_outputs(scene, a);
  CommonArguments common = a;
  common.unit = scene.unit;
  common.up = scene.up;
  common.out = scene.output.mesh.string();
  Json choice;
  std::shared_ptr<WorldBody> body;
  if (!a.flags.accuracy().empty()) {
    const bool scene_dt = scene.simulation.dt.has_value();
    const Judgement j = choose_setting(a, common, body, document, scene, folder);
    if (const int code = exit_code_of(j); code != exit_ok) {
      std::cerr << "error: " << a.in << ": " << words(j, scene_dt) << "\n";
      return code;
    }
    choice = to_json(j, scene_dt);
  }
  return run_scene(scene, document, folder, std::move(state), a.state, common, body, choice);
}

}  // namespace

void add_simulate(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<SimulateArguments>();
  CLI::App* sub =
      app.add_subcommand("simulate",
                         "Let a garment hang, fall and rest on a body\n\n"
                         "  furrow simulate sheet.ply --pin-box -0.5,0,-1,-0.5,1,1 -o hung.ply\n"
                         "  furrow simulate wrinkled.ply --body body.obj -o worn.ply\n"
                         "  furrow simulate scenes/skirt.toml --set material.bending=1\n"
                         "  furrow simulate wrinkled.ply --body body.obj --stop-at 1 --save-state at1.ply\n"
                         "  furrow simulate --state at1.ply -o worn.ply");
  sub->add_option(
      "garment", a->in,
      "garment to read (PLY of furrow wrinkle brings rest lengths and masses), or a scene: a .toml file");
  sub->add_option("--state", a->state, "go on from a saved state");
  a->flags.add_to(*sub, io::used_by::simulate);
  a->budget_option = sub->add_option(
      "--budget", a->budget,
      "predicted seconds of one thread that choosing for --tolerance 1% may take [s] (default 60)");
  add_common_options(*sub, *a);
  sub->callback([a, &exit_code] { exit_code = simulate(*a); });
}

}  // namespace furrow::cli
