// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/field_words.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

namespace furrow::io {

std::string worded(const std::string& text, const std::function<std::string(const NamedField&)>& words) {
  static const std::regex form("`(?:furrow ([a-z]+)(?: |(?=`)))?(?:([a-z][a-z0-9_.]*)(?:=([^`]*))?)?`");
  std::string result;
  std::size_t at = 0;
  for (std::sregex_iterator named(text.begin(), text.end(), form), end; named != end; ++named) {
    if (named->length() == 2) continue;
    result += text.substr(at, std::size_t(named->position()) - at);
    result += words({(*named)[1], (*named)[2], (*named)[3]});
    at = std::size_t(named->position() + named->length());
  }
  return result + text.substr(at);
}

nlohmann::ordered_json with_texts(nlohmann::ordered_json value,
                                  const std::function<std::string(const std::string&)>& change) {
  if (value.is_string()) return change(value.get_ref<const std::string&>());
  if (value.is_structured())
    for (auto& item : value) item = with_texts(std::move(item), change);
  return value;
}

std::string flag_of(const std::string& field, const std::string& value) {
  std::string flag = "--" + field;
  std::ranges::replace(flag, '_', '-');
  return value.empty() ? flag : flag + " " + value;
}

}  // namespace furrow::io
