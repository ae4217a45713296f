// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "geometry/mesh/property_names.h"
#include "physics/base/arrays.h"

/// What every GLB of ours is made of, a mesh's and an animation's.
/// Source: glTF 2.0, https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
namespace furrow::io {

using Float3 = std::array<float, 3>;

/// Component types, and what a view is for.
inline constexpr int gltf_unsigned_short = 5123, gltf_unsigned_int = 5125, gltf_float = 5126;
inline constexpr int gltf_vertex_data = 34962, gltf_indices = 34963;

inline constexpr std::uint32_t glb_magic = 0x46546C67, glb_json_chunk = 0x4E4F534A,
                               glb_binary_chunk = 0x004E4942;

/// The generator that our files name.
inline constexpr const char* gltf_generator = "Furrow";

/// Accessors in the order of the binary chunk, a view each.
class GltfAccessors {
 public:
  nlohmann::json accessors = nlohmann::json::array(), views = nlohmann::json::array();

  /// `offset`: what lies in the chunk before them [bytes]; a multiple of 4.
  explicit GltfAccessors(std::size_t offset = 0) : offset_(offset) {}

  /// The number of a new one of `bytes`, a multiple of 4, behind the last; `target` 0: neither vertices nor
  /// indices.
  int add(std::size_t count, int component, const char* type, std::size_t bytes, int target);
  /// The number of a new view of that many bytes, a multiple of 4, behind the last.
  std::size_t add_view(std::size_t bytes);
  /// The least and the largest of the last one.
  void bound(const nlohmann::json& low, const nlohmann::json& high);

 private:
  std::size_t offset_;
};

/// A file up to the content of its binary chunk, which has `binary` bytes, a multiple of 4.
std::string glb_head(const nlohmann::json& document, std::size_t binary);

/// glTF has v downwards; a corner without a coordinate gets (0, 1).
std::array<float, 2> gltf_texture(const geometry::TextureCoordinate& t);

/// Unit normals at the vertices, weighted by area; upwards where there is none.
std::vector<Float3> smooth_normals(std::span<const std::array<int, 3>> triangles,
                                   std::span<const physics::Vec3> positions);

}  // namespace furrow::io
