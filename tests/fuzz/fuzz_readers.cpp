// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer's entry for one reader, that of FUZZ_FORMAT; scripts/fuzz builds and runs it. A reader may refuse its bytes
// as content or as a wrong option; anything else is a finding.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "geometry/mesh/errors.h"
#include "io/animation/animation_file.h"
#include "io/base/camera_file.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/scene_file.h"
#include "io/scene/state_file.h"
#include "io/stroke/stroke_file.h"

namespace {

using namespace furrow;

void read_mesh(const std::string& bytes, io::MeshFormat format) {
  std::istringstream in(bytes);
  const io::MeshFile file = io::read_mesh(in, format, "fuzz");
  if (!file.mesh.is_valid(false) || file.mesh.number_of_faces() == 0) __builtin_trap();
  io::find_wrinkle_record(file);
}

/// In memory, as readers of animations and cameras know paths alone.
std::filesystem::path file_of(const std::string& bytes) {
  static const std::filesystem::path path = "/dev/shm/furrow-fuzz-" + std::to_string(::getpid());
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

/// The corpus has four vertices.
void read_frames(const std::string& bytes, bool mdd) {
  const auto frames = io::open_point_cache(file_of(bytes), mdd, 4, {});
  for (std::size_t i = 0; i < frames->frames(); ++i)
    if (frames->positions(i).size() != 4) __builtin_trap();
}

void read(const std::string& bytes) {
  constexpr std::string_view format = FUZZ_FORMAT;
  if (format == "obj") return read_mesh(bytes, io::MeshFormat::obj);
  if (format == "off") return read_mesh(bytes, io::MeshFormat::off);
  if (format == "ply") return read_mesh(bytes, io::MeshFormat::ply);
  if (format == "stl") return read_mesh(bytes, io::MeshFormat::stl);
  if (format == "pc2" || format == "mdd") return read_frames(bytes, format == "mdd");
  if (format == "camera") io::read_camera(file_of(bytes));
  if (format == "strokes") io::drawn_strokes_from(bytes, "fuzz");
  if (format == "scene") io::read_scene(io::parse_toml(bytes, "fuzz"), ".");
  if (format == "state") io::parse_state(bytes, "fuzz");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    read(std::string(reinterpret_cast<const char*>(data), size));
  } catch (const geometry::ContentError&) {
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
