// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/refine/bake_maps.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// A wrinkled mesh, to be baked into textures of the mesh it was made of.
struct BakeJob {
  MeshInput low, high;  ///< with texture coordinates, in one pose
  Frame frame = {};     ///< of the files read and written
  geometry::BakeOptions options = {};
  std::string prefix;  ///< that the names of the files begin with; "": nothing is written or checked
  /// The written map is applied to the low mesh, cut so many times into four, in [0, 6], and compared with
  /// the high mesh.
  std::optional<int> check;
  std::filesystem::path applied;  ///< mesh to write the result of the check to; empty or "-": none
};

/// How far a surface lies from another one, over its area [m].
struct BakeDeviation {
  std::string name;  ///< "to_high", "from_high", "wrinkled_to_high", "wrinkled_from_high"
  double median = 0, p95 = 0, largest = 0;
  double area = 0;  ///< [m^2]
};

/// How well the written maps tell the high mesh.
struct BakeCheck {
  io::MeshFile applied;  ///< the low mesh with the map applied
  std::vector<BakeDeviation> deviations;
};

/// What jobs::bake() did.
struct BakeReport {
  bool ran = false;  ///< false: it was cancelled before anything was written; what follows is empty
  geometry::BakedMaps maps;
  std::optional<BakeCheck> check;  ///< as far as it came
  bool cancelled = false;          ///< after the maps were written
  std::vector<std::string> written;
  Frame frame;   ///< of the files written
  int size = 0;  ///< of the maps [texels]
};

/// Its options (jobs/base/card.h).
std::vector<CardRow> card(BakeJob& job);

/// Bakes the maps (geometry/refine/bake_maps.h) and writes PREFIX_normal.png, PREFIX_displacement.png and
/// PREFIX_maps.json, each whole or not at all. Throws std::invalid_argument for outputs that would replace an
/// input, geometry::ContentError for meshes without texture coordinates or half a diagonal apart.
BakeReport bake(const BakeJob& job, Listener& listener);

/// The report for programs, and what the command line prints. It ran.
Json to_json(const BakeReport& report);

}  // namespace furrow::jobs
