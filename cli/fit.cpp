// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/fit.h"

#include "cli/camera_options.h"
#include "cli/card_options.h"
#include "cli/subcommands.h"
#include "io/picture/png_file.h"
#include "jobs/base/read_inputs.h"
#include "jobs/rest/fit_picture.h"

namespace furrow::cli {
namespace {

struct FitArguments : CommonArguments {
  std::vector<std::string> worn;
  std::string picture, captions;
  FitJob job;
  CameraArguments camera;
  bool compare = false, view_chosen = false, no_legend = false;
};

void check_call(const FitArguments& a) {
  if (a.worn.size() > 1 && !a.compare)
    throw UsageError(std::to_string(a.worn.size()) + " garments: say --compare to lay them side by side");
  if (a.picture.empty() &&
      (a.view_chosen || a.no_legend || !a.captions.empty() || !a.camera.save_camera.empty()))
    throw UsageError("a view, --captions, --no-legend and --save-camera are of use with --picture only");
  if (split_at_commas(a.captions).size() > a.worn.size())
    throw UsageError("--captions: " + std::to_string(split_at_commas(a.captions).size()) + " for " +
                     std::to_string(a.worn.size()) + " garments");
  check_picture(a.picture, "--picture");
  check_folder(a.camera.save_camera);
}

FitJob job_of(const FitArguments& a) {
  FitJob job = a.job;
  job.worn.assign(a.worn.begin(), a.worn.end());
  job.frame = a;
  job.more_outputs = {a.picture, a.camera.save_camera};
  job.more_inputs = {a.camera.camera};
  return job;
}

void write_picture(const FitJobReport& report, const FitArguments& a, const CommonArguments& common) {
  std::vector<geometry::Mesh> bodies;
  Frame of_bodies = common;
  if (a.job.body_unit) of_bodies.unit = a.job.body_unit;
  for (const MeshInput& body : a.job.bodies)
    bodies.push_back(std::move(*io::read_mesh(name_of(body, ""), read_options(of_bodies)).mesh));
  const std::vector<std::string> captions = split_at_commas(a.captions);
  std::vector<FitPanel> panels;
  for (std::size_t i = 0; i < report.garments.size(); ++i) {
    const FittedGarment& fitted = report.garments[i];
    panels.push_back(
        {&*fitted.garment.mesh, &bodies[bodies.size() > 1 ? i : 0],
         (i < captions.size() ? captions[i] : fitted.name) + (report.garments.size() > 1 ? "\n" : ": ") +
             fit_words(fitted.report, a.job.options, report.shown) + crossing_words(fitted.crossings),
         fitted.crossings.faces});
  }
  const std::vector<io::RenderScene> scenes = fit_scenes(panels);
  Terminal terminal(a);
  const io::RenderOptions options = render_options(scenes, a.camera);
  const io::FitScale scale = fit_scale(report.shown, a.job.options, a.job.range);
  io::write_png(a.picture,
                fit_picture(panels, scenes, scale, options, a.view_chosen, terminal, !a.no_legend));
  save_camera(options, a.camera);
}

Lines fit_lines(const Json& report) {
  Lines lines;
  const Json& garments = list_of(report, "garments");
  if (garments.empty()) {
    add_fit_lines(lines, report);
    for (const char* key : {"tight_zones", "loose_zones"})
      if (const Json& zones = list_of(report, key); !zones.empty())
        lines.push_back("look at: " + counted(zones.size(), "zone") + " that " +
                        (zones.size() == 1 ? "is " : "are ") + std::string(key).substr(0, 5) +
                        ", the largest at " + per_cent(value_of(zones[0], "height_share")) +
                        " of the body's height, " + text_of(zones[0], "side"));
    add_crossings(lines, report);
    return lines;
  }
  for (const Json& g : garments) {
    const Json& strain = table_of(g, "strain");
    lines.push_back(text_of(g, "garment") + ": " +
                    (strain.empty()
                         ? std::string("strain unknown")
                         : per_cent(value_of(strain, "share_over")) + " of the cloth strained over " +
                               per_cent(value_of(strain, "over"))) +
                    "; ease " + ease_text(g));
  }
  return lines;
}

void fit(const FitArguments& a) {
  check_call(a);
  Terminal terminal(a);
  const FitJobReport report = jobs::fit(job_of(a), terminal);
  const CommonArguments common = in_frame(a, report.frame);
  if (!a.picture.empty()) write_picture(report, a, common);
  if (a.out == "-") write_mesh(report.garments[0].garment, common);
  Json json = to_json(report);
  if (!a.picture.empty()) json["picture"] = a.picture;
  if (!a.out.empty()) json["written"] = a.out;
  std::vector<std::string> next;
  if (a.picture.empty() && !a.compare)
    next = {"furrow", "fit", a.worn[0], "--body", name_of(a.job.bodies[0], ""), "--picture", "fit.png"};
  print_report(json, a, {fit_lines(json), {a.out, a.picture}, next});
}

void run_fit(FitArguments& a) {
  a.out = a.job.output.string();
  for (const char* option : {"--view", "--camera", "--eye", "--target"})
    a.view_chosen = a.view_chosen || a.typed->count(option) > 0;
  fit(a);
}

void add_fit(CLI::App& sub, FitArguments& a) {
  a.camera.size = "900,1100";
  sub.add_option("worn", a.worn, "a garment as it is worn: what simulate or drape wrote")->required();
  add_card(sub, card(a.job));
  sub.get_option("--body")->required();
  sub.add_flag("--compare", a.compare, "several garments side by side, with one scale");
  sub.add_option("--picture", a.picture, "PNG to write: coloured cloth on the body, with a legend");
  sub.add_flag("--no-legend", a.no_legend, "leave out the bar of colours and the words beside it");
  sub.add_option("--captions", a.captions,
                 "words for the pictures, separated by commas; default: file names");
  add_camera_options(sub, a.camera);
}

const Subcommand fit_subcommand(
    150, "fit",
    "Tell how a worn garment fits: where it is tight, where it is loose, how much room there is\n\n"
    "  furrow fit worn.ply --body body.obj --picture fit.png\n"
    "  furrow fit worn.ply --body body.obj --colour distance --picture room.png -o coloured.ply\n"
    "  furrow fit --compare S.ply M.ply L.ply --body body.obj --picture sizes.png",
    add_fit, run_fit);

}  // namespace
}  // namespace furrow::cli
