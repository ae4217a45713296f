// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace furrow::io {

/// Rows of a table in commas (RFC 4180): a field in quotes may hold commas, line ends and doubled quotes;
/// empty lines are skipped, and a byte order mark. Throws geometry::ContentError, with `name` and the line,
/// if a quote is not closed or a row has another number of fields than the first.
std::vector<std::vector<std::string>> parse_csv(std::string_view text, const std::string& name);

}  // namespace furrow::io
