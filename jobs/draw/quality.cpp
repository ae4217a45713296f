// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/quality.h"

#include <algorithm>
#include <cmath>

#include "geometry/fold/fold_base.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/stroke/prepare_strokes.h"
#include "io/base/field_words.h"
#include "io/stroke/resolve_strokes.h"
#include "io/stroke/stroke_file.h"
#include "jobs/base/card.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "jobs/draw/quality_targets.h"
#include "jobs/draw/recorded_drawing.h"
#include "physics/base/cancel_scope.h"

namespace furrow::jobs {
namespace {

namespace fs = std::filesystem;
using geometry::FoldCurve;
using geometry::FoldSurface;
using geometry::Mesh;
using geometry::Vertex;

constexpr double moved_share = 0.05;  ///< of the highest fold: cloth away from lines that far off has moved
constexpr double wide_share =
    0.005;  ///< of the widest fold: bases of wide low folds round coarse facets so much
constexpr double away_from_lines = 1;  ///< in widths
constexpr double beside_share =
    0.75;  ///< of the cloth: so much of it is nearer to its place than what is told
constexpr double tilt =
    0.3;  ///< of its height: so far beside its place a vertex may be raised on a coarse garment
constexpr std::size_t most_knobs = 10;
constexpr double knobs_apart = 0.02;  ///< [m]

void check(const QualityJob& job) {
  std::vector<std::string> inputs{name_of(job.mesh, ""), job.base ? name_of(*job.base, "") : ""};
  if (job.strokes)
    if (const auto* path = std::get_if<fs::path>(&*job.strokes)) inputs.push_back(path->string());
  refuse_same(job.more_outputs, inputs);
  check_card(job);
}

/// The cloth before its folds, and what is known of its lines.
struct Before {
  std::optional<io::MeshFile> file;
  std::string from = "none";
  bool is_found = false;  ///< it was not named: the cloth may have moved since
};

/// The mesh at its rest positions, which say where each vertex lay before lines, pose and motion.
std::optional<io::MeshFile> at_rest_positions(const io::MeshFile& file) {
  const auto rest = geometry::find_map(file.mesh, geometry::attribute::rest_position);
  if (!rest) return std::nullopt;
  io::MeshFile before = file;
  for (Vertex v : before.mesh->vertices()) {
    const auto& p = (*rest)[v];
    if (!std::isfinite(p[0] + p[1] + p[2])) return std::nullopt;
    before.mesh->point(v) = {p[0], p[1], p[2]};
  }
  return before;
}

/// The garment that the mesh notes; nothing where it is not there any more, or has changed.
std::optional<io::MeshFile> noted_garment(const QualityJob& job, const io::MeshFile& mesh,
                                          const Context& context) {
  const auto* path = std::get_if<fs::path>(&job.mesh);
  const auto record = io::find_wrinkle_record(mesh);
  if (!path || !record || record->garment.empty() || record->strokes.empty()) return std::nullopt;
  SilentListener silent(context.listener);
  const Context quiet{context.frame, silent, context.memory};
  try {
    return read_garment(recorded_drawing(*path, quiet).garment, quiet);
  } catch (const geometry::ContentError&) {
    return std::nullopt;
  }
}

Before find_before(const QualityJob& job, const io::MeshFile& mesh, const Context& context) {
  if (job.base) return {read_garment(*job.base, context, "the garment before its folds"), "file", false};
  if (auto garment = noted_garment(job, mesh, context)) return {std::move(garment), "garment", true};
  if (auto rest = at_rest_positions(mesh)) return {std::move(rest), "rest_positions", true};
  return {};
}

/// The value of a flag in the options that a mesh notes.
std::optional<double> noted(const std::string& options, const std::string& flag) {
  const std::size_t at = options.find(flag + " ");
  if (at == std::string::npos) return std::nullopt;
  return std::strtod(options.c_str() + at + flag.size() + 1, nullptr);
}

double mean_rest_edge(const Mesh& mesh) {
  const std::vector<double> lengths = geometry::rest_lengths(mesh);
  double sum = 0;
  for (double length : lengths) sum += length;
  return lengths.empty() ? 0 : sum / static_cast<double>(lengths.size());
}

struct Lines {
  std::vector<FoldCurve> curves;
  std::string from = "none";
};

std::vector<io::DrawnStroke> drawn_strokes(const QualityJob& job, const io::WrinkleRecord& record,
                                           const Context& context) {
  if (!job.strokes) return io::drawn_strokes_from(record.strokes, name_of(job.mesh, "the mesh"));
  if (const auto* list = std::get_if<std::vector<io::DrawnStroke>>(&*job.strokes)) return *list;
  return io::read_drawn_strokes(std::get<fs::path>(*job.strokes), job.height, read_options(context.frame));
}

/// Strokes as rule fold lays them onto the cloth before.
std::vector<FoldCurve> curves_of_strokes(const QualityJob& job, const io::WrinkleRecord& record,
                                         const Before& before, const Context& context) {
  std::vector<io::DrawnStroke> drawn = drawn_strokes(job, record, context);
  if (job.width)
    for (io::DrawnStroke& d : drawn)
      if (!d.stroke.width) d.stroke.width = job.width;
  const double reach = job.max_distance.value_or(
      noted(record.options, io::flag_of("max_distance")).value_or(geometry::TraceOptions{}.max_distance));
  const std::vector<geometry::Stroke> strokes =
      io::resolve_strokes(drawn, *before.file, reach).strokes;  // what it warns of, wrinkle tells
  const double edge = before.from == "rest_positions" && record.mean_structural_length > 0
                          ? record.mean_structural_length
                          : mean_rest_edge(before.file->mesh);
  return geometry::prepare_strokes(before.file->mesh, strokes, {reach, edge, 0}).curves;
}

Lines find_lines(const QualityJob& job, const io::WrinkleRecord& record, const Before& before,
                 const FoldSurface& surface, const Context& context) {
  if (job.strokes) return {curves_of_strokes(job, record, before, context), "file"};
  if (!record.strokes.empty()) return {curves_of_strokes(job, record, before, context), "record"};
  std::vector<double> heights;
  for (const auto& line : record.lines) heights.push_back(line.height);
  Lines lines{geometry::carried_curves(surface, io::line_widths(record), heights), "mesh"};
  for (FoldCurve& curve : lines.curves)
    if (static_cast<std::size_t>(curve.line) < record.lines.size())
      curve.name = record.lines[static_cast<std::size_t>(curve.line)].name;
  if (lines.curves.empty()) lines.from = "none";
  return lines;
}

/// Median distance from the surface before, away from all lines [m]; 0 where there is hardly such cloth.
double moved_by(const FoldSurface& surface, const std::vector<FoldCurve>& curves) {
  std::vector<double> off;
  for (Vertex v : surface.mesh->vertices()) {
    if (!surface.has_foot(v)) continue;
    const auto is_near = [&](const FoldCurve& curve) {
      const double far = away_from_lines * curve.width.front();
      const auto step = static_cast<std::size_t>(
          std::max(1.0, 0.25 * far / curve.length * static_cast<double>(curve.points.size())));
      for (std::size_t i = 0; i < curve.points.size(); i += step)
        if ((surface.feet[v.idx()] - curve.points[i]).norm() < far) return true;
      return false;
    };
    if (std::none_of(curves.begin(), curves.end(), is_near))
      off.push_back(std::abs(surface.heights[v.idx()]));
  }
  if (off.size() < 10) return 0;
  std::nth_element(off.begin(), off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2), off.end());
  return off[off.size() / 2];
}

/// How far the feet of the vertices are from where these lay before the lines, for most of the cloth [m]: a
/// fold that was only drawn stands nearly straight above that place, along lines, too. 0 where the mesh does
/// not know it.
double beside_place(const FoldSurface& surface) {
  const auto rest = geometry::find_map(*surface.mesh, geometry::attribute::rest_position);
  std::vector<double> off;
  for (Vertex v : surface.mesh->vertices()) {
    if (!rest || !surface.has_foot(v)) continue;
    const auto& p = (*rest)[v];
    const double distance = (surface.feet[v.idx()] - Eigen::Vector3d(p[0], p[1], p[2])).norm();
    const double raised = std::abs(surface.heights[v.idx()]);
    if (std::isfinite(distance)) off.push_back(std::max(0.0, distance - tilt * raised));
  }
  if (off.size() < 10) return 0;
  const auto at = off.begin() + static_cast<std::ptrdiff_t>(beside_share * static_cast<double>(off.size()));
  std::nth_element(off.begin(), at, off.end());
  return *at;
}

bool has_moved(const FoldSurface& surface, const std::vector<FoldCurve>& curves) {
  double highest = 0, widest = 0;
  for (const FoldCurve& curve : curves) {
    for (double k : curve.height) highest = std::max(highest, std::abs(k));
    for (double w : curve.width) widest = std::max(widest, w);
  }
  const double far = std::max(moved_share * highest, wide_share * widest);
  return moved_by(surface, curves) > far || beside_place(surface) > far;
}

/// "": the lines were measured.
std::string measure_lines(const QualityJob& job, const Before& before, QualityReport& report,
                          const Context& context) {
  const io::WrinkleRecord record = io::find_wrinkle_record(report.mesh).value_or(io::WrinkleRecord{});
  if (!before.file) return "the surface before the folds is not known: name it with `base`";
  const FoldSurface surface =
      before.from == "rest_positions"
          ? geometry::surface_over(report.mesh.mesh,
                                   std::vector<geometry::Point>(before.file->mesh->points().begin(),
                                                                before.file->mesh->points().end()))
          : geometry::surface_over(report.mesh.mesh, before.file->mesh,
                                   record.options.find(io::flag_of("flat_base")) != std::string::npos);
  stop_if_cancelled(context);
  const Lines lines = find_lines(job, record, before, surface, context);
  report.lines_from = lines.from;
  if (lines.curves.empty()) return "the mesh carries no lines: name their strokes with `strokes`";
  if (before.is_found && has_moved(surface, lines.curves))
    return "the cloth has moved since its lines were drawn: name it as it would lie without them with `base`";
  const ProgressScope progress(context.listener, "sections");
  for (const FoldCurve& curve : lines.curves) {
    stop_if_cancelled(context);
    report.lines.push_back(geometry::measure_line(surface, curve));
    progress(static_cast<double>(report.lines.size()) / static_cast<double>(lines.curves.size()));
  }
  return "";
}

void find_knobs(QualityReport& report) {
  const Mesh& mesh = report.mesh.mesh;
  report.defects = geometry::angle_defects(mesh);
  std::vector<double> areas(mesh.num_vertices(), 0);
  for (geometry::Face f : mesh.faces())
    for (Vertex v : geometry::corners_of(mesh, f))
      areas[v.idx()] += std::sqrt(geometry::area_normal_of(mesh, f).squared_length()) / 6;
  std::vector<Vertex> order;
  for (Vertex v : mesh.vertices()) {
    double& defect = report.defects[v.idx()];
    defect = areas[v.idx()] > 0 ? defect / areas[v.idx()] : 0;
    if (defect != 0) order.push_back(v);
  }
  const auto size = [&](Vertex v) { return std::abs(report.defects[v.idx()]); };
  std::sort(order.begin(), order.end(),
            [&](Vertex a, Vertex b) { return size(a) != size(b) ? size(a) > size(b) : a.idx() < b.idx(); });
  for (Vertex v : order) {
    if (report.knobs.size() == most_knobs) break;
    const auto is_near = [&](const Knob& k) {
      return CGAL::squared_distance(k.place, mesh.point(v)) < knobs_apart * knobs_apart;
    };
    if (std::none_of(report.knobs.begin(), report.knobs.end(), is_near))
      report.knobs.push_back({mesh.point(v), report.defects[v.idx()]});
  }
}

}  // namespace

