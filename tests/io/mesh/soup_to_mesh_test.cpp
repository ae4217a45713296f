// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/soup_to_mesh.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "geometry/mesh/vertex_attributes.h"
#include "io/mesh/make_manifold.h"
#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

using List = std::vector<std::size_t>;

io::PolygonSoup soup_of(std::size_t n_points, const std::vector<List>& faces) {
  io::PolygonSoup soup;
  for (std::size_t i = 0; i < n_points; ++i) {
    const double t = static_cast<double>(i);
    soup.points.emplace_back(std::cos(t), std::sin(t), t * t / 50);
  }
  for (const List& face : faces) {
    soup.corners.insert(soup.corners.end(), face.begin(), face.end());
    soup.close_face();
  }
  return soup;
}

/// Every vertex has one fan: no face of it is missed when turning round it.
bool is_manifold(const Mesh& mesh) {
  if (!mesh.is_valid(false)) return false;
  List corners(mesh.number_of_vertices(), 0);
  for (const std::size_t v : corners_of(mesh)) ++corners[v];
  for (const Vertex v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;
    std::size_t faces = 0, borders = 0;
    for (const Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v)))
      ++(mesh.is_border(h) ? borders : faces);
    if (faces != corners[v] || borders > 1) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("soup_to_mesh: an oriented manifold is left as it is") {
  const auto out = io::soup_to_mesh(soup_of(5, {{0, 1, 2}, {0, 2, 3}}), "t");
  CHECK_FALSE(out.repairs.any());
  CHECK(out.repairs.isolated_vertices == 1);
  CHECK(out.origin == List{0, 1, 2, 3, 4});
  CHECK(corners_of(out.mesh) == List{0, 1, 2, 0, 2, 3});
}

TEST_CASE("soup_to_mesh: backs in another material are the lining of their fronts") {
  io::PolygonSoup soup = soup_of(6, {{0, 1, 2}, {0, 2, 3}, {1, 4, 5, 2}, {2, 1, 0}, {4, 1, 2, 5}});
  soup.materials = {0, 0, 0, 1, 2};
  soup.textures.assign(soup.corners.size(), {0.5, 0.5});
  soup.textures.back() = {0, 1};
  const auto out = io::soup_to_mesh(soup, "t");
  CHECK(out.repairs.duplicate_faces == 0);
  CHECK(out.repairs.lining_textures == 1);
  CHECK(out.origin.size() == 6);
  CHECK(is_manifold(out.mesh));
  const auto lining = *find_map(out.mesh, attribute::lining);
  std::vector<int> found;
  for (const Face f : out.mesh.faces()) found.push_back(lining[f]);
  CHECK(found == std::vector<int>{1, -1, 2, 2});
}

TEST_CASE("soup_to_mesh: a second back, and one without a material, are dropped and counted") {
  io::PolygonSoup soup = soup_of(4, {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {2, 1, 0}, {3, 2, 0}});
  soup.materials = {0, 0, 1, 2, -1};
  const auto out = io::soup_to_mesh(soup, "t");
  CHECK(out.repairs.duplicate_faces == 2);
  const auto lining = *find_map(out.mesh, attribute::lining);
  std::vector<int> found;
  for (const Face f : out.mesh.faces()) found.push_back(lining[f]);
  CHECK(found == std::vector<int>{1, -1});
}

TEST_CASE("soup_to_mesh: a lining is written as OBJ and GLB, and read again") {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl front\nf 1/1 2/2 3/3\nf 1/1 3/3 "
      "4/2\n"
      "usemtl back\nf 3/3 2/2 1/1\n";
  const io::MeshFile file = read_from(text, io::MeshFormat::obj);
  REQUIRE(file.mesh->number_of_faces() == 2);
  const TemporaryFolder folder;
  for (const char* name : {"a.obj", "a.glb"}) {
    io::write_mesh(folder / name, file);
    const io::MeshFile back = io::read_mesh(folder / name);
    REQUIRE(back.mesh->number_of_faces() == 2);
    CHECK(back.mesh->number_of_vertices() == 4);
    CHECK(back.repairs.lining_textures == 0);
    const auto lining = find_map(back.mesh, attribute::lining);
    REQUIRE(lining);
    std::vector<std::string> found;
    for (const Face f : back.mesh->faces())
      if ((*lining)[f] >= 0) found.push_back(back.material_names.at(std::size_t((*lining)[f])));
    CHECK(found == std::vector<std::string>{"back"});
  }
}

