// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/glb_container.h"

#include <Eigen/Geometry>
#include <cmath>

#include "io/base/byte_order.h"

namespace furrow::io {

using nlohmann::json;
using physics::Vec3;

int GltfAccessors::add(std::size_t count, int component, const char* type, std::size_t bytes, int target) {
  const std::size_t view = add_view(bytes);
  if (target) views.back()["target"] = target;
  accessors.push_back({{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
  return static_cast<int>(accessors.size()) - 1;
}

std::size_t GltfAccessors::add_view(std::size_t bytes) {
  views.push_back({{"buffer", 0}, {"byteOffset", offset_}, {"byteLength", bytes}});
  offset_ += bytes;
  return views.size() - 1;
}

void GltfAccessors::bound(const json& low, const json& high) {
  accessors.back()["min"] = low, accessors.back()["max"] = high;
}

std::string glb_head(const json& document, std::size_t binary) {
  std::string text = document.dump(-1, ' ', false, json::error_handler_t::replace), bytes;  // any names
  text.append((4 - text.size() % 4) % 4, ' ');
  const auto put = [&](std::size_t word) {
    append_in_order(bytes, static_cast<std::uint32_t>(word), std::endian::little);
  };
  put(glb_magic);
  put(2);
  put(28 + text.size() + binary);
  put(text.size());
  put(glb_json_chunk);
  bytes += text;
  put(binary);
  put(glb_binary_chunk);
  return bytes;
}

std::array<float, 2> gltf_texture(const geometry::TextureCoordinate& t) {
  const std::array<float, 2> turned{static_cast<float>(t[0]), static_cast<float>(1 - t[1])};
  if (!std::isfinite(turned[0]) || !std::isfinite(turned[1])) return {0, 1};
  return turned;
}

std::vector<Float3> smooth_normals(std::span<const std::array<int, 3>> triangles, std::span<const Vec3> x) {
  std::vector<Vec3> sum(x.size(), Vec3::Zero());
  for (const auto& [a, b, c] : triangles) {
    const Vec3 normal = (x[b] - x[a]).cross(x[c] - x[a]);
    for (const int v : {a, b, c}) sum[v] += normal;
  }
  std::vector<Float3> result(x.size(), Float3{0, 1, 0});
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double length = sum[i].norm();
    if (length > 0 && std::isfinite(length))
      for (int k = 0; k < 3; ++k) result[i][k] = static_cast<float>(sum[i][k] / length);
  }
  return result;
}

}  // namespace furrow::io
