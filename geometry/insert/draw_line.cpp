// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insert/draw_line.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/insert/insert_in_faces.h"
#include "geometry/insert/restore_delaunay.h"
#include "physics/base/cancel_scope.h"

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

/// What stays the same throughout a round.
struct Drawing {
  const TracedStroke& traced;
  const LinePlan& plan;
  int line_id;
  double mean_edge;  ///< h [m]
  const InsertionOptions& options;
};

/// A corner of a crossed face in place of a new vertex, and why.
struct CornerNode {
  Vertex vertex;
  bool is_reused = false;     ///< of an earlier line
  bool is_too_small = false;  ///< the face is too small or was split too often
};

struct NewNode {
  FacePoint point;
  double stroke_parameter;
};

/// Where the line's nodes go.
struct NodePlan {
  std::map<Face, Vertex> corners;       ///< of faces that take a corner
  std::map<Vertex, double> parameters;  ///< stroke parameters of those corners
  std::vector<NewNode> splits;          ///< the other faces, by stroke order
  std::size_t reused = 0, snapped = 0, too_small = 0;
};

/// The nodes as vertices of the mesh.
struct Nodes {
  std::map<Face, Vertex> of_face;
  std::map<Vertex, double> parameters;  ///< along the stroke, of every node
  std::map<Vertex, Face> inserted_in;   ///< new vertices
  std::map<Vertex, Vector> normals;     ///< of the faces that new vertices split
};

using Links = std::vector<Link>;

struct Chains {
  std::vector<std::vector<Vertex>> chains;     ///< one a sub-stroke
  std::map<Vertex, double> border_parameters;  ///< of border vertices that chains begin or end with
};

const Barycentrics& node_of(const LinePlan& plan, const CrossedFace& visit) {
  const auto pinned = plan.pinned.find(visit.face);
  return pinned == plan.pinned.end() ? visit.node : pinned->second;
}

/// A corner in place of a new vertex, if the safe rule wants one.
std::optional<CornerNode> corner_for(const MeshEditor& editor, const Drawing& d, const CrossedFace& visit) {
  const Mesh& mesh = editor.mesh();
  const auto corners = corners_of(mesh, visit.face);
  const auto away =
      lengths_to_corners(rest_lengths_of(mesh, editor.rest(), visit.face), node_of(d.plan, visit));
  std::optional<int> reused;
  for (int i = 0; i < 3; ++i) {
    const bool near = editor.line()[corners[i]] >= 0 && away[i] <= reuse * d.mean_edge;
    if (near && (!reused || away[i] < away[*reused])) reused = i;
  }
  if (reused) return CornerNode{corners[*reused], true};
  const auto place = d.plan.places.find(visit.face);
  const bool small = too_small(editor, visit.face, d.mean_edge);
  if (!small && (place == d.plan.places.end() || place->second != LinePlan::Place::corner))
    return std::nullopt;
  return CornerNode{corners[std::min_element(away.begin(), away.end()) - away.begin()], false, small};
}

Barycentrics place_in(const MeshEditor& editor, const Drawing& d, const CrossedFace& visit) {
  if (d.options.rule == InsertionRule::paper) return visit.node;
  if (d.plan.places.count(visit.face) == 0) return clamped(node_of(d.plan, visit), d.options.min_barycentric);
  return incenter(rest_lengths_of(editor.mesh(), editor.rest(), visit.face));
}

NodePlan choose_nodes(const MeshEditor& editor, const Drawing& d) {
  NodePlan nodes;
  std::set<Face> seen;
  for (const SubStroke& part : d.traced.sub_strokes) {
    for (const CrossedFace& visit : part.faces) {
      physics::throw_if_cancelled("wrinkle");
      if (!seen.insert(visit.face).second) continue;
      check_face(editor.mesh(), editor.rest(), visit.face);
      const auto corner = d.options.rule == InsertionRule::safe ? corner_for(editor, d, visit) : std::nullopt;
      if (!corner) {
        nodes.splits.push_back({{visit.face, place_in(editor, d, visit)}, visit.stroke_parameter});
        continue;
      }
      nodes.corners[visit.face] = corner->vertex;
      nodes.parameters.try_emplace(corner->vertex, visit.stroke_parameter);
      nodes.reused += corner->is_reused;
      nodes.snapped += !corner->is_reused;
      nodes.too_small += corner->is_too_small;
    }
  }
  return nodes;
}

