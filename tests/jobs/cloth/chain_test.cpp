// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/chain.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bridge/arrays/convert.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "io/scene/scene.h"
#include "jobs/chain/keep.h"
#include "jobs/chain/wrinkle.h"
#include "jobs/mesh/info.h"
#include "jobs/move/chart.h"
#include "jobs/move/simulate.h"
#include "jobs/rest/drape.h"
#include "jobs/rest/fit.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/physics/rest/hanging_chains.h"
#include "tests/test_paths.h"

using namespace furrow;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

struct Threads {
  std::vector<physics::Vec3> points;
  std::vector<std::vector<int>> lines;  // from 0
};

fs::path write_lines(const fs::path& path, const Threads& threads) {
  std::ofstream out(path);
  out.precision(17);
  for (const physics::Vec3& p : threads.points) out << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  for (const std::vector<int>& line : threads.lines) {
    out << 'l';
    for (const int v : line) out << ' ' << v + 1;
    out << '\n';
  }
  return path;
}

/// A V of 1.5 m between (0, 0, 0) and (1, 0, 0), of uneven links.
Threads uneven_v(int links = 32) {
  Threads threads{{}, {{}}};
  for (int i = 0; i <= links; ++i) {
    const double t = double(i) / links;
    const double s = t + 0.4 / (2 * std::numbers::pi) / links * 4 * std::sin(8 * std::numbers::pi * t);
    threads.points.emplace_back(s, -std::sqrt(0.3125) * (1 - std::abs(2 * s - 1)), 0);
    threads.lines[0].push_back(i);
  }
  return threads;
}

jobs::SimulateJob job_of(const fs::path& mesh, const std::string& settings) {
  jobs::SimulateJob job;
  job.scene.settings = io::parse_toml(settings, "test");
  io::set_value(job.scene.settings, "garment.mesh", mesh.string(), "test");
  return job;
}

const std::string chain_by_ends =
    "[[pins]]\nvertices = [0, 32]\n[material]\nline_stretch = 147.15\n"
    "line_density = 0.06666666666666667\n";
const std::string chain_settles = "[simulation]\nsettle = true\nseconds = 0\n";

/// What the file means, put together by hand: k = EA / L, half of a link's mass to either end.
physics::Cloth cloth_of(const Threads& threads, double stretch, double density) {
  physics::Cloth cloth;
  for (const physics::Vec3& p : threads.points) tests::add_particle(cloth, p, 1);
  std::fill(cloth.particles.mass.begin(), cloth.particles.mass.end(), 0);
  for (std::size_t i = 0; i + 1 < threads.points.size(); ++i) {
    const double rest = (threads.points[i + 1] - threads.points[i]).norm();
    cloth.structural.push_back({int(i), int(i) + 1, rest, stretch / rest});
    for (const std::size_t end : {i, i + 1}) cloth.particles.mass[end] += density * rest / 2;
  }
  return cloth;
}

io::MeshFile sheet_file() {
  io::MeshFile file;
  file.mesh = geometry::equilateral_sheet(0.4, 0.4, 0.1);
  return file;
}

/// From the first vertex on.
double farthest(const io::MeshFile& garment, const std::vector<Eigen::Vector2d>& exact) {
  const std::vector<physics::Vec3> x = bridge::positions_of(garment.mesh);
  double distance = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    distance = std::max(distance, (x[i] - x[0] - physics::Vec3(exact[i].x(), exact[i].y(), 0)).norm());
  return distance;
}

}  // namespace

TEST_CASE("chain: an uneven one that settles hangs as the exact discrete catenary") {
  const fs::path folder = tests::empty_folder("chain_rest");
  const Threads v = uneven_v();
  tests::Recorder recorder;
  const jobs::SimulateReport report =
      jobs::simulate(job_of(write_lines(folder / "v.obj", v), chain_by_ends + chain_settles), recorder);
  CHECK_FALSE(report.fails());
  REQUIRE(report.rest);
  CHECK(report.rest->settle.converged);
  const physics::Cloth cloth = cloth_of(v, 147.15, 0.06666666666666667);
  CHECK(farthest(report.garment, tests::exact_chain(cloth)) < 1e-6);
  CHECK(report.run.strain.max > 0.003);  // told of the links: EA = 150 weights
  CHECK(report.run.strain.max < 0.02);
  CHECK(report.energy->stretch > 0);
  CHECK(report.energy->ties == 0);
  CHECK(report.shape->centre.y() < -0.29);  // -0.28 as drawn
  CHECK(recorder.warnings.empty());
}

