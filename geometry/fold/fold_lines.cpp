// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/fold_lines.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <set>

#include "geometry/band/refine_displaced.h"
#include "geometry/fold/fold_base.h"
#include "geometry/fold/fold_heights.h"
#include "geometry/fold/line_region.h"
#include "geometry/fold/wrinkle_steps.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/tangent_frames.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/fold_rest.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/stroke/prepare_strokes.h"

namespace furrow::geometry {
namespace {

using Vec3 = Eigen::Vector3d;
constexpr double reach = 1.5;        ///< of the cloth that a fold moves, along edges, in half widths
constexpr double full_share = 0.98;  ///< of the highest T: there a crest is measured
constexpr double thinnest = 3;       ///< angle of a face that physics bears [degrees]
constexpr double least_angle = 15;   ///< a face may become as thin by smoothing [degrees]

Vec3 vec(const Point& p) { return {p.x(), p.y(), p.z()}; }

/// Which curves raise a vertex, by vertex index.
using CurvesOfVertex = std::vector<std::vector<int>>;

/// The folds as heights over the mesh.
struct Folds {
  std::vector<FoldCurve> curves;
  std::vector<FoldHeight> heights;

  explicit Folds(std::vector<FoldCurve> list) : curves(std::move(list)) {
    for (const FoldCurve& curve : curves) heights.emplace_back(curve);
  }
  /// Of the given curves at a point: of each line, and together [m].
  struct Joined {
    std::map<int, double> of_line;
    double height = 0;
  };
  Joined at(const Vec3& x, const std::vector<int>& of) const {
    Joined joined;
    for (int i : of) joined.of_line[curves[i].line] += heights[i].at(x);
    std::vector<double> list;
    for (const auto& [line, height] : joined.of_line) list.push_back(height);
    joined.height = joined_heights(list);
    return joined;
  }
};

/// Vertices that ways along edges join to a curve's chain.
CurvesOfVertex curves_of_vertices(const Mesh& mesh, const Folds& folds,
                                  const std::vector<BandChain>& chains) {
  CurvesOfVertex result(mesh.num_vertices());
  const std::vector<double> lengths = rest_lengths(mesh);
  for (std::size_t i = 0; i < chains.size(); ++i) {
    const double far = reach * folds.heights[i].greatest_width() / 2;
    for (Vertex v : vertices_within(mesh, chains[i].vertices, far, lengths))
      result[v.idx()].push_back(static_cast<int>(i));
  }
  return result;
}

/// The cloth on its way: flat is the mesh's own positions.
struct Raised {
  std::vector<Point> base;      ///< on the curved surface
  std::vector<Vector> normals;  ///< of that
  std::vector<double> height;   ///< u [m]
  std::vector<double> set;      ///< of the lines that raise a vertex, by their shares; NaN: none does [-]
};

std::vector<Point> base_of(const Mesh& given, const Mesh& mesh, const BandReport& band, bool flat,
                           const std::set<Vertex>& held) {
  std::vector<Point> base(mesh.points().begin(), mesh.points().end());
  if (flat) return base;
  const std::vector<Vector> normals = vertex_normals(given);
  for (Vertex v : mesh.vertices()) {
    const FacePoint& place = band.places[v.idx()];
    if (held.count(v) || !place.face.is_valid() || given.number_of_faces() == 0) continue;
    const auto& b = place.barycentrics;
    if (std::max({b[0], b[1], b[2]}) == 1) continue;  // a vertex of the mesh given
    base[v.idx()] = curved_place(given, normals, place);
  }
  return base;
}

void raise_vertex(const Folds& folds, const CurvesOfVertex& curves, Raised& raised, std::size_t v) {
  const Folds::Joined joined = folds.at(vec(raised.base[v]), curves[v]);
  raised.height[v] = joined.height;
  double sum = 0, weights = 0;
  for (int i : curves[v]) {
    const double weight = std::abs(joined.of_line.at(folds.curves[i].line));
    sum += weight * folds.curves[i].set;
    weights += weight;
  }
  if (weights > 0) raised.set[v] = sum / weights;
}

void raise(const Folds& folds, const CurvesOfVertex& curves, const std::set<Vertex>& held, Raised& raised) {
  const std::size_t n = raised.base.size();
  raised.height.assign(n, 0);
  raised.set.assign(n, unset_value);
  for (std::size_t v = 0; v < n; ++v)
    if (!curves[v].empty() && !held.count(Vertex(static_cast<Vertex::size_type>(v))))
      raise_vertex(folds, curves, raised, v);
}

/// Steep flanks stretch the band: the second pass, whose new vertices get all that the others have.
void refine_flanks(Mesh& mesh, const Mesh& given, const Folds& folds, const WrinkleOptions& options,
                   BandReport& band, CurvesOfVertex& curves, Raised& raised) {
  std::vector<Point> displaced;
  for (std::size_t v = 0; v < raised.base.size(); ++v)
    displaced.push_back(raised.base[v] + raised.height[v] * raised.normals[v]);
  const std::vector<Vector> normals = vertex_normals(given);
  const auto displace = [&](const SplitEdge& split, const FacePoint& place) {
    const std::size_t a = split.from.idx(), b = split.to.idx(), v = split.vertex.idx();
    const std::size_t n = std::max(raised.base.size(), v + 1);
    raised.base.resize(n), raised.normals.resize(n, Vector(0, 0, 0));
    raised.height.resize(n, 0), raised.set.resize(n, unset_value), curves.resize(n);
    curves[v].clear();
    std::set_union(curves[a].begin(), curves[a].end(), curves[b].begin(), curves[b].end(),
                   std::back_inserter(curves[v]));
    raised.base[v] = options.flat_base ? position_of(given, place) : curved_place(given, normals, place);
    const Vector sum = raised.normals[a] + raised.normals[b];
    raised.normals[v] = sum / std::max(std::sqrt(sum.squared_length()), 1e-300);
    raise_vertex(folds, curves, raised, v);
    return raised.base[v] + raised.height[v] * raised.normals[v];
  };
  refine_displaced(mesh, given, folds.curves, displaced, displace, band,
                   {options.detail, 0.003, options.insertion.may_flip, options.held});
}

Mesh with_points(const Mesh& mesh, const std::vector<Point>& points) {
  Mesh copy = mesh;
  for (Vertex v : copy.vertices()) copy.point(v) = points[v.idx()];
  return copy;
}

/// Base, normals and heights of the refined mesh, which the second pass refines again.
Raised raised_on(const Mesh& given, Mesh& mesh, BandReport& band, const Folds& folds,
                 const WrinkleOptions& options, const std::set<Vertex>& held) {
  Raised raised;
  raised.base = base_of(given, mesh, band, options.flat_base, held);
  raised.normals = averaged_normals(with_points(mesh, raised.base));
  CurvesOfVertex curves = curves_of_vertices(mesh, folds, band.chains);
  raise(folds, curves, held, raised);
  refine_flanks(mesh, given, folds, options, band, curves, raised);
  return raised;
}

void lay(Mesh& mesh, const Raised& raised) {
  for (Vertex v : mesh.vertices())
    mesh.point(v) = raised.base[v.idx()] + raised.height[v.idx()] * raised.normals[v.idx()];
}

/// Smallest angle of a face in space [degrees].
double face_angle(const Mesh& mesh, Face f) {
  const auto h = halfedges_of(mesh, f);
  return smallest_angle({spatial_length(mesh, mesh.edge(h[0])), spatial_length(mesh, mesh.edge(h[1])),
                         spatial_length(mesh, mesh.edge(h[2]))}) *
         180 / std::numbers::pi;
}

/// Takes smoothing back at the corners of faces that it made thinner than they were and than least_angle,
/// until there are none; returns at how many vertices.
std::size_t take_back(Mesh& mesh, const std::vector<Point>& before, std::span<const Vertex> region) {
  std::set<Face> faces;
  for (Vertex v : region)
    for (Face f : mesh.faces_around_target(mesh.halfedge(v)))
      if (f.is_valid()) faces.insert(f);
  Mesh unsmoothed = mesh;
  for (Vertex v : region) unsmoothed.point(v) = before[v.idx()];
  std::map<Face, double> wanted;
  for (Face f : faces) wanted[f] = std::min(least_angle, face_angle(unsmoothed, f)) - 1e-6;
  std::set<Vertex> taken;
  for (bool changed = true; changed;) {
    changed = false;
    for (Face f : faces) {
      if (face_angle(mesh, f) >= wanted[f]) continue;
      for (Vertex v : corners_of(mesh, f))
        if (mesh.point(v) != before[v.idx()]) {
          mesh.point(v) = before[v.idx()];
          taken.insert(v);
          changed = true;
        }
    }
  }
  return taken.size();
}

std::size_t smooth(Mesh& mesh, const Raised& raised, const WrinkleOptions& options,
                   const std::set<Vertex>& held) {
  std::vector<Vertex> region;
  for (Vertex v : mesh.vertices())
    if (raised.height[v.idx()] != 0 && !held.count(v) && !mesh.is_isolated(v)) region.push_back(v);
  if (region.empty() || options.fold_iterations == 0) return 0;
  TaubinOptions smoothing = options.smoothing;
  smoothing.iterations = options.fold_iterations;
  smoothing.weights = SmoothingWeights::cotangent;  // of the rest lengths, which know nothing of folds yet
  smoothing.lines = LineRule::keep;
  smoothing.border = BorderRule::keep;
  const std::vector<Point> before(mesh.points().begin(), mesh.points().end());
  taubin_smooth(mesh, region, smoothing);
  return take_back(mesh, before, region);
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
std::vector<std::vector<Vertex>> chains_of(const std::vector<BandChain>& chains, int line) {
  std::vector<std::vector<Vertex>> result;
  for (const BandChain& chain : chains) {
    if (chain.line != line) continue;
    result.push_back(chain.vertices);
    if (chain.closed && !chain.vertices.empty()) result.back().push_back(chain.vertices.front());
  }
  return result;
}

void note_band(const BandReport& band, WrinkleReport& report) {
  report.insertion.inserted = band.inserted;
  report.insertion.flipped = band.flipped;
  report.insertion.snapped = band.snapped.size();
  report.insertion.split_edges = band.split_edges;
  report.insertion.changed_faces = band.changed_faces;
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
      const Vec3 &a = curve.points[i], &b = curve.points[(i + 1) % n];
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
        "the folds leave faces too thin for cloth, as where they lie on close layers or graze a hem; draw "
        "the "
        "lines elsewhere or narrower, or use the rule safe");
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
  BandReport band =
      refine_band(work, folds.curves, {options.detail, 0.003, options.insertion.may_flip, options.held});
  if (observer) {
    complete_springs(work, band.changed_faces);
    observer(Stage::inserted, work);
  }
  const Raised raised = raised_on(mesh, work, band, folds, options, held);
  note_band(band, report);
  report.lines = lines_of(strokes, folds, band.chains, options.first_line);
  note_paths(folds, options.first_line, report.lines);
  report.undisplaced = raised.base;
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
