// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/weld.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>

#include "geometry/figure/border_seams.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/face_point.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/vertex_attributes.h"
#include "tests/io/base/io_test_helpers.h"
#include "tests/test_meshes.h"

using namespace furrow;
using namespace furrow::geometry;

namespace {

/// Every triangle with vertices and a group of its own.
io::MeshFile loose(const Mesh& mesh) {
  io::MeshFile file;
  auto group = ensure_map(file.mesh, attribute::group);
  int number = 0;
  for (const Face f : mesh.faces()) {
    std::vector<Vertex> v;
    for (const Vertex corner : mesh.vertices_around_face(mesh.halfedge(f)))
      v.push_back(file.mesh->add_vertex(mesh.point(corner)));
    group[file.mesh->add_face(v[0], v[1], v[2])] = number++;
  }
  file.mesh->add_vertex({9, 9, 9});
  return file;
}

/// Two sheets of 1 m x 1 m side by side, 10 um apart, the right one of ny rows; texture: the place.
io::MeshFile two_panels(int ny, bool of_two_groups = false) {
  io::MeshFile file;
  file.mesh = tests::grid(4, 4);
  Mesh right = tests::grid(4, ny);
  for (const Vertex v : right.vertices()) right.point(v) = right.point(v) + Vector(1 + 1e-5, 0, 0);
  tests::append(file.mesh, right);
  auto texture = ensure_map(file.mesh, attribute::texture);
  auto material = ensure_map(file.mesh, attribute::material), group = ensure_map(file.mesh, attribute::group);
  auto weight = ensure_vertex_attribute(file.mesh, "weight_hip");
  for (const Vertex v : file.mesh->vertices()) weight[v] = v.idx();
  for (const Face f : file.mesh->faces()) {
    material[f] = file.mesh->point(corners_of(file.mesh, f)[0]).x() > 1;
    group[f] = of_two_groups ? material[f] : 0;
    for (const Halfedge h : halfedges_of(file.mesh, f)) {
      const Point& p = file.mesh->point(file.mesh->target(h));
      texture[h] = {p.x() + 5 * material[f], p.y()};
    }
  }
  file.group_names =
      of_two_groups ? std::vector<std::string>{"left", "right"} : std::vector<std::string>{"both"};
  file.material_names = {"silk", "wool"};
  return file;
}

/// Each corner has the texture of its place, by its face's material.
void has_its_texture(const Mesh& mesh, double within) {
  const auto texture = find_map(mesh, attribute::texture);
  const auto material = find_map(mesh, attribute::material);
  REQUIRE(texture);
  REQUIRE(material);
  for (const Face f : mesh.faces())
    for (const Halfedge h : halfedges_of(mesh, f)) {
      const Point& p = mesh.point(mesh.target(h));
      CHECK((*texture)[h][0] == Approx(p.x() + 5 * (*material)[f]).margin(within));
      CHECK((*texture)[h][1] == Approx(p.y()).margin(within));
    }
}

}  // namespace

TEST_CASE("weld: loose triangles become the mesh that they were cut from, with their groups in order") {
  for (const Mesh& mesh : {tests::grid(5, 4), tests::icosphere(1), tests::cylinder(1, 2, 8, 3)}) {
    const io::MeshFile welded = io::welded(loose(mesh), "t");
    CHECK(welded.mesh->number_of_vertices() == mesh.number_of_vertices());
    CHECK(welded.mesh->number_of_edges() == mesh.number_of_edges());
    CHECK(welded.repairs.merged_vertices == 3 * mesh.number_of_faces() + 1 - mesh.number_of_vertices());
    CHECK(measure(welded.mesh).boundary_loops == measure(mesh).boundary_loops);
    const auto group = find_map(welded.mesh, attribute::group);
    REQUIRE(group);
    int number = 0;
    for (const Face f : welded.mesh->faces()) CHECK((*group)[f] == number++);
  }
}

