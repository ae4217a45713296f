// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/fit.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <thread>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/vertex_attributes.h"
#include "geometry/rest/rest_metric.h"
#include "physics/base/progress.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

/// A sleeve around a ball, in memory, a tenth longer than it was made.
jobs::FitJob worn_sleeve(double radius = 0.12) {
  io::MeshFile sleeve, ball;
  sleeve.mesh = tests::cylinder(radius, 0.12, 16, 4);
  geometry::ensure_rest_lengths(sleeve.mesh);
  auto rest = *geometry::find_map(sleeve.mesh, geometry::attribute::rest_length);
  for (geometry::Edge e : sleeve.mesh->edges()) rest[e] /= 1.1;
  ball.mesh = tests::icosphere(2, 0.1, {0, 0.06, 0});
  jobs::FitJob job;
  job.worn = {sleeve};
  job.bodies = {ball};
  return job;
}

/// Without what it was made of.
void forget_rest(jobs::MeshInput& input) {
  io::MeshFile& file = std::get<io::MeshFile>(input);
  auto rest = geometry::find_map(file.mesh, geometry::attribute::rest_length);
  file.mesh->remove_property_map(rest.value());
}

}  // namespace

TEST_CASE("fit: a garment and a body in memory come to the bits of their files") {
  const fs::path folder = tests::empty_folder("fit_memory");
  tests::Recorder recorder;
  const jobs::FitJob in_memory = worn_sleeve();
  jobs::FitJob of_files = in_memory;
  io::write_mesh(folder / "sleeve.ply", tests::mesh_of(in_memory.worn[0]));
  io::write_mesh(folder / "ball.ply", tests::mesh_of(in_memory.bodies[0]));
  of_files.worn = {folder / "sleeve.ply"};
  of_files.bodies = {folder / "ball.ply"};
  of_files.output = folder / "fitted.ply";
  const jobs::FitJobReport a = jobs::fit(in_memory, recorder), b = jobs::fit(of_files, recorder);
  REQUIRE(a.garments.at(0).report.strain);
  CHECK(a.garments[0].report.strain->p50 == Approx(0.1));
  CHECK(a.shown == jobs::FitColour::strain);
  CHECK(geometry::find_map(a.garments[0].garment.mesh, geometry::attribute::color).has_value());
  CHECK(tests::positions(a.garments[0].garment) == tests::positions(b.garments[0].garment));
  CHECK(to_json(a) == to_json(b));
  const io::MeshFile written = io::read_mesh(folder / "fitted.ply");
  CHECK(tests::positions(written) == tests::positions(b.garments[0].garment));
  CHECK(geometry::vertex_attributes(written.mesh).size() ==
        geometry::vertex_attributes(b.garments[0].garment.mesh).size());
}

TEST_CASE("fit: what is not known is warned of by its code") {
  tests::Recorder recorder;
  jobs::FitJob job = worn_sleeve();
  const io::MeshFile made = tests::mesh_of(job.worn[0]);
  forget_rest(job.worn[0]);
  const jobs::FitJobReport unknown = jobs::fit(job, recorder);
  CHECK(recorder.warned_of("strain_unknown"));
  CHECK(recorder.warned_of("sections_not_found"));
  CHECK_FALSE(unknown.garments[0].report.strain);
  CHECK(unknown.shown == jobs::FitColour::distance);
  tests::Recorder second;
  job.rest = made;  // as it is worn, so nothing is strained
  const jobs::FitJobReport known = jobs::fit(job, second);
  CHECK_FALSE(second.warned_of("strain_unknown"));
  REQUIRE(known.garments[0].report.strain);
  CHECK(known.garments[0].report.strain->max == Approx(0).margin(1e-12));
}

