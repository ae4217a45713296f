// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

namespace furrow::cli {

/// A file or folder that comes with the program, such as "meshes/mannequin.obj": in share/furrow where it is
/// installed, in the source tree where it was built; empty: there is none.
std::filesystem::path shipped(const std::string& name);

}  // namespace furrow::cli
