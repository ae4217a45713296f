// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "geometry/mesh/errors.h"
#include "io/mesh/mesh_file.h"
#include "jobs/base/inputs.h"
#include "jobs/base/read_inputs.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"

using namespace furrow;

namespace {

/// A triangle of this size [m].
io::MeshFile triangle(double size) {
  io::MeshFile file;
  const auto a = file.mesh->add_vertex({0, 0, 0}), b = file.mesh->add_vertex({size, 0, 0});
  file.mesh->add_face(a, b, file.mesh->add_vertex({0, size, 0}));
  return file;
}

double height(const io::MeshFile& file) {
  double high = 0;
  for (geometry::Vertex v : file.mesh->vertices()) high = std::max(high, file.mesh->point(v).y());
  return high;
}

}  // namespace

TEST_CASE("mesh_input: a mesh in memory is what its file is when it is read") {
  const auto folder = tests::empty_folder("mesh_input");
  tests::Recorder recorder;
  const jobs::MemoryFiles memory{{{"shirt", triangle(0.5)}}, {}};
  const jobs::Context context{{}, recorder, &memory};
  jobs::write_mesh(folder / "triangle.ply", triangle(0.5), context);
  for (const jobs::MeshInput& input :
       {jobs::MeshInput(folder / "triangle.ply"), jobs::MeshInput(triangle(0.5)), jobs::MeshInput("shirt")}) {
    const io::MeshFile read = jobs::read_mesh(input, context);
    CHECK(read.mesh->number_of_faces() == 1);
    CHECK(height(read) == 0.5);
  }
  CHECK(recorder.warnings.empty());
}

TEST_CASE("mesh_input: what is in memory is found by each text that names its place") {
  jobs::MemoryFiles memory;
  memory.meshes["./drawings/shirt"] = triangle(0.5);
  memory.strokes["drawings/the lines"];
  for (const std::string& path :
       {std::string("drawings/shirt"), std::string("./drawings/../drawings/./shirt"),
        (std::filesystem::current_path() / "drawings/shirt").string()}) {
    INFO(path);
    CHECK(memory.find_mesh(path));
    CHECK(memory.holds(path));
  }
  CHECK(memory.holds("drawings//the lines"));
  CHECK_FALSE(memory.holds("shirt"));
  CHECK_FALSE(memory.holds("drawings/Shirt"));
}

TEST_CASE("mesh_input: a file is read in the unit that it notes, and says so where the frame names another") {
  const auto folder = tests::empty_folder("noted_unit");
  tests::Recorder recorder;
  io::MeshFile file = triangle(0.5);
  io::set_wrinkle_record(file, {});
  jobs::Frame centimetres;
  centimetres.unit = "cm";
  jobs::write_mesh(folder / "cm.ply", file, {centimetres, recorder});
  CHECK(height(jobs::read_mesh(folder / "cm.ply", {{}, recorder})) == Approx(0.5).epsilon(1e-12));
  CHECK(recorder.warnings.empty());
  jobs::Frame millimetres;
  millimetres.unit = "mm";
  CHECK(height(jobs::read_mesh(folder / "cm.ply", {millimetres, recorder})) == Approx(0.05).epsilon(1e-12));
  REQUIRE(recorder.warned_of("other_frame"));
  CHECK(recorder.warnings[0].where == (folder / "cm.ply").string());
}

TEST_CASE("mesh_input: a garment taller than ten metres is refused, and a unit that is none") {
  tests::Recorder recorder;
  CHECK_THROWS_AS(jobs::read_garment(triangle(11), {{}, recorder}), geometry::ContentError);
  CHECK_NOTHROW(jobs::read_garment(triangle(9), {{}, recorder}));
  jobs::Frame frame;
  frame.unit = "ell";
  CHECK_THROWS_AS(jobs::read_options(frame), std::invalid_argument);
}
