// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

namespace furrow::tests {

struct Run {
  int exit_code;  ///< 128 + signal if the program died of one, as a shell says it
  std::string out, err;
};

/// Runs the built program with these arguments (shell syntax), standard input closed; `by` is another program
/// that starts it, such as timeout.
Run run_furrow(const std::string& arguments, const std::string& by = "");

/// A directory of this test's own, empty at the start and gone at the end.
class ScratchDirectory {
 public:
  ScratchDirectory();
  ~ScratchDirectory();
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The path of a file of the source tree.
std::string source_file(const std::string& path);

std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace furrow::tests
