// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/base/require.h"

#include <catch2/catch.hpp>
#include <limits>

using furrow::physics::refuse;
using furrow::physics::require;

namespace {

/// What a refusal says; empty if nothing was refused.
template <class Call>
std::string said(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("require: a refusal names operation, option, value and range") {
  CHECK(said([] { require("settle", "gap", -1, false, "> 0"); }) == "settle: gap = -1.000000 is not > 0");
  CHECK(said([] { require("settle", "gap", 1e-3, true, "> 0"); }).empty());
}

TEST_CASE("require: no value that is infinite or no number is good") {
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
  CHECK(said([&] { require("settle", "gap", infinity, true, "> 0"); }) == "settle: gap = inf is not > 0");
  CHECK(said([&] { require("settle", "friction", nan, true, "finite"); }) ==
        "settle: friction = nan is not finite");
}

TEST_CASE("refuse: parts stand as a stream shows them") {
  CHECK(said([] { refuse("simulate", "dt = ", 0.1, " s, ", 3, " steps"); }) ==
        "simulate: dt = 0.1 s, 3 steps");
}
