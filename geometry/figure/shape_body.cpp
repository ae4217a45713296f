// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/shape_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/figure/repair_body.h"
#include "geometry/figure/trunk_outline.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"

namespace furrow::geometry {
namespace {

constexpr int most_rounds = 40;
constexpr double close_enough = 1e-3;                       // m
constexpr double ankles = 0.06, knees = 0.28, neck = 0.87;  // of the height
constexpr double share_at_knees = 0.4;                      // of what the hips grow by
constexpr double arm_blend = 0.08;                          // beyond the trunk's outline, of its radius

using Triangles = std::span<const std::array<int, 3>>;

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

std::array<double, 2> extent(std::span<const Point> points) {
  std::array<double, 2> range{points[0].y(), points[0].y()};
  for (const Point& p : points) range = {std::min(range[0], p.y()), std::max(range[1], p.y())};
  return range;
}

/// A body that was measured, and its trunk.
struct MeasuredBody {
  BodyMeasures measures;
  TorsoHeights heights;
  double low = 0;
  std::vector<TorsoLevel> levels;
};

MeasuredBody measured(std::span<const Point> points, Triangles triangles) {
  const char* const fault =
      "the body has no torso that could be measured: it must stand upright, 0.9 to 2.5 m high, y up; look at "
      "`unit` and `up`";
  if (points.empty()) throw ContentError("the body is empty");
  MeasuredBody body;
  body.levels = torso_levels(points, triangles);
  const auto [low, high] = extent(points);
  const auto heights = torso_heights(body.levels, low, high);
  if (!heights) throw ContentError(fault);
  body.low = low;
  body.heights = *heights;
  const auto girth = [&](double height) {
    const auto section = torso_section(points, triangles, body.levels, height);
    if (!section) throw ContentError(fault);
    return tape_measure(section->torso);
  };
  body.measures = {high - low, girth(heights->chest), girth(heights->waist), girth(heights->hip)};
  return body;
}

/// Factors on slices, and what they do to a place.
class Reshaping {
 public:
  Reshaping(const MeasuredBody& body, std::span<const Point> points, Triangles triangles,
            const BodyMeasures& factors)
      : factors_(factors), heights_(body.heights) {
    for (const TorsoLevel& level : body.levels)
      if (const auto section = torso_section(points, triangles, body.levels, level.height))
        outlines_.push_back(outline_of(section->torso, level.height));
    const double height = body.measures.height, top = body.levels.back().height;
    knots_ = {{{body.low + ankles * height, 1},
               {body.low + knees * height, 1 + share_at_knees * (factors.hip - 1)},
               {body.heights.hip, factors.hip},
               {body.heights.waist, factors.waist},
               {body.heights.chest, factors.chest},
               {std::max(top, body.heights.chest), factors.chest},
               {body.low + neck * height, 1}}};
  }

  Point operator()(const Point& p) const {
    const auto [below, above, t] = around(p.y());
    const auto blend = [t = t](double a, double b) { return a + t * (b - a); };
    const double x = p.x() - blend(below->centre[0], above->centre[0]),
                 z = p.z() - blend(below->centre[1], above->centre[1]), r = std::hypot(x, z);
    if (!(r > 0)) return p;
    const double angle = std::atan2(z, x), trunk = blend(below->towards(angle), above->towards(angle));
    const double arm = smooth_step((r / trunk - 1) / arm_blend);
    const double factor = (1 - arm) * slice(p.y()) + arm * aside(p.y());
    const double move = (factor - 1) * std::min(r, trunk) / r;
    return Point(p.x() + move * x, p.y(), p.z() + move * z);
  }

 private:
  struct Knot {
    double height, factor;
  };

  /// The outlines below and above a height, and how far it is from one to the other [-].
  struct Between {
    const TrunkOutline *below, *above;
    double share;
  };
  Between around(double y) const {
    const auto above =
        std::lower_bound(outlines_.begin(), outlines_.end(), y,
                         [](const TrunkOutline& o, double height) { return o.height < height; });
    if (above == outlines_.begin()) return {&*above, &*above, 0};
    if (above == outlines_.end()) return {&outlines_.back(), &outlines_.back(), 0};
    const TrunkOutline& below = *(above - 1);
    return {&below, &*above, (y - below.height) / (above->height - below.height)};
  }

  double slice(double y) const {
    if (y <= knots_.front().height) return knots_.front().factor;
    for (std::size_t i = 1; i < knots_.size(); ++i) {
      const Knot &a = knots_[i - 1], &b = knots_[i];
      if (y <= b.height && b.height > a.height)
        return a.factor + smooth_step((y - a.height) / (b.height - a.height)) * (b.factor - a.factor);
    }
    return knots_.back().factor;
  }

