// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace furrow::io {

/// What a reader had to do to a file's content to get an oriented manifold of triangles. Zero where nothing was.
struct RepairReport {
  std::size_t triangulated_faces = 0;    ///< faces with more than three corners, cut
  std::size_t degenerate_faces = 0;      ///< dropped: a repeated corner
  std::size_t duplicate_faces = 0;       ///< dropped
  std::size_t reversed_faces = 0;        ///< turned to agree with their neighbours
  std::size_t duplicated_vertices = 0;   ///< appended at the end, to part non-manifold edges and vertices
  std::size_t isolated_vertices = 0;     ///< kept
  std::size_t merged_vertices = 0;       ///< only where the format shares none (STL)
  bool any() const {
    return degenerate_faces || duplicate_faces || reversed_faces || duplicated_vertices || merged_vertices;
  }
};

/// A mesh and what its file says beside it. Vertices are in the file's order; positions in metres, y up.
struct MeshFile {
  geometry::Mesh mesh;                                      ///< maps as in geometry/property_names.h
  std::vector<std::string> group_names;                     ///< f:group
  std::vector<std::string> material_names;                  ///< f:material
  std::vector<std::string> material_libraries;              ///< OBJ mtllib
  std::vector<std::vector<geometry::Point>> polylines;      ///< OBJ l elements, chained [m]
  std::vector<std::string> comments;                        ///< without the comment mark; PLY and OBJ
  std::vector<std::string> warnings;                        ///< e.g. "single precision, vertex order not kept"
  RepairReport repairs;
};

/// The axis of a file that points up; we work with y up.
enum class Axis { y, z };

struct ReadOptions {
  double metres_per_unit = 1;  ///< > 0
  Axis up = Axis::y;           ///< of the file; z is turned to y
};

struct WriteOptions {
  double metres_per_unit = 1;  ///< > 0
  Axis up = Axis::y;           ///< of the file to be written
};

/// Reads by the file name's ending: obj, ply, off, stl, gltf, glb. "-" is OBJ from standard input.
/// Throws geometry::ContentError with file and line if the content cannot be used.
MeshFile read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// Writes by the file name's ending: obj, ply, off, stl; to a temporary beside it, then renames.
/// "-" is OBJ to standard output. Throws std::runtime_error if the file cannot be written.
void write_mesh(const std::filesystem::path& path, const MeshFile& file, const WriteOptions& options = {});

}  // namespace furrow::io
