// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "io/base/byte_order.h"

namespace furrow::tests {

using nlohmann::json;

/// A GLB taken apart again, without the writer's help.
struct Glb {
  json scene;
  std::string binary;

  explicit Glb(const std::string& bytes) {
    REQUIRE(bytes.substr(0, 4) == "glTF");
    REQUIRE(integer(bytes, 4) == 2);
    REQUIRE(integer(bytes, 8) == bytes.size());
    const std::size_t text = integer(bytes, 12);
    REQUIRE(bytes.substr(16, 4) == "JSON");
    REQUIRE(text % 4 == 0);
    scene = json::parse(bytes.substr(20, text));
    REQUIRE(integer(bytes, 20 + text) == bytes.size() - 28 - text);
    REQUIRE(bytes.substr(24 + text, 4) == std::string("BIN\0", 4));
    binary = bytes.substr(28 + text);
    REQUIRE(scene["buffers"][0]["byteLength"] == binary.size());
  }

  static std::uint32_t integer(const std::string& bytes, std::size_t at) {
    return io::read_in_order<std::uint32_t>(&bytes.at(at), std::endian::little);
  }

  static std::size_t width_of(const json& accessor) {
    const std::string type = accessor["type"];
    return type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<std::size_t>(type.back() - '0');
  }

  /// Side by side in a view of their own, as we write them.
  template <class T>
  std::vector<T> numbers(const json& accessor) const {
    const json& a = scene["accessors"].at(accessor.get<std::size_t>());
    const json& view = scene["bufferViews"].at(a["bufferView"].get<std::size_t>());
    const std::size_t width = width_of(a), count = a["count"].get<std::size_t>() * width;
    REQUIRE(view["byteLength"] == sizeof(T) * count);
    REQUIRE(view["byteOffset"].get<std::size_t>() % 4 == 0);
    std::vector<T> values;
    for (std::size_t i = 0; i < count; ++i)
      values.push_back(io::read_in_order<T>(&binary.at(view["byteOffset"].get<std::size_t>() + sizeof(T) * i),
                                            std::endian::little));
    for (std::size_t k = 0; k < width && a.contains("min"); ++k) {
      T low = values[k], high = values[k];
      for (std::size_t i = k; i < count; i += width)
        low = std::min(low, values[i]), high = std::max(high, values[i]);
      CHECK(a["min"][k] == low);
      CHECK(a["max"][k] == high);
    }
    return values;
  }

  std::string bytes_of_view(std::size_t number) const {
    const json& view = scene["bufferViews"].at(number);
    REQUIRE(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>() <= binary.size());
    return binary.substr(view["byteOffset"].get<std::size_t>(), view["byteLength"].get<std::size_t>());
  }

  const json& primitive(std::size_t mesh = 0, std::size_t number = 0) const {
    return scene["meshes"].at(mesh)["primitives"].at(number);
  }
};

/// What glTF 2.0 asks of the vertices of a primitive: counts, bounds, unit normals, weights of sum 1.
inline void check_primitive(const Glb& glb, const json& primitive, std::size_t joints) {
  const json& attributes = primitive["attributes"];
  const json& accessors = glb.scene["accessors"];
  const std::size_t vertices = accessors.at(attributes["POSITION"].get<std::size_t>())["count"];
  REQUIRE(accessors[attributes["POSITION"].get<std::size_t>()].contains("min"));
  for (const auto& [name, accessor] : attributes.items())
    CHECK(accessors.at(accessor.get<std::size_t>())["count"] == vertices);
  std::set<std::uint32_t> used;
  for (const std::uint32_t i : glb.numbers<std::uint32_t>(primitive["indices"])) used.insert(i);
  CHECK(used.size() == vertices);  // none is spare, and none beyond the last
  CHECK(*used.rbegin() + 1 == vertices);
  const auto x = glb.numbers<float>(attributes["POSITION"]), n = glb.numbers<float>(attributes["NORMAL"]);
  CHECK(std::ranges::all_of(x, [](float value) { return std::isfinite(value); }));
  for (std::size_t v = 0; v < vertices; ++v)
    CHECK(std::hypot(n[3 * v], n[3 * v + 1], n[3 * v + 2]) == Approx(1).margin(1e-6));
  if (joints == 0) return;
  const auto j = glb.numbers<std::uint16_t>(attributes["JOINTS_0"]);
  const auto w = glb.numbers<float>(attributes["WEIGHTS_0"]);
  for (std::size_t v = 0; v < vertices; ++v) {
    double sum = 0;
    for (std::size_t k = 4 * v; k < 4 * v + 4; ++k) {
      CHECK(j[k] < joints);
      CHECK(w[k] >= 0);
      if (w[k] == 0) CHECK(j[k] == 0);
      sum += static_cast<double>(w[k]);
    }
    CHECK(std::abs(sum - 1) < 2e-7);
  }
}

/// What glTF 2.0 asks of a whole file of ours: what is named by number is there, nodes are a tree.
inline void check_glb(const Glb& glb) {
  const json& s = glb.scene;
  CHECK(s["asset"]["version"] == "2.0");
  for (std::size_t v = 0; v < s["bufferViews"].size(); ++v) glb.bytes_of_view(v);
  for (const json& a : s["accessors"])
    if (a.contains("bufferView")) CHECK(a["bufferView"].get<std::size_t>() < s["bufferViews"].size());
  std::vector<int> parents(s["nodes"].size(), 0);
  for (const json& node : s["nodes"]) {
    for (const json& child : node.value("children", json::array())) ++parents.at(child.get<std::size_t>());
    CHECK((!node.contains("skin") || node.contains("mesh")));
    if (!node.contains("mesh")) continue;
    const bool skinned = node.contains("skin");
    const std::size_t joints = skinned ? s["skins"].at(node["skin"].get<std::size_t>())["joints"].size() : 0;
    for (const json& p : s["meshes"].at(node["mesh"].get<std::size_t>())["primitives"]) {
      if (p["attributes"].contains("NORMAL")) check_primitive(glb, p, joints);  // else it was kept as it was
      if (p.contains("material")) CHECK(p["material"].get<std::size_t>() < s["materials"].size());
    }
  }
  CHECK(std::ranges::all_of(parents, [](int n) { return n <= 1; }));
  for (const json& image : s.value("images", json::array()))
    CHECK(image.contains("bufferView") != image.contains("uri"));
  for (const json& texture : s.value("textures", json::array()))
    if (texture.contains("source")) CHECK(texture["source"].get<std::size_t>() < s["images"].size());
}

}  // namespace furrow::tests
