// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "tests/io/base/io_test_helpers.h"

/// Small glTF files, made by hand.
namespace furrow::tests {

using nlohmann::json;

template <class T>
void put_bytes(std::string& bytes, T value) {
  const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  bytes.append(raw.data(), raw.size());
}

/// Two triangles that share an edge, with that edge's vertices twice, as glTF has it at a texture seam.
struct Seam {
  std::string buffer;
  json scene;

  Seam() {
    const float positions[6][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0.1F}};
    for (const auto& p : positions)
      for (const float x : p) put_bytes(buffer, x);
    for (int v = 0; v < 6; ++v) put_bytes(buffer, static_cast<float>(v) / 8), put_bytes(buffer, 0.25F);
    for (std::uint16_t i = 0; i < 6; ++i) put_bytes(buffer, i);
    scene = json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
      "nodes": [{"mesh": 0, "name": "sleeve", "scale": [2, 2, 2], "translation": [0, 0, 5]}],
      "materials": [{"name": "silk"}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
      "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 72}, {"buffer": 0, "byteOffset": 72, "byteLength": 48},
                      {"buffer": 0, "byteOffset": 120, "byteLength": 12}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3", "min": [0,0,0], "max": [1,1,1]},
                    {"bufferView": 1, "componentType": 5126, "count": 6, "type": "VEC2"},
                    {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}]})");
    scene["buffers"] = json::array({{{"byteLength", buffer.size()}}});
  }

  std::string glb() const {
    std::string text = scene.dump(), out = "glTF";
    text.resize((text.size() + 3) / 4 * 4, ' ');
    put_bytes(out, std::uint32_t{2});
    put_bytes(out, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + buffer.size()));
    put_bytes(out, static_cast<std::uint32_t>(text.size()));
    out += "JSON" + text;
    put_bytes(out, static_cast<std::uint32_t>(buffer.size()));
    return out + std::string("BIN\0", 4) + buffer;
  }
};

/// Appends bytes with a view of their own, whose number it returns.
inline std::size_t add_view(Seam& seam, const std::string& bytes) {
  seam.buffer.resize((seam.buffer.size() + 3) / 4 * 4);
  seam.scene["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", seam.buffer.size()}, {"byteLength", bytes.size()}});
  seam.buffer += bytes;
  seam.scene["buffers"][0]["byteLength"] = seam.buffer.size();
  return seam.scene["bufferViews"].size() - 1;
}

/// The seam with a skin of two joints, one above the other, whose inverse bind matrices are given by their
/// translations.
struct SkinnedSeam : Seam {
  explicit SkinnedSeam(const std::array<std::array<float, 3>, 2>& inverse_bind = {}) {
    const std::size_t at = buffer.size();
    for (int v = 0; v < 6; ++v)
      for (const std::uint8_t joint : {0, 1, 0, 0}) put_bytes(buffer, joint);
    for (int v = 0; v < 6; ++v)
      for (const float w : {v < 3 ? 0.25F : 1.F, v < 3 ? 0.75F : 0.F, 0.F, 0.F}) put_bytes(buffer, w);
    for (const auto& to : inverse_bind)  // column by column
      for (int i = 0; i < 16; ++i) put_bytes(buffer, i >= 12 && i < 15 ? to[i - 12] : i % 5 == 0 ? 1.F : 0.F);
    scene["buffers"][0]["byteLength"] = buffer.size();
    scene["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", 24}});
    scene["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at + 24}, {"byteLength", 96}});
    scene["accessors"].push_back(
        {{"bufferView", 3}, {"componentType", 5121}, {"count", 6}, {"type", "VEC4"}});
    scene["accessors"].push_back(
        {{"bufferView", 4}, {"componentType", 5126}, {"count", 6}, {"type", "VEC4"}});
    scene["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at + 120}, {"byteLength", 128}});
    scene["accessors"].push_back(
        {{"bufferView", 5}, {"componentType", 5126}, {"count", 2}, {"type", "MAT4"}});
    json& attributes = scene["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = 3;
    attributes["WEIGHTS_0"] = 4;
    scene["nodes"][0]["skin"] = 0;
    scene["nodes"].push_back({{"name", "upper arm"}, {"children", {2}}});
    scene["nodes"].push_back({{"name", "hand"}});
    scene["scenes"][0]["nodes"].push_back(1);
    scene["skins"] = json::array({{{"joints", {1, 2}}, {"inverseBindMatrices", 5}}});
  }

  io::MeshFile read() const {
    TemporaryFolder folder;
    spit(folder / "a.glb", glb());
    return io::read_mesh(folder / "a.glb");
  }
};

/// With a shape key that moves vertex 5 alone, by (0, 0.5, 0), as sparse elements of an accessor without
/// view.
template <class Made>
Made with_key(Made seam) {
  std::string index, move;
  put_bytes(index, std::uint16_t{5});
  for (const float x : {0.F, 0.5F, 0.F}) put_bytes(move, x);
  const std::size_t at = add_view(seam, index), values = add_view(seam, move);
  seam.scene["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", seam.scene["accessors"].size()}}};
  seam.scene["meshes"][0]["extras"] = {{"targetNames", {"Long"}}};
  seam.scene["accessors"].push_back({{"componentType", 5126},
                                     {"count", 6},
                                     {"type", "VEC3"},
                                     {"sparse",
                                      {{"count", 1},
                                       {"indices", {{"bufferView", at}, {"componentType", 5123}}},
                                       {"values", {{"bufferView", values}}}}}});
  return seam;
}

}  // namespace furrow::tests
