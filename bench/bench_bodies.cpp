// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/bench_bodies.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>

#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>

namespace furrow::bench {

using physics::TriangleMesh;
using physics::Vec3;

namespace {

constexpr int icosahedron[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};

/// Flat icosahedron whose faces are cut into frequency^2 triangles.
struct Geodesic {
  int n;
  TriangleMesh mesh;
  std::map<std::pair<int, int>, int> first_on_edge;

  explicit Geodesic(int frequency) : n(frequency) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    for (int axis : {1, 2, 0})  // the long side of each of the three golden rectangles
      for (int i = 0; i < 4; ++i) {
        Vec3 p(0, 0, 0);
        p[axis] = i & 2 ? -g : g;
        p[(axis + 2) % 3] = i & 1 ? 1 : -1;
        if (axis == 0) p = {i & 2 ? -g : g, 0, i & 1 ? 1.0 : -1.0};
        mesh.vertices.push_back(p);
      }
    for (const auto& f : icosahedron) cut(f);
  }

  /// The k-th of n steps from corner a to corner b.
  int on_edge(int a, int b, int k) {
    if (k == 0 || k == n) return k == 0 ? a : b;
    if (a > b) return on_edge(b, a, n - k);
    const auto [at, added] = first_on_edge.try_emplace({a, b}, static_cast<int>(mesh.vertices.size()));
    for (int i = 1; added && i < n; ++i) {
      const double s = static_cast<double>(i) / n;
      mesh.vertices.push_back(mesh.vertices[a] * (1 - s) + mesh.vertices[b] * s);
    }
    return at->second + k - 1;
  }

  void cut(const int (&f)[3]) {
    std::vector<int> above, row;
    for (int r = 0; r <= n; ++r, above.swap(row)) {
      row.clear();
      for (int c = 0; c <= r; ++c) row.push_back(vertex(f, r, c));
      for (int c = 0; c + 1 <= r; ++c) {
        mesh.triangles.push_back({above[c], row[c], row[c + 1]});
        if (c + 1 < r) mesh.triangles.push_back({above[c], row[c + 1], above[c + 1]});
      }
    }
  }

  int vertex(const int (&f)[3], int r, int c) {
    if (c == 0) return on_edge(f[0], f[1], r);
    if (c == r) return on_edge(f[0], f[2], r);
    if (r == n) return on_edge(f[1], f[2], c);
    const double w0 = 1.0 - static_cast<double>(r) / n, w2 = static_cast<double>(c) / n;
    const auto& v = mesh.vertices;
    mesh.vertices.push_back(w0 * v[f[0]] + (1 - w0 - w2) * v[f[1]] + w2 * v[f[2]]);
    return static_cast<int>(mesh.vertices.size()) - 1;
  }
};

}  // namespace

TriangleMesh noisy_sphere(int frequency) {
  TriangleMesh mesh = Geodesic(frequency).mesh;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-1, 1);
  for (Vec3& x : mesh.vertices) {
    const Vec3 n = x.normalized();
    const double bumps = 0.1 * std::sin(5 * n[0]) * std::cos(4 * n[1] + 1) * std::sin(6 * n[2]);
    x = (1 + bumps + 0.3 * (1.1 / frequency) * noise(random)) * n;
  }
  return mesh;
}

TriangleMesh read_obj(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path);
  TriangleMesh mesh;
  for (std::string line, word; std::getline(in, line);) {
    std::istringstream words(line);
    words >> word;
    if (word == "v") {
      Vec3 x;
      words >> x[0] >> x[1] >> x[2];
      mesh.vertices.push_back(x);
    } else if (word == "f") {
      std::vector<int> f;
      while (words >> word) f.push_back(std::stoi(word) - 1);
      for (std::size_t i = 2; i < f.size(); ++i) mesh.triangles.push_back({f[0], f[i - 1], f[i]});
    }
  }
  return mesh;
}

TriangleMesh loop_once(const TriangleMesh& mesh) {
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  CGAL::Surface_mesh<Point> cgal;
  using Vertex = CGAL::Surface_mesh<Point>::Vertex_index;
  for (const Vec3& x : mesh.vertices) cgal.add_vertex(Point(x[0], x[1], x[2]));
  for (const auto& [a, b, c] : mesh.triangles)
    if (cgal.add_face(Vertex(a), Vertex(b), Vertex(c)) == cgal.null_face())
      throw std::runtime_error("the body is not a manifold; it cannot be subdivided");
  CGAL::Subdivision_method_3::Loop_subdivision(cgal, CGAL::parameters::number_of_iterations(1));
  TriangleMesh result;
  for (Vertex v : cgal.vertices())
    result.vertices.emplace_back(cgal.point(v).x(), cgal.point(v).y(), cgal.point(v).z());
  for (auto f : cgal.faces()) {
    std::array<int, 3> t;
    int k = 0;
    for (Vertex v : cgal.vertices_around_face(cgal.halfedge(f))) t[k++] = static_cast<int>(v.idx());
    result.triangles.push_back(t);
  }
  return result;
}

}  // namespace furrow::bench
