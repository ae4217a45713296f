// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

namespace furrow::io {

/// While one of these lives, all that its thread writes by write_atomically() lies below this folder and
/// takes the place of regular files alone, and no link leads there from the folder on; else
/// std::runtime_error is thrown, which names the link, before anything is made. The way to the folder itself
/// may be a link. For folders whose content comes from anyone. Inside another one it takes its place. A link
/// that somebody makes between the check and the write is not seen.
class OutputsBelow {
 public:
  explicit OutputsBelow(const std::filesystem::path& folder);
  ~OutputsBelow();
  OutputsBelow(const OutputsBelow&) = delete;
  OutputsBelow& operator=(const OutputsBelow&) = delete;

  /// Throws as above where the thread's present one, if it has one, bars this file or folder.
  static void check(const std::filesystem::path& path);

 private:
  void check_below(const std::filesystem::path& path) const;

  static thread_local const OutputsBelow* present_;
  const std::filesystem::path folder_;  ///< absolute
  const OutputsBelow* const around_;
};

}  // namespace furrow::io
