// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/stroke/stroke_file.h"

#include <catch2/catch.hpp>

#include "io/base/nearest_word.h"
#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

using Points = std::vector<Coordinates<Point>>;

std::vector<Stroke> strokes(const std::string& json, const io::ReadOptions& options = {}) {
  TemporaryFolder folder;
  spit(folder / "s.json", json);
  return io::read_strokes(folder / "s.json", 0.01, options);
}
/// The message behind the file's name.
std::string error_of_strokes(const std::string& json) {
  const std::string text = content_error([&] { strokes(json); });
  const auto name = text.find("s.json:");
  return name == std::string::npos ? text : text.substr(name + 7);
}

}  // namespace

TEST_CASE("strokes: all keys, and the defaults of those that are missing") {
  const auto read = strokes(R"({"strokes": [
    {"height": -0.02, "points": [[0, 1, 2], [1e-3, 0.1, -3]], "name": "fold", "closed": false, "direction": [0, 0, -2]},
    {"points": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "closed": true},
    {"height": 0, "points": [[5, 5, 5]]}]})");
  REQUIRE(read.size() == 3);
  CHECK(read[0].height == -0.02);
  CHECK(read[0].points == Points{{0, 1, 2}, {1e-3, 0.1, -3}});
  CHECK(read[0].name == "fold");
  CHECK_FALSE(read[0].closed);
  CHECK(*read[0].direction == Vector(0, 0, -2));
  CHECK((read[1].closed && read[1].height == 0.01 && !read[1].direction && read[1].name.empty()));
  CHECK((read[2].height == 0 && read[2].points.size() == 1));
}

TEST_CASE("strokes: all faults of a file are told at once, at most twenty") {
  CHECK(error_of_strokes(R"({"strokes": [{"hieght": 1, "width": -1, "points": [[0,0,0],[1,2]]},
                                         {"points": [[0,0,0]]}, 7, {"pixles": [[1,2]]}]})") ==
        " stroke 0: unknown key 'hieght'; did you mean 'height'?\n"
        "  stroke 0: 'width' = -1.000000 must be > 0 (metres)\n"
        "  stroke 0: point 1: 'points': three numbers [x, y, z] are needed\n"
        "  stroke 2: must be an object {\"points\": […], …}\n"
        "  stroke 3: unknown key 'pixles'; did you mean 'pixels'?");
  std::string many = R"({"strokes": [1)";
  for (int i = 0; i < 100; ++i) many += ",1";
  const std::string told = error_of_strokes(many + "]}");
  CHECK(std::count(told.begin(), told.end(), '\n') == 20);
  CHECK(told.ends_with("\n  and 81 more"));
}

TEST_CASE("strokes: what is not allowed is named with stroke and key") {
  CHECK(error_of_strokes(R"({"strokes": [{"points": [[0,0,0]]}, {"hieght": 1, "points": [[0,0,0]]}]})") ==
        " stroke 1: unknown key 'hieght'; did you mean 'height'?");
  CHECK(error_of_strokes(R"({"stroke": []})") == " unknown key 'stroke'; did you mean 'strokes'?");
  CHECK(error_of_strokes(R"({"strokes": {}})").find("must be a list") != std::string::npos);
  CHECK(error_of_strokes(R"({})").find("must be a list") != std::string::npos);
  CHECK(error_of_strokes(R"([])").find("must hold an object") != std::string::npos);
  CHECK(error_of_strokes(R"({"strokes": []})") == " no strokes; add one to the list");
  CHECK(error_of_strokes(R"({"strokes": [7]})").starts_with(" stroke 0: must be an object"));
  CHECK(error_of_strokes(R"({"strokes": [{"height": 1}]})") ==
        " stroke 0: 'points' is missing, or one of 'pixels', 'texture' and 'vertices'");
  CHECK(error_of_strokes(R"({"strokes": [{"points": []}]})")
            .starts_with(" stroke 0: 'points' must be a list of at least one"));
  CHECK(error_of_strokes(R"({"strokes": [{"points": [[0,0,0],[1,2]]}]})")
            .starts_with(" stroke 0: point 1: 'points': three"));
  CHECK(error_of_strokes(R"({"strokes": [{"points": [[0,0,"1"]]}]})")
            .starts_with(" stroke 0: point 0: 'points' must hold num"));
  CHECK(error_of_strokes(R"({"strokes": [{"points": [[0,0,1e10]]}]})").find("beyond 1e9 m") !=
        std::string::npos);
  CHECK(error_of_strokes(R"({"strokes": [{"points": [[0,0,0]], "height": true}]})").find("holds a boolean") !=
        std::string::npos);
  CHECK(error_of_strokes(R"({"strokes": [{"points": [[0,0,0]], "height": null}]})").find("'height' must") !=
        std::string::npos);
  CHECK(error_of_strokes(R"({"strokes": [{"points": [[0,0,0]], "closed": 1}]})").find("true or false") !=
        std::string::npos);
  CHECK(error_of_strokes(R"({"strokes": [{"points": [[0,0,0]], "closed": true}]})").find("three points") !=
        std::string::npos);
  CHECK(error_of_strokes(R"({"strokes": [{"points": [[0,0,0]], "name": 1}]})").find("'name' must") !=
        std::string::npos);
  CHECK(error_of_strokes(R"({"strokes": [{"points": [[0,0,0]], "direction": [0,0,0]}]})").find("zero") !=
        std::string::npos);
}

