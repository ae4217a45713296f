// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string_view>

namespace furrow::io {

/// A file without a name, in the folder of the file that it is for. It takes what is written before the
/// file's head is known, and is gone with the object, or with the process, however that ends. Throws
/// std::runtime_error, which names `path`, where the system refuses.
class Spool {
 public:
  explicit Spool(const std::filesystem::path& path);
  Spool(const Spool&) = delete;
  Spool& operator=(const Spool&) = delete;
  ~Spool();

  /// If it throws (no room left), nothing was appended.
  void append(std::string_view bytes);
  std::size_t size() const { return size_; }  ///< [bytes]
  void copy_to(std::ostream& out) const;

 private:
  std::filesystem::path path_;
  int file_ = -1;
  std::size_t size_ = 0;
};

}  // namespace furrow::io
