// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "jobs/base/inputs.h"

/// How jobs read what they take, check it, and write meshes: for jobs and the program alone.
namespace furrow::jobs {

/// Whether it is one of the units.
bool is_unit(const std::string& unit);
/// Takes over what the first of these files that notes its unit and axis says of them.
void take_noted_frame(Frame& frame, const std::vector<std::string>& files);

/// Throw std::invalid_argument for a unit that is none.
io::ReadOptions read_options(const Frame& frame);
io::WriteOptions write_options(const Frame& frame);

/// Throws physics::Cancelled if the listener cancels.
void stop_if_cancelled(const Context& context);

/// The file's path, or `unnamed` for a mesh in memory: for messages.
std::string name_of(const MeshInput& input, const std::string& unnamed);

/// What becomes of a file with lines and without faces (io::ReadOptions::chains).
enum class Chains { refused, taken };

/// Reads a mesh, in the unit that it notes if the frame says none, and warns of what was repaired. One in
/// memory is copied. Throws as io::read_mesh().
io::MeshFile read_mesh(const MeshInput& input, const Context& context, Chains chains = Chains::refused);

/// As read_mesh(), with open seams joined (io/mesh/weld.h), which a warning says, unless the scene's `joins`
/// is false; none: there is no scene. Throws geometry::ContentError for a garment, or what else it is, of an
/// odd size or without area (gate.h).
io::MeshFile read_garment(const MeshInput& input, const Context& context, const std::string& what = "garment",
                          Chains chains = Chains::refused, std::optional<bool> joins = {});

/// Does it; a geometry::ContentError of it then begins with the file's name.
template <class Work>
auto naming(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const geometry::ContentError& e) {
    if (name.empty() || std::string(e.what()).rfind(name, 0) == 0) throw;
    throw geometry::ContentError(name + ": " + e.what());
  }
}

/// Warns of vertex attributes that a format other than PLY has no place for; `path` "-" is standard output.
void warn_of_lost_attributes(const std::string& path, const io::MeshFile& file, const Context& context);

/// The file with the frame noted in its wrinkle record, if it has one: as it is to be written.
io::MeshFile with_noted_frame(io::MeshFile file, const Frame& frame);

/// Writes a mesh in the context's frame, whole or not at all. Throws as io::write_mesh(), also for "-".
void write_mesh(const std::filesystem::path& path, const io::MeshFile& file, const Context& context);

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
