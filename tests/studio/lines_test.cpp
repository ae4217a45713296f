// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/studio/visitor.h"

namespace furrow {

using jobs::Json;
using tests::Desk;
using tests::line_at;
using tests::Visitor;

TEST_CASE("studio lines: a line is dragged by its points, and seen before it is let go") {
  const Desk desk("drag");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("draw", line_at(0.05)).contains("done"));
  const Json points = page.ask("points", {{"line", 0}}).at("done").at("points");
  REQUIRE(points == line_at(0.05).at("points"));
  page.ask("show");
  const std::string before = page.cloth;
  Json moved = points;
  moved[1][0] = 0.1;
  REQUIRE(page.ask("set", {{"line", 0}, {"points", moved}, {"live", true}}).at("done").at("live") == true);
  page.ask("points", {{"line", 0}});
  CHECK(page.preview.size() > 100);
  CHECK(page.status.at("step") == 1);  // nothing was changed
  CHECK(page.ask("points", {{"line", 0}}).at("done").at("points") == points);
  REQUIRE(page.ask("set", {{"line", 0}, {"points", moved}}).contains("done"));
  CHECK(page.status.at("undo") == "drag ridge 1");
  page.ask("show");
  CHECK(page.cloth != before);
  CHECK(page.cloth.substr(8) == page.preview.substr(8));  // what was promised
  CHECK(page.ask("undo").contains("done"));
  page.ask("show");
  CHECK(page.cloth == before);
}

TEST_CASE("studio lines: a ridge that becomes a valley is called one, unless somebody named it") {
  const Desk desk("kinds");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  const auto name = [&](int line) { return page.status.at("lines").at(line).at("name").get<std::string>(); };
  REQUIRE(page.ask("draw", line_at(0.1)).contains("done"));
  REQUIRE(page.ask("draw", line_at(0.2, -0.02)).contains("done"));
  REQUIRE(page.ask("set", {{"line", 0}, {"height", -0.02}}).contains("done"));
  CHECK(name(0) == "valley 2");
  REQUIRE(page.ask("set", {{"line", 0}, {"height", -0.01}}).contains("done"));
  CHECK(name(0) == "valley 2");
  REQUIRE(page.ask("set", {{"line", 1}, {"name", "ridge 7"}}).contains("done"));
  CHECK(name(1) == "ridge 7");
  REQUIRE(page.ask("set", {{"line", 1}, {"height", 0.02}}).contains("done"));
  CHECK(name(1) == "ridge 7");
}

TEST_CASE("studio lines: a line that gathers has no height, its own kind of name, and is raised again") {
  const Desk desk("gather");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  for (const double y : {0.1, 0.2}) REQUIRE(page.ask("draw", line_at(y)).contains("done"));
  const Json thread{{"line", 0}, {"gather", 0.8}, {"height", 0}, {"width", nullptr}};
  REQUIRE(page.ask("set", thread).contains("done"));
  const auto row = [&](int line) { return page.status.at("lines").at(line); };
  CHECK(row(0).at("name") == "gather 1");
  CHECK((row(0).at("gather") == 0.8 && row(0).at("height") == 0));
  CHECK(page.status.at("undo") == "gather ridge 1");
  REQUIRE(page.ask("set", {{"lines", {0, 1}}, {"height", 0.03}}).contains("done"));
  CHECK((row(0).at("height") == 0 && row(1).at("height") == 0.03));
  REQUIRE(page.ask("save").contains("done"));
  CHECK(tests::saved_strokes(desk.project()).at(0).at("gather") == 0.8);
  REQUIRE(page.ask("set", {{"line", 0}, {"gather", nullptr}, {"height", -0.01}}).contains("done"));
  CHECK(row(0).at("name") == "valley 1");
  CHECK(!row(0).contains("gather"));
  REQUIRE(page.ask("set", {{"line", 0}, {"gather", nullptr}, {"sharpness", 0.5}}).contains("done"));
}

TEST_CASE(
    "studio lines: a pen that feels pressure draws heights along the line, which are the stroke's own") {
  const Desk desk("pressure");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  Json line = line_at(0.1, -0.02);
  for (const Json& wrong : {Json::array({-0.01, -0.02}), Json::array({-0.01, 0.02, -0.01}), Json("high"),
                            Json::array({-0.01, -2.0, -0.01}), Json::array({-0.01, nullptr, -0.01})}) {
    line["heights"] = wrong;
    CHECK(page.ask("draw", line).at("refused").get<std::string>().find("heights: ") == 0);
  }
  line["heights"] = {-0.005, -0.02, -0.01};
  line["mirror"] = true;
  REQUIRE(page.ask("draw", line).contains("done"));
  REQUIRE(page.status.at("lines").size() == 2);
  for (const int i : {0, 1}) {
    CHECK(page.status["lines"][i].at("varies") == true);
    CHECK(page.status["lines"][i].at("name") == "valley " + std::to_string(i + 1));
  }
  REQUIRE(page.ask("duplicate", {{"line", 0}}).contains("done"));
  REQUIRE(page.ask("save").contains("done"));
  CHECK(tests::saved_strokes(desk.project()).at(0).at("height") == line["heights"]);
  REQUIRE(page.ask("set", {{"line", 0}, {"height", -0.01}}).contains("done"));
  CHECK(page.status["lines"][0].at("height") == -0.01);
}

