// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/fold_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "geometry/band/band_sizing.h"
#include "geometry/fold/fold_base.h"
#include "geometry/fold/raise_folds.h"
#include "geometry/fold/smooth_folds.h"
#include "geometry/fold/wrinkle_steps.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/fold_rest.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/stroke/prepare_strokes.h"

namespace furrow::geometry {
namespace {

constexpr double full_share = 0.98;  ///< of the highest T: there a crest is measured
constexpr double thinnest = 3;       ///< angle of a face that physics bears [degrees]
constexpr double most_faces = 2e6;   ///< that folds are made of: some minutes, 2 GB

void lay(Mesh& mesh, const Raised& raised) {
  for (Vertex v : mesh.vertices()) mesh.point(v) = raised.displaced(v);
}

std::size_t smooth(Mesh& mesh, const Raised& raised, const WrinkleOptions& options,
                   const std::set<Vertex>& held) {
  std::vector<Vertex> region;
  for (Vertex v : mesh.vertices())
    if (raised.height[v.idx()] != 0 && !held.count(v) && !mesh.is_isolated(v)) region.push_back(v);
  TaubinOptions smoothing = options.smoothing;
  smoothing.iterations = options.fold_iterations;
  return smooth_folds(mesh, region, smoothing);
}

std::vector<double> all_angles(const Mesh& mesh) {
  std::vector<double> angles(mesh.num_edges(), 0);
  for (Edge e : mesh.edges()) angles[e.idx()] = dihedral_angle(mesh, e);
  return angles;
}

/// Of every edge: the mean of its ends' and opposite corners', where lines raise them.
std::vector<double> set_of_edges(const Mesh& mesh, const std::vector<double>& set) {
  std::vector<double> result(mesh.num_edges(), Stroke{}.set);
  for (Edge e : mesh.edges()) {
    double sum = 0;
    int count = 0;
    const Halfedge h = mesh.halfedge(e), o = mesh.opposite(h);
    for (Vertex v : {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h)), mesh.target(mesh.next(o))})
      if (!std::isnan(set[v.idx()])) sum += set[v.idx()], ++count;
    if (count > 0) result[e.idx()] = sum / count;
  }
  return result;
}

/// Mean height over the base of the chains' vertices where the fold is full, scaled to the stroke's height.
std::optional<double> crest_height(const Mesh& mesh, const Raised& raised, const Folds& folds,
                                   const std::vector<BandChain>& chains, int line, double asked) {
  double top = 0, sum = 0;
  std::size_t count = 0;
  const auto each = [&](const auto& call) {
    for (std::size_t i = 0; i < chains.size(); ++i)
      for (std::size_t j = 0; chains[i].line == line && j < chains[i].vertices.size(); ++j)
        call(folds.heights[i], chains[i].along[j], chains[i].vertices[j]);
  };
  const auto wanted = [](const FoldHeight& fold, double along) {
    return fold.height_at(along) * fold.taper_at(along);
  };
  each([&](const FoldHeight& fold, double along, Vertex) { top = std::max(top, fold.taper_at(along)); });
  each([&](const FoldHeight& fold, double along, Vertex v) {
    if (fold.taper_at(along) < full_share * top || wanted(fold, along) == 0) return;
    sum += (mesh.point(v) - raised.base[v.idx()]) * raised.normals[v.idx()] / wanted(fold, along);
    ++count;
  });
  if (count == 0) return std::nullopt;
  return asked * sum / static_cast<double>(count);
}

/// The chain of every curve; of a closed one with its first vertex again at the end.
std::vector<std::vector<Index<Vertex>>> chains_of(const std::vector<BandChain>& chains, int line) {
  std::vector<std::vector<Index<Vertex>>> result;
  for (const BandChain& chain : chains) {
    if (chain.line != line) continue;
    result.emplace_back(chain.vertices.begin(), chain.vertices.end());
    if (chain.closed && !chain.vertices.empty()) result.back().push_back(chain.vertices.front());
  }
  return result;
}

