// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/card_options.h"

#include "cli/common.h"
#include "cli/help.h"
#include "cli/print_text.h"
#include "io/base/field_words.h"

namespace furrow::cli {
namespace {

/// Adds the option of a row, by what its value is.
struct Adder {
  CLI::App& sub;
  const CardRow& row;
  const std::string flag = std::string(row.name == "output" ? "-o," : "") + io::flag_of(row.name);
  const std::string words = worded(described(row, row.range.may_be_infinite));

  void limit(CLI::Option* option, bool is_whole) const {
    const Range& r = row.range;
    if (!r.is_bounded() || r.may_be_infinite) return;  // the job checks it
    if (r.most < HUGE_VAL)
      option->check(is_whole ? CLI::Range(int(r.least), int(r.most)) : CLI::Range(r.least, r.most));
    else if (r.above_least)
      option->check(CLI::PositiveNumber);
    else
      option->check(CLI::NonNegativeNumber);
  }
  CLI::Option* text(const std::function<void(const std::string&)>& set) const {
    return sub.add_option_function<std::string>(flag, set, words);
  }
  void texts(const std::function<void(const std::vector<std::string>&)>& set) const {
    sub.add_option_function<std::vector<std::string>>(flag, set, words)->allow_extra_args(false);
  }

  void operator()(double* x) const { limit(sub.add_option(flag, *x, words), false); }
  void operator()(std::optional<double>* x) const { limit(sub.add_option(flag, *x, words), false); }
  void operator()(int* x) const { limit(sub.add_option(flag, *x, words), true); }
  void operator()(std::optional<int>* x) const { limit(sub.add_option(flag, *x, words), true); }
  void operator()(const Whole& x) const { limit(sub.add_option_function<int>(flag, x.set, words), true); }
  void operator()(bool* x) const { sub.add_flag(flag, *x, words); }
  void operator()(const Flag& f) const {
    sub.add_flag_callback(
        flag, [set = f.set] { set(true); }, words);
  }
  void operator()(std::vector<std::string>* x) const {
    texts([x](const std::vector<std::string>& given) { *x = given; });
  }
  void operator()(std::vector<MeshInput>* x) const {
    texts([x](const std::vector<std::string>& given) { x->assign(given.begin(), given.end()); });
  }
  /// A file, or a text.
  template <class Target>
  void operator()(Target* x) const {
    text([x](const std::string& given) {
      if constexpr (std::is_same_v<Target, std::string>)
        *x = given;
      else
        *x = std::filesystem::path(given);
    });
  }
  void operator()(const Choice& c) const {
    text([c](const std::string& word) {
      c.set(std::size_t(std::find(c.words.begin(), c.words.end(), word) - c.words.begin()));
    })->check(CLI::IsMember(c.words));
  }
  void operator()(const OrAuto& x) const {
    std::vector<std::string> words{"auto"};
    for (int i = int(row.range.least); i <= row.range.most; ++i) words.push_back(std::to_string(i));
    text([number = x.number](const std::string& word) {
      *number = word == "auto" ? std::nullopt : std::optional(std::stoi(word));
    })->check(CLI::IsMember(words));
  }
  void operator()(const Share& x) const {
    text([x, name = io::flag_of(row.name)](const std::string& given) { x.set(parse_share(given, name)); });
  }
  void operator()(const NamedNumbers& x) const {
    texts([x, name = io::flag_of(row.name)](const std::vector<std::string>& given) {
      for (const std::string& pair : given) add_pair(x, name + " " + pair, pair);
    });
  }
  void operator()(const Listed& x) const {
    text([words = x.words, name = io::flag_of(row.name)](const std::string& given) {
      *words = listed(given, name);
    });
  }

  /// "top=0.95". Throws UsageError that tells what to write.
  static void add_pair(const NamedNumbers& x, const std::string& call, const std::string& pair) {
    const auto fail = [&](const std::string& what) { throw UsageError(call + ": " + what + "; " + x.how); };
    const std::size_t equals = pair.find('=');
    if (equals == pair.npos) fail("there is no " + x.number);
    if (equals == 0) fail("there is no " + x.name);
    const std::string number = pair.substr(equals + 1);
    char* end = nullptr;
    const double value = std::strtod(number.c_str(), &end);
    if (number.empty() || *end != 0) fail("'" + number + "' is no number");
    try {
      x.add(pair.substr(0, equals), value);
    } catch (const std::invalid_argument& e) {
      fail(e.what());
    }
  }
  /// Throws UsageError where one is missing.
  static std::vector<std::string> listed(const std::string& given, const std::string& name) {
    std::vector<std::string> words = split_at_commas(given + ",");
    for (std::string& word : words)
      if (CLI::detail::trim(word).empty())
        throw UsageError(name + " '" + given +
                         "': a name is missing; write them separated by commas, as in " + name +
                         " cotton,silk,denim");
    return words;
  }
};

}  // namespace

void add_card(CLI::App& sub, const std::vector<CardRow>& card) {
  for (const CardRow& row : card) {
    begin_group(sub, row.group, row.audience);
    std::visit(Adder{sub, row}, row.value);
  }
}

}  // namespace furrow::cli
