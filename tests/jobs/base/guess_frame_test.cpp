// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/guess_frame.h"

#include <catch2/catch.hpp>

#include "tests/jobs/job_folders.h"

using namespace furrow;

namespace {

/// Two triangles that span a box, as OBJ.
std::string box_text(double x, double y, double z) {
  const auto vertex = [](double a, double b, double c) {
    return "v " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  };
  return vertex(0, 0, 0) + vertex(x, 0, z) + vertex(x, y, z) + vertex(0, y, 0) + "f 1 2 3\nf 1 3 4\n";
}

std::filesystem::path written(const std::filesystem::path& folder, const std::string& name,
                              const std::string& text) {
  std::ofstream(folder / name) << text;
  return folder / name;
}

}  // namespace

TEST_CASE("guess_frame: a body of a person's size tells unit and axis, whatever the garment's size") {
  const auto folder = tests::empty_folder("guess");
  const auto garment = written(folder, "g.obj", box_text(60, 30, 70));
  struct Case {
    double x, y, z;
    const char *unit, *up;
  };
  const Case c = GENERATE(Case{0.5, 1.7, 0.3, "m", "y"}, Case{50, 170, 30, "cm", "y"},
                          Case{500, 300, 1700, "mm", "z"}, Case{0.5, 0.3, 1.1, "m", "z"});
  const auto found = jobs::guess_frame(garment, written(folder, "b.obj", box_text(c.x, c.y, c.z)));
  CHECK(found.unit == c.unit);
  CHECK(found.up == c.up);
  CHECK(found.sure);
  CHECK(found.height == Approx(std::max(c.y, c.z) * (found.unit == "m"    ? 1
                                                     : found.unit == "cm" ? 0.01
                                                                          : 0.001)));
}

TEST_CASE("guess_frame: what a file of ours notes goes before any size") {
  const auto folder = tests::empty_folder("noted");
  io::MeshFile curtain = io::read_mesh(written(folder, "curtain.obj", box_text(4, 5, 0.1)));
  io::WrinkleRecord record;
  record.unit = "m", record.up = "z";
  io::set_wrinkle_record(curtain, record);
  io::write_mesh(folder / "curtain.ply", curtain);
  const auto found = jobs::guess_frame(folder / "curtain.ply");
  CHECK(found.unit == "m");
  CHECK(found.up == "z");
  CHECK(found.sure);
}

TEST_CASE("guess_frame: it doubts a size that nobody has, and a garment as deep as tall") {
  const auto folder = tests::empty_folder("doubt");
  CHECK_FALSE(jobs::guess_frame(written(folder, "huge.obj", box_text(5, 1e5, 5))).sure);
  CHECK_FALSE(jobs::guess_frame(written(folder, "cube.obj", box_text(0.6, 0.6, 0.55))).sure);
  CHECK(jobs::guess_frame(written(folder, "tall.obj", box_text(0.3, 0.6, 0.3))).sure);
}
