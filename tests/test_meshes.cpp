// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/test_meshes.h"

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <sstream>
#include <stdexcept>

namespace furrow::tests {

using geometry::Face;
using geometry::Mesh;
using geometry::Point;
using geometry::Vertex;
using std::numbers::pi;

namespace {

Vertex at(int i) { return Vertex(static_cast<Vertex::size_type>(i)); }

void add_face(Mesh& mesh, Vertex a, Vertex b, Vertex c) {
  if (mesh.add_face(a, b, c) == Mesh::null_face()) throw std::logic_error("test mesh: a face is refused");
}

template <class OtherDiagonal>
Mesh cells(int nx, int ny, double width, double height, const OtherDiagonal& other_diagonal) {
  std::vector<Point> points;
  std::vector<std::array<int, 3>> faces;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) points.emplace_back(width * i / nx, height * j / ny, 0);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = i + j * (nx + 1), b = a + 1, c = b + nx + 1, d = a + nx + 1;
      if (other_diagonal(i, j))
        faces.insert(faces.end(), {{a, b, d}, {b, c, d}});
      else
        faces.insert(faces.end(), {{a, b, c}, {a, c, d}});
    }
  return mesh_of(points, faces);
}

}  // namespace

Mesh mesh_of(const std::vector<Point>& points, const std::vector<std::array<int, 3>>& faces) {
  Mesh mesh;
  for (const Point& p : points) mesh.add_vertex(p);
  for (const auto& f : faces) add_face(mesh, at(f[0]), at(f[1]), at(f[2]));
  return mesh;
}

Mesh single_triangle() { return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}); }

Mesh grid(int nx, int ny, double width, double height) {
  return cells(nx, ny, width, height, [](int, int) { return false; });
}

Mesh union_jack(int nx, int ny, double width, double height) {
  return cells(nx, ny, width, height, [](int i, int j) { return (i + j) % 2 == 1; });
}

Mesh jittered(int nx, int ny, double amount, unsigned seed, double width, double height) {
  Mesh mesh = grid(nx, ny, width, height);
  std::mt19937 engine(seed);
  const auto uniform = [&] { return 2.0 * engine() / static_cast<double>(std::mt19937::max()) - 1; };
  for (Vertex v : mesh.vertices()) {
    const double dx = amount * uniform() * width / nx, dy = amount * uniform() * height / ny;
    if (!mesh.is_border(v)) mesh.point(v) = {mesh.point(v).x() + dx, mesh.point(v).y() + dy, 0};
  }
  return mesh;
}

Mesh cylinder(double radius, double height, int around, int up) {
  std::vector<Point> points;
  std::vector<std::array<int, 3>> faces;
  for (int j = 0; j <= up; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * pi * i / around;
      points.emplace_back(radius * std::sin(angle), height * j / up, radius * std::cos(angle));
    }
  for (int j = 0; j < up; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = i + j * around, b = (i + 1) % around + j * around, c = b + around, d = a + around;
      faces.insert(faces.end(), {{a, b, c}, {a, c, d}});
    }
  return mesh_of(points, faces);
}

Mesh icosphere(int levels, double radius, const Point& center) {
  const double g = std::numbers::phi;
  std::vector<Point> points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                               {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<std::array<int, 3>> faces = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                           {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                           {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                           {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middle;
    const auto between = [&](int a, int b) {
      const auto [entry, is_new] = middle.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (is_new)
        points.push_back(
            CGAL::midpoint(points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)]));
      return entry->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    faces = finer;
  }
  for (Point& p : points) {
    const geometry::Vector v = p - CGAL::ORIGIN;
    p = center + radius / std::sqrt(v.squared_length()) * v;
  }
  return mesh_of(points, faces);
}

Mesh torus_lattice(int n, int m, double major, double minor) {
  std::vector<Point> points;
  std::vector<std::array<int, 3>> faces;
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const double u = 2 * pi * i / n, v = 2 * pi * j / m, ring = major + minor * std::cos(v);
      points.emplace_back(ring * std::sin(u), minor * std::sin(v), ring * std::cos(u));
    }
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const int i1 = (i + 1) % n, j1 = (j + 1) % m;
      const int a = i + j * n, b = i1 + j * n, c = i1 + j1 * n, d = i + j1 * n;
      faces.insert(faces.end(), {{a, b, c}, {a, c, d}});
    }
  return mesh_of(points, faces);
}

Mesh cube() {
  std::vector<Point> points;
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  return mesh_of(points, {{0, 2, 3},
                          {0, 3, 1},
                          {4, 5, 7},
                          {4, 7, 6},
                          {0, 1, 5},
                          {0, 5, 4},
                          {2, 6, 7},
                          {2, 7, 3},
                          {0, 4, 6},
                          {0, 6, 2},
                          {1, 3, 7},
                          {1, 7, 5}});
}

void append(Mesh& mesh, const Mesh& part) {
  std::vector<Vertex> index;
  for (Vertex v : part.vertices()) index.push_back(mesh.add_vertex(part.point(v)));
  for (Face f : part.faces()) {
    std::vector<Vertex> corners;
    for (Vertex v : part.vertices_around_face(part.halfedge(f))) corners.push_back(index[v.idx()]);
    add_face(mesh, corners[0], corners[1], corners[2]);
  }
}

Mesh read_plain_obj(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  Mesh mesh;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    double x, y, z;
    if (word == "v" && words >> x >> y >> z) mesh.add_vertex({x, y, z});
    if (word != "f") continue;
    std::vector<Vertex> corners;
    while (words >> word) corners.push_back(at(std::stoi(word) - 1));  // stoi stops at the slash
    for (std::size_t i = 2; i < corners.size(); ++i) add_face(mesh, corners[0], corners[i - 1], corners[i]);
  }
  return mesh;
}

}  // namespace furrow::tests
