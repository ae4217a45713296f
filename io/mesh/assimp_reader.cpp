// SPDX-License-Identifier: GPL-3.0-or-later
// The only source that knows assimp.
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "geometry/mesh/errors.h"
#include "io/mesh/gltf_document.h"

namespace furrow::io {
namespace {

using geometry::ContentError;
using nlohmann::json;

/// assimp's exporter leaves out what shape keys are called; how far a file shows them is 0 in a mesh of its.
void name_keys(const aiScene& scene, json& document) {
  std::map<std::string, json> names;
  for (const aiMesh* mesh : std::span(scene.mMeshes, scene.mNumMeshes)) {
    json list = json::array();
    for (unsigned k = 0; k < mesh->mNumAnimMeshes; ++k) list.push_back(mesh->mAnimMeshes[k]->mName.C_Str());
    if (!list.empty()) names[mesh->mName.C_Str()] = std::move(list);
  }
  for (std::size_t m = 0; m < list_of(document, "meshes").size(); ++m) {
    json& mesh = document["meshes"][m];
    mesh.erase("weights");
    const auto known = names.find(mesh.value("name", ""));
    if (known != names.end()) mesh["extras"] = {{"targetNames", known->second}};
  }
}

/// assimp's exporter takes moves below 10 mm or 10 units for none. Its nodes are those of the tree, as it is
/// walked.
void place_nodes(const aiNode& node, json& nodes, std::size_t& next) {
  json& place = nodes.at(next++);
  if (place.value("name", "") != node.mName.C_Str())
    throw ContentError("assimp gives its nodes in another order");
  json matrix = json::array();
  for (unsigned i = 0; i < 16; ++i) matrix.push_back(node.mTransformation[i % 4][i / 4]);
  place["matrix"] = std::move(matrix);
  for (const aiNode* child : std::span(node.mChildren, node.mNumChildren)) place_nodes(*child, nodes, next);
}

/// A node above all, in metres with y up. FBX says in metadata what it is in; COLLADA's unit is in its
/// transforms.
json whole_of(const aiScene& scene) {
  float centimetres = 100;
  int up = 1;  // x, y, z
  if (scene.mMetaData) {
    scene.mMetaData->Get("UnitScaleFactor", centimetres);
    scene.mMetaData->Get("UpAxis", up);
  }
  json whole{{"children", {0}}, {"scale", std::vector<double>(3, static_cast<double>(centimetres) / 100)}};
  if (up == 2) whole["rotation"] = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  return whole;
}

}  // namespace

std::string other_as_gltf(std::string_view bytes, const std::string& ending) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  const aiScene* scene =
      importer.ReadFileFromMemory(bytes.data(), bytes.size(), aiProcess_Triangulate, ending.c_str());
  if (!scene || !scene->HasMeshes())
    throw ContentError(std::string("assimp reads no mesh from it: ") + importer.GetErrorString() +
                       "; export it as GLB or OBJ");
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob = exporter.ExportToBlob(scene, "glb2");
  if (!blob)
    throw ContentError(std::string("assimp cannot turn it into a GLB: ") + exporter.GetErrorString());
  const std::string glb(static_cast<const char*>(blob->data), blob->size);
  const OpenBeside none = [](const std::string&) { return std::nullopt; };
  GltfDocument document(glb, none);
  json& root = document.root;
  name_keys(*scene, root);
  std::size_t next = 0;
  place_nodes(*scene->mRootNode, root["nodes"], next);
  root["scenes"][0]["nodes"] = {root["nodes"].size()};
  root["nodes"].push_back(whole_of(*scene));
  for (std::size_t m = 0; m < list_of(root, "materials").size(); ++m)
    root["materials"][m].erase("extensions");
  return document.serialized({});
}

}  // namespace furrow::io
