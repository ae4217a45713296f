// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/gltf_nodes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <utility>

#include "geometry/mesh/errors.h"
#include "io/mesh/gltf_document.h"

namespace furrow::io {

using geometry::ContentError;
using nlohmann::json;

namespace {

template <std::size_t N>
std::array<double, N> numbers_in(const json& node, const char* name, const std::array<double, N>& otherwise) {
  const json& given = list_of(node, name);
  if (given.empty()) return otherwise;
  if (given.size() != N) throw ContentError("a node's " + std::string(name) + " has not its numbers");
  return given.get<std::array<double, N>>();
}

/// From a node's frame to its parent's.
Eigen::Matrix4d transform_of(const json& node) {
  if (node.contains("matrix"))
    return Eigen::Map<const Eigen::Matrix4d>(numbers_in<16>(node, "matrix", {}).data());
  const auto t = numbers_in<3>(node, "translation", {0, 0, 0}), s = numbers_in<3>(node, "scale", {1, 1, 1});
  const auto r = numbers_in<4>(node, "rotation", {0, 0, 0, 1});
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  transform.translate(Eigen::Vector3d(t[0], t[1], t[2]));
  transform.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]));
  transform.scale(Eigen::Vector3d(s[0], s[1], s[2]));
  return transform.matrix();
}

/// The nodes of a scene in the order in which its tree is walked, each with its parent, -1 for none.
std::vector<std::pair<std::size_t, int>> walk(const json& document, const json& roots) {
  const json& nodes = list_of(document, "nodes");
  std::vector<std::pair<std::size_t, int>> walked, open;
  const auto put = [&](const json& list, int parent) {
    for (std::size_t c = list.size(); c-- > 0;) open.emplace_back(index_in(nodes, list[c]), parent);
  };
  put(roots, -1);
  std::set<std::size_t> seen;
  while (!open.empty()) {
    walked.push_back(open.back());
    open.pop_back();
    const std::size_t n = walked.back().first;
    if (!seen.insert(n).second) throw ContentError("its nodes are no tree");
    put(list_of(nodes[n], "children"), static_cast<int>(n));
  }
  return walked;
}

std::vector<std::pair<std::size_t, int>> shown_nodes(const json& document) {
  const json& scenes = list_of(document, "scenes");
  if (scenes.empty()) throw ContentError("it has no scene");
  const std::size_t shown = document.contains("scene") ? index_in(scenes, document["scene"]) : 0;
  return walk(document, list_of(scenes[shown], "nodes"));
}

/// The name, or where that is taken the first "name (2)", "name (3)" … that is not.
std::string unique(const std::string& name, std::set<std::string>& taken) {
  std::string own = name;
  for (int copy = 2; !taken.insert(own).second; ++copy) own = name + " (" + std::to_string(copy) + ")";
  return own;
}

/// As the name of a vertex attribute has it: without white space.
std::string without_blanks(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) <= ' ') c = '_';
  return name;
}

}  // namespace

std::vector<Eigen::Matrix4d> gltf_places(const json& document) {
  const json& nodes = list_of(document, "nodes");
  std::vector<Eigen::Matrix4d> places(nodes.size(), Eigen::Matrix4d::Identity());
  for (const auto& [n, parent] : shown_nodes(document))
    places[n] = (parent < 0 ? Eigen::Matrix4d::Identity() : places[parent]) * transform_of(nodes[n]);
  return places;
}

std::vector<GltfMeshNode> gltf_mesh_nodes(const json& document, const std::string& figure) {
  const json& nodes = list_of(document, "nodes");
  const json& meshes = list_of(document, "meshes");
  const std::vector<Eigen::Matrix4d> places = gltf_places(document);
  std::vector<GltfMeshNode> found;
  std::set<std::string> taken;
  std::string names;
  std::vector<char> is_named(nodes.size(), figure.empty());
  for (const auto& [n, parent] : shown_nodes(document)) {
    is_named[n] = is_named[n] || nodes[n].value("name", "") == figure || (parent >= 0 && is_named[parent]);
    if (!nodes[n].contains("mesh")) continue;
    const std::size_t m = index_in(meshes, nodes[n]["mesh"]);
    std::string name = nodes[n].value("name", "");
    if (name.empty()) name = meshes[m].value("name", "");
    name = unique(name.empty() ? "mesh" : name, taken);
    names += (names.empty() ? "'" : ", '") + name + "'";
    if (!is_named[n] && name != figure && meshes[m].value("name", "") != figure) continue;
    GltfMeshNode& node = found.emplace_back();
    node.node = n, node.mesh = m, node.name = name, node.to_scene = places[n];
    const json& weights = list_of(list_of(nodes[n], "weights").empty() ? meshes[m] : nodes[n], "weights");
    node.shown = weights.get<std::vector<float>>();
    node.shown.resize(gltf_key_names(meshes[m]).size(), 0);
  }
  if (found.empty() && !figure.empty())
    throw ContentError("it has no figure '" + figure + "'; it has " + (names.empty() ? "none" : names));
  return found;
}

std::vector<std::string> joint_attributes(const json& document) {
  const json& nodes = list_of(document, "nodes");
  std::set<std::size_t> joints;
  for (const json& skin : list_of(document, "skins"))
    for (const json& joint : list_of(skin, "joints")) joints.insert(index_in(nodes, joint));
  std::vector<std::string> names(nodes.size());
  std::set<std::string> taken;
  for (const std::size_t n : joints) {
    const std::string name = nodes[n].value("name", "");
    std::string own = "weight_" + (name.empty() ? "nodes[" + std::to_string(n) + "]" : name);
    names[n] = without_blanks(unique(without_blanks(own), taken));
  }
  return names;
}

std::vector<std::string> gltf_key_names(const json& mesh) {
  std::size_t keys = 0;
  for (const json& primitive : list_of(mesh, "primitives"))
    keys = std::max(keys, list_of(primitive, "targets").size());
  const json extras = mesh.value("extras", json::object());
  const json& given = list_of(extras, "targetNames");
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (std::size_t k = 0; k < keys; ++k) {
    const bool is_named = k < given.size() && given[k].is_string() && !given[k].get<std::string>().empty();
    const std::string name = is_named ? given[k].get<std::string>() : std::to_string(k);
    names.push_back(without_blanks(unique(without_blanks(name), taken)));
  }
  return names;
}

}  // namespace furrow::io
