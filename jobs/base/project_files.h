// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "geometry/mesh/errors.h"
#include "io/base/outputs_below.h"
#include "jobs/base/inputs.h"

/// Files of a folder that an interactive program keeps, and whose content may come from anyone: nothing but
/// regular files is opened, and nothing is written over a link.
namespace furrow::jobs {

using io::OutputsBelow;

/// What the file holds; none: nothing is there. Throws geometry::ContentError for a link, a folder, a pipe or
/// a device, and for a file that cannot be read or is larger than 1 GiB.
std::optional<std::string> read_regular(const std::filesystem::path& path);

/// Throws geometry::ContentError, with line and column, for what is no JSON or is nested more than 100 levels
/// deep.
Json parse_json(const std::string& text, const std::string& name);

/// Writes a file whole or not at all, after a loss of power, too (io/base/atomic_file.h).
void write_whole(const std::filesystem::path& path, const std::string& bytes);

/// Writes text behind the first `size` bytes of a file, in place of what stood there, and returns its new
/// length; one that is not there is made. Throws std::runtime_error if it cannot be written, and then the
/// first `size` bytes are as they were. Another name of the file (a hard link) keeps the old content.
std::uintmax_t append_at(const std::filesystem::path& path, std::uintmax_t size, const std::string& text);

/// The bytes as an address of their own, by which a page shows them; `type`: "image/png".
std::string data_url(const std::string& type, const std::string& bytes);

/// A folder that one program has for itself, by the lock of a file "lock" in it, which ends with the program,
/// however that ends.
class FolderLock {
 public:
  /// Throws std::runtime_error where that file cannot be made.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  /// False: another program has it.
  bool is_held() const { return held_; }

 private:
  int file_;
  bool held_;
};

}  // namespace furrow::jobs
