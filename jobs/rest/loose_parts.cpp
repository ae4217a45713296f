// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/loose_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <optional>

#include "bridge/arrays/convert.h"
#include "geometry/mesh/parts.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "geometry/refine/local_refinement.h"
#include "geometry/refine/subdivide.h"
#include "physics/pairs/pair_distance.h"

namespace furrow::jobs {
namespace {

using physics::Vec3;
using Corners = std::array<geometry::Vertex, 3>;

/// By part: one of the seeds lies in it.
std::vector<char> seeded(const geometry::Parts& parts, std::span<const int> seeds) {
  std::vector<char> loose(parts.list.size(), 0);
  for (const int seed : seeds)
    if (const int part = parts.of_vertex[std::size_t(seed)]; part >= 0) loose[std::size_t(part)] = 1;
  return loose;
}

Vec3 place(const geometry::Mesh& mesh, geometry::Vertex v) {
  const geometry::Point& p = mesh.point(v);
  return {p.x(), p.y(), p.z()};
}

Corners corners_of(const geometry::Mesh& mesh, geometry::Face f) {
  const geometry::Halfedge h = mesh.halfedge(f);
  return {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
}

/// Where a triangle lies, and how it is turned.
Eigen::Isometry3d frame_of(const geometry::Mesh& mesh, const Corners& t) {
  const Vec3 a = place(mesh, t[0]), b = place(mesh, t[1]), c = place(mesh, t[2]);
  const Vec3 along = (b - a).normalized(), normal = (b - a).eval().cross((c - a).eval()).normalized();
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << along, normal.cross(along), normal;
  frame.translation() = (a + b + c) / 3;
  return frame;
}

/// Of the parts that are not loose; none if all are.
std::optional<Corners> nearest_triangle(const geometry::Mesh& mesh, const geometry::Parts& parts,
                                        const std::vector<char>& loose, const Vec3& to) {
  std::optional<Corners> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const geometry::Face f : mesh.faces()) {
    if (loose[std::size_t(parts.of_face[f.idx()])]) continue;
    const Corners t = corners_of(mesh, f);
    const Vec3 a = place(mesh, t[0]), b = place(mesh, t[1]), c = place(mesh, t[2]);
    if (!((b - a).eval().cross((c - a).eval()).norm() > 0)) continue;
    const double squared = physics::vertex_triangle_distance(to, a, b, c).squared();
    if (squared < least) least = squared, nearest = t;
  }
  return nearest;
}

Vec3 middle_of(const geometry::Mesh& mesh, const geometry::Parts& parts, int part) {
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (const geometry::Vertex v : mesh.vertices())
    if (parts.of_vertex[v.idx()] == part) sum += place(mesh, v), ++count;
  return sum / count;
}

/// Marks what belongs to loose parts as removed.
void remove_marked(geometry::Mesh& mesh, const geometry::Parts& parts, const std::vector<char>& loose) {
  const auto is_loose = [&](int part) { return part >= 0 && loose[std::size_t(part)]; };
  std::vector<geometry::Edge> edges;
  for (const geometry::Edge e : mesh.edges())
    if (is_loose(parts.of_vertex[mesh.vertex(e, 0).idx()])) edges.push_back(e);
  for (std::size_t f = 0; f < parts.of_face.size(); ++f)
    if (is_loose(parts.of_face[f])) mesh.remove_face(geometry::Face(geometry::Face::size_type(f)));
  for (const geometry::Edge e : edges) mesh.remove_edge(e);
  for (std::size_t v = 0; v < parts.of_vertex.size(); ++v)
    if (is_loose(parts.of_vertex[v])) mesh.remove_vertex(geometry::Vertex(geometry::Vertex::size_type(v)));
}

/// Where vertices go as gaps are closed.
struct NewPlaces {
  std::vector<int> of_vertex;  ///< -1: it is gone
  template <class Vertices, class Halfedges, class Faces>
  void operator()(const Vertices& vertices, const Halfedges&, const Faces&) {
    for (std::size_t v = 0; v < of_vertex.size(); ++v)
      if (of_vertex[v] >= 0)
        of_vertex[v] = int(vertices[geometry::Vertex(geometry::Vertex::size_type(v))].idx());
  }
};

}  // namespace

LooseParts loose_parts_of(const io::MeshFile& given, std::span<const int> seeds) {
  const geometry::Parts parts = geometry::find_parts(given.mesh);
  const std::vector<char> loose = seeded(parts, seeds);
  LooseParts result;
  double area = 0, all = 0;
  for (std::size_t i = 0; i < parts.list.size(); ++i) {
    all += parts.list[i].area;
    if (!loose[i]) continue;
    area += parts.list[i].area;
    result.vertices += parts.list[i].vertices;
  }
  result.area_share = all > 0 ? area / all : 0;
  return result;
}

namespace {

/// Refined as the one that was draped.
geometry::Mesh refined_as(const geometry::Mesh& draped, const geometry::Mesh& given, int refinements) {
  geometry::Mesh before = given;
  if (refinements > 0) geometry::loop_subdivide(before, refinements);
  const auto index = geometry::uniform_indices(draped);
  if (!index) return before;
  geometry::Mesh local = draped;
  for (const geometry::Vertex v : local.vertices())
    local.point(v) = before.point(geometry::Vertex(geometry::Vertex::size_type((*index)[v])));
  return local;
}

}  // namespace

void carry_loose_parts(geometry::Mesh& draped, const geometry::Mesh& given, int refinements,
                       std::span<const int> seeds) {
  const geometry::Mesh before = refined_as(draped, given, refinements);
  const geometry::Parts parts = geometry::find_parts(before);
  const std::vector<char> loose = seeded(parts, seeds);
  for (std::size_t part = 0; part < loose.size(); ++part) {
    if (!loose[part]) continue;
    const auto carrier = nearest_triangle(before, parts, loose, middle_of(before, parts, int(part)));
    if (!carrier) return;
    const Eigen::Isometry3d move = frame_of(draped, *carrier) * frame_of(before, *carrier).inverse();
    for (const geometry::Vertex v : before.vertices())
      if (parts.of_vertex[v.idx()] == int(part)) draped.point(v) = bridge::to_cgal(move * place(before, v));
  }
}

void drop_parts(io::MeshFile& file, std::span<const int> seeds) {
  geometry::Mesh& mesh = file.mesh;
  const geometry::Parts parts = geometry::find_parts(mesh);
  const std::vector<char> loose = seeded(parts, seeds);
  std::vector<geometry::Strut> struts = geometry::struts(mesh);
  NewPlaces places;
  for (const int part : parts.of_vertex)
    places.of_vertex.push_back(part >= 0 && loose[std::size_t(part)] ? -1 : 0);
  remove_marked(mesh, parts, loose);
  mesh.collect_garbage(places);
  const auto gone = [&](std::size_t v) { return places.of_vertex.at(v) < 0; };
  std::erase_if(struts, [&](const geometry::Strut& s) { return gone(s.a.idx()) || gone(s.b.idx()); });
  for (geometry::Strut& s : struts)
    for (geometry::Vertex* v : {&s.a, &s.b})
      *v = geometry::Vertex(geometry::Vertex::size_type(places.of_vertex[v->idx()]));
  for (geometry::Strut& s : struts)
    if (s.b < s.a) std::swap(s.a, s.b);
  geometry::set_struts(mesh, struts);
  if (const auto joined = geometry::find_map(mesh, geometry::attribute::joined))
    for (const geometry::Vertex v : mesh.vertices())
      if (int& with = (*joined)[v]; with >= 0) with = places.of_vertex[std::size_t(with)];
  std::erase_if(file.polylines, [&](const io::Polyline& l) {
    return std::any_of(l.vertices.begin(), l.vertices.end(), gone);
  });
  for (io::Polyline& l : file.polylines)
    for (std::size_t& v : l.vertices) v = std::size_t(places.of_vertex[v]);
}

}  // namespace furrow::jobs
