// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/wrinkle.h"

#include <filesystem>
#include <memory>
#include <sstream>

#include "cli/camera_options.h"
#include "cli/common.h"
#include "cli/max_weights.h"
#include "cli/smoothing_options.h"
#include "cli/subcommands.h"
#include "cli/wrinkle_reports.h"
#include "geometry/errors.h"
#include "geometry/property_names.h"
#include "io/bytes_file.h"
#include "io/resolve_strokes.h"
#include "io/stroke_file.h"
#include "io/wrinkle_record.h"

namespace furrow::cli {
namespace {

struct WrinkleArguments : CommonArguments {
  std::string in, strokes, inserted, preview;
  std::vector<std::string> without;
  double height = geometry::Stroke{}.height;
  std::string rule = "safe", rest = "drawn", region = "two-ring";
  std::optional<double> density;
  std::optional<int> max_weights;
  geometry::WrinkleOptions options;
  SmoothingArguments smoothing;
  CameraArguments camera;
};

/// A garment and the strokes to be drawn on it.
struct Drawing {
  io::MeshFile file;
  std::string path;
  std::vector<io::DrawnStroke> strokes;
};

geometry::WrinkleOptions to_options(const WrinkleArguments& a) {
  using namespace geometry;
  WrinkleOptions o = a.options;
  o.smoothing = to_options(a.smoothing);
  o.insertion.rule = a.rule == "paper" ? InsertionRule::paper : InsertionRule::safe;
  o.rest = a.rest == "flat" ? RestRule::flat : RestRule::drawn;
  o.region = a.region == "whole-mesh" ? SmoothingRegion::whole_mesh : SmoothingRegion::two_ring;
  return o;
}

/// The flags that say the same, for the record in the file.
std::string flags(const WrinkleArguments& a, const geometry::WrinkleOptions& o) {
  const auto number = [](double x) { return Json(x).dump(); };
  return "--rule " + a.rule + " --rest " + a.rest + " --region " + a.region + " --max-distance " +
         number(a.options.insertion.max_distance) + " --density " + number(o.density) + " --iterations " +
         std::to_string(a.smoothing.iterations) + " --lambda " + number(a.smoothing.lambda) + " --mu " +
         number(a.smoothing.mu) + " --weights " + a.smoothing.weights +
         (a.smoothing.keep_lines ? " --keep-lines" : "") + (a.smoothing.keep_border ? " --keep-border" : "");
}

/// Continues what an earlier round of lines left: their ids, the mean rest lengths before any line, the
/// density.
geometry::WrinkleOptions continued(geometry::WrinkleOptions o, const WrinkleArguments& a,
                                   const io::MeshFile& file, const std::optional<io::WrinkleRecord>& record) {
  o.first_line = next_line(file.mesh);
  if (record) {
    o.first_line = std::max(o.first_line, static_cast<int>(record->lines.size()));
    o.mean_structural_length = record->mean_structural_length;
    if (record->mean_bending_length > 0) o.mean_bending_length = record->mean_bending_length;
  }
  o.density = a.density.value_or(record ? record->density : o.density);
  return o;
}

/// The record of the lines of earlier rounds and of this one.
io::WrinkleRecord record_of(const WrinkleArguments& a, const geometry::WrinkleOptions& o,
                            const std::optional<io::WrinkleRecord>& earlier, const Drawing& drawing,
                            const geometry::WrinkleReport& report) {
  io::WrinkleRecord record = earlier.value_or(io::WrinkleRecord{});
  record.mean_structural_length = report.mean_structural_length;
  record.mean_bending_length = report.mean_bending_length;
  record.density = o.density;
  record.options = flags(a, o);
  record.lines.resize(o.first_line, {"", geometry::kUnset, geometry::kUnset, geometry::kUnset});
  for (const geometry::WrinkledLine& line : report.lines)
    record.lines.push_back(
        {line.name, line.height, line.drawn_height, line.smoothed_height, line.base_height});
  const bool from_pipe = drawing.path == "-";
  record.garment = from_pipe ? "" : drawing.path;
  record.garment_hash = from_pipe ? "" : io::content_hash(drawing.path);
  std::ostringstream strokes;
  io::write_strokes(strokes, drawing.strokes);
  record.strokes = strokes.str();
  return record;
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
  sub.add_option("--rest", a.rest, "drawn: a line adds cloth; flat: rest lengths stay as they were")
      ->check(CLI::IsMember({"drawn", "flat"}))
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

/// The untouched garment and the strokes of a wrinkled mesh, and the options that it was made with.
Drawing drawing_again(WrinkleArguments& a) {
  const io::MeshFile wrinkled = read_mesh(a.in, a);
  const auto record = io::find_wrinkle_record(wrinkled);
  if (!record || record->strokes.empty() || record->garment.empty())
    throw UsageError(a.in + " holds no strokes to draw again: name a file of strokes");
  CLI::App flags;
  add_options(flags, a);
  add_smoothing_options(flags, a.smoothing);
  try {
    flags.parse(record->options);
  } catch (const CLI::ParseError& e) {
    throw geometry::ContentError(a.in + ": the options in its record cannot be read: " + e.what());
  }
  if (!a.unit) a.unit = record->unit;
  if (!a.up) a.up = record->up;
  const std::string garment = find_garment(*record, a.in);
  return {read_garment(garment, a), garment, io::drawn_strokes_from(record->strokes, a.in)};
}

Drawing read_drawing(WrinkleArguments& a) {
  Drawing drawing;
  if (a.strokes.empty()) {
    drawing = drawing_again(a);
  } else {
    drawing = {read_garment(a.in, a), a.in, io::read_drawn_strokes(a.strokes, a.height, read_options(a))};
  }
  for (const std::string& name : a.without)
    drawing.strokes.erase(drawing.strokes.begin() + io::find_stroke(drawing.strokes, name));
  if (drawing.strokes.empty()) throw UsageError("--without leaves no stroke to draw");
  return drawing;
}

void check_outputs(const WrinkleArguments& a) {
  if (a.out.empty() && a.preview.empty())
    throw UsageError("wrinkle writes a mesh (-o) or a picture (--preview)");
  if (a.out.empty() && !a.inserted.empty()) throw UsageError("--inserted goes with -o");
  if (!a.out.empty()) check_output(a.out);
  if (!a.inserted.empty()) {
    check_output(a.inserted);
    refuse_same(a.inserted, a.out);
  }
  for (const std::string& file : {a.in, a.strokes, a.out, a.inserted}) refuse_same(a.preview, file);
}

void write_preview(const io::RenderScene& scene, const WrinkleArguments& a) {
  const io::RenderOptions options = render_options({&scene, 1}, a.camera);
  io::write_png(a.preview, io::render(scene, options));
  save_camera(options, a.camera);
}

void wrinkle(WrinkleArguments a) {
  check_outputs(a);
  Drawing drawing = read_drawing(a);
  io::MeshFile& file = drawing.file;
  const io::ResolvedStrokes resolved = io::resolve_strokes(drawing.strokes, file);
  for (const std::string& w : resolved.warnings) warn(w, a);
  const std::optional<io::WrinkleRecord> earlier = io::find_wrinkle_record(file);
  const geometry::WrinkleOptions options = continued(to_options(a), a, file, earlier);
  std::optional<geometry::Mesh> inserted, displaced;
  const auto keep_stage = [&](geometry::Stage stage, const geometry::Mesh& mesh) {
    if (!a.preview.empty() && stage == geometry::Stage::inserted) inserted = mesh;
    if (!a.inserted.empty() && stage == geometry::Stage::displaced) displaced = mesh;
  };
  const geometry::Mesh before = file.mesh;
  const geometry::WrinkleReport report = geometry::wrinkle(file.mesh, resolved.strokes, options, keep_stage);
  for (const std::string& w : report.insertion.warnings) warn(w, a);
  if (a.max_weights) geometry::normalize_skin_weights(file.mesh, *a.max_weights);
  const io::WrinkleRecord record = record_of(a, options, earlier, drawing, report);
  if (inserted) write_preview(preview_of(*inserted, before, report, record), a);
  set_wrinkle_record(file, record);
  if (!a.out.empty()) write_mesh(file, a);
  const Json json = to_json(report, file.mesh, options.first_line);
  if (displaced) {
    file.mesh = std::move(*displaced);
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
                         "  furrow wrinkle skirt.obj lines.obj --height -0.02 -o wrinkled.ply");
  sub->add_option("mesh", a->in, "garment to read")->required();
  sub->add_option(
      "strokes", a->strokes,
      "lines: JSON, or the l elements of an OBJ file; none: those that the mesh, a wrinkled PLY, was "
      "made with are drawn again on its garment, with its options");
  sub->add_option("-o,--output", a->out, "mesh to write; PLY keeps rest lengths, masses and lines");
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
  sub->callback([a] { wrinkle(*a); });
}

}  // namespace furrow::cli