void note_band(const BandReport& band, WrinkleReport& report) {
  report.insertion.inserted = band.inserted;
  report.insertion.flipped = band.flipped;
  report.insertion.snapped = band.snapped.size();
  report.insertion.split_edges = band.split_edges;
  report.insertion.changed_faces.assign(band.changed_faces.begin(), band.changed_faces.end());
  report.insertion.min_angle_deg = band.min_angle_deg;
  for (const BandChain& chain : band.chains)
    report.insertion.max_deviation = std::max(report.insertion.max_deviation, chain.lateral);
  report.fold->lateral = report.insertion.max_deviation;
  report.fold->snapped = band.snapped.size();
  report.fold->min_angle_before_deg = band.min_angle_before_deg;
}

std::vector<WrinkledLine> lines_of(std::span<const Stroke> strokes, const Folds& folds,
                                   const std::vector<BandChain>& chains, int first) {
  std::vector<WrinkledLine> lines;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const int id = first + static_cast<int>(i);
    double width = 0, sharpness = 0;
    for (std::size_t j = 0; j < folds.curves.size(); ++j)
      if (folds.curves[j].line == id)
        width = std::max(width, folds.heights[j].greatest_width()), sharpness = folds.curves[j].sharpness;
    lines.push_back({strokes[i].name, strokes[i].height, 0, 0, 0, chains_of(chains, id), width, sharpness,
                     strokes[i].press});
  }
  return lines;
}

void note_paths(const Folds& folds, int first, std::vector<WrinkledLine>& lines) {
  for (const FoldCurve& curve : folds.curves)
    for (std::size_t i = 0, n = curve.points.size(); i + (curve.closed ? 0 : 1) < n; ++i) {
      const Eigen::Vector3d &a = curve.points[i], &b = curve.points[(i + 1) % n];
      lines[static_cast<std::size_t>(curve.line - first)].path.push_back(
          {Point(a.x(), a.y(), a.z()), Point(b.x(), b.y(), b.z())});
    }
}

LineShapes shapes_of(const std::vector<WrinkledLine>& lines, int first) {
  LineShapes shapes{std::vector<double>(static_cast<std::size_t>(first), 1),
                    std::vector<double>(static_cast<std::size_t>(first), unset_value)};
  for (const WrinkledLine& line : lines) {
    shapes.presses.push_back(line.press);
    shapes.widths.push_back(line.width.value_or(unset_value));
  }
  return shapes;
}

double smallest_rest_angle(const Mesh& mesh, const std::vector<Face>& faces) {
  const auto rest = find_map(mesh, attribute::rest_length).value();
  double least = faces.empty() ? 0 : std::numbers::pi;
  for (Face f : faces) least = std::min(least, smallest_angle(rest_lengths_of(mesh, rest, f)));
  return least * 180 / std::numbers::pi;
}

Folds folds_of(const Mesh& mesh, std::span<const Stroke> strokes, const WrinkleOptions& options,
               WrinkleReport& report) {
  const double mean_edge = options.insertion.mean_edge.value_or(report.mean_structural_length);
  PreparedStrokes prepared =
      prepare_strokes(mesh, strokes, {options.insertion.max_distance, mean_edge, options.first_line});
  report.warnings = std::move(prepared.warnings);
  return Folds(std::move(prepared.curves));
}

/// Faces that a fold needs, about: of its flanks, its crest, and those that grow beyond it (BandSizing).
double faces_of(const FoldCurve& curve, const BandOptions& o) {
  const auto faces = [](double area, double edge) { return area / (std::numbers::sqrt3 / 4 * edge * edge); };
  double sum = 0;
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const double w = curve.width[i], length = (curve.points[i] - curve.points[i - 1]).norm();
    const double flank = crest_edge(w, 0, o.detail, o.least_edge),
                 crest = crest_edge(w, curve.height[i], o.detail, o.least_edge);
    sum += length * (faces(0.9 * w, flank) + faces(0.2 * w, crest) + 13 / flank);
  }
  return sum;
}

