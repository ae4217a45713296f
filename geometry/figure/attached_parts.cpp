// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/attached_parts.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"

namespace furrow::geometry {
namespace {

constexpr double reach = 0.004;      // [m] of a part that lies on cloth
constexpr double small_size = 0.06;  // [m] of a part that is stiff
constexpr double small_reach = 0.1;  // [m] of such a part: by itself it would only fall
constexpr double share_near = 0.9;   // of a part's vertices
constexpr double large = 0.25;       // share of the other cloth's area from which it is an inner side or none
constexpr double opposite = -0.5;    // cosine between faces that look away from each other
constexpr double never = std::numeric_limits<double>::infinity();

/// The face of a part that is nearest to a vertex.
struct Near {
  double squared = never;  ///< distance [m^2]
  Face face{};
};

/// Of a vertex or a face, by its index.
struct Box : CGAL::Box_intersection_d::Box_d<double, 3> {
  Box(const CGAL::Bbox_3& box, std::size_t i) : Box_d(box), index(i) {}
  std::size_t index;
};

/// Of each part.
std::vector<CGAL::Bbox_3> boxes_of(const Parts& parts, const std::vector<Point>& at) {
  std::vector<CGAL::Bbox_3> boxes(parts.list.size());
  for (std::size_t v = 0; v < at.size(); ++v)
    if (const int part = parts.of_vertex[v]; part >= 0) boxes[std::size_t(part)] += at[v].bbox();
  return boxes;
}

/// By part: at most `small_size` across, and not the largest.
std::vector<char> small_of(const std::vector<CGAL::Bbox_3>& boxes) {
  std::vector<char> small(boxes.size(), 0);
  for (std::size_t part = 1; part < boxes.size(); ++part) {
    const CGAL::Bbox_3& b = boxes[part];
    const double size = std::hypot(b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin());
    small[part] = size <= small_size;
  }
  return small;
}

class Finder {
 public:
  Finder(const Mesh& mesh, const Parts& parts, const std::vector<Ride>& chosen)
      : mesh_(mesh),
        parts_(parts),
        chosen_(chosen),
        at_(places_as_made(mesh)),
        boxes_(boxes_of(parts, at_)),
        small_(small_of(boxes_)) {
    chosen_.resize(parts.list.size(), Ride::none);
    find_amid();
    find_joined();
    look();
  }

  std::vector<AttachedPart> find() {
    std::vector<AttachedPart> found;
    std::vector<char> rides(parts_.list.size(), 0);
    const std::vector<char> nothing = rides;
    for (std::size_t part = 0; part < rides.size(); ++part) {
      AttachedPart one = as_chosen(int(part));
      if (one.ride == Ride::none && part > 0) one = judge(int(part), rides, true);
      if (one.ride == Ride::none && part > 0) one = judge(int(part), nothing, false);
      if (one.ride == Ride::none) continue;
      rides[part] = one.ride != Ride::by_itself;
      found.push_back(one);
    }
    return found;
  }

 private:
  bool is_small(int part) const { return small_[std::size_t(part)] != 0; }
  AttachedPart as_chosen(int part) const {
    const Ride ride = chosen_[std::size_t(part)];
    return {part, ride == Ride::by_place && is_small(part) ? Ride::rigid : ride, never};
  }
  double reach_of(int part) const { return is_small(part) ? small_reach : reach; }
  /// A stiff part has one place: that of its vertex nearest to the middle of its box.
  bool is_looked_at(Vertex v) const {
    const int part = parts_.of_vertex[v.idx()];
    return !is_small(part) || amid_[std::size_t(part)] == v;
  }

