// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "bridge/arrays/convert.h"
#include "geometry/mesh/property_names.h"
#include "io/animation/animation_encoder.h"
#include "io/base/byte_order.h"
#include "io/mesh/glb_container.h"

namespace furrow::io {
namespace {

using geometry::Face;
using geometry::Halfedge;
using geometry::Mesh;
using nlohmann::json;
using physics::Vec3;

template <class T>
void put(std::string& bytes, T value) {
  append_in_order(bytes, value, std::endian::little);
}

struct Bounds {
  Float3 low, high;
};

/// The binary chunk: indices, texture coordinates | frame 0: positions, normals | frame i > 0: what is added
/// to both in it | times, weights. Mesh vertex i is vertex i; its copies for other texture coordinates follow
/// the last.
class GlbEncoder : public AnimationEncoder {
 public:
  GlbEncoder(const Mesh& mesh, const AnimationOptions& options)
      : options_(options), triangles_(bridge::triangles_of(mesh)) {
    for (std::size_t v = 0; v < mesh.number_of_vertices(); ++v)
      source_.push_back(static_cast<std::uint32_t>(v));
    split_by_texture(mesh);
    for (const auto& t : indices_) put(static_data_, t);
    for (const auto& t : textures_)
      for (const float c : t) put(static_data_, c);
  }

  std::string frame(std::size_t index, std::span<const Vec3> positions) override {
    std::vector<Float3> x(positions.size()), n = smooth_normals(triangles_, positions);
    const bool first = index == 0;
    if (first) first_positions_.resize(x.size()), first_normals_ = n;
    bounds_.resize(index);
    bounds_.push_back({{huge, huge, huge}, {-huge, -huge, -huge}});
    for (std::size_t i = 0; i < x.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        if (first) first_positions_[i][k] = static_cast<float>(positions[i][k]);
        x[i][k] =
            first ? first_positions_[i][k] : static_cast<float>(positions[i][k] - first_positions_[i][k]);
        if (!first) n[i][k] -= first_normals_[i][k];
        bounds_[index].low[k] = std::min(bounds_[index].low[k], x[i][k]);
        bounds_[index].high[k] = std::max(bounds_[index].high[k], x[i][k]);
      }
    std::string bytes;
    bytes.reserve(24 * source_.size());
    for (const auto* values : {&x, &n})
      for (const std::uint32_t v : source_)
        for (const float c : (*values)[v]) put(bytes, c);
    return bytes;
  }

  std::string head(std::size_t frames) const override {
    const std::size_t binary = binary_size(frames);
    return glb_head(document(frames, binary), binary) + static_data_;
  }

  /// Times, and a row of weights for each: all 0 for the first frame, then one 1.
  std::string tail(std::size_t frames) const override {
    std::string bytes;
    if (frames < 2) return bytes;
    for (std::size_t i = 0; i < frames; ++i) put(bytes, static_cast<float>(frame_time(options_, i)));
    for (std::size_t i = 0; i < frames; ++i)
      for (std::size_t target = 1; target < frames; ++target) put(bytes, i == target ? 1.0f : 0.0f);
    return bytes;
  }

  /// 4 GiB of the format, less what head() and tail() may need: the text takes some 600 bytes a frame.
  std::size_t largest_file() const override {
    const std::size_t frames = bounds_.size();
    const std::size_t beside = 4096 + 1000 * frames + static_data_.size() + 4 * frames * frames;
    constexpr std::size_t largest = std::numeric_limits<std::uint32_t>::max();
    return beside < largest ? largest - beside : 0;
  }

 private:
  static constexpr float huge = std::numeric_limits<float>::max();

  /// glTF has one texture coordinate a vertex.
  void split_by_texture(const Mesh& mesh) {
    const auto textures = geometry::find_map(mesh, geometry::attribute::texture);
    if (textures) textures_.assign(source_.size(), {0, 1});
    std::vector<bool> taken(source_.size(), false);
    std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> known;
    for (const Face f : mesh.faces()) {
      Halfedge h = mesh.halfedge(f);
      h = mesh.prev(h);  // its target is the first corner of triangles_of()
      for (int corner = 0; corner < 3; ++corner, h = mesh.next(h)) {
        const auto v = static_cast<std::uint32_t>(mesh.target(h));
        if (!textures) {
          indices_.push_back(v);
          continue;
        }
        const std::array<float, 2> t = gltf_texture((*textures)[h]);
        const auto next = taken[v] ? static_cast<std::uint32_t>(source_.size()) : v;
        const auto [place, is_new] = known.emplace(std::tuple(v, t[0], t[1]), next);
        if (is_new && next != v) source_.push_back(v), textures_.push_back(t);
        if (is_new && next == v) taken[v] = true, textures_[v] = t;
        indices_.push_back(place->second);
      }
    }
  }

