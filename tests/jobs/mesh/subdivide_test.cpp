// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/subdivide.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "geometry/mesh/sheet.h"
#include "geometry/mesh/vertex_attributes.h"
#include "jobs/base/own_output.h"
#include "physics/base/progress.h"
#include "tests/io/mesh/glb_parts.h"
#include "tests/io/mesh/seam.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

jobs::SubdivideJob lined_sheet() {
  io::MeshFile sheet;
  sheet.mesh = geometry::equilateral_sheet(0.4, 0.4, 0.05);
  io::DrawnStroke line;
  line.stroke.name = "line";
  line.stroke.points = {{-0.1, 0.2, 0}, {0.1, 0.2, 0}};
  jobs::SubdivideJob job;
  job.mesh = sheet;
  job.refinement = jobs::Refinement::strokes;
  job.strokes = std::vector{line};
  return job;
}

}  // namespace

TEST_CASE("subdivide: a mesh and strokes in memory come to the bits of their files") {
  const fs::path folder = tests::empty_folder("subdivide_memory");
  tests::Recorder recorder;
  const jobs::SubdivideJob in_memory = lined_sheet();
  jobs::SubdivideJob of_files = in_memory;
  io::write_mesh(folder / "sheet.ply", std::get<io::MeshFile>(in_memory.mesh));
  std::ofstream(folder / "line.json")
      << R"({"strokes": [{"name": "line", "points": [[-0.1, 0.2, 0], [0.1, 0.2, 0]]}]})";
  of_files.mesh = folder / "sheet.ply";
  of_files.strokes = folder / "line.json";
  of_files.output = folder / "lined.ply";
  const jobs::SubdivideReport a = jobs::subdivide(in_memory, recorder),
                              b = jobs::subdivide(of_files, recorder);
  REQUIRE(a.insertion);
  CHECK(a.insertion->inserted > 0);
  CHECK(tests::positions(a.mesh) == tests::positions(b.mesh));
  CHECK(to_json(a) == to_json(b));
  CHECK(tests::positions(io::read_mesh(of_files.output)) == tests::positions(b.mesh));
}

TEST_CASE("subdivide: each refinement makes the faces that it says") {
  tests::Recorder recorder;
  jobs::SubdivideJob job = lined_sheet();
  const std::size_t faces = std::get<io::MeshFile>(job.mesh).mesh->number_of_faces();
  const auto times = [&](jobs::Refinement refinement, int steps) {
    job.refinement = refinement;
    job.steps = steps;
    return double(jobs::subdivide(job, recorder).mesh.mesh->number_of_faces()) / double(faces);
  };
  CHECK(times(jobs::Refinement::everywhere, 0) == 3);
  CHECK(times(jobs::Refinement::loop, 2) == 16);
  CHECK(times(jobs::Refinement::sqrt3, 2) == 9);
  CHECK(times(jobs::Refinement::linear, 1) == 4);
}

TEST_CASE("subdivide: a job that is cancelled, or cannot be, leaves nothing") {
  const fs::path folder = tests::empty_folder("subdivide_cancelled");
  jobs::SubdivideJob job = lined_sheet();
  job.output = folder / "lined.ply";
  for (int at : {1, 2}) {
    tests::Recorder recorder(at);
    CHECK_THROWS_AS(jobs::subdivide(job, recorder), physics::Cancelled);
  }
  tests::Recorder recorder;
  job.refinement = jobs::Refinement::loop;
  job.steps = 7;
  CHECK_THROWS_AS(jobs::subdivide(job, recorder), std::invalid_argument);
  job.output = folder / "lined.gltf";
  CHECK_THROWS_AS(jobs::subdivide(job, recorder), std::invalid_argument);
  CHECK(tests::names_in(folder).empty());
}

TEST_CASE("subdivide: a rigged GLB comes out as a GLB with its rig, and what it cannot hold is told") {
  const fs::path folder = tests::empty_folder("subdivide_glb");
  const tests::SkinnedSeam rigged({{{0, -1, 0}, {0, -1.5F, 0}}});
  tests::spit(folder / "rigged.glb", rigged.glb());
  jobs::SubdivideJob job;
  job.mesh = folder / "rigged.glb";
  job.refinement = jobs::Refinement::linear;
  job.steps = 2;
  job.output = folder / "fine.glb";
  tests::Recorder recorder;
  jobs::subdivide(job, recorder);
  CHECK_FALSE(recorder.warned_of("lost_in_glb"));
  CHECK_FALSE(recorder.warned_of("lost_attributes"));
  CHECK(jobs::is_own_output(job.output));
  const tests::Glb fine(tests::slurp(job.output));
  tests::check_glb(fine);
  CHECK(fine.scene["nodes"] == rigged.scene["nodes"]);
  const io::MeshFile back = io::read_mesh(job.output);
  CHECK(back.mesh->number_of_faces() == 32);
  for (const geometry::VertexAttribute& joint : geometry::vertex_attributes(back.mesh))
    for (const geometry::Vertex v : back.mesh->vertices()) CHECK(joint.values[v] <= 1);

  io::MeshFile masked = back;
  geometry::ensure_vertex_attribute(masked.mesh, "mask");
  job.mesh = masked;
  job.steps = 1;
  jobs::subdivide(job, recorder);
  REQUIRE(recorder.warned_of("lost_in_glb"));
  CHECK(recorder.warnings.back().text ==
        job.output.string() + ": it leaves out the vertex attributes mask; a PLY keeps them");
}
