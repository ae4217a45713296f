// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/wrinkle.h"

#include <memory>

#include "cli/common.h"
#include "cli/max_weights.h"
#include "cli/smoothing_options.h"
#include "cli/subcommands.h"
#include "cli/wrinkle_reports.h"
#include "geometry/property_names.h"
#include "io/stroke_file.h"
#include "io/wrinkle_record.h"

namespace furrow::cli {
namespace {

struct WrinkleArguments : CommonArguments {
  std::string in, strokes, inserted;
  double height = geometry::Stroke{}.height;
  std::string rule = "safe", rest = "drawn", region = "two-ring";
  std::optional<double> density;
  std::optional<int> max_weights;
  geometry::WrinkleOptions options;
  SmoothingArguments smoothing;
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
                            const std::optional<io::WrinkleRecord>& earlier,
                            const geometry::WrinkleReport& report) {
  io::WrinkleRecord record = earlier.value_or(io::WrinkleRecord{});
  record.mean_structural_length = report.mean_structural_length;
  record.mean_bending_length = report.mean_bending_length;
  record.density = o.density;
  record.options = flags(a, o);
  record.lines.resize(o.first_line, {"", geometry::kUnset, geometry::kUnset, geometry::kUnset});
  for (const geometry::WrinkledLine& line : report.lines)
    record.lines.push_back({line.name, line.height, line.drawn_height, line.smoothed_height});
  return record;
}

void wrinkle(const WrinkleArguments& a) {
  check_output(a.out);
  if (!a.inserted.empty()) {
    check_output(a.inserted);
    refuse_same(a.inserted, a.out);
  }
  io::MeshFile file = read_garment(a.in, a);
  const std::vector<geometry::Stroke> strokes = io::read_strokes(a.strokes, a.height, read_options(a));
  const std::optional<io::WrinkleRecord> earlier = io::find_wrinkle_record(file);
  const geometry::WrinkleOptions options = continued(to_options(a), a, file, earlier);
  std::optional<geometry::Mesh> displaced;
  const auto keep_stage = [&](geometry::Stage stage, const geometry::Mesh& mesh) {
    if (!a.inserted.empty() && stage == geometry::Stage::displaced) displaced = mesh;
  };
  const geometry::WrinkleReport report = geometry::wrinkle(file.mesh, strokes, options, keep_stage);
  for (const std::string& w : report.insertion.warnings) warn(w, a);
  if (a.max_weights) geometry::normalize_skin_weights(file.mesh, *a.max_weights);
  set_wrinkle_record(file, record_of(a, options, earlier, report));
  write_mesh(file, a);
  const Json json = to_json(report, file.mesh, options.first_line);
  if (displaced) {
    file.mesh = std::move(*displaced);
    write_mesh(a.inserted, file, a);
  }
  print_report(json, a);
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
  sub.add_option("--inserted", a.inserted, "also write the mesh after insertion and before smoothing");
}

}  // namespace

void add_wrinkle(CLI::App& app) {
  auto a = std::make_shared<WrinkleArguments>();
  CLI::App* sub = app.add_subcommand("wrinkle",
                                     "Turn drawn ridge and valley lines into wrinkles\n\n"
                                     "  furrow wrinkle shirt.obj lines.json -o wrinkled.ply\n"
                                     "  furrow wrinkle skirt.obj lines.obj --height -0.02 -o wrinkled.ply");
  sub->add_option("mesh", a->in, "garment to read")->required();
  sub->add_option("strokes", a->strokes, "lines: JSON, or the l elements of an OBJ file")->required();
  sub->add_option("-o,--output", a->out, "mesh to write; PLY keeps rest lengths, masses and lines")
      ->required();
  add_options(*sub, *a);
  add_smoothing_options(*sub, a->smoothing);
  add_common_options(*sub, *a);
  sub->callback([a] { wrinkle(*a); });
}

}  // namespace furrow::cli
