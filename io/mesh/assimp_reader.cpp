// SPDX-License-Identifier: GPL-3.0-or-later
// The only source that knows assimp.
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
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

}  // namespace

std::string other_as_gltf(std::string_view bytes, const std::string& ending) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  const aiScene* scene = importer.ReadFileFromMemory(
      bytes.data(), bytes.size(), aiProcess_Triangulate | aiProcess_GlobalScale, ending.c_str());
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
  name_keys(*scene, document.root);
  return document.serialized({});
}

}  // namespace furrow::io
