// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/ends_on_cloth.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <set>

#include "geometry/figure/attached_parts.h"
#include "geometry/mesh/parts.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"

namespace furrow::geometry {
namespace {

constexpr double end_reach = 0.004;   // [m] of an end that lies on cloth
constexpr double way_along = 0.1;     // [m] along the cloth to where it lies, in the same part
constexpr double looks_alike = 0.5;   // cosine between faces that look the same way
constexpr double small_share = 0.25;  // share of another part's area up to which a part lies on it
constexpr std::size_t least_row = 3;
constexpr double turned_by = 0.5;   // of an edge, by which a border leads away
constexpr double open_seam = 1e-4;  // [m] what is nearer is a seam, which is to be joined

using EndTriangle = CGAL::Triangle_3<Point::R>;

/// Of a vertex or a face, by its index.
struct EndBox : CGAL::Box_intersection_d::Box_d<double, 3> {
  EndBox(const CGAL::Bbox_3& box, std::size_t i) : Box_d(box), index(i) {}
  std::size_t index;
};

struct EndNear {
  EndOnCloth end;
  bool beside;  ///< a border of that cloth is near, too
};

class EndFinder {
 public:
  explicit EndFinder(const Mesh& mesh)
      : mesh_(mesh),
        parts_(find_parts(mesh)),
        at_(places_as_made(mesh)),
        rides_(find_map(mesh, attribute::rides)) {}

  std::vector<EndOnCloth> find() {
    look();
    for (auto at = near_.begin(); at != near_.end();) {
      const auto end = near_.upper_bound(at->first);
      if (const EndNear one = judge(at->first, at, end);
          open_seam < one.end.distance && one.end.distance <= end_reach)
        found_.emplace(at->first, one);
      at = end;
    }
    std::vector<EndOnCloth> result;
    for (const std::vector<Vertex>& row : rows())
      if (is_end(row))
        for (const Vertex v : row) result.push_back(found_.at(v).end);
    std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
    return result;
  }

 private:
  using NearFaces = std::multimap<Vertex, Face>;

  bool may_be_tied(Face f) const { return !rides_ || (*rides_)[f] == int(Ride::none); }
  Face own_face(Vertex v) const { return mesh_.face(mesh_.opposite(border_at(v))); }
  Halfedge border_at(Vertex v) const {
    for (const Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(v)))
      if (mesh_.is_border(h)) return h;
    return Mesh::null_halfedge();
  }
  EndTriangle triangle(Face f) const {
    const Halfedge h = mesh_.halfedge(f);
    return {at_[mesh_.source(h).idx()], at_[mesh_.target(h).idx()], at_[mesh_.target(mesh_.next(h)).idx()]};
  }
  Vector normal(Face f) const {
    const EndTriangle t = triangle(f);
    const Vector n = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
    const double length = std::sqrt(n.squared_length());
    return length > 0 ? n / length : n;
  }

  std::set<Vertex> held_by_struts() const {
    std::set<Vertex> held;
    for (const Strut& s : struts(mesh_)) held.insert({s.a, s.b});
    return held;
  }

  /// Notes the faces near each vertex of a border, but for those around it.
  void look() {
    const std::set<Vertex> held = held_by_struts();
    std::vector<EndBox> ends, faces;
    for (const Vertex v : mesh_.vertices()) {
      if (mesh_.is_isolated(v) || !mesh_.is_border(v) || held.contains(v) || !may_be_tied(own_face(v)))
        continue;
      const Point& p = at_[v.idx()];
      ends.emplace_back(CGAL::Bbox_3(p.x() - end_reach, p.y() - end_reach, p.z() - end_reach,
                                     p.x() + end_reach, p.y() + end_reach, p.z() + end_reach),
                        v.idx());
    }
    for (const Face f : mesh_.faces())
      if (may_be_tied(f) && !triangle(f).is_degenerate()) faces.emplace_back(triangle(f).bbox(), f.idx());
    CGAL::box_intersection_d(ends.begin(), ends.end(), faces.begin(), faces.end(),
                             [&](const EndBox& v, const EndBox& f) {
                               note(Vertex(Vertex::size_type(v.index)), Face(Face::size_type(f.index)));
                             });
  }

  void note(Vertex v, Face f) {
    for (const Vertex corner : mesh_.vertices_around_face(mesh_.halfedge(f)))
      if (corner == v) return;
    if (may_lie_on(v, f) && CGAL::squared_distance(at_[v.idx()], triangle(f)) <= end_reach * end_reach)
      near_.emplace(v, f);
  }

  bool may_lie_on(Vertex v, Face f) const {
    const auto own = std::size_t(parts_.of_vertex[v.idx()]), other = std::size_t(parts_.of_face[f.idx()]);
    return own == other ? normal(own_face(v)) * normal(f) > looks_alike
                        : parts_.list[own].area <= small_share * parts_.list[other].area;
  }

  /// The nearest face that is far along the cloth.
  EndNear judge(Vertex v, NearFaces::const_iterator first, NearFaces::const_iterator last) const {
    EndNear best{{v, Mesh::null_face(), std::numeric_limits<double>::infinity()}, false};
    const std::set<Vertex> around = lies_beyond_rings(v, first, last) ? reached(v) : std::set<Vertex>{};
    if (around.empty()) return best;
    for (auto at = first; at != last; ++at) {
      if (is_around(at->second, around)) continue;
      best.beside = best.beside || has_border_near(v, at->second);
      const double distance = std::sqrt(CGAL::squared_distance(at_[v.idx()], triangle(at->second)));
      if (distance < best.end.distance || (distance == best.end.distance && at->second < best.end.face))
        best.end = {v, at->second, distance};
    }
    return best;
  }

