// SPDX-License-Identifier: GPL-3.0-or-later
// Garments over each other, named in the right order and in the wrong one, and a suit of three parts in one
// file.
#include <catch2/catch.hpp>
#include <fstream>

#include "bridge/arrays/convert.h"
#include "io/mesh/mesh_file.h"
#include "journey.h"

using namespace furrow;
using namespace furrow::tests;
using Catch::Contains;

namespace {

/// The garment of a file, moved outwards by so much [m].
geometry::Mesh widened(const std::string& path, double by) {
  geometry::Mesh mesh = io::read_mesh(path).mesh;
  std::vector<physics::Vec3> normals(mesh.number_of_vertices(), physics::Vec3::Zero());
  const std::vector<physics::Vec3> x = bridge::positions_of(mesh);
  for (const auto& [a, b, c] : bridge::triangles_of(mesh)) {
    const physics::Vec3 n = (x[b] - x[a]).cross(x[c] - x[a]);
    for (const int i : {a, b, c}) normals[std::size_t(i)] += n;
  }
  for (geometry::Vertex v : mesh.vertices()) {
    const physics::Vec3 p = x[v.idx()] + by * normals[v.idx()].normalized();
    mesh.point(v) = {p.x(), p.y(), p.z()};
  }
  return mesh;
}

}  // namespace

TEST_CASE("journeys: a coat over a tunic rests, and the other order is refused with what to swap",
          "[release]") {
  const Journey here;
  here.bring("meshes/tunic.obj");
  here.bring_body_of_tunic("she.obj");
  io::MeshFile coat;
  coat.mesh = widened("tunic.obj", 0.012);
  io::write_mesh("coat.obj", coat);
  const auto right = step("drape tunic.obj coat.obj --body she.obj --subdivide 0 -o worn.ply");
  CHECK(right["layers"]["pairs"][0]["crossings"] == 0);
  const Run wrong = run_furrow("drape coat.obj tunic.obj --body she.obj -o wrong.ply");
  CHECK(wrong.exit_code == 2);
  CHECK_THAT(wrong.err, Contains("tunic before coat"));
  CHECK_FALSE(std::filesystem::exists("wrong-coat.ply"));
}

TEST_CASE("journeys: a suit of three layers in one file rests without a crossing", "[release]") {
  const Journey here;
  here.bring("meshes/tunic.obj");
  here.bring_body_of_tunic("she.obj");
  io::MeshFile suit;
  for (const double by : {0.0, 0.012, 0.024}) {
    const geometry::Mesh part = widened("tunic.obj", by);
    const auto first = geometry::Vertex::size_type(suit.mesh->number_of_vertices());
    for (const geometry::Vertex v : part.vertices()) suit.mesh->add_vertex(part.point(v));
    const auto at = [&](int i) { return geometry::Vertex(first + geometry::Vertex::size_type(i)); };
    for (const auto& [a, b, c] : bridge::triangles_of(part)) suit.mesh->add_face(at(a), at(b), at(c));
  }
  io::write_mesh("suit.obj", suit);
  const auto report = step("drape suit.obj --body she.obj --subdivide 0 -o worn.ply");
  CHECK(report["crossings"]["pairs"] == 0);
  CHECK(report["end"]["parts"].size() == 3);
  CHECK(report["end"]["parts_lost"] == 0);
}

TEST_CASE("journeys: a body that is named as its own garment is refused", "[release]") {
  const Journey here;
  here.bring_body_of_tunic("she.obj");
  const Run run = run_furrow("drape she.obj --body ./she.obj -o worn.ply");
  CHECK(run.exit_code == 3);
  CHECK_THAT(run.err, Contains("nothing is worn on itself"));
}

TEST_CASE("journeys: a drape whose budget is spent leaves a file and says so", "[release]") {
  const Journey here;
  here.bring("meshes/tunic.obj");
  here.bring_body_of_tunic("she.obj");
  const Run run =
      run_furrow("drape tunic.obj --body she.obj --subdivide 3 --budget 4 --progress 0.2 -o worn.ply");
  CHECK(run.exit_code == 4);
  CHECK_THAT(run.err, Contains("draping: ") && Contains("(at most 4 s of processor time)\n"));
  CHECK_THAT(run.err, Contains("budget"));
  CHECK_THAT(run.out, !Contains("interrupted"));
  CHECK(std::filesystem::exists("worn.ply") ==
        (run.err.find("the best state so far is in") != std::string::npos));
}
