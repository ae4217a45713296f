// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>

/// How deep data may be nested in files from anywhere: what copies and prints them calls itself once a level.
namespace furrow::io {

/// Levels of arrays and tables within each other; no file that is meant needs a tenth of them.
constexpr int most_levels = 100;

/// Whether a JSON text opens more levels than that. O(length); nothing is parsed.
bool is_nested_too_deep(std::string_view json);
/// The line, from 1, where a TOML text has a key of more parts than that, as a.b.c has three; 0: none. The
/// parser limits the depth of values itself. O(length).
int line_of_too_long_key(std::string_view toml);
/// "nested more than 100 levels deep".
std::string too_deep_text();

}  // namespace furrow::io
