// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/mesh_file.h"

namespace furrow::io {

/// What an ending of names of files stands for. The table of them, in mesh_formats.cpp, is the one place that
/// lists formats: reading, writing, messages, help, sequences and the tests of damaged files follow it.
struct MeshEnding {
  std::string_view text;  ///< ".obj"
  MeshFormat format;
  bool keeps_order = true;  ///< whether vertices come back in the order in which they were written
  /// Reads a whole text; `name` stands in messages. Null: files are read only by their paths.
  MeshFile (*read)(std::string_view text, const std::string& name, const ReadOptions& options) = nullptr;
  /// Writes, and returns what is left out, a sentence each; `folder` is that of the file, if it is known.
  /// Null: such files are read only, and `instead` says what to write.
  std::vector<std::string> (*write)(std::ostream& out, const MeshFile& file, const WriteOptions& options,
                                    const std::filesystem::path& folder) = nullptr;
  const char* instead = "";
  /// Whether furrow wrote a file that begins (16 MiB) and ends (100 bytes) so; null: none is known.
  bool (*is_own)(std::string_view head, std::string_view tail) = nullptr;
};

/// All of them, in the order in which sentences list them.
std::span<const MeshEnding> mesh_endings();
/// That of a file's name, in any case of letters; null: there is none.
const MeshEnding* find_mesh_ending(const std::filesystem::path& path);
/// Those that keep the order of vertices, for a sentence: "obj, ply or off".
std::string mesh_formats_in_order();

}  // namespace furrow::io