  /// Of arms: from hip to chest as if there were no waist, so that they stay straight.
  double aside(double y) const {
    if (y <= heights_.hip || y >= heights_.chest) return slice(y);
    const double t = (y - heights_.hip) / (heights_.chest - heights_.hip);
    return factors_.hip + t * (factors_.chest - factors_.hip);
  }

  BodyMeasures factors_;
  TorsoHeights heights_;
  std::vector<TrunkOutline> outlines_;
  std::array<Knot, 7> knots_;
};

void check_measures(const BodyMeasures& wanted, const BodyMeasures& now) {
  const double all[] = {wanted.height, wanted.chest, wanted.waist, wanted.hip};
  for (const double value : all)
    if (!std::isfinite(value) || value < 0) refuse("shape_body", "a measurement is negative or not finite");
  if (!wanted.any()) refuse("shape_body", "no measurement is asked for");
  if (wanted.height != 0 && !(wanted.height >= 0.9 && wanted.height <= 2.5))
    refuse("shape_body", "height = " + std::to_string(wanted.height) + " m is not in [0.9, 2.5]");
  const double scale = wanted.height > 0 ? wanted.height / now.height : 1;
  const auto check = [&](const char* name, double asked, double own) {
    if (asked != 0 && !(asked >= 0.5 * scale * own && asked <= 2 * scale * own))
      refuse("shape_body", std::string(name) + " = " + std::to_string(asked) +
                               " m is not between half and twice the body's " + std::to_string(scale * own) +
                               " m");
  };
  check("chest", wanted.chest, now.chest);
  check("waist", wanted.waist, now.waist);
  check("hip", wanted.hip, now.hip);
}

/// About a place on the ground in the middle of the trunk.
void scale_to(double factor, const MeasuredBody& body, std::vector<Point>& points, Mesh& mesh) {
  const std::array<double, 2> centre = body.levels.front().centre;
  const auto scaled = [&](const Point& p) {
    return Point(centre[0] + factor * (p.x() - centre[0]), body.low + factor * (p.y() - body.low),
                 centre[1] + factor * (p.z() - centre[1]));
  };
  for (Point& p : points) p = scaled(p);
  for (const Vertex v : mesh.vertices()) mesh.point(v) = scaled(mesh.point(v));
}

double farthest_of(const BodyMeasures& wanted, const BodyMeasures& now) {
  double farthest = 0;
  const auto add = [&](double asked, double is) {
    if (asked > 0) farthest = std::max(farthest, std::abs(is - asked));
  };
  add(wanted.height, now.height), add(wanted.chest, now.chest);
  add(wanted.waist, now.waist), add(wanted.hip, now.hip);
  return farthest;
}

}  // namespace

BodyMeasures measure_body(std::span<const Point> points, std::span<const std::array<int, 3>> triangles) {
  return measured(points, triangles).measures;
}

ShapeReport shape_body(Mesh& mesh, const BodyMeasures& asked) {
  Body body = repair_body(mesh);
  MeasuredBody now = measured(body.points, body.triangles);
  ShapeReport report{now.measures, now.measures, 0, 0};
  check_measures(asked, now.measures);
  const double scale = asked.height > 0 ? asked.height / now.measures.height : 1;
  const auto wanted_girth = [&](double girth, double own) { return girth > 0 ? girth : scale * own; };
  const BodyMeasures wanted{scale * now.measures.height, wanted_girth(asked.chest, now.measures.chest),
                            wanted_girth(asked.waist, now.measures.waist),
                            wanted_girth(asked.hip, now.measures.hip)};
  Mesh shaped = mesh;
  scale_to(scale, now, body.points, shaped);
  for (now = measured(body.points, body.triangles);
       farthest_of(wanted, now.measures) > close_enough && report.rounds < most_rounds; ++report.rounds) {
    const Reshaping reshaped(now, body.points, body.triangles,
                             {1, wanted.chest / now.measures.chest, wanted.waist / now.measures.waist,
                              wanted.hip / now.measures.hip});
    for (Point& p : body.points) p = reshaped(p);
    for (const Vertex v : shaped.vertices()) shaped.point(v) = reshaped(shaped.point(v));
    now = measured(body.points, body.triangles);
  }
  report.reached = now.measures;
  report.farthest = farthest_of(asked, now.measures);
  for (const Vertex v : mesh.vertices()) mesh.point(v) = shaped.point(v);
  return report;
}

}  // namespace furrow::geometry
