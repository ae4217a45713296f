// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <string>

namespace furrow::io {

/// How one comes to what a file holds that many processes need.
struct ShareSteps {
  std::function<void()> read;   ///< throws std::exception for a file that cannot be used
  std::function<void()> make;   ///< the same without the file; what it throws, share_file() throws
  std::function<void()> write;  ///< the file, of what was made; whole or not at all
  std::function<void()> wait;   ///< asked every 20 ms while another process makes it; may throw
};

struct ShareReport {
  bool made = false;      ///< else it was read
  std::string broken;     ///< why a file that was there could not be used; "": it could, or there was none
  std::string unwritten;  ///< why what was made is not in the file now; "": it is
};

/// Reads the file; where it is not there, or cannot be used, makes what it holds and writes it. One process
/// makes it, others wait for it, by a lock in a file beside it that ends with the process. Folders are made.
/// Where neither lock nor file can be written, it is made all the same.
ShareReport share_file(const std::filesystem::path& path, const ShareSteps& steps);

}  // namespace furrow::io
