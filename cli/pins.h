// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "io/mesh_file.h"
#include "physics/springs.h"

namespace furrow::cli {

/// The vertices that a simulation holds where they are.
struct PinArguments {
  std::vector<std::string> boxes;   ///< x0,y0,z0,x1,y1,z1 [m]
  std::vector<std::string> loops;   ///< top, bottom, or the index of a boundary loop
  std::vector<std::string> groups;  ///< names of groups
  std::vector<int> vertices;        ///< indices
};
void add_pin_options(CLI::App& sub, PinArguments& a);

/// Pins what the arguments name and returns their indices. Throws UsageError for one that names nothing.
std::vector<int> pin(physics::Cloth& cloth, const io::MeshFile& file, const PinArguments& a);

}  // namespace furrow::cli
