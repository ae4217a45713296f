// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cli/common.h"
#include "io/scene/toml_document.h"

/// The material that a garment's file notes (io/mesh/wrinkle_record.h): what it came to rest with.
namespace furrow::cli {

/// Whether the settings say what kind of cloth it is: preset, membrane, bending_law or stiffness.
bool names_cloth(const io::TomlDocument& document);

/// Takes over each setting of [material] that the garment's file notes and the document does not say; none if
/// the document names another cloth, which goes before it: then it warns if that is not what the garment came
/// to rest with (not for `common` null). Reads the file's header. Returns whether anything was taken.
bool take_recorded_material(io::TomlDocument& document, const std::filesystem::path& garment,
                            const CommonArguments* common);

/// Notes the document's [material] in the garment, and the gap that it kept from a body [m] (0: none).
void note_material(io::MeshFile& file, const io::TomlDocument& document, double contact_gap);

}  // namespace furrow::cli
