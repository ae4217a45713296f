// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/chain/wrinkle.h"

#include <algorithm>
#include <iostream>
#include <set>

#include "cli/camera_options.h"
#include "cli/card_options.h"
#include "cli/help.h"
#include "cli/print_text.h"
#include "cli/scene_flags.h"
#include "cli/subcommands.h"
#include "geometry/mesh/errors.h"
#include "io/base/field_words.h"
#include "io/base/figure_path.h"
#include "io/picture/png_file.h"
#include "io/picture/render_scene.h"
#include "io/scene/relocated.h"
#include "io/scene/scene_rules.h"
#include "jobs/base/read_inputs.h"
#include "jobs/chain/wrinkle_stages.h"
#include "jobs/cloth/fabric_file.h"
#include "jobs/cloth/recorded_material.h"
#include "jobs/draw/recorded_drawing.h"
#include "jobs/draw/wrinkle_reports.h"

namespace furrow::cli {
namespace {

struct WrinkleArguments : CommonArguments {
  std::string in, strokes, state, inserted, smoothed, preview;
  WrinkleJob job;
  SceneFlags flags;  ///< of --rest keep and --settle
  CameraArguments camera;
};

void check_call(const WrinkleArguments& a) {
  if (a.state.empty() && io::ending_of(a.in) == ".json")
    throw UsageError(a.in + ": is a file of strokes; the garment comes first, then its strokes");
  if (a.out.empty() && a.preview.empty())
    throw UsageError("wrinkle writes a mesh (-o) or a picture (--picture)");
  if (a.out.empty() && !a.inserted.empty()) throw UsageError("--inserted goes with -o");
  check_picture(a.preview, "--picture");
  check_folder(a.camera.save_camera);
  if (!a.state.empty()) refuse_same(a.out, a.in);  // with --state these are the strokes
  const std::string flag = a.flags.first();
  if (!flag.empty() && !a.job.keep && !a.job.settle)
    throw UsageError(flag + ": goes with --rest keep or --settle; furrow simulate chooses it otherwise");
  if (a.job.settle && a.out.empty()) throw UsageError("--settle goes with -o");
  if (a.typed->count("--subdivide") && !a.job.settle)
    throw UsageError("--subdivide goes with --settle; furrow subdivide refines a garment by itself");
  if (a.smoothed == "-")
    throw UsageError("--smoothed: only the garment at the end (-o) can go to standard output");
  if (!flag.empty() && !a.state.empty())
    throw UsageError(flag + ": --state has material, pins and body; leave it out");
}

/// With --state the one file that is named is that of the strokes.
void take_state(const WrinkleArguments& a, WrinkleJob& job) {
  if (!a.strokes.empty()) throw UsageError(a.in + ": --state has its garment; leave out the mesh");
  if (job.density) throw UsageError("--density: furrow simulate --state S --density changes that of a state");
  job.state = io::read_state(a.state);
  job.state_path = a.state;
  job.strokes = std::filesystem::path(a.in);
}

/// Takes over the options that a wrinkled mesh was made with; those of the command line go over them.
void take_recorded_options(const WrinkleArguments& a, WrinkleJob& job, const std::string& recorded) {
  CLI::App flags;
  add_card(flags, drawing_card(job));
  std::vector<std::string> again;
  for (const CLI::Option* option : a.typed->get_options())
    if (option->count() > 0 && !option->get_lnames().empty())
      if (const std::string name = "--" + option->get_lnames()[0]; flags.get_option_no_throw(name))
        again.push_back(name + "=" + option->results().back());
  try {
    flags.parse(recorded);
    job.hold = job.options.rest == geometry::RestRule::drawn;  // which every record names
    flags.parse(std::move(again));
  } catch (const CLI::ParseError& e) {
    throw geometry::ContentError(a.in + ": the options in its record cannot be read: " + e.what());
  }
}

/// The garment, strokes and options that a wrinkled mesh was made with, and over them those of the command
/// line.
void draw_again(const WrinkleArguments& a, WrinkleJob& job) {
  refuse_same({a.out, a.inserted, a.preview, a.camera.save_camera}, {a.in});
  Terminal terminal(a);
  Frame frame = a;
  take_noted_frame(frame, {a.in});
  RecordedDrawing recorded = recorded_drawing(a.in, {frame, terminal});
  for (const char* option : {"--height", "--width"})
    if (a.typed->count(option))
      throw UsageError(option + (": the strokes of " + a.in) +
                       " have theirs; change them with furrow strokes --change, and draw that file");
  take_recorded_options(a, job, recorded.options);
  if (!job.keep && recorded.was_kept)
    warn(a.in + " was kept; its lines are drawn again without that: add --rest keep, or keep the result", a);
  refuse_same({a.out, a.inserted, a.preview, a.camera.save_camera}, {recorded.garment.string()});
  job.frame = frame;
  job.garment = recorded.garment;
  job.strokes = std::move(recorded.strokes);
}

/// Options that the rule in use would not look at are refused, rather than ignored.
void check_rule(const WrinkleArguments& a, const WrinkleJob& job) {
  const geometry::InsertionRule rule = job.options.insertion.rule;
  const bool folds = rule == geometry::InsertionRule::fold;
  for (const std::string& option : io::options_without_use(rule))
    if (a.typed->count(io::flag_of(option)))
      throw UsageError("`" + option + "`: the rule " +
                       (folds                                   ? "fold"
                        : rule == geometry::InsertionRule::safe ? "safe"
                                                                : "paper") +
                       " does not use it; it goes with `rule=" +
                       (folds ? "safe` or `rule=paper` (fold has `fold_iterations`)" : "fold`"));
}

/// What a garment is kept in, or comes to rest in: material, forces, pins and body of the state, or of flags.
SceneInput surroundings(const WrinkleArguments& a, const WrinkleJob& job) {
  io::TomlDocument document;
  if (job.state) document = io::document_of(job.state->scene, a.state);
  for (const char* list : {"lines", "pins"}) io::make_list(document, list);
  a.flags.apply(document);
  jobs::take_fabric_file(document, job.state_path.parent_path());
  if (!job.state) jobs::take_recorded_material(document, a.in);
  // Of a mesh drawn again, job.density is that of its record: the fabric's goes before it.
  const bool has_fabric = document.root->value("material", Json::object()).contains("preset");
  if (job.density && (a.typed->count("--density") || !has_fabric))
    io::set_value(document, "material.density", *job.density, "--density");
  if (job.keep && !job.settle) io::set_value(document, "garment.rest", "keep", "`rest=keep`");
  return {document, job.state_path.parent_path()};
}

/// What else than lines a drawing that neither is kept nor rests is told of its garment.
void take_sets(const WrinkleArguments& a, WrinkleJob& job) {
  const std::set<std::string> known{"attach", "attach_parts", "free_parts", "join"};
  io::TomlDocument document;
  a.flags.apply(document);
  if (document.root->empty()) return;
  for (const auto& [table, values] : document.root->items())
    for (const auto& [key, value] : values.items())
      if (table != "garment" || !known.contains(key) || job.state)
        throw UsageError("--set " + table + (key.empty() ? "" : "." + key) +
                         ": goes with --rest keep or --settle; without them garment.attach, attach_parts, "
                         "free_parts and join do, on a mesh");
  const io::Scene scene = jobs::scene_of(document, "");
  job.attach = scene.attach;
  job.join = scene.join;
}

WrinkleJob job_of(const WrinkleArguments& a) {
  WrinkleJob job = a.job;
  job.frame = a;
  if (!a.state.empty()) {
    take_state(a, job);
  } else if (a.strokes.empty()) {
    draw_again(a, job);
  } else {
    job.garment = std::filesystem::path(a.in);
    job.strokes = std::filesystem::path(a.strokes);
  }
  check_rule(a, job);
  if (job.keep) job.keep = surroundings(a, job);
  if (job.settle) job.settle = surroundings(a, job);
  if (!job.keep && !job.settle) take_sets(a, job);
  job.wants_stages = !a.preview.empty() && !job.settle;
  job.more_outputs = {a.preview, a.camera.save_camera};
  job.more_inputs = {a.camera.camera};
  return job;
}

/// The body that the garment rests on.
std::optional<io::RenderMesh> body_shown(const WrinkleReport& report, const WrinkleJob& job,
                                         const WrinkleArguments& a) {
  if (!report.rest) return std::nullopt;
  const io::Scene around = jobs::scene_of(job.settle->settings, job.settle->folder);
  const std::optional<io::MeshFile> file = read_body_of(around, in_frame(a, report.frame));
  if (!file) return std::nullopt;
  io::RenderMesh body = io::render_mesh_from(file->mesh, io::Style::body);
  body.colour = io::body_colour;
  body.framed = false;
  return body;
}

void write_preview(const WrinkleReport& report, const WrinkleJob& job, const WrinkleArguments& a) {
  io::RenderScene scene = preview_scene(report);
  if (const auto body = body_shown(report, job, a)) scene.meshes.push_back(*body);
  const io::RenderOptions options = render_options({&scene, 1}, a.camera);
  io::write_png(a.preview, io::render(scene, options));
  save_camera(options, a.camera);
}

Lines wrinkle_lines(const Json& report) {
  const Json& drawn = list_of(report, "lines");
  Lines lines{counted(drawn.size(), "line") + " drawn, " + std::to_string(count_of(report, "inserted")) +
              " vertices inserted; smallest angle " + number(value_of(report, "min_angle_deg")) + " degrees"};
  const std::size_t most = 4;
  for (std::size_t i = 0; i < std::min(most, drawn.size()); ++i) {
    const Json& line = drawn[i];
    if (line.contains("gather")) {
      lines.push_back(name_of_line(line) + ": has a thread of " + per_cent(value_of(line, "gather")) +
                      " of its length, which draws it in as the cloth comes to rest");
      if (value_of(line, "height") == 0) continue;
    }
    const std::string asked = name_of_line(line) + ": asked " + length(line, "height");
    lines.push_back(line.contains("crest_height") ? asked + ", " + length(line, "crest_height") +
                                                        " at the crest, " + length(line, "width") + " wide"
                                                  : asked + ", drawn " + length(line, "drawn_height") +
                                                        ", smoothed to " + length(line, "smoothed_height"));
  }
  if (drawn.size() > most) lines.push_back("and " + counted(drawn.size() - most, "more line"));
  if (const std::size_t n = list_of(report, "line_edges_missing").size())
    lines.push_back("look at: " + counted(n, "edge") + " of the lines could not be made");
  if (const Json& kept = table_of(report, "kept"); !kept.empty())
    lines.push_back(balance_of(kept, "kept: ", "the drawn shape"));
  add_crossings(lines, report);
  if (const Json& rest = table_of(report, "at_rest"); !rest.empty()) {
    lines.push_back("then " + text_of(rest, "outcome") + " (" + number(value_of(rest, "seconds")) +
                    " s); angle defect " + number(value_of(rest, "angle_defect")) + " rad/m^2");
    add_heights(lines, rest);
  }
  return lines;
}

/// What a user may call next; empty: nothing.
std::vector<std::string> next_command(const WrinkleArguments& a, const WrinkleReport& report) {
  if (a.out.empty() || a.out == "-") return {};
  if (!a.state.empty()) return {"furrow", "simulate", "--state", a.out, "-o", "worn.ply"};
  if (report.rest)
    return a.preview.empty() ? std::vector<std::string>{"furrow", "render", a.out, "-o", "rests.png"}
                             : std::vector<std::string>{};
  if (a.strokes.empty() || a.job.keep)
    return {"furrow", "simulate", a.out, "--body", "BODY", "-o", "worn.ply"};
  return {"furrow", "wrinkle", a.in, a.strokes, "--settle", "--body", "BODY", "-o", "rests.ply"};
}

int wrinkle(const WrinkleArguments& a) {
  check_call(a);
  if (a.job.settle) catch_interrupts();
  const WrinkleJob job = job_of(a);
  Terminal terminal(a, a.job.settle ? a.job.budget : unlimited);
  const WrinkleReport report = jobs::wrinkle(job, terminal);
  const CommonArguments common = in_frame(a, report.frame);
  if (!a.preview.empty()) write_preview(report, job, a);
  if (a.out == "-") write_mesh(report.garment, common);
  if (a.inserted == "-") write_mesh("-", inserted_garment(report), common);
  Json json = to_json(report);
  json["written"] = names_of_files({a.out, a.inserted, a.smoothed, a.preview, a.camera.save_camera});
  print_report(json, a,
               {wrinkle_lines(json),
                {a.out, a.inserted, a.smoothed, a.preview, a.camera.save_camera},
                next_command(a, report)});
  for (const Warning& w : report.failures) std::cerr << "error: " << worded(w.text) << "\n";
  if (report.budget_spent) report_spent_budget(a.job.budget, {a.out});
  return exit_code_of(interrupted(), report.failures.empty() && !report.budget_spent);
}

int run_wrinkle(WrinkleArguments& a) {
  a.out = a.job.output.string();
  a.inserted = a.job.inserted.string();
  a.smoothed = a.job.smoothed.string();
  a.state = a.job.state_path.string();
  // A look before anything is changed takes a quarter of normal quality.
  if (!a.job.settle && !a.typed->count("--quality")) a.camera.quality = "draft";
  return wrinkle(a);
}

void add_wrinkle(CLI::App& sub, WrinkleArguments& a) {
  sub.add_option("mesh", a.in, "garment to read; with --state: the file of strokes")->required();
  begin_group(sub, group::lines);
  sub.add_option(
      "strokes,--strokes", a.strokes,
      "lines: JSON, or the l elements of an OBJ file; none: those that the mesh, a wrinkled PLY, was "
      "made with are drawn again on its garment, with its options");
  add_card(sub, card(a.job));
  begin_group(sub, group::picture);
  sub.add_option(
      "--picture", a.preview,
      "PNG of what is inserted where, before anything is displaced, or with --settle of the garment at rest "
      "on its body, faces that cross in magenta; without -o no mesh is written");
  a.flags.add_to(sub, io::used_by::wrinkle);
  add_camera_options(sub, a.camera);
}

const Subcommand wrinkle_subcommand(
    50, "wrinkle",
    "Turn drawn ridge and valley lines into wrinkles\n\n"
    "  furrow wrinkle shirt.obj lines.json -o wrinkled.ply\n"
    "  furrow wrinkle shirt.obj lines.json --picture lines.png --view front\n"
    "  furrow wrinkle wrinkled.ply --without fold -o less.ply\n"
    "  furrow wrinkle --state at1.ply more.json -o at1-more.ply\n"
    "  furrow wrinkle sheet.obj lines.json --rest keep --fabric denim --pin-loop top -o kept.ply\n"
    "  furrow wrinkle skirt.obj lines.obj --height -0.02 -o wrinkled.ply\n"
    "  furrow wrinkle skirt.obj lines.json --settle --body body.obj --pin-loop top -o rests.ply",
    add_wrinkle, run_wrinkle);

}  // namespace
}  // namespace furrow::cli
