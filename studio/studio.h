// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "jobs/base/inputs.h"
#include "studio/replay.h"

namespace furrow::studio {

/// Where a studio finds what comes with it, and puts drawings that are begun in the page.
struct Places {
  std::filesystem::path gallery;         ///< folder of scenes; empty: there is none
  std::filesystem::path drawings = ".";  ///< folder in which their projects are made
  /// Shows a folder to the user, in whatever shows folders here; null: nothing does.
  std::function<void(const std::filesystem::path&)> show_folder = {};
};

/// A studio that serves one drawing at a time to pages on this machine, in threads of its own, from its
/// making until its end. All that was done is in the project's folder then.
class Studio {
 public:
  /// Nothing is open: a page chooses from the gallery, or sends files.
  explicit Studio(const Places& places, unsigned short port = 0);
  /// Begins a drawing in the folder, or goes on with the one that is there. `port` 0: a free one. `made_for`:
  /// body that the garment lies about, if that of the scene is to wear it; empty: it lies about that. Throws
  /// std::invalid_argument for a folder that cannot be taken and for settings that cannot be,
  /// geometry::ContentError for files that cannot be used, std::runtime_error if no port can be had.
  Studio(const jobs::SceneInput& scene, const std::filesystem::path& folder, unsigned short port = 0,
         const Places& places = {}, const std::filesystem::path& made_for = {});
  /// Goes on with a project.
  explicit Studio(const std::filesystem::path& folder, unsigned short port = 0, const Places& places = {});
  ~Studio();
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  static bool is_project(const std::filesystem::path& folder);
  /// The page's address with its token: whoever knows it may draw.
  std::string url() const;
  unsigned short port() const;
  const std::string& token() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace furrow::studio
