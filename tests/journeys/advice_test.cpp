// SPDX-License-Identifier: GPL-3.0-or-later
// What furrow chart advises for a scene with a body, followed by furrow simulate.
#include <catch2/catch.hpp>

#include "geometry/refine/surface_deviation.h"
#include "io/mesh/mesh_file.h"
#include "journey.h"

using namespace furrow;
using namespace furrow::tests;

TEST_CASE("journeys: the advice of a chart, followed, is as near to the reference as it was said to be",
          "[release]") {
  const Journey here;
  here.bring("meshes/tunic.obj");
  here.bring_body_of_tunic("she.obj");
  write_text("worn.toml",
             "[garment]\nmesh = \"tunic.obj\"\n[body]\nmesh = \"she.obj\"\n[simulation]\nseconds = 0.1\n");
  const auto chart = step("chart worn.toml");
  const auto run = [](const nlohmann::json& setting, const std::string& output) {
    step("simulate worn.toml " + setting["flags"].get<std::string>() + " -o " + output);
    return io::read_mesh(output).mesh;
  };
  const geometry::Mesh advised = run(chart["recommendation"], "advised.ply"),
                       reference = run(chart["reference"], "reference.ply");
  const auto off = geometry::surface_deviation(advised, reference);
  const double size = chart["size"], said = chart["recommendation"]["error"];
  CAPTURE(off.median, off.p95, said * size);
  CHECK(said <= chart["tolerance"].get<double>());
  // Half of a surface lies within the square root of two of its root mean square, whatever its shape.
  CHECK(off.median <= 1.42 * said * size);
  CHECK(off.p95 <= chart["tolerance"].get<double>() * size);
}
