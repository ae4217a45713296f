// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/nesting.h"

#include <catch2/catch.hpp>

#include "io/base/json_fields.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/scene.h"
#include "io/scene/state_file.h"
#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::tests;

namespace {

std::string times(std::size_t n, const std::string& text) {
  std::string all;
  for (std::size_t i = 0; i < n; ++i) all += text;
  return all;
}
/// n lists in each other.
std::string lists(std::size_t n) { return times(n, "[") + times(n, "]"); }

std::string ply_with(const std::string& comment) {
  return "ply\nformat ascii 1.0\ncomment " + comment +
         "\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float vx\n"
         "property float vy\nproperty float vz\nelement face 1\nproperty list uchar int vertex_indices\n"
         "end_header\n0 0 0 0 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2\n";
}

}  // namespace

TEST_CASE("nesting: levels are counted outside of texts") {
  CHECK_FALSE(io::is_nested_too_deep(lists(100)));
  CHECK(io::is_nested_too_deep(lists(101)));
  CHECK(io::is_nested_too_deep(times(101, "{\"a\":")));
  CHECK_FALSE(io::is_nested_too_deep("\"" + times(500, "[\\\"") + "\""));
  CHECK_FALSE(io::is_nested_too_deep("[" + times(500, "[],") + "[]]"));
}

TEST_CASE("nesting: a key of too many parts is found with its line") {
  CHECK(io::line_of_too_long_key("a = 1\n" + times(100, "a.") + "a = 1\n") == 2);
  CHECK(io::line_of_too_long_key("[" + times(100, "a . ") + "a]") == 1);
  CHECK(io::line_of_too_long_key("a = {" + times(100, "\"b.c\".") + "d = 1}") == 1);
  CHECK(io::line_of_too_long_key(times(99, "a.") + "a = 1\n") == 0);
  CHECK(io::line_of_too_long_key("x = [" + times(200, "1.5, ") + "2]") == 0);
  CHECK(io::line_of_too_long_key("# " + times(200, "a.") + "\nx = '" + times(200, ".") + "'\n") == 0);
  CHECK(io::line_of_too_long_key("x = \"\"\"\n" + times(200, ".\n") + "\"\"\"\n" + times(150, "b.")) == 203);
  CHECK(io::line_of_too_long_key("#") == 0);
}

TEST_CASE("nesting: records, states, scenes, settings and strokes of 100,000 levels are refused") {
  const std::string deep = lists(100000);
  const std::string record =
      R"(furrow wrinkle {"r_avg_structural":1,"r_avg_bending":1,"density":1,"options":"",)"
      R"("unit":"m","up":"y","lines":[],"strokes":)";
  CHECK_THROWS_WITH(io::find_wrinkle_record(read_from(ply_with(record + deep + "}"), io::MeshFormat::ply)),
                    Catch::Contains("nested more than 100 levels deep"));
  const std::string state = ply_with(record + "[]}\ncomment furrow state {\"scene\":" + deep + "}");
  CHECK_THROWS_WITH(io::parse_state(state, "s.ply"), Catch::Contains("nested more than 100 levels deep"));
  CHECK_THROWS_WITH(io::parse_toml("\n" + times(100000, "a.") + "a=1\n", "s.toml"),
                    Catch::Equals("s.toml:2: a key is nested more than 100 levels deep; no setting is"));
  io::TomlDocument document;
  CHECK_THROWS_WITH(io::set_value(document, times(100000, "a.") + "a", 1, "`set`"),
                    Catch::Contains("nested more than 100 levels deep"));
  CHECK_THROWS_WITH(io::JsonFields("s.json").parse("{\"strokes\":" + deep + "}"),
                    Catch::StartsWith("s.json: no valid JSON: nested more than 100 levels deep"));
}