/// So that a garment in another unit, or a scribble, does not take hours and all memory.
void require_bearable(const Folds& folds, const BandOptions& refining) {
  double all = 0, most = 0;
  const FoldCurve* largest = nullptr;
  for (const FoldCurve& curve : folds.curves) {
    const double faces = faces_of(curve, refining);
    all += faces;
    if (faces > most) most = faces, largest = &curve;
  }
  if (all > most_faces)
    throw ContentError(
        "stroke \"" + largest->name + "\": its fold, " + length_text(largest->length) + " long and " +
        length_text(largest->width.front()) + " wide, would take some " +
        std::to_string(std::lround(most / 1e5) / 10.0).substr(0, 5) + " million faces, all lines " +
        std::to_string(std::lround(all / 1e5) / 10.0).substr(0, 5) +
        ", and 2 are borne; is the garment in metres (`unit`)? Draw fewer lines, shorter or wider "
        "ones, or use the rule safe");
}

void complete_springs(Mesh& mesh, std::span<const Face> changed) {
  rebuild_bending_springs(mesh, changed);
  ensure_rest_angles(mesh);
}

void note_rest(const FoldRestReport& rest, WrinkleReport& report) {
  report.fold->reshaped_faces = rest.reshaped_faces;
  report.fold->invalid_faces = rest.invalid_faces;
}

void note_shape(const Mesh& mesh, const Raised& raised, const Folds& folds, const BandReport& band,
                int first_line, WrinkleReport& report) {
  for (std::size_t i = 0; i < report.lines.size(); ++i) {
    WrinkledLine& line = report.lines[i];
    line.crest_height =
        crest_height(mesh, raised, folds, band.chains, first_line + static_cast<int>(i), line.height);
  }
  report.fold->angle_defect_after = angle_defect(mesh);
  report.fold->min_angle_deg = smallest_rest_angle(mesh, band.changed_faces);
  if (report.fold->min_angle_deg < std::min(thinnest, 0.5 * band.min_angle_before_deg))
    report.warnings.push_back(
        "the folds leave faces too thin for cloth, as where they graze a hem; draw the lines elsewhere or "
        "narrower, or use the rule safe");
}

}  // namespace

WrinkleReport fold_lines(Mesh& mesh, std::span<const Stroke> strokes, const WrinkleOptions& options,
                         const StageObserver& observer) {
  const std::set<Vertex> held(options.held.begin(), options.held.end());
  Mesh work = mesh;
  WrinkleReport report = begin_wrinkling(work, options);
  report.fold = FoldReport{};
  report.fold->angle_defect_before = angle_defect(work);
  const Folds folds = folds_of(work, strokes, options, report);
  const BandOptions refining{
      options.detail, 0.003, options.insertion.may_flip, {options.held.begin(), options.held.end()}};
  require_bearable(folds, refining);
  BandReport band = refine_band(work, folds.curves, refining);
  if (observer) {
    complete_springs(work, band.changed_faces);
    observer(Stage::inserted, work);
  }
  const Raised raised = raise_folds(mesh, work, band, folds, {refining, options.flat_base});
  note_band(band, report);
  report.lines = lines_of(strokes, folds, band.chains, options.first_line);
  note_paths(folds, options.first_line, report.lines);
  report.undisplaced.assign(raised.base.begin(), raised.base.end());
  complete_springs(work, band.changed_faces);

  const LineShapes shapes = shapes_of(report.lines, options.first_line);
  const RestSnapshot before = take_rest_snapshot(work);
  const Mesh on_base = with_points(work, raised.base);
  const std::vector<double> angles = all_angles(on_base);
  const auto base = heights_from(on_base, options.first_line, strokes.size(), shapes.widths);
  lay(work, raised);
  const auto drawn = heights_from(work, options.first_line, strokes.size(), shapes.widths);
  if (observer) observer(Stage::displaced, work);

  report.fold->unsmoothed_vertices = smooth(work, raised, options, held);
  press_stored_hinges(work, shapes);
  note_rest(apply_fold_rest(work, before, angles, set_of_edges(work, raised.set), options.rest), report);
  note_heights(report.lines, base, drawn,
               heights_from(work, options.first_line, strokes.size(), shapes.widths));
  note_shape(work, raised, folds, band, options.first_line, report);
  end_wrinkling(work, options, report);
  if (observer) observer(Stage::smoothed, work);
  mesh = std::move(work);
  return report;
}

}  // namespace furrow::geometry
