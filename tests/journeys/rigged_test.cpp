// SPDX-License-Identifier: GPL-3.0-or-later
// J4: a rigged GLB with two materials is drawn on, worn, and goes back to where it came from.
#include <algorithm>
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <vector>

#include "journey.h"
#include "tests/io/mesh/glb_parts.h"

using namespace furrow::tests;
using nlohmann::json;

namespace {

using Float3 = std::array<float, 3>;
using Float2 = std::array<float, 2>;

/// A vertex as a GLB has it: split where the texture is, and between materials.
struct Corner {
  Float3 place;
  Float2 texture;
  std::array<unsigned char, 4> joints;
  std::array<float, 4> weights;
};
struct Part {
  std::vector<Corner> corners;
  std::vector<std::uint32_t> indices;
};

/// meshes/tunic.obj in triangles.
struct Tunic {
  std::vector<std::array<double, 3>> places;
  std::vector<std::array<int, 3>> triangles;
  Tunic() {
    std::istringstream text(read_text(source_file("meshes/tunic.obj")));
    for (std::string line; std::getline(text, line);) {
      std::istringstream words(line.substr(std::min<std::size_t>(2, line.size())));
      if (line.starts_with("v ")) {
        auto& p = places.emplace_back();
        words >> p[0] >> p[1] >> p[2];
      } else if (line.starts_with("f ")) {
        std::vector<int> face;
        for (int i; words >> i;) face.push_back(i - 1);
        for (std::size_t k = 2; k < face.size(); ++k) triangles.push_back({face[0], face[k - 1], face[k]});
      }
    }
  }
  /// Around its axis, 0 at the back, where the texture's seam runs; from 0 to 1.
  double around(int v) const {
    return std::atan2(places[v][2] - 0.25, places[v][0] - 0.4) / (2 * std::numbers::pi) + 0.5;
  }
};

Corner corner_of(const Tunic& tunic, int v, bool beyond_seam) {
  const auto& p = tunic.places[v];
  const double up = std::clamp((p[1] - 0.6) / 0.25, 0.0, 1.0);  // from the hips to the chest
  const float chest = static_cast<float>(up), hips = 1 - chest;
  return {{float(p[0]), float(p[1]), float(p[2])},
          {float(tunic.around(v) + (beyond_seam ? 1 : 0)), float(p[1])},
          {0, 1, 0, 0},
          {hips, chest, 0, 0}};
}

/// Two parts, front and back; a triangle that crosses the back seam takes the texture beyond it.
std::array<Part, 2> parts_of(const Tunic& tunic) {
  std::array<Part, 2> parts;
  std::map<std::array<int, 3>, std::uint32_t> known;
  for (const auto& t : tunic.triangles) {
    const auto [low, high] = std::minmax({tunic.around(t[0]), tunic.around(t[1]), tunic.around(t[2])});
    const bool crosses = high - low > 0.5;
    const double x = tunic.places[t[0]][0] + tunic.places[t[1]][0] + tunic.places[t[2]][0];
    const int material = x / 3 < 0.4 ? 1 : 0;
    for (int v : t) {
      const bool beyond = crosses && tunic.around(v) < 0.5;
      Part& part = parts[material];
      const auto [at, fresh] = known.try_emplace({material, v, beyond}, part.corners.size());
      if (fresh) part.corners.push_back(corner_of(tunic, v, beyond));
      part.indices.push_back(at->second);
    }
  }
  return parts;
}

/// Grows a buffer by one accessor after the other.
struct GlbMaker {
  std::string binary;
  json scene = {{"asset", {{"version", "2.0"}, {"generator", "another program"}}}, {"scene", 0}};

  template <class T>
  int add(const char* type, int component, const std::vector<T>& values, int width) {
    const std::size_t from = binary.size();
    binary.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    scene["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", from}, {"byteLength", values.size() * sizeof(T)}});
    while (binary.size() % 4) binary += '\0';
    scene["accessors"].push_back({{"bufferView", scene["bufferViews"].size() - 1},
                                  {"componentType", component},
                                  {"count", values.size() / width},
                                  {"type", type}});
    return int(scene["accessors"].size()) - 1;
  }
  json primitive(const Part& part, int material) {
    std::vector<float> places, textures, weights;
    std::vector<unsigned char> joints;
    Float3 low = part.corners[0].place, high = low;
    for (const Corner& c : part.corners) {
      places.insert(places.end(), c.place.begin(), c.place.end());
      textures.insert(textures.end(), c.texture.begin(), c.texture.end());
      weights.insert(weights.end(), c.weights.begin(), c.weights.end());
      joints.insert(joints.end(), c.joints.begin(), c.joints.end());
      for (int k = 0; k < 3; ++k)
        low[k] = std::min(low[k], c.place[k]), high[k] = std::max(high[k], c.place[k]);
    }
    json attributes;
    const int position = add("VEC3", 5126, places, 3);
    scene["accessors"][position]["min"] = low;
    scene["accessors"][position]["max"] = high;
    attributes["POSITION"] = position;
    attributes["TEXCOORD_0"] = add("VEC2", 5126, textures, 2);
    attributes["JOINTS_0"] = add("VEC4", 5121, joints, 4);
    attributes["WEIGHTS_0"] = add("VEC4", 5126, weights, 4);
    return {{"attributes", attributes},
            {"indices", add("SCALAR", 5125, part.indices, 1)},
            {"material", material}};
  }
  std::string bytes() {
    scene["buffers"] = json::array({{{"byteLength", binary.size()}}});
    std::string text = scene.dump();
    while (text.size() % 4) text += ' ';
    const auto number = [](std::uint32_t n) {
      return std::string{char(n), char(n >> 8), char(n >> 16), char(n >> 24)};
    };
    return "glTF" + number(2) + number(28 + text.size() + binary.size()) + number(text.size()) + "JSON" +
           text + number(binary.size()) + std::string("BIN\0", 4) + binary;
  }
};

