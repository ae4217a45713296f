// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/prepare_strokes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/property_names.h"
#include "geometry/stroke/curve_cuts.h"
#include "geometry/stroke/placed_stroke.h"
#include "geometry/stroke/project_onto_surface.h"
#include "geometry/stroke/trace_stroke.h"
#include "geometry/stroke/walk_surface.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr double width_of_height = 5, least_width = 4;  ///< in |k|, in h
constexpr double most_of_height = 7.5;                  ///< in |k|: where h is long, it widens no fold beyond
constexpr double steepest = 0.31;                       ///< k over width: 45 degrees
constexpr double usual_gather = 0.04, least_gathers = 8;  ///< a gather's width [m]; how many of them, if less
constexpr std::size_t most_points = 5000;

Vec3 vec(const Point& p) { return {p.x(), p.y(), p.z()}; }
Vec3 vec(const Vector& v) { return {v.x(), v.y(), v.z()}; }
Point point(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::string quoted(const Stroke& stroke) { return "stroke \"" + stroke.name + "\": "; }

/// A piece of a stroke as it lies on the surface: segment i, in one face, goes from point i to the next one.
struct Piece {
  std::size_t stroke = 0;
  bool closed = false;
  std::vector<Vec3> points;                         ///< closed: the first again at the end
  std::vector<Face> faces;                          ///< of the segments
  std::vector<std::size_t> samples, sample_points;  ///< indices into Stroke::points, and where in `points`
  std::vector<double> arc;                          ///< of the points [m]
  double width = 0;                                 ///< its greatest [m]
  double length() const { return arc.back(); }
};

void push(Piece& piece, const Point& p, Face from) {
  if (!piece.points.empty()) {
    if ((vec(p) - piece.points.back()).norm() < 1e-12) return;
    piece.faces.push_back(from);
  }
  piece.points.push_back(vec(p));
}

void measure_arc(Piece& piece) {
  piece.arc.assign(1, 0);
  for (std::size_t i = 1; i < piece.points.size(); ++i)
    piece.arc.push_back(piece.arc.back() + (piece.points[i] - piece.points[i - 1]).norm());
}

/// The samples of a visit are those that follow the last ones taken, in its face.
Piece piece_of(const TracedStroke& traced, const SubStroke& part, std::size_t stroke, std::size_t& next) {
  Piece piece;
  piece.stroke = stroke;
  piece.closed = part.closed;
  const auto& samples = traced.samples;
  for (const CrossedFace& visit : part.faces) {
    if (visit.entry) push(piece, visit.entry->position, visit.face);
    std::size_t at = next;
    while (at < std::min(samples.size(), next + 3) && samples[at].point.face != visit.face) ++at;
    const bool found = visit.samples > 0 && at < std::min(samples.size(), next + 3);
    if (found) next = at;
    for (; found && next < samples.size() && samples[next].point.face == visit.face; ++next) {
      push(piece, samples[next].position, visit.face);
      piece.samples.push_back(samples[next].index);
      piece.sample_points.push_back(piece.points.size() - 1);
    }
    if (visit.exit) push(piece, visit.exit->position, visit.face);
  }
  if (piece.closed && piece.points.size() > 2)
    push(piece, point(piece.points.front()), part.faces.front().face);
  measure_arc(piece);
  return piece;
}

/// Numbers at a stroke's points, at a place of a piece: linear between samples.
double number_at(const Piece& piece, const std::vector<double>& numbers, double usual, double along) {
  if (numbers.empty() || piece.samples.empty()) return usual;
  std::size_t i = 0;
  while (i < piece.samples.size() && piece.arc[piece.sample_points[i]] <= along) ++i;
  if (i == 0 && !piece.closed) return numbers[piece.samples.front()];
  if (i == piece.samples.size() && !piece.closed) return numbers[piece.samples.back()];
  const std::size_t n = piece.samples.size(), before = (i + n - 1) % n, after = i % n;
  double from = piece.arc[piece.sample_points[before]], to = piece.arc[piece.sample_points[after]];
  if (i == 0) from -= piece.length();
  if (i == n) to += piece.length();
  const double t = to > from ? std::clamp((along - from) / (to - from), 0.0, 1.0) : 0;
  return (1 - t) * numbers[piece.samples[before]] + t * numbers[piece.samples[after]];
}

Vec3 normal_at(const Mesh& mesh, Face face) { return vec(area_normal_of(mesh, face)).normalized(); }

class Preparing {
 public:
  Preparing(const Mesh& mesh, std::span<const Stroke> strokes, const PrepareOptions& options)
      : mesh_(mesh), strokes_(strokes), options_(options), projector_(mesh) {
    for (Halfedge h : mesh.halfedges())
      if (mesh.is_border(h)) border_.push_back(h);
  }

  PreparedStrokes prepare() {
    trace_all();
    choose_widths();
    for (const Piece& piece : pieces_) result_.curves.push_back(curve_of(piece));
    std::vector<double> slopes;
    for (std::size_t i = 0; i < strokes_.size(); ++i) slopes.push_back(warn_of_bends(i));
    warn_of_slopes(slopes);
    warn_of_opposites();
    return std::move(result_);
  }

 private:
  void warn(std::size_t stroke, const std::string& what) {
    result_.warnings.push_back(quoted(strokes_[stroke]) + what);
  }

  /// Every stroke that does not lie on the mesh is told at once.
  void trace_all() {
    StrokeFaults faults;
    for (std::size_t i = 0; i < strokes_.size(); ++i) {
      try {
        trace(i);
      } catch (const ContentError& e) {
        faults.add(e.what());
      }
    }
    faults.raise();
  }

  void trace(std::size_t i) {
    const Stroke& stroke = strokes_[i];
    for (const auto* list : {&stroke.heights, &stroke.widths})
      if (!list->empty() && list->size() != stroke.points.size())
        throw ContentError(quoted(stroke) + std::to_string(list->size()) + " numbers for " +
                           std::to_string(stroke.points.size()) + " points");
    const TracedStroke traced =
        trace_stroke(mesh_, projector_, stroke, {options_.max_distance, options_.mean_edge});
    for (const std::string& warning : traced.warnings) result_.warnings.push_back(warning);
    std::size_t next = 0;
    const std::size_t before = pieces_.size();
    for (const SubStroke& part : traced.sub_strokes) {
      Piece piece = piece_of(traced, part, i, next);
      if (!piece.closed) go_to_borders(piece);
      if (piece.length() > 1e-3 * options_.mean_edge) pieces_.push_back(std::move(piece));
    }
    if (pieces_.size() == before)
      throw ContentError(quoted(stroke) +
                         "is a point; the rule fold needs a line: draw it longer, or use the rule safe");
  }

  struct BorderPoint {
    Vec3 place, along;
    Face face;
    double distance = std::numeric_limits<double>::infinity();
  };
  BorderPoint nearest_border(const Vec3& p) const {
    BorderPoint best;
    for (Halfedge h : border_) {
      const Vec3 a = vec(mesh_.point(mesh_.source(h))), e = vec(mesh_.point(mesh_.target(h))) - a;
      const double t = std::clamp((p - a).dot(e) / std::max(e.squaredNorm(), 1e-300), 0.0, 1.0);
      const double distance = (a + t * e - p).norm();
      if (distance < best.distance)
        best = {a + t * e, e.normalized(), mesh_.face(mesh_.opposite(h)), distance};
    }
    return best;
  }

  /// Whether the line, going `outward`, meets the border there.
  static bool meets(const BorderPoint& border, const Vec3& p, const Vec3& outward, double reach) {
    if (!(border.distance <= reach) || std::abs(outward.dot(border.along)) > 0.9) return false;
    return (border.place - p).dot(outward) >= 0.5 * border.distance;
  }

  void go_to_borders(Piece& piece) const {
    if (piece.points.size() < 2) return;
    for (int end = 0; end < 2; ++end) {
      const Vec3 p = end_point(piece.points, end), outward = outward_at(piece.points, end);
      const BorderPoint border = nearest_border(p);
      if (border.distance < 1e-9 || !meets(border, p, outward, 0.3 * options_.mean_edge)) continue;
      if (end == 0) {
        piece.points.insert(piece.points.begin(), border.place);
        piece.faces.insert(piece.faces.begin(), border.face);
        for (std::size_t& i : piece.sample_points) ++i;
      } else {
        piece.points.push_back(border.place);
        piece.faces.push_back(border.face);
      }
    }
    measure_arc(piece);
  }

  static Vec3 end_point(const std::vector<Vec3>& points, int end) {
    return end == 0 ? points.front() : points.back();
  }
  static Vec3 outward_at(const std::vector<Vec3>& points, int end) {
    const std::size_t n = points.size();
    return (end == 0 ? points[0] - points[1] : points[n - 1] - points[n - 2]).normalized();
  }

  /// Median distance of the nearest line of the same sign where it runs side by side with this one for at
  /// least half of its length; infinite without any.
  double neighbour_distance(const Piece& piece) const {
    std::vector<double> distances;
    std::size_t asked = 0;
    const std::size_t step = std::max<std::size_t>(1, piece.faces.size() / 64);
    for (std::size_t i = 0; i < piece.faces.size(); i += step, ++asked)
      if (const double d = distance_beside(piece, i); std::isfinite(d)) distances.push_back(d);
    if (2 * distances.size() < asked) return std::numeric_limits<double>::infinity();
    std::nth_element(distances.begin(), distances.begin() + distances.size() / 2, distances.end());
    return distances[distances.size() / 2];
  }

  double distance_beside(const Piece& piece, std::size_t i) const {
    const Vec3 p = 0.5 * (piece.points[i] + piece.points[i + 1]),
               along = (piece.points[i + 1] - piece.points[i]).normalized(),
               normal = normal_at(mesh_, piece.faces[i]);
    physics::throw_if_cancelled("wrinkle");
    double least = std::numeric_limits<double>::infinity();
    for (const Piece& other : pieces_) {
      if (other.stroke == piece.stroke || strokes_[other.stroke].height * strokes_[piece.stroke].height <= 0)
        continue;
      for (std::size_t j = 0; j < other.faces.size(); ++j) {
        const Vec3 a = other.points[j], e = other.points[j + 1] - a;
        const double t = std::clamp((p - a).dot(e) / e.squaredNorm(), 0.0, 1.0);
        const double distance = (a + t * e - p).norm();
        if (distance >= least || std::abs(e.normalized().dot(along)) < 0.7) continue;
        if (std::abs((a + t * e - p).dot(along)) > 0.5 * distance) continue;  // before or behind it
        if (normal_at(mesh_, other.faces[j]).dot(normal) > 0) least = distance;
      }
    }
    return least;
  }

  void choose_widths() {
    for (Piece& piece : pieces_) {
      const Stroke& stroke = strokes_[piece.stroke];
      piece.width = stroke.width.value_or(0);
      if (stroke.width) continue;
      const double apart = neighbour_distance(piece), k = std::abs(stroke.height);
      const double least = least_width * options_.mean_edge;
      if (stroke.gather && k == 0)
        piece.width = std::min(usual_gather, piece.length() / least_gathers);
      else
        piece.width = std::max(std::min(width_of_height * k, apart),
                               k > 0 ? std::min(least, most_of_height * k) : least);
    }
    for (Piece& piece : pieces_)  // the pieces of a stroke are one fold
      for (const Piece& other : pieces_)
        if (other.stroke == piece.stroke && !strokes_[piece.stroke].width)
          piece.width = std::max(piece.width, other.width);
  }

  /// Points at equal distances, with the faces that they lie in.
  struct Samples {
    std::vector<Vec3> points;
    std::vector<Face> faces;
    std::vector<double> along;
  };
  Samples resample(const Piece& piece) const {
    const double apart = std::min(options_.mean_edge / 4, piece.width / 20);
    const std::size_t n =
        std::clamp(static_cast<std::size_t>(std::ceil(piece.length() / apart)), std::size_t{8}, most_points);
    Samples samples;
    std::size_t segment = 0;
    for (std::size_t i = 0; i < n + (piece.closed ? 0 : 1); ++i) {
      const double along = piece.length() * static_cast<double>(i) / static_cast<double>(n);
      while (segment + 1 < piece.faces.size() && piece.arc[segment + 1] < along) ++segment;
      const double l = piece.arc[segment + 1] - piece.arc[segment];
      const double t = std::clamp((along - piece.arc[segment]) / l, 0.0, 1.0);
      samples.points.push_back((1 - t) * piece.points[segment] + t * piece.points[segment + 1]);
      samples.faces.push_back(piece.faces[segment]);
      samples.along.push_back(along);
    }
    return samples;
  }

  /// Gaussian of sigma [m] over points that are `apart` [m]; an open curve goes on beyond its ends, turned by
  /// half a turn about them, so that they stay and straight lines do.
  static std::vector<Vec3> smoothed(const std::vector<Vec3>& points, bool closed, double sigma,
                                    double apart) {
    const auto n = static_cast<std::ptrdiff_t>(points.size());
    const std::ptrdiff_t reach = std::min<std::ptrdiff_t>(std::lround(3 * sigma / apart), n - 1);
    if (reach < 1) return points;
    const auto at = [&](std::ptrdiff_t i) -> Vec3 {
      if (closed) return points[static_cast<std::size_t>((i + n) % n)];
      if (i < 0) return 2 * points.front() - points[static_cast<std::size_t>(-i)];
      if (i >= n) return 2 * points.back() - points[static_cast<std::size_t>(2 * (n - 1) - i)];
      return points[static_cast<std::size_t>(i)];
    };
    std::vector<Vec3> result;
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      physics::throw_if_cancelled("wrinkle");
      Vec3 sum = Vec3::Zero();
      double weights = 0;
      for (std::ptrdiff_t j = -reach; j <= reach; ++j) {
        const double x = static_cast<double>(j) * apart / sigma, weight = std::exp(-0.5 * x * x);
        sum += weight * at(i + j);
        weights += weight;
      }
      result.push_back(sum / weights);
    }
    if (!closed) result.front() = points.front(), result.back() = points.back();
    return result;
  }

  void lay_back(const Samples& samples, const std::vector<Vec3>& places, FoldCurve& curve) const {
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double moved = (places[i] - samples.points[i]).norm();
      if (moved < 1e-12) {
        const Barycentrics b = barycentrics_of(mesh_, samples.faces[i], point(samples.points[i]));
        curve.places.push_back({samples.faces[i], b});
        curve.points.push_back(samples.points[i]);
        continue;
      }
      const std::vector<Face> near = faces_reachable_within(mesh_, samples.faces[i], point(samples.points[i]),
                                                            2 * moved + 0.1 * options_.mean_edge);
      const SurfaceHit hit = projector_.closest_among(point(places[i]), near);
      curve.places.push_back(hit.point);
      curve.points.push_back(vec(hit.position));
    }
  }

  FoldCurve curve_of(const Piece& piece) {
    const Stroke& stroke = strokes_[piece.stroke];
    FoldCurve curve;
    curve.line = options_.first_line + static_cast<int>(piece.stroke);
    curve.name = stroke.name;
    curve.closed = piece.closed;
    curve.sharpness = stroke.sharpness.value_or(0);
    curve.set = stroke.set;
    const Samples samples = resample(piece);
    for (double along : samples.along) {
      physics::throw_if_cancelled("wrinkle");
      curve.width.push_back(number_at(piece, stroke.widths, piece.width, along));
      curve.height.push_back(number_at(piece, stroke.heights, stroke.height, along));
    }
    const double apart = piece.length() / static_cast<double>(samples.points.size() - (piece.closed ? 0 : 1));
    const double sigma = stroke.smooth * piece.width / 10;
    const auto places = sigma > 0 ? smoothed(samples.points, piece.closed, sigma, apart) : samples.points;
    lay_back(samples, places, curve);
    double moved = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      moved = std::max(moved, (curve.points[i] - samples.points[i]).norm());
    if (moved > 0.1 * piece.width)
      warn(piece.stroke, "smoothing moves it by " + length_text(moved) +
                             ", more than a tenth of its width of " + length_text(piece.width) +
                             "; \"smooth\": 0 takes it as it is drawn");
    measure(curve);
    if (drop_small_loops(mesh_, curve) > 0) measure(curve);
    cut_where_it_meets_itself(mesh_, curve);
    find_ends(curve);
    curve.rise = rise_of(curve, stroke, piece.width);
    return curve;
  }

  static void measure(FoldCurve& curve) {
    curve.arc.assign(1, 0);
    for (std::size_t i = 1; i < curve.points.size(); ++i)
      curve.arc.push_back(curve.arc.back() + (curve.points[i] - curve.points[i - 1]).norm());
    curve.length = curve.arc.back();
    if (curve.closed) curve.length += (curve.points.front() - curve.points.back()).norm();
  }

  void find_ends(FoldCurve& curve) const {
    if (curve.closed) return;
    for (int end = 0; end < 2; ++end) {
      const Vec3 p = end_point(curve.points, end);
      const BorderPoint border = nearest_border(p);
      const bool at = border.distance <= 1e-6 * options_.mean_edge &&
                      std::abs(outward_at(curve.points, end).dot(border.along)) <= 0.9;
      (end == 0 ? curve.begins_at_border : curve.ends_at_border) = at;
    }
  }

  static std::array<double, 2> rise_of(const FoldCurve& curve, const Stroke& stroke, double width) {
    if (curve.closed) return {0, 0};
    const std::array<bool, 2> at_border{curve.begins_at_border, curve.ends_at_border};
    const bool flare = stroke.flare.value_or(!stroke.taper && at_border[0] != at_border[1]);
    std::array<double, 2> rise;
    for (int end = 0; end < 2; ++end) {
      rise[end] = at_border[end] ? 0 : std::min(1.5 * width, 0.45 * curve.length);
      if (stroke.taper) rise[end] = std::min((*stroke.taper)[end], 0.5 * curve.length);
    }
    const int low = at_border[0] && !at_border[1] ? 1 : 0;  // where the flare begins
    if (flare) rise[low] = 0.75 * curve.length;
    if (flare && rise[1 - low] > 0) rise[1 - low] = std::min(rise[1 - low], 0.25 * curve.length);
    return rise;
  }

  /// Curvature within the surface over a quarter of the width, times half the width [-].
  double bend(const FoldCurve& curve, std::size_t i, std::size_t step) const {
    if (i < step || i + step >= curve.points.size()) return 0;
    const Vec3 a = curve.points[i] - curve.points[i - step], b = curve.points[i + step] - curve.points[i];
    Vec3 turn = b.normalized() - a.normalized();
    const Vec3 normal = normal_at(mesh_, curve.places[i].face);
    turn -= turn.dot(normal) * normal;
    return 0.5 * curve.width[i] * turn.norm() / (0.5 * (a.norm() + b.norm()));
  }

  /// Returns the stroke's greatest height over its width.
  double warn_of_bends(std::size_t stroke) {
    double tightest = 0, slope = 0, width = 0;
    for (const FoldCurve& curve : result_.curves) {
      if (curve.line != options_.first_line + static_cast<int>(stroke)) continue;
      const double apart = curve.length / static_cast<double>(curve.points.size());
      for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const auto step = static_cast<std::size_t>(std::max(1.0, std::round(0.125 * curve.width[i] / apart)));
        tightest = std::max(tightest, bend(curve, i, step));
        slope = std::max(slope, std::abs(curve.height[i]) / curve.width[i]);
        width = std::max(width, curve.width[i]);
      }
    }
    if (tightest > 1 && slope > 0)  // a line of height 0 raises no cloth to gather
      warn(stroke,
           "bends with a radius below half its width of " + length_text(width) +
               ", so that the cloth gathers on the inner side; " +
               (strokes_[stroke].points.size() < 6
                    ? "its few points make a corner: draw the bend with more points along a round curve"
                    : "draw the bend rounder, or make the line narrower"));
    return slope;
  }

  /// One warning for all of them: strokes of one garment are alike.
  void warn_of_slopes(const std::vector<double>& slopes) {
    std::vector<std::size_t> steep;
    for (std::size_t i = 0; i < slopes.size(); ++i)
      if (slopes[i] > steepest) steep.push_back(i);
    if (steep.empty()) return;
    std::stable_sort(steep.begin(), steep.end(), [&](auto a, auto b) { return slopes[a] > slopes[b]; });
    const auto share = [&](std::size_t i) { return std::to_string(slopes[i]).substr(0, 4); };
    const bool alone = steep.size() == 1;
    const std::string others =
        alone ? ""
              : " (and " + std::to_string(steep.size() - 1) + (steep.size() > 2 ? " others" : " other") + ")";
    warn(steep.front(), "its height is " + share(steep.front()) + " of its width" + others +
                            ": steeper than 45 degrees, from 0.31 on; a wider or lower line is smoother");
  }

  void warn_of_opposites() {
    const auto& curves = result_.curves;
    for (std::size_t i = 0; i < curves.size(); ++i)
      for (std::size_t j = i + 1; j < curves.size(); ++j) {
        if (curves[i].height.front() * curves[j].height.front() >= 0) continue;
        const double width = std::max(curves[i].width.front(), curves[j].width.front());
        if (overlap(curves[i], curves[j], 0.5 * width))
          warn(static_cast<std::size_t>(curves[i].line - options_.first_line),
               "runs beside \"" + curves[j].name +
                   "\" nearer than half a width; a ridge and a valley there cancel each other");
      }
  }

  static Vec3 direction_at(const FoldCurve& curve, std::size_t i) {
    const std::size_t last = curve.points.size() - 1;
    return (curve.points[std::min(i + 1, last)] - curve.points[i > 0 ? i - 1 : 0]).normalized();
  }

  /// Whether two curves run along each other, nearer than `reach`, for more than a quarter of the first one.
  static bool overlap(const FoldCurve& a, const FoldCurve& b, double reach) {
    physics::throw_if_cancelled("wrinkle");
    std::size_t near = 0, asked = 0;
    const std::size_t step = std::max<std::size_t>(1, a.points.size() / 64);
    for (std::size_t i = 0; i < a.points.size(); i += step, ++asked) {
      const Vec3 along = direction_at(a, i);
      for (std::size_t j = 0; j < b.points.size(); ++j)
        if ((b.points[j] - a.points[i]).norm() < reach && std::abs(direction_at(b, j).dot(along)) > 0.7) {
          ++near;
          break;
        }
    }
    return 4 * near > asked;
  }

  const Mesh& mesh_;
  std::span<const Stroke> strokes_;
  const PrepareOptions& options_;
  SurfaceProjector projector_;
  std::vector<Halfedge> border_;
  std::vector<Piece> pieces_;
  PreparedStrokes result_;
};

}  // namespace

PreparedStrokes prepare_strokes(const Mesh& mesh, std::span<const Stroke> strokes,
                                const PrepareOptions& options) {
  if (strokes.empty()) return {};
  return Preparing(mesh, strokes, options).prepare();
}

}  // namespace furrow::geometry
