// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdlib>
#include <filesystem>

namespace furrow::tests {

/// The repository's root.
inline std::filesystem::path source_dir() { return FURROW_SOURCE_DIR; }

/// Where the real meshes and references lie: FURROW_SHARED, or `shared` beside the repository.
/// Not part of the repository: a test that needs it does
///   if (!have_shared()) { WARN("skipped: no shared data"); return; }
inline std::filesystem::path shared_dir() {
  if (const char* dir = std::getenv("FURROW_SHARED")) return dir;
  return source_dir().parent_path() / "shared";
}
inline bool have_shared() { return std::filesystem::exists(shared_dir() / "meshes" / "MANIFEST.md"); }

}  // namespace furrow::tests