  void find_amid() {
    amid_.assign(parts_.list.size(), Mesh::null_vertex());
    std::vector<double> least(parts_.list.size(), never);
    for (const Vertex v : mesh_.vertices()) {
      if (parts_.of_vertex[v.idx()] < 0) continue;
      const auto part = std::size_t(parts_.of_vertex[v.idx()]);
      const CGAL::Bbox_3& b = boxes_[part];
      const Point middle((b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2, (b.zmin() + b.zmax()) / 2);
      const double squared = CGAL::squared_distance(at_[v.idx()], middle);
      if (squared < least[part]) least[part] = squared, amid_[part] = v;
    }
  }

  /// Parts that stay cloth whatever they lie on.
  void find_joined() {
    stays_.assign(parts_.list.size(), 0);
    const auto stay = [&](std::size_t v) {
      if (parts_.of_vertex[v] >= 0) stays_[std::size_t(parts_.of_vertex[v])] = 1;
    };
    for (const Strut& s : struts(mesh_))
      if (parts_.of_vertex[s.a.idx()] != parts_.of_vertex[s.b.idx()]) stay(s.a.idx()), stay(s.b.idx());
    if (const auto line = find_map(mesh_, attribute::line))
      for (const Vertex v : mesh_.vertices())
        if ((*line)[v] >= 0) stay(v.idx());
  }

  CGAL::Triangle_3<Point::R> triangle(Face f) const {
    const Halfedge h = mesh_.halfedge(f);
    return {at_[mesh_.source(h).idx()], at_[mesh_.target(h).idx()], at_[mesh_.target(mesh_.next(h)).idx()]};
  }

  /// Of each vertex that is looked at, the nearest face of each larger part within its reach.
  void look() {
    std::vector<Box> vertices, faces;
    for (const Vertex v : mesh_.vertices()) {
      const int part = parts_.of_vertex[v.idx()];
      if (part < 1 || stays_[std::size_t(part)] || !is_looked_at(v)) continue;
      const double r = reach_of(part);
      const Point& p = at_[v.idx()];
      vertices.emplace_back(CGAL::Bbox_3(p.x() - r, p.y() - r, p.z() - r, p.x() + r, p.y() + r, p.z() + r),
                            v.idx());
    }
    if (vertices.empty()) return;
    for (const Face f : mesh_.faces()) faces.emplace_back(triangle(f).bbox(), f.idx());
    CGAL::box_intersection_d(vertices.begin(), vertices.end(), faces.begin(), faces.end(),
                             [&](const Box& v, const Box& f) { note(v.index, f.index); });
  }

  void note(std::size_t v, std::size_t f) {
    const int of = parts_.of_face[f];
    if (of >= parts_.of_vertex[v] || is_small(of)) return;
    const Face face{Face::size_type(f)};
    const CGAL::Triangle_3<Point::R> t = triangle(face);
    if (t.is_degenerate()) return;
    const double squared = CGAL::squared_distance(at_[v], t);
    Near& best = near_[{v, of}];
    if (squared < best.squared || (squared == best.squared && face < best.face)) best = {squared, face};
  }

  /// The nearest face, without those of some parts.
  Near nearest(std::size_t v, const std::vector<char>& without) const {
    Near best;
    for (auto at = near_.lower_bound({v, 0}); at != near_.end() && at->first.first == v; ++at)
      if (!without[std::size_t(at->first.second)] && at->second.squared < best.squared) best = at->second;
    return best;
  }

  Vector normal(Face f) const {
    const CGAL::Triangle_3<Point::R> t = triangle(f);
    const Vector n = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
    const double length = std::sqrt(n.squared_length());
    return length > 0 ? n / length : n;
  }

  /// As it lies on other parts, without some; `sides`: it may be an inner side.
  AttachedPart judge(int part, const std::vector<char>& without, bool sides) const {
    AttachedPart result{part, Ride::none, never};
    if (stays_[std::size_t(part)]) return result;
    std::vector<double> distances;
    double carried = 0, away = 0;
    std::vector<char> carriers(parts_.list.size(), 0);
    for (const Vertex v : mesh_.vertices()) {
      if (parts_.of_vertex[v.idx()] != part || !is_looked_at(v)) continue;
      const Near near = nearest(v.idx(), without);
      distances.push_back(std::sqrt(near.squared));
      if (near.squared == never) continue;
      carriers[std::size_t(parts_.of_face[near.face.idx()])] = 1;
      const Halfedge h = mesh_.halfedge(v);
      const Face own = mesh_.face(mesh_.is_border(h) ? mesh_.opposite(h) : h);
      away += normal(own) * normal(near.face) < opposite;
    }
    for (std::size_t i = 0; i < carriers.size(); ++i)
      if (carriers[i]) carried += parts_.list[i].area;
    const bool is_large = parts_.list[std::size_t(part)].area > large * carried;
    std::sort(distances.begin(), distances.end());
    const auto counted = std::size_t(std::ceil(share_near * double(distances.size())));
    result.reach = distances[(is_large ? distances.size() : counted) - 1];
    if (!(result.reach <= reach_of(part))) return result;
    if (!is_large)
      result.ride = is_small(part) ? Ride::rigid : Ride::by_place;
    else if (sides && away >= share_near * double(distances.size()))
      result.ride = Ride::by_place;
    return result;
  }

  const Mesh& mesh_;
  const Parts& parts_;
  std::vector<Ride> chosen_;  ///< by part
  std::vector<Point> at_;
  std::vector<CGAL::Bbox_3> boxes_;  ///< by part
  std::vector<char> small_;          ///< by part
  std::vector<Vertex> amid_;         ///< by part
  std::vector<char> stays_;
  std::map<std::pair<std::size_t, int>, Near> near_;  ///< by vertex and part
};

}  // namespace

std::vector<Point> places_as_made(const Mesh& mesh) {
  const auto rest = find_map(mesh, attribute::rest_position);
  std::vector<Point> places;
  for (const Vertex v : mesh.vertices()) {
    const RestPosition at = rest ? (*rest)[v] : RestPosition{unset_value, unset_value, unset_value};
    places.push_back(std::isfinite(at[0]) ? Point(at[0], at[1], at[2]) : mesh.point(v));
  }
  return places;
}

std::vector<char> small_parts(const Mesh& mesh, const Parts& parts) {
  return small_of(boxes_of(parts, places_as_made(mesh)));
}

std::vector<AttachedPart> find_attached(const Mesh& mesh, const Parts& parts,
                                        const std::vector<Ride>& chosen) {
  return parts.list.size() < 2 ? std::vector<AttachedPart>{} : Finder(mesh, parts, chosen).find();
}

void set_rides(Mesh& mesh, const Parts& parts, const std::vector<AttachedPart>& attached) {
  if (auto old = find_map(mesh, attribute::rides)) mesh.remove_property_map(*old);
  if (attached.empty()) return;
  const auto map = ensure_map(mesh, attribute::rides);
  for (const Face f : mesh.faces())
    for (const AttachedPart& a : attached)
      if (parts.of_face[f.idx()] == a.part) map[f] = int(a.ride);
}

void free_drawn_parts(Mesh& mesh) {
  const auto line = find_map(mesh, attribute::line);
  const auto rides = find_map(mesh, attribute::rides);
  if (!line || !rides) return;
  const Parts parts = find_parts(mesh);
  std::vector<char> drawn(parts.list.size(), 0);
  for (const Vertex v : mesh.vertices())
    if (parts.of_vertex[v.idx()] >= 0 && (*line)[v] >= 0) drawn[std::size_t(parts.of_vertex[v.idx()])] = 1;
  for (const Face f : mesh.faces())
    if (drawn[std::size_t(parts.of_face[f.idx()])]) (*rides)[f] = int(Ride::none);
}

std::vector<Ride> rides_of(const Mesh& mesh) {
  const auto map = find_map(mesh, attribute::rides);
  if (!map) return {};
  std::vector<Ride> rides(mesh.num_faces(), Ride::none);
  for (const Face f : mesh.faces())
    if ((*map)[f] != int(Ride::by_itself)) rides[f.idx()] = Ride((*map)[f]);
  return rides;
}

}  // namespace furrow::geometry