TEST_CASE("chain: the scene of the repository is a catenary") {
  jobs::SimulateJob job;
  job.scene = jobs::scene_from_file(tests::source_dir() / "scenes/chain.toml");
  tests::Recorder recorder;
  const jobs::SimulateReport report = jobs::simulate(job, recorder);
  CHECK_FALSE(report.fails());
  const io::ReadOptions chains{.chains = true};
  const io::MeshFile drawn = io::read_mesh(tests::source_dir() / "meshes/chain.obj", chains);
  const physics::Cloth cloth = cloth_of({bridge::positions_of(drawn.mesh), {}}, 150, 0.07);
  CHECK(farthest(report.garment, tests::exact_chain(cloth)) < 1e-6);
}

TEST_CASE("chain: a link with a mass at its end swings with a pendulum's period") {
  const fs::path folder = tests::empty_folder("chain_pendulum");
  const double length = 0.5, angle = 0.4;
  const physics::Vec3 end(length * std::sin(angle), -length * std::cos(angle), 0);
  const fs::path mesh = write_lines(folder / "pendulum.obj", {{{0, 0, 0}, end}, {{0, 1}}});
  const double period = 4 * std::sqrt(length / 9.81) * std::comp_ellint_1(std::sin(angle / 2));
  tests::Recorder recorder;
  jobs::SimulateJob job = job_of(mesh,
                                 "[[pins]]\nvertices = [0]\n[material]\nline_stretch = 20000\n"
                                 "line_density = 0.1\ndamping = 0\ndrag = 0\n");
  const auto at = [&](double share) {
    io::set_value(job.scene.settings, "simulation.seconds", share * period, "test");
    const jobs::SimulateReport report = jobs::simulate(job, recorder);
    CHECK(report.run.outcome == physics::Outcome::finished);
    return bridge::positions_of(report.garment.mesh)[1];
  };
  const double speed = 2 * std::sqrt(9.81 * length) * std::sin(angle / 2);  // at the lowest point
  CHECK(std::abs(at(1.25).x()) < 1e-3 * period * speed);
  CHECK(std::abs(at(1.25).y() + length) < 1e-3 * length);
  CHECK((at(1) - end).norm() < 1e-3 * length);
  CHECK((at(0.5) - physics::Vec3(-end.x(), end.y(), 0)).norm() < 1e-3 * length);
}

TEST_CASE("chain: a run that was stopped and goes on from its state has the same bits") {
  const fs::path folder = tests::empty_folder("chain_resume");
  const fs::path mesh = write_lines(folder / "v.obj", uneven_v());
  tests::Recorder recorder;
  for (const std::string integrator : {"leapfrog", "implicit"}) {
    const std::string settings =
        "[[pins]]\nvertices = [0, 32]\n[simulation]\nseconds = 0.2\nintegrator = \"" + integrator + "\"\n";
    const jobs::SimulateReport whole = jobs::simulate(job_of(mesh, settings), recorder);
    jobs::SimulateJob first = job_of(mesh, settings + "stop_at = 0.1\n");
    const fs::path state = folder / (integrator + ".ply");
    io::set_value(first.scene.settings, "output.state", state.string(), "the test");
    jobs::simulate(first, recorder);
    const jobs::SimulateReport second = jobs::simulate(jobs::resume_from(state), recorder);
    CHECK(second.run.time == whole.run.time);
    CHECK(tests::positions(second.garment) == tests::positions(whole.garment));
    CHECK(tests::positions(whole.garment)[8].y() < -0.3);  // from -0.28
    jobs::SimulateJob stiffer = jobs::resume_from(state);
    io::set_value(stiffer.scene.settings, "material.line_stretch", 3000, "test");
    CHECK(tests::positions(jobs::simulate(stiffer, recorder).garment) != tests::positions(whole.garment));
  }
}

