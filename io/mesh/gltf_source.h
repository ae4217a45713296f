// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace furrow::io {

/// What a glTF says beside its geometry: what a GLB that is made of its mesh has to say again.
struct GltfSource {
  /// Which node of the document a group's faces came from, and how that places them.
  struct Place {
    int node = -1;                      ///< -1: none
    std::array<double, 16> to_scene{};  ///< from the node's vertices to the file's scene, row by row
  };

  std::string document;           ///< JSON; nodes, materials … keep their numbers, meshes their names alone
  std::string binary;             ///< its one buffer: images, inverse bind matrices, animations
  std::vector<Place> places;      ///< by group
  std::vector<int> materials;     ///< the document's, by that of the mesh; -1: none
  std::vector<std::string> lost;  ///< what a GLB made of it misses, a sentence each
};

/// A node with a mesh.
struct GltfMeshNode {
  int node = 0;
  std::string name;
  std::vector<int> materials;  ///< by primitive; -1: none
};

struct KeptGltf {
  GltfSource source;                     ///< without places and materials
  std::vector<GltfMeshNode> mesh_nodes;  ///< in the order in which the scene's tree is walked
  std::vector<std::string> material_names;
};

/// The content of a file that a glTF names, or nothing if it is not to be had.
using OpenBeside = std::function<std::optional<std::string>(const std::string& name)>;

/// Takes out of a glTF or GLB file, whose bytes these are, all but the geometry. Files that it names are put
/// into the binary. Throws geometry::ContentError for what is no glTF 2.0.
KeptGltf keep_gltf(std::string_view bytes, const OpenBeside& open);

/// The file without the compressions of geometry that it requires (KHR_draco_mesh_compression,
/// EXT_meshopt_compression); nothing if it requires none. Throws geometry::ContentError for what is no
/// glTF 2.0, and for data that cannot be unpacked. Hostile data may take time and memory: to be called in a
/// child.
std::optional<std::string> unpack_gltf(std::string_view bytes, const OpenBeside& open);

/// The file with floats where it has integers, with the shape keys applied that it shows, of which it warns,
/// and with inverse bind matrices; nothing if it is so already. Throws geometry::ContentError for what is no
/// glTF 2.0, and, naming it, for a required extension that says where vertices are and is not read.
std::optional<std::string> plain_gltf(std::string_view bytes, const OpenBeside& open,
                                      std::vector<std::string>& warnings);

/// The vertex attribute that a joint's weights are.
std::string weight_attribute(const std::string& joint);

}  // namespace furrow::io
