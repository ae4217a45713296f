// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh/mesh_fwd.h"

namespace furrow::io {

/// What a reader had to do to a file's content to get an oriented manifold of triangles.
struct RepairReport {
  std::size_t triangulated_faces = 0;   ///< faces with more than three corners, cut
  std::size_t degenerate_faces = 0;     ///< triangles dropped: a repeated corner
  std::size_t duplicate_faces = 0;      ///< triangles dropped: the same three vertices as an earlier one
  std::size_t reversed_faces = 0;       ///< triangles turned to agree with their neighbours
  std::size_t duplicated_vertices = 0;  ///< appended at the end, to part non-manifold edges and vertices
  std::size_t isolated_vertices = 0;    ///< kept
  std::size_t lining_textures = 0;      ///< backs that took the texture coordinates of their fronts
  std::size_t merged_vertices = 0;  ///< equal positions, only where the format cannot share them (STL, glTF)
  bool any() const {
    return degenerate_faces || duplicate_faces || reversed_faces || duplicated_vertices || merged_vertices;
  }
};

/// An OBJ `l` element, or a chain of two-point elements that share vertices.
struct Polyline {
  std::vector<geometry::Coordinates<geometry::Point>>
      points;                         ///< [m]; the first is not repeated at the end of a closed one
  std::vector<std::size_t> vertices;  ///< the same points as vertex indices of the mesh; empty = not its own
  bool closed = false;
};

struct GltfSource;

/// A mesh and what its file says beside it. Vertices are in the file's order; positions in metres, y up.
struct MeshFile {
  geometry::Owned<geometry::Mesh> mesh;         ///< maps as in geometry/mesh/property_names.h
  std::vector<std::string> group_names;         ///< f:group
  std::vector<std::string> material_names;      ///< f:material
  std::vector<std::string> material_libraries;  ///< OBJ mtllib
  std::vector<Polyline> polylines;              ///< OBJ l elements, chained
  std::vector<std::string> comments;            ///< without the comment mark; PLY and OBJ
  std::vector<std::string> warnings;            ///< e.g. "single precision, vertex order not kept"
  RepairReport repairs;
  std::filesystem::path folder;  ///< that material_libraries are relative to; empty: not known
  /// Materials, textures, skeleton and motion of a glTF or GLB, which a GLB gets again; null: it was none.
  std::shared_ptr<const GltfSource> gltf = {};
};

/// The axis of a file that points up; we work with y up.
enum class Axis { y, z };

struct ReadOptions {
  double metres_per_unit = 1;  ///< > 0, finite
  Axis up = Axis::y;           ///< of the file; z is turned to y: (x, y, z) becomes (x, z, -y)
  /// Whether an OBJ with lines (`l`) or a PLY with struts, and without a face, is read: as a chain, whose
  /// vertices are those of the file. Such a file is refused otherwise.
  bool chains = false;
};

struct WriteOptions {
  double metres_per_unit = 1;  ///< > 0, finite
  Axis up = Axis::y;           ///< of the file to be written
};

enum class MeshFormat { obj, ply, off, stl, gltf };

/// Endings of names of files that are written (`all`: or read), for a sentence: "obj, ply, off, stl or glb".
std::string mesh_formats(bool all = false, const std::string& last = " or ");
/// Whether meshes of that ending, ".ply", are written.
bool is_written_mesh(const std::string& ending);

/// The format that a file name's ending names, in any case of letters; "-" is OBJ.
/// Throws geometry::ContentError that lists the known endings.
MeshFormat mesh_format(const std::filesystem::path& path);

/// Reads by the file name's ending. "-" is OBJ from standard input.
/// Throws geometry::ContentError with file and line if the file or its content cannot be used.
MeshFile read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// Reads a format from a stream; `name` stands in messages. Not glTF, whose files name other files.
MeshFile read_mesh(std::istream& in, MeshFormat format, const std::string& name,
                   const ReadOptions& options = {});

/// Writes by the file name's ending; to a temporary beside it, then renames. An OBJ
/// in another folder than the mesh was read from names the material libraries there from here.
/// Returns what a GLB has no place for, a sentence each. Throws std::invalid_argument for "-" and for what we
/// do not write, nothing written; std::runtime_error if the file cannot be written, the old one left as it
/// was.
std::vector<std::string> write_mesh(const std::filesystem::path& path, const MeshFile& file,
                                    const WriteOptions& options = {});

/// Writes a format, of glTF a GLB, to a stream (standard output is the program's, not the library's).
std::vector<std::string> write_mesh(std::ostream& out, MeshFormat format, const MeshFile& file,
                                    const WriteOptions& options = {});

/// What a wrinkled mesh carries beside its maps, so that a simulation needs nothing else. Kept as comments
/// `furrow wrinkle {…}` (JSON in one line).
struct WrinkleRecord {
  struct Line {
    std::string name;
    double height = 0;           ///< k [m]
    double drawn_height = 0;     ///< [m]
    double smoothed_height = 0;  ///< [m]
    double base_height = 0;      ///< of the line before it was displaced; the two above are without it [m]
    std::optional<double> width = {};  ///< as asked for [m], as the next two [-]
    double sharpness = 0.5, press = 1;
    std::optional<double> crest_height = {};  ///< of a fold: of its crest as drawn, away from its ends [m]
    std::optional<double> gather = {};        ///< as asked for [-]; none: no thread is sewn along it
  };
  double mean_structural_length = 0;  ///< r_avg of the mesh before any line [m]
  double mean_bending_length = 0;     ///< [m]
  double density = 0;                 ///< [kg/m^2]
  std::string options;                ///< the flags that made the last lines
  std::string unit = "m", up = "y";   ///< of the file's positions and rest lengths: m, cm, mm or inch; y or z
  std::vector<Line> lines;            ///< by line id
  std::string garment;                ///< the file that the last lines were drawn on; empty: not known
  std::string garment_hash;           ///< its content_hash()
  std::string strokes;  ///< the last lines as a stroke file's text (metres, y up); empty: not known
  std::string
      material;  ///< the scene's [material], as JSON, that it came to rest or moved with; empty: not known
  double contact_gap = 0;  ///< that it kept from a body then [m]; 0: not known
};

/// Of the lines by id: widths [m] (NaN: none), and presses [-].
std::vector<double> line_widths(const WrinkleRecord& record);
std::vector<double> line_presses(const WrinkleRecord& record);
/// 1 for those that are to have no height, by id.
std::vector<char> flat_lines(const WrinkleRecord& record);
/// The ids of the lines that a thread gathers, ascending.
std::vector<int> gathered_lines(const WrinkleRecord& record);

void set_wrinkle_record(MeshFile& file, const WrinkleRecord& record);
/// The record, or nothing if the file has none. Fields of later versions that are not there keep their
/// defaults. Throws geometry::ContentError if it is damaged.
std::optional<WrinkleRecord> find_wrinkle_record(const MeshFile& file);
/// The same of the file of that name, which messages then begin with.
std::optional<WrinkleRecord> find_wrinkle_record(const MeshFile& file, const std::string& name);
/// The same from the first lines of a PLY or OBJ file; nothing for any other, also one that is not there.
std::optional<WrinkleRecord> read_wrinkle_record(const std::filesystem::path& path);

}  // namespace furrow::io
