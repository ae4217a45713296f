// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/message.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace furrow::studio {
namespace {

const Json& value_of(const Json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end()) throw Refused(std::string("the message has no '") + key + "'");
  return *found;
}

std::string range_text(double least, double most) {
  return "in [" + Json(least).dump() + ", " + Json(most).dump() + "]";
}

}  // namespace

Message parse_message(const std::string& text) {
  if (text.size() > largest_message) throw Refused("the message is longer than 8 MiB");
  const auto limit = [](int depth, Json::parse_event_t, Json&) {
    if (depth > deepest_message) throw Refused("the message is nested too deep");
    return true;
  };
  Message message;
  try {
    message.body = Json::parse(text, limit);
  } catch (const Json::exception&) {
    throw Refused("the message is no JSON");
  }
  if (!message.body.is_object()) throw Refused("the message is no JSON object");
  message.id = value_of(message.body, "id");
  if (!message.id.is_number_integer() &&
      !(message.id.is_string() && message.id.get_ref<const std::string&>().size() <= 64))
    throw Refused("'id' is neither a whole number nor a text");
  message.what = text_of(message.body, "do", 32);
  return message;
}

double number_of(const Json& body, const char* key, double least, double most) {
  const Json& value = value_of(body, key);
  const double number = value.is_number() ? value.get<double>() : NAN;
  if (!(number >= least && number <= most))
    throw Refused(std::string(key) + ": " + (value.is_number() ? value.dump() : "what was sent") +
                  " is no number " + range_text(least, most));
  return number;
}

std::size_t index_of(const Json& body, const char* key, std::size_t count) {
  const Json& value = value_of(body, key);
  if (!value.is_number_unsigned() || value.get<std::size_t>() >= count)
    throw Refused(std::string(key) + ": there is none of that number");
  return value.get<std::size_t>();
}

std::string text_of(const Json& body, const char* key, std::size_t longest) {
  const Json& value = value_of(body, key);
  if (!value.is_string() || value.get_ref<const std::string&>().size() > longest)
    throw Refused(std::string(key) + ": is no text of at most " + std::to_string(longest) + " characters");
  return value.get<std::string>();
}

Json points_of(const Json& body) {
  const Json& points = value_of(body, "points");
  if (!points.is_array() || points.size() < 2 || points.size() > most_points)
    throw Refused("points: a line has 2 to " + std::to_string(most_points) + " points");
  for (const Json& point : points) {
    if (!point.is_array() || point.size() != 3) throw Refused("points: each is three numbers");
    for (const Json& x : point)
      if (!x.is_number() || !(std::abs(x.get<double>()) < 1e6))
        throw Refused("points: each is three numbers");
  }
  return points;
}

}  // namespace furrow::studio
