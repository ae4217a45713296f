// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insert/improve_line.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

using Place = LinePlan::Place;

double squared_distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const Vector ab = b - a;
  const double squared = ab.squared_length();
  const double t = squared > 0 ? std::clamp(((p - a) * ab) / squared, 0.0, 1.0) : 0.0;
  return CGAL::squared_distance(p, a + t * ab);
}

/// The longest rest edge of each crossed face and the faces crossed before and after it.
std::map<Face, double> longest_edges_around(const Mesh& mesh, const EdgeMap<double>& rest,
                                            const TracedStroke& traced) {
  std::map<Face, double> longest;
  for (const SubStroke& part : traced.sub_strokes) {
    const auto edge_of = [&](std::size_t i) {
      const auto lengths = rest_lengths_of(mesh, rest, part.faces[i].face);
      return *std::max_element(lengths.begin(), lengths.end());
    };
    for (std::size_t i = 0; i < part.faces.size(); ++i) {
      double& l = longest[part.faces[i].face];
      for (std::size_t j = i > 0 ? i - 1 : 0; j < std::min(i + 2, part.faces.size()); ++j)
        l = std::max(l, edge_of(j));
    }
  }
  return longest;
}

/// Moves those of a bad face's new vertices that have moved least: to the incenter, then to a corner. Whether
/// any was.
bool move_nodes(const DrawnLine& drawn, const std::vector<Vertex>& fresh, const LinePlan& plan,
                LinePlan& next) {
  const auto place_of = [&](Vertex v) {
    const auto found = plan.places.find(drawn.inserted_in.at(v));
    return found == plan.places.end() ? Place::clamped : found->second;
  };
  Place lowest = Place::corner;
  for (Vertex v : fresh) lowest = std::min(lowest, place_of(v));
  bool changed = false;
  for (Vertex v : fresh) {
    if (place_of(v) != lowest) continue;
    next.places[drawn.inserted_in.at(v)] = lowest == Place::clamped ? Place::incenter : Place::corner;
    changed = true;
  }
  return changed;
}

/// Routes the links that pass a bad face between old vertices. Whether any was not before.
bool route_links(const DrawnLine& drawn, Face face, LinePlan& next) {
  const auto corners = corners_of(drawn.mesh, face);
  const auto at_corner = [&](Vertex v) {
    return std::find(corners.begin(), corners.end(), v) != corners.end();
  };
  bool changed = false;
  for (const Link& link : drawn.links) {
    const bool here = (at_corner(link.from) && at_corner(link.to)) ||
                      std::any_of(link.between.begin(), link.between.end(), at_corner);
    if (here) changed = next.routed.insert(link.edge).second || changed;
  }
  return changed;
}

/// Moves a face's node to a sample that is too far from the line, then to the corner there. Whether it moved.
bool pin(const ProjectedSample& sample, const LinePlan& plan, LinePlan& next) {
  const Face face = sample.point.face;
  if (next.pinned.try_emplace(face, sample.point.barycentrics).second) return true;
  if (plan.pinned.count(face) == 0) return false;
  // The place in the face was still too far from the tip where the sample lies.
  const auto placed = next.places.find(face);
  const bool changed = placed == next.places.end() || placed->second != Place::corner;
  next.places[face] = Place::corner;
  return changed;
}

}  // namespace

LineDeviation deviation_of(const DrawnLine& drawn, const Mesh& before, const EdgeMap<double>& rest_before,
                           const TracedStroke& traced, double mean_edge) {
  LineDeviation deviation;
  const auto longest = longest_edges_around(before, rest_before, traced);
  for (const ProjectedSample& sample : traced.samples) {
    physics::throw_if_cancelled("wrinkle");
    double squared = std::numeric_limits<double>::infinity();
    for (const auto& chain : drawn.insertion.line.chains) {
      for (std::size_t i = 0; i < chain.size(); ++i) {
        const Point &a = drawn.mesh.point(chain[i == 0 ? 0 : i - 1]), &b = drawn.mesh.point(chain[i]);
        squared = std::min(squared, squared_distance_to_segment(sample.position, a, b));
      }
    }
    const double distance = std::sqrt(squared);
    deviation.largest = std::max(deviation.largest, distance);
    if (distance > 0.5 * std::max(mean_edge, longest.at(sample.point.face)))
      deviation.samples.push_back(sample);
  }
  return deviation;
}

double smallest_angle_around(const Mesh& mesh, const EdgeMap<double>& rest, const TracedStroke& traced) {
  std::set<Face> faces;
  for (const SubStroke& part : traced.sub_strokes) {
    for (const CrossedFace& visit : part.faces) {
      faces.insert(visit.face);
      for (Halfedge h : halfedges_of(mesh, visit.face)) {
        if (!mesh.is_border(mesh.opposite(h))) faces.insert(mesh.face(mesh.opposite(h)));
      }
    }
  }
  double least = std::numbers::pi;
  for (Face f : faces) least = std::min(least, smallest_angle(rest_lengths_of(mesh, rest, f)));
  return least;
}

bool improve_plan(const DrawnLine& drawn, const LineDeviation& deviation, double least_angle,
                  LinePlan& plan) {
  const auto rest = *find_map(drawn.mesh, attribute::rest_length);
  LinePlan next = plan;
  bool changed = false;
  for (Face face : drawn.insertion.report.changed_faces) {
    if (smallest_angle(rest_lengths_of(drawn.mesh, rest, face)) >= least_angle) continue;
    std::vector<Vertex> fresh;
    for (Vertex v : corners_of(drawn.mesh, face))
      if (drawn.inserted_in.count(v) > 0) fresh.push_back(v);
    const bool here = fresh.empty() ? route_links(drawn, face, next) : move_nodes(drawn, fresh, plan, next);
    changed = here || changed;
  }
  for (const ProjectedSample& sample : deviation.samples) changed = pin(sample, plan, next) || changed;
  plan = std::move(next);
  return changed;
}

}  // namespace furrow::geometry
