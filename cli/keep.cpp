// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "bridge/convert.h"
#include "bridge/gather.h"
#include "bridge/store_rest_state.h"
#include "cli/camera_options.h"
#include "cli/judge_report.h"
#include "cli/keep_at_rest.h"
#include "cli/keep_report.h"
#include "cli/prepare_garment.h"
#include "cli/recorded_material.h"
#include "cli/run_warnings.h"
#include "cli/scene_cloth.h"
#include "cli/scene_flags.h"
#include "cli/scene_input.h"
#include "cli/scene_run.h"
#include "cli/subcommands.h"
#include "geometry/mesh/errors.h"
#include "io/scene/relocated.h"
#include "physics/cloth/pins.h"

namespace furrow::cli {
namespace {

struct KeepArguments : CommonArguments {
  std::string in, state, picture;
  SceneFlags flags;
  CameraArguments camera;
  double run = 5, gust = 12;
  std::string kept = "95%";
  bool no_balance = false, no_help = false, whole = false;
};

/// The garment in its drawn shape, of a scene that draws at time 0 alone, or of a state.
SceneCloth drawn_garment(const io::Scene& scene, std::optional<io::SavedState>& state,
                         const CommonArguments& common) {
  if (!state) {
    io::Scene drawn = scene;  // what is kept, keep_lines() finds out
    drawn.keep = false;
    for (io::SceneLines& lines : drawn.lines) lines.keep = false;
    return prepare_scene(drawn, common);
  }
  SceneCloth result;
  result.file = state->file;
  result.pins = state->pins;
  if (scene.body) result.body = std::make_shared<WorldBody>(*scene.body, common);
  complete_garment(result.file, scene.material);
  result.cloth = bridge::gather(result.file.mesh, spring_options(result.file, scene.material));
  pin_cloth(result.cloth, result.pins, result.body.get(), state->simulation.time, common);
  result.options = scene.simulation;
  double& gap = result.options.contact_gap;
  const Json material = state->scene.value("material", Json::object());
  const bool settled = result.body && result.body->fingerprint() == state->body &&
                       material.value("gap", physics::SimulateOptions{}.contact_gap) == gap;
  if (!settled) state->contact_gap = 0;
  if (result.body)
    gap = state->contact_gap =
        std::max(state->contact_gap, contact_gap(gap, result.body->tolerance(), result.file));
  result.options.threads = threads_of(scene, result.cloth.particles.size());
  return result;
}

void check(const KeepArguments& a, const io::Scene& scene) {
  if (a.whole && a.no_help)
    throw UsageError("--whole is help for what lies between the lines; leave --no-help away");
  const io::SceneOutput& out = scene.output;
  for (const auto& path : {out.mesh, out.state})
    if (!path.empty()) check_output(path.string());
  if (!out.state.empty() && out.state.extension() != ".ply")
    throw UsageError(out.state.string() + ": a state is a .ply file");
  if (!out.animation.empty() || !out.inserted.empty() || !out.smoothed.empty() || !out.body.empty())
    if (!is_scene(a.in)) throw UsageError("keep writes --output, --save-state and --picture alone");
  if (!a.picture.empty()) check_folder(a.picture);
  std::vector<std::string> inputs{a.state, scene.garment.string()};
  if (is_scene(a.in)) inputs.push_back(a.in);
  if (scene.body)
    for (const auto& path : {scene.body->mesh, scene.body->field, scene.body->frames})
      inputs.push_back(path.string());
  for (const io::SceneLines& lines : scene.lines) inputs.push_back(lines.strokes.string());
  refuse_same({out.mesh.string(), out.state.string(), a.picture}, inputs);
}

/// Heights that lines would have without displacement.
std::vector<double> base_heights(const io::WrinkleRecord& record) {
  std::vector<double> base;
  for (const auto& line : record.lines) base.push_back(line.base_height);
  return base;
}

/// Each line's press from now on, so that keeping it again goes on from there.
void note_presses(const bridge::KeepReport& report, io::WrinkleRecord record, io::MeshFile& file) {
  for (const bridge::KeptLine& line : report.lines)
    if (std::size_t(line.line) < record.lines.size()) record.lines[line.line].press = line.press;
  io::set_wrinkle_record(file, record);
}

/// From rest, with nothing that fades in any more.
void write_kept_state(const io::Scene& scene, const io::TomlDocument& document,
                      const std::filesystem::path& folder, const SceneCloth& cloth,
                      std::optional<io::SavedState> state) {
  io::SavedState kept;
  if (state)
    kept = std::move(*state);
  else
    kept.lines_drawn = int(std::count_if(scene.lines.begin(), scene.lines.end(),
                                         [](const io::SceneLines& lines) { return lines.time == 0; }));
  const double time = kept.simulation.time;
  kept.simulation = {};
  kept.simulation.time = time;
  kept.file = cloth.file;
  io::drop_motion(kept.file);
  kept.pins = cloth.pins;
  kept.body = cloth.body ? cloth.body->fingerprint() : "";
  kept.scene = io::relocated(document, folder, scene.output.state.parent_path());
  kept.scene.erase("output");
  io::write_state(scene.output.state, std::move(kept));
}

bridge::KeepOptions options_of(const KeepArguments& a, const physics::SimulateOptions& run,
                               const io::WrinkleRecord& record) {
  bridge::KeepOptions options;
  options.run = run;
  options.run.stop_at.reset();
  options.seconds = a.run;
  options.kept = parse_share(a.kept, "--kept");
  options.gust = a.gust;
  options.line_widths = io::line_widths(record);
  options.line_presses = io::line_presses(record);
  options.whole = a.whole;
  if (a.no_balance) options.largest_turn = 0;
  if (a.no_help) options.presses.clear(), options.struts.clear(), options.height_trials = 0;
  return options;
}

int keep(KeepArguments& a) {
  catch_interrupts();
  std::optional<io::SavedState> state;
  if (!a.state.empty()) state = io::read_state(a.state);
  io::TomlDocument document = scene_settings(a.in, a.state, state, a.flags, a);
  const std::filesystem::path folder = std::filesystem::path(is_scene(a.in) ? a.in : a.state).parent_path();
  io::Scene scene = scene_of(document, folder);
  if (!state && take_recorded_material(document, scene.garment, nullptr)) scene = scene_of(document, folder);
  if (scene.garment.empty() && !state) throw UsageError(document.name + ": garment.mesh is missing");
  check_inputs(scene, document, state ? state->lines_drawn : -1);
  if (!state) take_noted_frame(scene, document);
  check(a, scene);
  CommonArguments common = a;
  common.unit = scene.unit;
  common.up = scene.up;
  const bool later =
      std::any_of(scene.lines.begin(), scene.lines.end(), [](const auto& l) { return l.time > 0; });
  if (!state && later && !(state = run_until_drawn(scene, document, folder, common))) return exit_interrupted;
  SceneCloth garment = drawn_garment(scene, state, common);
  const io::WrinkleRecord record = *io::find_wrinkle_record(garment.file);
  const bridge::KeepOptions options = options_of(a, garment.options, record);
  bridge::KeepReport report;
  {
    Progress progress("keeping", common);
    report = bridge::keep_lines(garment.file.mesh, garment.cloth, garment.world(scene), base_heights(record),
                                options, [&](double share) {
                                  progress.show(share);
                                  return !interrupted();
                                });
  }
  note_presses(report, record, garment.file);
  physics::soften_clamps(garment.cloth);
  bridge::store_rest_state(garment.cloth, spring_options(garment.file, scene.material), garment.file.mesh);
  if (!scene.output.state.empty()) write_kept_state(scene, document, folder, garment, std::move(state));
  warn_if_shape_only(scene.output.mesh, common);
  note_material(garment.file, document, garment.body ? garment.options.contact_gap : 0);
  if (!scene.output.mesh.empty()) write_mesh(scene.output.mesh.string(), garment.file, common);
  if (!a.picture.empty()) {
    const std::vector<io::RenderScene> scenes{verdict_scene(garment.file.mesh, report)};
    io::write_png(a.picture, io::render(scenes[0], render_options(scenes, a.camera)));
  }
  print_report(to_json(report, record), common);
  warn_of_idle_press(scene.material, record, common);
  return exit_code_of(report);
}

}  // namespace

void add_keep(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<KeepArguments>();
  CLI::App* sub = app.add_subcommand(
      "keep",
      "Give a garment the rest state that keeps its drawn lines, and tell of each whether it will hold\n\n"
      "  furrow keep scenes/kept_sheet.toml -o kept.ply --picture verdict.png\n"
      "  furrow keep wrinkled.ply --pin-loop top --fabric cotton -o kept.ply --save-state kept-state.ply\n"
      "  furrow keep --state worn.ply --save-state kept.ply\n"
      "  furrow simulate --state kept.ply --seconds 5 -o after.ply");
  sub->add_option("garment", a->in, "wrinkled garment, or a scene: a .toml file");
  sub->add_option("--state", a->state, "a saved state, with lines drawn on the cloth as it hangs or lies");
  sub->add_option("--run", a->run, "how long each trial runs forward from rest [s] (default 5)")
      ->check(CLI::PositiveNumber);
  sub->add_option("--gust", a->gust,
                  "then an acceleration to one side for 0.4 s, and 2 s of calm [m/s^2] (default 12)")
      ->check(CLI::NonNegativeNumber);
  sub->add_option("--kept", a->kept, "share of its height with which a line holds (default 95%)");
  sub->add_flag(
      "--no-balance", a->no_balance,
      "do not turn a garment about a line of pins, or one, until its centre of mass hangs below them "
      "(by at most 0.2 rad)");
  sub->add_flag("--no-help", a->no_help,
                "no press, struts or lower height where the rest state alone does not hold");
  sub->add_flag("--whole", a->whole,
                "press what lies between the lines, too, where it could give way, so that all of the garment "
                "stays as drawn");
  sub->add_option(
      "--picture", a->picture,
      "picture of the garment, lines coloured by verdict: green held, yellow pressed, orange struts, blue "
      "lower, red cannot hold");
  a->flags.add_to(*sub, io::used_by::keep);
  add_camera_options(*sub, a->camera);
  add_common_options(*sub, *a);
  sub->callback([a, &exit_code] { exit_code = keep(*a); });
}

}  // namespace furrow::cli
