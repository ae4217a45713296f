// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/mesh/face_point.h"
#include "geometry/mesh/preconditions.h"

namespace furrow::geometry {
namespace {

/// Faces reached from a seed through edges, each marked with the part's number.
std::vector<Face> flood(const Mesh& mesh, Face seed, int number, std::vector<int>& of_face) {
  std::vector<Face> faces{seed};
  of_face[seed.idx()] = number;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (Face g : mesh.faces_around_face(mesh.halfedge(faces[i]))) {
      if (!g.is_valid() || of_face[g.idx()] >= 0) continue;
      of_face[g.idx()] = number;
      faces.push_back(g);
    }
  return faces;
}

Part measure(const Mesh& mesh, const std::vector<Face>& faces, int number, std::vector<int>& of_vertex) {
  Part part;
  part.faces = faces.size();
  part.first = *std::min_element(faces.begin(), faces.end());
  Vector weighted(0, 0, 0);
  for (Face f : faces) {
    const auto v = corners_of(mesh, f);
    const Point &a = mesh.point(v[0]), &b = mesh.point(v[1]), &c = mesh.point(v[2]);
    const double area = std::sqrt(CGAL::cross_product(b - a, c - a).squared_length()) / 2;
    part.area += area;
    weighted += area * (CGAL::centroid(a, b, c) - CGAL::ORIGIN);
    for (Vertex corner : v) {
      part.vertices += of_vertex[corner.idx()] != number;
      of_vertex[corner.idx()] = number;
    }
  }
  part.centre = part.area > 0 ? CGAL::ORIGIN + weighted / part.area
                              : mesh.point(mesh.target(mesh.halfedge(part.first)));
  return part;
}

}  // namespace

Parts find_parts(const Mesh& mesh) {
  require_triangles(mesh, "find_parts");
  Parts parts;
  parts.of_face.assign(mesh.num_faces(), -1);
  parts.of_vertex.assign(mesh.num_vertices(), -1);
  std::vector<Part> found;
  for (Face seed : mesh.faces()) {
    if (parts.of_face[seed.idx()] >= 0) continue;
    const int number = int(found.size());
    found.push_back(measure(mesh, flood(mesh, seed, number, parts.of_face), number, parts.of_vertex));
  }
  std::vector<int> order(found.size()), rank(found.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return found[std::size_t(a)].area > found[std::size_t(b)].area; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    rank[std::size_t(order[i])] = int(i);
    parts.list.push_back(found[std::size_t(order[i])]);
  }
  for (std::vector<int>* numbers : {&parts.of_face, &parts.of_vertex})
    for (int& number : *numbers)
      if (number >= 0) number = rank[std::size_t(number)];
  return parts;
}

}  // namespace furrow::geometry
