// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

namespace furrow::cli {

/// A message, or all those of a report, with the flags of the fields that they name: "--cloth-thickness".
std::string worded(const std::string& text);
nlohmann::ordered_json worded_report(const nlohmann::ordered_json& report);

/// A report for people: a line a key, nested objects indented, lists of objects of the same kind as tables.
void print_text(std::ostream& out, const nlohmann::ordered_json& value, const std::string& indent = "");

}  // namespace furrow::cli
