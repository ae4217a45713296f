// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/base/control_character.h"

namespace furrow::io {

/// The text as one word of a POSIX shell: in quotes, unless it is of letters, digits and ./_-=:,+@% alone.
/// Throws std::invalid_argument for a control character: who reads line by line would cut the word.
inline std::string shell_word(std::string_view text) {
  if (has_control_character(text))
    throw std::invalid_argument("a word for a shell has a control character, such as a line end; rename it");
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789./_-=:,+@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string_view::npos) return std::string(text);
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace furrow::io
