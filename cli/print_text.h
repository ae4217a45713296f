// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <ostream>

namespace furrow::cli {

/// A report for people: a line a key, nested objects indented, lists of objects of the same kind as tables.
void print_text(std::ostream& out, const nlohmann::ordered_json& value, const std::string& indent = "");

}  // namespace furrow::cli