TEST_CASE("soup_to_mesh: backs in the same material, and copies that face the same way, are dropped") {
  io::PolygonSoup soup = soup_of(4, {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {0, 2, 3}});
  soup.materials = {0, 0, 0, 1};
  const auto out = io::soup_to_mesh(soup, "t");
  CHECK(out.repairs.duplicate_faces == 2);
  CHECK(out.mesh.number_of_faces() == 2);
  CHECK(out.origin.size() == 4);
}

TEST_CASE("soup_to_mesh: degenerate and duplicate triangles are dropped and counted") {
  const auto out =
      io::soup_to_mesh(soup_of(4, {{0, 1, 1}, {0, 1, 2}, {0, 1}, {2, 1, 0}, {1, 2, 0}, {0, 2, 3, 0}}), "t");
  CHECK(out.repairs.degenerate_faces == 3);
  CHECK(out.repairs.duplicate_faces == 2);
  CHECK(out.repairs.triangulated_faces == 1);
  CHECK(corners_of(out.mesh) == List{0, 1, 2, 0, 2, 3});
}

TEST_CASE("soup_to_mesh: the backs of quads with two sides are dropped, whichever diagonal cuts them") {
  const std::vector<List> front = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  std::vector<List> both = front;
  for (const List& f : front) both.push_back({f[3], f[2], f[1], f[0]});
  const auto one = io::soup_to_mesh(soup_of(6, front), "t"), out = io::soup_to_mesh(soup_of(6, both), "t");
  CHECK(out.repairs.duplicate_faces == 2);
  CHECK(out.repairs.duplicated_vertices == 0);
  CHECK(corners_of(out.mesh) == corners_of(one.mesh));
}

