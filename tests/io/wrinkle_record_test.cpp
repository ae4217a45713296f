// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/wrinkle_record.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/errors.h"

using namespace furrow::io;

TEST_CASE("a wrinkle record reads back as written, heights that were not measured included") {
  MeshFile file;
  file.comments = {"made by hand"};
  const WrinkleRecord record{
      0.02, 0.035, 0.3, "--rule safe", "cm", "z", {{"größe \n \"x\"", -0.01, NAN, 0.004}}};
  set_wrinkle_record(file, {});
  set_wrinkle_record(file, record);
  REQUIRE(file.comments.size() == 2);
  CHECK(file.comments[1].find('\n') == std::string::npos);
  const auto back = find_wrinkle_record(file);
  REQUIRE(back);
  CHECK(back->mean_structural_length == 0.02);
  CHECK(back->mean_bending_length == 0.035);
  CHECK(back->density == 0.3);
  CHECK(back->unit == "cm");
  CHECK(back->up == "z");
  REQUIRE(back->lines.size() == 1);
  CHECK(back->lines[0].name == record.lines[0].name);
  CHECK(back->lines[0].height == -0.01);
  CHECK(std::isnan(back->lines[0].drawn_height));
  CHECK(back->lines[0].smoothed_height == 0.004);
}

TEST_CASE("a mesh without a record has none, a damaged one is an error") {
  MeshFile file;
  CHECK_FALSE(find_wrinkle_record(file));
  file.comments = {"furrow wrinkle {\"lines\": 3}"};
  CHECK_THROWS_AS(find_wrinkle_record(file), furrow::geometry::ContentError);
}
