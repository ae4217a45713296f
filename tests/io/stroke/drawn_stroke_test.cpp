// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>

#include "io/base/camera_file.h"
#include "io/stroke/stroke_file.h"
#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

constexpr const char* test_camera = R"({"eye":[0,1,3],"target":[0,1,0],"fov":40,"size":[640,480]})";

std::vector<io::DrawnStroke> drawn(const std::string& json, const io::ReadOptions& options = {}) {
  TemporaryFolder folder;
  spit(folder / "cam.json", test_camera);
  spit(folder / "s.json", json);
  return io::read_drawn_strokes(folder / "s.json", 0.01, options);
}
std::string error_of_drawn(const std::string& json) {
  const std::string text = content_error([&] { drawn(json); });
  const auto name = text.find(".json: ");
  return name == std::string::npos ? text : text.substr(name + 7);
}

}  // namespace

TEST_CASE("drawn_stroke: strokes are on pictures, in the texture, between vertices, in space") {
  const auto read = drawn(R"({"camera": "cam.json", "strokes": [
    {"name": "a", "height": -0.02, "pixels": [[10, 20.5], [300, 40]]},
    {"pixels": [[1, 2], [3, 4], [5, 6]], "closed": true,
     "camera": {"eye": [1, 2, 3], "target": [0, 0, 0], "up": [0, 0, 1], "parallel": 1.5, "size": [100, 200]}},
    {"texture": [[0.1, 0.2], [0.3, 0.4]], "group": "sleeve", "near": [100, 0, 0]},
    {"vertices": [3, 12, 5]},
    {"points": [[0, 0, 0], [1, 0, 0], [2, 0, 0]], "breaks": [2]}]})",
                          {.metres_per_unit = 0.01});
  REQUIRE(read.size() == 5);
  const auto& first = std::get<io::PictureStroke>(read[0].on);
  CHECK(first.pixels == std::vector<std::array<double, 2>>{{10, 20.5}, {300, 40}});
  CHECK(first.picture.camera.eye == io::Position{0, 1, 3});  // metres, whatever the unit
  CHECK(first.picture.camera.field_of_view_deg == 40);
  CHECK(first.picture.width == 640);
  const auto& second = std::get<io::PictureStroke>(read[1].on);
  CHECK(second.picture.camera.parallel_height == 1.5);
  CHECK(second.picture.camera.up == io::Position{0, 0, 1});
  CHECK(read[1].stroke.closed);
  const auto& third = std::get<io::TextureStroke>(read[2].on);
  CHECK(third.group == "sleeve");
  CHECK(third.near->x() == Approx(1));
  CHECK(std::get<io::VertexStroke>(read[3].on).vertices == std::vector<std::size_t>{3, 12, 5});
  CHECK(read[4].stroke.breaks == std::vector<std::size_t>{2});
  CHECK(io::kind_of(read[2]) == std::string("texture"));
  CHECK(io::drawn_length(read[0]) == Approx(std::hypot(290, 19.5)));
  CHECK(std::isnan(io::drawn_length(read[3])));
  CHECK(io::drawn_length(read[4]) == Approx(0.01));

  TemporaryFolder folder;
  io::write_strokes(folder / "again.json", read);
  const auto back = io::read_drawn_strokes(folder / "again.json");
  REQUIRE(back.size() == 5);
  CHECK(std::get<io::PictureStroke>(back[0].on).pixels == first.pixels);
  CHECK(std::get<io::PictureStroke>(back[1].on).picture.camera.parallel_height == 1.5);
  CHECK(std::get<io::TextureStroke>(back[2].on).points == third.points);
  CHECK(*std::get<io::TextureStroke>(back[2].on).near == *third.near);
  CHECK(std::get<io::VertexStroke>(back[3].on).vertices.size() == 3);
  CHECK(back[4].stroke.breaks == read[4].stroke.breaks);
  CHECK(back[0].stroke.height == -0.02);
}

