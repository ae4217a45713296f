// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/print_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "io/base/field_words.h"

namespace furrow::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string plain_text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_null()) return "-";
  if (!value.is_number_float()) return value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return fmt::format("{:.6g}", value.get<double>());
}

/// Objects of plain values, two or more keys each.
bool is_table(const Json& value) {
  if (!value.is_array() || value.empty()) return false;
  return std::all_of(value.begin(), value.end(), [](const Json& row) {
    return row.is_object() && row.size() > 1 &&
           std::none_of(row.begin(), row.end(), [](const Json& item) { return item.is_structured(); });
  });
}

/// The length in characters; bytes that go on a UTF-8 character do not count.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

void print_table(std::ostream& out, const Json& rows, const std::string& indent) {
  std::vector<std::string> keys;
  for (const Json& row : rows)
    for (const auto& [key, item] : row.items())
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  std::vector<std::vector<std::string>> columns;
  for (const std::string& key : keys) {
    std::vector<std::string>& column = columns.emplace_back(1, key);
    for (const Json& row : rows) column.push_back(row.contains(key) ? plain_text_of(row[key]) : "");
    std::size_t width = 0;
    for (const std::string& cell : column) width = std::max(width, width_of(cell));
    for (std::string& cell : column) cell.append(width - width_of(cell), ' ');
  }
  for (std::size_t i = 0; i <= rows.size(); ++i) {
    std::string line = indent;
    for (const auto& column : columns) line += column[i] + "  ";
    out << line.erase(line.find_last_not_of(' ') + 1) << "\n";
  }
}

/// "furrow doctor --repair", "--set body.tolerance=0.01".
std::string flag_words(const io::NamedField& named) {
  std::string words = named.job.empty() ? "" : "furrow " + named.job;
  if (!words.empty() && !named.field.empty()) words += " ";
  if (named.field.find('.') != std::string::npos)
    return words + io::flag_of("set", named.field + (named.value.empty() ? "" : "=" + named.value));
  return words + (named.field.empty() ? "" : io::flag_of(named.field, named.value));
}

}  // namespace

std::string worded(const std::string& text) { return io::worded(text, flag_words); }

Json worded_report(const Json& report) {
  return io::with_texts(report, [](const std::string& text) { return worded(text); });
}

void print_text(std::ostream& out, const Json& value, const std::string& indent) {
  for (const auto& [key, item] : value.items()) {
    out << indent << key << ":";
    if (is_table(item)) {
      out << "\n";
      print_table(out, item, indent + "  ");
    } else if (item.is_structured() && !item.empty() && !(item.is_array() && !item[0].is_structured())) {
      out << "\n";
      print_text(out, item, indent + "  ");
    } else {
      out << " " << plain_text_of(item) << "\n";
    }
  }
}

}  // namespace furrow::cli
