// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insert/connect_line.h"

#include <algorithm>
#include <map>

#include "geometry/insert/flip_rules.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr double near_end = 0.2;   ///< part of a split edge below which the line goes through its end
constexpr double near_line = 0.5;  ///< in h: a line's vertex this near to the crossing is taken

class Connector {
 public:
  Connector(MeshEditor& editor, double mean_edge, const InsertionOptions& options, InsertionReport& report)
      : editor_(editor), mean_edge_(mean_edge), options_(options), report_(report) {}

  bool joined_already(Link& link) {
    if (link.from == link.to) return true;
    const auto edge = editor_.edge_between(link.from, link.to);
    if (edge) lock(*edge);
    return edge.has_value();
  }

  void join(Link& link) {
    if (joined_already(link)) return;
    const auto edge = edge_across(link);
    if (edge && !link.route) {
      const auto refusal = refusal_of_flip(editor_, *edge, options_);
      if (!refusal) {
        report_.folded_flips += folds_over(editor_, *edge);
        editor_.flip_edge(*edge);
        lock(*edge);
        ++report_.flipped;
        return;
      }
      link.refusal = refusal;
    }
    if (link.route) link.refusal = Refusal::quality;
    if (!link.refusal) link.refusal = Refusal::line_edge;  // an own flip or line edge took the edge between
    ++report_.refused_flips[*link.refusal];
    if (options_.rule == InsertionRule::paper) return;
    if (edge && !link.route && split_wanted(*edge, *link.refusal)) {
      split(link, *edge);
    } else {
      link.between = shortest_edge_path(editor_.mesh(), editor_.rest(), link.from, link.to);
      ++report_.routed;
    }
    lock_path(link);
  }

  const std::set<Edge>& fresh() const { return fresh_; }

 private:
  /// The edge whose two faces have the link's nodes as their apexes.
  std::optional<Edge> edge_across(const Link& link) const {
    const Mesh& mesh = editor_.mesh();
    for (Halfedge h : mesh.halfedges_around_target(mesh.halfedge(link.from))) {
      if (mesh.is_border(h)) continue;
      const Halfedge across = mesh.opposite(mesh.prev(h));
      if (!mesh.is_border(across) && mesh.target(mesh.next(across)) == link.to) return mesh.edge(across);
    }
    return std::nullopt;
  }

  bool split_wanted(Edge edge, Refusal refusal) const {
    return (refusal == Refusal::line_edge || refusal == Refusal::seam) && own_.count(edge) == 0;
  }

  void split(Link& link, Edge edge) {
    const Mesh& mesh = editor_.mesh();
    Halfedge h = mesh.halfedge(edge);
    if (mesh.source(h) != link.a && mesh.target(h) == link.a) h = mesh.opposite(h);
    const Vertex a = mesh.source(h), b = mesh.target(h);
    const bool stroke_crossed_it = a == link.a && b == link.b;
    const double t = stroke_crossed_it ? link.t : 0.5, length = editor_.rest()[edge];
    const double near =
        editor_.line_edge()[edge] ? std::max(near_end, near_line * mean_edge_ / length) : near_end;
    if (std::min(t, 1 - t) < near) {
      link.between = {t < 0.5 ? a : b};
      ++report_.routed;
      return;
    }
    const Vertex middle = editor_.split_edge(h, t);
    link.between = {middle};
    ++report_.inserted;
    report_.split_edges.push_back({a, b, middle});
  }

  void lock(Edge edge) {
    if (!editor_.line_edge()[edge]) fresh_.insert(edge);
    editor_.line_edge()[edge] = true;
    own_.insert(edge);
  }

  void lock_path(const Link& link) {
    Vertex last = link.from;
    for (Vertex v : link.between) lock(*editor_.edge_between(last, v)), last = v;
    lock(*editor_.edge_between(last, link.to));
  }

  MeshEditor& editor_;
  double mean_edge_;
  const InsertionOptions& options_;
  InsertionReport& report_;
  std::set<Edge> own_;    // of this line
  std::set<Edge> fresh_;  // of this line and of no earlier one
};

}  // namespace

std::set<Edge> connect_line(MeshEditor& editor, std::vector<Link>& links, double mean_edge,
                            const InsertionOptions& options, InsertionReport& report) {
  Connector connector(editor, mean_edge, options, report);
  std::vector<bool> joined(links.size(), false);
  for (std::size_t i = 0; i < links.size(); ++i) joined[i] = connector.joined_already(links[i]);
  for (std::size_t i = 0; i < links.size(); ++i) {
    physics::throw_if_cancelled("wrinkle");
    if (!joined[i]) connector.join(links[i]);
  }
  return connector.fresh();
}

std::vector<Vertex> shortest_edge_path(const Mesh& mesh, const EdgeMap<double>& rest, Vertex from,
                                       Vertex to) {
  std::map<Vertex, std::pair<double, Vertex>> best{{from, {0.0, from}}};
  std::set<std::pair<double, Vertex>> queue{{0.0, from}};
  std::set<Vertex> done;
  while (!queue.empty()) {
    physics::throw_if_cancelled("wrinkle");
    const auto [distance, v] = *queue.begin();
    queue.erase(queue.begin());
    if (v == to) break;
    if (!done.insert(v).second) continue;
    for (Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v))) {
      const Vertex w = mesh.source(h);
      const double through = distance + rest[mesh.edge(h)];
      const auto known = best.find(w);
      if (known != best.end() && known->second.first <= through) continue;
      best[w] = {through, v};
      queue.insert({through, w});
    }
  }
  std::vector<Vertex> path;
  for (Vertex v = best.at(to).second; v != from; v = best.at(v).second) path.push_back(v);
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace furrow::geometry
