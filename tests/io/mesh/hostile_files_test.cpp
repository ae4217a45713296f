// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <map>

#include "io/mesh/mesh_formats.h"
#include "tests/io/base/io_test_helpers.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::tests;
namespace fs = std::filesystem;

TEST_CASE("hostile files: every hostile file is read or refused with a content error") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  std::size_t files = 0, read = 0;
  for (const auto& entry : fs::recursive_directory_iterator(shared_dir() / "meshes" / "hostile")) {
    if (!entry.is_regular_file()) continue;
    ++files;
    INFO(entry.path());
    try {
      const io::MeshFile file = io::read_mesh(entry.path());
      ++read;
      CHECK(file.mesh->is_valid(false));
      CHECK(CGAL::is_triangle_mesh(*file.mesh));
      for (const io::MeshEnding& e : io::mesh_endings()) {
        if (!e.read || !e.write || !e.keeps_order) continue;
        const io::MeshFile back = read_from(written(file, e.format), e.format);
        CHECK(same_positions(back.mesh, file.mesh));
        CHECK(corners_of(back.mesh) == corners_of(file.mesh));
      }
    } catch (const geometry::ContentError& error) {
      CHECK(std::string(error.what()).starts_with(entry.path().string() + ":"));
    }
  }
  CHECK(files == 61);
  CHECK(read == 38);
}

TEST_CASE("hostile files: which are refused, and where") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  const std::map<std::string, std::string> refused = {
      {"comments_only.obj", " no faces"},
      {"count_too_big.off", "2: the header announces 2000000000 vertices"},
      {"empty_file.obj", " no faces"},
      {"huge_1e30.obj", "2: a coordinate is not finite or beyond 1e9 m"},
      {"index_out_of_range.obj", "15: a corner names a vertex beyond the last of 8"},
      {"index_out_of_range.off", "16: a corner names a vertex beyond the last of 8"},
      {"index_zero.obj", "15: index 0"},
      {"inf_coordinate.ply", "13: vertex 3: a coordinate is not finite"},
      {"nan_coordinate.obj", "7: 'nan' is not a finite number"},
      {"negative_index_too_far.obj", "15: index -99"},
      {"not_a_mesh.obj", " no faces"},
      {"truncated.off", "37: a number is missing"},
      {"truncated.ply", " face "},
      {"truncated.stl", " the header announces"},
      {"unknown_format.xyzq", " unknown format '.xyzq'"},
      {"vertices_no_faces.obj", " no faces"},
      {"thirdparty/assimp/OBJ__box_UTF16BE.obj", " the text is UTF-16"},
      {"thirdparty/assimp/OBJ__number_formats.obj", "11: '3.1+e2' is not a number"},
      {"thirdparty/assimp/OFF__invalid.off", "7: a whole number is missing"},
      {"thirdparty/assimp/invalid__OutOfMemory.off", "2: the header announces 353535235358 vertices"},
      {"thirdparty/assimp/invalid__malformed.obj", "28: index 0"},
      {"thirdparty/tinyobjloader/issue-140-zero-face-idx.obj", "16: index 0"},
      {"thirdparty/tinyobjloader/test-nan.obj", "12: 'nan' is not a finite number"}};
  CHECK(refused.size() == 61 - 38);
  for (const auto& [name, message] : refused) {
    const fs::path path = shared_dir() / "meshes" / "hostile" / name;
    const std::string error = content_error([&] { io::read_mesh(path); });
    INFO(error);
    CHECK(error.starts_with(path.string() + ":" + message));
  }
}

TEST_CASE("hostile files: what is repaired, and how") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  const auto read = [](const std::string& name) {
    return io::read_mesh(shared_dir() / "meshes" / "hostile" / name);
  };
  CHECK(read("degenerate_triangles.obj").repairs.degenerate_faces == 1);
  CHECK(read("duplicate_faces.obj").repairs.duplicate_faces == 4);
  CHECK(read("isolated_vertices.obj").repairs.isolated_vertices == 3);
  CHECK(read("nonmanifold_edge.obj").repairs.duplicated_vertices == 4);
  CHECK(read("nonmanifold_vertex.obj").repairs.duplicated_vertices == 1);
  CHECK(read("mixed_winding.obj").repairs.reversed_faces > 0);
  CHECK(read("mixed_winding.obj").repairs.duplicated_vertices == 0);
  CHECK_FALSE(read("inside_out.obj").repairs.any());
  CHECK(read("thirdparty/geometry-central/dodecahedron_poly.obj").mesh->number_of_faces() == 36);
}
