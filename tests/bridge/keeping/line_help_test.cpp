// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/keeping/line_help.h"

#include <catch2/catch.hpp>

using namespace furrow;
using bridge::HelpedLine;

namespace {

/// Lines that have had these steps of help.
std::vector<HelpedLine> lines_at(const std::vector<int>& steps) {
  std::vector<HelpedLine> lines;
  for (const int step : steps) lines.push_back({int(lines.size()), {}, 0.01, step});
  return lines;
}

std::vector<int> steps_of(const std::vector<HelpedLine>& lines) {
  std::vector<int> steps;
  for (const HelpedLine& line : lines) steps.push_back(line.step);
  return steps;
}

}  // namespace

TEST_CASE("line_help: the steps are presses, then struts on top of the strongest press") {
  const bridge::KeepOptions options;
  REQUIRE(bridge::help_steps(options) == 6);
  const std::vector<HelpedLine> lines = lines_at({0, 1, 3, 4, 6});
  const std::vector<double> presses{1, 10, 100, 100, 100}, struts{0, 0, 0, 0.3, 30};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    CHECK(bridge::press_of(lines[i], options) == presses[i]);
    CHECK(bridge::struts_of(lines[i], options) == struts[i]);
  }
}

TEST_CASE("line_help: what had help before gets two steps, all get the least, none more than there is") {
  const bridge::KeepOptions options;
  std::vector<HelpedLine> lines = lines_at({0, 0, 0, 1, 1, 5, 6});
  const bridge::Steps steps{0, 1, 2, 0, 1, 1, 0};
  CHECK(bridge::add_help(steps, 0, options, lines) == 4);
  CHECK(steps_of(lines) == std::vector<int>{0, 1, 2, 1, 3, 6, 6});
  CHECK(bridge::add_help({0, 0, 0, 0, 0, 0, 0}, 2, options, lines) == 3);
  CHECK(steps_of(lines) == std::vector<int>{2, 2, 2, 2, 3, 6, 6});
  bridge::KeepOptions none;
  none.presses.clear(), none.struts.clear();
  lines = lines_at({0});
  CHECK(bridge::add_help({0}, 2, none, lines) == 0);
  CHECK(steps_of(lines) == std::vector<int>{0});
}

TEST_CASE("line_help: a line fails anew that had no help, not one that had some") {
  const std::vector<HelpedLine> lines = lines_at({0, 0, 2});
  CHECK_FALSE(bridge::fails_anew({0, 0, 0}, lines));
  CHECK_FALSE(bridge::fails_anew({0, 0, 1}, lines));
  CHECK(bridge::fails_anew({0, 1, 1}, lines));
}
