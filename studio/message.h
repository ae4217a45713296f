// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "jobs/base/inputs.h"

namespace furrow::studio {

using jobs::Json;

/// Why a message is not done: the sentence that the page shows.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline constexpr std::size_t largest_message = std::size_t{8} << 20;  ///< [bytes]
inline constexpr int deepest_message = 8;                             ///< tables and lists inside each other
inline constexpr std::size_t most_points = 20000;                     ///< of a stroke

/// What a page asks for: its id comes back with the answer.
struct Message {
  Json id;           ///< a number or a text
  std::string what;  ///< "draw", "set", "undo", ...
  Json body;         ///< the whole object
};

/// Throws Refused for what is no JSON object with "id" and "do", for what is nested too deep, and for numbers
/// that are not finite.
Message parse_message(const std::string& text);

/// Values of a message. Throw Refused, naming the key, for one that is missing, of another type, or out of
/// range.
double number_of(const Json& body, const char* key, double least, double most);
std::size_t index_of(const Json& body, const char* key, std::size_t count);
std::string text_of(const Json& body, const char* key, std::size_t longest = 200);
/// A list of at least two points [m].
Json points_of(const Json& body);

}  // namespace furrow::studio
