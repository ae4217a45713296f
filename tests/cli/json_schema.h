// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace furrow::tests {

/// What is wrong with `value` by this part of a JSON Schema (2020-12), "place: fault" each; empty: it is
/// valid. Knows $ref within `root`, anyOf, enum, type, properties, required, additionalProperties (false),
/// items and minimum. Throws std::logic_error for any other keyword that asserts something, so that none is
/// passed over.
std::vector<std::string> schema_faults(const nlohmann::json& value, const nlohmann::json& schema,
                                       const nlohmann::json& root, const std::string& place = "");

/// The text as JSON, strictly: no NaN, no comments, no key twice in one object. Throws std::exception.
nlohmann::json parse_strictly(const std::string& text);

}  // namespace furrow::tests
