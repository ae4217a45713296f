// SPDX-License-Identifier: GPL-3.0-or-later
// Checks a draped garment without any code of ours but the readers: drape_check BODY WORN GAP prints
// vertices, faces, vertices inside the body, the least distance [mm], vertices nearer than half the gap,
// faces that the body pierces, pairs of faces that cross, parts, and parts that lie nowhere near the body.
// CGAL's trees and exact predicates answer, with a brute count of pairs; for bench/drape_check_run.
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <numeric>

#include "io/mesh/mesh_file.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Face = Mesh::Face_index;
using Vertex = Mesh::Vertex_index;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Mesh read(const char* path) {
  const furrow::io::MeshFile file = furrow::io::read_mesh(path);
  Mesh mesh;
  for (const auto& p : file.mesh->points()) mesh.add_vertex({p.x(), p.y(), p.z()});
  for (const auto f : file.mesh->faces()) {
    std::vector<Vertex> v;
    for (const auto c : file.mesh->vertices_around_face(file.mesh->halfedge(f))) v.emplace_back(c.idx());
    mesh.add_face(v);
  }
  return mesh;
}

std::array<Vertex, 3> corners(const Mesh& mesh, Face f) {
  const auto h = mesh.halfedge(f);
  return {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
}

Kernel::Triangle_3 shape(const Mesh& mesh, Face f) {
  const auto v = corners(mesh, f);
  return {mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])};
}

bool share_a_place(const Mesh& mesh, Face f, Face g) {
  for (const Vertex a : corners(mesh, f))
    for (const Vertex b : corners(mesh, g))
      if (mesh.point(a) == mesh.point(b)) return true;
  return false;
}

std::size_t crossing_pairs(const Mesh& mesh) {
  const Tree tree(faces(mesh).begin(), faces(mesh).end(), mesh);
  std::size_t pairs = 0;
  for (const Face f : mesh.faces()) {
    std::vector<Face> met;
    tree.all_intersected_primitives(shape(mesh, f), std::back_inserter(met));
    for (const Face g : met) pairs += f < g && !share_a_place(mesh, f, g);
  }
  return pairs;
}

std::size_t pierced(const Mesh& garment, const Tree& body) {
  std::size_t count = 0;
  for (const Face f : garment.faces()) count += body.do_intersect(shape(garment, f));
  return count;
}

/// The part of each vertex, by faces that share one.
std::vector<std::size_t> parts_of(const Mesh& mesh) {
  std::vector<std::size_t> root(mesh.num_vertices());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const Face f : mesh.faces()) {
    const auto v = corners(mesh, f);
    for (const Vertex b : v) root[find(b.idx())] = find(v[0].idx());
  }
  for (std::size_t i = 0; i < root.size(); ++i) root[i] = find(i);
  return root;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "drape_check BODY WORN GAP\n"), 2;
  const Mesh body = read(argv[1]), garment = read(argv[2]);
  const double gap = std::atof(argv[3]);
  Tree tree(faces(body).begin(), faces(body).end(), body);
  tree.accelerate_distance_queries();
  const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side(body);
  const std::vector<std::size_t> part = parts_of(garment);
  std::map<std::size_t, double> nearest;
  std::size_t inside = 0, near = 0;
  double least = 1e300;
  for (const Vertex v : garment.vertices()) {
    if (garment.is_isolated(v)) continue;
    const Point& p = garment.point(v);
    const bool in = side(p) == CGAL::ON_BOUNDED_SIDE;
    const double distance = (in ? -1 : 1) * std::sqrt(tree.squared_distance(p));
    inside += in;
    near += distance < gap / 2;
    least = std::min(least, distance);
    const auto known = nearest.emplace(part[v.idx()], distance).first;
    known->second = std::min(known->second, distance);
  }
  std::size_t loose = 0;
  for (const auto& [name, distance] : nearest) loose += distance > 2 * gap;
  std::printf("%zu,%zu,%zu,%.2f,%zu,%zu,%zu,%zu,%zu\n", std::size_t(garment.number_of_vertices()),
              std::size_t(garment.number_of_faces()), inside, 1000 * least, near, pierced(garment, tree),
              crossing_pairs(garment), nearest.size(), loose);
}
