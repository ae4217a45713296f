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

  std::string
      document;  ///< JSON; all keep their numbers, but of a mesh that is read its keys' names are left
  std::string
      binary;  ///< its one buffer: images, inverse bind matrices, animations, meshes that are not read
  std::vector<Place> places;      ///< by group
  std::vector<int> materials;     ///< the document's, by that of the mesh; -1: none
  std::vector<std::string> lost;  ///< what a GLB made of it misses, a sentence each
};

/// The content of a file that a glTF names, or nothing if it is not to be had.
using OpenBeside = std::function<std::optional<std::string>(const std::string& name)>;

/// The file without the compressions of geometry that it requires (KHR_draco_mesh_compression,
/// EXT_meshopt_compression); nothing if it requires none. Throws geometry::ContentError for what is no
/// glTF 2.0, and for data that cannot be unpacked. Hostile data may take time and memory: to be called in a
/// child.
std::optional<std::string> unpack_gltf(std::string_view bytes, const OpenBeside& open);

/// An FBX or COLLADA file (`ending`: "fbx", "dae") as a GLB in metres, y up. As the above to be called in a
/// child.
std::string other_as_gltf(std::string_view bytes, const std::string& ending);

}  // namespace furrow::io
