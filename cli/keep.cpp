// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/chain/keep.h"

#include <memory>

#include "cli/camera_options.h"
#include "cli/help.h"
#include "cli/scene_flags.h"
#include "cli/subcommands.h"
#include "io/picture/png_file.h"
#include "io/picture/render_scene.h"
#include "jobs/base/read_inputs.h"
#include "jobs/chain/verdict_scene.h"

namespace furrow::cli {
namespace {

struct KeepArguments : CommonArguments {
  std::string in, state, picture;
  SceneFlags flags;
  CameraArguments camera;
  double run = 5, gust = 12;
  std::string kept = "95%";
  bool no_balance = false, no_settle = false, no_help = false, whole = false, fast = false;
  double budget = KeepJob{}.budget;
};

KeepJob job_of(const KeepArguments& a) {
  if (a.picture.empty() && !a.camera.save_camera.empty())
    throw UsageError("--save-camera is of use with --picture only");
  check_folder(a.camera.save_camera);
  KeepJob job;
  if (!a.state.empty()) job.state = io::read_state(a.state);
  job.state_path = a.state;
  job.scene.settings = scene_settings(a.in, a.state, job.state, a.flags, a);
  job.scene.folder = std::filesystem::path(is_scene(a.in) ? a.in : a.state).parent_path();
  job.seconds = a.run;
  job.gust = a.gust;
  job.kept = parse_share(a.kept, "--kept");
  job.balance = !a.no_balance;
  job.settle = !a.no_settle;
  job.help = !a.no_help;
  job.whole = a.whole;
  job.prove = !a.fast;
  job.budget = a.budget;
  job.more_outputs = {a.picture, a.camera.save_camera};
  return job;
}

int keep(const KeepArguments& a) {
  catch_interrupts();
  Terminal terminal(a, a.budget);
  const KeepReport report = jobs::keep(job_of(a), terminal);
  if (report.budget_spent) report_spent_budget(a.budget, {report.mesh.string()});
  if (!report.ran) return report.budget_spent ? exit_not_converged : exit_interrupted;
  const CommonArguments common = in_frame(a, report.frame);
  if (report.mesh == "-") write_mesh("-", report.garment, common);
  if (!a.picture.empty()) {
    std::vector<io::RenderScene> scenes{verdict_scene(report.garment.mesh, report.lines)};
    io::mark_faces(scenes[0].meshes[0], report.crossings.faces);
    const io::RenderOptions options = render_options(scenes, a.camera);
    io::write_png(a.picture, io::render(scenes[0], options));
    save_camera(options, a.camera);
  }
  Json json = to_json(report);
  json["written"] =
      names_of_files({report.mesh.string(), report.saved_state.string(), a.picture, a.camera.save_camera});
  const std::string mesh = report.mesh.string();
  print_report(json, common,
               {keep_lines(json),
                {mesh, a.picture},
                mesh.empty() || mesh == "-" ? std::vector<std::string>{}
                                            : std::vector<std::string>{"furrow", "simulate", mesh,
                                                                       "PINS_AND_BODY", "-o", "after.ply"}});
  for (const Warning& w : report.warnings) terminal.warn(w);
  return exit_code_of(report.lines.interrupted && !report.budget_spent,
                      report.all_hold() && !report.budget_spent);
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
  begin_group(*sub, group::lines);
  sub->add_option("--state", a->state, "a saved state, with lines drawn on the cloth as it hangs or lies");
  sub->add_option("--gust", a->gust,
                  "and an acceleration to each of four sides for 0.4 s, and 2 s of calm [m/s^2] (default 12)")
      ->check(CLI::NonNegativeNumber);
  sub->add_option("--kept", a->kept, "share of its height with which a line holds (default 95%)");
  sub->add_flag(
      "--fast", a->fast,
      "one gust in place of four and longer steps: two to four times sooner, but a line that is called "
      "held may be lost in others");
  sub->add_flag("--whole", a->whole,
                "press what lies between the lines, too, where it could give way, so that all of the garment "
                "stays as drawn");
  add_budget_option(*sub, a->budget, "the last rest state that was found is written, with exit code 4");
  begin_group(*sub, group::lines, Audience::few);
  sub->add_option("--run", a->run, "how long each trial runs forward from rest [s] (default 5)")
      ->check(CLI::PositiveNumber);
  sub->add_flag(
      "--no-balance", a->no_balance,
      "do not turn a garment about a line of pins, or one, until its centre of mass hangs below them "
      "(by at most 0.2 rad)");
  sub->add_flag("--no-settle", a->no_settle,
                "on a body, keep a wrinkled garment, or draw the scene's lines, where it lies, even if "
                "nothing holds it there, or a few vertices; by default it comes to rest first then");
  sub->add_flag("--no-help", a->no_help,
                "no press, struts or lower height where the rest state alone does not hold");
  begin_group(*sub, group::picture);
  sub->add_option(
      "--picture", a->picture,
      "picture of the garment, lines coloured by verdict: green held, yellow pressed, orange struts, blue "
      "lower, violet may hold, red cannot hold; faces that cross are magenta");
  a->flags.add_to(*sub, io::used_by::keep);
  add_camera_options(*sub, a->camera);
  add_common_options(*sub, *a);
  sub->callback([a, &exit_code] { exit_code = keep(*a); });
}

}  // namespace furrow::cli
