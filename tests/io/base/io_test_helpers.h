// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CGAL/boost/graph/helpers.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "io/mesh/mesh_file.h"

namespace furrow::tests {

inline io::MeshFile read_from(const std::string& text, io::MeshFormat format,
                              const io::ReadOptions& options = {}) {
  std::istringstream in(text);
  return io::read_mesh(in, format, "test", options);
}

inline std::string written(const io::MeshFile& file, io::MeshFormat format,
                           const io::WriteOptions& options = {}) {
  std::ostringstream out;
  io::write_mesh(out, format, file, options);
  return out.str();
}

/// The message of the ContentError that `act` throws; "(none)" if it throws none.
inline std::string content_error(const std::function<void()>& act) {
  try {
    act();
  } catch (const geometry::ContentError& error) {
    return error.what();
  }
  return "(none)";
}

/// A folder that is gone after the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "furrow-io-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline void spit(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}
inline std::string slurp(const std::filesystem::path& path) {
  std::ostringstream out;
  out << std::ifstream(path, std::ios::binary).rdbuf();
  return out.str();
}

/// Equal down to the bits; any two NaN are equal.
inline bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b); }

/// Bumpy n by n grid of quads cut in two, with every map of property_names.h set to values of many digits.
inline io::MeshFile decorated_grid(int n) {
  using namespace geometry;
  io::MeshFile file;
  Mesh& mesh = file.mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.add_vertex(Point(i / 3.0, std::sin(i + 2.0 * j) / 7, -j / 7.0));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto v = [&](int a, int b) {
        return Vertex(static_cast<Mesh::size_type>((j + b) * (n + 1) + i + a));
      };
      mesh.add_face(v(0, 0), v(1, 0), v(1, 1));
      mesh.add_face(v(0, 0), v(1, 1), v(0, 1));
    }
  const auto third = [](auto index) { return 1 / (3.0 + static_cast<double>(std::size_t(index))); };
  auto color = ensure_map(mesh, attribute::color);
  auto line = ensure_map(mesh, attribute::line);
  auto mass = ensure_map(mesh, attribute::mass);
  for (const Vertex v : mesh.vertices()) {
    color[v] = {third(v), 2 * third(v), 0.5, 1};
    line[v] = static_cast<int>(std::size_t(v)) % 4 - 1;
    mass[v] = v == Vertex(1) ? unset_value : third(v);
  }
  auto rest = ensure_map(mesh, attribute::rest_length),
       bending = ensure_map(mesh, attribute::bending_rest_length);
  auto count = ensure_map(mesh, attribute::bending_count);
  auto line_edge = ensure_map(mesh, attribute::line_edge);
  for (const Edge e : mesh.edges()) {
    rest[e] = third(e) + 1;
    if (!mesh.is_border(e)) bending[e] = third(e), count[e] = 1 + static_cast<int>(std::size_t(e)) % 2;
    line_edge[e] = std::size_t(e) % 5 == 0;
    ensure_map(mesh, attribute::diagonal)[e] = std::size_t(e) % 3 == 1;
    for (const auto* name : {&attribute::stiffness, &attribute::bending_stiffness,
                             &attribute::hinge_stiffness, &attribute::tension, &attribute::rest_angle})
      ensure_map(mesh, *name)[e] = std::size_t(e) % 7 == 2 ? unset_value : third(e);
  }
  auto own = ensure_map(mesh, attribute::triangle_rest_length);
  for (const Halfedge h : mesh.halfedges())
    if (!mesh.is_border(h)) own[h] = std::size_t(mesh.face(h)) % 4 == 3 ? unset_value : third(h) + 2;
  const Vertex last(static_cast<Mesh::size_type>(mesh.number_of_vertices() - 1));
  set_struts(mesh,
             std::vector<Strut>{{Vertex(1), last, third(5), 0.1}, {Vertex(0), last, 1 / 7.0, third(1)}});
  auto texture = ensure_map(mesh, attribute::texture);
  auto group = ensure_map(mesh, attribute::group), material = ensure_map(mesh, attribute::material);
  for (const Face f : mesh.faces()) {
    group[f] = static_cast<int>(std::size_t(f)) % 3 - 1;
    material[f] = static_cast<int>(std::size_t(f)) % 2;
    for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
      texture[h] = {third(h), std::size_t(f) == 3 ? unset_value : 1 - third(h)};
  }
  file.group_names = {"left sleeve", "front"};
  file.material_names = {"cotton", "silk"};
  file.comments = {"r_avg 0.031", "unit m"};
  return file;
}

/// The corners of every face, from the first, as numbers.
inline std::vector<std::size_t> corners_of(const geometry::Mesh& mesh) {
  std::vector<std::size_t> corners;
  for (const geometry::Face f : mesh.faces())
    for (const geometry::Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) corners.push_back(v);
  return corners;
}

inline bool same_positions(const geometry::Mesh& a, const geometry::Mesh& b) {
  if (a.number_of_vertices() != b.number_of_vertices()) return false;
  for (const geometry::Vertex v : a.vertices())
    for (int k = 0; k < 3; ++k)
      if (!same_bits(a.point(v)[k], b.point(v)[k])) return false;
  return true;
}

inline const std::string cube_obj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

}  // namespace furrow::tests
