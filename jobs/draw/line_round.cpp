// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/line_round.h"

#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "geometry/mesh/measures.h"
#include "geometry/mesh/property_names.h"
#include "io/base/bytes_file.h"
#include "io/base/field_words.h"
#include "io/scene/state_file.h"
#include "io/stroke/resolve_strokes.h"
#include "io/stroke/stroke_file.h"
#include "jobs/base/gate.h"
#include "jobs/base/inputs.h"
#include "jobs/base/read_inputs.h"
#include "jobs/draw/wrinkle_reports.h"
#include "physics/base/cancel_scope.h"

namespace furrow::jobs {
namespace {

std::string number(double x) { return Json(x).dump(); }

const char* word_of(geometry::RestRule rule) {
  return rule == geometry::RestRule::flat ? "flat" : rule == geometry::RestRule::copied ? "copied" : "drawn";
}

/// The options of `wrinkle` that say the same, for the record in the file.
std::string flags(const geometry::WrinkleOptions& o) {
  using namespace geometry;
  const bool folds = o.insertion.rule == InsertionRule::fold;
  std::string text;
  const auto add = [&](const char* field, const std::string& value = "") {
    text += (text.empty() ? "" : " ") + io::flag_of(field, value);
  };
  add("rule", folds ? "fold" : o.insertion.rule == InsertionRule::paper ? "paper" : "safe");
  add("rest", word_of(o.rest));
  if (folds)
    add("detail", o.detail == Detail::coarse ? "coarse" : o.detail == Detail::fine ? "fine" : "normal");
  else
    add("region", o.region == SmoothingRegion::whole_mesh ? "whole-mesh" : "two-ring");
  if (folds && o.flat_base) add("flat_base");
  add("max_distance", number(o.insertion.max_distance));
  add("density", number(o.density));
  if (folds)
    add("fold_iterations", std::to_string(o.fold_iterations));
  else
    add("iterations", std::to_string(o.smoothing.iterations));
  add("lambda", number(o.smoothing.lambda));
  add("mu", number(o.smoothing.mu));
  if (folds) return text;
  add("weights", o.smoothing.weights == SmoothingWeights::cotangent ? "cotangent" : "uniform");
  if (o.smoothing.lines == LineRule::keep) add("keep_lines");
  if (o.smoothing.border == BorderRule::keep) add("keep_border");
  return text;
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
                            line.width, line.sharpness, line.press, line.crest_height, line.gather});
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

/// The share of a stroke's length that lies within `reach` of another's which runs along it there [-].
double share_near(const geometry::Stroke& stroke, const geometry::Stroke& other, double reach) {
  using Segment = CGAL::Segment_3<geometry::Point::R>;
  const auto segments = [](const geometry::Stroke& s) {
    std::vector<Segment> list;
    for (std::size_t i = 1; i < s.points.size(); ++i)
      if (std::find(s.breaks.begin(), s.breaks.end(), i) == s.breaks.end())
        list.emplace_back(s.points[i - 1], s.points[i]);
    if (s.closed && s.points.size() > 2) list.emplace_back(s.points.back(), s.points.front());
    return list;
  };
  constexpr double along = 0.7;  // cosine of the angle between two that run side by side
  const std::vector<Segment> of_other = segments(other);
  double near = 0, length = 0;
  for (const Segment& s : segments(stroke)) {
    physics::throw_if_cancelled("draw_lines");
    const double part = std::sqrt(s.squared_length());
    const int n = int(std::clamp(4 * part / reach, 1.0, 200.0));
    const auto is_beside = [&](const geometry::Point& p, const Segment& t) {
      const double lengths = part * std::sqrt(t.squared_length());
      return std::abs(s.to_vector() * t.to_vector()) > along * lengths &&
             CGAL::squared_distance(p, t) < reach * reach;
    };
    for (int k = 0; k < n; ++k) {
      const geometry::Point p = s.source() + (k + 0.5) / n * s.to_vector();
      length += part / n;
      if (std::any_of(of_other.begin(), of_other.end(), [&](const Segment& t) { return is_beside(p, t); }))
        near += part / n;
    }
  }
  return length > 0 ? near / length : 0;
}

/// A ridge and a valley side by side within their widths, of which one has lost a fifth of its height by
/// that.
void warn_of_cancelling(const std::vector<geometry::Stroke>& strokes, const geometry::WrinkleReport& report,
                        std::vector<std::string>& warnings) {
  constexpr double side_by_side = 0.25, kept = 0.8;
  const auto asked = [&](std::size_t i) { return report.lines[i].height; };
  const auto drawn = [&](std::size_t i) {  // as the report has it
    return report.lines[i].crest_height.value_or(report.lines[i].drawn_height);
  };
  const auto lost = [&](std::size_t i) {
    return !(std::copysign(1, asked(i)) * drawn(i) >= kept * std::abs(asked(i)));
  };
  const auto told = [&](std::size_t i) {
    return "'" + strokes[i].name + "' (" + geometry::length_text(asked(i)) + " asked, " +
           (std::isfinite(drawn(i)) ? geometry::length_text(drawn(i)) : "none") + " drawn)";
  };
  for (std::size_t i = 0; i < std::min(strokes.size(), report.lines.size()); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (!(strokes[i].height * strokes[j].height < 0) || (!lost(i) && !lost(j))) continue;
      const double widths = (strokes[i].width.value_or(0) + strokes[j].width.value_or(0)) / 2;
      const double reach = std::max(widths, report.mean_structural_length);
      const double share =
          std::max(share_near(strokes[i], strokes[j], reach), share_near(strokes[j], strokes[i], reach));
      if (share < side_by_side) continue;
      warnings.push_back("strokes " + told(j) + " and " + told(i) +
                         " run side by side, one up and one down, nearer than their widths: they cancel each "
                         "other; draw them farther apart, or narrower");
    }
}

/// Folds wider than half of the garment: a height that was meant in other units, as a fold is five times as
/// wide as high unless its stroke says.
void warn_of_width(const geometry::Mesh& garment, const geometry::WrinkleReport& report,
                   std::vector<std::string>& warnings) {
  const auto box = CGAL::bbox_3(garment.points().begin(), garment.points().end());
  const double size = std::hypot(box.x_span(), box.y_span(), box.z_span());
  for (const geometry::WrinkledLine& line : report.lines)
    if (line.width && *line.width > size / 2)
      warnings.push_back("'" + line.name + "': its fold, " + geometry::length_text(line.height) +
                         " high, is " + geometry::length_text(*line.width) + " wide, on a garment of " +
                         geometry::length_text(size) +
                         " from corner to corner; heights are in metres (0.015 for 15 mm), and width = sets "
                         "how wide it is");
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
    for (int v : list) options.held.push_back(geometry::Vertex(static_cast<geometry::Vertex::size_type>(v)));
  io::ResolvedStrokes resolved = io::resolve_strokes(strokes, target.file, options.insertion.max_distance);
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
  warn_of_cancelling(resolved.strokes, round.report, round.warnings);
  warn_of_width(target.file.mesh, round.report, round.warnings);
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
  if (strokes.empty()) throw std::invalid_argument("`without` leaves no stroke to draw");
}

std::vector<io::DrawnStroke> read_strokes(const io::SceneLines& lines, const Context& context) {
  std::vector<io::DrawnStroke> strokes;
  if (context.memory && context.memory->strokes.count(lines.strokes))
    strokes = context.memory->strokes.at(lines.strokes);
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
