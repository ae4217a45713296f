// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/gltf_source.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/polygon_soup.h"

namespace furrow::io {

/// What the child process of the glTF reader sends.
struct SoupFile {
  PolygonSoup soup;
  std::vector<std::string> group_names, material_names, warnings;
  std::size_t merged_vertices = 0;
  GltfSource gltf;  ///< of as many places as groups, and materials as names
};

/// Reads a glTF or GLB of these bytes, also one packed by Draco or meshoptimizer. Hostile bytes may take time
/// and memory: to be called in a child. `figure` as in gltf_mesh_nodes(). Throws
/// geometry::ContentError for what cannot be used.
SoupFile read_gltf_soup(std::string_view bytes, const std::string& figure, const OpenBeside& open,
                        const ReadOptions& options);

/// As bytes for the same machine (not for files), and back.
std::string to_bytes(const SoupFile& file);
/// Throws geometry::ContentError if the bytes are not what to_bytes() makes, or their arrays do not fit
/// together (lengths; positions not finite; corners beyond the last point). Allocates no more than the bytes
/// hold.
SoupFile soup_from_bytes(std::string_view bytes);

}  // namespace furrow::io
