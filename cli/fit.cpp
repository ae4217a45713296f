// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/fit.h"

#include <memory>

#include "cli/camera_options.h"
#include "cli/subcommands.h"
#include "io/picture/png_file.h"
#include "jobs/base/read_inputs.h"
#include "jobs/rest/fit_picture.h"

namespace furrow::cli {
namespace {

struct FitArguments : CommonArguments {
  std::vector<std::string> worn, bodies, sections;
  std::string rest, picture, colour, captions, body_unit;
  std::optional<double> range, contact;
  bridge::FitOptions options;
  CameraArguments camera;
  bool compare = false, view_chosen = false, no_legend = false;
};

/// "chest=1.25" and the like.
void take_sections(FitArguments& a) {
  for (const std::string& text : a.sections) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    bridge::SectionHeights& heights = a.options.sections;
    std::optional<double>* height = name == "chest"   ? &heights.chest
                                    : name == "waist" ? &heights.waist
                                    : name == "hip"   ? &heights.hip
                                                      : nullptr;
    if (!height || equals == std::string::npos)
      throw UsageError("--section takes chest=, waist= or hip= and a height [m], not '" + text + "'");
    *height = parse_numbers(text.substr(equals + 1), 1, "--section " + name)[0];
  }
}

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
  FitJob job;
  for (const std::string& path : a.worn) job.worn.emplace_back(std::filesystem::path(path));
  for (const std::string& path : a.bodies) job.bodies.emplace_back(std::filesystem::path(path));
  if (!a.rest.empty()) job.rest = std::filesystem::path(a.rest);
  job.frame = a;
  if (!a.body_unit.empty()) job.body_unit = a.body_unit;
  job.options = a.options;
  job.contact = a.contact;
  if (!a.colour.empty()) job.colour = a.colour == "strain" ? FitColour::strain : FitColour::distance;
  job.range = a.range;
  job.output = a.out;
  job.more_outputs = {a.picture, a.camera.save_camera};
  job.more_inputs = {a.camera.camera};
  return job;
}

void write_picture(const FitJobReport& report, const FitArguments& a, const CommonArguments& common) {
  std::vector<geometry::Mesh> bodies;
  Frame of_bodies = common;
  if (!a.body_unit.empty()) of_bodies.unit = a.body_unit;
  for (const std::string& path : a.bodies)
    bodies.push_back(std::move(*io::read_mesh(path, read_options(of_bodies)).mesh));
  const std::vector<std::string> captions = split_at_commas(a.captions);
  std::vector<FitPanel> panels;
  for (std::size_t i = 0; i < report.garments.size(); ++i) {
    const FittedGarment& fitted = report.garments[i];
    panels.push_back(
        {&*fitted.garment.mesh, &bodies[bodies.size() > 1 ? i : 0],
         (i < captions.size() ? captions[i] : fitted.name) + (report.garments.size() > 1 ? "\n" : ": ") +
             fit_words(fitted.report, a.options, report.shown) + crossing_words(fitted.crossings),
         fitted.crossings.faces});
  }
  const std::vector<io::RenderScene> scenes = fit_scenes(panels);
  Terminal terminal(a);
  const io::RenderOptions options = render_options(scenes, a.camera);
  const io::FitScale scale = fit_scale(report.shown, a.options, a.range);
  io::write_png(a.picture,
                fit_picture(panels, scenes, scale, options, a.view_chosen, terminal, !a.no_legend));
  save_camera(options, a.camera);
}

void fit(FitArguments a) {
  take_sections(a);
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
    next = {"furrow", "fit", a.worn[0], "--body", a.bodies[0], "--picture", "fit.png"};
  print_report(json, a, {fit_lines(json), {a.out, a.picture}, next});
}

void add_thresholds(CLI::App& sub, FitArguments& a) {
  sub.add_option("--tight", a.options.tight_strain, "cloth strained more is tight [-], > 0")
      ->capture_default_str();
  sub.add_option("--loose", a.options.loose_distance, "cloth farther from the body is loose [m], > 0")
      ->capture_default_str();
  sub.add_option(
      "--contact", a.contact,
      "cloth nearer lies on the body [m], >= 0; default 1.2 times the gap that the garment kept, or "
      "would keep");
  sub.add_option("--smallest-zone", a.options.smallest_zone, "zones with less area are left out [m^2], >= 0")
      ->capture_default_str();
  sub.add_option(
         "--section", a.sections,
         "height of a section in place of what is found on the body, e.g. chest=1.25; chest, waist or "
         "hip [m]; may be given again")
      ->allow_extra_args(false);
}

}  // namespace

void add_fit(CLI::App& app) {
  auto a = std::make_shared<FitArguments>();
  a->camera.size = "900,1100";
  CLI::App* sub = app.add_subcommand(
      "fit",
      "Tell how a worn garment fits: where it is tight, where it is loose, how much room there is\n\n"
      "  furrow fit worn.ply --body body.obj --picture fit.png\n"
      "  furrow fit worn.ply --body body.obj --colour distance --picture room.png -o coloured.ply\n"
      "  furrow fit --compare S.ply M.ply L.ply --body body.obj --picture sizes.png");
  sub->add_option("worn", a->worn, "a garment as it is worn: what simulate or drape wrote")->required();
  sub->add_option("--body", a->bodies,
                  "the body that wears it, as it stands there; with --compare one, or one for each garment: "
                  "--body A.obj --body B.obj")
      ->required()
      ->allow_extra_args(false);
  sub->add_option("--body-unit", a->body_unit, "unit of the bodies' files, where it is not the garments'")
      ->check(CLI::IsMember({"m", "cm", "mm", "inch"}));
  sub->add_option(
      "--rest-shape", a->rest,
      "the garment as it was made, with the same vertices, where the worn one has no rest lengths");
  sub->add_flag("--compare", a->compare, "several garments side by side, with one scale");
  sub->add_option("--picture", a->picture, "PNG to write: coloured cloth on the body, with a legend");
  sub->add_option("-o,--output", a->out,
                  "mesh to write with colours; PLY keeps the columns fit_distance [m] "
                  "and strain [-], too");
  sub->add_option("--colour", a->colour, "strain or distance; default strain, where it is known")
      ->check(CLI::IsMember({"strain", "distance"}));
  sub->add_option("--range", a->range,
                  "where the colours end: strain [-] or distance [m]; default 2 x --tight, 1.2 x --loose");
  sub->add_flag("--no-legend", a->no_legend, "leave out the bar of colours and the words beside it");
  sub->add_option("--captions", a->captions,
                  "words for the pictures, separated by commas; default: file names");
  add_thresholds(*sub, *a);
  add_camera_options(*sub, a->camera);
  add_common_options(*sub, *a);
  sub->callback([a, sub] {
    for (const char* option : {"--view", "--camera", "--eye", "--target"})
      a->view_chosen = a->view_chosen || sub->count(option) > 0;
    fit(*a);
  });
}

}  // namespace furrow::cli
