// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/drape.h"

#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "cli/camera_options.h"
#include "cli/card_options.h"
#include "cli/help.h"
#include "cli/print_text.h"
#include "cli/scene_flags.h"
#include "cli/subcommands.h"
#include "io/base/atomic_file.h"
#include "io/picture/png_file.h"
#include "jobs/base/read_inputs.h"
#include "jobs/rest/fit_picture.h"

namespace furrow::cli {
namespace {

struct DrapeArguments : CommonArguments {
  std::string in, picture, colour = "strain", animation;
  std::vector<std::string> garments;  ///< `in` is the first
  DrapeJob job;
  SceneFlags flags;
  CameraArguments camera;
  bool view_chosen = false, no_legend = false, auto_subdivide = false;
};

void check_call(const DrapeArguments& a) {
  if (a.out.empty() && a.picture.empty() && a.animation.empty())
    throw UsageError("nothing to write: name --output, --picture or --animation");
  if (!a.job.fabrics.empty() && a.picture.empty())
    throw UsageError("--fabrics is a picture: name it with --picture");
  if (!a.job.fabrics.empty() && (!a.out.empty() || !a.animation.empty()))
    throw UsageError("--fabrics writes a picture only; drape each by itself for its mesh");
  if (a.picture.empty() && (a.view_chosen || a.no_legend || !a.camera.save_camera.empty()))
    throw UsageError("a view, --no-legend and --save-camera are of use with --picture only");
  check_picture(a.picture, "--picture");
  check_folder(a.camera.save_camera);
}

DrapeJob job_of(const DrapeArguments& a) {
  check_call(a);
  DrapeJob job = a.job;
  job.scene.settings = scene_settings(a.in, "", std::nullopt, a.flags, a);
  if (a.colour == "distance" && !job.scene.settings.root->contains("body"))
    throw UsageError("--colour distance is that to a body: name one with --body");
  for (std::size_t i = 1; i < a.garments.size(); ++i) {
    if (is_scene(a.garments[i]))
      throw UsageError(a.garments[i] + ": a scene stands first; then follow meshes, the inner ones first");
    job.over.push_back(a.garments[i]);
  }
  if (is_scene(a.in)) job.scene.folder = std::filesystem::path(a.in).parent_path();
  if (a.auto_subdivide) {
    if (auto& root = *job.scene.settings.root; root.contains("garment")) {
      io::Json& garment = root["garment"];
      if (garment.is_object()) garment.erase("subdivide");
      if (garment.is_array())
        for (io::Json& one : garment)
          if (one.is_object()) one.erase("subdivide");
    }
  }
  job.more_outputs = {a.picture, a.camera.save_camera};
  job.more_inputs = {a.camera.camera};
  if (is_scene(a.in)) job.more_inputs.push_back(a.in);
  return job;
}

/// "shirt over vest: nothing crosses".
std::string layers_words(const DrapedLayers& layers) {
  std::string words;
  for (const LayerPair& p : layers.pairs)
    words += (words.empty() ? "" : "; ") + p.outer + " over " + p.inner + ": " +
             (p.crossings ? std::to_string(p.crossings) + " pairs of faces cross" : "nothing crosses");
  return words;
}

/// The garments' files.
std::vector<std::string> written_files(const DrapeJobReport& report, const DrapeArguments& a) {
  if (!report.layers) return {a.out};
  std::vector<std::string> files;
  for (const Draped& d : report.garments) files.push_back(d.written.string());
  return files;
}

void write_picture(DrapeJobReport& report, const DrapeArguments& a, const CommonArguments& common) {
  const FitColour colour = a.colour == "distance" ? FitColour::distance : FitColour::strain;
  std::vector<Draped>& all = report.garments;
  const io::FitScale scale = fit_scale(colour, all[0].fit_options);
  const std::optional<io::MeshFile> body = read_body_of(report.scene, common);
  std::vector<FitPanel> panels;
  std::vector<const geometry::Mesh*> over;
  for (Draped& d : all) {
    colour_garment(d.file.mesh, scale);
    if (report.layers && &d != &all[0]) {
      over.push_back(&*d.file.mesh);
      continue;
    }
    const std::string outcome = d.outcome();
    panels.push_back({&*d.file.mesh, body ? &*body->mesh : nullptr,
                      d.name + (outcome == "at rest" ? "" : " (" + outcome + ")") +
                          (all.size() > 1 ? "\n" : ": ") + fit_words(d.fit, d.fit_options, colour) +
                          crossing_words(d.crossings),
                      d.crossings.faces});
  }
  if (report.layers) {
    panels[0].over = std::move(over);
    panels[0].caption = layers_words(*report.layers);
  }
  const std::vector<io::RenderScene> scenes = fit_scenes(panels);
  Terminal terminal(common);
  const io::RenderOptions options = render_options(scenes, a.camera);
  io::write_png(a.picture,
                fit_picture(panels, scenes, scale, options, a.view_chosen, terminal, !a.no_legend));
  save_camera(options, a.camera);
}

/// On stderr: which of the files that were asked for there are.
void tell_interruption(const DrapeArguments& a, bool drawn, bool animated) {
  std::string written, missing;
  const auto add = [&](const std::string& path, bool there) {
    std::string& list = there ? written : missing;
    if (!path.empty()) list += (list.empty() ? "" : ", ") + path;
  };
  add(a.out, true);
  add(a.picture, drawn);
  add(a.animation, animated);
  std::cerr << "error: interrupted; " << (written.empty() ? "nothing was written" : "written: " + written)
            << (missing.empty() ? "" : "; not written: " + missing) << '\n';
}

/// Says what is to be said of the result, and returns the exit code for it.
int tell_remarks(const DrapeJobReport& report, const DrapeArguments& a, Terminal& terminal) {
  if (report.budget_spent) report_spent_budget(a.job.budget, written_files(report, a));
  for (const DrapeRemark& r : report.remarks) {
    if (r.fails)
      std::cerr << "error: " << worded(r.remark.text) << "\n";
    else
      terminal.warn(r.remark);
  }
  return exit_code_of(report.cancelled() && !report.budget_spent, !report.fails() && !report.budget_spent);
}

/// "not refined", "refined once", "refined 3 times".
std::string refined(long long times) {
  return times == 0   ? "not refined"
         : times == 1 ? "refined once"
                      : "refined " + std::to_string(times) + " times";
}

/// "waist +4.1 +- 0.2 cm", and so on, over all starts.
void add_starts(Lines& lines, const Json& report) {
  const Json& starts = table_of(report, "starts");
  if (starts.empty()) return;
  std::string text = std::to_string(count_of(starts, "resting")) + " of " +
                     std::to_string(count_of(starts, "asked")) + " starts at rest, that of start " +
                     std::to_string(count_of(starts, "chosen")) + " taken";
  for (const Json& s : list_of(starts, "spread")) {
    const std::string name = text_of(s, "name");
    const double mean = value_of(s, "mean"), deviation = value_of(s, "deviation");
    if (name.starts_with("ease_"))
      text += fmt::format("; {} {:+.1f} +- {:.2f} cm", name.substr(5), 100 * mean, 100 * deviation);
    else if (name == "hem_height")
      text += fmt::format("; hem at {:.1f} +- {:.2f} cm", 100 * mean, 100 * deviation);
    else if (name == "energy")
      text += fmt::format("; energy {:.4g} +- {:.2g} J", mean, deviation);
  }
  lines.push_back(text);
}

/// "brought from anna.obj: height x 1.03, arms turned by 28 degrees, legs by 8; moved by 7 cm, …".
void add_placed(Lines& lines, const Json& placed) {
  if (placed.empty()) return;
  const Json& turned = table_of(placed, "turned");
  const auto degrees = [&](const char* left, const char* right) {
    const double most = std::fmax(value_of(turned, left), value_of(turned, right));
    return std::to_string(std::lround(std::isfinite(most) ? most : 0)) + " degrees";
  };
  lines.push_back("brought from " + text_of(placed, "made_for") + ": height x " +
                  number(value_of(placed, "height_scale")) + ", arms turned by " +
                  degrees("left_arm", "right_arm") + ", legs by " + degrees("left_leg", "right_leg") +
                  "; moved by " + length(placed, "mean_move") + ", at most " +
                  length(placed, "farthest_move") + "; " + per_cent(value_of(placed, "inside_share")) +
                  " of it began inside the body");
}

void add_touches(Lines& lines, const Json& report) {
  std::size_t i = 0;
  for (const Json& t : list_of(report, "touches")) {
    const double remains = value_of(t, "remains");
    lines.push_back(fmt::format("touch {} ({}): moved {} vertices by up to {:.1f} mm", ++i,
                                text_of(t, "kind"), count_of(t, "vertices"), 1000 * value_of(t, "moved")) +
                    (remains >= 0.995         ? ", all of it remains"
                     : std::isfinite(remains) ? fmt::format(", {:.0f} % of it remain", 100 * remains)
                                              : ""));
  }
}

/// Of one garment on a body.
void add_draped(Lines& lines, const Json& report) {
  const Json& levels = list_of(report, "levels");
  const long long vertices = levels.empty() ? 0 : count_of(levels.back(), "vertices");
  const Json& local = table_of(report, "local");
  lines.push_back(text_of(report, "garment") + ": " + text_of(report, "outcome") + " (" +
                  std::to_string(vertices) + " vertices, " +
                  (local.empty() ? refined(count_of(report, "subdivide"))
                                 : "refined where it folds; as fine everywhere, " +
                                       std::to_string(count_of(local, "uniform_vertices"))) +
                  ", " + number(value_of(report, "seconds")) + " s)");
  if (!report.contains("fit")) return lines.push_back("not measured: `furrow fit` measures what was written");
  const std::string asked = length(report, "gap_asked"), taken = length(report, "gap");
  if (table_of(table_of(report, "fit"), "distance").empty())
    lines.push_back("no body: it hangs from its pins");
  else
    lines.push_back("gap: " + asked + " asked, " + (taken == asked ? "" : taken + " aimed at, ") +
                    length(table_of(table_of(report, "fit"), "distance"), "min") + " at the nearest place; " +
                    std::to_string(count_of(report, "touching")) + " vertices touch the body");
  add_placed(lines, table_of(report, "placed"));
  add_touches(lines, report);
  add_starts(lines, report);
  add_fit_lines(lines, table_of(report, "fit"));
  if (const Json& contact = table_of(report, "self_contact"); contact.contains("crossings_without"))
    lines.push_back("cloth keeps off cloth: without that " +
                    counted(count_of(contact, "crossings_without"), "pair") + " of faces crossed");
  add_crossings(lines, report);
}

Lines drape_lines(const Json& report) {
  Lines lines;
  const Json& garments = list_of(report, "garments");
  if (garments.empty()) {
    add_draped(lines, report);
    return lines;
  }
  for (const Json& d : garments) {
    if (!d.contains("fit")) {
      add_draped(lines, d);
      continue;
    }
    const Json& strain = table_of(table_of(d, "fit"), "strain");
    lines.push_back(text_of(d, "garment") + ": " + text_of(d, "outcome") + "; " +
                    per_cent(value_of(strain, "share_over")) + " of the cloth strained over " +
                    per_cent(value_of(strain, "over")) +
                    (table_of(d, "fit").value("body_height", Json()).is_null()
                         ? ""
                         : "; ease " + ease_text(table_of(d, "fit"))));
  }
  for (const Json& p : list_of(table_of(report, "layers"), "pairs")) {
    const double compared = value_of(p, "compared");
    lines.push_back(text_of(p, "outer") + " over " + text_of(p, "inner") + ": " +
                    counted(count_of(p, "crossings"), "pair") + " of faces cross, " +
                    std::to_string(count_of(p, "crossings_at_start")) + " as given" +
                    (compared > 0
                         ? "; order kept at " + per_cent(value_of(p, "outside") / compared) + " of " +
                               std::to_string(count_of(p, "compared")) + " vertices that are near"
                         : ""));
  }
  return lines;
}

int drape(const DrapeArguments& a) {
  catch_interrupts();
  Terminal terminal(a, a.job.budget);
  io::OutputGroup together;
  DrapeJobReport report = jobs::drape(job_of(a), terminal);
  const CommonArguments common = in_frame(a, report.frame);
  if (a.out == "-") write_mesh(report.garments[0].file, common);
  const bool draws = !a.picture.empty() && !interrupted();  // that may take longer than the fit
  try {
    if (draws) write_picture(report, a, common);
  } catch (...) {
    together.commit();  // the fit took longer than the picture: it is not lost with that
    throw;
  }
  together.commit();
  Json json = to_json(report);
  const bool animated = report.garments[0].animated;
  if (!a.out.empty() && !report.layers) json["written"] = a.out;
  if (draws) json["picture"] = a.picture;
  if (animated) json["animation"] = a.animation;
  const bool many = report.garments.size() > 1;
  std::vector<std::string> next;
  if (!a.out.empty() && a.out != "-" && !many && report.scene.body)
    next = {"furrow", "fit", a.out, "--body", report.scene.body->mesh.string(), "--picture", "fit.png"};
  else if (!a.out.empty() && a.out != "-" && !many && !draws)
    next = {"furrow", "render", a.out, "-o", "rests.png"};
  std::vector<std::string> files = written_files(report, a);
  files.insert(files.end(), {draws ? a.picture : "", animated ? a.animation : ""});
  print_report(json, common, {drape_lines(json), files, next});
  const int code = tell_remarks(report, a, terminal);
  if (interrupted()) tell_interruption(a, draws, animated);
  return code == exit_ok && interrupted() ? exit_interrupted : code;
}

int run_drape(DrapeArguments& a) {
  for (const char* option : {"--view", "--camera", "--eye", "--target"})
    a.view_chosen = a.view_chosen || a.typed->count(option) > 0;
  a.in = a.garments.front();
  a.out = a.job.output.string();
  a.animation = a.job.settings.animation.string();
  a.auto_subdivide = a.typed->count("--subdivide") && !a.job.subdivide;
  return drape(a);
}

void add_drape(CLI::App& sub, DrapeArguments& a) {
  a.camera.size = "900,1100";
  sub.add_option("garment", a.garments,
                 "garment to read, where it lies on the body or about it, or a scene: a .toml file; several "
                 "are worn over each other, the first one innermost, and none passes through another")
      ->required();
  add_card(sub, card(a.job));
  begin_group(sub, group::picture);
  sub.add_option("--picture", a.picture, "PNG to write: the garment on the body, coloured, with a legend");
  begin_group(sub, group::picture, Audience::few);
  sub.add_option("--colour", a.colour, "of the picture: strain (default) or distance")
      ->check(CLI::IsMember({"strain", "distance"}));
  sub.add_flag("--no-legend", a.no_legend, "leave the bar of colours and the words out of the picture");
  a.flags.add_to(sub, io::used_by::drape);
  add_camera_options(sub, a.camera);
}

const Subcommand drape_subcommand(
    130, "drape",
    "Put a finished garment on a body, or hang it from its pins: how it comes to rest, and how it fits\n\n"
    "  furrow drape shirt.obj --body body.obj -o worn.ply --picture fit.png\n"
    "  furrow drape skirt.obj --body body.obj --fabric silk --band top=0.95 -o worn.ply\n"
    "  furrow drape leggings.obj skirt.obj --body body.obj -o worn.ply\n"
    "  furrow drape shirt.obj --body body.obj --fabrics cotton,silk,denim --picture fabrics.png\n"
    "  furrow drape shirt.obj --made-for anna.obj --body berta.obj -o worn.ply\n"
    "  furrow drape curtain.obj --pin-loop top -o hangs.ply",
    add_drape, run_drape);

}  // namespace
}  // namespace furrow::cli