  bool is_around(Face f, const std::set<Vertex>& vertices) const {
    for (const Vertex corner : mesh_.vertices_around_face(mesh_.halfedge(f)))
      if (vertices.contains(corner)) return true;
    return false;
  }

  /// Whether some are not within two rings of the vertex: most are, and need no walk.
  bool lies_beyond_rings(Vertex v, NearFaces::const_iterator first, NearFaces::const_iterator last) const {
    std::set<Vertex> rings{v};
    for (int ring = 0; ring < 2; ++ring) widen(rings);
    return std::any_of(first, last, [&](const auto& near) { return !is_around(near.second, rings); });
  }

  /// The vertices that edges lead to within that way: Dijkstra.
  std::set<Vertex> reached(Vertex from) const {
    std::map<Vertex, double> way{{from, 0}};
    using Step = std::pair<double, Vertex>;
    std::priority_queue<Step, std::vector<Step>, std::greater<>> next;
    next.push({0, from});
    std::set<Vertex> result;
    while (!next.empty()) {
      const auto [length, v] = next.top();
      next.pop();
      if (!result.insert(v).second) continue;
      for (const Vertex w : mesh_.vertices_around_target(mesh_.halfedge(v))) {
        const double there = length + std::sqrt(CGAL::squared_distance(at_[v.idx()], at_[w.idx()]));
        if (there > way_along) continue;
        const auto known = way.emplace(w, there);
        if (!known.second && known.first->second <= there) continue;
        known.first->second = there;
        next.push({there, w});
      }
    }
    return result;
  }

  bool has_border_near(Vertex v, Face f) const {
    for (const Halfedge h : mesh_.halfedges_around_face(mesh_.halfedge(f)))
      if (mesh_.is_border(mesh_.opposite(h)) &&
          CGAL::squared_distance(at_[v.idx()], CGAL::Segment_3<Point::R>(at_[mesh_.source(h).idx()],
                                                                         at_[mesh_.target(h).idx()])) <=
              end_reach * end_reach)
        return true;
    return false;
  }

  /// Longest runs along a border, in its order; a whole border begins anywhere.
  std::vector<std::vector<Vertex>> rows() const {
    std::vector<std::vector<Vertex>> result;
    std::set<Vertex> seen;
    for (const auto& entry : found_) {
      if (seen.contains(entry.first)) continue;
      Halfedge h = border_at(entry.first);
      while (found_.contains(mesh_.source(h)) && mesh_.source(h) != entry.first) h = mesh_.prev(h);
      std::vector<Vertex> row;
      for (; found_.contains(mesh_.target(h)) && seen.insert(mesh_.target(h)).second; h = mesh_.next(h))
        row.push_back(mesh_.target(h));
      result.push_back(row);
    }
    return result;
  }

  /// Sides of a slit lie beside each other, too, but at one end they meet, or go on side by side.
  bool is_end(const std::vector<Vertex>& row) const {
    if (row.size() < least_row) return false;
    const auto inside = std::count_if(row.begin(), row.end(), [&](Vertex v) { return !found_.at(v).beside; });
    return std::size_t(inside) >= least_row ||
           (turns_away(row.front(), mesh_.source(border_at(row.front()))) &&
            turns_away(row.back(), mesh_.target(mesh_.next(border_at(row.back())))));
  }

  /// Whether the border leads from a row's last vertex away from the cloth that it lies at.
  bool turns_away(Vertex last, Vertex beyond) const {
    if (found_.contains(beyond)) return true;  // a whole border
    const EndOnCloth& end = found_.at(last).end;
    const Halfedge h = mesh_.halfedge(end.face);
    std::set<Vertex> patch{mesh_.source(h), mesh_.target(h), mesh_.target(mesh_.next(h))};
    for (int ring = 0; ring < 2; ++ring) widen(patch);
    double distance = std::numeric_limits<double>::infinity();
    for (const Vertex v : patch)
      for (const Face f : mesh_.faces_around_target(mesh_.halfedge(v)))
        if (f != Mesh::null_face())
          distance = std::min(distance, std::sqrt(CGAL::squared_distance(at_[beyond.idx()], triangle(f))));
    const double edge = std::sqrt(CGAL::squared_distance(at_[last.idx()], at_[beyond.idx()]));
    return distance - end.distance > turned_by * edge;
  }

  void widen(std::set<Vertex>& patch) const {
    for (const Vertex u : std::set<Vertex>(patch))
      for (const Vertex w : mesh_.vertices_around_target(mesh_.halfedge(u))) patch.insert(w);
  }

  const Mesh& mesh_;
  const Parts parts_;
  const std::vector<Point> at_;
  const std::optional<Map<Face, int>> rides_;
  NearFaces near_;
  std::map<Vertex, EndNear> found_;
};

}  // namespace

std::vector<EndOnCloth> find_ends_on_cloth(const Mesh& mesh) { return EndFinder(mesh).find(); }

void tie_ends(Mesh& mesh, const std::vector<EndOnCloth>& ends, double stiffness) {
  if (ends.empty()) return;
  const std::vector<Point> at = places_as_made(mesh);
  std::vector<Strut> all = struts(mesh);
  for (const EndOnCloth& end : ends)
    for (const Vertex corner : mesh.vertices_around_face(mesh.halfedge(end.face))) {
      const double length = std::sqrt(CGAL::squared_distance(at[end.vertex.idx()], at[corner.idx()]));
      all.push_back({std::min(end.vertex, corner), std::max(end.vertex, corner), length, stiffness});
    }
  set_struts(mesh, all);
}

}  // namespace furrow::geometry
