// SPDX-License-Identifier: GPL-3.0-or-later
// The garments of the journeys are sound, and lie about their body with the options that their frame needs.
#include <catch2/catch.hpp>

#include "journey.h"

using namespace furrow::tests;

TEST_CASE(
    "journeys: the dress in centimetres and the tunic off the origin are sound and lie about their body",
    "[release]") {
  const Journey here;
  here.bring("meshes/dress_cm.obj", "mine/dress.obj");
  here.bring_body_of_dress("mine/body.obj");
  CHECK(step("doctor mine/dress.obj --unit cm --up z --body mine/body.obj")["found"].empty());
  here.bring("meshes/tunic.obj");
  here.bring_body_of_tunic("she.obj");
  CHECK(step("doctor tunic.obj --body she.obj")["found"].empty());
}
