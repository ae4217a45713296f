// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/equivalent_flags.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "io/base/field_words.h"
#include "io/scene/settings_schema.h"

using namespace furrow;
using io::equivalent_flags, io::Json;

TEST_CASE("equivalent_flags: a flag where there is one, --set for the rest, and the garment first") {
  const Json scene{{"title", "for people"},
                   {"unit", "cm"},
                   {"garment", {{"mesh", "my skirt.obj"}, {"subdivide", 1}}},
                   {"lines", Json::array({{{"strokes", "l.json"}, {"time", 1.5}}})},
                   {"material", {{"preset", "denim"}, {"poisson", 0.2}}},
                   {"pins", Json::array({{{"loop", "top"}}})},
                   {"forces", {{"gravity", Json{0, -1, 0}}, {"swirl", {{"rate", 3}}}}},
                   {"simulation", {{"dt", 0.001}, {"force_dt", true}}},
                   {"output", {{"mesh", "o.ply"}}}};
  CHECK(equivalent_flags(scene, "", {}) ==
        "simulate 'my skirt.obj' --unit cm --subdivide 1 --set 'lines.0.strokes=\"l.json\"' --set "
        "lines.0.time=1.5 --fabric denim --set material.poisson=0.2 --set 'pins.0.loop=\"top\"' --gravity "
        "'[0, -1, 0]' --set forces.swirl.rate=3 --dt 0.001 --force-dt --output o.ply");
}

TEST_CASE("equivalent_flags: a switch that is off needs no flag, and a quote in a name is kept") {
  CHECK(equivalent_flags(Json{{"simulation", {{"force_dt", false}}}}, "", {}) == "simulate");
  CHECK(equivalent_flags(Json{{"garment", {{"mesh", "a'b.obj"}}}}, "", {}) == "simulate 'a'\\''b.obj'");
}

TEST_CASE("equivalent_flags: of a state, what is not as the state had it") {
  const Json before{{"garment", {{"mesh", "g.obj"}}},
                    {"material", {{"bending", 1}, {"drag", 2}}},
                    {"pins", Json::array({{{"loop", "top"}}, {{"loop", "bottom"}}})}};
  Json now = before;
  CHECK(equivalent_flags(now, "at1.ply", before) == "simulate --state at1.ply");
  now["material"]["bending"] = 5;
  now["pins"][1]["motion"]["spin"]["rate"] = 2;
  CHECK(equivalent_flags(now, "at1.ply", before) ==
        "simulate --state at1.ply --bending 5 --set pins.1.motion.spin.rate=2");
}

TEST_CASE("equivalent_flags: every setting of the schema with a flag is said with it") {
  for (const io::Setting& s : io::scene_settings()) {
    if (s.keyword.empty() || s.table().empty() || s.table() == "pins") continue;
    const Json value = s.kind == io::Kind::yes_no ? Json(true) : s.is_text() ? Json("word") : Json(3);
    const std::string shown = s.kind == io::Kind::yes_no ? "" : s.is_text() ? " word" : " 3";
    CHECK(equivalent_flags(Json{{s.table(), {{s.key(), value}}}}, "", {}) ==
          "simulate " + io::flag_of(s.keyword) + shown);
  }
}
