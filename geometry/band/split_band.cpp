// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/split_band.h"

#include <algorithm>
#include <queue>

namespace furrow::geometry {
namespace {

constexpr double too_long = 1.33;     ///< of the sizing
constexpr double longer_side = 1.25;  ///< of an edge: such a side is split before it

/// An edge that is to be split. Lengths are rounded to float, so that rounding does not decide between equal
/// ones: vertices do.
struct Waiting {
  float length;
  Vertex a, b;  // a < b
  bool operator<(const Waiting& other) const {
    if (length != other.length) return length < other.length;
    return std::pair(other.a, other.b) < std::pair(a, b);
  }
};

Point centre_of(const Mesh& mesh, Face f) {
  const auto c = corners_of(mesh, f);
  return CGAL::centroid(mesh.point(c[0]), mesh.point(c[1]), mesh.point(c[2]));
}

class Splitter {
 public:
  Splitter(BandMesh& band, const BandSizing& sizing) : band_(band), mesh_(band.mesh), sizing_(sizing) {}

  std::size_t run() {
    std::vector<Edge> edges;
    for (Edge e : mesh_.edges()) push(e);
    std::size_t count = 0;
    while (!queue_.empty()) {
      const Waiting next = queue_.top();
      queue_.pop();
      const auto e = band_.editor.edge_between(next.a, next.b);
      if (!e || next.length != static_cast<float>(band_.rest[*e])) continue;
      split(longest_near(*e));
      ++count;
      if (const auto still = band_.editor.edge_between(next.a, next.b)) push(*still);
    }
    return count;
  }

 private:
  bool in_band(Edge e) const {
    for (Halfedge h : {mesh_.halfedge(e), mesh_.opposite(mesh_.halfedge(e))})
      if (!mesh_.is_border(h) && band_.in_band[mesh_.face(h).idx()]) return true;
    return false;
  }

  void push(Edge e) {
    if (!in_band(e)) return;
    const Halfedge h = band_.from_lower(e);
    const Vertex a = mesh_.source(h), b = mesh_.target(h);
    const double most = band_.rest[e] / too_long;
    if (sizing_.at(CGAL::midpoint(mesh_.point(a), mesh_.point(b)), most) < most)
      queue_.push({static_cast<float>(band_.rest[e]), a, b});
  }

  /// From sides to longer sides, until none is much longer.
  Edge longest_near(Edge e) const {
    while (true) {
      Edge longest = e;
      const Halfedge h = band_.from_lower(e);
      for (Halfedge side : {h, mesh_.opposite(h)}) {
        if (mesh_.is_border(side)) continue;
        for (Halfedge s : {mesh_.next(side), mesh_.prev(side)})
          if (band_.rest[mesh_.edge(s)] > longer_side * band_.rest[longest]) longest = mesh_.edge(s);
      }
      if (longest == e) return e;
      e = longest;
    }
  }

  void split(Edge e) {
    const Vertex v = band_.split(e, 0.5);
    for (Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(v))) {
      push(mesh_.edge(h));
      if (band_.moved[v.idx()] && !mesh_.is_border(h)) push(mesh_.edge(mesh_.prev(mesh_.prev(h))));
    }
  }

  BandMesh& band_;
  const Mesh& mesh_;
  const BandSizing& sizing_;
  std::priority_queue<Waiting> queue_;
};

}  // namespace

std::vector<bool> band_faces(const Mesh& mesh, const EdgeMap<double>& rest, std::span<const FoldCurve> curves,
                             const BandSizing& sizing) {
  std::vector<bool> inside(mesh.num_faces(), false);
  std::vector<Face> queue;
  const auto add = [&](Face f) {
    if (!f.is_valid() || inside[f.idx()]) return;
    inside[f.idx()] = true;
    queue.push_back(f);
  };
  for (const FoldCurve& curve : curves)
    for (const FacePoint& p : curve.places) add(p.face);
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const auto lengths = rest_lengths_of(mesh, rest, queue[next]);
    const double longest = *std::max_element(lengths.begin(), lengths.end());
    const Point centre = centre_of(mesh, queue[next]);
    if (!(sizing.at(centre, longest) < longest) && !sizing.in_band(centre)) continue;
    for (Halfedge h : halfedges_of(mesh, queue[next]))
      if (!mesh.is_border(mesh.opposite(h))) add(mesh.face(mesh.opposite(h)));
  }
  return inside;
}

std::size_t split_band(BandMesh& band, const BandSizing& sizing) { return Splitter(band, sizing).run(); }

}  // namespace furrow::geometry