TEST_CASE("weld: a lining stays, where its front has no material, too") {
  io::MeshFile file;
  Mesh& mesh = file.mesh;
  const auto add = [&](const Point& a, const Point& b, const Point& c) {
    return mesh.add_face(mesh.add_vertex(a), mesh.add_vertex(b), mesh.add_vertex(c));
  };
  const Face lined = add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  add({1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  ensure_map(mesh, attribute::lining)[lined] = 0;
  const io::MeshFile joined = io::welded(file, "t");
  CHECK(joined.mesh->number_of_vertices() == 4);
  REQUIRE(joined.mesh->number_of_faces() == 2);
  const auto lining = *find_map(joined.mesh, attribute::lining);
  CHECK(lining[*joined.mesh->faces_begin()] == 0);
  CHECK(lining[*std::next(joined.mesh->faces_begin())] == -1);
}

TEST_CASE("weld: a mesh without two vertices at one place keeps its vertices and faces") {
  io::MeshFile file;
  file.mesh = tests::jittered(6, 6, 0.2, 1);
  const io::MeshFile welded = io::welded(file, "t");
  CHECK(welded.mesh->number_of_vertices() == file.mesh->number_of_vertices());
  for (const Vertex v : file.mesh->vertices()) CHECK(welded.mesh->point(v) == file.mesh->point(v));
  CHECK_FALSE(welded.repairs.any());
}

TEST_CASE(
    "weld: the sides of a seam become one, and texture, materials, weights and the order of vertices stay") {
  const io::MeshFile file = two_panels(4);
  const io::MeshFile welded = io::welded(file, "t");
  const MeshInfo info = measure(welded.mesh);
  CHECK(info.components == 1);
  CHECK(info.boundary_loops == 1);
  CHECK(info.vertices == 2 * 25 - 5);
  CHECK(info.faces == file.mesh->number_of_faces());
  has_its_texture(welded.mesh, 2e-5);
  const auto weights = vertex_attributes(welded.mesh);
  REQUIRE(weights.size() == 1);
  std::size_t last = 0;
  for (const Vertex v : welded.mesh->vertices()) {
    const auto from = std::size_t(weights[0].values[v]);  // the vertex that it was
    CHECK(from >= last);
    CHECK(welded.mesh->point(v) == file.mesh->point(Vertex(Vertex::size_type(from))));
    last = from;
  }
}

TEST_CASE("weld: a vertex amid an edge splits the face there, as often as there are vertices") {
  const io::MeshFile file = two_panels(GENERATE(8, 12));
  const BorderSeams seams = find_border_seams(file.mesh);
  REQUIRE_FALSE(seams.splits.empty());
  const io::MeshFile welded = io::welded(file, "t");
  const MeshInfo info = measure(welded.mesh), was = measure(file.mesh);
  CHECK(info.components == 1);
  CHECK(info.boundary_loops == 1);
  CHECK(info.degenerate_faces == 0);
  CHECK(info.faces == was.faces + seams.splits.size());
  CHECK(info.vertices == was.vertices - 5);
  CHECK(info.area == Approx(was.area).epsilon(1e-4));
  CHECK_FALSE(welded.repairs.reversed_faces);
  has_its_texture(welded.mesh, 2e-5);
  CHECK(find_border_seams(welded.mesh).any() == false);
}

TEST_CASE("weld: a face that is split along two and along three sides is cut into triangles that cover it") {
  // A triangle in a hole of the sheet whose corners are joined, and whose sides are of four edges.
  io::MeshFile file;
  Mesh& mesh = file.mesh;
  const std::array<Point, 3> corners{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)};
  const int sides = GENERATE(2, 3);
  std::vector<Vertex> ring;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < (k < sides ? 4 : 1); ++i) {
      const double t = i / (k < sides ? 4. : 1.);
      ring.push_back(mesh.add_vertex(corners[std::size_t(k)] +
                                     t * (corners[std::size_t(k + 1) % 3] - corners[std::size_t(k)])));
    }
  const std::size_t n = ring.size();
  std::vector<Vertex> outer;
  for (const Vertex v : ring)
    outer.push_back(mesh.add_vertex(mesh.point(v) + (mesh.point(v) - Point(0.3, 0.3, 0))));
  for (std::size_t i = 0; i < n; ++i) {
    mesh.add_face(ring[i], outer[(i + 1) % n], ring[(i + 1) % n]);
    mesh.add_face(ring[i], outer[i], outer[(i + 1) % n]);
  }
  std::vector<Vertex> inner;
  for (const Point& p : corners) inner.push_back(mesh.add_vertex(p + Vector(1e-6, 1e-6, 0)));
  mesh.add_face(inner[0], inner[1], inner[2]);
  const BorderSeams seams = find_border_seams(mesh);
  REQUIRE(seams.splits.size() == std::size_t(3 * sides));
  const io::MeshFile welded = io::welded(file, "t");
  const MeshInfo info = measure(welded.mesh);
  CHECK(info.boundary_loops == 1);
  CHECK(info.components == 1);
  CHECK(info.area == Approx(measure(file.mesh).area).epsilon(1e-4));
  CHECK(info.faces == 2 * n + 1 + std::size_t(3 * sides));
}

