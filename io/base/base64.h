// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace furrow::io {

/// Bytes as letters, as a data URI has them. Source: RFC 4648, section 4.
std::string to_base64(std::span<const std::byte> bytes);

/// The bytes that such letters stand for, up to the first "="; fill letters may be missing. Throws
/// geometry::ContentError for any other letter.
std::string from_base64(std::string_view text);

}  // namespace furrow::io
