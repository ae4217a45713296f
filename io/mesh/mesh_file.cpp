// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/mesh_file.h"

#include <iostream>
#include <utility>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "io/base/atomic_file.h"
#include "io/base/bytes_file.h"
#include "io/mesh/file_frame.h"
#include "io/mesh/material_libraries.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/mesh_readers.h"
#include "io/mesh/mesh_writers.h"
#include "io/mesh/soup_to_mesh.h"

namespace furrow::io {
namespace {

/// The row of the format that can be read from a text, or that can be written.
const MeshEnding& ending_for(MeshFormat format, bool to_write) {
  for (const MeshEnding& e : mesh_endings())
    if (e.format == format && (to_write ? e.write != nullptr : e.read != nullptr)) return e;
  throw std::invalid_argument(format == MeshFormat::gltf
                                  ? "format: glTF is read from files only, not from streams"
                                  : "format: there is no such format");
}

void check_file(const MeshFile& file, const WriteOptions& options) {
  check_unit(options.metres_per_unit);
  geometry::require_structure(file.mesh, "mesh");
  geometry::require_triangles(file.mesh, "mesh");
  check_positions(file.mesh, options);
}

}  // namespace

MeshFile read_mesh(const std::filesystem::path& path, const ReadOptions& options) {
  check_unit(options.metres_per_unit);
  if (std::filesystem::is_directory(path))
    throw geometry::ContentError(path.string() + ": is a folder; name a mesh in it");
  const MeshFormat format = mesh_format(path);
  if (path == "-") return read_mesh(std::cin, format, "standard input", options);
  if (format == MeshFormat::gltf) return read_gltf(path, options);
  MeshFile file = ending_for(format, false).read(read_text(path), path.string(), options);
  file.folder = folder_of(path);
  return file;
}

MeshFile read_mesh(std::istream& in, MeshFormat format, const std::string& name, const ReadOptions& options) {
  check_unit(options.metres_per_unit);
  return ending_for(format, false).read(read_text(in, name), name, options);
}

std::vector<std::string> write_mesh(const std::filesystem::path& path, const MeshFile& file,
                                    const WriteOptions& options) {
  if (path == "-") throw std::invalid_argument("path: '-' is standard output; write to a stream");
  try {
    mesh_format(path);
  } catch (const geometry::ContentError& error) {
    throw std::invalid_argument(error.what());
  }
  const MeshEnding& ending = *find_mesh_ending(path);
  if (!ending.write) throw std::invalid_argument(path.string() + ": " + ending.instead);
  check_file(file, options);
  std::vector<std::string> lost;
  write_atomically(path,
                   [&](std::ostream& out) { lost = ending.write(out, file, options, folder_of(path)); });
  return lost;
}

std::vector<std::string> write_mesh(std::ostream& out, MeshFormat format, const MeshFile& file,
                                    const WriteOptions& options) {
  check_file(file, options);
  return ending_for(format, true).write(out, file, options, {});
}

void set_mesh(MeshFile& file, const PolygonSoup& soup, const std::string& name, bool chains) {
  SoupMesh mesh = soup_to_mesh(soup, name, chains);
  mesh.repairs.merged_vertices = file.repairs.merged_vertices;
  file.mesh = std::move(mesh.mesh);
  file.repairs = mesh.repairs;
}

std::vector<std::size_t> vertex_numbers(const geometry::Mesh& mesh) {
  std::vector<std::size_t> numbers(mesh.num_vertices(), 0);
  std::size_t next = 0;
  for (const geometry::Vertex v : mesh.vertices()) numbers[v] = next++;
  return numbers;
}

void check_positions(const geometry::Mesh& mesh, const WriteOptions& options) {
  for (const geometry::Vertex v : mesh.vertices()) {
    const geometry::Vector p = to_file(mesh.point(v), options);
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(p[k]))
        throw std::invalid_argument("mesh: the position of vertex " + std::to_string(v.idx()) +
                                    " is not finite");
  }
}

}  // namespace furrow::io
