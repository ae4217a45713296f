// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/mesh/mesh_file.h"
#include "io/scene/scene.h"
#include "physics/motion/simulate.h"

namespace furrow::io {

/// A simulation that was stopped: all that is needed to go on with it, bit for bit.
struct SavedState {
  MeshFile file;  ///< the garment as it is now, with attribute::velocity, attribute::mass and rest lengths
  physics::SimulateState simulation;
  geometry::Owned<Json> scene = empty_table();  ///< its settings (docs/scenes.md); paths relative to the
                                                ///< state's folder
  std::vector<std::vector<int>> pins;           ///< the vertices of each of the scene's pins
  std::string body;     ///< what the contact memory is about (WorldBody::fingerprint); "" without
  int lines_drawn = 0;  ///< rounds of the scene's lines that are in the garment already
  /// At which the cloth has rested on the body so far [m]; 0: on none yet. A line's short edges do not lower
  /// it: what lies on the body stays there.
  double contact_gap = 0;
  std::optional<physics::Integrator>
      integrator;              ///< that was chosen for its plan; none: the settings name one
  double field_tolerance = 0;  ///< of the body's field, where a small gap asked for a finer one [m]; else 0
};

/// The file is a binary PLY that other programs open as a mesh: velocities, contact memory and compensating
/// forces are scalar columns of the vertices (vx, …); rest lengths, rest angles and stiffnesses columns of
/// edges and faces, struts an element of their own (docs/rest-state.md); time, step, plan, scene and lines
/// are comments (`furrow state {…}`, JSON in one line). Metres, y up. Reading and writing again gives the
/// same bytes.
void write_state(const std::filesystem::path& path, SavedState state);
/// The file's bytes, as a string.
std::string state_bytes(SavedState state);

/// Throws geometry::ContentError if the file is no state or damaged.
SavedState read_state(const std::filesystem::path& path);
SavedState parse_state(const std::string& bytes, const std::string& name);

/// What belongs to a cloth in motion is taken away; what is left is an ordinary garment.
void drop_motion(MeshFile& file);

}  // namespace furrow::io
