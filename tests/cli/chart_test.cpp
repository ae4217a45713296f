// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bridge/arrays/convert.h"
#include "io/mesh/mesh_file.h"
#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::tests;
using nlohmann::json;

namespace {

/// A patch that hangs by two corners.
std::string write_patch_scene(const ScratchDirectory& scratch, const std::string& seconds = "0.15",
                              const std::string& more = "") {
  const std::string path = scratch / "patch.toml";
  write_text(path, "[garment]\nmesh = \"" FURROW_SOURCE_DIR
                   "/meshes/validation/patch.obj\"\n[[pins]]\nvertices = [0, 10]\n[simulation]\nseconds = " +
                       seconds + "\n" + more);
  return path;
}

json report_of(const Run& run) {
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  return json::parse(run.out);
}

std::vector<physics::Vec3> simulated(const ScratchDirectory& scratch, const std::string& scene,
                                     const std::string& flags) {
  const std::string end = scratch / "end.ply";
  const Run run = run_furrow("simulate -q " + scene + " -o " + end + " " + flags);
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  return bridge::positions_of(io::read_mesh(end).mesh);
}

/// RMS of the vertices over the patch's diagonal; its vertices weigh nearly the same.
double apart(const std::vector<physics::Vec3>& a, const std::vector<physics::Vec3>& b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]).squaredNorm();
  return std::sqrt(squares / double(a.size())) / std::hypot(0.1, 0.1);
}

/// Flags of the dearest that was tried below the recommendation.
std::string next_cheaper(const json& report) {
  std::string flags;
  double cost = 0;
  for (const json& c : report["candidates"])
    if (c["verdict"] != "too dear" && c["cost"] < report["recommendation"]["cost"] && c["cost"] > cost)
      flags = c["flags"], cost = c["cost"];
  REQUIRE(!flags.empty());
  return flags;
}

/// A box of 1.2 m below the patch, closed; `missing`: of its triangles, so many are left out.
std::string box(double top, int missing = 0) {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += "v " + std::to_string(i & 1 ? 0.6 : -0.6) + " " + std::to_string(i & 2 ? top : -0.5) + " " +
            std::to_string(i & 4 ? 0.6 : -0.6) + "\n";
  const char* const faces[] = {"1 3 4", "1 4 2", "5 6 8", "5 8 7", "1 2 6", "1 6 5",
                               "3 7 8", "3 8 4", "1 5 7", "1 7 3", "2 4 8", "2 8 6"};
  for (int i = missing; i < 12; ++i) text += std::string("f ") + faces[i] + "\n";
  return text;
}

}  // namespace

TEST_CASE("chart: the recommendation holds against a finer reference, the next cheaper does not",
          "[release]") {
  const ScratchDirectory scratch;
  const std::string scene = write_patch_scene(scratch);
  const json report = report_of(run_furrow("chart --json " + scene));
  CHECK(report["complete"] == true);
  CHECK(report["shortened"] == false);
  CHECK(report["reference"]["error"] < 0.002);
  for (const json& c : report["candidates"]) {
    if (c["verdict"] == "too dear") continue;
    CHECK(c["error"].is_number());
    CHECK(c["cost"] > 0);
  }
  const auto fine = simulated(scratch, scene, "--dt 6e-6");
  CHECK(apart(simulated(scratch, scene, report["recommendation"]["flags"]), fine) < 0.0101);
  CHECK(apart(simulated(scratch, scene, next_cheaper(report)), fine) > 0.01);
}

TEST_CASE("chart: the same twice, to the byte", "[long]") {
  const ScratchDirectory scratch;
  const std::string scene = write_patch_scene(scratch, "0.05");
  const Run first = run_furrow("chart --json " + scene), second = run_furrow("chart --json " + scene);
  CHECK(first.exit_code == 0);
  CHECK(first.out == second.out);
}

TEST_CASE("chart: a motion without chaos is judged by positions, and the order of leapfrog shows") {
  const ScratchDirectory scratch;
  const json report =
      report_of(run_furrow("chart --json --accuracy 5% " + write_patch_scene(scratch, "0.04")));
  CHECK(report["error_is"] == "positions");
  const json& all = report["candidates"];
  // Steps 1, 1/2 against 1/4: errors of order two are as 1 - 1/16 to 1/4 - 1/16.
  const double coarse = all[0]["rms"], fine = all[1]["rms"], reference = report["reference"]["error"];
  CHECK(coarse / fine == Approx(5).epsilon(0.1));
  CHECK(reference == Approx(fine / 3).epsilon(0.1));
}

