// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/words/command_words.h"

#include <sstream>

#include "io/base/field_words.h"
#include "io/scene/settings_schema.h"

namespace furrow::cli {
namespace {

/// What stands between these marks, parted at `separator`, without the marks.
std::vector<std::string> words_between(const std::string& text, char open, char close, char separator) {
  std::vector<std::string> words;
  const std::size_t begin = text.find(open), end = text.find(close, begin + 1);
  if (begin == std::string::npos || end == std::string::npos) return words;
  std::istringstream list(text.substr(begin + 1, end - begin - 1));
  for (std::string word; std::getline(list, word, separator);) words.push_back(word);
  return words;
}

/// "`leapfrog`, `rk4`" as a setting's range names its words.
std::vector<std::string> quoted_words(const std::string& range) {
  std::vector<std::string> words;
  for (std::size_t begin = range.find('`'); begin != std::string::npos;) {
    const std::size_t end = range.find('`', begin + 1);
    if (end == std::string::npos) break;
    words.push_back(range.substr(begin + 1, end - begin - 1));
    begin = range.find('`', end + 1);
  }
  return words;
}

std::string flag_name(const io::Setting& s) { return io::flag_of(s.keyword); }

/// Of the check that the option has, or of the setting that it sets; a setting's flag has the setting's help.
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::vector<std::string> words = words_between(option.get_type_name(), '{', '}', ',');
  if (!words.empty()) return words;
  const std::string help = option.get_description();
  for (const io::Setting& s : io::scene_settings())
    if (s.kind == io::Kind::choice && !s.keyword.empty() && option.check_name(flag_name(s)) &&
        help == io::described(s, flag_name))
      return quoted_words(s.range);
  return words;
}

OptionWords option_words(const CLI::Option& option) {
  OptionWords words;
  if (option.get_positional() && option.get_lnames().empty()) {
    words.names = {option.get_name(true)};
    words.is_positional = true;
  }
  for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
  if (option.get_items_expected_max() > 0) {
    const std::string type = option.get_type_name();
    words.value = type.substr(0, type.find_first_of(": {"));
    if (words.value.empty()) words.value = "TEXT";
    words.choices = choices_of(option);
  }
  words.help = option.get_description();
  if (!option.get_default_str().empty() && words.help.find("default") == std::string::npos)
    words.help += " (default " + option.get_default_str() + ")";
  words.is_required = option.get_required();
  words.is_repeatable = option.get_items_expected_max() > 1;
  return words;
}

}  // namespace

CommandWords words_of(const CLI::App& app) {
  CommandWords words;
  words.name = app.get_name();
  std::istringstream text(app.get_description());
  std::getline(text, words.summary);
  for (std::string line; std::getline(text, line);)
    if (line.rfind("  furrow", 0) == 0)
      words.examples.push_back(line.substr(2));
    else if (!line.empty())
      words.details += line + "\n";
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) words.options.push_back(option_words(*option));
  return words;
}

std::vector<const CLI::App*> shown_subcommands(const CLI::App& app) {
  std::vector<const CLI::App*> shown;
  for (const CLI::App* sub : app.get_subcommands(nullptr))
    if (!sub->get_group().empty()) shown.push_back(sub);
  return shown;
}

}  // namespace furrow::cli
