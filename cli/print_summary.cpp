// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/print_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/mesh/measures.h"
#include "io/base/shell_word.h"

namespace furrow::cli {

std::string number(double value) { return fmt::format("{:.3g}", value); }

double value_of(const Json& report, const char* key) {
  const auto at = report.find(key);
  return at != report.end() && at->is_number() ? at->get<double>() : NAN;
}

std::string text_of(const Json& report, const char* key) {
  const auto at = report.find(key);
  return at != report.end() && at->is_string() ? at->get<std::string>() : "";
}

const Json& list_of(const Json& report, const char* key) {
  static const Json empty = Json::array();
  const auto at = report.find(key);
  return at != report.end() && at->is_array() ? *at : empty;
}

const Json& table_of(const Json& report, const char* key) {
  static const Json empty = Json::object();
  const auto at = report.find(key);
  return at != report.end() && at->is_object() ? *at : empty;
}

long long count_of(const Json& report, const char* key) {
  const double value = value_of(report, key);
  return std::isfinite(value) ? static_cast<long long>(value) : 0;
}

std::string length_or_unknown(double value) {
  return std::isfinite(value) ? geometry::length_text(value) : "unknown";
}

std::string length(const Json& report, const char* key) { return length_or_unknown(value_of(report, key)); }

std::string per_cent(double share) {
  if (!std::isfinite(share)) return "unknown";
  return number(std::abs(share) < 1e-5 ? 0 : 100 * share) + " %";
}

std::string balance_of(const Json& rest, const std::string& good, const std::string& shape) {
  constexpr double out_of_balance = 1e-6;  // of the weight
  if (!(value_of(rest, "residual") <= out_of_balance)) return "look at: " + shape + " is not in balance";
  if (!rest.value("stable", false)) return "look at: " + shape + " is balanced, but not stable";
  return good + shape + " is at rest, and stable";
}

void add_crossings(Lines& lines, const Json& report) {
  const Json& crossings = table_of(report, "crossings");
  const long long pairs = count_of(crossings, "pairs");
  if (!pairs) return;
  std::string line = "look at: " + counted(pairs, "pair") + " of faces cross";
  if (crossings.contains("new")) line += ", " + std::to_string(count_of(crossings, "new")) + " of them new";
  if (const Json& places = list_of(crossings, "places"); !places.empty())
    line += ", most at (" + number(value_of(places[0], "x")) + ", " + number(value_of(places[0], "y")) +
            ", " + number(value_of(places[0], "z")) + ") m";
  lines.push_back(line);
}

std::string name_of_line(const Json& line) {
  const std::string name = text_of(line, "name");
  return name.empty() ? "line " + std::to_string(count_of(line, "id")) : name;
}

std::string ease_text(const Json& fit) {
  std::string text;
  for (const Json& e : list_of(fit, "ease")) {
    const double ease = value_of(e, "ease");
    if (!std::isfinite(ease)) continue;
    text += (text.empty() ? "" : ", ") + text_of(e, "section") + fmt::format(" {:+.1f} cm", 100 * ease);
  }
  return text;
}

void add_fit_lines(Lines& lines, const Json& fit) {
  const Json& strain = table_of(fit, "strain");
  const Json& distance = table_of(fit, "distance");
  if (!strain.empty())
    lines.push_back("strain: " + per_cent(value_of(strain, "share_over")) + " of the cloth over " +
                    per_cent(value_of(strain, "over")) + ", at most " + per_cent(value_of(strain, "max")));
  if (!distance.empty())
    lines.push_back("distance to the body: " + length(distance, "min") + " to " + length(distance, "p95") +
                    ", half of the cloth nearer than " + length(distance, "median"));
  if (const std::string ease = ease_text(fit); !ease.empty()) lines.push_back("ease: " + ease);
  if (const long long faces = count_of(distance, "pierced_faces"))
    lines.push_back("look at: the body comes through " + counted(faces, "face") + ", by up to " +
                    length(distance, "deepest_penetration"));
}

void add_heights(Lines& lines, const Json& report) {
  constexpr std::size_t most = 4;
  std::string kept, gathered;
  std::size_t known = 0;
  for (const Json& line : list_of(report, "lines")) {
    if (line.contains("gathered"))
      gathered +=
          (gathered.empty() ? "" : ", ") + name_of_line(line) + " " + per_cent(value_of(line, "gathered"));
    if (!std::isfinite(value_of(line, "kept")) || ++known > most) continue;
    kept += (kept.empty() ? "" : ", ") + name_of_line(line) + " " + per_cent(value_of(line, "kept"));
    if (line.contains("press")) kept += " pressed x" + number(value_of(line, "press"));
  }
  if (known > most) kept += " and " + std::to_string(known - most) + " more";
  if (!kept.empty()) lines.push_back("lines keep of their height: " + kept);
  if (!gathered.empty()) lines.push_back("lines are gathered to: " + gathered);
}

void print_summary(std::ostream& out, const Summary& summary) {
  const std::size_t n = summary.lines.size(), shown = n > most_lines ? most_lines - 1 : n;
  for (std::size_t i = 0; i < shown; ++i) out << summary.lines[i] << "\n";
  if (shown < n) out << "and " << n - shown << " lines more, with -v\n";
  std::string written;
  for (const std::string& file : summary.written)
    if (!file.empty() && file != "-") written += (written.empty() ? "" : ", ") + file;
  if (!written.empty()) out << "written: " << written << "\n";
  if (std::ranges::any_of(summary.next, io::has_control_character)) return;  // no line can hold it
  for (std::size_t i = 0; i < summary.next.size(); ++i)
    out << (i == 0 ? "next: " : " ") << io::shell_word(summary.next[i]);
  if (!summary.next.empty()) out << "\n";
}

}  // namespace furrow::cli
