// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/keeping/keep_verdicts.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace furrow;
using bridge::Verdict;

namespace {

/// Three lines of 10 mm, stable, that keep their heights.
struct Tried {
  bridge::KeepOptions options;
  bridge::TriedPlan found{
      {{{0, {}, 0.01}, {1, {}, 0.01}, {2, {}, 0.01}}},
      {.cloth = {}, .shape = {}, .rest_press = 1, .kept = {1, 1, 1}, .kept_gust = {1, 1, 1}, .blown = true}};
  std::vector<double> heights{0.01, 0.01, 0.01};

  std::vector<bridge::KeptLine> told() const { return bridge::verdicts(found, heights, options, false); }
};

}  // namespace

TEST_CASE("keep_verdicts: a line is told at the height that it lies at, whoever was lowered") {
  Tried tried;
  for (const bridge::KeptLine& line : tried.told()) {
    CHECK(line.verdict == Verdict::held);
    CHECK(line.lowered == 1);
  }
  tried.found.plan.lines[0].height = 0.25;
  tried.heights = {0.003, 0.005, 0.0098};  // the first, one across it, one far from both
  const auto told = tried.told();
  CHECK(told[0].verdict == Verdict::lowered);
  CHECK(told[0].lowered == Approx(0.3));
  CHECK(told[0].height == Approx(0.003));
  CHECK(told[1].verdict == Verdict::lowered);
  CHECK(told[1].height == Approx(0.005));
  CHECK(told[2].verdict == Verdict::held);
  CHECK(told[2].height == Approx(0.0098));
}

TEST_CASE("keep_verdicts: help names what holds, gusts allow two fifths of what calm does") {
  Tried tried;
  tried.found.plan.lines[0].step = 1;
  tried.found.plan.lines[1].step = int(tried.options.presses.size()) + 1;
  tried.found.outcome.kept_gust[2] = 0.975;  // 5 % may be lost, 2 % in gusts
  const auto told = tried.told();
  CHECK(told[0].verdict == Verdict::pressed);
  CHECK(told[0].press == tried.options.presses.front());
  CHECK(told[1].verdict == Verdict::strutted);
  CHECK(told[1].struts == tried.options.struts.front());
  CHECK(told[2].verdict == Verdict::may_hold);
  CHECK_FALSE(told[2].reason.empty());
  tried.found.outcome.blown = false;  // then that is what calm left
  CHECK(tried.told()[2].verdict == Verdict::held);
}

TEST_CASE("keep_verdicts: what stands lower than asked is not held, whatever it keeps of that") {
  Tried tried;
  tried.options.line_heights = {0.02, 0.0102, NAN};
  tried.found.outcome.kept[1] = tried.found.outcome.kept[2] = 0.98;
  const auto told = tried.told();
  CHECK(told[0].verdict == Verdict::lowered);
  CHECK(told[0].lowered == Approx(0.5));
  CHECK(told[0].kept == 1);
  CHECK_FALSE(bridge::holds(told[0].verdict));
  CHECK(told[1].verdict == Verdict::held);
  CHECK(told[1].lowered == Approx(1 / 1.02));
  CHECK(told[2].verdict == Verdict::held);
  CHECK(told[2].lowered == 1);
  tried.found.outcome.kept_gust = {0.96, 0.96, 0.5};
  const auto nearly = tried.told();
  CHECK(nearly[0].verdict == Verdict::may_hold);
  CHECK_THAT(nearly[0].reason, Catch::StartsWith("50 % of the height asked is left, and it came within 4 %"));
  CHECK(nearly[1].verdict == Verdict::may_hold);
  CHECK(nearly[2].verdict == Verdict::may_hold);
  CHECK_THAT(nearly[2].reason, Catch::Contains("gusts left it at 50 %"));
}

TEST_CASE("keep_verdicts: a line that gusts alone took may hold, one that calm took cannot") {
  Tried tried;
  tried.found.outcome.kept_gust = {0.5, NAN, 1};
  tried.found.outcome.kept[2] = 0.5;
  const auto told = tried.told();
  CHECK(told[0].verdict == Verdict::may_hold);
  CHECK(told[0].kept_gust == 0.5);
  CHECK(told[1].verdict == Verdict::may_hold);
  CHECK_THAT(told[1].reason, Catch::Contains("no height to measure"));
  CHECK(told[2].verdict == Verdict::cannot_hold);
  const auto broken_off = bridge::verdicts(tried.found, tried.heights, tried.options, true);
  CHECK(broken_off[0].reason == "interrupted");
  CHECK(broken_off[0].verdict == Verdict::not_known);
}
