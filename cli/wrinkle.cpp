// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <memory>

#include "cli/keep_at_rest.h"
#include "cli/line_round.h"
#include "cli/max_weights.h"
#include "cli/pins.h"
#include "cli/prepare_garment.h"
#include "cli/recorded_material.h"
#include "cli/scene_input.h"
#include "cli/subcommands.h"
#include "cli/wrinkle_drawing.h"
#include "cli/wrinkle_reports.h"
#include "geometry/mesh/property_names.h"
#include "io/mesh/wrinkle_record.h"
#include "io/scene/relocated.h"
#include "io/scene/scene_file.h"
#include "io/scene/state_file.h"

namespace furrow::cli {
namespace {

void check_outputs(const WrinkleArguments& a) {
  if (a.out.empty() && a.preview.empty())
    throw UsageError("wrinkle writes a mesh (-o) or a picture (--preview)");
  if (a.out.empty() && !a.inserted.empty()) throw UsageError("--inserted goes with -o");
  if (!a.out.empty()) check_output(a.out);
  if (!a.state.empty() && !a.out.empty() && std::filesystem::path(a.out).extension() != ".ply")
    throw UsageError(a.out + ": lines drawn into a state make a state, a .ply file");
  if (!a.inserted.empty()) check_output(a.inserted);
  check_picture(a.preview, "--preview");
  check_folder(a.camera.save_camera);
  refuse_same({a.out, a.inserted, a.preview, a.camera.save_camera}, {a.strokes, a.camera.camera});
  // The result alone may take the place of what it was made of.
  refuse_same({a.inserted, a.preview, a.camera.save_camera}, {a.in, a.state});
  if (!a.state.empty()) refuse_same(a.out, a.in);  // with --state these are the strokes
  const std::string flag = a.flags.first();
  if (!flag.empty() && a.rest != "keep")
    throw UsageError(flag + ": goes with --rest keep; furrow simulate chooses it otherwise");
  if (!flag.empty() && !a.state.empty())
    throw UsageError(flag + ": --state has material, pins and body; leave it away");
}

void write_preview(const io::RenderScene& scene, const WrinkleArguments& a) {
  const io::RenderOptions options = render_options({&scene, 1}, a.camera);
  io::write_png(a.preview, io::render(scene, options));
  save_camera(options, a.camera);
}

/// The springs of the simulation that a state belongs to.
bridge::GatherOptions springs_of(const io::SavedState& state, const io::MeshFile& file,
                                 const std::string& path) {
  const io::TomlDocument document = io::document_of(state.scene, path);
  return spring_options(file, io::read_scene(document, std::filesystem::path(path).parent_path()).material);
}

/// What a garment is kept in: material, forces, pins and body of the state, or of flags.
io::TomlDocument surroundings(const WrinkleArguments& a, const Drawing& drawing) {
  io::TomlDocument document;
  if (drawing.state) document = io::document_of(drawing.state->scene, a.state);
  for (const char* list : {"lines", "pins"}) io::make_list(document, list);
  a.flags.apply(document);
  if (!drawing.state) take_recorded_material(document, a.in, nullptr);
  // Of a mesh drawn again, a.density is that of its record: the fabric's goes before it.
  const bool has_fabric = document.root.value("material", Json::object()).contains("preset");
  if (a.density && (a.typed->count("--density") || !has_fabric))
    io::set_value(document, "material.density", *a.density, "--density");
  io::set_value(document, "garment.rest", "keep", "--rest keep");
  return document;
}

void write_result(const WrinkleArguments& a, Drawing& drawing) {
  if (!drawing.state) return write_mesh(drawing.file, a);
  io::SavedState state = *drawing.state;
  state.file = drawing.file;
  const auto folder = [](const std::string& path) { return std::filesystem::path(path).parent_path(); };
  const io::TomlDocument document = io::document_of(state.scene, a.state);
  state.scene = io::relocated(document, folder(a.state), folder(a.out));
  io::write_state(a.out, std::move(state));
}

void wrinkle(WrinkleArguments a) {
  check_outputs(a);
  take_noted_frame(a, {a.in});
  Drawing drawing = read_drawing(a);
  io::MeshFile& file = drawing.file;
  std::optional<io::Scene> scene;
  io::TomlDocument document;
  if (a.rest == "keep") {
    document = surroundings(a, drawing);
    scene = scene_of(document, std::filesystem::path(a.state).parent_path());
  }
  const auto density = scene && !drawing.state ? scene->material.density : a.density;
  LineTarget target{file, drawing.path, density, nullptr, {}};
  std::vector<std::vector<int>> pins;
  if (drawing.state)
    pins = drawing.state->pins;
  else if (scene)
    pins = find_pins(file, scene->pins);
  if (drawing.state) {
    target.moving = &drawing.state->simulation;
    target.springs = springs_of(*drawing.state, file, a.state);
    target.pins = pins;
  }
  io::SceneLines lines;
  lines.options = to_options(a);
  lines.fade = a.fade;
  std::optional<geometry::Mesh> inserted, displaced;
  const auto keep_stage = [&](geometry::Stage stage, const geometry::Mesh& mesh) {
    if (!a.preview.empty() && stage == geometry::Stage::inserted) inserted = mesh;
    if (!a.inserted.empty() && stage == geometry::Stage::displaced) displaced = mesh;
  };
  const geometry::Mesh before = file.mesh;
  const LineRound round = draw_lines(target, drawing.strokes, lines, keep_stage);
  for (const std::string& w : round.warnings) warn(w, a);
  pin_new_vertices(file.mesh, before.number_of_vertices(), pins);
  if (drawing.state) drawing.state->pins = pins;
  Json kept;
  if (scene) {
    std::optional<WorldBody> body;
    if (scene->body) body.emplace(*scene->body, a);
    kept = keep_at_rest(file, *scene, pins, body ? &*body : nullptr, target.moving ? target.moving->time : 0,
                        drawing.state ? drawing.state->contact_gap : 0, target.moving, a);
  }
  if (a.max_weights) limit_noted_weights(file, *a.max_weights);
  if (inserted) write_preview(preview_of(*inserted, before, round.report, *io::find_wrinkle_record(file)), a);
  if (scene) warn_if_shape_only(a.out, a);
  if (scene && !drawing.state) note_material(file, document, 0);
  if (!a.out.empty()) write_result(a, drawing);
  Json json = to_json(round.report, file.mesh, round.first_line);
  if (round.moving) json["moving"] = to_json(*round.moving, drawing.state->simulation.time);
  if (scene) json["kept"] = std::move(kept);
  if (displaced) {
    file.mesh = std::move(*displaced);
    io::drop_motion(file);
    write_mesh(a.inserted, file, a);
  }
  print_report(json, a);
}

}  // namespace

void add_wrinkle(CLI::App& app) {
  auto a = std::make_shared<WrinkleArguments>();
  CLI::App* sub = app.add_subcommand(
      "wrinkle",
      "Turn drawn ridge and valley lines into wrinkles\n\n"
      "  furrow wrinkle shirt.obj lines.json -o wrinkled.ply\n"
      "  furrow wrinkle shirt.obj lines.json --preview lines.png --view front\n"
      "  furrow wrinkle wrinkled.ply --without fold -o less.ply\n"
      "  furrow wrinkle --state at1.ply more.json -o at1-more.ply\n"
      "  furrow wrinkle sheet.obj lines.json --rest keep --fabric denim --pin-loop top -o kept.ply\n"
      "  furrow wrinkle skirt.obj lines.obj --height -0.02 -o wrinkled.ply");
  sub->add_option("mesh", a->in, "garment to read; with --state: the file of strokes")->required();
  sub->add_option(
      "strokes", a->strokes,
      "lines: JSON, or the l elements of an OBJ file; none: those that the mesh, a wrinkled PLY, was "
      "made with are drawn again on its garment, with its options");
  sub->add_option("-o,--output", a->out, "mesh to write; PLY keeps rest lengths, masses and lines");
  sub->add_option(
      "--state", a->state,
      "draw into a simulation that was stopped (furrow simulate --save-state); -o is a state, too");
  sub->add_option("--fade", a->fade,
                  "with --state: how slowly the forces of the new lines set in [s]; inf: never")
      ->capture_default_str();
  sub->add_option("--without", a->without, "leave out the stroke of this name; may be given several times")
      ->allow_extra_args(false);
  sub->add_option("--inserted", a->inserted, "also write the mesh after insertion and before smoothing");
  sub->add_option(
      "--preview", a->preview,
      "PNG of what is inserted where, before anything is displaced; without -o no mesh is written");
  add_drawing_options(*sub, *a);
  a->flags.add_to(*sub, io::used_by::wrinkle);
  add_smoothing_options(*sub, a->smoothing);
  add_camera_options(*sub, a->camera);
  add_common_options(*sub, *a);
  a->typed = sub;
  sub->callback([a] { wrinkle(*a); });
}

}  // namespace furrow::cli
