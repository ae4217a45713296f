// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/repair_body.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/mesh/add_all_faces.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/self_intersections.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;  // hole filling triangulates in 3D
using ExactMesh = CGAL::Surface_mesh<Exact::Point_3>;
using Corners = std::array<Exact::Point_3, 3>;

struct Soup {
  std::vector<Exact::Point_3> points;
  std::vector<std::vector<std::size_t>> faces;
};

Soup soup_of(const Mesh& mesh) {
  Soup soup;
  std::vector<std::size_t> index(mesh.num_vertices());
  for (Vertex v : mesh.vertices()) {
    index[v.idx()] = soup.points.size();
    soup.points.emplace_back(mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z());
  }
  for (Face f : mesh.faces()) {
    soup.faces.emplace_back();
    for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) soup.faces.back().push_back(index[v.idx()]);
  }
  return soup;
}

/// Corners in their cyclic order, smallest first: equal for equally wound triangles.
Corners cyclic(Corners c) {
  std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
  return c;
}

/// Of an oriented soup without edges of three faces or vertices of two fans.
ExactMesh joined_soup(const Soup& soup) {
  ExactMesh body;
  std::vector<CornerIndices> corners;
  for (const auto& f : soup.faces) corners.push_back({f[0], f[1], f[2]});
  if (has_crowded_point(corners, soup.points.size())) {
    for (const auto& p : soup.points) body.add_vertex(p);
    if (add_all_faces(std::span<const CornerIndices>(corners), body)) return body;
    body.clear();
  }
  pmp::polygon_soup_to_polygon_mesh(soup.points, soup.faces, body);
  return body;
}

/// The parted, consistently wound and stitched mesh of a soup.
ExactMesh oriented_mesh(Soup& soup, BodyReport& report) {
  const std::size_t faces = soup.faces.size();
  std::size_t points = soup.points.size();
  pmp::repair_polygon_soup(soup.points, soup.faces);
  report.dropped_faces = faces - soup.faces.size();
  report.merged_points = points - soup.points.size();
  // A face whose three corners lie at two positions only shrinks to two points and is dropped above.
  std::erase_if(soup.faces, [](const auto& f) { return f.size() != 3; });
  if (soup.faces.empty()) throw ContentError("repair_body: no face has an area; this is no body");
  points = soup.points.size();
  pmp::orient_polygon_soup(soup.points, soup.faces);
  report.duplicated_points = soup.points.size() - points;
  ExactMesh body = joined_soup(soup);
  pmp::stitch_borders(body);
  return body;
}

std::size_t count_edges(const ExactMesh& body, ExactMesh::Halfedge_index border) {
  std::size_t n = 0;
  for (auto h : CGAL::halfedges_around_face(border, body)) n += h.is_valid();
  return n;
}

/// Fan around the mean of the hole's vertices: always possible.
std::size_t fill_by_fan(ExactMesh& body, ExactMesh::Halfedge_index border) {
  std::vector<ExactMesh::Vertex_index> ring;
  CGAL::Vector_3<Exact> sum(0, 0, 0);
  for (auto h : CGAL::halfedges_around_face(border, body)) {
    ring.push_back(body.target(h));
    sum = sum + (body.point(ring.back()) - CGAL::ORIGIN);
  }
  CGAL::Euler::fill_hole(border, body);
  const auto center = CGAL::Euler::add_center_vertex(body.halfedge(body.face(border)), body);
  body.point(body.target(center)) = CGAL::ORIGIN + sum / static_cast<double>(ring.size());
  return ring.size();
}

void fill_holes(ExactMesh& body, BodyReport& report) {
  std::vector<ExactMesh::Halfedge_index> cycles;
  pmp::extract_boundary_cycles(body, std::back_inserter(cycles));
  for (auto border : cycles) {
    physics::throw_if_cancelled("repair_body");
    std::vector<ExactMesh::Face_index> faces;
    if (count_edges(body, border) <= 1000) pmp::triangulate_hole(body, border, std::back_inserter(faces));
    report.filling_faces += faces.empty() ? fill_by_fan(body, border) : faces.size();
    ++report.filled_holes;
  }
}

/// What hangs together, with six times its volume, and that of all its faces counted as positive.
struct Component {
  std::vector<ExactMesh::Face_index> faces;
  double volume = 0, scale = 0;
};

std::vector<Component> components_of(ExactMesh& body) {
  auto component = body.add_property_map<ExactMesh::Face_index, std::size_t>("f:component", 0).first;
  std::vector<Component> components(pmp::connected_components(body, component));
  for (auto f : body.faces()) {
    std::vector<Exact::Point_3> p;
    for (auto v : body.vertices_around_face(body.halfedge(f))) p.push_back(body.point(v));
    const double part = CGAL::determinant(p[0] - CGAL::ORIGIN, p[1] - CGAL::ORIGIN, p[2] - CGAL::ORIGIN);
    Component& of = components[component[f]];
    of.faces.push_back(f);
    of.volume += part;
    of.scale += std::abs(part);
  }
  body.remove_property_map(component);
  return components;
}

void gather(const ExactMesh& mesh, Body& body) {
  std::vector<int> index(mesh.num_vertices(), 0);
  for (auto v : mesh.vertices()) {
    index[v.idx()] = static_cast<int>(body.points.size());
    body.points.emplace_back(mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z());
  }
  for (auto f : mesh.faces()) {
    std::size_t i = 0;
    body.triangles.emplace_back();
    for (auto v : mesh.vertices_around_face(mesh.halfedge(f))) body.triangles.back()[i++] = index[v.idx()];
  }
}

/// At least 1 where there are too many to count.
std::size_t intersections_of(const Body& body) {
  try {
    return count_self_intersections(body.points, body.triangles);
  } catch (const ContentError&) {
    return 1;
  }
}

/// Whether it has a volume, which is what orient_to_bound_a_volume() takes; flat ones have none.
bool has_volume(const Component& c) { return std::abs(c.volume) > 1e-12 * c.scale; }

}  // namespace

Body repair_body(const Mesh& mesh) {
  check_mesh(mesh, "repair_body");
  if (mesh.number_of_faces() == 0) throw ContentError("repair_body: the mesh has no faces");
  Body body;
  Soup soup = soup_of(mesh);
  std::set<Corners> reversed;  // of the input: what the result may not contain
  for (const auto& f : soup.faces)
    reversed.insert(cyclic({soup.points[f[0]], soup.points[f[2]], soup.points[f[1]]}));
  ExactMesh exact = oriented_mesh(soup, body.report);
  fill_holes(exact, body.report);
  body.report.closed = CGAL::is_closed(exact);

  gather(exact, body);
  body.report.self_intersections = intersections_of(body);
  const std::vector<Component> components = components_of(exact);
  body.report.components = components.size();
  if (body.report.closed && body.report.self_intersections == 0 &&
      std::ranges::all_of(components, has_volume))
    pmp::orient_to_bound_a_volume(exact);
  else
    for (const Component& c : components)
      if (c.volume < 0) pmp::reverse_face_orientations(c.faces, exact);
  body.points.clear();
  body.triangles.clear();
  gather(exact, body);

  for (auto f : exact.faces()) {
    Corners c;
    std::size_t i = 0;
    for (auto v : exact.vertices_around_face(exact.halfedge(f))) c[i++] = exact.point(v);
    body.report.reversed_faces += reversed.count(cyclic(c));
  }
  return body;
}

}  // namespace furrow::geometry
