// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace furrow::io {

/// Files above this are refused, so that an endless one (a device) does not fill the memory [bytes].
inline constexpr std::size_t largest_file_size = std::size_t{4} << 30;

/// The same of a device, such as /dev/zero, whose size is not known [bytes].
inline constexpr std::size_t largest_device_size = std::size_t{64} << 20;

/// The whole file. Throws geometry::ContentError if it is missing, a folder, unreadable or above
/// largest_file_size, which is said before it is read.
std::string read_text(const std::filesystem::path& path);
/// The rest of a stream; `name` stands in messages.
std::string read_text(std::istream& in, const std::string& name);
/// The same as bytes, for a saved distance field, for example.
std::vector<std::byte> read_bytes(const std::filesystem::path& path);
/// Writes by write_atomically(), and throws what that throws.
void write_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// 16 hexadecimal digits that tell one file's content from another's (not safe against forgery). Throws what
/// read_text() throws. Source: FNV-1a, 64 bits (RFC 9923).
std::string content_hash(const std::filesystem::path& path);  // of a figure: of its file
std::string content_hash(std::span<const std::byte> bytes);

}  // namespace furrow::io
