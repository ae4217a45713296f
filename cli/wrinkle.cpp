// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/wrinkle.h"

#include <filesystem>
#include <memory>

#include "cli/camera_options.h"
#include "cli/common.h"
#include "cli/line_round.h"
#include "cli/max_weights.h"
#include "cli/pins.h"
#include "cli/prepare_garment.h"
#include "cli/recorded_options.h"
#include "cli/smoothing_options.h"
#include "cli/subcommands.h"
#include "cli/wrinkle_reports.h"
#include "geometry/errors.h"
#include "geometry/property_names.h"
#include "io/bytes_file.h"
#include "io/resolve_strokes.h"
#include "io/scene_file.h"
#include "io/state_file.h"
#include "io/stroke_file.h"
#include "io/wrinkle_record.h"

namespace furrow::cli {
namespace {

struct WrinkleArguments : CommonArguments {
  std::string in, strokes, state, inserted, preview;
  std::vector<std::string> without;
  double height = geometry::Stroke{}.height, fade = io::SceneLines{}.fade;
  std::string rule = "safe", rest = "drawn", region = "two-ring";
  std::optional<double> density;
  std::optional<int> max_weights;
  geometry::WrinkleOptions options;
  SmoothingArguments smoothing;
  CameraArguments camera;
  const CLI::App* typed = nullptr;  ///< what was on the command line
};

/// A garment, perhaps in motion, and the strokes to be drawn on it.
struct Drawing {
  io::MeshFile file;
  std::string path;
  std::vector<io::DrawnStroke> strokes;
  std::optional<io::SavedState> state;  ///< its mesh is in `file`
};

geometry::WrinkleOptions to_options(const WrinkleArguments& a) {
  using namespace geometry;
  WrinkleOptions o = a.options;
  o.smoothing = to_options(a.smoothing);
  o.insertion.rule = a.rule == "paper" ? InsertionRule::paper : InsertionRule::safe;
  o.rest = a.rest == "flat" ? RestRule::flat : a.rest == "copied" ? RestRule::copied : RestRule::drawn;
  o.region = a.region == "whole-mesh" ? SmoothingRegion::whole_mesh : SmoothingRegion::two_ring;
  return o;
}

void add_options(CLI::App& sub, WrinkleArguments& a) {
  sub.add_option("--height", a.height, "height of strokes that name none [m]; > 0 ridge, < 0 valley")
      ->capture_default_str();
  sub.add_option("--max-distance", a.options.insertion.max_distance,
                 "how far a stroke may lie from the surface [m]")
      ->capture_default_str();
  sub.add_option("--rule", a.rule,
                 "safe: flips that would spoil the mesh are refused; paper: the paper's plain rule")
      ->check(CLI::IsMember({"safe", "paper"}))
      ->capture_default_str();
  sub.add_option(
         "--rest", a.rest,
         "drawn: a line adds cloth, rest angles stay; copied: they turn, too; flat: the rest stays as it was")
      ->check(CLI::IsMember({"drawn", "flat", "copied"}))
      ->capture_default_str();
  sub.add_option("--region", a.region, "what is smoothed: two-ring (around the lines) or whole-mesh")
      ->check(CLI::IsMember({"two-ring", "whole-mesh"}))
      ->capture_default_str();
  sub.add_option("--density", a.density, "mass of the cloth [kg/m^2]; default that of the file, else 0.15");
  add_max_weights(sub, a.max_weights);
}

/// The garment that a wrinkled mesh was made of: where it was, or beside the mesh; unchanged.
std::string find_garment(const io::WrinkleRecord& record, const std::string& wrinkled) {
  namespace fs = std::filesystem;
  const fs::path named = record.garment, folder = fs::path(wrinkled).parent_path();
  for (const fs::path& path : {named, folder / named, folder / named.filename()})
    if (fs::is_regular_file(path) && io::content_hash(path) == record.garment_hash) return path.string();
  throw geometry::ContentError(
      wrinkled + ": the garment '" + record.garment +
      "' that its lines were drawn on is not there, or has changed; lay it beside this "
      "file, or write the strokes with furrow strokes and draw them on another");
}

/// The options that a wrinkled mesh was made with, and over them those of the command line.
void take_options(WrinkleArguments& a, const io::WrinkleRecord& record) {
  CLI::App flags;
  add_options(flags, a);
  add_smoothing_options(flags, a.smoothing);
  try {
    parse_recorded(flags, record.options, *a.typed);
  } catch (const CLI::ParseError& e) {
    throw geometry::ContentError(a.in + ": the options in its record cannot be read: " + e.what());
  }
}

/// The untouched garment and the strokes of a wrinkled mesh, and the options that it was made with.
Drawing drawing_again(WrinkleArguments& a) {
  const auto record = io::find_wrinkle_record(read_mesh(a.in, a));
  if (!record || record->strokes.empty() || record->garment.empty())
    throw UsageError(a.in + " holds no strokes to draw again: name a file of strokes");
  if (a.typed->count("--height"))
    throw UsageError("--height: the strokes of " + a.in +
                     " have theirs; change them with furrow strokes --height, and draw that file");
  take_options(a, *record);
  const std::string garment = find_garment(*record, a.in);
  refuse_same({a.out, a.inserted, a.preview, a.camera.save_camera}, {garment});
  return {read_garment(garment, a), garment, io::drawn_strokes_from(record->strokes, a.in), {}};
}

Drawing read_drawing(WrinkleArguments& a) {
  Drawing drawing;
  if (!a.state.empty()) {
    // With --state the one file that is named is that of the strokes.
    if (!a.strokes.empty()) throw UsageError(a.in + ": --state has its garment; leave the mesh away");
    if (a.density) throw UsageError("--density: furrow simulate --state S --density changes that of a state");
    drawing.state = io::read_state(a.state);
    const Json& scene = drawing.state->scene;
    if (!a.unit && scene.contains("unit")) a.unit = scene["unit"].get<std::string>();
    if (!a.up && scene.contains("up")) a.up = scene["up"].get<std::string>();
    drawing.file = std::move(drawing.state->file);
    drawing.strokes = io::read_drawn_strokes(a.in, a.height, read_options(a));
  } else if (a.strokes.empty()) {
    drawing = drawing_again(a);
  } else {
    drawing = {read_garment(a.in, a), a.in, io::read_drawn_strokes(a.strokes, a.height, read_options(a)), {}};
  }
  if (!a.without.empty()) leave_out(drawing.strokes, a.without);
  return drawing;
}

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

void write_result(const WrinkleArguments& a, Drawing& drawing, std::size_t old_count) {
  if (!drawing.state) return write_mesh(drawing.file, a);
  pin_new_vertices(drawing.file.mesh, old_count, drawing.state->pins);
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
  LineTarget target{file, drawing.path, a.density, nullptr, {}};
  if (drawing.state) {
    target.moving = &drawing.state->simulation;
    target.springs = springs_of(*drawing.state, file, a.state);
    target.pins = drawing.state->pins;
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
  if (a.max_weights) limit_noted_weights(file, *a.max_weights);
  if (inserted) write_preview(preview_of(*inserted, before, round.report, *io::find_wrinkle_record(file)), a);
  if (!a.out.empty()) write_result(a, drawing, before.number_of_vertices());
  Json json = to_json(round.report, file.mesh, round.first_line);
  if (round.moving) json["moving"] = to_json(*round.moving, drawing.state->simulation.time);
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
  CLI::App* sub =
      app.add_subcommand("wrinkle",
                         "Turn drawn ridge and valley lines into wrinkles\n\n"
                         "  furrow wrinkle shirt.obj lines.json -o wrinkled.ply\n"
                         "  furrow wrinkle shirt.obj lines.json --preview lines.png --view front\n"
                         "  furrow wrinkle wrinkled.ply --without fold -o less.ply\n"
                         "  furrow wrinkle --state at1.ply more.json -o at1-more.ply\n"
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
  add_options(*sub, *a);
  add_smoothing_options(*sub, a->smoothing);
  add_camera_options(*sub, a->camera);
  add_common_options(*sub, *a);
  a->typed = sub;
  sub->callback([a] { wrinkle(*a); });
}

}  // namespace furrow::cli
