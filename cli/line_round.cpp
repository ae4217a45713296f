// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/line_round.h"

#include <algorithm>

#include "cli/common.h"
#include "cli/wrinkle_reports.h"
#include "geometry/property_names.h"
#include "io/nearest_word.h"

namespace furrow::cli {
namespace {

/// The flags of `wrinkle` that say the same, for the record in the file.
std::string flags(const geometry::WrinkleOptions& o) {
  using namespace geometry;
  const auto number = [](double x) { return Json(x).dump(); };
  return std::string("--rule ") + (o.insertion.rule == InsertionRule::paper ? "paper" : "safe") + " --rest " +
         (o.rest == RestRule::flat ? "flat" : "drawn") + " --region " +
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
  record.lines.resize(o.first_line, {"", geometry::kUnset, geometry::kUnset, geometry::kUnset});
  for (const geometry::WrinkledLine& line : report.lines)
    record.lines.push_back({line.name, line.height, line.drawn_height, line.smoothed_height});
  return record;
}

}  // namespace

LineRound draw_lines(io::MeshFile& file, const std::vector<geometry::Stroke>& strokes,
                     const io::SceneLines& lines, std::optional<double> density,
                     const geometry::StageObserver& observer, physics::SimulateState* state,
                     const bridge::GatherOptions& springs) {
  const std::optional<io::WrinkleRecord> earlier = io::find_wrinkle_record(file);
  const geometry::WrinkleOptions options = continued(lines.options, file.mesh, earlier, density);
  LineRound round;
  round.first_line = options.first_line;
  if (state) {
    round.moving = bridge::draw_more(file.mesh, *state, strokes, {options, springs, lines.fade}, observer);
    round.report = round.moving->wrinkle;
  } else {
    round.report = geometry::wrinkle(file.mesh, strokes, options, observer);
  }
  io::set_wrinkle_record(file, record_of(options, earlier, round.report));
  return round;
}

void leave_out(std::vector<geometry::Stroke>& strokes, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    std::vector<std::string> known;
    for (const geometry::Stroke& s : strokes) known.push_back(s.name);
    if (!std::erase_if(strokes, [&](const geometry::Stroke& s) { return s.name == name; }))
      throw UsageError("no stroke is named '" + name + "'" +
                       (known.empty() ? "" : "; did you mean '" + io::nearest_word(name, known) + "'?"));
  }
}

}  // namespace furrow::cli
