// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_furrow.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace furrow::tests {

Run run_furrow(const std::string& arguments, const std::string& by) {
  const ScratchDirectory scratch;
  const std::string out = scratch / "out", err = scratch / "err";
  const std::string command =
      by + " " FURROW_BINARY_DIR "/furrow " + arguments + " >" + out + " 2>" + err + " </dev/null";
  const int status = std::system(command.c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, read_text(out), read_text(err)};
}

ScratchDirectory::ScratchDirectory() {
  std::string name = (std::filesystem::temp_directory_path() / "furrow-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no scratch directory");
  path_ = name;
}
ScratchDirectory::~ScratchDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string source_file(const std::string& path) { return std::string(FURROW_SOURCE_DIR "/") + path; }

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}
void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace furrow::tests
