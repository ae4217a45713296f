// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/run/line_round.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "geometry/mesh/property_names.h"
#include "io/base/bytes_file.h"
#include "io/scene/state_file.h"
#include "io/stroke/resolve_strokes.h"
#include "io/stroke/stroke_file.h"
#include "jobs/inputs.h"
#include "jobs/read_inputs.h"
#include "jobs/report/wrinkle_reports.h"
#include "jobs/run/gate.h"

namespace furrow::jobs {
namespace {

std::string number(double x) { return Json(x).dump(); }

const char* word_of(geometry::RestRule rule) {
  return rule == geometry::RestRule::flat ? "flat" : rule == geometry::RestRule::copied ? "copied" : "drawn";
}

std::string fold_flags(const geometry::WrinkleOptions& o) {
  using geometry::Detail;
  return std::string("--rule fold --rest ") + word_of(o.rest) + " --detail " +
         (o.detail == Detail::coarse ? "coarse"
          : o.detail == Detail::fine ? "fine"
                                     : "normal") +
         (o.flat_base ? " --flat-base" : "") + " --max-distance " + number(o.insertion.max_distance) +
         " --density " + number(o.density) + " --fold-iterations " + std::to_string(o.fold_iterations) +
         " --lambda " + number(o.smoothing.lambda) + " --mu " + number(o.smoothing.mu);
}

/// The flags of `wrinkle` that say the same, for the record in the file.
std::string flags(const geometry::WrinkleOptions& o) {
  using namespace geometry;
  const InsertionRule rule = o.insertion.rule;
  if (rule == InsertionRule::fold) return fold_flags(o);
  return std::string("--rule ") + (rule == InsertionRule::paper ? "paper" : "safe") + " --rest " +
         word_of(o.rest) + " --region " +
         (o.region == SmoothingRegion::whole_mesh ? "whole-mesh" : "two-ring") + " --max-distance " +
         number(o.insertion.max_distance) + " --density " + number(o.density) + " --iterations " +
         std::to_string(o.smoothing.iterations) + " --lambda " + number(o.smoothing.lambda) + " --mu " +
         number(o.smoothing.mu) + " --weights " +
         (o.smoothing.weights == SmoothingWeights::cotangent ? "cotangent" : "uniform") +
         (o.smoothing.lines == LineRule::keep ? " --keep-lines" : "") +
         (o.smoothing.border == BorderRule::keep ? " --keep-border" : "");
}

geometry::WrinkleOptions continued(geometry::WrinkleOptions o, const geometry::Mesh& mesh,
                                   const std::optional<io::WrinkleRecord>& earlier,
                                   std::optional<double> density) {
  o.first_line = next_line(mesh);
  if (earlier) {
    o.first_line = std::max(o.first_line, static_cast<int>(earlier->lines.size()));
    o.mean_structural_length = earlier->mean_structural_length;
    if (earlier->mean_bending_length > 0) o.mean_bending_length = earlier->mean_bending_length;
  }
  o.density = density.value_or(earlier && earlier->density > 0 ? earlier->density : o.density);
  return o;
}

io::WrinkleRecord record_of(const geometry::WrinkleOptions& o,
                            const std::optional<io::WrinkleRecord>& earlier,
                            const geometry::WrinkleReport& report) {
  io::WrinkleRecord record = earlier.value_or(io::WrinkleRecord{});
  record.mean_structural_length = report.mean_structural_length;
  record.mean_bending_length = report.mean_bending_length;
  record.density = o.density;
  record.options = flags(o);
  record.lines.resize(o.first_line,
                      {"", geometry::unset_value, geometry::unset_value, geometry::unset_value});
  for (const geometry::WrinkledLine& line : report.lines)
    record.lines.push_back({line.name, line.height, line.drawn_height, line.smoothed_height, line.base_height,
                            line.width, line.sharpness, line.press});
  return record;
}

/// So that the lines can be drawn again, without some of them, from the wrinkled mesh alone.
void note_strokes(io::WrinkleRecord& record, const std::string& garment, std::vector<io::DrawnStroke> strokes,
                  geometry::InsertionRule rule) {
  if (rule != geometry::InsertionRule::fold)
    for (io::DrawnStroke& drawn : strokes)
      if (drawn.stroke.width && !drawn.stroke.sharpness) drawn.stroke.sharpness = 0.5;
  const bool is_file = !garment.empty() && garment != "-";
  record.garment = is_file ? garment : "";
  record.garment_hash = is_file ? io::content_hash(garment) : "";
  std::ostringstream text;
  io::write_strokes(text, strokes);
  record.strokes = text.str();
}

/// Diagonal of the bounding box [m].
double size_of(const geometry::Mesh& mesh) {
  CGAL::Bbox_3 box;
  for (geometry::Vertex v : mesh.vertices()) box += mesh.point(v).bbox();
  return std::hypot(box.x_span(), box.y_span(), box.z_span());
}

/// A height in millimetres, say, that was meant as such.
void warn_of_heights(const std::vector<geometry::Stroke>& strokes, double garment,
                     std::vector<std::string>& warnings) {
  for (const geometry::Stroke& stroke : strokes)
    if (std::abs(stroke.height) > garment)
      warnings.push_back("stroke '" + stroke.name + "': its height of " + Json(stroke.height).dump() +
                         " m is more than the garment's size; heights are in metres");
}

}  // namespace

std::string garment_file(const io::Scene& scene, const Context& context) {
  const bool in_memory = context.memory && context.memory->holds(scene.garment);
  return scene.subdivide || in_memory ? "" : scene.garment.string();
}

LineRound draw_lines(const LineTarget& target, const std::vector<io::DrawnStroke>& strokes,
                     const io::SceneLines& lines, const geometry::StageObserver& observer) {
  const std::optional<io::WrinkleRecord> earlier = io::find_wrinkle_record(target.file);
  geometry::WrinkleOptions options = continued(lines.options, target.file.mesh, earlier, target.density);
  for (const std::vector<int>& list : target.pins)
    for (int v : list) options.held.emplace_back(static_cast<geometry::Vertex::size_type>(v));
  io::ResolvedStrokes resolved = io::resolve_strokes(strokes, target.file, options.insertion.max_distance);
  const double size = size_of(target.file.mesh);
  LineRound round;
  round.first_line = options.first_line;
  round.warnings = std::move(resolved.warnings);
  if (target.moving) {
    round.moving = bridge::draw_more(target.file.mesh, *target.moving, resolved.strokes,
                                     {options, target.springs, lines.fade}, observer);
    round.report = round.moving->wrinkle;
  } else {
    round.report = naming(target.garment, [&] {
      return geometry::wrinkle(target.file.mesh, resolved.strokes, options, observer);
    });
  }
  warn_of_heights(resolved.strokes, size, round.warnings);
  for (const auto* more : {&round.report.insertion.warnings, &round.report.warnings})
    round.warnings.insert(round.warnings.end(), more->begin(), more->end());
  io::WrinkleRecord record = record_of(options, earlier, round.report);
  if (!target.moving && !is_utf8(target.garment))
    round.warnings.push_back(
        target.garment +
        ": its name is not UTF-8, so that the wrinkled mesh cannot name it, and its lines "
        "cannot be drawn again from that mesh alone; rename the garment");
  note_strokes(record, target.moving ? "" : target.garment, strokes, options.insertion.rule);
  io::set_wrinkle_record(target.file, record);
  return round;
}

void leave_out(std::vector<io::DrawnStroke>& strokes, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    strokes.erase(strokes.begin() + static_cast<std::ptrdiff_t>(io::find_stroke(strokes, name)));
  if (strokes.empty()) throw std::invalid_argument("--without leaves no stroke to draw");
}

std::vector<io::DrawnStroke> read_strokes(const io::SceneLines& lines, const Context& context) {
  std::vector<io::DrawnStroke> strokes;
  if (context.memory && context.memory->strokes.count(lines.strokes.string()))
    strokes = context.memory->strokes.at(lines.strokes.string());
  else
    strokes = io::read_drawn_strokes(lines.strokes, lines.height, read_options(context.frame));
  if (!lines.without.empty()) leave_out(strokes, lines.without);
  return strokes;
}

std::vector<std::vector<io::DrawnStroke>> read_rounds(const io::Scene& scene, int first,
                                                      const Context& context) {
  std::vector<std::vector<io::DrawnStroke>> rounds(static_cast<std::size_t>(first));
  for (std::size_t i = rounds.size(); i < scene.lines.size(); ++i) {
    const io::SceneLines& lines = scene.lines[i];
    rounds.push_back(read_strokes(lines, context));
    if (lines.time >= scene.simulation.seconds && lines.time > 0)
      context.warn("lines_after_end",
                   lines.strokes.string() + ": its lines come at " + Json(lines.time).dump() +
                       " s, when the simulation is over; they are not drawn",
                   lines.strokes.string(), "simulation.seconds");
  }
  return rounds;
}

geometry::StageObserver stage_writer(const io::SceneOutput& output, const io::MeshFile& file,
                                     const Context& context) {
  return [&](geometry::Stage stage, const geometry::Mesh& mesh) {
    const bool is_inserted = stage == geometry::Stage::displaced;
    if (!is_inserted && stage != geometry::Stage::smoothed) return;
    const std::filesystem::path& path = is_inserted ? output.inserted : output.smoothed;
    if (path.empty()) return;
    io::MeshFile written = file;
    written.mesh = mesh;
    io::drop_motion(written);
    write_mesh(path, written, context);
  };
}

}  // namespace furrow::jobs
