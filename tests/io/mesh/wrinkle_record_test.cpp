// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/mesh/errors.h"
#include "io/mesh/mesh_file.h"

using namespace furrow::io;

TEST_CASE("wrinkle_record: a wrinkle record reads back as written, heights that were not measured included") {
  MeshFile file;
  file.comments = {"made by hand"};
  WrinkleRecord record{
      0.02,
      0.035,
      0.3,
      "--rule safe",
      "cm",
      "z",
      {{"größe \n \"x\"", -0.01, NAN, 0.004, 0.001}, {"wide", 0.01, 0.01, 0.01, 0, 0.06, 0.25, 30}},
      "a shirt.obj",
      "00ff",
      R"({"strokes":[{"name":"é","height":0.01,"points":[[0.1,2.0,3.0]]}]})",
      {},
      {}};
  record.lines[1].crest_height = 0.02;
  record.lines[1].gather = 0.7;
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
  REQUIRE(back->lines.size() == 2);
  CHECK_FALSE(back->lines[0].width);
  CHECK(*back->lines[1].width == 0.06);
  CHECK(back->lines[1].sharpness == 0.25);
  CHECK_FALSE(back->lines[0].crest_height);
  CHECK(*back->lines[1].crest_height == 0.02);
  CHECK_FALSE(back->lines[0].gather);
  CHECK(*back->lines[1].gather == 0.7);
  CHECK(gathered_lines(*back) == std::vector<int>{1});
  CHECK(std::isnan(line_widths(*back)[0]));
  CHECK(line_widths(*back)[1] == 0.06);
  CHECK(line_presses(*back) == std::vector<double>{1, 30});
  CHECK(back->lines[0].name == record.lines[0].name);
  CHECK(back->lines[0].height == -0.01);
  CHECK(std::isnan(back->lines[0].drawn_height));
  CHECK(back->lines[0].smoothed_height == 0.004);
  CHECK(back->lines[0].base_height == 0.001);
  CHECK(back->garment == "a shirt.obj");
  CHECK(back->garment_hash == "00ff");
  CHECK(back->strokes == record.strokes);
}

TEST_CASE("wrinkle_record: a record of an earlier version has no strokes, garment and base heights") {
  MeshFile file;
  file.comments = {
      R"(furrow wrinkle {"r_avg_structural":1,"r_avg_bending":2,"density":3,"unit":"m","up":"y","options":"",)"
      R"("lines":[{"name":"a","height":1,"drawn_height":1,"smoothed_height":1}]})"};
  const auto record = find_wrinkle_record(file);
  REQUIRE(record);
  CHECK(record->strokes.empty());
  CHECK(record->garment.empty());
  CHECK(record->lines[0].base_height == 0);
}

TEST_CASE("wrinkle_record: a mesh without a record has none, a damaged one is an error") {
  MeshFile file;
  CHECK_FALSE(find_wrinkle_record(file));
  file.comments = {"furrow wrinkle {\"lines\": 3}"};
  CHECK_THROWS_AS(find_wrinkle_record(file), furrow::geometry::ContentError);
}

TEST_CASE("wrinkle_record: a wrinkle record keeps the material and the gap, and refuses damaged ones") {
  MeshFile file;
  WrinkleRecord record;
  set_wrinkle_record(file, record);
  CHECK(file.comments[0].find("material") == std::string::npos);  // not known: not written
  CHECK(find_wrinkle_record(file)->material.empty());
  CHECK(find_wrinkle_record(file)->contact_gap == 0);
  record.material = R"({"preset":"silk","friction":0.25})";
  record.contact_gap = 0.1 + 0.2;
  set_wrinkle_record(file, record);
  REQUIRE(file.comments.size() == 1);
  CHECK(find_wrinkle_record(file)->material == record.material);
  CHECK(find_wrinkle_record(file)->contact_gap == record.contact_gap);
  const std::string sound = file.comments[0];
  const auto damaged = [&](const std::string& from, const std::string& to) {
    file.comments[0] = sound;
    file.comments[0].replace(sound.find(from), from.size(), to);
    CHECK_THROWS_AS(find_wrinkle_record(file), furrow::geometry::ContentError);
  };
  damaged(record.material, "3");
  damaged("\"contact_gap\":", "\"contact_gap\":-");
  damaged("\"contact_gap\":", "\"contact_gap\":\"a\",\"x\":");
}