TEST_CASE("chart: chaotic motion is judged by surface, centre, extent and energy", "[release]") {
  const ScratchDirectory scratch;
  const std::string scene = write_patch_scene(scratch, "0.2", "[material]\nbending = 0\n");
  const json report = report_of(run_furrow("chart --json --accuracy 2% " + scene));
  CHECK(report["twin_drift"] > 2e-4);
  CHECK(report["error_is"] == "shape");
  for (const json& c : report["candidates"]) {
    if (c["verdict"] == "too dear") continue;
    const double surface = c["surface"], centre = c["centre"], extent = c["extent"], error = c["error"];
    const double shape = std::max({surface, centre, extent}), energy = c["energy"];
    CHECK(error == std::max(shape, energy));
    CHECK(c[c["error_is"].get<std::string>()] == error);
    CHECK(shape <= c["rms"].get<double>() * (1 + 1e-12));
    CHECK(energy >= 0);
  }
  const auto fine = simulated(scratch, scene, "--dt 6e-6");
  CHECK(apart(simulated(scratch, scene, report["recommendation"]["flags"]), fine) < 0.02);
  CHECK(apart(simulated(scratch, scene, next_cheaper(report)), fine) > 0.02);
}

TEST_CASE("chart: leapfrog's energy converges by order two, as its positions do") {
  const ScratchDirectory scratch;
  const json report =
      report_of(run_furrow("chart --json --accuracy 20% " + write_patch_scene(scratch, "0.04")));
  // Steps 1, 1/2 against 1/4: as 1 - 1/16 to 1/4 - 1/16.
  const double coarse = report["candidates"][0]["energy"], fine = report["candidates"][1]["energy"];
  CHECK(fine > 0);
  CHECK(coarse / fine == Approx(5).epsilon(0.2));
}

TEST_CASE("chart: sweeps are those of the scene, and flags set them") {
  const ScratchDirectory scratch;
  const std::string scene = write_patch_scene(scratch, "0.02", "sweeps = 3\n"), end = scratch / "e.ply";
  const json report = report_of(run_furrow("chart --json --accuracy 50% " + scene));
  for (const json& c : report["candidates"]) {
    const std::string name = c["name"], flags = c["flags"];
    CHECK((flags.find(" --sweeps 3") != flags.npos) == (name.rfind("xpbd", 0) == 0));
  }
  const auto iterations = [&](const std::string& flags) {
    const json run = report_of(run_furrow("simulate --json " + scene + " -o " + end + flags));
    return run["iterations"].get<double>() / run["steps"].get<double>();
  };
  CHECK(iterations(" --integrator xpbd") == 3);
  CHECK(iterations(" --integrator xpbd --sweeps 7") == 7);
  const Run refused = run_furrow("simulate " + scene + " -o " + end + " --sweeps 0");
  CHECK(refused.exit_code != 0);
  CHECK(refused.err.find("sweeps") != std::string::npos);
}

TEST_CASE("chart: a body that changes its shape costs, and begins anew each run", "[release]") {
  const ScratchDirectory scratch;
  for (int frame = 0; frame < 3; ++frame)
    write_text(scratch / ("box_000" + std::to_string(frame) + ".obj"), box(-0.01 + 0.002 * frame));
  const json alone =
      report_of(run_furrow("chart --json --accuracy 50% " + write_patch_scene(scratch, "0.03")));
  const std::string end = scratch / "chosen.ply",
                    scene = write_patch_scene(scratch, "0.03",
                                              "[body]\nmesh = \"box_0000.obj\"\n"
                                              "frames = \"box_####.obj\"\n");
  const json moving =
      report_of(run_furrow("simulate --json --accuracy 50% " + scene + " -o " + end))["choice"];
  CHECK(moving["complete"] == true);
  for (std::size_t i = 0; i < moving["candidates"].size(); ++i)
    CHECK(moving["candidates"][i]["cost"] > alone["candidates"][i]["cost"].get<double>());
  // Of a garment alone --seconds names the table that these would be in, and none of them.
  const Run plain =
      run_furrow("simulate " FURROW_SOURCE_DIR "/meshes/validation/patch.obj --pin-vertices 0,10 -o " +
                 (scratch / "plain.ply") + " --seconds 0.01 --accuracy 5%");
  INFO(plain.err);
  CHECK(plain.err.find("chooses integrator and step") == std::string::npos);
  CHECK(plain.exit_code != 2);
  const auto chosen = bridge::positions_of(io::read_mesh(end).mesh);
  CHECK(apart(chosen, simulated(scratch, scene, moving["recommendation"]["flags"])) == 0);
}

