// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "json_schema.h"
#include "run_furrow.h"

namespace furrow::tests {

/// What a run that must succeed printed.
inline nlohmann::json succeed(const std::string& arguments) {
  const Run run = run_furrow(arguments);
  INFO(arguments << "\n" << run.err);
  REQUIRE(run.exit_code == 0);
  return nlohmann::json::parse(run.out);
}

/// The schema of all reports.
inline const nlohmann::json& schema() {
  static const nlohmann::json all = parse_strictly(read_text(source_file("jobs/report.schema.json")));
  return all;
}

/// What is wrong with a report by the schema, a line each.
inline std::string faults_of(const nlohmann::json& report, const std::string& command) {
  std::string text;
  for (const std::string& fault : schema_faults(report, schema()["$defs"][command], schema()))
    text += fault + "\n";
  return text;
}

/// The report of a run that must end with this exit code: strict JSON, and as its schema says.
inline nlohmann::json report_of(const std::string& arguments, int exit_code = 0) {
  const Run run = run_furrow(arguments + " --json");
  INFO(arguments << "\n" << run.err << run.out);
  REQUIRE(run.exit_code == exit_code);
  const nlohmann::json report = parse_strictly(run.out);
  CHECK(faults_of(report, arguments.substr(0, arguments.find(' '))) == "");
  return report;
}

}  // namespace furrow::tests
