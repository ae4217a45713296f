// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "studio/replay.h"
#include "tests/studio/visitor.h"

namespace furrow {
namespace {

using jobs::Json;
using tests::Desk;
using tests::Visitor;

Json touch(const char* kind, double radius = 0.1) {
  return {{"touch", {{kind, {0.2, 0.1, 0.0}}, {"radius", radius}, {"strength", 0.4}}}};
}

/// Where a drape leaves the middle of the sheet that is touched.
Json at_rest(Visitor& page, Json body) {
  page.ask("show");
  float p[3] = {};
  std::memcpy(p, page.cloth.data() + 24 + 12 * 40, sizeof p);
  body["touch"][body["touch"].begin().key()] = {p[0], p[1], p[2]};
  return body;
}

}  // namespace

TEST_CASE(
    "studio touch: cloth at rest is touched, each touch is undone to the bit, and the log does it again") {
  const Desk desk("touch");
  {
    const studio::Studio studio(desk.scene, desk.project());
    Visitor page(studio);
    CHECK(page.ask("touch", touch("iron")).at("refused").get<std::string>().find("rest") !=
          std::string::npos);
    REQUIRE(page.ask("drape").contains("done"));
    page.ask("show");
    const std::string rested = page.cloth;
    for (const char* kind : {"iron", "steam", "pinch"}) {
      const Json answer = page.ask("touch", at_rest(page, touch(kind)));
      INFO(answer.dump());
      REQUIRE(answer.contains("done"));
      CHECK(answer.at("done").at("moved") >= 0.0);
      CHECK(answer.at("done").at("balances") == true);
      CHECK(answer.at("done").at("pairs") == 0);
      CHECK(page.status.at("undo") == kind);
    }
    CHECK(page.cloth != rested);
    const std::string touched = page.cloth;
    for (int i = 0; i < 3; ++i) REQUIRE(page.ask("undo").contains("done"));
    CHECK(page.cloth == rested);
    for (int i = 0; i < 3; ++i) REQUIRE(page.ask("redo").contains("done"));
    CHECK(page.cloth == touched);
    REQUIRE(page.ask("drape").contains("done"));
  }
  const auto report = studio::replay(desk.project(), desk.folder / "again", [](auto, auto) { return true; });
  CHECK(report.difference == "");
}

TEST_CASE(
    "studio touch: lines that are not at rest, no cloth there, and what is no touch are refused in words") {
  const Desk desk("touch_refused");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  const auto refusal = [&](const Json& body) {
    return page.ask("touch", body).at("refused").get<std::string>();
  };
  REQUIRE(page.ask("drape").contains("done"));
  CHECK(refusal({}).find("no touch") != std::string::npos);
  CHECK(refusal({{"touch", {{"press", {0, 0, 0}}}}}).find("iron") != std::string::npos);
  CHECK(refusal({{"touch", {{"iron", {5, 5, 5}}}}}).find("no cloth") != std::string::npos);
  const Json points{{0.1, 0.1, 0.0}, {0.1, 0.2, 0.0}, {0.1, 0.3, 0.0}};
  REQUIRE(page.ask("draw", {{"height", 0.01}, {"points", points}}).contains("done"));
  CHECK(refusal(touch("iron")).find("drape") != std::string::npos);
}

}  // namespace furrow
