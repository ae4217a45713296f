// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insert/draw_line.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/insert/insert_in_faces.h"
#include "geometry/insert/restore_delaunay.h"

namespace furrow::geometry {
namespace {

constexpr double reuse = 0.5;        ///< in h: a node this near to an earlier line's vertex takes it
constexpr double least_edge = 0.25;  ///< h_min in h
constexpr int generations = 2;

bool too_small(const MeshEditor& editor, Face face, double mean_edge) {
  const auto lengths = rest_lengths_of(editor.mesh(), editor.rest(), face);
  const double h_min = least_edge * mean_edge;
  return *std::max_element(lengths.begin(), lengths.end()) < 1.5 * h_min ||
         triangle_area(lengths) < std::numbers::sqrt3 / 4 * h_min * h_min ||
         editor.generation()[face] >= generations;
}

class LineDrawing {
 public:
  LineDrawing(DrawnLine& out, const TracedStroke& traced, const LinePlan& plan, int line_id, double mean_edge,
              const InsertionOptions& options)
      : out_(out),
        report_(out.insertion.report),
        editor_(out.mesh),
        traced_(traced),
        plan_(plan),
        line_id_(line_id),
        mean_edge_(mean_edge),
        options_(options) {}

  void run() {
    choose_nodes();
    const auto rim = edges_in_flip_order(editor_.mesh(), selected(), crossed_between_new());
    for (auto& [face, point] : to_split_) split(face, point);
    make_links();
    std::vector<Link> links;
    for (const auto& entry : out_.links) links.push_back(entry.first);
    const std::set<Edge> fresh = connect_line(editor_, links, mean_edge_, options_, report_);
    for (std::size_t i = 0; i < links.size(); ++i) out_.links[i].first = links[i];
    make_chains(fresh);
    std::vector<Edge> left;
    for (Edge e : rim) {
      if (fresh.count(e) == 0) left.push_back(e);
    }
    flip_edges(editor_, left, options_, report_);
    if (options_.rule == InsertionRule::safe) report_.delaunay_flips = restore_delaunay(editor_, options_);
    note_missing_edges();
    describe_vertices();
    conclude(editor_, report_);
  }

 private:
  std::vector<Face> selected() const {
    std::vector<Face> faces;
    for (const auto& entry : to_split_) faces.push_back(entry.first);
    return faces;
  }

  const Barycentrics& node_of(const CrossedFace& visit) const {
    const auto pinned = plan_.pinned.find(visit.face);
    return pinned == plan_.pinned.end() ? visit.node : pinned->second;
  }

  /// A corner in place of a new vertex, if the safe rule wants one.
  std::optional<Vertex> corner_for(const CrossedFace& visit) {
    const Mesh& mesh = editor_.mesh();
    const auto corners = corners_of(mesh, visit.face);
    const auto away = lengths_to_corners(rest_lengths_of(mesh, editor_.rest(), visit.face), node_of(visit));
    std::optional<int> reused;
    for (int i = 0; i < 3; ++i) {
      const bool near = editor_.line()[corners[i]] >= 0 && away[i] <= reuse * mean_edge_;
      if (near && (!reused || away[i] < away[*reused])) reused = i;
    }
    if (reused) return ++report_.reused, corners[*reused];
    const auto place = plan_.places.find(visit.face);
    const bool small = too_small(editor_, visit.face, mean_edge_);
    if (!small && (place == plan_.places.end() || place->second != LinePlan::Place::corner))
      return std::nullopt;
    report_.too_small += small;
    ++report_.snapped;
    return corners[std::min_element(away.begin(), away.end()) - away.begin()];
  }

  Barycentrics place_in(const CrossedFace& visit) const {
    if (options_.rule == InsertionRule::paper) return visit.node;
    if (plan_.places.count(visit.face) == 0) return clamped(node_of(visit), options_.min_barycentric);
    return incenter(rest_lengths_of(editor_.mesh(), editor_.rest(), visit.face));
  }

  void choose_nodes() {
    std::set<Face> seen;
    for (const SubStroke& part : traced_.sub_strokes) {
      for (const CrossedFace& visit : part.faces) {
        if (!seen.insert(visit.face).second) continue;
        check_face(editor_.mesh(), editor_.rest(), visit.face);
        const auto corner = options_.rule == InsertionRule::safe ? corner_for(visit) : std::nullopt;
        if (corner) {
          nodes_[visit.face] = *corner;
          parameters_.try_emplace(*corner, visit.stroke_parameter);
        } else {
          to_split_.push_back({visit.face, place_in(visit)});
          split_parameters_[visit.face] = visit.stroke_parameter;
        }
      }
    }
  }

  /// Crossed edges with a new vertex on either side: connect_line sees to them.
  std::set<Edge> crossed_between_new() const {
    std::set<Edge> edges;
    const Mesh& mesh = editor_.mesh();
    for (const SubStroke& part : traced_.sub_strokes) {
      for (const CrossedFace& visit : part.faces) {
        if (!visit.exit || mesh.is_border(mesh.edge(visit.exit->halfedge))) continue;
        const Face next = mesh.face(mesh.opposite(visit.exit->halfedge));
        if (nodes_.count(visit.face) == 0 && nodes_.count(next) == 0)
          edges.insert(mesh.edge(visit.exit->halfedge));
      }
    }
    return edges;
  }

  void split(Face face, const Barycentrics& point) {
    normals_.insert({face, normalized(area_normal_of(editor_.mesh(), face))});
    const Vertex v = editor_.split_face({face, point});
    nodes_[face] = v;
    out_.inserted_in[v] = face;
    parameters_[v] = split_parameters_[face];
    ++report_.inserted;
  }

