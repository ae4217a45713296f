// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "io/mesh/mesh_file.h"
#include "io/stroke/drawn_stroke.h"

namespace furrow::jobs {

/// What a job has in memory in place of files: settings name it as if it were one. Keys are paths as the
/// program would open them; metres, y up.
struct MemoryFiles {
  std::map<std::string, io::MeshFile> meshes = {};
  std::map<std::string, std::vector<io::DrawnStroke>> strokes = {};

  bool holds(const std::filesystem::path& path) const {
    return meshes.count(path.string()) || strokes.count(path.string());
  }
  const io::MeshFile* find_mesh(const std::filesystem::path& path) const {
    const auto found = meshes.find(path.string());
    return found == meshes.end() ? nullptr : &found->second;
  }
};

}  // namespace furrow::jobs
