// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "tests/io/base/io_test_helpers.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::tests;

namespace {

/// Facts of the manifest, measured there by another reader.
struct Fact {
  const char* path;
  std::size_t vertices, faces, cut;  ///< faces as in the file; cut: those with more than three corners
  std::size_t triangles;
  bool closed;
};

}  // namespace

TEST_CASE("real files: real meshes have the manifest's numbers of vertices and faces") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  const Fact fact =
      GENERATE(values<Fact>({{"pairs/mh_male/body.obj", 13380, 13378, 13378, 26756, true},
                             {"pairs/mh_male/tshirt.obj", 810, 764, 764, 1528, false},
                             {"pairs/mh_female/skirt.obj", 720, 684, 684, 1368, false},
                             {"bodies/smpl_f_average_A40.obj", 6890, 6900, 6876, 13776, true},
                             {"cloth/cipc_square8K.obj", 8282, 16154, 0, 16154, false},
                             {"closed/torus.obj", 2304, 4608, 0, 4608, true},
                             {"accuracy/spot_catmullclark_x2.ply", 2930, 5856, 0, 5856, true}}));
  INFO(fact.path);
  const io::MeshFile file = io::read_mesh(shared_dir() / "meshes" / fact.path);
  CHECK(file.mesh->number_of_vertices() == fact.vertices);
  CHECK(file.repairs.triangulated_faces == fact.cut);
  CHECK(file.mesh->number_of_faces() == fact.triangles);
  CHECK(CGAL::is_closed(*file.mesh) == fact.closed);
  CHECK_FALSE(file.repairs.any());
  CHECK(file.repairs.isolated_vertices == 0);
  CHECK(fact.triangles >= fact.faces);
}

TEST_CASE("real files: a control mesh with n-gons is triangulated, the dress's two bad vertices are parted") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  const io::MeshFile spot = io::read_mesh(shared_dir() / "meshes/closed/spot_control.obj");
  CHECK(spot.mesh->number_of_vertices() == 188);
  CHECK(spot.repairs.triangulated_faces == 160 + 16);
  CHECK(CGAL::is_closed(*spot.mesh));
  CHECK(spot.mesh->number_of_faces() == 2 * 188 - 4);  // Euler, genus 0
  const io::MeshFile dress = io::read_mesh(shared_dir() / "meshes/cloth/dc_dress_v3.obj");
  CHECK(dress.repairs.duplicated_vertices == 2);
  CHECK(dress.repairs.reversed_faces == 0);
  CHECK(dress.mesh->number_of_vertices() == 4536 + 2);
  CHECK(dress.mesh->number_of_faces() == 8801);
}

TEST_CASE("real files: a real garment passes through PLY with the same bytes") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  const io::MeshFile shirt = io::read_mesh(shared_dir() / "meshes/pairs/mh_male/tshirt.obj");
  const std::string bytes = written(shirt, io::MeshFormat::ply);
  const io::MeshFile back = read_from(bytes, io::MeshFormat::ply);
  CHECK(same_positions(shirt.mesh, back.mesh));
  CHECK(corners_of(shirt.mesh) == corners_of(back.mesh));
  CHECK(back.group_names == shirt.group_names);
  CHECK(written(back, io::MeshFormat::ply) == bytes);
}
