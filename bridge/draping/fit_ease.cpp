// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/fit_ease.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "bridge/arrays/convert.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/property_names.h"

namespace furrow::bridge {
namespace {

using geometry::SectionLoop;
using geometry::SectionPoint;

constexpr double trunk_step = 0.005, trunk_reach = 0.25, armhole_error = 1e-4;  // [m]
constexpr double below_armholes = 0.025;                                        // [m], where tailors measure

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
    if (!geometry::find_map(mesh, geometry::attribute::rest_length)) return;
    const std::vector<double> lengths = geometry::rest_lengths(mesh);
    for (geometry::Face f : mesh.faces()) rest.push_back(geometry::edge_lengths(mesh, f, lengths));
  }

  /// Rest length of a straight way between two points of a triangle. With u the difference of their
  /// barycentrics its square is l^2 = -(l01^2 u0 u1 + l12^2 u1 u2 + l20^2 u2 u0). (Sharp, Soliman, Crane
  /// 2019.)
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

/// What is left of curves between the cuts, with the straight lines that close it.
struct Girth {
  double length = 0;  ///< with the closing lines [m]
  double share = 1;   ///< rest length over length, of the cloth [-]
  double angle = 0;   ///< that the cloth covers, seen from the middle of the torso [rad]
  bool is_cut = false;
};

using Curves = std::vector<const SectionLoop*>;

/// Calls visit(p, q, triangle) for the pieces of a curve.
template <class Visit>
void for_each_piece(const SectionLoop& loop, const Visit& visit) {
  for (std::size_t i = 0; i < loop.triangles.size(); ++i)
    visit(loop.points[i], loop.points[(i + 1) % loop.points.size()], loop.triangles[i]);
}

/// Each cut is closed from the first to the last crossing [m].
double closing_length(const Curves& curves, const std::vector<Cut>& cuts) {
  double length = 0;
  for (const Cut& cut : cuts) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const SectionLoop* loop : curves)
      for_each_piece(*loop, [&](const SectionPoint& p, const SectionPoint& q, int) {
        const double a = cut.side(p), b = cut.side(q);
        if ((a > 0) == (b > 0)) return;
        const double s = a / (a - b), along = cut.along(p.x + s * (q.x - p.x), p.z + s * (q.z - p.z));
        low = std::min(low, along);
        high = std::max(high, along);
      });
    if (high > low) length += high - low;
  }
  return length;
}

Girth girth_of(const Cloth& cloth, const Curves& curves, const std::vector<Cut>& cuts,
               const std::array<double, 2>& middle) {
  Girth girth;
  girth.is_cut = !cuts.empty();
  double rest = 0;
  for (const SectionLoop* loop : curves)
    for_each_piece(*loop, [&](const SectionPoint& p, const SectionPoint& q, int triangle) {
      const auto [from, to] = kept_part(p, q, cuts);
      if (!(to > from)) return;
      girth.length += (to - from) * std::hypot(q.x - p.x, q.z - p.z);
      if (!cloth.rest.empty()) rest += (to - from) * cloth.rest_length(p, q, triangle);
      const double px = p.x - middle[0], pz = p.z - middle[1], qx = q.x - middle[0], qz = q.z - middle[1];
      girth.angle += (to - from) * std::atan2(px * qz - pz * qx, px * qx + pz * qz);
    });
  if (girth.length > 0) girth.share = rest / girth.length;
  girth.length += closing_length(curves, cuts);
  return girth;
}

/// Whether a border of the cloth ends on the kept side.
bool ends_inside(const SectionLoop& loop, const std::vector<Cut>& cuts) {
  const auto kept = [&](const SectionPoint& p) {
    return std::none_of(cuts.begin(), cuts.end(), [&](const Cut& cut) { return cut.side(p) > 0; });
  };
  return kept(loop.points.front()) || kept(loop.points.back());
}

/// The largest closed curve around the middle of the torso.
const SectionLoop* curve_around(const std::vector<SectionLoop>& loops, const std::array<double, 2>& middle) {
  const SectionLoop* around = nullptr;
  for (const SectionLoop& loop : loops)
    if (geometry::encloses(loop, middle[0], middle[1]) &&
        (!around || std::abs(geometry::enclosed_area(loop)) > std::abs(geometry::enclosed_area(*around))))
      around = &loop;
  return around;
}