TEST_CASE("chain: a PLY gives the same chain again, and an OBJ its lines") {
  const fs::path folder = tests::empty_folder("chain_files");
  tests::Recorder recorder;
  jobs::SimulateJob job = job_of(write_lines(folder / "v.obj", uneven_v()), chain_by_ends + chain_settles);
  io::set_value(job.scene.settings, "output.mesh", (folder / "rest.ply").string(), "the test");
  const jobs::SimulateReport rest = jobs::simulate(job, recorder);

  const io::ReadOptions chains{.chains = true};
  const io::MeshFile read = io::read_mesh(folder / "rest.ply", chains);
  CHECK(tests::positions(read) == tests::positions(rest.garment));
  const auto before = geometry::struts(rest.garment.mesh), after = geometry::struts(read.mesh);
  REQUIRE(before.size() == 32);
  REQUIRE(after.size() == 32);
  for (std::size_t i = 0; i < 32; ++i) {
    CHECK(after[i].rest_length == before[i].rest_length);
    CHECK(after[i].stiffness == before[i].stiffness);
  }
  const jobs::SimulateReport again =
      jobs::simulate(job_of(folder / "rest.ply", "[[pins]]\nvertices = [0, 32]\n" + chain_settles), recorder);
  for (std::size_t i = 0; i < 33; ++i)
    CHECK(
        std::sqrt((tests::positions(again.garment)[i] - tests::positions(rest.garment)[i]).squared_length()) <
        1e-6);
  const jobs::SimulateReport heavier =
      jobs::simulate(job_of(folder / "rest.ply",
                            "[[pins]]\nvertices = [0, 32]\n[material]\nline_density = 0.2\n" + chain_settles),
                     recorder);
  CHECK(tests::positions(heavier.garment)[16].y() < tests::positions(rest.garment)[16].y() - 1e-3);

  io::write_mesh(folder / "rest.obj", rest.garment);
  const io::MeshFile lines = io::read_mesh(folder / "rest.obj", chains);
  REQUIRE(lines.polylines.size() == 1);
  CHECK(lines.polylines[0].vertices.size() == 33);
  const jobs::Json info = jobs::info(read);
  CHECK(info["chain"]["links"] == 32);
  CHECK(info["chain"]["length"].get<double>() == Approx(1.5));
  CHECK(jobs::info(lines)["chain"]["links"] == 32);
  CHECK_FALSE(jobs::info(sheet_file()).contains("chain"));
}

TEST_CASE("chain: lines that part and close are a net, repeated parts count once, loose points stay") {
  const fs::path folder = tests::empty_folder("chain_net");
  Threads net{{{0, 0, 0}, {1, 0, 0}, {1, -1, 0}, {0, -1, 0}, {0.5, -2, 0}, {7, 7, 7}}, {}};
  net.lines = {{0, 1, 2, 3, 0}, {1, 0}, {3, 4}, {2, 4}};
  tests::Recorder recorder;
  const jobs::SimulateReport report = jobs::simulate(
      job_of(write_lines(folder / "net.obj", net),
             "[[pins]]\nvertices = [0, 1]\n[material]\nline_density = 0.1\n[simulation]\nseconds = 0.1\n"),
      recorder);
  CHECK(geometry::struts(report.garment.mesh).size() == 6);
  const auto mass = *geometry::find_map(report.garment.mesh, geometry::attribute::mass);
  double total = 0;
  for (const geometry::Vertex v : report.garment.mesh->vertices()) total += mass[v];
  CHECK(total == Approx(0.1 * (4 + 2 * std::hypot(0.5, 1))));
  CHECK(tests::positions(report.garment)[5] == geometry::Point(7, 7, 7));
  CHECK(tests::positions(report.garment)[4].y() < -2);
}

TEST_CASE("chain: a body carries it, and it is told where it lies inside") {
  const fs::path folder = tests::empty_folder("chain_body");
  Threads thread{{}, {{}}};
  for (int i = 0; i <= 20; ++i) {
    thread.points.emplace_back(-0.4 + 0.04 * i, 0.02, 0);
    thread.lines[0].push_back(i);
  }
  jobs::SimulateJob job = job_of(write_lines(folder / "thread.obj", thread),
                                 "[body]\nmesh = \"slab\"\n[simulation]\nseconds = 0.5\n");
  job.scene.settings.root["body"]["mesh"] = (tests::source_dir() / "meshes/validation/slab.obj").string();
  tests::Recorder recorder;
  const jobs::SimulateReport report = jobs::simulate(job, recorder);
  CHECK_FALSE(report.fails());
  REQUIRE(report.shape->contact);
  CHECK(report.shape->contact->inside.inside == 0);
  for (const geometry::Point& p : tests::positions(report.garment)) {
    CHECK(p.y() > 0);
    CHECK(p.y() < 0.019);
  }
}

