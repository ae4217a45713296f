// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/mesh_file.h"

#include <algorithm>
#include <iostream>
#include <utility>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "io/base/atomic_file.h"
#include "io/base/bytes_file.h"
#include "io/base/lower_case.h"
#include "io/mesh/file_frame.h"
#include "io/mesh/material_libraries.h"
#include "io/mesh/mesh_readers.h"
#include "io/mesh/mesh_writers.h"
#include "io/mesh/soup_to_mesh.h"

namespace furrow::io {
namespace {

struct Ending {
  const char* text;
  MeshFormat format;
  bool written = true;
};
constexpr Ending endings[] = {{".obj", MeshFormat::obj},          {".ply", MeshFormat::ply},
                              {".off", MeshFormat::off},          {".stl", MeshFormat::stl},
                              {".gltf", MeshFormat::gltf, false}, {".glb", MeshFormat::gltf}};

MeshFile parse(std::string_view text, MeshFormat format, const std::string& name,
               const ReadOptions& options) {
  switch (format) {
    case MeshFormat::obj:
      return read_obj(text, name, options);
    case MeshFormat::ply:
      return read_ply(text, name, options);
    case MeshFormat::off:
      return read_off(text, name, options);
    case MeshFormat::stl:
      return read_stl(text, name, options);
    case MeshFormat::gltf:
      throw std::invalid_argument("format: glTF is read from files only, not from streams");
  }
  throw std::invalid_argument("format: there is no such format");
}

void check_file(const MeshFile& file, const WriteOptions& options) {
  check_unit(options.metres_per_unit);
  geometry::require_structure(file.mesh, "mesh");
  geometry::require_triangles(file.mesh, "mesh");
  check_positions(file.mesh, options);
}

}  // namespace

std::string mesh_formats(bool all, const std::string& last) {
  std::vector<std::string> words;
  for (const Ending& e : endings)
    if (all || e.written) words.push_back(e.text + 1);
  std::string text = words[0];
  for (std::size_t i = 1; i < words.size(); ++i) text += (i + 1 < words.size() ? ", " : last) + words[i];
  return text;
}

bool is_written_mesh(const std::string& ending) {
  return std::any_of(std::begin(endings), std::end(endings),
                     [&](const Ending& e) { return e.written && ending == e.text; });
}

MeshFormat mesh_format(const std::filesystem::path& path) {
  if (path == "-") return MeshFormat::obj;
  const std::string ending = ending_of(path);
  for (const Ending& e : endings)
    if (ending == e.text) return e.format;
  throw geometry::ContentError(
      path.string() + ": unknown format '" + ending + "'; " + mesh_formats(true, " and ") + " are read, " +
      mesh_formats(false, " and ") + " written" +
      (ending == ".fbx" || ending == ".blend" || ending == ".dae" || ending == ".usd" || ending == ".abc"
           ? "; export it as GLB or OBJ"
           : ""));
}

MeshFile read_mesh(const std::filesystem::path& path, const ReadOptions& options) {
  check_unit(options.metres_per_unit);
  if (std::filesystem::is_directory(path))
    throw geometry::ContentError(path.string() + ": is a folder; name a mesh in it");
  const MeshFormat format = mesh_format(path);
  if (path == "-") return read_mesh(std::cin, format, "standard input", options);
  if (format == MeshFormat::gltf) return read_gltf(path, options);
  MeshFile file = parse(read_text(path), format, path.string(), options);
  file.folder = folder_of(path);
  return file;
}

MeshFile read_mesh(std::istream& in, MeshFormat format, const std::string& name, const ReadOptions& options) {
  check_unit(options.metres_per_unit);
  return parse(read_text(in, name), format, name, options);
}

std::vector<std::string> write_mesh(const std::filesystem::path& path, const MeshFile& file,
                                    const WriteOptions& options) {
  if (path == "-") throw std::invalid_argument("path: '-' is standard output; write to a stream");
  MeshFormat format{};
  try {
    format = mesh_format(path);
  } catch (const geometry::ContentError& error) {
    throw std::invalid_argument(error.what());
  }
  if (ending_of(path) == ".gltf")
    throw std::invalid_argument(path.string() + ": a glTF is written as one file; let its name end in .glb");
  check_file(file, options);
  std::vector<std::string> lost;
  write_atomically(path, [&](std::ostream& out) {
    if (format == MeshFormat::obj)
      write_obj(out, file, options, folder_of(path));
    else
      lost = write_mesh(out, format, file, options);
  });
  return lost;
}

std::vector<std::string> write_mesh(std::ostream& out, MeshFormat format, const MeshFile& file,
                                    const WriteOptions& options) {
  check_file(file, options);
  switch (format) {
    case MeshFormat::obj:
      return write_obj(out, file, options), std::vector<std::string>{};
    case MeshFormat::ply:
      return write_ply(out, file, options), std::vector<std::string>{};
    case MeshFormat::off:
      return write_off(out, file, options), std::vector<std::string>{};
    case MeshFormat::stl:
      return write_stl(out, file, options), std::vector<std::string>{};
    case MeshFormat::gltf:
      return write_glb(out, file, options);
  }
  throw std::invalid_argument("format: there is no such format");
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
