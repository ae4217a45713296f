// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>

namespace furrow::io {

/// Lets `write` fill a temporary beside `path`, then renames it: a reader sees the old file or the whole new
/// one, after a loss of power, too (both file and folder are synchronised with the disk). A link is followed,
/// also one to a file that is not there yet, and an old file's permissions are kept; other hard links keep
/// the old file. What is not a regular file (a pipe, /dev/null) is written directly. Throws
/// std::runtime_error if the file cannot be written, and what `write` throws; then the temporary is removed
/// and the old file is as it was.
/// \details Temporaries are named ".NAME.furrow-PID-N.tmp" and locked (flock) while they are written. Those
/// of runs that were killed have no lock any more: the next write into their folder removes them.
void write_atomically(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

/// Files that belong together appear together: while one of these lives, what its thread writes by
/// write_atomically() stays in temporaries until commit() renames all of it. Without commit() nothing of it
/// appears. Inside another group it is a part of that one.
class OutputGroup {
 public:
  OutputGroup();
  ~OutputGroup();
  OutputGroup(const OutputGroup&) = delete;
  OutputGroup& operator=(const OutputGroup&) = delete;

  /// Renames all temporaries. Throws std::runtime_error, naming the file, if one cannot be renamed; those
  /// before it are in place then.
  void commit();

 private:
  class Pending;
  friend class OutputAlone;
  friend void write_atomically(const std::filesystem::path&, const std::function<void(std::ostream&)>&);
  static thread_local OutputGroup* outermost_;
  std::unique_ptr<Pending> pending_;  ///< null: part of an outer group
};

/// While one of these lives, what its thread writes appears at once, whatever group it is in.
class OutputAlone {
 public:
  OutputAlone();
  ~OutputAlone();
  OutputAlone(const OutputAlone&) = delete;
  OutputAlone& operator=(const OutputAlone&) = delete;

 private:
  OutputGroup* around_;
};

}  // namespace furrow::io
