// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/border_seams.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "geometry/mesh/face_point.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "geometry/rest/tie_length.h"

namespace furrow::geometry {
namespace {

constexpr double share_of_edge = 0.01;       // within it borders are beside each other
constexpr std::size_t most_of_a_slit = 3;    // edges that its sides may be beside each other
constexpr double turns_away = 0.1;           // between the directions in which two borders go on
constexpr double lies_upon = 0.985;          // cosine between faces at a seam: within 10 degrees of a fold
constexpr double single_rounding = 0x1p-21;  // of the largest coordinate: four roundings
constexpr std::size_t no_node = std::size_t(-1);

/// A place on a border from which an edge goes on: a vertex, or one of the other border amid an edge.
struct BorderNode {
  Vertex vertex;
  Halfedge border;  ///< that goes on from here, or that it lies amid
  Point place;
  double reach;  ///< within which others are beside it [m]; < 0: none
  double t = 0;  ///< along the border; 0: it is its source
  std::size_t next = no_node, previous = no_node;
};

class SeamFinder {
 public:
  SeamFinder(const Mesh& mesh, const SeamOptions& options) : mesh_(mesh), options_(options) {
    if (options.within_groups) group_ = find_map(mesh, attribute::group);
    gather();
    for (std::size_t i = 0; i < along_.size(); ++i) find_near(i);
    match();
    if (options.split && split()) match();
  }

  BorderSeams find() {
    std::vector<char> goes_on(nodes_.size(), 0);  // from another edge
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (onwards(i) != no_node) goes_on[onwards(i)] = 1;
    taken_.assign(nodes_.size(), 0);
    for (const bool closed : {false, true})  // what no open run has is in closed ones
      for (std::size_t i = 0; i < nodes_.size(); ++i)
        if (match_[i] != no_node && !taken_[i] && (closed || !goes_on[i])) take_run(i);
    BorderSeams seams{{pairs_.begin(), pairs_.end()}, {}, {}, gap_, tolerance_};
    for (const auto& [a, b] : pairs_)
      if (mesh_.point(a) != mesh_.point(b)) seams.apart.push_back(b);
    for (const auto& [place, at] : splits_) seams.splits.push_back({place.first, place.second, at});
    return seams;
  }

 private:
  Vector between(std::size_t from, std::size_t to) const { return nodes_[to].place - nodes_[from].place; }
  double distance_of(std::size_t i, std::size_t j) const { return std::sqrt(between(i, j).squared_length()); }
  Vector way(Halfedge h) const { return mesh_.point(mesh_.target(h)) - mesh_.point(mesh_.source(h)); }
  /// Along a direction that hardly a seam runs across.
  static double skew(const Point& p) { return 0.62 * p.x() + 0.53 * p.y() + 0.58 * p.z(); }

  void gather() {
    std::vector<std::size_t> of_border(mesh_.num_halfedges(), no_node);
    std::vector<char> tied(mesh_.num_vertices(), 0);
    for (const Strut& s : struts(mesh_))
      if (s.rest_length <= tie_length) tied[s.a.idx()] = tied[s.b.idx()] = 1;
    for (const Halfedge h : mesh_.halfedges()) {
      if (!mesh_.is_border(h)) continue;
      of_border[h.idx()] = nodes_.size();
      const Vertex v = mesh_.source(h);
      const Point& p = mesh_.point(v);
      const double shortest = std::min(way(h).squared_length(), way(mesh_.prev(h)).squared_length());
      along_.push_back({skew(p), nodes_.size()});
      nodes_.push_back({v, h, p, tied[v.idx()] ? -1 : share_of_edge * std::sqrt(shortest)});
      for (int k = 0; k < 3; ++k) rounding_ = std::max(rounding_, single_rounding * std::abs(p[k]));
    }
    for (BorderNode& node : nodes_) {
      node.next = of_border[mesh_.next(node.border).idx()];
      node.previous = of_border[mesh_.prev(node.border).idx()];
    }
    std::sort(along_.begin(), along_.end());
    near_.resize(nodes_.size());
  }

  template <class Visit>
  void visit(double from, double to, const Visit& visit) const {
    for (auto at = std::lower_bound(along_.begin(), along_.end(), std::pair(from, std::size_t{0}));
         at != along_.end() && at->first <= to; ++at)
      visit(at->second);
  }

