// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "run_furrow.h"

namespace furrow::tests {

/// What a run that must succeed printed.
inline nlohmann::json succeed(const std::string& arguments) {
  const Run run = run_furrow(arguments);
  INFO(arguments << "\n" << run.err);
  REQUIRE(run.exit_code == 0);
  return nlohmann::json::parse(run.out);
}

}  // namespace furrow::tests
