// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>

#include "io/mesh/mesh_file.h"
#include "io/mesh/polygon_soup.h"

/// The readers behind read_mesh(), one source a format. `text` is the whole file, `name` stands in messages.
/// All throw geometry::ContentError with name and line (text) or element (binary).
namespace furrow::io {

/// Wavefront OBJ: v (with w, or red green blue [alpha]), vt, f, l, g, o, usemtl, mtllib; indices from 1 or
/// negative; continued lines. vn, vp, p, s and free-form geometry are passed over, unknown words with one
/// warning.
MeshFile read_obj(std::string_view text, const std::string& name, const ReadOptions& options);
/// A polyline and the object (`o`), or else the group (`g`), that it belongs to; "" = none.
struct NamedPolyline : Polyline {
  std::string name;
};
/// Only the polylines of an OBJ file, which needs no faces: object by object, two-point elements chained
/// within each.
std::vector<NamedPolyline> read_obj_polylines(std::string_view text, const std::string& name,
                                              const ReadOptions& options);
/// Stanford PLY, ascii and binary of both byte orders, with our own properties (decision 0005). Other
/// numbers at vertices become vertex attributes.
MeshFile read_ply(std::string_view text, const std::string& name, const ReadOptions& options);
/// glTF and GLB by assimp, in a child process with limits: single precision, vertices of equal position in
/// one node merged; skin weights become vertex attributes. A skinned mesh lies where its skin's bind pose is,
/// its node's transform does not count. Throws geometry::ContentError too if the child crashes, hangs or
/// sends nonsense.
MeshFile read_gltf(const std::filesystem::path& path, const ReadOptions& options);

/// The mesh of a soup put into the file's other content; `chains` as in soup_to_mesh().
void set_mesh(MeshFile& file, const PolygonSoup& soup, const std::string& name, bool chains = false);

}  // namespace furrow::io