  void find_near(std::size_t i) {
    near_[i].push_back(i);  // the end of a slit is of both sides
    const double at = skew(nodes_[i].place), r = nodes_[i].reach;
    visit(at - 1.01 * r, at + 1.01 * r, [&](std::size_t j) {
      if (i != j && distance_of(i, j) <= std::min(r, nodes_[j].reach)) near_[i].push_back(j);
    });
  }

  /// From an edge into its face, at a right angle.
  Vector inwards(std::size_t edge) const {
    const Halfedge border = nodes_[edge].border, inside = mesh_.next(mesh_.opposite(border));
    const Vector along = normalized(way(border)),
                 to_apex = mesh_.point(mesh_.target(inside)) - nodes_[edge].place;
    return normalized(to_apex - (to_apex * along) * along);
  }

  bool may_meet(std::size_t i, std::size_t j) const {
    const Face f = mesh_.face(mesh_.opposite(nodes_[i].border)),
               g = mesh_.face(mesh_.opposite(nodes_[j].border));
    return f != g && (!group_ || (*group_)[f] == (*group_)[g]) && inwards(i) * inwards(j) < lies_upon;
  }

  /// The edge that runs along this one the other way, both ends near; the nearest.
  std::size_t beside(std::size_t edge) const {
    std::pair best(0.0, no_node);
    for (const std::size_t end : near_[edge]) {
      const std::size_t other = nodes_[end].previous, next = nodes_[edge].next;
      const auto& there = near_[next];
      if (other == edge || std::find(there.begin(), there.end(), other) == there.end()) continue;
      const std::pair found(distance_of(edge, end) + distance_of(next, other), other);
      if ((best.second == no_node || found < best) && may_meet(edge, other)) best = found;
    }
    return best.second;
  }

  void match() {
    std::vector<std::size_t> best(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) best[i] = beside(i);
    match_.assign(nodes_.size(), no_node);
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (best[i] != no_node && best[best[i]] == i) match_[i] = best[i];
  }

  /// Puts nodes amid edges that nothing runs along; false if there are none.
  bool split() {
    for (std::size_t i = 0; i < along_.size(); ++i) {
      if (match_[i] != no_node || nodes_[i].reach < 0) continue;
      std::size_t last = i;
      const std::size_t end = nodes_[i].next;
      for (const auto& [t, of] : amid_edge(i)) {
        if (distance_of(last, of) <= nodes_[of].reach) continue;
        const Point on = nodes_[i].place + t * between(i, end);
        const std::size_t here = nodes_.size();
        nodes_.push_back({nodes_[of].vertex, nodes_[i].border, on, nodes_[of].reach, t, end, last});
        near_.push_back({of});
        near_[of].push_back(here);
        last = nodes_[last].next = here;
      }
      nodes_[end].previous = last;
    }
    return nodes_.size() > along_.size();
  }

  /// Vertices of borders that lie along an edge: t, and node.
  std::set<std::pair<double, std::size_t>> amid_edge(std::size_t edge) const {
    std::set<std::pair<double, std::size_t>> amid;
    const Point p = nodes_[edge].place, q = mesh_.point(mesh_.target(nodes_[edge].border));
    const double size = std::sqrt((q - p).squared_length()), wide = share_of_edge * size;
    const Vector along = normalized(q - p);
    const auto [low, high] = std::minmax({skew(p), skew(q)});
    visit(low - 1.01 * wide, high + 1.01 * wide, [&](std::size_t i) {
      const BorderNode& node = nodes_[i];
      const double reach = std::min(wide, node.reach), at = (node.place - p) * along;
      if (node.vertex == nodes_[edge].vertex || !(at > reach) || !(size - at > reach)) return;
      if ((node.place - p - at * along).squared_length() > reach * std::abs(reach)) return;
      amid.insert({at / size, i});
    });
    return amid;
  }

  /// The edge after this one, if the one beside it goes on with it; none at the end of a run.
  std::size_t onwards(std::size_t edge) const {
    if (match_[edge] == no_node) return no_node;
    const std::size_t next = nodes_[edge].next, other = match_[next];
    return next != match_[edge] && other != no_node && other == nodes_[match_[edge]].previous ? next
                                                                                              : no_node;
  }

