// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// What a glTF's nodes, skins and shape keys are called here, and where they stand. All throw
/// geometry::ContentError for what contradicts itself.
namespace furrow::io {

/// A node with a mesh that the shown scene has.
struct GltfMeshNode {
  std::size_t node = 0, mesh = 0;                          ///< of the document
  std::string name;                                        ///< unique among them
  Eigen::Matrix4d to_scene = Eigen::Matrix4d::Identity();  ///< from its own frame
  std::vector<float> shown;                                ///< how far each shape key is; as many as keys
};

/// Of the scene that a document shows, in the order in which its tree is walked. `figure`: those alone that
/// it names, or a node above them or their mesh; empty: all. Throws, and lists the names, where none has it.
std::vector<GltfMeshNode> gltf_mesh_nodes(const nlohmann::json& document, const std::string& figure = "");

/// From each node's own frame to the scene's.
std::vector<Eigen::Matrix4d> gltf_places(const nlohmann::json& document);

/// The vertex attribute that the weights of each joint are, by node; "" for what is no joint. Joints of one
/// name, as two rigs have them, have attributes of their own.
std::vector<std::string> joint_attributes(const nlohmann::json& document);

/// A mesh's shape keys: their names, unique in it, without white space.
std::vector<std::string> gltf_key_names(const nlohmann::json& mesh);

}  // namespace furrow::io
