// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/fit_ease.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bridge/convert.h"
#include "geometry/edge_metric.h"
#include "geometry/property_names.h"

namespace furrow::bridge {
namespace {

using geometry::SectionLoop;
using geometry::SectionPoint;

/// The half of the plane that is kept: normal . (p - middle) <= 0.
struct Cut {
  double x, z, normal_x, normal_z;
  double side(const SectionPoint& p) const { return (p.x - x) * normal_x + (p.z - z) * normal_z; }
  double along(double px, double pz) const { return (pz - z) * normal_x - (px - x) * normal_z; }
};

/// Halfway between two curves, across the shortest way between their points.
Cut between(const SectionLoop& torso, const SectionLoop& arm) {
  double least = std::numeric_limits<double>::infinity();
  Cut cut{};
  for (const SectionPoint& p : torso.points)
    for (const SectionPoint& q : arm.points) {
      const double distance = std::hypot(q.x - p.x, q.z - p.z);
      if (!(distance < least)) continue;
      least = distance;
      const double scale = distance > 0 ? 1 / distance : 0;
      cut = {(p.x + q.x) / 2, (p.z + q.z) / 2, (q.x - p.x) * scale, (q.z - p.z) * scale};
    }
  return cut;
}

/// The garment as arrays, its triangles with their rest lengths.
struct Cloth {
  std::vector<geometry::Point> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<double, 3>> rest;  ///< of edges 01, 12, 20 of each triangle [m]; empty: not known

  explicit Cloth(const geometry::Mesh& mesh)
      : points(mesh.num_vertices(), geometry::Point(0, 0, 0)), triangles(triangles_of(mesh)) {
    for (geometry::Vertex v : mesh.vertices()) points[v.idx()] = mesh.point(v);
    if (!geometry::find_map(mesh, geometry::kRestLength)) return;
    const std::vector<double> lengths = geometry::rest_lengths(mesh);
    for (geometry::Face f : mesh.faces()) rest.push_back(geometry::edge_lengths(mesh, f, lengths));
  }

  /// Of a straight way between two points of a triangle, in its rest metric: with u the difference of their
  /// barycentrics, l^2 = -(l01^2 u0 u1 + l12^2 u1 u2 + l20^2 u2 u0). (Sharp, Soliman, Crane 2019.)
  double rest_length(const SectionPoint& p, const SectionPoint& q, int triangle) const {
    const auto& t = triangles[static_cast<std::size_t>(triangle)];
    const auto& l = rest[static_cast<std::size_t>(triangle)];
    const auto weight = [](const SectionPoint& s, int v) {
      return v == s.a ? 1 - s.share : v == s.b ? s.share : 0;
    };
    std::array<double, 3> u{};
    for (std::size_t k = 0; k < 3; ++k) u[k] = weight(q, t[k]) - weight(p, t[k]);
    const double squared =
        -(l[0] * l[0] * u[0] * u[1] + l[1] * l[1] * u[1] * u[2] + l[2] * l[2] * u[2] * u[0]);
    return std::sqrt(std::max(0.0, squared));
  }
};

/// The part [from, to] of the way p -> q, in [0, 1], on the kept side of all cuts; empty where from >= to.
std::array<double, 2> kept_part(const SectionPoint& p, const SectionPoint& q, const std::vector<Cut>& cuts) {
  double from = 0, to = 1;
  for (const Cut& cut : cuts) {
    const double a = cut.side(p), b = cut.side(q);
    if (a > 0 && b > 0) return {1, 0};
    if (a > 0) from = std::max(from, a / (a - b));
    if (b > 0) to = std::min(to, a / (a - b));
  }
  return {from, to};
}

/// The straight lines that close what the cuts have opened: each from the first to the last crossing [m].
double closing_length(const SectionLoop& loop, const std::vector<Cut>& cuts) {
  double length = 0;
  for (const Cut& cut : cuts) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      const SectionPoint &p = loop.points[i], &q = loop.points[(i + 1) % loop.points.size()];
      const double a = cut.side(p), b = cut.side(q);
      if ((a > 0) == (b > 0)) continue;
      const double s = a / (a - b), along = cut.along(p.x + s * (q.x - p.x), p.z + s * (q.z - p.z));
      low = std::min(low, along);
      high = std::max(high, along);
    }
    if (high > low) length += high - low;
  }
  return length;
}

void measure_girths(const Cloth& cloth, const SectionLoop& loop, const std::vector<Cut>& cuts,
                    FitEase& ease) {
  double length = 0, rest = 0;
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const SectionPoint &p = loop.points[i], &q = loop.points[(i + 1) % loop.points.size()];
    const auto [from, to] = kept_part(p, q, cuts);
    if (!(to > from)) continue;
    length += (to - from) * std::hypot(q.x - p.x, q.z - p.z);
    if (!cloth.rest.empty()) rest += (to - from) * cloth.rest_length(p, q, loop.triangles[i]);
  }
  const double closing = closing_length(loop, cuts);
  ease.garment_girth = length + closing;
  ease.ease = *ease.garment_girth - *ease.body_girth;
  if (cloth.rest.empty() || !(length > 0)) return;
  ease.rest_girth = (length + closing) * (rest / length);  // the closing lines as the rest of the curve
  ease.rest_ease = *ease.rest_girth - *ease.body_girth;
}

FitEase ease_at(const std::string& name, double height, const Cloth& cloth, const FitBody& body) {
  FitEase ease;
  ease.name = name;
  ease.height = height;
  const auto section = geometry::torso_section(body.points, body.triangles, body.levels, height);
  if (!section) {
    ease.note = "the body has no torso at this height";
    return ease;
  }
  ease.body_girth = geometry::tape_measure(section->torso);
  const auto [x, z] = geometry::centre_of(section->torso);
  const std::vector<SectionLoop> loops = geometry::horizontal_section(cloth.points, cloth.triangles, height);
  const SectionLoop* around = nullptr;
  for (const SectionLoop& loop : loops)
    if (geometry::encloses(loop, x, z) &&
        (!around || std::abs(geometry::enclosed_area(loop)) > std::abs(geometry::enclosed_area(*around))))
      around = &loop;
  if (!around) {
    ease.note = loops.empty() ? "the garment does not reach this height"
                              : "the garment does not close around the torso at this height";
    return ease;
  }
  std::vector<Cut> cuts;
  for (const SectionLoop& other : section->others) {
    const auto [other_x, other_z] = geometry::centre_of(other);
    if (other.closed && geometry::encloses(*around, other_x, other_z) &&
        !geometry::encloses(section->torso, other_x, other_z))
      cuts.push_back(between(section->torso, other));
  }
  measure_girths(cloth, *around, cuts, ease);
  return ease;
}

}  // namespace

std::vector<FitEase> measure_ease(const geometry::Mesh& garment, const FitBody& body,
                                  const SectionHeights& heights) {
  const Cloth cloth(garment);
  std::vector<FitEase> result;
  const auto add = [&](const char* name, const std::optional<double>& height) {
    if (height) result.push_back(ease_at(name, *height, cloth, body));
  };
  add("chest", heights.chest);
  add("waist", heights.waist);
  add("hip", heights.hip);
  return result;
}

}  // namespace furrow::bridge