/// Crossed edges with a new vertex on either side: connect_line sees to them.
std::set<Edge> crossed_between_new(const Mesh& mesh, const TracedStroke& traced, const NodePlan& nodes) {
  std::set<Edge> edges;
  for (const SubStroke& part : traced.sub_strokes) {
    for (const CrossedFace& visit : part.faces) {
      if (!visit.exit || mesh.is_border(mesh.edge(visit.exit->halfedge))) continue;
      const Face next = mesh.face(mesh.opposite(visit.exit->halfedge));
      if (nodes.corners.count(visit.face) == 0 && nodes.corners.count(next) == 0)
        edges.insert(mesh.edge(visit.exit->halfedge));
    }
  }
  return edges;
}

/// The other edges of faces that will be split, which Algorithm 2 flips.
std::vector<Edge> rim_of(const Mesh& mesh, const TracedStroke& traced, const NodePlan& nodes) {
  std::vector<Face> selected;
  for (const NewNode& node : nodes.splits) selected.push_back(node.point.face);
  return edges_in_flip_order(mesh, selected, crossed_between_new(mesh, traced, nodes));
}

Nodes split_faces(MeshEditor& editor, const NodePlan& plan) {
  Nodes nodes{plan.corners, plan.parameters, {}, {}};
  for (const NewNode& node : plan.splits) {
    physics::throw_if_cancelled("wrinkle");
    const Vector normal = normalized(area_normal_of(editor.mesh(), node.point.face));
    const Vertex v = editor.split_face(node.point);
    nodes.of_face[node.point.face] = v;
    nodes.parameters[v] = node.stroke_parameter;
    nodes.inserted_in[v] = node.point.face;
    nodes.normals.insert({v, normal});
  }
  return nodes;
}

/// Splitting a face keeps its three edges and their halfedges.
Links links_between(const Mesh& mesh, const Drawing& d, const Nodes& nodes) {
  Links links;
  for (const SubStroke& part : d.traced.sub_strokes) {
    const std::size_t n = part.faces.size();
    for (std::size_t i = 0; i + (part.closed ? 0 : 1) < n; ++i) {
      const EdgeCrossing& x = *part.faces[i].exit;
      Link link;
      link.edge = mesh.edge(x.halfedge);
      link.from = nodes.of_face.at(part.faces[i].face);
      link.to = nodes.of_face.at(part.faces[(i + 1) % n].face);
      link.a = mesh.source(x.halfedge);
      link.b = mesh.target(x.halfedge);
      link.t = x.t;
      link.route = d.plan.routed.count(link.edge) > 0;
      links.push_back(link);
    }
  }
  return links;
}

/// Where a stroke leaves the cloth or comes onto it, the line goes to the nearer end of the border edge
/// there: a hem that is drawn over takes part in the wrinkle. That end is a corner of the face, so an edge
/// leads to it.
std::optional<Vertex> border_end(const MeshEditor& editor, const Drawing& d, const Nodes& nodes,
                                 const SubStroke& part, const CrossedFace& visit,
                                 const std::optional<EdgeCrossing>& x) {
  const Mesh& mesh = editor.mesh();
  if (d.options.rule != InsertionRule::safe || part.closed || !x || !mesh.is_border(mesh.edge(x->halfedge)))
    return std::nullopt;
  const Vertex end = x->t < 0.5 ? mesh.source(x->halfedge) : mesh.target(x->halfedge);
  if (!editor.edge_between(nodes.of_face.at(visit.face), end)) return std::nullopt;
  return end;
}

/// Adds a vertex to a chain; a way round through a corner and back again adds nothing.
void push(std::vector<Vertex>& chain, Vertex v, const std::set<Vertex>& nodes) {
  if (!chain.empty() && chain.back() == v) return;
  const std::size_t n = chain.size();
  const bool spike = n >= 2 && chain[n - 2] == v && nodes.count(chain[n - 1]) == 0;
  spike ? chain.pop_back() : chain.push_back(v);
}