TEST_CASE("chart: a budget that is too small shortens, or is refused with what is needed") {
  const ScratchDirectory scratch;
  const std::string scene = write_patch_scene(scratch, "2");
  const json report = report_of(run_furrow("chart --json --accuracy 10% --budget 0.2 " + scene));
  CHECK(report["shortened"] == true);
  CHECK(report["judged_seconds"] < 1);
  CHECK(report["says"].get<std::string>().find("judged on the first") != std::string::npos);
  const Run refused = run_furrow("chart --budget 0.001 " + scene);
  CHECK(refused.exit_code == 2);
  CHECK(refused.err.find("raise it to") != std::string::npos);
}

TEST_CASE("chart: nothing within the tolerance exits with 4, a missing scene with 3, a bad call with 2",
          "[long]") {
  const ScratchDirectory scratch;
  const std::string scene = write_patch_scene(scratch, "0.1");
  const Run none = run_furrow("chart --accuracy 0.0000001% " + scene);
  CHECK(none.exit_code == 4);
  CHECK(none.err.find("larger --accuracy") != std::string::npos);
  CHECK(run_furrow("chart " + (scratch / "no.toml")).exit_code == 3);
  for (const char* flags : {"--accuracy 0.01", "--accuracy -1%", "--budget -1", "-o chart.pdf", "--set x"})
    CHECK(run_furrow("chart " + scene + " " + flags).exit_code == 2);
}

TEST_CASE("chart: numbers as CSV, and a picture where gnuplot is") {
  const ScratchDirectory scratch;
  const std::string scene = write_patch_scene(scratch, "0.02"), csv = scratch / "c.csv",
                    svg = scratch / "c.svg";
  CHECK(run_furrow("chart -q --accuracy 20% " + scene + " --csv " + csv).exit_code == 0);
  CHECK(read_text(csv).rfind("name,integrator,dt,cost,error,error_is,rms,max,surface,centre,extent,borders,"
                             "energy,verdict\n",
                             0) == 0);
  const bool has_gnuplot = std::system("command -v gnuplot >/dev/null 2>&1") == 0;
  const Run run = run_furrow("chart -q --accuracy 20% " + scene + " -o " + svg);
  CHECK(run.exit_code == (has_gnuplot ? 0 : 1));
  if (has_gnuplot) CHECK(read_text(svg).find("predicted seconds") != std::string::npos);
  if (!has_gnuplot) CHECK(run.err.find("gnuplot-nox") != std::string::npos);
}

TEST_CASE("chart: simulate with --accuracy takes its recommendation and says its flags", "[release]") {
  const ScratchDirectory scratch;
  const std::string scene = write_patch_scene(scratch), end = scratch / "end.ply";
  const json chart = report_of(run_furrow("chart --json " + scene));
  const json run = report_of(run_furrow("simulate --json --accuracy 1% " + scene + " -o " + end));
  CHECK(run["choice"]["recommendation"] == chart["recommendation"]);
  const std::string flags = chart["recommendation"]["flags"];
  CHECK(run["flags"].get<std::string>().find(flags) != std::string::npos);
  for (const char* given : {"--integrator rk4", "--dt 1e-5"}) {
    const Run refused = run_furrow("simulate --accuracy 1% " + scene + " -o " + end + " " + given);
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.find("leave out one of them") != std::string::npos);
  }
  const auto chosen = bridge::positions_of(io::read_mesh(end).mesh);
  CHECK(apart(chosen, simulated(scratch, scene, chart["recommendation"]["flags"])) == 0);
  CHECK(run_furrow("simulate --tolerance 0.001 " + scene + " -o " + end + " --seconds 0.001").exit_code != 0);
}

TEST_CASE("chart: simulate with --accuracy reads and builds the body once") {
  const ScratchDirectory scratch;
  write_text(scratch / "box.obj", box(-0.01, 2));
  const std::string scene =
      write_patch_scene(scratch, "0.03", "[body]\nmesh = \"box.obj\"\ntolerance = 0.01\n");
  const Run run = run_furrow("simulate --accuracy 50% " + scene + " -o " + (scratch / "end.ply"));
  CHECK(run.exit_code == 0);
  const std::size_t first = run.err.find("of the body filled");
  REQUIRE(first != std::string::npos);
  CHECK(run.err.find("of the body filled", first + 1) == std::string::npos);
}