  void make_links() {
    // Splitting a face keeps its three edges and their halfedges.
    for (const SubStroke& part : traced_.sub_strokes) {
      const std::size_t n = part.faces.size();
      for (std::size_t i = 0; i + (part.closed ? 0 : 1) < n; ++i) {
        const EdgeCrossing& x = *part.faces[i].exit;
        const Mesh& mesh = editor_.mesh();
        const Edge edge = mesh.edge(x.halfedge);
        Link link;
        link.from = nodes_.at(part.faces[i].face);
        link.to = nodes_.at(part.faces[(i + 1) % n].face);
        link.a = mesh.source(x.halfedge);
        link.b = mesh.target(x.halfedge);
        link.t = x.t;
        link.route = plan_.routed.count(edge) > 0;
        out_.links.push_back({link, edge});
      }
    }
  }

  /// Where a stroke leaves the cloth or comes onto it, the line goes to the nearer end of the border edge
  /// there: a hem that is drawn over takes part in the wrinkle. That end is a corner of the face, so an edge
  /// leads to it.
  std::optional<Vertex> border_end(const SubStroke& part, const CrossedFace& visit,
                                   const std::optional<EdgeCrossing>& x) {
    const Mesh& mesh = editor_.mesh();
    if (options_.rule != InsertionRule::safe || part.closed || !x || !mesh.is_border(mesh.edge(x->halfedge)))
      return std::nullopt;
    const Vertex end = x->t < 0.5 ? mesh.source(x->halfedge) : mesh.target(x->halfedge);
    if (!editor_.edge_between(nodes_.at(visit.face), end)) return std::nullopt;
    parameters_.try_emplace(end, visit.stroke_parameter);
    return end;
  }

  void make_chains(const std::set<Edge>& fresh) {
    std::size_t next = 0;
    std::set<Edge> used;
    std::set<Vertex> is_node;
    for (const auto& entry : nodes_) is_node.insert(entry.second);
    for (const SubStroke& part : traced_.sub_strokes) {
      std::vector<Vertex> chain;
      const auto push = [&](Vertex v) {
        if (!chain.empty() && chain.back() == v) return;
        const std::size_t n = chain.size();
        // A way round through a corner and back again adds nothing.
        const bool spike = n >= 2 && chain[n - 2] == v && is_node.count(chain[n - 1]) == 0;
        spike ? chain.pop_back() : chain.push_back(v);
      };
      if (const auto end = border_end(part, part.faces.front(), part.faces.front().entry)) push(*end);
      push(nodes_.at(part.faces.front().face));
      for (std::size_t i = 0; i + (part.closed ? 0 : 1) < part.faces.size(); ++i, ++next) {
        for (Vertex v : out_.links[next].first.between) push(v);
        push(out_.links[next].first.to);
      }
      if (const auto end = border_end(part, part.faces.back(), part.faces.back().exit)) push(*end);
      for (std::size_t i = 1; i < chain.size(); ++i) {
        if (const auto e = editor_.edge_between(chain[i - 1], chain[i])) used.insert(*e);
      }
      for (Vertex v : chain) editor_.line()[v] = line_id_;
      out_.insertion.line.chains.push_back(std::move(chain));
    }
    for (Edge e : fresh) editor_.line_edge()[e] = false;
    for (Edge e : used) editor_.line_edge()[e] = true;
  }

  void note_missing_edges() {
    for (const auto& [link, edge] : out_.links) {
      if (!link.refusal || !link.between.empty() || editor_.edge_between(link.from, link.to)) continue;
      report_.missing_edges.push_back({link.from, link.to, *link.refusal});
    }
  }

  Vector normal_of(Vertex v) const {
    const auto inserted = out_.inserted_in.find(v);
    if (inserted != out_.inserted_in.end()) return normals_.at(inserted->second);
    const Mesh& mesh = editor_.mesh();
    Vector sum(0, 0, 0);
    for (Face f : mesh.faces_around_target(mesh.halfedge(v))) {
      if (f.is_valid()) sum = sum + area_normal_of(mesh, f);
    }
    return normalized(sum);
  }

  void describe_vertices() {
    std::set<Vertex> seen;
    for (const auto& chain : out_.insertion.line.chains) {
      double last = parameters_.at(chain.front());
      for (Vertex v : chain) {
        const auto known = parameters_.find(v);
        if (known != parameters_.end()) last = known->second;
        if (seen.insert(v).second) out_.insertion.line.vertices.push_back({v, normal_of(v), last});
      }
    }
  }

  DrawnLine& out_;
  InsertionReport& report_;
  MeshEditor editor_;
  const TracedStroke& traced_;
  const LinePlan& plan_;
  int line_id_;
  double mean_edge_;
  const InsertionOptions& options_;
  std::map<Face, Vertex> nodes_;
  std::vector<std::pair<Face, Barycentrics>> to_split_;
  std::map<Face, double> split_parameters_;
  std::map<Vertex, double> parameters_;
  std::map<Face, Vector> normals_;
};

}  // namespace

DrawnLine draw_line(const Mesh& mesh, const TracedStroke& traced, const LinePlan& plan, int line_id,
                    double mean_edge, const InsertionOptions& options) {
  DrawnLine out;
  out.mesh = mesh;
  out.insertion.line.id = line_id;
  LineDrawing(out, traced, plan, line_id, mean_edge, options).run();
  return out;
}

}  // namespace furrow::geometry
