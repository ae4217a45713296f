// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/nesting.h"

#include <algorithm>

namespace furrow::io {

bool is_nested_too_deep(std::string_view json) {
  int level = 0;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '"')
      for (++i; i < json.size() && json[i] != '"'; ++i) i += json[i] == '\\';
    else if (c == '[' || c == '{')
      ++level;
    else if (c == ']' || c == '}')
      --level;
    if (level > most_levels) return true;
  }
  return false;
}

namespace {

/// The place behind a TOML string, or a piece of one, that begins at `at` with a quotation mark.
std::size_t end_of_string(std::string_view toml, std::size_t at) {
  const char quote = toml[at];
  const bool escapes = quote == '"', several_lines = toml.substr(at, 3) == std::string(3, quote);
  const std::string end(several_lines ? 3 : 1, quote);
  for (at += end.size(); at < toml.size(); ++at) {
    if (escapes && toml[at] == '\\') {
      ++at;
      continue;
    }
    if (toml.substr(at, end.size()) == end) return at + end.size();
    if (!several_lines && toml[at] == '\n') return at;
  }
  return toml.size();
}

}  // namespace

int line_of_too_long_key(std::string_view toml) {
  int line = 1, dots = 0;
  for (std::size_t i = 0; i < toml.size();) {
    if (toml[i] == '"' || toml[i] == '\'') {
      const std::size_t end = end_of_string(toml, i);
      for (; i < end; ++i) line += toml[i] == '\n';
      continue;
    }
    if (toml[i] == '#') i = std::min(toml.find('\n', i), toml.size() - 1);
    const char c = toml[i++];
    if (c == '.' && ++dots >= most_levels) return line;
    if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) dots = 0;
    line += c == '\n';
  }
  return 0;
}

std::string too_deep_text() { return "nested more than " + std::to_string(most_levels) + " levels deep"; }

}  // namespace furrow::io