TEST_CASE("chart: implicit steps are tried, and their flags run as they were judged", "[long]") {
  const ScratchDirectory scratch;
  const std::string scene = write_patch_scene(scratch, "0.05");
  const json report = report_of(run_furrow("chart --json --accuracy 5% " + scene));
  const auto fine = simulated(scratch, scene, report["reference"]["flags"]);
  int tried = 0;
  for (const json& c : report["candidates"]) {
    const std::string flags = c["flags"];
    if (flags.find("implicit") == std::string::npos && flags.find("tr-bdf2") == std::string::npos) continue;
    INFO(c.dump());
    REQUIRE(c["verdict"] != "too dear");
    CHECK(apart(simulated(scratch, scene, flags), fine) == Approx(c["rms"].get<double>()).epsilon(0.05));
    ++tried;
  }
  CHECK(tried == 4);
}

TEST_CASE("chart: where dt_max bounds the cheapest step, the reference is still a quarter of it") {
  const ScratchDirectory scratch;
  const std::string soft = "[material]\nstiffness = 0.02\nbending = 0.002\ndensity = 1\n";
  const json report =
      report_of(run_furrow("chart --json --accuracy 50% " + write_patch_scene(scratch, "2", soft)));
  REQUIRE(report["dt_limit"] > 0.005 / 0.225);  // so that a quarter of it would be above dt_max
  const double coarse = report["candidates"][0]["dt"];
  CHECK(coarse == Approx(0.005).epsilon(0.01));
  CHECK(report["candidates"][1]["dt"] == Approx(coarse / 2).epsilon(0.01));
  CHECK(report["reference"]["dt"] == Approx(coarse / 4).epsilon(0.01));
}

TEST_CASE("chart: it replaces nothing that its scene reads") {
  const ScratchDirectory scratch;
  const std::string garment = scratch / "tent.obj",
                    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.1\nf 1 2 3\nf 2 4 3\n";
  write_text(garment, text);
  write_text(scratch / "tent.toml", "garment.mesh = \"tent.obj\"\n");
  const Run run = run_furrow("chart -q --replace " + (scratch / "tent.toml") + " --csv " + garment);
  CHECK(run.exit_code == 2);
  CHECK(run.err.find("would replace") != std::string::npos);
  CHECK(read_text(garment) == text);
}

TEST_CASE("chart: what diverges everywhere is no matter of the tolerance", "[long]") {
  const ScratchDirectory scratch;
  const std::string scene = scratch / "torn.toml";
  write_text(scene,
             "[garment]\nmesh = \"" FURROW_SOURCE_DIR
             "/meshes/validation/patch.obj\"\n[[pins]]\nvertices = [0, 10]\nmotion.keyframes = [{time = 0}, "
             "{time = 0.01, translation = [1000, 0, 0]}]\n[simulation]\nseconds = 0.05\n");
  const Run run = run_furrow("chart -q " + scene);
  CHECK(run.exit_code == 4);
  CHECK(run.err.find("diverged") != std::string::npos);
  CHECK(run.err.find("inf") == std::string::npos);
  CHECK(run.err.find("--accuracy") == std::string::npos);
}

TEST_CASE("chart: a setting of the scene that no run would take is refused before the work") {
  const ScratchDirectory scratch;
  const Run step = run_furrow("chart " + write_patch_scene(scratch, "0.1", "dt = 0.5\n"));
  CHECK(step.exit_code == 2);
  CHECK(step.err.find("stability limit") != std::string::npos);
  const Run denim =
      run_furrow("chart " + write_patch_scene(scratch, "0.1",
                                              "integrator = \"xpbd\"\n[material]\npreset = \"denim\"\n"));
  CHECK(denim.exit_code == 2);
  CHECK(denim.err.find("choose springs") != std::string::npos);
}

TEST_CASE("chart: a budget is a number above 0, and is for a choice") {
  const ScratchDirectory scratch;
  const std::string scene = write_patch_scene(scratch, "0.01"), end = scratch / "end.ply";
  for (const char* budget : {"0", "-1", "nan", "inf"}) {
    const Run run = run_furrow("chart " + scene + " --budget " + budget);
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("--budget") != std::string::npos);
  }
  const Run alone = run_furrow("simulate " + scene + " -o " + end + " --budget 5");
  CHECK(alone.exit_code == 2);
  CHECK(alone.err.find("--budget") != std::string::npos);
}
