// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/project_files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ostream>
#include <span>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>

#include "io/base/atomic_file.h"
#include "io/base/base64.h"
#include "io/base/json_fields.h"

namespace furrow::jobs {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_regular = std::uintmax_t{1} << 30;  // [bytes]

[[noreturn]] void fail_to_write(const fs::path& path) {
  throw std::runtime_error(path.string() + ": cannot be written: " + std::strerror(errno));
}

/// A regular file, opened over no link and without waiting for anybody; -1, with errno, if that cannot be.
class RegularFile {
 public:
  RegularFile(const fs::path& path, int mode)
      : file_(::open(path.c_str(), mode | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | O_NOCTTY, 0666)) {
    if (file_ < 0 || (::fstat(file_, &status_) == 0 && S_ISREG(status_.st_mode))) return;
    ::close(std::exchange(file_, -1));
    errno = EINVAL;
  }
  ~RegularFile() {
    if (file_ >= 0) ::close(file_);
  }
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  bool is_open() const { return file_ >= 0; }
  int release() { return std::exchange(file_, -1); }
  int number() const { return file_; }
  std::uintmax_t size() const { return static_cast<std::uintmax_t>(status_.st_size); }
  bool has_other_names() const { return status_.st_nlink > 1; }

 private:
  int file_;
  struct stat status_ = {};
};

std::string read_to_end(const RegularFile& file, const std::string& name) {
  if (file.size() > largest_regular) throw geometry::ContentError(name + ": is larger than 1 GiB");
  std::string bytes(file.size(), '\0');
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t got = ::pread(file.number(), bytes.data() + at, bytes.size() - at, off_t(at));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw geometry::ContentError(name + ": cannot be read: " + std::strerror(errno));
    if (got == 0) bytes.resize(at);
    at += std::size_t(got);
  }
  return bytes;
}

bool write_at(int file, std::uintmax_t at, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(file, bytes.data(), bytes.size(), off_t(at));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    at += std::uintmax_t(written);
    bytes.remove_prefix(std::size_t(written));
  }
  return true;
}

}  // namespace

std::optional<std::string> read_regular(const fs::path& path) {
  const RegularFile file(path, O_RDONLY);
  if (file.is_open()) return read_to_end(file, path.string());
  if (errno == ENOENT || errno == ENOTDIR) return std::nullopt;
  if (errno == ELOOP || errno == EINVAL || errno == ENXIO)
    throw geometry::ContentError(path.string() + ": is a link, or no regular file; remove it");
  throw geometry::ContentError(path.string() + ": cannot be read: " + std::strerror(errno));
}

Json parse_json(const std::string& text, const std::string& name) { return io::JsonFields(name).parse(text); }

void write_whole(const fs::path& path, const std::string& bytes) {
  io::write_atomically(path, [&](std::ostream& out) { out << bytes; });
}

std::uintmax_t append_at(const fs::path& path, std::uintmax_t size, const std::string& text) {
  OutputsBelow::check(path);
  const RegularFile file(path, O_RDWR | O_CREAT);
  if (!file.is_open()) fail_to_write(path);
  size = std::min(size, file.size());
  if (file.has_other_names()) {
    write_whole(path, read_to_end(file, path.string()).substr(0, size) + text);
    return size + text.size();
  }
  if ((size < file.size() && ::ftruncate(file.number(), off_t(size)) != 0) ||
      !write_at(file.number(), size, text) || ::fsync(file.number()) != 0) {
    const int why = errno;
    std::ignore = ::ftruncate(file.number(), off_t(size));  // what stays behind it is passed over
    errno = why;
    fail_to_write(path);
  }
  return size + text.size();
}

std::string data_url(const std::string& type, const std::string& bytes) {
  return "data:" + type + ";base64," + io::to_base64(std::as_bytes(std::span(bytes)));
}

FolderLock::FolderLock(const fs::path& folder) {
  const fs::path path = folder / "lock";
  RegularFile file(path, O_RDWR | O_CREAT);
  if (!file.is_open()) fail_to_write(path);
  held_ =
      ::flock(file.number(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;  // or there are no locks here
  file_ = file.release();
}

FolderLock::~FolderLock() { ::close(file_); }

}  // namespace furrow::jobs
