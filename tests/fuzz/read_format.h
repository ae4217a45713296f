// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/mesh.h"
#include "io/animation/animation_file.h"
#include "io/base/camera_file.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/soup_bytes.h"
#include "io/scene/scene_file.h"
#include "io/scene/state_file.h"
#include "io/stroke/stroke_file.h"

namespace furrow::fuzz {

/// Of tests/fuzz/corpus, a folder each: the formats of meshes that are read from a text, and the rest.
inline std::vector<std::string> formats() {
  std::vector<std::string> names{"pc2", "mdd", "camera", "strokes", "scene", "state", "packed"};
  for (const io::MeshEnding& e : io::mesh_endings())
    if (e.read) names.emplace_back(e.text.substr(1));
  return names;
}

inline void require(bool held) {
  if (!held) throw std::logic_error("a reader gave what it promises not to give");
}

inline void read_mesh(const std::string& bytes, io::MeshFormat format) {
  std::istringstream in(bytes);
  const io::MeshFile file = io::read_mesh(in, format, "fuzz");
  require(file.mesh->is_valid(false) && file.mesh->number_of_faces() > 0);
  io::find_wrinkle_record(file);
}

/// In memory where there is such a folder, as readers of animations and cameras know paths alone.
class FileOf {
 public:
  explicit FileOf(const std::string& bytes) {
    const std::filesystem::path memory = "/dev/shm";
    path_ = (std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path()) /
            ("furrow-fuzz-" + std::to_string(::getpid()));
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  FileOf(const FileOf&) = delete;
  FileOf& operator=(const FileOf&) = delete;
  ~FileOf() {
    std::error_code none;
    std::filesystem::remove(path_, none);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The corpus has four vertices.
inline void read_frames(const std::string& bytes, bool mdd) {
  const FileOf file(bytes);
  const auto frames = io::open_point_cache(file.path(), mdd, 4, {});
  for (std::size_t i = 0; i < frames->frames(); ++i) require(frames->positions(i).size() == 4);
}

/// Read in this process, not in a child.
inline void read_gltf(const std::string& bytes) {
  io::read_gltf_soup(bytes, "", [](const std::string&) { return std::nullopt; }, {});
}

inline void read(std::string_view format, const std::string& bytes) {
  if (const io::MeshEnding* mesh = io::find_mesh_ending("fuzz." + std::string(format)))
    return read_mesh(bytes, mesh->format);
  if (format == "pc2" || format == "mdd") return read_frames(bytes, format == "mdd");
  if (format == "camera") io::read_camera(FileOf(bytes).path());
  if (format == "strokes") io::drawn_strokes_from(bytes, "fuzz");
  if (format == "scene") io::read_scene(io::parse_toml(bytes, "fuzz"), ".");
  if (format == "state") io::parse_state(bytes, "fuzz");
  if (format == "packed") read_gltf(bytes);
}

/// Reads, or refuses as content or as a wrong option: true and false. Anything else is a finding, and thrown
/// on.
inline bool reads(std::string_view format, const std::string& bytes) {
  try {
    read(format, bytes);
    return true;
  } catch (const geometry::ContentError&) {
  } catch (const std::invalid_argument&) {
  }
  return false;
}

}  // namespace furrow::fuzz
