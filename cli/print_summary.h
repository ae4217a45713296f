// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <concepts>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

/// What people are told of a job, in ten lines at most: what happened, what to look at, where it was written,
/// what next. All of it is taken from the report that --json prints; -v prints the rest of that.
namespace furrow::cli {

using Json = nlohmann::ordered_json;

struct Summary {
  std::vector<std::string> lines = {};    ///< what happened, and what to look at; more than eight are cut
  std::vector<std::string> written = {};  ///< files; "" and "-" are passed over
  /// Words of a call that is likely to follow; none: none. Those in capitals are for the user to fill in.
  std::vector<std::string> next = {};
};

using Lines = std::vector<std::string>;
inline constexpr std::size_t most_lines = 8;  ///< about a job; the rest is cut

/// What stands at a key of a report: NaN, "", [], {} and 0 where nothing of that type does.
double value_of(const Json& report, const char* key);
std::string text_of(const Json& report, const char* key);
const Json& list_of(const Json& report, const char* key);
const Json& table_of(const Json& report, const char* key);
long long count_of(const Json& report, const char* key);

std::string number(double value);             ///< of three digits
std::string length_or_unknown(double value);  ///< [m], as people write it
std::string length(const Json& report, const char* key);
std::string per_cent(double share);  ///< what is below a thousandth of a per cent is none
/// "1 face", "3 faces".
std::string counted(std::integral auto n, const std::string& what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}
std::string name_of_line(const Json& line);

/// Whether a rest state holds still: its second derivatives tell nothing where forces do not balance.
std::string balance_of(const Json& rest, const std::string& good, const std::string& shape);
std::string ease_text(const Json& fit);  ///< "chest +7.9 cm, waist +31.9 cm"
void add_fit_lines(Lines& lines, const Json& fit);
void add_crossings(Lines& lines, const Json& report);  ///< what the garment's crossings are, if there are any
void add_heights(Lines& lines, const Json& report);  ///< what lines keep of theirs, and how they are pressed

/// At most ten lines; the last of those about the job says how many are left out.
void print_summary(std::ostream& out, const Summary& summary);

}  // namespace furrow::cli