TEST_CASE("fit: a cancelled job leaves nothing", "[long]") {
  const fs::path folder = tests::empty_folder("fit_cancelled");
  jobs::FitJob job = worn_sleeve();
  job.output = folder / "fitted.ply";
  tests::Recorder all;
  jobs::fit(job, all);
  REQUIRE(all.asked >= 2);
  for (int at = 1; at <= all.asked; at += std::max(1, all.asked / 30)) {
    fs::remove(job.output);
    tests::Recorder recorder(at);
    CHECK_THROWS_AS(jobs::fit(job, recorder), physics::Cancelled);
    CHECK(tests::names_in(folder).empty());
  }
}

TEST_CASE("fit: a job that cannot be is refused before anything is written") {
  const fs::path folder = tests::empty_folder("fit_refused");
  tests::Recorder recorder;
  const jobs::FitJob good = worn_sleeve();
  io::write_mesh(folder / "sleeve.ply", tests::mesh_of(good.worn[0]));
  const std::string sleeve = tests::bytes_of(folder / "sleeve.ply");
  const auto refused = [&](const auto& spoil) {
    jobs::FitJob job = good;
    job.output = folder / "fitted.ply";
    spoil(job);
    CHECK_THROWS_AS(jobs::fit(job, recorder), std::invalid_argument);
  };
  refused([](auto& job) { job.worn.clear(); });
  refused([](auto& job) { job.bodies.clear(); });
  refused([](auto& job) { job.bodies.push_back(job.bodies[0]); });
  refused([](auto& job) { job.worn.push_back(job.worn[0]); });
  refused([](auto& job) { job.range = 0; });
  refused([](auto& job) { job.contact = -1; });
  refused([](auto& job) { job.options.tight_strain = 0; });
  refused([&](auto& job) { job.output = folder / "fitted.txt"; });
  refused([&](auto& job) { job.more_outputs = {job.output.string()}; });
  refused([&](auto& job) { job.worn = {folder / "sleeve.ply"}, job.output = folder / "sleeve.ply"; });
  jobs::FitJob job = good;
  job.output = folder / "nowhere" / "fitted.ply";
  CHECK_THROWS_AS(jobs::fit(job, recorder), std::runtime_error);
  job.output = folder / "fitted.ply";
  job.rest = job.bodies[0];
  CHECK_THROWS_AS(jobs::fit(job, recorder), geometry::ContentError);
  job.rest.reset();
  job.colour = jobs::FitColour::strain;
  forget_rest(job.worn[0]);
  CHECK_THROWS_AS(jobs::fit(job, recorder), geometry::ContentError);
  CHECK(tests::names_in(folder) == std::set<std::string>{"sleeve.ply"});
  CHECK(tests::bytes_of(folder / "sleeve.ply") == sleeve);
}

TEST_CASE("fit: is cancelled within its measuring, too, and writes nothing then") {
  const fs::path folder = tests::empty_folder("fit_cancel");
  jobs::FitJob job = worn_sleeve();
  job.output = folder / "fitted.ply";
  tests::Recorder patient;
  jobs::fit(job, patient);
  REQUIRE(patient.asked > int(tests::mesh_of(job.worn[0]).mesh->number_of_vertices()));
  fs::remove(job.output);
  for (int at = 1; at <= patient.asked; at += std::max(1, patient.asked / 20)) {
    INFO("cancelled at question " << at << " of " << patient.asked);
    tests::Recorder recorder(at);
    CHECK_THROWS_AS(jobs::fit(job, recorder), physics::Cancelled);
    CHECK(tests::names_in(folder).empty());
  }
}

TEST_CASE("fit: two jobs at once in one process give the bits of single runs") {
  tests::Recorder recorder;
  const jobs::FitJob one = worn_sleeve(0.12), two = worn_sleeve(0.15);
  const jobs::FitJobReport single_one = jobs::fit(one, recorder), single_two = jobs::fit(two, recorder);
  jobs::FitJobReport both_one, both_two;
  std::thread other([&] {
    tests::Recorder own;
    both_two = jobs::fit(two, own);
  });
  both_one = jobs::fit(one, recorder);
  other.join();
  CHECK(to_json(both_one) == to_json(single_one));
  CHECK(to_json(both_two) == to_json(single_two));
  CHECK(to_json(both_one) != to_json(both_two));
}
