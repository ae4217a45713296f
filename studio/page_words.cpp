// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/page_words.h"

#include <map>

#include "io/base/field_words.h"

namespace furrow::studio {
namespace {

/// What the page calls it; "": it does not have it.
std::string label_of(const io::NamedField& named) {
  static const std::map<std::string, std::string> labels{
      {"keep", "Keep"},         {"drape", "Drape"}, {"body", "Body"},  {"fabric", "Fabric"},
      {"made_for", "Made for"}, {"unit", "Unit"},   {"up", "Upwards"}, {"width", "Width"}};
  const auto found = labels.find(named.job.empty() ? named.field : named.job);
  if (found == labels.end() || (!named.job.empty() && !named.field.empty())) return "";
  return found->second + (named.value.empty() ? "" : " " + named.value);
}

/// A part of a message between semicolons; "": it is advice that only other faces can follow.
std::string clause_in_page(const std::string& clause, bool is_advice) {
  bool tangles = false, all_known = true;
  const std::string words = io::worded(clause, [&](const io::NamedField& named) {
    tangles = tangles || named.field == "allow_crossings";
    const std::string label = label_of(named);
    all_known = all_known && !label.empty();
    return label.empty() ? named.job + named.field : label;
  });
  if (tangles) return "Tangles (T) shows where, Undo takes it back";
  return is_advice && !all_known ? "" : words;
}

}  // namespace

std::string in_page(const std::string& message) {
  std::string result;
  for (std::size_t begin = 0, end = 0; end != message.npos; begin = end + 2) {
    end = message.find("; ", begin);
    const std::string words = clause_in_page(message.substr(begin, end - begin), begin > 0);
    result += (result.empty() || words.empty() ? "" : "; ") + words;
  }
  return result;
}

}  // namespace furrow::studio
