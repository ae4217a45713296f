// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

namespace furrow::studio {

inline constexpr std::size_t largest_upload = std::size_t{64} << 20;  ///< [bytes]

/// A file that a page has sent.
struct Upload {
  std::string name;  ///< letters, digits, '-', '_' and one ending alone: no path
  std::string bytes;
};

/// The files that pages have sent and that nobody has opened yet: the latest few, in memory. From any thread.
class Uploads {
 public:
  /// What stands for it in a message; "" where the name is none of a mesh that is written.
  std::string put(const std::string& name, std::string bytes);
  /// Takes it out; none: there is none of that number any more.
  std::optional<Upload> take(const std::string& number);

 private:
  struct Kept {
    std::string number;
    Upload upload;
  };
  std::mutex mutex_;
  std::deque<Kept> kept_;
  unsigned next_ = 1;
};

}  // namespace furrow::studio