std::string rigged_tunic(const std::array<Part, 2>& parts) {
  GlbMaker glb;
  json& scene = glb.scene;
  scene["materials"] = {
      {{"name", "linen"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0.8, 0.7, 0.5, 1}}}}},
      {{"name", "lining"}, {"doubleSided", true}}};
  scene["meshes"] = json::array({{{"primitives", {glb.primitive(parts[0], 0), glb.primitive(parts[1], 1)}}}});
  // Bound where the joints stand: 0.5 m and 0.9 m high.
  std::vector<float> inverse;
  for (const float y : {0.5f, 0.9f})
    for (const float x : {1.f, 0.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 0.f, 1.f, 0.f, -0.4f, -y, -0.25f, 1.f})
      inverse.push_back(x);
  scene["skins"] =
      json::array({{{"joints", {1, 2}}, {"inverseBindMatrices", glb.add("MAT4", 5126, inverse, 16)}}});
  scene["nodes"] = {{{"name", "rig"}, {"children", {1, 3}}},
                    {{"name", "hips"}, {"children", {2}}, {"translation", {0.4, 0.5, 0.25}}},
                    {{"name", "chest"}, {"translation", {0, 0.4, 0}}},
                    {{"name", "tunic"}, {"mesh", 0}, {"skin", 0}}};
  scene["scenes"] = json::array({{{"nodes", {0}}}});
  return glb.bytes();
}

/// The corners of a primitive that furrow wrote.
std::vector<Corner> corners_of(const Glb& glb, const json& primitive) {
  const json& a = primitive["attributes"];
  const auto x = glb.numbers<float>(a["POSITION"]), t = glb.numbers<float>(a["TEXCOORD_0"]),
             w = glb.numbers<float>(a["WEIGHTS_0"]);
  const auto j = glb.numbers<std::uint16_t>(a["JOINTS_0"]);
  std::vector<Corner> corners(x.size() / 3);
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = {{x[3 * i], x[3 * i + 1], x[3 * i + 2]}, {t[2 * i], t[2 * i + 1]}, {}, {}};
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (int k = 0; k < 4; ++k)  // by joint: the writer may order them
      if (w[4 * i + k] > 0) corners[i].weights[j[4 * i + k]] = w[4 * i + k];
  return corners;
}

/// To a millionth, as 1 - (1 - v) may differ from v in its last bit.
Float2 rounded(const Float2& t) { return {std::round(t[0] * 1e6f), std::round(t[1] * 1e6f)}; }

std::multiset<std::array<Float2, 3>> faces_of(const std::vector<Corner>& corners,
                                              const std::vector<std::uint32_t>& indices) {
  std::multiset<std::array<Float2, 3>> faces;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    std::array<Float2, 3> f;
    for (int k = 0; k < 3; ++k) f[k] = rounded(corners[indices[i + k]].texture);
    std::ranges::rotate(f, std::ranges::min_element(f));
    faces.insert(f);
  }
  return faces;
}

}  // namespace

TEST_CASE("journey: a rigged tunic of two materials is wrinkled, worn and goes back into its GLB",
          "[release]") {
  const Journey here;
  const auto parts = parts_of(Tunic());
  write_text("tunic.glb", rigged_tunic(parts));
  here.bring_body_of_tunic("she.obj");
  write_text("lines.json", R"({"strokes":[
    {"name":"sweep","height":0.012,"points":[[0.55,0.66,0.36],[0.565,0.59,0.26],[0.56,0.52,0.18]]},
    {"name":"back","height":-0.008,"points":[[0.24,0.75,0.3],[0.235,0.6,0.26],[0.23,0.5,0.2]]}]})");
  step("wrinkle tunic.glb lines.json -o drawn.ply");
  step("drape drawn.ply --body she.obj -o worn.ply");
  const json transferred = step("transfer tunic.glb worn.ply -o worn.glb");
  CHECK(transferred["vertices"].get<int>() > 1500);
  CHECK(step("fit worn.glb --body she.obj")["distance"]["min"].get<double>() > 0);

  const Glb worn(read_text("worn.glb"));
  check_glb(worn);
  CHECK(worn.scene["materials"][0]["name"] == "linen");
  CHECK(worn.scene["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] == json({0.8, 0.7, 0.5, 1}));
  CHECK(worn.scene["materials"][1]["doubleSided"] == true);
  REQUIRE(worn.scene["meshes"][0]["primitives"].size() == 2);
  std::map<Float3, Float3> went;  // from each place to where all its corners must be
  std::size_t moved = 0;
  for (const json& primitive : worn.scene["meshes"][0]["primitives"]) {
    const Part& before = parts.at(primitive["material"].get<std::size_t>());
    const auto after = corners_of(worn, primitive);
    CHECK(after.size() == before.corners.size());
    const bool same_faces = faces_of(after, worn.numbers<std::uint32_t>(primitive["indices"])) ==
                            faces_of(before.corners, before.indices);
    CHECK(same_faces);
    std::map<Float2, Corner> by_texture;
    for (const Corner& c : after) by_texture[rounded(c.texture)] = c;
    for (const Corner& c : before.corners) {
      REQUIRE(by_texture.contains(rounded(c.texture)));
      const Corner& now = by_texture[rounded(c.texture)];
      for (int k = 0; k < 4; ++k) CHECK(now.weights[k] == Approx(c.weights[k]).margin(1e-6));
      const auto [at, first] = went.try_emplace(c.place, now.place);
      CHECK(at->second == now.place);  // the seam is closed
      moved += now.place != c.place;
    }
  }
  CHECK(moved > went.size() / 2);
}
