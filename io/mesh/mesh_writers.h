// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "io/mesh/file_frame.h"
#include "io/mesh/mesh_file.h"

/// The writers behind write_mesh(), one source a format. They pass over removed elements of a mesh with
/// garbage; vertices and faces keep their order. All throw std::invalid_argument, nothing written, for a
/// position that is not finite.
namespace furrow::io {

/// OBJ in double (shortest text that reads back exactly): comments, mtllib, v (with colour), vt (equal ones
/// shared; a face with a corner that has none gets none), g, usemtl, f; and as `l` elements the chains of
/// line edges (e:line_edge) or, where the mesh has none, `polylines` (those without vertices of the mesh get
/// vertices of their own at the end). Of a mesh without faces its struts are the lines.
/// In `folder`, if it is known, material libraries are named from there.
void write_obj(std::ostream& out, const MeshFile& file, const WriteOptions& options,
               const std::filesystem::path& folder = {});
/// PLY, binary little-endian, double: every map of geometry/mesh/property_names.h that the mesh has, and its
/// vertex attributes (decision 0005). Throws geometry::ContentError for an attribute that is named like
/// another column of the vertices.
void write_ply(std::ostream& out, const MeshFile& file, const WriteOptions& options);

/// GLB, glTF 2.0, in single precision: positions, normals, texture coordinates, colours, a primitive a
/// material. A mesh that was read from a glTF goes back into the nodes that it came from, in the frame of
/// `options`, with the four largest of each vertex's skin weights, the skeleton where it stood, and all else
/// of that file but its geometry. Any other is one node, in metres, y up, with plain materials. Returns what
/// is left out, a sentence each. Throws std::invalid_argument for a mesh without faces and for a weight that
/// is negative or not finite.
std::vector<std::string> write_glb(std::ostream& out, const MeshFile& file, const WriteOptions& options);

/// The number that each vertex gets in a file (by vertex index; removed ones have none of meaning).
std::vector<std::size_t> vertex_numbers(const geometry::Mesh& mesh);
/// Throws std::invalid_argument naming the first vertex whose position is not finite in the file's unit.
void check_positions(const geometry::Mesh& mesh, const WriteOptions& options);

}  // namespace furrow::io
