// SPDX-License-Identifier: GPL-3.0-or-later
// furrow drape: a garment comes to rest on a body; wrong calls.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/property_names.h"
#include "io/animation_file.h"
#include "io/mesh_file.h"
#include "io/png_file.h"
#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::tests;
using nlohmann::json;

namespace {

/// The repository's skirt on its mannequin.
std::string skirt() {
  return (source_dir() / "meshes/skirt.obj").string() + " --body " +
         (source_dir() / "meshes/mannequin.obj").string();
}

}  // namespace

TEST_CASE("drape brings the skirt to rest on the mannequin, the same bits twice, and tells how it fits") {
  ScratchDirectory scratch;
  const std::string call = "drape " + skirt() + " --band top=0.95 --json";
  const Run run = run_furrow(call + " -o " + (scratch / "a.ply") + " --picture " + (scratch / "a.png") +
                             " --animation " + (scratch / "a.pc2"));
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const json r = json::parse(run.out);
  CHECK(r["converged"] == true);
  CHECK(r["residual_force"].get<double>() <= 1e-3);
  CHECK(r["touching"].get<int>() > 10);
  CHECK(r["fit"]["strain"]["p99"].get<double>() < 0.08);
  CHECK(r["fit"]["distance"]["deepest_penetration"].get<double>() < 5e-4);
  CHECK(r["levels"].size() == 1);
  const io::MeshFile worn = io::read_mesh(scratch / "a.ply");
  CHECK(worn.mesh.number_of_vertices() == r["levels"][0]["vertices"].get<std::size_t>());
  CHECK(geometry::find_map(worn.mesh, geometry::kRestLength));
  CHECK(io::read_png(scratch / "a.png").width > 0);
  CHECK(std::filesystem::file_size(scratch / "a.pc2") >
        12 * worn.mesh.number_of_vertices() * r["levels"][0]["iterations"].get<std::size_t>());
  REQUIRE(run_furrow(call + " -o " + (scratch / "b.ply") + " -q").exit_code == 0);
  REQUIRE(run_furrow(call + " -o " + (scratch / "c.ply") + " -q").exit_code == 0);
  CHECK(read_text(scratch / "b.ply") == read_text(scratch / "c.ply"));
}

TEST_CASE("drape: what cannot be done is told before the work") {
  ScratchDirectory scratch;
  const auto refused = [&](const std::string& arguments, const std::string& word) {
    const Run run = run_furrow("drape " + arguments);
    CAPTURE(arguments, run.err);
    CHECK(run.exit_code == 2);
    CHECK(run.err.find(word) != std::string::npos);
  };
  const std::string out = " -o " + (scratch / "x.ply");
  refused((source_dir() / "meshes/skirt.obj").string() + out, "--body");
  refused(skirt(), "nothing to write");
  refused(skirt() + out + " --band top", "--band");
  refused(skirt() + out + " --compare silk,cotton", "--picture");
  refused(skirt() + " -o " + (source_dir() / "meshes/skirt.obj").string(), "skirt.obj");
  refused(skirt() + out + " --residual 0", "--residual");
  refused(skirt() + out + " --band left=0.9", "left");
  refused(skirt() + out + " --set body.motion.spin={axis=[0,1,0],rate=1}", "body.motion");
  refused(skirt() + " --picture " + (scratch / "p.png") + " --compare cotton,slik", "slik");
  refused(skirt() + " --picture " + (scratch / "p.png") + " --compare cotton,,silk", "missing");
  CHECK_FALSE(std::filesystem::exists(scratch / "x.ply"));
  const Run few = run_furrow("drape " + skirt() + out + " --iterations 2 --fabric silk");
  CHECK(few.exit_code == 4);
  CHECK(few.err.find("not at rest") != std::string::npos);
  CHECK(std::filesystem::exists(scratch / "x.ply"));
}