TEST_CASE("soup_to_mesh: the minority of a component is turned, with its corners' data") {
  io::PolygonSoup soup = soup_of(6, {{0, 2, 1}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
  for (std::size_t c = 0; c < 12; ++c) soup.textures.push_back({static_cast<double>(c), 0.5});
  soup.groups = {5, 6, 7, 8};
  const auto out = io::soup_to_mesh(soup, "t");
  CHECK(out.repairs.reversed_faces == 1);
  CHECK(out.repairs.duplicated_vertices == 0);
  CHECK(corners_of(out.mesh) == List{0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5});
  const auto texture = *find_map(out.mesh, attribute::texture);
  CHECK(texture[out.mesh.halfedge(Vertex(0), Vertex(1))][0] == 2);
  CHECK(texture[out.mesh.halfedge(Vertex(1), Vertex(2))][0] == 1);
  CHECK((*find_map(out.mesh, attribute::group))[Face(3)] == 8);
}

TEST_CASE("soup_to_mesh: three faces at an edge are parted, copies carry their data") {
  io::PolygonSoup soup = soup_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  soup.attributes = {{"mask", {7, 8, -1, -1, -1}}};
  soup.colors.assign(5, Color{0, 0, 1, 1});
  const auto out = io::soup_to_mesh(soup, "t");
  CHECK(out.repairs.duplicated_vertices == 4);
  CHECK(out.origin == List{0, 1, 2, 3, 4, 1, 0, 0, 1});
  CHECK(out.mesh.number_of_faces() == 3);
  CHECK(out.mesh.point(Vertex(5)) == soup.points[1]);
  CHECK(out.face_origin == List{0, 1, 2});
  CHECK(vertex_attributes(out.mesh).at(0).values[Vertex(8)] == 8);
  CHECK(vertex_attributes(out.mesh).at(0).values[Vertex(6)] == 7);
  CHECK((*find_map(out.mesh, attribute::color))[Vertex(6)] == Color{0, 0, 1, 1});
  CHECK(is_manifold(out.mesh));
}

TEST_CASE("soup_to_mesh: two fans at one vertex are parted, closed ones too") {
  const auto bow_tie = io::soup_to_mesh(soup_of(5, {{0, 1, 2}, {0, 3, 4}}), "t");
  CHECK(bow_tie.repairs.duplicated_vertices == 1);
  CHECK(bow_tie.origin == List{0, 1, 2, 3, 4, 0});
  const std::vector<List> first = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  const std::vector<List> second = {{0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}};
  std::vector<List> mixed;
  for (int i = 0; i < 4; ++i) mixed.push_back(first[i]), mixed.push_back(second[i]);
  std::vector<List> in_turn = first;
  in_turn.insert(in_turn.end(), second.begin(), second.end());
  for (const auto& faces : {in_turn, mixed}) {
    const auto out = io::soup_to_mesh(soup_of(7, faces), "t");
    CHECK(out.repairs.duplicated_vertices == 1);
    CHECK(out.repairs.reversed_faces == 0);
    CHECK(CGAL::is_closed(out.mesh));
    CHECK(is_manifold(out.mesh));
  }
}

TEST_CASE("soup_to_mesh: a Moebius strip is cut open once") {
  std::vector<List> faces;
  const std::size_t n = 8;  // pairs (2 i, 2 i + 1); the last is joined to the first crosswise
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t a = 2 * i, b = a + 1, c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? a + 3 : 0;
    faces.push_back({a, b, d});
    faces.push_back({a, d, c});
  }
  const auto out = io::soup_to_mesh(soup_of(2 * n, faces), "t");
  CHECK(out.mesh.number_of_faces() == 2 * n);
  CHECK(out.repairs.duplicated_vertices == 2);
  CHECK(is_manifold(out.mesh));
}

TEST_CASE("soup_to_mesh: any soup becomes a manifold with the same triangles") {
  CHECK(rc::check([](const std::vector<std::array<unsigned char, 3>>& input) {
    std::vector<List> faces;
    for (const auto& t : input) faces.push_back({t[0] % 7u, t[1] % 7u, t[2] % 7u});
    const io::PolygonSoup soup = soup_of(7, faces);
    try {
      const io::SoupMesh out = io::soup_to_mesh(soup, "t");
      RC_ASSERT(is_manifold(out.mesh));
      RC_ASSERT(out.mesh.number_of_faces() + out.repairs.degenerate_faces + out.repairs.duplicate_faces ==
                faces.size());
      RC_ASSERT(out.mesh.number_of_vertices() == 7 + out.repairs.duplicated_vertices);
      for (std::size_t i = 0; i < out.origin.size(); ++i) {
        RC_ASSERT(i >= 7 || out.origin[i] == i);
        RC_ASSERT(out.mesh.point(Vertex(static_cast<Mesh::size_type>(i))) == soup.points[out.origin[i]]);
      }
      std::size_t face = 0;
      std::set<std::set<std::size_t>> seen;
      for (const Face f : out.mesh.faces()) {  // the faces that are left, in their order
        std::set<std::size_t> corners;
        for (const Vertex v : out.mesh.vertices_around_face(out.mesh.halfedge(f)))
          corners.insert(out.origin[v]);
        while (face < faces.size() && std::set(faces[face].begin(), faces[face].end()) != corners) ++face;
        RC_ASSERT(face < faces.size());
        RC_ASSERT(seen.insert(corners).second);
      }
    } catch (const ContentError& error) {
      RC_ASSERT(std::string(error.what()).starts_with("t: no faces"));
    }
  }));
}

TEST_CASE("soup_to_mesh: a corner out of range is named with its face or line") {
  io::PolygonSoup soup = soup_of(3, {{0, 1, 2}, {0, 1, 3}});
  CHECK(
      content_error([&] { io::soup_to_mesh(soup, "t"); }).starts_with("t: face 1: a corner names a vertex"));
  soup.face_lines = {11, 12};
  CHECK(content_error([&] { io::soup_to_mesh(soup, "t"); }).starts_with("t:12: a corner names a vertex"));
}

TEST_CASE("make_manifold: a component is turned whole where that turns fewer faces") {
  std::vector<io::SoupTriangle> t = {
      {{0, 2, 1}, {0, 1, 2}, 0}, {{0, 2, 3}, {3, 4, 5}, 1}, {{0, 3, 4}, {6, 7, 8}, 2}};
  const io::ManifoldReport report = io::make_manifold(t, 5);
  CHECK(report.reversed_faces == 1);
  CHECK(report.added_points.empty());
  CHECK(t[0].points == std::array<std::size_t, 3>{0, 1, 2});
  CHECK(t[0].corners == std::array<std::size_t, 3>{0, 2, 1});
}

TEST_CASE("soup_to_mesh: the cut of a four-sided face is a diagonal, other edges are none") {
  // A quad, a triangle beside it, a pentagon, and a quad that is wound the other way.
  const io::SoupMesh out =
      io::soup_to_mesh(soup_of(10, {{0, 1, 2, 3}, {1, 4, 2}, {5, 6, 7, 8, 9}, {0, 1, 6, 5}}), "soup");
  const auto diagonal = *find_map(out.mesh, attribute::diagonal);
  std::set<std::pair<std::size_t, std::size_t>> marked;
  for (const Edge e : out.mesh.edges()) {
    if (!diagonal[e]) continue;
    marked.insert(std::minmax(out.origin[out.mesh.vertex(e, 0)], out.origin[out.mesh.vertex(e, 1)]));
  }
  CHECK(marked == std::set<std::pair<std::size_t, std::size_t>>{{0, 2}, {0, 6}});
  CHECK_FALSE(
      find_map(io::soup_to_mesh(soup_of(5, {{0, 1, 2}, {0, 2, 3, 4, 1}}), "soup").mesh, attribute::diagonal));
}

TEST_CASE("soup_to_mesh: a point of 1,500 faces gives the half-edges that adding one by one gives") {
  for (const bool closed : {true, false}) {
    constexpr std::size_t n = 1500;
    std::vector<List> faces;
    for (std::size_t i = 0; i < n - !closed; ++i) {
      const std::size_t k = (7 * i + 3) % (closed ? n : n - 1);
      faces.push_back({0, 1 + k, 1 + (k + 1) % n});
    }
    faces.push_back({1, n + 1, 2});  // beside the fan
    const auto out = io::soup_to_mesh(soup_of(n + 2, faces), "t");
    Mesh one_by_one;
    for (const Point& p : out.mesh.points()) one_by_one.add_vertex(p);
    for (const List& f : faces)
      REQUIRE(one_by_one.add_face(Vertex(f[0]), Vertex(f[1]), Vertex(f[2])) != Mesh::null_face());
    CHECK_FALSE(out.repairs.any());
    CHECK(is_manifold(out.mesh));
    REQUIRE(out.mesh.number_of_halfedges() == one_by_one.number_of_halfedges());
    bool same = true;
    for (const Halfedge h : out.mesh.halfedges())
      same &= out.mesh.next(h) == one_by_one.next(h) && out.mesh.face(h) == one_by_one.face(h) &&
              out.mesh.target(h) == one_by_one.target(h);
    for (const Face f : out.mesh.faces()) same &= out.mesh.halfedge(f) == one_by_one.halfedge(f);
    CHECK(same);
  }
}

TEST_CASE("soup_to_mesh: 1,500 faces that share one point alone are parted there") {
  std::vector<List> faces;
  for (std::size_t i = 0; i < 1500; ++i) faces.push_back({0, 1 + 2 * i, 2 + 2 * i});
  const auto out = io::soup_to_mesh(soup_of(3001, faces), "t");
  CHECK(out.repairs.duplicated_vertices == 1499);
  CHECK(is_manifold(out.mesh));
}
