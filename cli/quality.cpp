// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/quality.h"

#include <memory>

#include "cli/camera_options.h"
#include "cli/card_options.h"
#include "cli/subcommands.h"
#include "io/picture/png_file.h"
#include "jobs/base/read_inputs.h"
#include "jobs/draw/quality_targets.h"

namespace furrow::cli {
namespace {

struct QualityArguments : CommonArguments {
  std::string mesh, picture;
  QualityJob job;
  bool check = false;
  CameraArguments camera;
};

void write_picture(const QualityReport& report, const QualityArguments& a) {
  const io::RenderScene scene = quality_scene(report);
  const io::RenderOptions options = render_options({&scene, 1}, a.camera);
  io::write_png(a.picture, io::render(scene, options));
  save_camera(options, a.camera);
}

int quality(QualityArguments& a) {
  check_picture(a.picture, "--picture");
  a.job.mesh = std::filesystem::path(a.mesh);
  a.job.frame = a;
  a.job.more_outputs = {a.picture, a.camera.save_camera};
  Terminal terminal(a);
  const QualityReport report = jobs::quality(a.job, terminal);
  if (!a.picture.empty()) write_picture(report, a);
  Json json = to_json(report);
  if (!a.picture.empty()) json["picture"] = a.picture;
  print_report(json, a, {quality_lines(json), {a.picture, a.camera.save_camera}, {}});
  return exit_code_of(false, !a.check || report.met());
}

}  // namespace

void add_quality(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<QualityArguments>();
  CLI::App* sub = app.add_subcommand(
      "quality",
      "Measure how well a cloth is folded: ripples, zigzag, knobs, thin faces, hems\n\n"
      "  furrow quality wrinkled.ply\n"
      "  furrow quality wrinkled.obj --base skirt.obj --strokes lines.json --picture knobs.png\n"
      "  furrow quality worn.ply --check\n\n"
      "Each measure stands beside its target. The exit code is 0, with --check 4 where one is missed.");
  sub->add_option("mesh", a->mesh, "mesh to measure, with folds or without")->required();
  add_card(*sub, card(a->job));
  sub->add_option(
      "--picture", a->picture,
      "PNG to write: angle defects as colours, red domes and blue saddles, full at 400 rad/m^2; a "
      "magenta ball at the worst places beyond that");
  sub->add_flag("--check", a->check, "exit with 4 where a target is missed");
  add_camera_options(*sub, a->camera);
  add_common_options(*sub, *a);
  sub->callback([a, &exit_code] { exit_code = quality(*a); });
}

}  // namespace furrow::cli
