// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bridge/convert.h"
#include "io/mesh_file.h"
#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::tests;
using nlohmann::json;

namespace {

/// A patch that hangs by two corners.
std::string write_scene(const ScratchDirectory& scratch, const std::string& seconds = "0.15",
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

}  // namespace

TEST_CASE("chart: the recommendation holds against a finer reference, the next cheaper does not") {
  const ScratchDirectory scratch;
  const std::string scene = write_scene(scratch);
  const json report = report_of(run_furrow("chart --json " + scene));
  CHECK(report["complete"] == true);
  CHECK(report["shortened"] == false);
  CHECK(report["reference"]["error"] < 0.002);
  const json chosen = report["recommendation"];
  std::string cheaper;
  double cheaper_cost = 0;
  for (const json& c : report["candidates"]) {
    if (c["verdict"] == "too dear") continue;
    CHECK(c["error"].is_number());
    CHECK(c["cost"] > 0);
    if (c["cost"] < chosen["cost"] && c["cost"] > cheaper_cost)
      cheaper = c["flags"], cheaper_cost = c["cost"];
  }
  REQUIRE(!cheaper.empty());
  const auto fine = simulated(scratch, scene, "--dt 6e-6");
  CHECK(apart(simulated(scratch, scene, chosen["flags"]), fine) < 0.0101);
  CHECK(apart(simulated(scratch, scene, cheaper), fine) > 0.01);
}

TEST_CASE("chart: the same twice, to the byte") {
  const ScratchDirectory scratch;
  const std::string scene = write_scene(scratch, "0.05");
  const Run first = run_furrow("chart --json " + scene), second = run_furrow("chart --json " + scene);
  CHECK(first.exit_code == 0);
  CHECK(first.out == second.out);
}

TEST_CASE("chart: a motion without chaos is judged by positions, and the order of leapfrog shows") {
  const ScratchDirectory scratch;
  const json report = report_of(run_furrow("chart --json --tolerance 5% " + write_scene(scratch, "0.04")));
  CHECK(report["error_is"] == "positions");
  const json& all = report["candidates"];
  // Steps 1, 1/2 against 1/4: errors of order two are as 1 - 1/16 to 1/4 - 1/16.
  const double coarse = all[0]["rms"], fine = all[1]["rms"], reference = report["reference"]["error"];
  CHECK(coarse / fine == Approx(5).epsilon(0.1));
  CHECK(reference == Approx(fine / 3).epsilon(0.1));
}

TEST_CASE("chart: a budget that is too small shortens, or is refused with what is needed") {
  const ScratchDirectory scratch;
  const std::string scene = write_scene(scratch, "2");
  const json report = report_of(run_furrow("chart --json --tolerance 10% --budget 0.2 " + scene));
  CHECK(report["shortened"] == true);
  CHECK(report["judged_seconds"] < 1);
  CHECK(report["says"].get<std::string>().find("judged on the first") != std::string::npos);
  const Run refused = run_furrow("chart --budget 0.001 " + scene);
  CHECK(refused.exit_code == 2);
  CHECK(refused.err.find("raise it to") != std::string::npos);
}

TEST_CASE("chart: nothing within the tolerance exits with 4, a missing scene with 3, a bad call with 2") {
  const ScratchDirectory scratch;
  const std::string scene = write_scene(scratch, "0.1");
  const Run none = run_furrow("chart --tolerance 0.0000001% " + scene);
  CHECK(none.exit_code == 4);
  CHECK(none.err.find("larger --tolerance") != std::string::npos);
  CHECK(run_furrow("chart " + (scratch / "no.toml")).exit_code == 3);
  for (const char* flags : {"--tolerance 0.01", "--tolerance -1%", "--budget -1", "-o chart.pdf", "--set x"})
    CHECK(run_furrow("chart " + scene + " " + flags).exit_code == 2);
}

TEST_CASE("chart: numbers as CSV, and a picture where gnuplot is") {
  const ScratchDirectory scratch;
  const std::string scene = write_scene(scratch, "0.02"), csv = scratch / "c.csv", svg = scratch / "c.svg";
  CHECK(run_furrow("chart -q --tolerance 20% " + scene + " --csv " + csv).exit_code == 0);
  CHECK(read_text(csv).rfind("name,integrator,dt,cost,error,rms,max,bulk,verdict\n", 0) == 0);
  const bool has_gnuplot = std::system("command -v gnuplot >/dev/null 2>&1") == 0;
  const Run run = run_furrow("chart -q --tolerance 20% " + scene + " -o " + svg);
  CHECK(run.exit_code == (has_gnuplot ? 0 : 1));
  if (has_gnuplot) CHECK(read_text(svg).find("predicted seconds") != std::string::npos);
  if (!has_gnuplot) CHECK(run.err.find("gnuplot-nox") != std::string::npos);
}

TEST_CASE("simulate with --tolerance in percent takes the chart's recommendation and says its flags") {
  const ScratchDirectory scratch;
  const std::string scene = write_scene(scratch), end = scratch / "end.ply";
  const json chart = report_of(run_furrow("chart --json " + scene));
  const json run = report_of(run_furrow("simulate --json --tolerance 1% " + scene + " -o " + end));
  CHECK(run["choice"]["recommendation"] == chart["recommendation"]);
  CHECK(run["flags"].get<std::string>().find("--integrator xpbd --dt 0.0008333") != std::string::npos);
  const auto chosen = bridge::positions_of(io::read_mesh(end).mesh);
  CHECK(apart(chosen, simulated(scratch, scene, chart["recommendation"]["flags"])) == 0);
  CHECK(run_furrow("simulate --tolerance 0.001 " + scene + " -o " + end + " --seconds 0.001").exit_code != 0);
}