QualityReport quality(const QualityJob& job, Listener& listener) {
  const physics::CancelScope cancelling([&listener] { return listener.cancelled(); });
  check(job);
  QualityReport report;
  Frame frame = job.frame;
  take_noted_frame(frame, {name_of(job.mesh, "")});
  const Context context{frame, listener};
  report.mesh = read_garment(job.mesh, context, "mesh");
  const Before before = find_before(job, report.mesh, context);
  report.base_from = before.from;
  report.lines_from = "none";
  report.whole = geometry::measure_quality(report.mesh.mesh);
  if (before.from != "none" && before.from != "rest_positions")
    report.before = geometry::measure_quality(before.file->mesh);
  stop_if_cancelled(context);
  const std::string why = measure_lines(job, before, report, context);
  find_knobs(report);
  const auto record = io::find_wrinkle_record(report.mesh);
  const bool is_fine = record && record->options.find(io::flag_of("detail", "fine")) != std::string::npos;
  report.measures = judged(report, why, is_fine);
  return report;
}

bool QualityReport::met() const {
  return std::all_of(measures.begin(), measures.end(), [](const QualityMeasure& m) { return m.met(); });
}

std::vector<CardRow> card(QualityJob& job) {
  return {
      {"strokes", &job.strokes,
       "lines of its folds: JSON, or the l elements of an OBJ file; none: those that the mesh, a wrinkled "
       "PLY, was made with, or the lines that it carries"},
      {"base", &job.base,
       "the garment before its folds, from which heights count; none: the one that the mesh names, or where "
       "its vertices lay"},
      {"height", &job.height, "of strokes that name none [m]"},
      {"width", &job.width, positive, "of strokes that name none [m]; none: as rule fold chooses it"},
      {"max_distance", &job.max_distance, positive,
       "of a stroke's point from the base [m]; none: as the lines were drawn with, or 0.05"},
  };
}

}  // namespace furrow::jobs
