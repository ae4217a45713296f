// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/chain/keep.h"

#include <algorithm>

#include "cli/camera_options.h"
#include "cli/card_options.h"
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
  std::string in, picture;
  KeepJob job;
  SceneFlags flags;
  CameraArguments camera;
};

KeepJob job_of(const KeepArguments& a) {
  if (a.picture.empty() && !a.camera.save_camera.empty())
    throw UsageError("--save-camera is of use with --picture only");
  check_folder(a.camera.save_camera);
  KeepJob job = a.job;
  const std::string state = job.state_path.string();
  if (!state.empty()) job.state = io::read_state(state);
  job.scene.settings = scene_settings(a.in, state, job.state, a.flags, a);
  job.scene.folder = std::filesystem::path(is_scene(a.in) ? a.in : state).parent_path();
  job.more_outputs = {a.picture, a.camera.save_camera};
  return job;
}

Lines keep_lines(const Json& report) {
  const Json& drawn = list_of(report, "lines");
  const auto fails = [](const Json& line) { return text_of(line, "verdict").rfind("held", 0) != 0; };
  const auto count = [&](const char* verdict) {
    return std::count_if(drawn.begin(), drawn.end(),
                         [&](const Json& line) { return text_of(line, "verdict") == verdict; });
  };
  const auto n = std::count_if(drawn.begin(), drawn.end(), fails);
  const auto in_calm = count("may hold"), open = count("not known");
  Lines lines{drawn.empty()
                  ? "no line has a height to keep"
                  : std::to_string(drawn.size() - static_cast<std::size_t>(n)) + " of " +
                        counted(drawn.size(), "line") + " will hold" +
                        (in_calm > 0 ? ", " + std::to_string(in_calm) + " more where nothing blows" : "") +
                        (open > 0 ? ", of " + std::to_string(open) + " it is not known" : "")};
  for (const bool failing : {true, false})  // what fails first
    for (const Json& line : drawn)
      if (fails(line) == failing)
        lines.push_back(name_of_line(line) + ": " + text_of(line, "words") + " (asked " +
                        length(line, "asked") + ", drawn " + length(line, "smoothed") + ", left " +
                        length_or_unknown(value_of(line, "height") * value_of(line, "kept")) + ")");
  if (lines.size() > 6) {
    const std::size_t more = lines.size() - 5;
    lines.resize(5);
    lines.push_back("and " + counted(more, "more line"));
  }
  lines.push_back(balance_of(report, "", "the shape"));
  add_crossings(lines, report);
  return lines;
}

/// How what was kept moves on: from its state, or with what this call said of it. A scene or an older state
/// says that itself, of another garment: then none.
std::vector<std::string> next_of_kept(const KeepArguments& a, const KeepReport& report) {
  const std::string mesh = report.mesh.string(), state = report.saved_state.string();
  if (!state.empty()) return {"furrow", "simulate", "--state", state, "-o", "after.ply"};
  if (mesh.empty() || mesh == "-" || a.in.empty() || is_scene(a.in)) return {};
  std::vector<std::string> next = a.flags.words(io::used_by::simulate);
  next.insert(next.begin(), {"furrow", "simulate", mesh});
  next.insert(next.end(), {"-o", "after.ply"});
  return next;
}

int keep(const KeepArguments& a) {
  catch_interrupts();
  Terminal terminal(a, a.job.budget);
  const KeepReport report = jobs::keep(job_of(a), terminal);
  if (report.budget_spent) report_spent_budget(a.job.budget, {report.mesh.string()});
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
  print_report(json, common, {keep_lines(json), {report.mesh.string(), a.picture}, next_of_kept(a, report)});
  for (const Warning& w : report.warnings) terminal.warn(w);
  return exit_code_of(report.lines.interrupted && !report.budget_spent,
                      report.all_hold() && !report.budget_spent);
}

void add_keep(CLI::App& sub, KeepArguments& a) {
  sub.add_option("garment", a.in, "wrinkled garment, or a scene: a .toml file");
  add_card(sub, card(a.job));
  begin_group(sub, group::picture);
  sub.add_option(
      "--picture", a.picture,
      "picture of the garment, lines coloured by verdict: green held, yellow pressed, orange struts, blue "
      "lower, violet may hold, red cannot hold, grey not known; faces that cross are magenta");
  a.flags.add_to(sub, io::used_by::keep);
  add_camera_options(sub, a.camera);
}

const Subcommand keep_subcommand(
    90, "keep",
    "Give a garment the rest state that keeps its drawn lines, and tell of each whether it will hold\n\n"
    "  furrow keep scenes/kept_sheet.toml -o kept.ply --picture verdict.png\n"
    "  furrow keep wrinkled.ply --pin-loop top --fabric cotton -o kept.ply --save-state kept-state.ply\n"
    "  furrow keep --state worn.ply --save-state kept.ply\n"
    "  furrow simulate --state kept.ply --seconds 5 -o after.ply",
    add_keep, keep);

}  // namespace
}  // namespace furrow::cli
