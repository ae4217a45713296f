// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/field_words.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

namespace furrow::io {
namespace {

bool is_name(const std::string& word) {
  return !word.empty() && word[0] >= 'a' && word[0] <= 'z' && std::ranges::all_of(word, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
  });
}

/// Of what stands between backticks; none: that names no field.
std::optional<NamedField> named(std::string text) {
  NamedField found;
  if (text.starts_with("furrow ")) {
    const std::size_t end = text.find(' ', 7);
    found.job = text.substr(7, end - 7);
    if (!is_name(found.job)) return std::nullopt;
    if (end == text.npos) return found;
    text.erase(0, end + 1);
  }
  const std::size_t equals = text.find('=');
  found.field = text.substr(0, equals);
  if (equals != text.npos) found.value = text.substr(equals + 1);
  if (!is_name(found.field)) return std::nullopt;
  return found;
}

}  // namespace

std::string worded(const std::string& text, const std::function<std::string(const NamedField&)>& words) {
  std::string result;
  std::size_t at = 0;
  for (std::size_t open = text.find('`'); open != text.npos; open = text.find('`', at)) {
    const std::size_t close = text.find('`', open + 1);
    if (close == text.npos) break;
    const std::optional<NamedField> field = named(text.substr(open + 1, close - open - 1));
    result += text.substr(at, open - at) + (field ? words(*field) : text.substr(open, close - open));
    at = field ? close + 1 : close;
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
