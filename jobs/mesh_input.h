// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <variant>

#include "jobs/context.h"

/// Meshes that jobs take and give, in their frame.
namespace furrow::jobs {

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

}  // namespace furrow::jobs