TEST_CASE("drawn_stroke: what is not allowed is named with stroke and key") {
  CHECK(error_of_drawn(R"({"strokes": [{"pixles": [[0,0]]}]})") ==
        "stroke 0: unknown key 'pixles'; did you mean 'pixels'?");
  CHECK(error_of_drawn(R"({"strokes": [{"pixels": [[0,0]]}]})").find("need a 'camera'") != std::string::npos);
  CHECK(error_of_drawn(R"({"strokes": [{"pixels": [[0,0]], "points": [[0,0,0]]}]})").find("has both") !=
        std::string::npos);
  CHECK(error_of_drawn(R"({"strokes": [{"points": [[0,0,0]], "group": "a"}]})") ==
        "stroke 0: 'group' goes with 'texture', not with 'points'");
  CHECK(error_of_drawn(R"({"strokes": [{"texture": [[0,0],[1]]}]})")
            .starts_with("stroke 0: point 1: 'texture': two"));
  CHECK(error_of_drawn(R"({"strokes": [{"vertices": [0, -1]}]})")
            .find("whole numbers, counted from 0, not -1") != std::string::npos);
  CHECK(error_of_drawn(R"({"strokes": [{"vertices": [0, 1.5]}]})").find("whole numbers") !=
        std::string::npos);
  CHECK(error_of_drawn(R"({"strokes": [{"vertices": []}]})").find("at least one vertex") !=
        std::string::npos);
  CHECK(error_of_drawn(R"({"strokes": [{"points": [[0,0,0],[1,0,0]], "breaks": [2]}]})")
            .find("'breaks' must ascend") != std::string::npos);
  CHECK(error_of_drawn(R"({"camera": {"eye": [0,0,1], "target": [0,0,0]}, "strokes": []})") ==
        "'size' of the camera is missing");
  CHECK(
      error_of_drawn(R"({"camera": {"eye": [0,0,1], "target": [0,0,1], "size": [10,10]}, "strokes": []})") ==
      "camera: eye and target are at one place");
  CHECK(error_of_drawn(R"({"camera": {"eye": [0,0,1], "target": [0,0,0], "size": [10,0]}, "strokes": []})")
            .find("height") != std::string::npos);
  CHECK(error_of_drawn(R"({"camera": {"ey": [0,0,1]}, "strokes": []})") ==
        "unknown key 'ey'; did you mean 'eye'?");
  CHECK(content_error([&] { drawn(R"({"camera": "none.json", "strokes": []})"); }).find("none.json") !=
        std::string::npos);
  TemporaryFolder folder;
  spit(folder / "s.json", R"({"strokes": [{"vertices": [1, 2]}]})");
  CHECK(content_error([&] { io::read_strokes(folder / "s.json"); }).find("only strokes in space") !=
        std::string::npos);
}

TEST_CASE("cameras: what is written comes back with the same bits") {
  TemporaryFolder folder;
  io::CameraPicture picture{{{0.1, 1.0 / 3, 2}, {0, 1, 0}, {0, 0.6, 0.8}, 31.7}, 320, 241};
  io::write_camera(folder / "c.json", picture);
  io::CameraPicture back = io::read_camera(folder / "c.json");
  CHECK(back.camera.eye == picture.camera.eye);
  CHECK(back.camera.up == picture.camera.up);
  CHECK(back.camera.field_of_view_deg == 31.7);
  CHECK((back.width == 320 && back.height == 241 && !back.camera.parallel_height));
  picture.camera.parallel_height = 0.7;
  io::write_camera(folder / "c.json", picture);
  CHECK(io::read_camera(folder / "c.json").camera.parallel_height == 0.7);
  picture.camera.up = {0, 0, 0};
  CHECK_THROWS_AS(io::write_camera(folder / "c.json", picture), std::invalid_argument);
}

TEST_CASE("drawn_stroke: strokes are found by name and moved in their own coordinates") {
  auto strokes = drawn(R"({"camera": "cam.json", "strokes": [
    {"name": "fold", "points": [[0, 1, 2]]}, {"name": "hem", "pixels": [[10, 20]]},
    {"name": "path", "vertices": [1, 2]}, {"name": "twin", "points": [[0,0,0]]}, {"name": "twin", "points": [[0,0,0]]}]})");
  CHECK(io::find_stroke(strokes, "hem") == 1);
  CHECK(content_error([&] { io::find_stroke(strokes, "fald"); }).find("did you mean 'fold'") !=
        std::string::npos);
  CHECK(content_error([&] { io::find_stroke(strokes, "twin"); }).find("2 strokes are named") !=
        std::string::npos);
  io::move_stroke(strokes[0], std::array{0.5, -1.0, 0.25});
  CHECK(strokes[0].stroke.points[0] == Point(0.5, 0, 2.25));
  io::move_stroke(strokes[1], std::array{-3.0, 4.0});
  CHECK(std::get<io::PictureStroke>(strokes[1].on).pixels[0] == std::array{7.0, 24.0});
  CHECK_THROWS_AS(io::move_stroke(strokes[0], std::array{1.0, 2.0}), std::invalid_argument);
  CHECK_THROWS_AS(io::move_stroke(strokes[1], std::array{1.0, 2.0, 3.0}), std::invalid_argument);
  CHECK_THROWS_AS(io::move_stroke(strokes[2], std::array{1.0, 2.0}), std::invalid_argument);
  CHECK_THROWS_AS(io::move_stroke(strokes[1], std::array{1.0, std::nan("")}), std::invalid_argument);
}

TEST_CASE("order_strokes: those that are named come first, the others keep their order") {
  const auto names = [](std::vector<std::string> order) {
    auto list = drawn(R"({"strokes": [{"name": "a", "points": [[0, 0, 0]]}, {"points": [[0, 0, 0]]},
      {"name": "b", "points": [[0, 0, 0]]}, {"name": "c", "points": [[0, 0, 0]]}]})");
    io::order_strokes(list, order);
    std::string result;
    for (const io::DrawnStroke& s : list) result += s.stroke.name.empty() ? "-" : s.stroke.name;
    return result;
  };
  CHECK(names({"c", "a"}) == "ca-b");
  CHECK(names({}) == "a-bc");
  CHECK_THROWS_WITH(names({"a", "a"}), Catch::Contains("twice"));
  CHECK_THROWS_WITH(names({"d"}), Catch::Contains("'d'"));
}
