// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>

#include "io/mesh/mesh_file.h"
#include "io/scene/scene.h"
#include "jobs/base/inputs.h"

/// The material that a garment's file notes (io/mesh/mesh_file.h): what it came to rest with.
namespace furrow::jobs {

/// Whether the settings say what kind of cloth it is: preset, membrane, bending_law, stiffness or bending.
bool names_cloth(const io::TomlDocument& document);

/// Cotton, where they do not; `who` says so. Whether that was done.
bool take_default_cloth(io::TomlDocument& document, const std::string& who);
/// The same for cloth that moves: `xpbd` knows springs alone, so that names them.
bool take_default_moving_cloth(io::TomlDocument& document, const std::string& who);

struct RecordedMaterial {
  bool taken = false;    ///< a setting was
  io::Json other_cloth;  ///< what it came to rest with, where the document names other cloth; else null
};

/// Takes over each setting of [material] that the garment's file notes and the document does not say; none if
/// the document names another cloth, which goes before it. Reads the file's header.
RecordedMaterial take_recorded_material(io::TomlDocument& document, const std::filesystem::path& garment,
                                        const MemoryFiles& memory = {});

/// The garment that settings name, before anything else of them is looked at: what its file notes may be what
/// another setting needs, as rest = "keep" needs hinges. Empty where there is none, or none can be made out
/// (reading the settings tells why). `folder`: as for read_scene().
std::filesystem::path garment_of(const io::TomlDocument& document, const std::filesystem::path& folder);

/// That a garment is other cloth than it came to rest with: a sentence.
std::string words_of_other_cloth(const std::filesystem::path& garment, const io::Json& other_cloth);

/// Notes the document's [material] in the garment, and the gap that it kept from a body [m] (0: none).
void note_material(io::MeshFile& file, const io::TomlDocument& document, double contact_gap);

}  // namespace furrow::jobs