TEST_CASE("strokes: width, sharpness and press, in metres whatever the unit, and back again") {
  const auto read = strokes(R"({"strokes": [
    {"points": [[0, 0, 0]], "width": 0.06, "sharpness": 1, "press": 10},
    {"points": [[0, 0, 0]], "width": 0.06}, {"points": [[0, 0, 0]]}]})",
                            {.metres_per_unit = 0.01});
  CHECK(*read[0].width == 0.06);
  CHECK((read[0].sharpness == 1 && read[0].press == 10));
  CHECK((*read[1].width == 0.06 && !read[1].sharpness && read[1].press == 1));
  CHECK_FALSE(read[2].width);
  TemporaryFolder folder;
  io::write_strokes(folder / "s.json", read);
  const auto back = io::read_strokes(folder / "s.json");
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(back[i].width == read[i].width);
    CHECK((back[i].sharpness == read[i].sharpness && back[i].press == read[i].press));
  }
  Stroke bad = read[0];
  bad.press = 0;
  CHECK_THROWS_AS(io::write_strokes(folder / "t.json", std::vector<Stroke>{bad}), std::invalid_argument);
  const auto error = [](const std::string& keys) {
    return error_of_strokes(R"({"strokes": [{"points": [[0, 0, 0]], )" + keys + "}]}");
  };
  CHECK(error(R"("width": 0)") == " stroke 0: 'width' = 0.000000 must be > 0 (metres)");
  CHECK(error(R"("width": -1)").find("'width' = -1") != std::string::npos);
  CHECK(error(R"("width": "6 cm")").find("'width'") != std::string::npos);
  CHECK(error(R"("width": null)").find("'width'") != std::string::npos);
  CHECK(error(R"("width": 0.1, "sharpness": 1.01)").find("must be in [0, 1]") != std::string::npos);
  CHECK(strokes(R"({"strokes": [{"points": [[0, 0, 0]], "sharpness": 0.3}]})")[0].sharpness == 0.3);
  CHECK(error(R"("press": 0.9)").find("must be in [1, 1e6]") != std::string::npos);
  CHECK(error(R"("press": 1e999)") != "");
}

TEST_CASE("strokes: a gathered line has no height unless it names one, and comes back") {
  const auto read = strokes(R"({"strokes": [
    {"points": [[0, 0, 0]], "gather": 0.7}, {"points": [[0, 0, 0]], "gather": 1, "height": 0.02},
    {"points": [[0, 0, 0]]}]})");
  CHECK((read[0].height == 0 && *read[0].gather == 0.7));
  CHECK((read[1].height == 0.02 && *read[1].gather == 1));
  CHECK((read[2].height == 0.01 && !read[2].gather));
  TemporaryFolder folder;
  io::write_strokes(folder / "s.json", read);
  const auto back = io::read_strokes(folder / "s.json");
  for (std::size_t i = 0; i < 3; ++i)
    CHECK((back[i].gather == read[i].gather && back[i].height == read[i].height));
  CHECK(error_of_strokes(R"({"strokes": [{"points": [[0, 0, 0]], "gather": 70}]})")
            .find("in [0.1, 1], a share of the line's length") != std::string::npos);
}

TEST_CASE("strokes: broken JSON is named with line and column") {
  CHECK(error_of_strokes("{\"strokes\": [\n  {\"points\" [[0,0,0]]}]}").starts_with("2:13: no valid JSON: "));
  CHECK(error_of_strokes("").starts_with("1:1: no valid JSON: "));
  CHECK(error_of_strokes(R"({"strokes": [{"points": [[0,0,1e999]]}]})").find("no valid JSON") !=
        std::string::npos);
  CHECK(error_of_strokes(R"({"strokes": [{"points": [[0,0,NaN]]}]})").find("no valid JSON") !=
        std::string::npos);
  CHECK(error_of_strokes(std::string(300000, '[')).find("no valid JSON") != std::string::npos);
  CHECK(error_of_strokes("{\"strokes\": " + std::string(300000, '[') + std::string(300000, ']') + "}")
            .starts_with(" no valid JSON: nested more than 100 levels deep"));
}

