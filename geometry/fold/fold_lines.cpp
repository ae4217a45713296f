// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/fold_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "geometry/band/band_sizing.h"
#include "geometry/fold/fold_base.h"
#include "geometry/fold/fold_clusters.h"
#include "geometry/fold/fold_memory.h"
#include "geometry/fold/gather_lines.h"
#include "geometry/fold/line_height.h"
#include "geometry/fold/raise_folds.h"
#include "geometry/fold/smooth_folds.h"
#include "geometry/fold/wrinkle_steps.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/patch.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
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

BandOptions refining_of(const WrinkleOptions& options) {
  return {options.detail, 0.003, options.insertion.may_flip, {options.held.begin(), options.held.end()}};
}

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
                                   const std::vector<BandChain>& chains, const std::vector<int>& ids,
                                   int first) {
  std::vector<WrinkledLine> lines;
  for (int id : ids) {
    const Stroke& stroke = strokes[static_cast<std::size_t>(id - first)];
    double width = 0, sharpness = 0;
    for (std::size_t j = 0; j < folds.curves.size(); ++j)
      if (folds.curves[j].line == id)
        width = std::max(width, folds.heights[j].greatest_width()), sharpness = folds.curves[j].sharpness;
    lines.push_back(
        {stroke.name, stroke.height, 0, 0, 0, chains_of(chains, id), width, sharpness, stroke.press});
  }
  return lines;
}

/// As `given` has them, before they were carried to where other folds lie.
void note_paths(std::span<const FoldCurve> given, FoldProgress& progress) {
  for (const FoldCurve& curve : given)
    for (std::size_t i = 0, n = curve.points.size(); i + (curve.closed ? 0 : 1) < n; ++i) {
      const Eigen::Vector3d &a = curve.points[i], &b = curve.points[(i + 1) % n];
      progress.lines.at(curve.line).path.push_back({Point(a.x(), a.y(), a.z()), Point(b.x(), b.y(), b.z())});
    }
}

LineShapes shapes_of(const std::vector<WrinkledLine>& lines, const std::vector<int>& ids) {
  const auto size = static_cast<std::size_t>(ids.back()) + 1;
  LineShapes shapes{std::vector<double>(size, 1), std::vector<double>(size, unset_value)};
  for (std::size_t i = 0; i < ids.size(); ++i) {
    shapes.presses[ids[i]] = lines[i].press;
    shapes.widths[ids[i]] = lines[i].width.value_or(unset_value);
  }
  return shapes;
}

/// Of each of the lines; NaN for one whose vertices all went to later lines.
std::vector<double> heights_of(const Mesh& mesh, const std::vector<int>& ids, const LineShapes& shapes) {
  std::vector<double> result(ids.size(), unset_value);
  for (const LineHeight& h : line_heights(mesh, shapes.widths, ids))
    result[std::lower_bound(ids.begin(), ids.end(), h.line) - ids.begin()] = h.height;
  return result;
}

double smallest_rest_angle(const Mesh& mesh, const std::vector<Face>& faces) {
  const auto rest = find_map(mesh, attribute::rest_length).value();
  double least = faces.empty() ? 0 : std::numbers::pi;
  for (Face f : faces) least = std::min(least, smallest_angle(rest_lengths_of(mesh, rest, f)));
  return least * 180 / std::numbers::pi;
}

