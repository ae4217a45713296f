// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/wrinkle_drawing.h"

#include <filesystem>

#include "cli/line_round.h"
#include "cli/max_weights.h"
#include "cli/recorded_options.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "io/base/bytes_file.h"
#include "io/mesh/wrinkle_record.h"
#include "io/stroke/resolve_strokes.h"
#include "io/stroke/stroke_file.h"

namespace furrow::cli {
namespace {

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
  add_drawing_options(flags, a);
  add_smoothing_options(flags, a.smoothing);
  try {
    parse_recorded(flags, record.options, *a.typed);
  } catch (const CLI::ParseError& e) {
    throw geometry::ContentError(a.in + ": the options in its record cannot be read: " + e.what());
  }
}

/// The untouched garment and the strokes of a wrinkled mesh, and the options that it was made with.
Drawing drawing_again(WrinkleArguments& a) {
  const io::MeshFile wrinkled = read_mesh(a.in, a);
  const auto record = io::find_wrinkle_record(wrinkled);
  if (!record || record->strokes.empty() || record->garment.empty())
    throw UsageError(a.in + " holds no strokes to draw again: name a file of strokes");
  if (a.typed->count("--height"))
    throw UsageError("--height: the strokes of " + a.in +
                     " have theirs; change them with furrow strokes --height, and draw that file");
  take_options(a, *record);
  if (a.rest != "keep" && geometry::find_map(wrinkled.mesh, geometry::attribute::hinge_stiffness))
    warn(a.in + " was kept; its lines are drawn again without that: add --rest keep, or keep the result", a);
  const std::string garment = find_garment(*record, a.in);
  refuse_same({a.out, a.inserted, a.preview, a.camera.save_camera}, {garment});
  return {read_garment(garment, a), garment, io::drawn_strokes_from(record->strokes, a.in), {}};
}

}  // namespace

geometry::WrinkleOptions to_options(const WrinkleArguments& a) {
  using namespace geometry;
  WrinkleOptions o = a.options;
  o.smoothing = to_options(a.smoothing);
  o.insertion.rule = a.rule == "paper" ? InsertionRule::paper : InsertionRule::safe;
  o.rest = a.rest == "flat" ? RestRule::flat : a.rest == "copied" ? RestRule::copied : RestRule::drawn;
  o.region = a.region == "whole-mesh" ? SmoothingRegion::whole_mesh : SmoothingRegion::two_ring;
  return o;
}

void add_drawing_options(CLI::App& sub, WrinkleArguments& a) {
  sub.add_option("--height", a.height, "height of strokes that name none [m]; > 0 ridge, < 0 valley")
      ->capture_default_str();
  sub.add_option("--max-distance", a.options.insertion.max_distance,
                 "how far a stroke may lie from the surface [m]")
      ->capture_default_str();
  sub.add_option("--rule", a.rule,
                 "safe: flips that would spoil the mesh are refused; paper: the paper's plain rule")
      ->check(CLI::IsMember({"safe", "paper"}))
      ->capture_default_str();
  sub.add_option("--rest", a.rest,
                 "drawn: a line adds cloth, rest angles stay; copied: they turn, too; flat: the rest stays "
                 "as it was; "
                 "keep: the drawn shape bears its weight (needs --fabric or hinges; docs/keep.md)")
      ->check(CLI::IsMember({"drawn", "flat", "copied", "keep"}))
      ->capture_default_str();
  sub.add_option("--region", a.region, "what is smoothed: two-ring (around the lines) or whole-mesh")
      ->check(CLI::IsMember({"two-ring", "whole-mesh"}))
      ->capture_default_str();
  sub.add_option("--density", a.density, "mass of the cloth [kg/m^2]; default that of the file, else 0.15");
  add_max_weights(sub, a.max_weights);
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

}  // namespace furrow::cli
