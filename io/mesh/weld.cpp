// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/weld.h"

#include "geometry/mesh/face_point.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/vertex_attributes.h"
#include "io/mesh/merge_points.h"
#include "io/mesh/mesh_readers.h"

namespace furrow::io {
namespace {

using namespace geometry;

/// Points in the order of the first vertices that lie there; returns the point of each vertex.
std::vector<std::size_t> take_points(const Mesh& mesh, PolygonSoup& soup) {
  const auto color = find_map(mesh, attribute::color);
  const auto others = vertex_attributes(mesh);
  for (const VertexAttribute& a : others) soup.attributes.push_back({a.name, {}});
  std::vector<std::size_t> point(mesh.num_vertices(), 0);
  PointNumbers numbers;
  for (Vertex v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;
    const auto [number, is_new] = numbers.number(mesh.point(v));
    point[v.idx()] = number;
    if (!is_new) continue;
    soup.points.push_back(mesh.point(v));
    if (color) soup.colors.push_back((*color)[v]);
    for (std::size_t k = 0; k < others.size(); ++k) soup.attributes[k].values.push_back(others[k].values[v]);
  }
  return point;
}

void take_faces(const Mesh& mesh, const std::vector<std::size_t>& point, PolygonSoup& soup) {
  const auto texture = find_map(mesh, attribute::texture);
  const auto group = find_map(mesh, attribute::group), material = find_map(mesh, attribute::material);
  for (Face f : mesh.faces()) {
    for (Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      soup.corners.push_back(point[mesh.target(h).idx()]);
      if (texture) soup.textures.push_back((*texture)[h]);
    }
    soup.close_face();
    if (group) soup.groups.push_back((*group)[f]);
    if (material) soup.materials.push_back((*material)[f]);
  }
}

}  // namespace

MeshFile welded(const MeshFile& file, const std::string& name) {
  require_triangles(file.mesh, "weld");
  PolygonSoup soup;
  const std::vector<std::size_t> point = take_points(file.mesh, soup);
  take_faces(file.mesh, point, soup);
  MeshFile result = file;
  result.mesh = Mesh();
  result.polylines.clear();
  result.warnings.clear();
  result.repairs = {};
  result.repairs.merged_vertices = file.mesh->number_of_vertices() - soup.points.size();
  set_mesh(result, soup, name);
  return result;
}

}  // namespace furrow::io