  /// Whether two borders that are beside each other as far as here turn away from each other.
  bool ends(std::size_t a, std::size_t onwards_a, std::size_t b, std::size_t onwards_b) const {
    const Vector turn = normalized(between(a, onwards_a)) - normalized(between(b, onwards_b));
    return nodes_[a].vertex == nodes_[b].vertex || turn.squared_length() > turns_away * turns_away;
  }

  bool is_seam(const std::vector<std::size_t>& run, double gap) const {
    if (gap <= rounding_) return true;
    if (run.size() <= most_of_a_slit) return false;
    const std::size_t a = run.front(), z = run.back(), begin = nodes_[match_[a]].next, end = match_[z];
    return onwards(z) == a || (ends(a, nodes_[a].previous, begin, nodes_[begin].next) &&
                               ends(nodes_[z].next, nodes_[nodes_[z].next].next, end, nodes_[end].previous));
  }

  void take_run(std::size_t first) {
    std::vector<std::size_t> run;
    std::vector<std::array<std::size_t, 2>> meet;
    double gap = 0;
    bool splits = false;
    for (std::size_t i = first; i != no_node && !taken_[i]; i = onwards(i)) {
      taken_[i] = taken_[match_[i]] = 1;
      run.push_back(i);
      meet.push_back({i, nodes_[match_[i]].next});
      meet.push_back({nodes_[i].next, match_[i]});
    }
    for (const auto& [i, j] : meet) {
      gap = std::max(gap, distance_of(i, j));
      splits = splits || nodes_[i].t > 0 || nodes_[j].t > 0;
    }
    if ((gap == 0 && !splits && !options_.closed) || !is_seam(run, gap)) return;
    gap_ = std::max(gap_, gap);
    for (const auto& [a, b] : meet) {
      const BorderNode &i = nodes_[a], &j = nodes_[b];
      for (const BorderNode* k : {&i, &j})
        if (k->t > 0) splits_[{k->border, k->t}] = k->vertex;
      if (i.vertex != j.vertex) pairs_.insert({std::min(i.vertex, j.vertex), std::max(i.vertex, j.vertex)});
      if (a != b) tolerance_ = std::max(tolerance_, std::min(i.reach, j.reach));
    }
  }

  const Mesh& mesh_;
  SeamOptions options_;
  std::optional<FaceMap<int>> group_;
  std::vector<BorderNode> nodes_;                      ///< at vertices, then amid edges
  std::vector<std::pair<double, std::size_t>> along_;  ///< those at vertices, by skew()
  std::vector<std::vector<std::size_t>> near_;
  std::vector<std::size_t> match_;  ///< by the node that an edge goes on from
  std::vector<char> taken_;
  double rounding_ = 0, gap_ = 0, tolerance_ = 0;
  std::set<std::array<Vertex, 2>> pairs_;
  std::map<std::pair<Halfedge, double>, Vertex> splits_;
};

}  // namespace

BorderSeams find_border_seams(const Mesh& mesh, const SeamOptions& options) {
  require_structure(mesh, "border_seams");
  require_finite(mesh, "border_seams");
  return SeamFinder(mesh, options).find();
}

std::vector<Vertex> joined_vertices(const Mesh& mesh, const BorderSeams& seams) {
  std::vector<Vertex> joined;
  for (std::size_t i = 0; i < mesh.num_vertices(); ++i) joined.push_back(Vertex(Vertex::size_type(i)));
  const auto lowest = [&](Vertex v) {
    while (joined[v.idx()] != v) v = joined[v.idx()] = joined[joined[v.idx()].idx()];
    return v;
  };
  for (const auto& [a, b] : seams.pairs) {
    const Vertex p = lowest(a), q = lowest(b);
    joined[std::max(p, q).idx()] = std::min(p, q);
  }
  for (Vertex& v : joined) v = lowest(v);
  return joined;
}

void close_joined(Mesh& mesh) {
  const auto joined = find_map(mesh, attribute::joined);
  if (!joined) return;
  for (const Vertex v : mesh.vertices())
    if (const Vertex with{Vertex::size_type((*joined)[v])};
        (*joined)[v] >= 0 && mesh.is_isolated(v) && mesh.has_valid_index(with))
      mesh.point(v) = mesh.point(with);
}

}  // namespace furrow::geometry