TEST_CASE("chain: what needs faces refuses one in a sentence") {
  const fs::path folder = tests::empty_folder("chain_refused");
  const fs::path mesh = write_lines(folder / "v.obj", uneven_v());
  jobs::Listener listener;
  const auto refused = Contains("a chain, which `furrow simulate` moves");
  CHECK_THROWS_WITH(io::read_mesh(mesh), refused);
  const jobs::SceneInput scene =
      job_of(mesh, "[[pins]]\nvertices = [0, 32]\n[material]\nbending_law = \"hinge\"\n").scene;
  jobs::DrapeJob drape;
  drape.scene = scene;
  CHECK_THROWS_WITH(jobs::drape(drape, listener), refused);
  jobs::ChartJob chart;
  chart.scene = scene;
  CHECK_THROWS_WITH(jobs::chart(chart, listener), refused);
  jobs::KeepJob keep;
  keep.scene = scene;
  CHECK_THROWS_WITH(jobs::keep(keep, listener), refused);
  jobs::FitJob fit;
  fit.worn = {mesh};
  fit.bodies = {tests::source_dir() / "meshes/validation/ball.obj"};
  CHECK_THROWS_WITH(jobs::fit(fit, listener), refused);
  jobs::WrinkleJob wrinkle;
  wrinkle.garment = mesh;
  wrinkle.strokes = tests::source_dir() / "meshes/strokes/sheet.json";
  CHECK_THROWS_WITH(jobs::wrinkle(wrinkle, listener), refused);

  jobs::SimulateJob run = job_of(mesh, chain_by_ends + "[simulation]\nseconds = 0.01\n");
  io::set_value(run.scene.settings, "output.state", (folder / "state.ply").string(), "the test");
  jobs::simulate(run, listener);
  keep.state_path = wrinkle.state_path = folder / "state.ply";
  keep.state = wrinkle.state = io::read_state(folder / "state.ply");
  keep.scene = {io::document_of(keep.state->scene, "state.ply"), folder, {}};
  io::set_value(keep.scene.settings, "material.bending_law", "hinge", "the test");
  CHECK_THROWS_WITH(jobs::keep(keep, listener), refused);
  wrinkle.output = folder / "drawn.ply";
  CHECK_THROWS_WITH(jobs::wrinkle(wrinkle, listener), refused);
  CHECK(tests::names_in(folder) == std::set<std::string>{"state.ply", "v.obj"});
}

TEST_CASE("chain: simulate refuses what a chain has no faces for, before anything is written") {
  const fs::path folder = tests::empty_folder("chain_settings");
  const fs::path mesh = write_lines(folder / "v.obj", uneven_v());
  const auto run = [&](const std::string& key, const io::Json& value) {
    jobs::SimulateJob job = job_of(mesh, chain_by_ends + "[simulation]\nseconds = 0.01\n");
    io::set_value(job.scene.settings, key, value, "the test");
    jobs::Listener listener;
    jobs::simulate(job, listener);
  };
  CHECK_THROWS_WITH(run("garment.subdivide", 1), Contains("a chain, without faces"));
  CHECK_THROWS_WITH(run("lines.0.strokes", (tests::source_dir() / "meshes/strokes/sheet.json").string()),
                    Contains("a chain, without faces"));
  CHECK_THROWS_WITH(run("output.mesh", (folder / "out.stl").string()), Contains("the garment is a chain"));
  CHECK_THROWS_WITH(run("output.animation", (folder / "out.glb").string()),
                    Contains("the garment is a chain"));
  CHECK_THROWS_WITH(run("pins.0.loop", "top"), Contains("no border"));
  jobs::SimulateJob judged = job_of(mesh, chain_by_ends + "[simulation]\nseconds = 0.01\n");
  judged.tolerance = 0.01;
  jobs::Listener silent;
  CHECK_THROWS_WITH(jobs::simulate(judged, silent), Contains("a chain, without faces"));
  CHECK_THROWS_WITH(run("material.line_stretch", -1), Contains("line_stretch"));
  CHECK(tests::names_in(folder) == std::set<std::string>{"v.obj"});
  Threads folded = uneven_v();
  folded.points[5] = folded.points[6];
  write_lines(mesh, folded);
  CHECK_THROWS_WITH(run("title", "one"), Contains("vertex 5 to 6 has no length") && Contains("v.obj"));
}

TEST_CASE("chain: settings of cloth on a chain, and of chains on cloth, are told of") {
  const fs::path folder = tests::empty_folder("chain_warnings");
  const std::string moved = "[simulation]\nseconds = 0.001\n";
  tests::Recorder of_chain, of_cloth;
  jobs::simulate(job_of(write_lines(folder / "v.obj", uneven_v()),
                        "[[pins]]\nvertices = [0]\n[material]\ndensity = 0.1\n" + moved),
                 of_chain);
  CHECK(of_chain.warned_of("chain_settings"));
  io::write_mesh(folder / "sheet.obj", sheet_file());
  jobs::simulate(
      job_of(folder / "sheet.obj", "[[pins]]\nvertices = [0]\n[material]\nline_density = 0.1\n" + moved),
      of_cloth);
  CHECK(of_cloth.warned_of("chain_settings"));
}
