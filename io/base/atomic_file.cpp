// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

namespace furrow::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw std::runtime_error(path.string() + ": cannot be written: " + why);
}

/// An empty file beside the target that did not exist before; removed again unless renamed.
class Temporary {
 public:
  explicit Temporary(const fs::path& target) {
    static std::atomic<unsigned> number{0};
    const std::string stem = "." + target.filename().string() + "." + std::to_string(::getpid()) + "-";
    for (int file = -1; file < 0;) {
      path_ = target.parent_path() / (stem + std::to_string(number++) + ".tmp");
      file = ::open(path_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
      if (file < 0 && errno != EEXIST) fail(target, std::strerror(errno));
      if (file >= 0) ::close(file);
    }
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    std::error_code ignored;
    if (!renamed_) fs::remove(path_, ignored);
  }

  const fs::path& path() const { return path_; }

  void rename_to(const fs::path& target) {
    std::error_code error;
    fs::rename(path_, target, error);
    if (error) fail(target, error.message());
    renamed_ = true;
  }

 private:
  fs::path path_;
  bool renamed_ = false;
};

void fill(const fs::path& path, const fs::path& shown, const std::function<void(std::ostream&)>& write) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  if (!out) fail(shown, std::strerror(errno));
  write(out);
  out.close();
  if (!out) fail(shown, errno ? std::strerror(errno) : "unknown reason");
}

}  // namespace

void write_atomically(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  const bool exists = fs::exists(status);
  if (fs::is_directory(status)) fail(path, "it is a folder");
  if (exists && !fs::is_regular_file(status)) return fill(path, path, write);
  const fs::path target = exists ? fs::canonical(path) : path;
  Temporary temporary(target);
  fill(temporary.path(), path, write);
  if (exists) fs::permissions(temporary.path(), status.permissions(), ignored);
  temporary.rename_to(target);
}

}  // namespace furrow::io
