// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/csv.h"

#include <algorithm>

#include "geometry/mesh/errors.h"

namespace furrow::io {
namespace {

[[noreturn]] void refuse_csv(const std::string& name, std::size_t line, const std::string& what) {
  throw geometry::ContentError(name + ":" + std::to_string(line) + ": " + what);
}

/// Reads field by field.
struct CsvCursor {
  std::string_view text;
  const std::string& name;
  std::size_t at = 0, line = 1;

  bool ended() const { return at >= text.size(); }

  std::string quoted() {
    std::string field;
    const std::size_t begun = line;
    for (++at;; ++at) {
      if (ended()) refuse_csv(name, begun, "a quote is not closed");
      if (text[at] == '\n') ++line;
      if (text[at] != '"') {
        field += text[at];
      } else if (at + 1 < text.size() && text[at + 1] == '"') {
        field += text[++at];
      } else {
        ++at;
        break;
      }
    }
    if (!ended() && text[at] != ',' && text[at] != '\n' && text[at] != '\r')
      refuse_csv(name, line, "there is text behind a closed quote");
    return field;
  }

  std::string field() {
    if (!ended() && text[at] == '"') return quoted();
    const std::size_t end = std::min(text.find_first_of(",\r\n", at), text.size());
    const std::string_view found = text.substr(at, end - at);
    at = end;
    return std::string(found);
  }

  /// Behind a field: whether its row goes on.
  bool goes_on() {
    if (!ended() && text[at] == ',') return ++at, true;
    if (!ended() && text[at] == '\r') ++at;
    if (!ended() && text[at] == '\n') ++at, ++line;
    return false;
  }
};

}  // namespace

std::vector<std::vector<std::string>> parse_csv(std::string_view text, const std::string& name) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::vector<std::vector<std::string>> rows;
  for (CsvCursor cursor{text, name}; !cursor.ended();) {
    const std::size_t line = cursor.line;
    std::vector<std::string> row{cursor.field()};
    while (cursor.goes_on()) row.push_back(cursor.field());
    if (row.size() == 1 && row[0].empty()) continue;
    if (!rows.empty() && row.size() != rows[0].size())
      refuse_csv(
          name, line,
          std::to_string(row.size()) + " fields where the heading has " + std::to_string(rows[0].size()));
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace furrow::io
