// SPDX-License-Identifier: GPL-3.0-or-later
// Lines drawn and settled on a body in one command: each stands, or is named.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "journey.h"

using namespace furrow::tests;
using nlohmann::json;

namespace {

struct Line {
  std::string name;
  double height;                 ///< [m]
  std::vector<double> from, to;  ///< in the garment's unit
};

void write_lines(const std::string& file, const std::vector<Line>& lines) {
  json strokes = json::array();
  for (const Line& l : lines)
    strokes.push_back({{"name", l.name}, {"height", l.height}, {"points", {l.from, l.to}}});
  write_text(file, json{{"strokes", strokes}}.dump());
}

/// Draws and settles; every line is measured at rest, and what lost its height is warned of by name.
void check_lines(const std::string& arguments, const std::vector<Line>& lines) {
  write_lines("lines.json", lines);
  const Run run = run_furrow("wrinkle " + arguments + " -o worn.ply --json");
  INFO(run.err);
  REQUIRE((run.exit_code == 0 || run.exit_code == 4));
  const json report = json::parse(run.out), &rest = report.at("at_rest"), &end = rest.at("end");
  for (const Line& l : lines) {
    INFO(l.name << rest.at("lines").dump(1));
    const auto line = std::find_if(rest.at("lines").begin(), rest["lines"].end(),
                                   [&](const json& found) { return found.value("name", "") == l.name; });
    const bool named = run.err.find("'" + l.name + "'") != std::string::npos;
    REQUIRE((line != rest["lines"].end() || named));
    if (line == rest["lines"].end() || line->at("kept").is_null()) continue;
    CHECK((line->at("kept").get<double>() >= 0.5 || named));
  }
  CHECK(end.at("crossings") == rest["crossings"]["pairs"]);
  CHECK(end.at("fallen").get<double>() < 0.1);
  if (run.exit_code != 0) return;
  CHECK(end.at("body").at("depth").get<double>() <= 0.005);
  CHECK(end.at("residual_force").get<double>() <= 0.001);
  CHECK(end.at("parts_lost") == 0);
}

}  // namespace

TEST_CASE("journeys: lines settled on a loose and on a close garment stand, or are named", "[release]") {
  const Journey here;
  SECTION("a wide tunic") {
    here.bring("meshes/tunic.obj");
    here.bring_body_of_tunic("she.obj");
    check_lines("tunic.obj lines.json --max-distance 0.2 --settle --body she.obj",
                {{"front", 0.012, {0.55, 0.75, 0.25}, {0.55, 0.5, 0.25}},
                 {"back", -0.01, {0.25, 0.75, 0.25}, {0.25, 0.5, 0.25}}});
  }
  SECTION("a dress that lies close") {
    here.bring("meshes/dress_cm.obj");
    here.bring_body_of_dress("body.obj");
    check_lines("dress_cm.obj lines.json --unit cm --up z --max-distance 0.2 --settle --body body.obj",
                {{"front", 0.012, {0, -15, 110}, {0, -15, 80}}, {"back", -0.01, {0, 15, 110}, {0, 15, 80}}});
  }
}