TEST_CASE("weld: panels of one mesh of a GLB are joined as they are read, those of two meshes are not") {
  const tests::TemporaryFolder folder;
  const auto back = [&](const io::MeshFile& file) {
    io::write_mesh(folder / "a.glb", file);
    return io::read_mesh(folder / "a.glb");
  };
  const auto warns = [](const io::MeshFile& file) {
    return std::ranges::any_of(file.warnings, [](const std::string& w) {
      return w.find("seams joined that lay open by a rounding: 5 vertices, up to 0.01 mm apart") != w.npos;
    });
  };
  const io::MeshFile one = back(two_panels(4));
  CHECK(measure(one.mesh).components == 1);
  CHECK(warns(one));
  has_its_texture(one.mesh, 2e-5);
  const io::MeshFile two = io::with_joined_seams(two_panels(4, true), "t");
  CHECK(measure(two.mesh).components == 2);
  CHECK(two.warnings.empty());
  CHECK(measure(io::with_joined_seams(two_panels(4), "t").mesh).components == 1);
  // With vertices amid edges faces would be split: only doctor does that.
  CHECK(measure(back(two_panels(8)).mesh).components == 2);
}

TEST_CASE("weld: open seams are joined as they are read, and every vertex of the file stays") {
  const auto read = [](const std::string& more) {
    std::istringstream text(
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0.5 0\nv 2 0 0\nv 2 1 0\nl 1 2 6\n"
        "f 1 2 3\nf 1 3 4\nf 2 6 5\nf 6 7 5\nf 5 7 3\n" +
        more);
    return io::read_mesh(text, io::MeshFormat::obj, "t");
  };
  const io::MeshFile file = read("v 9 9 9\n");
  REQUIRE(file.repairs.duplicated_vertices == 2);
  const io::MeshFile split = io::with_seams_as_one(file, "t");
  CHECK(split.mesh->number_of_vertices() == 8);
  for (const Vertex v : split.mesh->vertices()) CHECK(split.mesh->point(v) == file.mesh->point(v));
  CHECK(split.mesh->number_of_faces() == 6);
  CHECK(split.repairs.duplicated_vertices == 0);
  CHECK(measure(split.mesh).boundary_loops == 1);
  CHECK(measure(split.mesh).area == Approx(2));
  REQUIRE(split.polylines.size() == 1);
  CHECK(split.polylines[0].vertices == std::vector<std::size_t>{0, 1, 5});
  REQUIRE(split.warnings.size() == file.warnings.size() + 1);
  CHECK(split.warnings.back().find("and 1 amid an edge of it") != std::string::npos);
  io::MeshFile rests = file;
  ensure_map(rests.mesh, attribute::rest_length);
  CHECK(io::with_seams_as_one(rests, "t").mesh->number_of_faces() == 5);
}

TEST_CASE("weld: a seam with a gap, and one without, is one, and says which vertices are") {
  const double gap = GENERATE(0.0, 1e-5);
  io::MeshFile file = two_panels(8);
  for (const Vertex v : file.mesh->vertices())
    if (v.idx() >= 25) file.mesh->point(v) = file.mesh->point(v) + Vector(gap - 1e-5, 0, 0);
  const io::MeshFile one = io::with_seams_as_one(file, "t");
  CHECK(one.mesh->number_of_vertices() == 70);
  CHECK(measure(one.mesh).components == 1);
  has_its_texture(one.mesh, 2e-5);
  const auto joined = find_map(one.mesh, attribute::joined);
  REQUIRE(joined);
  std::size_t count = 0;
  for (const Vertex v : one.mesh->vertices()) {
    CHECK(((*joined)[v] >= 0) == one.mesh->is_isolated(v));
    if ((*joined)[v] < 0) continue;
    ++count;
    CHECK(CGAL::squared_distance(one.mesh->point(v),
                                 file.mesh->point(Vertex(Vertex::size_type((*joined)[v])))) < 1e-9);
  }
  CHECK(count == 5);
  CHECK(one.repairs.merged_vertices == 0);
}

TEST_CASE("weld: nothing is left of a mesh that is two corners wide") {
  io::MeshFile file;
  const Point p(0, 0, 0);
  const Vertex a = file.mesh->add_vertex(p), b = file.mesh->add_vertex(p),
               c = file.mesh->add_vertex({1, 0, 0});
  file.mesh->add_face(a, b, c);
  CHECK_THROWS_AS(io::welded(file, "t"), ContentError);
}
