// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/smooth.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "physics/base/progress.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

jobs::SmoothJob rough_sheet() {
  io::MeshFile sheet;
  sheet.mesh = tests::jittered(10, 10, 0.2, 1);
  jobs::SmoothJob job;
  job.mesh = sheet;
  return job;
}

}  // namespace

TEST_CASE("smooth: a mesh in memory comes to the bits of its file") {
  const fs::path folder = tests::empty_folder("smooth_memory");
  tests::Recorder recorder;
  const jobs::SmoothJob in_memory = rough_sheet();
  jobs::SmoothJob of_file = in_memory;
  const io::MeshFile& rough = std::get<io::MeshFile>(in_memory.mesh);
  io::write_mesh(folder / "rough.ply", rough);
  of_file.mesh = folder / "rough.ply";
  of_file.output = folder / "smooth.ply";
  const jobs::SmoothReport a = jobs::smooth(in_memory, recorder), b = jobs::smooth(of_file, recorder);
  CHECK(tests::positions(a.mesh) != tests::positions(rough));
  CHECK(tests::positions(a.mesh) == tests::positions(b.mesh));
  CHECK(to_json(a) == to_json(b));
  CHECK(tests::positions(io::read_mesh(of_file.output)) == tests::positions(b.mesh));
}

TEST_CASE("smooth: a job that is cancelled, or cannot be, leaves nothing") {
  const fs::path folder = tests::empty_folder("smooth_cancelled");
  jobs::SmoothJob job = rough_sheet();
  job.output = folder / "smooth.ply";
  for (int at : {1, 2}) {
    tests::Recorder recorder(at);
    CHECK_THROWS_AS(jobs::smooth(job, recorder), physics::Cancelled);
  }
  tests::Recorder recorder;
  job.options.iterations = -1;
  CHECK_THROWS_AS(jobs::smooth(job, recorder), std::invalid_argument);
  CHECK(tests::names_in(folder).empty());
}