std::vector<FoldCurve> curves_of(const Mesh& mesh, std::span<const Stroke> strokes,
                                 const WrinkleOptions& options, WrinkleReport& report) {
  const double mean_edge = options.insertion.mean_edge.value_or(report.mean_structural_length);
  PreparedStrokes prepared =
      prepare_strokes(mesh, strokes, {options.insertion.max_distance, mean_edge, options.first_line});
  report.warnings = std::move(prepared.warnings);
  return std::move(prepared.curves);
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
void require_bearable(std::span<const FoldCurve> curves, const BandOptions& refining) {
  double all = 0, most = 0;
  const FoldCurve* largest = nullptr;
  for (const FoldCurve& curve : curves) {
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

void note_shape(const Mesh& mesh, const Raised& raised, const Folds& folds, const BandReport& band,
                const std::vector<int>& ids, WrinkleReport& report) {
  for (std::size_t i = 0; i < report.lines.size(); ++i)
    report.lines[i].crest_height =
        crest_height(mesh, raised, folds, band.chains, ids[i], report.lines[i].height);
  report.fold->min_angle_deg = smallest_rest_angle(mesh, band.changed_faces);
  if (report.fold->min_angle_deg < std::min(thinnest, 0.5 * band.min_angle_before_deg))
    report.warnings.push_back(
        "the folds leave faces too thin for cloth, as where they graze a hem; draw the lines elsewhere or "
        "narrower, or use the rule safe");
}

/// What folding a cluster did to a mesh.
struct Folded {
  WrinkleReport report;                  ///< of these lines
  std::vector<Point> before, displaced;  ///< by vertex
};

/// Folding of one cluster.
class Folding {
 public:
  Folding(Mesh& mesh, const FoldCluster& cluster, std::span<const Stroke> strokes,
          const WrinkleOptions& options, const StageObserver& observer)
      : mesh_(mesh),
        given_(mesh),
        cluster_(cluster),
        strokes_(strokes),
        options_(options),
        observer_(observer),
        folds_(cluster.curves) {}

  Folded run() {
    const BandOptions refining = refining_of(options_);
    WrinkleReport& report = folded_.report;
    report.fold = FoldReport{};
    BandReport band = refine_band(mesh_, folds_.curves, refining);
    if (observer_) {
      complete_springs(mesh_, band.changed_faces);
      observer_(Stage::inserted, mesh_);
    }
    const Raised raised = raise_folds(given_, mesh_, band, folds_, {refining, options_.flat_base});
    note_band(band, report);
    report.lines = lines_of(strokes_, folds_, band.chains, cluster_.lines, options_.first_line);
    report.undisplaced.assign(raised.base.begin(), raised.base.end());
    complete_springs(mesh_, band.changed_faces);
    raise(raised);
    note_shape(mesh_, raised, folds_, band, cluster_.lines, report);
    folded_.before.assign(given_.points().begin(), given_.points().end());
    return std::move(folded_);
  }

 private:
  /// Positions and rest state.
  void raise(const Raised& raised) {
    WrinkleReport& report = folded_.report;
    const std::vector<int>& ids = cluster_.lines;
    const LineShapes shapes = shapes_of(report.lines, ids);
    const RestSnapshot before = take_rest_snapshot(mesh_);
    const Mesh on_base = with_points(mesh_, raised.base);
    const std::vector<double> angles = all_angles(on_base);
    const auto base = heights_of(on_base, ids, shapes);
    lay(mesh_, raised);
    folded_.displaced.assign(mesh_.points().begin(), mesh_.points().end());
    const auto drawn = heights_of(mesh_, ids, shapes);
    if (observer_) observer_(Stage::displaced, mesh_);
    const std::set<Vertex> held(options_.held.begin(), options_.held.end());
    report.fold->unsmoothed_vertices = smooth(mesh_, raised, options_, held);
    press_stored_hinges(mesh_, shapes);
    report.fold->reshaped_faces =
        apply_fold_rest(mesh_, before, angles, set_of_edges(mesh_, raised.set), options_.rest).reshaped_faces;
    note_heights(report.lines, base, drawn, heights_of(mesh_, ids, shapes));
  }

  Mesh& mesh_;
  const Mesh given_;
  const FoldCluster& cluster_;
  std::span<const Stroke> strokes_;
  const WrinkleOptions& options_;
  const StageObserver& observer_;
  const Folds folds_;
  Folded folded_;
};

/// Where the elements of a patch are in the whole; without a patch, where they are.
struct Places {
  std::vector<Vertex> vertices;
  std::vector<Face> faces;
  std::size_t old_vertices = 0, old_faces = 0;  ///< of the whole

  Vertex of(Vertex v) const {
    if (v.idx() < vertices.size()) return vertices[v.idx()];
    return Vertex(static_cast<Vertex::size_type>(old_vertices + v.idx() - vertices.size()));
  }
  Face of(Face f) const {
    if (f.idx() < faces.size()) return faces[f.idx()];
    return Face(static_cast<Face::size_type>(old_faces + f.idx() - faces.size()));
  }
};

void add_fold(FoldReport& sum, const FoldReport& fold, bool first) {
  const auto less = [&](double& least, double x) { least = first ? x : std::min(least, x); };
  less(sum.min_angle_before_deg, fold.min_angle_before_deg);
  less(sum.min_angle_deg, fold.min_angle_deg);
  sum.lateral = std::max(sum.lateral, fold.lateral);
  sum.snapped += fold.snapped;
  sum.reshaped_faces += fold.reshaped_faces;
  sum.unsmoothed_vertices += fold.unsmoothed_vertices;
}

/// Notes what was done to the mesh of `progress`, which has it already.
void add(Folded&& folded, const FoldCluster& cluster, const Places& places, FoldProgress& progress) {
  WrinkleReport &report = folded.report, &sum = progress.report;
  for (Index<Face>& f : report.insertion.changed_faces) f = places.of(Face(f));
  for (SplitEdge& e : report.insertion.split_edges)
    for (Index<Vertex>* v : {&e.from, &e.to, &e.vertex}) *v = places.of(Vertex(*v));
  sum.insertion += report.insertion;
  add_fold(*sum.fold, *report.fold, progress.lines.empty());
  for (std::string& warning : report.warnings)
    if (std::find(sum.warnings.begin(), sum.warnings.end(), warning) == sum.warnings.end())
      sum.warnings.push_back(std::move(warning));
  sum.undisplaced.resize(progress.mesh.num_vertices());
  progress.displaced.resize(progress.mesh.num_vertices());
  for (std::size_t i = 0; i < folded.displaced.size(); ++i) {
    const std::size_t v = places.of(Vertex(static_cast<Vertex::size_type>(i))).idx();
    const bool is_new = i >= folded.before.size();
    const Point base = report.undisplaced[i];
    if (is_new || base != folded.before[i]) sum.undisplaced[v] = base;
    if (is_new || folded.displaced[i] != folded.before[i]) progress.displaced[v] = folded.displaced[i];
  }
  for (std::size_t i = 0; i < report.lines.size(); ++i) {
    for (auto& chain : report.lines[i].chains)
      for (Index<Vertex>& v : chain) v = places.of(Vertex(v));
    progress.lines[cluster.lines[i]] = std::move(report.lines[i]);
  }
}

template <class Key>
std::optional<Key> local(const std::vector<Key>& list, Key of) {
  const auto at = std::lower_bound(list.begin(), list.end(), of);
  if (at == list.end() || *at != of) return std::nullopt;
  return Key(static_cast<typename Key::size_type>(at - list.begin()));
}

/// Folds a cluster into a patch; false, nothing changed, if that reached the patch's rim.
bool fold_in_patch(FoldCluster cluster, std::span<const Stroke> strokes, const WrinkleOptions& options,
                   FoldProgress& progress) {
  Mesh& mesh = progress.mesh;
  Patch patch = cut_patch(mesh, faces_to_fold(mesh, cluster.curves, refining_of(options)));
  const std::vector<bool> rim = patch.rim(mesh);
  for (FoldCurve& curve : cluster.curves)
    for (FacePoint& place : curve.places) place.face = local(patch.faces, place.face).value();
  WrinkleOptions there = options;
  there.held.clear();
  for (Vertex v : options.held)
    if (const auto held = local(patch.vertices, v)) there.held.push_back(*held);
  Folded folded = Folding(patch.mesh, cluster, strokes, there, {}).run();
  for (Face f : folded.report.insertion.changed_faces)
    for (Vertex v : corners_of(patch.mesh, f))
      if (v.idx() < rim.size() && rim[v.idx()]) return false;
  const Places places{patch.vertices, patch.faces, mesh.num_vertices(), mesh.num_faces()};
  put_back(patch, mesh);
  add(std::move(folded), cluster, places, progress);
  return true;
}

/// The first cluster goes into the garment as a whole, and each of the others into what is around it.
void fold_cluster(const Mesh& garment, const FoldCluster& given, std::span<const Stroke> strokes,
                  const WrinkleOptions& options, const StageObserver& observer, FoldProgress& progress) {
  FoldCluster cluster = given;
  const bool is_first = progress.lines.empty();
  if (!is_first)
    for (FoldCurve& curve : cluster.curves) curve = carried_to(progress.mesh, garment, curve);
  if (is_first || !fold_in_patch(cluster, strokes, options, progress)) {
    Folded folded = Folding(progress.mesh, cluster, strokes, options, observer).run();
    add(std::move(folded), cluster, {}, progress);
  }
  note_paths(given.curves, progress);
}

/// What struts join is not cut into patches.
std::vector<FoldCluster> clusters_in(const Mesh& mesh, std::vector<FoldCurve> curves,
                                     const BandOptions& refining) {
  if (struts(mesh).empty()) return clusters_of(mesh, curves, refining);
  FoldCluster all;
  for (const FoldCurve& curve : curves)
    if (all.lines.empty() || all.lines.back() != curve.line) all.lines.push_back(curve.line);
  all.curves = std::move(curves);
  return {std::move(all)};
}

/// Folds all clusters, one after the other; those of which options.memory knows are not folded again.
FoldProgress fold_all(const Mesh& garment, std::span<const FoldCluster> clusters,
                      std::span<const Stroke> strokes, const WrinkleOptions& options,
                      const StageObserver& observer) {
  FoldProgress progress;
  FoldMemory* memory = options.insertion.may_flip ? nullptr : options.memory.get();
  const std::string bits = memory ? bits_of(garment) + bits_of(options) : "";
  std::vector<std::string> keys;
  for (std::size_t i = 0; memory && i < clusters.size(); ++i)
    keys.push_back(bits_of(clusters[i], strokes, options.first_line));
  std::size_t next = memory && !observer ? memory->recall(bits, keys, progress) : 0;
  if (next == 0) {
    progress.mesh = garment;
    progress.report.fold = FoldReport{};
    progress.report.undisplaced.assign(garment.points().begin(), garment.points().end());
    progress.displaced.assign(garment.points().begin(), garment.points().end());
  }
  for (; next < clusters.size(); ++next) {
    fold_cluster(garment, clusters[next], strokes, options, observer, progress);
    if (memory) memory->remember(bits, std::span(keys).first(next + 1), progress);
  }
  return progress;
}

/// The report as it began with what folding adds to it.
void join(WrinkleReport& report, FoldProgress& progress) {
  FoldReport fold = *progress.report.fold;
  fold.angle_defect_before = report.fold->angle_defect_before;
  fold.angle_defect_after = angle_defect(progress.mesh);
  fold.invalid_faces = invalid_rest_faces(progress.mesh);
  report.fold = fold;
  report.insertion = std::move(progress.report.insertion);
  report.undisplaced = std::move(progress.report.undisplaced);
  report.warnings.insert(report.warnings.end(), progress.report.warnings.begin(),
                         progress.report.warnings.end());
  for (auto& entry : progress.lines) report.lines.push_back(std::move(entry.second));
}

}  // namespace

WrinkleReport fold_lines(Mesh& mesh, std::span<const Stroke> strokes, const WrinkleOptions& options,
                         const StageObserver& observer) {
  Mesh garment = mesh;
  WrinkleReport report = begin_wrinkling(garment, options);
  report.fold = FoldReport{};
  report.fold->angle_defect_before = angle_defect(garment);
  std::vector<FoldCurve> curves = curves_of(garment, strokes, options, report);
  require_bearable(curves, refining_of(options));
  const std::vector<FoldCluster> clusters = clusters_in(garment, std::move(curves), refining_of(options));
  const bool is_one = clusters.size() == 1;
  FoldProgress progress = fold_all(garment, clusters, strokes, options, is_one ? observer : StageObserver());
  Mesh& work = progress.mesh;
  if (observer && !is_one) {  // each was raised before the next one was inserted
    const auto& flat = progress.report.undisplaced;
    observer(Stage::inserted, with_points(work, {flat.begin(), flat.end()}));
    observer(Stage::displaced, with_points(work, progress.displaced));
  }
  join(report, progress);
  for (std::size_t i = 0; i < report.lines.size(); ++i) report.lines[i].gather = strokes[i].gather;
  gather_lines(work, report.lines);
  end_wrinkling(work, options, report);
  if (observer) observer(Stage::smoothed, work);
  mesh = std::move(work);
  return report;
}

std::shared_ptr<FoldMemory> make_fold_memory() { return std::make_shared<FoldMemory>(); }

}  // namespace furrow::geometry