TEST_CASE("strokes: what is written comes back with the same bits, also in another unit and axis") {
  Stroke fold{"Falte \"1\"\n",
              0.1 + 0.2,
              {{1.0 / 3, 2, -3e-5}, {0.7, 0.1, 1}, {4, 5, 6}},
              true,
              Vector(0.1, 0.2, 0.3)};
  Stroke plain{"", -0.01, {{1, 2, 3}}, false, {}};
  TemporaryFolder folder;
  for (const io::Axis up : {io::Axis::y, io::Axis::z}) {
    io::write_strokes(folder / "s.json", {fold, plain}, {.metres_per_unit = 0.5, .up = up});
    const auto back = io::read_strokes(folder / "s.json", 0.3, {.metres_per_unit = 0.5, .up = up});
    REQUIRE(back.size() == 2);
    CHECK(back[0].name == fold.name);
    CHECK(back[0].height == fold.height);
    CHECK(back[0].points == fold.points);
    CHECK(back[0].closed);
    CHECK(*back[0].direction == *fold.direction);
    CHECK(
        (back[1].points == plain.points && !back[1].closed && !back[1].direction && back[1].height == -0.01));
  }
  plain.points.clear();
  CHECK_THROWS_AS(io::write_strokes(folder / "s.json", {plain}), std::invalid_argument);
  fold.height = unset_value;
  CHECK_THROWS_AS(io::write_strokes(folder / "s.json", {fold}), std::invalid_argument);
}

TEST_CASE("strokes: the polylines of an OBJ file, which needs no faces") {
  TemporaryFolder folder;
  spit(folder / "lines.obj",
       "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 5 5 5\nv 6 5 5\nv 5 6 5\nl 1 2\nl 2 3\nl 4 5\nl 5 6\nl 6 4\n");
  const auto read = io::read_strokes(folder / "lines.obj", -0.03);
  REQUIRE(read.size() == 2);
  CHECK(read[0].points == Points{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}});
  CHECK((read[0].height == -0.03 && !read[0].closed));
  CHECK((read[1].points.size() == 3 && read[1].closed));
  spit(folder / "none.obj", cube_obj);
  CHECK(content_error([&] { io::read_strokes(folder / "none.obj"); }).find("no polylines") !=
        std::string::npos);
  CHECK_THROWS_AS(io::read_strokes(folder / "strokes.svg"), ContentError);
  CHECK_THROWS_AS(io::read_strokes(folder / "lines.obj", unset_value), std::invalid_argument);
}

TEST_CASE("strokes: lines of an OBJ file have the names of their objects, which say height and width") {
  TemporaryFolder folder;
  spit(folder / "lines.obj",
       "o belly_h=15mm_w=6cm\nv 0 0 0\nv 1 0 0\nv 1 0 1\nl 1 2\no hem h=-0.012\nv 5 5 5\nv 6 5 5\nl 4 5\n"
       "o belly_h=15mm_w=6cm\nl 2 3\no fold_h=20mm.001\nl 1 2 3\no plain.002\nl 3 2 1\ng panel\n");
  const auto read = io::read_strokes(folder / "lines.obj", 0.03);
  REQUIRE(read.size() == 4);
  CHECK(read[0].name == "belly");
  CHECK(read[0].points == Points{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}});  // chained within its object
  CHECK(read[0].height == Approx(0.015));
  CHECK(read[0].width.value() == Approx(0.06));
  CHECK(read[1].name == "hem");
  CHECK(read[1].height == -0.012);
  CHECK_FALSE(read[1].width);
  CHECK(read[2].name == "fold");
  CHECK(read[2].height == Approx(0.02));
  CHECK(read[3].name == "plain");
  CHECK(read[3].height == 0.03);
  spit(folder / "group.obj", "g seam\nv 0 0 0\nv 1 0 0\nl 1 2\n");
  CHECK(io::read_strokes(folder / "group.obj").at(0).name == "seam");
  spit(folder / "wrong.obj", "o belly_h=high\nv 0 0 0\nv 1 0 0\nl 1 2\n");
  CHECK(content_error([&] { io::read_strokes(folder / "wrong.obj"); }).find("h= takes a height") !=
        std::string::npos);
  spit(folder / "long.obj", "o belly_height=15mm width=6cm\nv 0 0 0\nv 1 0 0\nl 1 2\n");
  const auto spelt = io::read_strokes(folder / "long.obj", 0.03);
  CHECK(spelt.at(0).name == "belly");
  CHECK(spelt.at(0).height == Approx(0.015));
  CHECK(spelt.at(0).width.value() == Approx(0.06));
  spit(folder / "other.obj", "o belly_hight=15mm\nv 0 0 0\nv 1 0 0\nl 1 2\n");
  CHECK(content_error([&] {
          io::read_strokes(folder / "other.obj");
        }).find("only h= (height) and w= (width)") != std::string::npos);
  spit(folder / "flat.obj", "o belly_w=-3mm\nv 0 0 0\nv 1 0 0\nl 1 2\n");
  CHECK(content_error([&] { io::read_strokes(folder / "flat.obj"); }).find("w= takes a width") !=
        std::string::npos);
}

TEST_CASE("nearest_word: distances known by hand") {
  CHECK(io::edit_distance("kitten", "sitting") == 3);
  CHECK(io::edit_distance("", "abc") == 3);
  CHECK(io::edit_distance("same", "same") == 0);
  CHECK(io::nearest_word("pionts", {"height", "points", "name"}) == "points");
}
