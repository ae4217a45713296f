// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/stroke/touch_file.h"

#include <catch2/catch.hpp>

#include "tests/io/base/io_test_helpers.h"

namespace furrow::tests {
namespace {

using geometry::Point;
using geometry::TouchKind;
using geometry::Vector;

}  // namespace

TEST_CASE("touch_file: touches are read in their order, in unit and axes of the file") {
  const std::string text = R"({"touches": [
    {"iron": [10, 20, 30]},
    {"pinch": [0, 0, 0], "radius": 0.05},
    {"pull": [1, 2, 3], "by": [0.01, 0.02, 0.03], "radius": 0.2, "strength": 0.5},
    {"steam": [4, 5, 6], "strength": 0.25}]})";
  io::ReadOptions options;
  options.metres_per_unit = 0.01;
  options.up = io::Axis::z;
  const auto touches = io::touches_from(text, "t.json", options);
  REQUIRE(touches.size() == 4);
  CHECK(touches[0].kind == TouchKind::iron);
  CHECK(Point(touches[0].at) == Point(0.1, 0.3, -0.2));
  CHECK(touches[0].radius == 0.1);
  CHECK(touches[0].strength == 1);
  CHECK(touches[1].kind == TouchKind::pinch);
  CHECK(touches[1].radius == 0.05);
  CHECK(touches[1].strength == 0.3);
  CHECK(touches[2].kind == TouchKind::pull);
  CHECK(Vector(touches[2].by) == Vector(0.01, 0.03, -0.02));
  CHECK(touches[2].strength == 0.5);
  CHECK(touches[3].kind == TouchKind::steam);
  CHECK(touches[3].strength == 0.25);
}

TEST_CASE("touch_file: what is wrong is named with its touch") {
  const auto error = [](const std::string& text) {
    return content_error([&] { io::touches_from(text, "t.json"); });
  };
  CHECK(error(R"({"touches": []})").find("one touch at least") != std::string::npos);
  CHECK(error(R"({"strokes": []})").find("one touch at least") != std::string::npos);
  CHECK(error(R"({"touches": [{"iron": [0, 0, 0]}, {"iron": [0, 0]}]})").find("touch 2: ") !=
        std::string::npos);
  CHECK(error(R"({"touches": [{"press": [0, 0, 0]}]})").find("one of iron, steam, pinch and pull") !=
        std::string::npos);
  CHECK(error(R"({"touches": [{"iron": [0, 0, 0], "steam": [0, 0, 0]}]})").find("one of iron") !=
        std::string::npos);
  CHECK(error(R"({"touches": [{"iron": [0, 0, 0], "by": [0, 0, 1]}]})").find("by") != std::string::npos);
  CHECK(error(R"({"touches": [{"pull": [0, 0, 0]}]})").find("needs its way") != std::string::npos);
  CHECK(error(R"({"touches": [{"iron": [0, 0, 0], "radius": 0}]})").find("radius") != std::string::npos);
  CHECK(error(R"({"touches": [{"iron": [0, 0, 0], "strength": 1.5}]})").find("strength") !=
        std::string::npos);
  CHECK(error(R"({"touches": [7]})").find("must be an object") != std::string::npos);
  CHECK(error("{").find("t.json") != std::string::npos);
}

}  // namespace furrow::tests
