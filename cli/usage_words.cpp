// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/usage_words.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <utility>

#include "io/base/nearest_word.h"
#include "io/scene/fabrics.h"

namespace furrow::cli {

std::string nearest_of(const std::vector<std::string>& words, const std::string& word) {
  std::string nearest;
  std::size_t least = word.size() / 4 + 2;
  for (const std::string& other : words)
    if (const std::size_t d = io::edit_distance(word, other); d < least) {
      least = d;
      nearest = other;
    }
  return nearest;
}

namespace {

/// "; lengths are metres: write 1.68" where the number is a length within the bounds in that unit (m, cm or
/// mm), else "".
std::string in_metres(double number, const std::string& unit, double least, double most) {
  for (const auto& [name, metres] : {std::pair("m", 1.0), {"cm", 1e-2}, {"mm", 1e-3}}) {
    const double length = number * metres;
    if (unit != name || length < least || length > most) continue;
    return fmt::format("; lengths are metres: write {:.9g}", length);
  }
  return "";
}

/// CLI11's message for a word that is no number, in words that help: lengths often come with their unit.
std::string words_of_conversion(const std::string& what) {
  const std::string begin = "Could not convert: ";
  const std::size_t equals = what.find(" = ");
  if (what.rfind(begin, 0) != 0 || equals == std::string::npos) return what;
  const std::string option = what.substr(begin.size(), equals - begin.size()),
                    value = what.substr(equals + 3);
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  return option + " takes a number, not '" + value + "'" +
         (end == value.c_str() || !*end ? "" : in_metres(number, end, -HUGE_VAL, HUGE_VAL));
}

/// "0.9 to 2.5", "0 or more", "more than 0": CLI11 prints the largest number there is where there is no
/// bound.
std::string range_text(double value, double least, double most) {
  if (most < 1e300) return fmt::format("{:.9g} to {:.9g}", least, most);
  return value == least ? fmt::format("more than {:.9g}", least) : fmt::format("{:.9g} or more", least);
}

/// CLI11's message for a number out of its range, in words that help; anything else comes back as it is.
std::string words_of_range(const CLI::App& app, const std::string& what) {
  static const std::regex form("(.*): Value (.*) not in range ([-0-9.]+) to ([-0-9.]+)");
  std::smatch part;
  if (!std::regex_match(what, part, form)) return what;
  const std::string option = part[1], value = part[2];
  double least = std::stod(part[3]), most = std::stod(part[4]);
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  const CLI::App& sub = app.get_subcommands().empty() ? app : *app.get_subcommands().front();
  const CLI::Option* known = sub.get_option_no_throw(option);
  // It prints six decimals; the type says the bounds as they were given: "FLOAT:FLOAT in [1e-07 - 1]".
  static const std::regex exact(".* in \\[(\\S+) - (\\S+)\\]");
  const std::string type = known ? known->get_type_name() : "";
  if (std::smatch bounds; std::regex_match(type, bounds, exact))
    least = std::stod(bounds[1]), most = std::stod(bounds[2]);
  const bool is_length = known && known->get_description().find("[m]") != std::string::npos;
  if (end == value.c_str() || (*end && !is_length)) return option + " takes a number, not '" + value + "'";
  std::string help;
  if (is_length && *end) help = in_metres(number, end, least, most);
  for (const char* unit : {"cm", "mm"})
    if (is_length && !*end && help.empty() && most < 1e300 && number > most)
      help = in_metres(number, unit, least, most);
  return option + " takes a " + (std::isinf(number) ? "finite " : "") + "number, " +
         range_text(number, least, most) + ", not " + value + help;
}

/// CLI11's message for a word that is none of a list, with the nearest one. A file where an action belongs is
/// often a file that the action was forgotten before; a fabric's name, one that is to be shown.
std::string words_of_choice(const std::string& command, const std::string& what) {
  static const std::regex form("(.*): (.*) not in \\{(.*)\\}");
  std::smatch part;
  if (!std::regex_match(what, part, form)) return what;
  const std::string option = part[1], value = part[2];
  std::vector<std::string> words;
  std::istringstream list(part[3]);
  std::string known;
  for (std::string word; std::getline(list, word, ',');) {
    words.push_back(word);
    known += (known.empty() ? "" : ", ") + word;
  }
  std::string text = option + ": '" + value + "' is none of " + known;
  if (const std::string nearest = nearest_of(words, value); !nearest.empty())
    return text + "; did you mean " + nearest + "?";
  if (option != "action") return text;
  if (command == "batch") return text + "; write furrow batch parallel " + value;
  std::vector<std::string> fabrics;
  for (const io::Fabric& fabric : io::fabrics()) fabrics.push_back(fabric.name);
  const std::string fabric = nearest_of(fabrics, value);
  return fabric.empty() ? text : text + "; did you mean furrow " + command + " show " + fabric + "?";
}

}  // namespace

std::string words_of_error(const CLI::App& app, const std::string& command, const std::string& what) {
  return words_of_choice(command, words_of_range(app, words_of_conversion(what)));
}

}  // namespace furrow::cli
