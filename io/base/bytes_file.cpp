// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/bytes_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <istream>
#include <ostream>
#include <string_view>

#include "geometry/mesh/errors.h"
#include "io/base/atomic_file.h"
#include "io/base/figure_path.h"

namespace furrow::io {
namespace {

/// Reads a file or stream to its end into any array of bytes.
[[noreturn]] void refuse_size(const std::string& name, std::size_t most) {
  const bool in_gib = most >= std::size_t{1} << 30;
  throw geometry::ContentError(
      name + ": larger than " + std::to_string(most >> (in_gib ? 30 : 20)) +
      (in_gib ? " GiB; give a smaller file" : " MiB, and a device may never end; give a file"));
}

/// `expected` bytes, if they are known, are asked for at once. Throws if there are more than `most`.
template <class Bytes>
Bytes read_all(std::istream& in, const std::string& name, std::size_t expected, std::size_t most) {
  constexpr std::size_t chunk = std::size_t{1} << 16;
  Bytes bytes;
  bytes.resize(expected > 0 ? expected + 1 : 0);  // and one, to see the end
  std::size_t size = 0;
  while (in) {
    if (bytes.size() == size) bytes.resize(std::max(2 * bytes.size(), size + chunk));
    in.read(reinterpret_cast<char*>(bytes.data()) + size, static_cast<std::streamsize>(bytes.size() - size));
    size += static_cast<std::size_t>(in.gcount());
    if (size > most) refuse_size(name, most);
  }
  if (in.bad()) throw geometry::ContentError(name + ": cannot be read: " + std::strerror(errno));
  bytes.resize(size);
  return bytes;
}

/// What a clone holds in place of a large file that was not fetched (Git LFS, docs/spec.md).
bool is_git_lfs_pointer(std::span<const std::byte> bytes) {
  constexpr std::string_view begin = "version https://git-lfs.github.com/spec/";
  return bytes.size() >= begin.size() && std::memcmp(bytes.data(), begin.data(), begin.size()) == 0;
}

template <class Bytes>
Bytes read_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw geometry::ContentError(path.string() + ": is a folder; name a file");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw geometry::ContentError(path.string() + ": cannot be opened: " + std::strerror(errno));
  if (std::filesystem::is_character_file(path, ignored) || std::filesystem::is_block_file(path, ignored))
    return read_all<Bytes>(in, path.string(), 0, largest_device_size);
  std::size_t expected = 0;
  if (std::filesystem::is_regular_file(path, ignored)) expected = std::filesystem::file_size(path, ignored);
  if (ignored) expected = 0;
  if (expected > largest_file_size) refuse_size(path.string(), largest_file_size);
  Bytes bytes = read_all<Bytes>(in, path.string(), expected, largest_file_size);
  if (is_git_lfs_pointer(std::as_bytes(std::span(bytes))))
    throw geometry::ContentError(path.string() +
                                 ": is a pointer of Git LFS, not the file itself; git lfs pull brings that");
  return bytes;
}

}  // namespace

std::string read_text(const std::filesystem::path& path) { return read_file<std::string>(path); }

std::string read_text(std::istream& in, const std::string& name) {
  return read_all<std::string>(in, name, 0, largest_file_size);
}

std::vector<std::byte> read_bytes(const std::filesystem::path& path) {
  return read_file<std::vector<std::byte>>(path);
}

void write_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  write_atomically(path, [bytes](std::ostream& out) {
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  });
}

std::string content_hash(const std::filesystem::path& path) {
  const std::string text = read_text(file_of_figure(path));
  return content_hash(std::as_bytes(std::span(text)));
}

std::string content_hash(std::span<const std::byte> bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const std::byte byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211ull;
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

}  // namespace furrow::io
