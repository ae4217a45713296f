// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "io/mesh/mesh_file.h"
#include "io/scene/scene.h"
#include "io/scene/state_file.h"
#include "io/scene/toml_document.h"
#include "io/stroke/drawn_stroke.h"
#include "jobs/listener.h"

/// What jobs take: garments, strokes and scenes in memory or by path, the frame of their files, and who
/// listens.
namespace furrow::jobs {

/// Unit and upward axis of the files that a job reads and writes.
struct Frame {
  /// "m", "cm", "mm" or "inch"; "y" or "z". None: what a file notes of itself, else the noted ones below.
  std::optional<std::string> unit, up;
  std::string noted_unit = "m", noted_up = "y";  ///< what an input notes, for files that note none

  /// The unit and the axis that hold.
  std::string unit_in_use() const { return unit.value_or(noted_unit); }
  std::string up_in_use() const { return up.value_or(noted_up); }
};

/// Whether it is one of the units.
bool is_unit(const std::string& unit);
/// Takes over what the first of these files that notes its unit and axis says of them.
void take_noted_frame(Frame& frame, const std::vector<std::string>& files);

/// Throw std::invalid_argument for a unit that is none.
io::ReadOptions read_options(const Frame& frame);
io::WriteOptions write_options(const Frame& frame);

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

using Json = nlohmann::ordered_json;

/// What every step of a job is given: the frame of its files, who listens, and what is in memory.
struct Context {
  Frame frame;
  Listener& listener;
  const MemoryFiles* memory = nullptr;  ///< null: all is in files

  void warn(std::string code, std::string text, std::string where = "", std::string help = "") const {
    listener.warn({std::move(code), std::move(text), std::move(where), std::move(help)});
  }
};

/// Throws physics::Cancelled if the listener cancels.
void stop_if_cancelled(const Context& context);

/// "3.6 mm".
std::string millimetres(double metres);

/// A mesh in memory (metres, y up), or the file that it is read from. A path may also name one of
/// Context::memory.
using MeshInput = std::variant<std::filesystem::path, io::MeshFile>;

/// The file's path, or `unnamed` for a mesh in memory: for messages.
std::string name_of(const MeshInput& input, const std::string& unnamed);

/// Reads a mesh, in the unit that it notes if the frame says none, and warns of what was repaired. One in
/// memory is copied. Throws as io::read_mesh().
io::MeshFile read_mesh(const MeshInput& input, const Context& context);
/// What is odd about the size of a mesh that is taller than 10 m, with a hint at the unit; else "".
std::string too_tall(const geometry::Mesh& mesh, const std::string& what);
/// As read_mesh(); throws geometry::ContentError for a garment, or what else it is, that is too tall.
io::MeshFile read_garment(const MeshInput& input, const Context& context,
                          const std::string& what = "garment");

/// Warns of vertex attributes that a format other than PLY has no place for; `path` "-" is standard output.
void warn_of_lost_attributes(const std::string& path, const io::MeshFile& file, const Context& context);
/// The file with the frame noted in its wrinkle record, if it has one: as it is to be written.
io::MeshFile with_noted_frame(io::MeshFile file, const Frame& frame);
/// Writes a mesh in the context's frame, whole or not at all. Throws as io::write_mesh(), also for "-".
void write_mesh(const std::filesystem::path& path, const io::MeshFile& file, const Context& context);

/// A scene as a job is given it.
struct SceneInput {
  io::TomlDocument settings;     ///< docs/scenes.md; io::read_toml(), io::set_value()
  std::filesystem::path folder;  ///< that the paths in the settings' file are relative to
  MemoryFiles memory = {};       ///< in place of files
};

/// The scene of a file. Throws as io::read_toml().
SceneInput scene_from_file(const std::filesystem::path& toml);

/// The settings of a scene file, of a saved state (null: none), or of a garment alone. Throws
/// std::invalid_argument if both or neither are named.
io::TomlDocument settings_of(const std::string& scene_or_garment, const std::string& state_path,
                             const std::optional<io::SavedState>& state);

/// Settings that were read, with what the garment's file notes.
struct OpenScene {
  io::Scene scene;
  io::TomlDocument document;
  std::filesystem::path folder;
  Frame frame;
};

/// Whether the name is that of a scene file: it ends in .toml.
bool is_scene(const std::string& path);

/// The document as a scene. Throws std::invalid_argument for a fault of a flag, geometry::ContentError for
/// one of the file.
io::Scene scene_of(const io::TomlDocument& document, const std::filesystem::path& folder);

/// A garment that notes its unit brings it for the body, the strokes and what is written; one in
/// memory has none. Reads the file's header.
void take_noted_frame(io::Scene& scene, io::TomlDocument& document, const MemoryFiles& memory = {});

/// Throws geometry::ContentError for a file that a scene or a state names and that is not there, and says
/// where it is named. `lines_drawn`: rounds of a state that need no file any more; -1: there is no state.
void check_inputs(const io::Scene& scene, const io::TomlDocument& document, int lines_drawn,
                  const MemoryFiles& memory = {});

}  // namespace furrow::jobs
