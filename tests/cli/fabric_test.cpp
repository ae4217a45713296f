// SPDX-License-Identifier: GPL-3.0-or-later
// furrow fabric, and where the warp runs: drape --warp, render --weave.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "geometry/mesh/warp_map.h"
#include "io/mesh/mesh_file.h"
#include "io/picture/png_file.h"
#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::tests;
using nlohmann::json;

namespace {

json told_by(const std::string& arguments) {
  const Run run = run_furrow(arguments + " --json");
  INFO(arguments << "\n" << run.err);
  REQUIRE(run.exit_code == 0);
  return json::parse(run.out);
}

std::string skirt_mesh() { return (source_dir() / "meshes/skirt.obj").string(); }

std::size_t faces_with_warp(const std::string& path) {
  const io::MeshFile file = io::read_mesh(path);
  const auto map = geometry::find_map(file.mesh, geometry::attribute::warp);
  std::size_t n = 0;
  if (map)
    for (geometry::Face f : file.mesh->faces()) n += std::isfinite((*map)[f][0]);
  return n;
}

}  // namespace

TEST_CASE("fabric: list has every fabric with its threads, show its source") {
  const json list = told_by("fabric list")["fabrics"];
  CHECK(list.size() >= 17);
  std::size_t woven = 0;
  for (const json& f : list) woven += f["threads"].get<bool>();
  CHECK(woven >= 7);
  const json denim = told_by("fabric show black-denim");
  CHECK(denim["warp_stretch"].get<double>() == Approx(410.5));
  CHECK(denim["source"].get<std::string>().find("ARCSim") != std::string::npos);
  CHECK(denim["bending_friction"].is_null());
  CHECK(told_by("fabric show cotton")["bending_friction"].get<double>() == Approx(1.216e-3 / 2));
  const Run none = run_furrow("fabric show corduroy");
  CHECK(none.exit_code == 2);
  CHECK(none.err.find("furrow fabric list has") != std::string::npos);
}

TEST_CASE("fabric: a disc drapes between limp and stiff, and stiffer cloth drapes less", "[release]") {
  const json limp = told_by("fabric drape polyester-twill --rings 10")["disc"];
  const json stiff = told_by("fabric drape black-denim --rings 10")["disc"];
  CHECK(limp["coefficient"].get<double>() < stiff["coefficient"].get<double>());
  CHECK(limp["coefficient"].get<double>() > 0.05);
  CHECK(stiff["coefficient"].get<double>() < 1.0);
}

TEST_CASE("fabric: a table of KES or FAST figures becomes settings, a wrong one is told") {
  ScratchDirectory scratch;
  std::ofstream(scratch / "kes.toml") << "[kes]\nW = 15\nEMT_warp = 4\nEMT_weft = 8\nG = 0.8\n"
                                         "B_warp = 0.1\nB_weft = 0.05\n";
  std::ofstream(scratch / "fast.toml") << "[fast]\nW = 180\nC_warp = 20\nC_weft = 16\nE100_warp = 3\n"
                                          "E100_weft = 5\nEB5 = 4\n";
  const json kes =
      told_by("fabric fit " + (scratch / "kes.toml") + " -o " + (scratch / "mine.toml"))["material"];
  CHECK(kes["density"].get<double>() == Approx(0.15));
  CHECK(kes["warp_rigidity"].get<double>() == Approx(9.80665e-6));
  CHECK(kes["warp_stretch"].get<double>() == Approx(12258.3).epsilon(1e-4));
  const json fast = told_by("fabric fit " + (scratch / "fast.toml"))["material"];
  CHECK(fast["warp_rigidity"].get<double>() == Approx(1.41221e-5).epsilon(1e-4));
  CHECK(fast["thread_shear"].get<double>() == Approx(30.75));
  std::ofstream(scratch / "bad.toml") << "[kes]\nW = 15\n";
  const Run bad = run_furrow("fabric fit " + (scratch / "bad.toml"));
  CHECK(bad.exit_code != 0);
  CHECK(bad.err.find("EMT_warp") != std::string::npos);
}

TEST_CASE("drape: cloth with threads writes where its warp runs, and says what it took", "[release]") {
  ScratchDirectory scratch;
  const std::string call = "drape " + skirt_mesh() + " --pin-loop top --fabric black-denim --subdivide 0 -o ";
  const Run usual = run_furrow(call + (scratch / "a.ply"));
  INFO(usual.err);
  REQUIRE(usual.exit_code == 0);
  CHECK(usual.err.find("nothing says where its threads run") != std::string::npos);
  const io::MeshFile worn = io::read_mesh(scratch / "a.ply");
  CHECK(faces_with_warp(scratch / "a.ply") == worn.mesh->number_of_faces());
  const Run again = run_furrow("drape " + (scratch / "a.ply") + " --pin-loop top -o " + (scratch / "b.ply"));
  CHECK(again.err.find("nothing says") == std::string::npos);
  CHECK(run_furrow("subdivide " + (scratch / "a.ply") + " --subdivide 1 -o " + (scratch / "fine.ply"))
            .exit_code == 0);
  CHECK(faces_with_warp(scratch / "fine.ply") == 4 * worn.mesh->number_of_faces());
  REQUIRE(run_furrow("render " + (scratch / "a.ply") + " --weave --size 200,200 -o " + (scratch / "w.png"))
              .exit_code == 0);
  CHECK(io::read_png(scratch / "w.png").width == 200);
}

TEST_CASE("warp: what cannot be is refused, with what to do") {
  ScratchDirectory scratch;
  const std::string base =
      skirt_mesh() + " --pin-loop top --fabric black-denim --subdivide 0 -o " + (scratch / "o.ply");
  const auto fails = [&](const std::string& call, const std::string& words) {
    const Run run = run_furrow(call);
    INFO(call << "\n" << run.err);
    CHECK(run.exit_code != 0);
    CHECK(run.err.find(words) != std::string::npos);
  };
  fails("drape " + base + " --warp sideways", "is none of auto, none, file");
  fails("drape " + base + " --warp file", "warp_x");
  fails("drape " + base + " --warp texture", "texture");
  fails("drape " + base + " --stretch 300", "warp = \"none\"");
  fails("render " + skirt_mesh() + " --warp y -o " + (scratch / "r.png"), "--weave");
}
