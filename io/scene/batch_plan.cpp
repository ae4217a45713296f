// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/batch_plan.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "geometry/mesh/errors.h"
#include "io/base/bytes_file.h"
#include "io/base/control_character.h"
#include "io/base/field_words.h"
#include "io/base/figure_path.h"
#include "io/base/nearest_word.h"
#include "io/scene/csv.h"
#include "io/scene/scene.h"

namespace furrow::io {
namespace {

constexpr std::size_t most_cases = 1000000;

const std::vector<std::string> plan_keys{"title",   "command", "output",  "mesh",
                                         "picture", "report",  "options", "cases"};
const std::vector<std::string> plan_commands{"drape", "simulate", "keep", "wrinkle", "fit"};
const std::vector<std::string> drawing_commands{"drape", "keep", "fit"};
/// What names a file whatever it looks like.
const std::vector<std::string> file_columns{"garment", "body", "made-for", "strokes", "worn"};
/// What a batch gives each case by itself.
const std::vector<std::string> own_columns{"output", "picture", "json", "quiet", "replace", "progress"};

/// Names a folder, which no result depends on.
const std::string cache_column = "cache";

using BatchRow = std::vector<BatchValue>;

bool has(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

[[noreturn]] void fail_at(const TomlDocument& document, const std::string& path, const std::string& what) {
  throw geometry::ContentError(document.place(path) + ": " + path + " " + what);
}

/// Throws for a text that could not stand in one line of a script, a log or a table.
const std::string& without_control(const std::string& text, const std::string& where) {
  if (has_control_character(text))
    throw geometry::ContentError(where + ": " +
                                 Json(text).dump(-1, ' ', false, Json::error_handler_t::replace) +
                                 " has a control character, such as a line end; write it without");
  return text;
}

std::string text_of(const TomlDocument& document, const std::string& path, const Json& value) {
  if (value.is_string()) return without_control(value.get<std::string>(), document.place(path) + ": " + path);
  if (value.is_number()) return value.dump();
  fail_at(document, path, "is neither a text nor a number");
}

/// None: the option is not given.
std::vector<BatchValue> values_of(const TomlDocument& document, const std::string& path,
                                  const std::string& column, const Json& value) {
  if (value.is_boolean()) return value.get<bool>() ? BatchRow{{column, {}}} : BatchRow{};
  if (!value.is_array()) return {{column, {text_of(document, path, value)}}};
  BatchValue all{column, {}};
  for (const Json& one : value) all.texts.push_back(text_of(document, path, one));
  if (all.texts.empty()) fail_at(document, path, "is an empty list");
  return {all};
}

/// The garment, then by the alphabet, as a TOML table has no order.
std::vector<std::string> columns_of(const Json& table) {
  std::vector<std::string> columns;
  for (const auto& [column, list] : table.items()) columns.push_back(column);
  std::sort(columns.begin(), columns.end());
  std::stable_partition(columns.begin(), columns.end(), [](const std::string& c) { return c == "garment"; });
  return columns;
}

/// Each with each, the last column changing fastest.
std::vector<BatchRow> each_with_each(const TomlDocument& document, const Json& table) {
  std::vector<BatchRow> rows{{}};
  for (const std::string& column : columns_of(table)) {
    const std::string path = "cases." + column;
    const Json& list = table[column];
    if (!list.is_array() || list.empty()) fail_at(document, path, "must be a list of what to try");
    if (rows.size() * list.size() > most_cases) fail_at(document, path, "makes more than a million cases");
    std::vector<BatchRow> longer;
    for (const BatchRow& row : rows)
      for (const Json& one : list) {
        longer.push_back(row);
        for (BatchValue& v : values_of(document, path, column, one)) longer.back().push_back(std::move(v));
      }
    rows = std::move(longer);
  }
  return rows;
}

std::vector<BatchRow> rows_of_csv(const std::filesystem::path& path) {
  const std::vector<std::vector<std::string>> table = parse_csv(read_text(path), path.string());
  if (table.size() < 2) throw geometry::ContentError(path.string() + ": there is no case below the heading");
  if (table.size() > most_cases) throw geometry::ContentError(path.string() + ": more than a million cases");
  std::vector<BatchRow> rows;
  for (std::size_t r = 1; r < table.size(); ++r) {
    BatchRow& row = rows.emplace_back();
    for (std::size_t c = 0; c < table[0].size(); ++c) {
      const std::string& cell = without_control(table[r][c], path.string() + ": case " + std::to_string(r));
      if (cell.empty() || cell == "false") continue;
      row.push_back({table[0][c], cell == "true" ? std::vector<std::string>{} : std::vector{cell}});
    }
  }
  return rows;
}

/// Options of all cases that the row does not set, and the row.
BatchRow completed(const BatchRow& options, const BatchRow& row) {
  BatchRow all;
  for (const BatchValue& v : options)
    if (std::none_of(row.begin(), row.end(), [&](const BatchValue& r) { return r.column == v.column; }))
      all.push_back(v);
  all.insert(all.end(), row.begin(), row.end());
  return all;
}

/// Puts the row's other columns where they stand in braces: "shirt-{size}.obj". Returns which were used.
std::set<std::string> fill_in(BatchRow& row) {
  std::set<std::string> used;
  const BatchRow before = row;
  for (BatchValue& v : row)
    for (std::string& text : v.texts)
      for (const BatchValue& other : before) {
        const std::string brace = "{" + other.column + "}";
        for (std::size_t at; other.texts.size() == 1 && (at = text.find(brace)) != std::string::npos;) {
          if (other.column == v.column) break;
          text.replace(at, brace.size(), other.texts[0]);
          used.insert(other.column);
        }
      }
  return used;
}

/// Tells files from words, and what they hold.
class Files {
 public:
  explicit Files(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The file's absolute path, or the text as it stands. Throws geometry::ContentError where there must be
  /// one.
  std::string resolved(const std::string& column, const std::string& text, const std::string& where) {
    const std::filesystem::path path = (folder_ / text).lexically_normal();
    if (column == cache_column) return path.string();
    if (text.size() > 1 && text[0] == '-' && !std::isdigit(text[1]) && text[1] != '.')
      throw geometry::ContentError(where + ": " + column + ": '" + text +
                                   "' is an option and no value; give it a column of its own");
    std::error_code ignored;
    const bool is_file = std::filesystem::is_regular_file(file_of_figure(path), ignored);
    const bool must = has(file_columns, column);
    if (must && !is_file)
      throw geometry::ContentError(where + ": " + column + ": there is no file " + path.string());
    return must || (is_file && text.find_first_of("./") != std::string::npos) ? path.string() : text;
  }

  /// What a text stands for: a file's content, else itself.
  std::string content(const std::string& text) {
    const auto known = hashes_.find(text);
    if (known != hashes_.end()) return known->second;
    std::error_code ignored;
    const bool is_file =
        text.starts_with('/') && std::filesystem::is_regular_file(file_of_figure(text), ignored);
    return hashes_[text] = is_file ? "file " + content_hash(std::filesystem::path(text)) : text;
  }

 private:
  std::filesystem::path folder_;
  std::map<std::string, std::string> hashes_;
};

std::string name_of(const std::string& version, const std::string& command, const BatchRow& row,
                    Files& files) {
  std::vector<std::string> parts;
  for (const BatchValue& v : row) {
    if (v.column == cache_column) continue;
    std::string part = v.column;
    for (const std::string& text : v.texts) part += '\x1f' + files.content(text);
    parts.push_back(part);
  }
  std::sort(parts.begin(), parts.end());
  std::string all = version + '\n' + command;
  for (const std::string& part : parts) all += '\n' + part;
  return content_hash(std::as_bytes(std::span(all.data(), all.size())));
}

BatchCase case_of(const std::string& version, const std::string& command, BatchRow row, Files& files,
                  const std::string& where) {
  BatchCase result;
  const std::set<std::string> used = fill_in(row);
  result.values = row;
  std::erase_if(row, [&](const BatchValue& v) { return used.contains(v.column); });
  for (BatchValue& v : row)
    for (std::string& text : v.texts) text = files.resolved(v.column, text, where);
  result.name = name_of(version, command, row, files);
  for (const BatchValue& v : row)
    if (v.column == "body" && v.texts.size() == 1) result.has_body = true;
  result.arguments = {command};
  for (const BatchValue& v : row) {
    if (has(own_columns, v.column))
      throw geometry::ContentError(where + ": " + v.column + ": a batch names that of each case by itself");
    if (v.column == "garment")
      result.arguments.insert(result.arguments.begin() + 1, v.texts.begin(), v.texts.end());
    if (v.column == "garment") continue;
    if (v.texts.empty()) result.arguments.push_back(flag_of(v.column));
    for (const std::string& text : v.texts) {
      result.arguments.push_back(flag_of(v.column));
      result.arguments.push_back(text);
    }
  }
  if (std::none_of(row.begin(), row.end(), [](const BatchValue& v) { return v.column == "garment"; }))
    throw geometry::ContentError(where + ": a case has no garment; name one in the column 'garment'");
  return result;
}

/// Columns whose values are not the same in all rows.
std::vector<std::string> differing(const std::vector<BatchRow>& rows) {
  std::vector<std::string> order;
  std::map<std::string, std::set<std::string>> seen;
  std::map<std::string, std::size_t> count;
  for (const BatchRow& row : rows)
    for (const BatchValue& v : row) {
      if (!seen.contains(v.column)) order.push_back(v.column);
      seen[v.column].insert(v.words());
      ++count[v.column];
    }
  std::erase_if(order, [&](const std::string& c) { return seen[c].size() == 1 && count[c] == rows.size(); });
  return order;
}

std::string word_of(const TomlDocument& document, const char* key, std::string otherwise) {
  if (!document.root->contains(key)) return otherwise;
  const Json& value = document.root[key];
  if (!value.is_string()) fail_at(document, key, "must be a text");
  return text_of(document, key, value);
}

/// Keys, also those of tables in tables.
void check_names(const Json& table, const std::string& where) {
  if (!table.is_object()) return;
  for (const auto& [key, value] : table.items()) {
    without_control(key, where);
    check_names(value, where);
  }
}

/// All but the cases.
BatchPlan plan_of(const TomlDocument& document, const std::filesystem::path& path) {
  check_names(document.root, document.name);
  for (const auto& [key, value] : document.root->items())
    if (!has(plan_keys, key))
      fail_at(document, key, "is no key of a plan; did you mean '" + nearest_word(key, plan_keys) + "'?");
  BatchPlan plan;
  plan.title = word_of(document, "title", path.stem().string());
  plan.command = word_of(document, "command", "drape");
  if (!has(plan_commands, plan.command))
    fail_at(document, "command", "must be drape, simulate, keep, wrinkle or fit");
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  without_control(folder.string(), "the folder of the plan");
  plan.output = (folder / word_of(document, "output", path.stem().string() + "-results")).lexically_normal();
  plan.mesh = word_of(document, "mesh", plan.command == "fit" ? "" : "ply");
  if (document.root->contains("picture")) {
    if (!document.root["picture"].is_boolean()) fail_at(document, "picture", "must be true or false");
    plan.picture = document.root["picture"].get<bool>();
  }
  if (plan.mesh.empty() && !(plan.picture && plan.draws()))
    throw geometry::ContentError(document.name +
                                 ": cases write neither a mesh nor a picture; set mesh or picture");
  plan.report = {"outcome"};
  if (plan.command == "drape")
    plan.report = {"outcome", "residual_force", "fit.strain.p99", "crossings.pairs"};
  if (document.root->contains("report")) {
    plan.report.clear();
    for (const Json& one : document.root["report"]) plan.report.push_back(text_of(document, "report", one));
  }
  return plan;
}

}  // namespace

std::string BatchValue::words() const {
  if (texts.empty()) return "yes";
  std::string words;
  for (const std::string& text : texts) words += (words.empty() ? "" : ", ") + text;
  return words;
}

bool BatchPlan::draws() const { return has(drawing_commands, command); }

BatchPlan read_batch_plan(const std::filesystem::path& path, const std::string& version) {
  const TomlDocument document = read_toml(path);
  BatchPlan plan = plan_of(document, path);
  BatchRow options;
  if (document.root->contains("options")) {
    if (!document.root["options"].is_object()) fail_at(document, "options", "must be a table");
    for (const auto& [column, value] : document.root["options"].items())
      for (BatchValue& v : values_of(document, "options." + column, column, value))
        options.push_back(std::move(v));
  }
  if (!document.root->contains("cases"))
    throw geometry::ContentError(document.name + ": there is no [cases]; name what to try, or a CSV file");
  const Json& cases = document.root["cases"];
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  if (!cases.is_object() && !cases.is_string())
    fail_at(document, "cases", "must be a table or a CSV file's name");
  const std::string where =
      cases.is_string() ? (folder / cases.get<std::string>()).string() : document.place("cases");
  std::vector<BatchRow> rows = cases.is_string() ? rows_of_csv(where) : each_with_each(document, cases);
  plan.columns = differing(rows);
  Files files(folder);
  std::set<std::string> names;
  for (const BatchRow& row : rows) {
    BatchCase one = case_of(version, plan.command, completed(options, row), files, where);
    if (names.insert(one.name).second)
      plan.cases.push_back(std::move(one));
    else
      ++plan.repeated;
  }
  return plan;
}

}  // namespace furrow::io