Chains chains_along(const MeshEditor& editor, const Drawing& d, const Nodes& nodes, const Links& links) {
  Chains result;
  std::size_t next = 0;
  std::set<Vertex> is_node;
  for (const auto& entry : nodes.of_face) is_node.insert(entry.second);
  for (const SubStroke& part : d.traced.sub_strokes) {
    const CrossedFace &first = part.faces.front(), &last = part.faces.back();
    std::vector<Vertex> chain;
    const auto push_end = [&](const CrossedFace& visit, const std::optional<EdgeCrossing>& x) {
      const auto end = border_end(editor, d, nodes, part, visit, x);
      if (!end) return;
      result.border_parameters.try_emplace(*end, visit.stroke_parameter);
      push(chain, *end, is_node);
    };
    push_end(first, first.entry);
    push(chain, nodes.of_face.at(first.face), is_node);
    for (std::size_t i = 0; i + (part.closed ? 0 : 1) < part.faces.size(); ++i, ++next) {
      for (Vertex v : links[next].between) push(chain, v, is_node);
      push(chain, links[next].to, is_node);
    }
    push_end(last, last.exit);
    result.chains.push_back(std::move(chain));
  }
  return result;
}

/// Line vertices are those of the chains, line edges those between them; of `fresh` no others stay.
void mark_line(MeshEditor& editor, const std::vector<std::vector<Vertex>>& chains, int line_id,
               const std::set<Edge>& fresh) {
  for (Edge e : fresh) editor.line_edge()[e] = false;
  for (const auto& chain : chains) {
    for (std::size_t i = 1; i < chain.size(); ++i)
      if (const auto e = editor.edge_between(chain[i - 1], chain[i])) editor.line_edge()[*e] = true;
    for (Vertex v : chain) editor.line()[v] = line_id;
  }
}

std::vector<MissingLineEdge> missing_edges(const MeshEditor& editor, const Links& links) {
  std::vector<MissingLineEdge> missing;
  for (const Link& link : links)
    if (link.refusal && link.between.empty() && !editor.edge_between(link.from, link.to))
      missing.push_back({link.from, link.to, *link.refusal});
  return missing;
}

Vector normal_of(const Mesh& mesh, const Nodes& nodes, Vertex v) {
  const auto known = nodes.normals.find(v);
  if (known != nodes.normals.end()) return known->second;
  Vector sum(0, 0, 0);
  for (Face f : mesh.faces_around_target(mesh.halfedge(v)))
    if (f.is_valid()) sum = sum + area_normal_of(mesh, f);
  return normalized(sum);
}

/// Each vertex of the chains once; one without a stroke parameter has that of the one before it.
std::vector<LineVertex> describe_vertices(const Mesh& mesh, const Nodes& nodes, const Chains& chains) {
  std::map<Vertex, double> parameters = nodes.parameters;
  parameters.insert(chains.border_parameters.begin(), chains.border_parameters.end());
  std::vector<LineVertex> vertices;
  std::set<Vertex> seen;
  for (const auto& chain : chains.chains) {
    double last = parameters.at(chain.front());
    for (Vertex v : chain) {
      const auto known = parameters.find(v);
      if (known != parameters.end()) last = known->second;
      if (seen.insert(v).second) vertices.push_back({v, normal_of(mesh, nodes, v), last});
    }
  }
  return vertices;
}

}  // namespace

DrawnLine draw_line(const Mesh& mesh, const TracedStroke& traced, const LinePlan& plan, int line_id,
                    double mean_edge, const InsertionOptions& options) {
  DrawnLine out;
  out.mesh = mesh;
  InsertionReport& report = out.insertion.report;
  const Drawing drawing{traced, plan, line_id, mean_edge, options};
  MeshEditor editor(out.mesh);
  const NodePlan chosen = choose_nodes(editor, drawing);
  report.reused = chosen.reused;
  report.snapped = chosen.snapped;
  report.too_small = chosen.too_small;
  report.inserted = chosen.splits.size();
  std::vector<Edge> rim = rim_of(editor.mesh(), traced, chosen);
  const Nodes nodes = split_faces(editor, chosen);
  out.inserted_in = nodes.inserted_in;
  out.links = links_between(editor.mesh(), drawing, nodes);
  const std::set<Edge> fresh = connect_line(editor, out.links, mean_edge, options, report);
  Chains chains = chains_along(editor, drawing, nodes, out.links);
  mark_line(editor, chains.chains, line_id, fresh);
  std::erase_if(rim, [&](Edge e) { return fresh.count(e) > 0; });
  flip_edges(editor, rim, options, report);
  if (options.rule == InsertionRule::safe) report.delaunay_flips = restore_delaunay(editor, options);
  report.missing_edges = missing_edges(editor, out.links);
  out.insertion.line = {line_id, {}, describe_vertices(editor.mesh(), nodes, chains)};
  out.insertion.line.chains = std::move(chains.chains);
  conclude(editor, report);
  return out;
}

}  // namespace furrow::geometry
