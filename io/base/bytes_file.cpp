// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/bytes_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <istream>
#include <ostream>

#include "geometry/mesh/errors.h"
#include "io/base/atomic_file.h"

namespace furrow::io {
namespace {

/// Reads a file or stream to its end into any array of bytes.
template <class Bytes>
Bytes read_all(std::istream& in, const std::string& name) {
  constexpr std::size_t chunk = std::size_t{1} << 16;
  Bytes bytes;
  std::size_t size = 0;
  while (in) {
    if (bytes.size() < size + chunk) bytes.resize(std::max(2 * bytes.size(), size + chunk));
    in.read(reinterpret_cast<char*>(bytes.data()) + size, static_cast<std::streamsize>(bytes.size() - size));
    size += static_cast<std::size_t>(in.gcount());
    if (size > largest_file_size)
      throw geometry::ContentError(name + ": larger than 4 GiB; give a smaller file");
  }
  if (in.bad()) throw geometry::ContentError(name + ": cannot be read: " + std::strerror(errno));
  bytes.resize(size);
  return bytes;
}

template <class Bytes>
Bytes read_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw geometry::ContentError(path.string() + ": is a folder; name a file");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw geometry::ContentError(path.string() + ": cannot be opened: " + std::strerror(errno));
  return read_all<Bytes>(in, path.string());
}

}  // namespace

std::string read_text(const std::filesystem::path& path) { return read_file<std::string>(path); }

std::string read_text(std::istream& in, const std::string& name) { return read_all<std::string>(in, name); }

std::vector<std::byte> read_bytes(const std::filesystem::path& path) {
  return read_file<std::vector<std::byte>>(path);
}

void write_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  write_atomically(path, [bytes](std::ostream& out) {
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  });
}

std::string content_hash(const std::filesystem::path& path) {
  const std::string text = read_text(path);
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
