// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/spool.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace furrow::io {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw std::runtime_error(path.string() + ": cannot be written: " + std::strerror(errno));
}

/// Some file systems have no O_TMPFILE: there the name is removed at once.
int open_nameless(const std::filesystem::path& folder) {
  const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL)) return file;
  std::string name = (folder / ".furrow-XXXXXX").string();
  const int named = ::mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) ::unlink(name.c_str());
  return named;
}

}  // namespace

Spool::Spool(const std::filesystem::path& path) : path_(path) {
  file_ = open_nameless(path.has_parent_path() ? path.parent_path() : std::filesystem::path("."));
  if (file_ < 0) fail(path_);
}

Spool::~Spool() { ::close(file_); }

void Spool::append(std::string_view bytes) {
  std::size_t end = size_;
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(end));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(path_);
    end += static_cast<std::size_t>(written);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  size_ = end;
}

void Spool::copy_to(std::ostream& out) const {
  std::vector<char> block(std::size_t{1} << 20);
  for (std::size_t begin = 0; begin < size_ && out;) {
    const ssize_t got =
        ::pread(file_, block.data(), std::min(block.size(), size_ - begin), static_cast<off_t>(begin));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail(path_);
    out.write(block.data(), got);
    begin += static_cast<std::size_t>(got);
  }
}

}  // namespace furrow::io