  std::size_t binary_size(std::size_t frames) const {
    const std::size_t animation = frames < 2 ? 0 : 4 * frames + 4 * frames * (frames - 1);
    return static_data_.size() + 24 * source_.size() * frames + animation;
  }

  json weights_over_time(std::size_t frames, GltfAccessors& a) const;
  json document(std::size_t frames, std::size_t binary) const;

  AnimationOptions options_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::uint32_t> source_, indices_;  ///< mesh vertex of each vertex; three of these a face
  std::vector<std::array<float, 2>> textures_;   ///< empty, or one a vertex
  std::string static_data_;
  std::vector<Float3> first_positions_, first_normals_;
  std::vector<Bounds> bounds_;  ///< of the positions (or what is added to them) of each frame
};

json GlbEncoder::weights_over_time(std::size_t frames, GltfAccessors& a) const {
  const std::size_t weights = frames * (frames - 1);
  const int input = a.add(frames, gltf_float, "SCALAR", 4 * frames, 0);
  a.bound(json::array({static_cast<float>(frame_time(options_, 0))}),
          json::array({static_cast<float>(frame_time(options_, frames - 1))}));
  json sampler = {{"input", input}, {"output", a.add(weights, gltf_float, "SCALAR", 4 * weights, 0)}};
  sampler["interpolation"] = options_.interpolation == Interpolation::step ? "STEP" : "LINEAR";
  const json channel = {{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}};
  return {{"samplers", json::array({sampler})}, {"channels", json::array({channel})}};
}

json GlbEncoder::document(std::size_t frames, std::size_t binary) const {
  GltfAccessors a;
  const std::size_t n = source_.size();
  json primitive = {{"material", 0}};
  primitive["indices"] =
      a.add(indices_.size(), gltf_unsigned_int, "SCALAR", 4 * indices_.size(), gltf_indices);
  json attributes;
  if (!textures_.empty()) attributes["TEXCOORD_0"] = a.add(n, gltf_float, "VEC2", 8 * n, gltf_vertex_data);
  json targets = json::array();
  for (std::size_t i = 0; i < frames; ++i) {
    json& to = i == 0 ? attributes : targets.emplace_back();
    to["POSITION"] = a.add(n, gltf_float, "VEC3", 12 * n, gltf_vertex_data);
    a.bound(bounds_[i].low, bounds_[i].high);
    to["NORMAL"] = a.add(n, gltf_float, "VEC3", 12 * n, gltf_vertex_data);
  }
  primitive["attributes"] = attributes;
  json mesh = {{"name", "cloth"}};
  json root = {{"asset", {{"version", "2.0"}, {"generator", gltf_generator}}}, {"scene", 0}};
  root["scenes"] = json::array({{{"nodes", json::array({0})}}});
  root["nodes"] = json::array({{{"mesh", 0}, {"name", "cloth"}}});
  root["materials"] = json::array({{{"name", "cloth"}, {"doubleSided", true}}});
  root["materials"][0]["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"roughnessFactor", 0.9}};
  root["buffers"] = json::array({{{"byteLength", binary}}});
  if (frames > 1) {
    root["animations"] = json::array({weights_over_time(frames, a)});
    primitive["targets"] = targets;
    mesh["weights"] = std::vector<int>(frames - 1, 0);
  }
  mesh["primitives"] = json::array({primitive});
  root["meshes"] = json::array({mesh});
  root["accessors"] = a.accessors;
  root["bufferViews"] = a.views;
  return root;
}

}  // namespace

std::unique_ptr<AnimationEncoder> glb_encoder(const Mesh& mesh, const AnimationOptions& options) {
  if (mesh.number_of_faces() == 0) throw std::invalid_argument("animation: a GLB needs a mesh with faces");
  return std::make_unique<GlbEncoder>(mesh, options);
}

}  // namespace furrow::io