/// Cuts between the torso and the other curves of the body, or those that `around` runs around, too.
std::vector<Cut> cuts_of(const geometry::TorsoSection& section, const SectionLoop* around) {
  std::vector<Cut> cuts;
  for (const SectionLoop& other : section.others) {
    const auto [x, z] = geometry::centre_of(other);
    if (!other.closed || geometry::encloses(section.torso, x, z)) continue;
    if (!around || geometry::encloses(*around, x, z)) cuts.push_back(between(section.torso, other));
  }
  return cuts;
}

/// The garment's girth around the torso; nothing where it does not close.
std::optional<Girth> find_girth(const Cloth& cloth, const std::vector<SectionLoop>& loops,
                                const geometry::TorsoSection& section) {
  const std::array<double, 2> middle = geometry::centre_of(section.torso);
  if (const SectionLoop* around = curve_around(loops, middle))
    return girth_of(cloth, {around}, cuts_of(section, around), middle);
  const std::vector<Cut> cuts = cuts_of(section, nullptr);
  Curves open;
  for (const SectionLoop& loop : loops)
    if (!loop.closed) open.push_back(&loop);
  for (const SectionLoop* loop : open)
    if (ends_inside(*loop, cuts)) return std::nullopt;
  const Girth girth = girth_of(cloth, open, cuts, middle);
  if (!(std::abs(girth.angle) > std::numbers::pi)) return std::nullopt;
  return girth;
}

/// The garment around the trunk alone.
struct Trunk {
  double height = 0;  ///< [m]
  Girth girth;
};

/// At a height; nothing where no closed curve runs around the torso and no other curve of the body.
std::optional<Trunk> trunk_at(const Cloth& cloth, const FitBody& body, double height) {
  const auto section = geometry::torso_section(body.points, body.triangles, body.levels, height);
  if (!section) return std::nullopt;
  const auto loops = geometry::horizontal_section(cloth.points, cloth.triangles, height);
  const std::array<double, 2> middle = geometry::centre_of(section->torso);
  const SectionLoop* around = curve_around(loops, middle);
  if (!around || !cuts_of(*section, around).empty()) return std::nullopt;
  return Trunk{height, girth_of(cloth, {around}, {}, middle)};
}

/// Below the armholes, the first of them below `height`: at the same ring of cloth wherever it hangs.
std::optional<Trunk> find_trunk(const Cloth& cloth, const FitBody& body, double height) {
  for (double below = trunk_step; below <= trunk_reach; below += trunk_step) {
    std::optional<Trunk> trunk = trunk_at(cloth, body, height - below);
    if (!trunk) continue;
    double above = trunk->height + trunk_step;  // where sleeves and trunk are one
    while (above - trunk->height > armhole_error) {
      const double middle = (above + trunk->height) / 2;
      if (auto higher = trunk_at(cloth, body, middle))
        trunk = std::move(higher);
      else
        above = middle;
    }
    const auto lower = trunk_at(cloth, body, trunk->height - below_armholes);
    return lower ? lower : trunk;
  }
  return std::nullopt;
}

/// Where the garment was measured, and what a section through its sleeves would have told.
std::string note_on_trunk(const Trunk& trunk, double height, double between_sleeves) {
  char text[160];
  std::snprintf(text, sizeof text,
                "the garment is measured around the trunk below its armholes, %.1f cm lower, as the sleeves "
                "join it here; between them it is %.1f cm around",
                100 * (height - trunk.height), 100 * between_sleeves);
  return text;
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
  const auto loops = geometry::horizontal_section(cloth.points, cloth.triangles, height);
  const std::optional<Girth> girth = find_girth(cloth, loops, *section);
  if (!girth) {
    ease.note = loops.empty() ? "the garment does not reach this height"
                              : "the garment does not close around the torso at this height";
    return ease;
  }
  const std::optional<Trunk> trunk = girth->is_cut ? find_trunk(cloth, body, height) : std::nullopt;
  if (trunk) ease.note = note_on_trunk(*trunk, height, girth->length);
  const Girth& measured = trunk ? trunk->girth : *girth;
  ease.garment_height = trunk ? trunk->height : height;
  ease.garment_girth = measured.length;
  ease.ease = measured.length - *ease.body_girth;
  if (cloth.rest.empty()) return ease;
  ease.rest_girth = measured.length * measured.share;  // the closing lines as the cloth between them
  ease.rest_ease = *ease.rest_girth - *ease.body_girth;
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
