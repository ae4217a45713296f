// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <functional>
#include <type_traits>

#include "jobs/base/inputs.h"

/// The options of a job, each named in one place: a row of the job's card, `std::vector<CardRow> card(Job&)`,
/// bound to the field that it sets. The program's flags (cli/card_options.h), the keywords of Python
/// (python/keywords.h) and the job's checks of ranges are made of it.
namespace furrow::jobs {

/// The groups of --help, in their order; options for few stand in --help-all alone.
enum class Group { options, lines, cloth, body, rest, motion, picture, output };
enum class Audience { everyone, few };

/// What a number may be; infinity only where that is said.
struct Range {
  double least = -HUGE_VAL, most = HUGE_VAL;
  bool above_least = false;  ///< the least itself may not be
  bool may_be_infinite = false, zero_is_none = false;

  bool is_bounded() const { return least > -HUGE_VAL || most < HUGE_VAL; }
  bool holds(double value) const;
  std::string words() const;  ///< "> 0", ">= 0", "in [0, 6]"; "": any
};
inline constexpr Range positive{0, HUGE_VAL, true}, not_negative{0}, endless{0, HUGE_VAL, true, true};
constexpr Range between(double least, double most) { return {least, most}; }

/// A flag that sets something else than a bool that is false without it.
struct Flag {
  std::function<void(bool)> set;
};
/// One of some words.
struct Choice {
  std::vector<std::string> words;
  std::function<void(std::size_t)> set;  ///< by the index of a word
  std::string usual = {};                ///< the word that holds without; "": none
};
/// A whole number that sets more than a field.
struct Whole {
  std::function<void(int)> set;
};
/// A whole number, or "auto" for none.
struct OrAuto {
  std::optional<int>* number;
};
/// A share in (0, 1), or a percentage in (0, 100).
struct Share {
  std::function<void(double)> set;
};
/// Names with a number each: "top=0.95". `add` throws std::invalid_argument for a pair that cannot be.
struct NamedNumbers {
  std::string name, number;  ///< what these are: "loop", "length"
  std::string how;           ///< to write one
  std::function<void(const std::string&, double)> add;
};
/// Words, in one text separated by commas.
struct Listed {
  std::vector<std::string>* words;
};

using Strokes = std::variant<std::filesystem::path, std::vector<io::DrawnStroke>>;
using CardValue =
    std::variant<double*, int*, bool*, std::string*, std::filesystem::path*, std::optional<double>*,
                 std::optional<int>*, std::optional<std::filesystem::path>*, std::vector<std::string>*,
                 MeshInput*, std::optional<MeshInput>*, std::vector<MeshInput>*, Strokes*,
                 std::optional<Strokes>*, Flag, Choice, Whole, OrAuto, Share, NamedNumbers, Listed>;

/// An option of a job.
struct CardRow {
  CardRow(const char* name_, CardValue value_, Range range_, std::string words_)
      : name(name_), value(std::move(value_)), range(range_), words(std::move(words_)) {}
  CardRow(const char* name_, CardValue value_, std::string words_)
      : CardRow(name_, std::move(value_), {}, std::move(words_)) {}
  template <class... More>
  CardRow(const char* name_, Group group_, Audience audience_, CardValue value_, More&&... more)
      : CardRow(name_, std::move(value_), std::forward<More>(more)...) {
    group = group_;
    audience = audience_;
  }

  std::string name;  ///< of Python, and with dashes the flag: "cloth_thickness"
  Group group = Group::options;
  Audience audience = Audience::everyone;
  CardValue value;
  Range range;        ///< of a number
  std::string words;  ///< with the unit; other options by their names, in backticks
};

/// What help says of the option: its words, its range if asked for, and the default that its field has.
std::string described(const CardRow& row, bool with_range);

/// Throws std::invalid_argument for a number out of its range, in the order of the rows.
void check(const std::vector<CardRow>& card);
template <class Job>
void check_card(const Job& job) {
  check(card(const_cast<Job&>(job)));  // which reads alone
}

/// The words and what each means for the field.
template <class Field>
Choice choice(Field& field, const std::type_identity_t<std::vector<std::pair<const char*, Field>>>& words) {
  Choice made{{}, [&field, words](std::size_t i) { field = words[i].second; }};
  for (const auto& [word, value] : words) {
    made.words.push_back(word);
    if (value == field) made.usual = word;
  }
  return made;
}
/// Of the unit of length in files; and unit and axis of all files, with what any job may be allowed.
Choice unit_choice(std::optional<std::string>& unit);
std::vector<CardRow> common_card(Frame& frame, bool& force, bool& replace);

/// A flag that turns a field off.
inline Flag off(bool& field) {
  return {[&field](bool is_on) { field = !is_on; }};
}

}  // namespace furrow::jobs