TEST_CASE("studio lines: several change at once, as one step, and stay ridges and valleys") {
  const Desk desk("several");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  for (const Json& line : {line_at(0.1), line_at(0.2, -0.02), line_at(0.15, 0.015)})
    REQUIRE(page.ask("draw", line).contains("done"));
  REQUIRE(page.ask("set", {{"lines", {0, 1}}, {"height", 0.01}}).contains("done"));
  const auto height = [&](int line) { return page.status.at("lines").at(line).at("height").get<double>(); };
  CHECK(height(0) == 0.01);
  CHECK(height(1) == -0.01);
  CHECK(height(2) == 0.015);
  CHECK(page.status.at("undo") == "change the height of 2 lines");
  REQUIRE(page.ask("undo").contains("done"));
  page.ask("show");
  CHECK(height(0) == 0.02);
  CHECK(height(1) == -0.02);
  REQUIRE(page.ask("set", {{"lines", {0, 1, 2}}, {"height", 0.03}, {"live", true}}).contains("done"));
  CHECK(page.preview.size() > 0);
  CHECK(height(2) == 0.015);
}

TEST_CASE("studio lines: their order can be changed, and is the one that is saved", "[long]") {
  const Desk desk("order");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  for (const double x : {-0.12, 0.0, 0.12}) REQUIRE(page.ask("draw", line_at(x)).contains("done"));
  const auto names = [&] {
    Json list = Json::array();
    for (const Json& line : page.status.at("lines")) list.push_back(line.at("name"));
    return list;
  };
  REQUIRE(page.ask("move", {{"line", 2}, {"to", 0}}).contains("done"));
  CHECK(names() == Json{"ridge 3", "ridge 1", "ridge 2"});
  CHECK(page.status.at("undo") == "move ridge 3 up");
  REQUIRE(page.ask("move", {{"line", 0}, {"to", 1}}).contains("done"));
  CHECK(names() == Json{"ridge 1", "ridge 3", "ridge 2"});
  CHECK(page.ask("move", {{"line", 1}, {"to", 1}}).contains("refused"));
  CHECK(page.ask("move", {{"line", 1}, {"to", 3}}).contains("refused"));
  REQUIRE(page.ask("save").contains("done"));
  CHECK(tests::saved_strokes(desk.project()).at(1).at("name") == "ridge 3");
}

TEST_CASE("studio lines: a duplicate lies beside its line, on the cloth, 1.2 widths away") {
  const Desk desk("duplicate");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("draw", line_at(0.0, -0.02)).contains("done"));
  REQUIRE(page.ask("duplicate", {{"line", 0}}).contains("done"));
  REQUIRE(page.status.at("lines").size() == 2);
  CHECK(page.status["lines"][1].at("name") == "valley 2");
  const Json beside = page.ask("points", {{"line", 1}}).at("done").at("points");
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(std::abs(beside.at(i).at(0).get<double>()) == Approx(1.2 * 0.08));
    CHECK(beside[i].at(2).get<double>() == Approx(0).margin(1e-12));
  }
  CHECK(page.ask("duplicate", {{"line", 5}}).contains("refused"));
}

TEST_CASE("studio lines: a line is drawn on both sides of a middle that can be moved, as one step") {
  const Desk desk("both");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("middle", {{"x", 0.02}}).contains("done"));
  CHECK(page.status.at("middle") == 0.02);
  Json line = line_at(0.12);
  line["mirror"] = true;
  REQUIRE(page.ask("draw", line).contains("done"));
  REQUIRE(page.status.at("lines").size() == 2);
  CHECK(page.ask("points", {{"line", 1}}).at("done").at("points").at(0).at(0).get<double>() == Approx(-0.08));
  CHECK(page.ask("undo").contains("done"));
  CHECK(page.status.at("lines").empty());
  Json middle = line_at(0.03);  // within half of its width: it would be drawn over itself
  middle["mirror"] = true;
  REQUIRE(page.ask("draw", middle).contains("done"));
  CHECK(page.status.at("lines").size() == 1);
  CHECK(page.ask("mirror", {{"line", 0}}).at("refused").get<std::string>().find("in the middle") !=
        std::string::npos);
  CHECK(page.ask("middle", {{"x", "left"}}).contains("refused"));
}

}  // namespace furrow
