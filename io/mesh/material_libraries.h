// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

namespace furrow::io {

/// The folder that a file lies in, "." for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// What stands behind the `mtllib` of an OBJ in the folder `there`, as an OBJ in the folder `here` has to say
/// it: relative to that, so that textures that the library names are found as before. It is one file, whose
/// name may have blanks, or several. Names that are not relative, and files that are not there, stay as they
/// are, all of it where a folder is not there or empty ("", not known). Nothing is read or written.
std::string library_from(const std::string& library, const std::filesystem::path& there,
                         const std::filesystem::path& here);

}  // namespace furrow::io
