// SPDX-License-Identifier: GPL-3.0-or-later
// Strokes over seams: no seam edge is flipped, and the texture stays whole.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "geometry/insert/insert_along_stroke.h"
#include "geometry/rest/rest_metric.h"
#include "io/mesh/mesh_file.h"
#include "io/stroke/stroke_file.h"
#include "tests/geometry/insert/insertion_checks.h"
#include "tests/geometry/insert/insertion_meshes.h"
#include "tests/test_paths.h"

namespace furrow::tests {

using namespace geometry;

namespace {

using Ends = std::pair<Vertex, Vertex>;

Ends ends(Vertex a, Vertex b) { return {std::min(a, b), std::max(a, b)}; }

/// Found without MeshEditor: texture, group or material differ across an inner edge.
std::set<Ends> seams(const Mesh& mesh) {
  const auto texture = *find_map(mesh, attribute::texture);
  const auto group = find_map(mesh, attribute::group), material = find_map(mesh, attribute::material);
  std::set<Ends> result;
  for (Edge e : mesh.edges()) {
    if (mesh.is_border(e)) continue;
    const Halfedge h = mesh.halfedge(e), o = mesh.opposite(h);
    const Face f = mesh.face(h), g = mesh.face(o);
    if (texture[h] != texture[mesh.prev(o)] || texture[o] != texture[mesh.prev(h)] ||
        (group && (*group)[f] != (*group)[g]) || (material && (*material)[f] != (*material)[g]))
      result.insert(ends(mesh.source(h), mesh.target(h)));
  }
  return result;
}

/// The seams before, each split edge replaced by its halves.
std::set<Ends> expected_seams(std::set<Ends> before, const InsertionReport& report) {
  for (const SplitEdge& s : report.split_edges)
    if (before.erase(ends(s.from, s.to)) > 0) {
      before.insert(ends(s.from, s.vertex));
      before.insert(ends(s.vertex, s.to));
    }
  return before;
}

/// Twice the signed areas of the faces in texture space.
std::vector<double> texture_areas(const Mesh& mesh) {
  const auto texture = *find_map(mesh, attribute::texture);
  std::vector<double> areas;
  for (Face f : mesh.faces()) {
    const auto h = halfedges_of(mesh, f);
    const auto &a = texture[h[0]], &b = texture[h[1]], &c = texture[h[2]];
    areas.push_back((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }
  return areas;
}

constexpr std::array<std::array<double, 6>, 3> charts = {
    {{0.2, 0, 0.05, 0, 0.3, 0.1}, {0.1, -0.2, 0.7, 0.2, 0.1, 0.2}, {-0.25, 0.02, 0.9, 0.03, 0.3, 0.6}}};

/// Texture coordinates of a place in one of three panels: scaled, turned, mirrored.
TextureCoordinate charted(int panel, double x, double y) {
  const auto& c = charts[panel];
  return {c[0] * x + c[1] * y + c[2], c[3] * x + c[4] * y + c[5]};
}

/// A flat sheet of three panels: two seams upright, the second by group alone where y > 0.5.
Mesh panelled_sheet() {
  Mesh mesh = union_jack_sheet(20);
  auto texture = ensure_map(mesh, attribute::texture);
  auto group = ensure_map(mesh, attribute::group);
  for (Face f : mesh.faces()) {
    const Point middle = position_of(mesh, {f, {1. / 3, 1. / 3, 1. / 3}});
    group[f] = middle.x() < 0.3 ? 0 : middle.x() < 0.7 ? 1 : 2;
    for (Halfedge h : halfedges_of(mesh, f)) {
      const Point& p = mesh.point(mesh.target(h));
      texture[h] = charted(group[f], p.x(), p.y());
    }
  }
  return mesh;
}

Stroke random_stroke(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.05, 0.95), bend(-0.15, 0.15);
  const double x0 = unit(random) * 0.3, y0 = unit(random), x1 = 0.7 + 0.3 * unit(random), y1 = unit(random);
  const double amount = bend(random);
  Stroke stroke;
  for (int i = 0; i <= 120; ++i) {
    const double t = i / 120.0, y = y0 + t * (y1 - y0) + amount * std::sin(std::numbers::pi * 2 * t);
    stroke.points.push_back(Point(x0 + t * (x1 - x0), std::clamp(y, 0.02, 0.98), 0));
  }
  return stroke;
}

}  // namespace

TEST_CASE(
    "insert_along_stroke: over flat panels seams stay, texture is the affine image of the rest position",
    "[long]") {
  std::mt19937 random(20261121);
  std::size_t splits = 0;
  for (int round = 0; round < 12; ++round) {
    Mesh mesh = panelled_sheet();
    auto given = ensure_map(mesh, attribute::second_texture);
    for (const Halfedge h : mesh.halfedges())
      if (!mesh.is_border(h))
        given[h] = charted(1, mesh.point(mesh.target(h)).x(), mesh.point(mesh.target(h)).y());
    const std::vector<double> areas_before = texture_areas(mesh);
    std::set<Ends> expected = seams(mesh);
    REQUIRE(expected.size() == 40);
    for (int id = 0; id < 3; ++id) {
      Mesh before = mesh;
      ensure_rest_lengths(before);
      const Insertion insertion = insert_along_stroke(mesh, random_stroke(random), id);
      CHECK(faults_of_insertion(before, mesh, insertion, true) == std::vector<std::string>{});
      expected = expected_seams(expected, insertion.report);
      CHECK(seams(mesh) == expected);
      splits += insertion.report.split_edges.size();
    }
    const auto texture = *find_map(mesh, attribute::texture),
               second = *find_map(mesh, attribute::second_texture);
    const auto rest = *find_map(mesh, attribute::rest_position);
    const auto group = *find_map(mesh, attribute::group);
    double worst = 0, least = 1;
    for (Face f : mesh.faces())
      for (Halfedge h : halfedges_of(mesh, f)) {
        const RestPosition& p = rest[mesh.target(h)];
        const TextureCoordinate t = charted(group[f], p[0], p[1]);
        const TextureCoordinate s = charted(1, p[0], p[1]);  // without seams
        worst = std::max({worst, std::abs(t[0] - texture[h][0]), std::abs(t[1] - texture[h][1]),
                          std::abs(s[0] - second[h][0]), std::abs(s[1] - second[h][1])});
      }
    for (Face f : mesh.faces())
      least = std::min(least, texture_areas(mesh)[f.idx()] * (group[f] == 2 ? -1 : 1));  // mirrored
    CHECK(worst < 1e-12);
    CHECK(least > 0.005 * std::abs(areas_before[0]));
  }
  CHECK(splits > 20);
}

TEST_CASE("insert_along_stroke: a texture that is stretched unevenly is not folded over") {
  Mesh mesh = union_jack_sheet(20);
  auto texture = ensure_map(mesh, attribute::texture);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> offset(-0.45, 0.45);
  std::vector<TextureCoordinate> at(mesh.number_of_vertices());
  for (Vertex v : mesh.vertices()) at[v.idx()] = {mesh.point(v).x(), mesh.point(v).y()};
  const auto assign = [&] {
    for (Halfedge h : mesh.halfedges())
      if (!mesh.is_border(h)) texture[h] = at[mesh.target(h).idx()];
  };
  for (Vertex v : mesh.vertices()) {  // moved as far as no triangle turns over
    const TextureCoordinate old = at[v.idx()];
    at[v.idx()] = {old[0] + 0.05 * offset(random), old[1] + 0.05 * offset(random)};
    assign();
    const std::vector<double> areas = texture_areas(mesh);
    for (Face f : mesh.faces_around_target(mesh.halfedge(v)))
      if (f.is_valid() && !(areas[f.idx()] > 2e-4)) at[v.idx()] = old;
  }
  assign();
  for (int id = 0; id < 4; ++id) insert_along_stroke(mesh, random_stroke(random), id);
  std::size_t folded = 0;
  for (double area : texture_areas(mesh)) folded += !(area > 0);
  CHECK(folded == 0);
}

TEST_CASE(
    "insert_along_stroke: on the panelled skirt no seam is flipped, texture keeps its lengths, nothing turns "
    "over") {
  const auto folder = source_dir() / "meshes";
  Mesh mesh = io::read_mesh(folder / "panelled.obj").mesh;
  CHECK(mesh.number_of_vertices() > 1500);
  CHECK(seams(mesh).size() == 6 * 28);
  const double scale = [&] {  // of texture to cloth: the same everywhere
    const auto texture = *find_map(mesh, attribute::texture);
    double flat = 0, cloth = 0;
    for (Halfedge h : mesh.halfedges()) {
      if (mesh.is_border(h)) continue;
      const auto &a = texture[mesh.prev(h)], &b = texture[h];
      flat += std::hypot(b[0] - a[0], b[1] - a[1]);
      cloth += std::sqrt(CGAL::squared_distance(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))));
    }
    return flat / cloth;
  }();
  std::set<Ends> expected = seams(mesh);
  std::size_t crossed = 0;
  int id = 0;
  for (const Stroke& stroke : io::read_strokes(folder / "strokes" / "panelled.json", 0.01, {})) {
    const Insertion insertion = insert_along_stroke(mesh, stroke, id++);
    expected = expected_seams(expected, insertion.report);
    const auto refused = insertion.report.refused_flips.find(Refusal::seam);
    if (refused != insertion.report.refused_flips.end()) crossed += refused->second;
  }
  CHECK(crossed > 10);
  CHECK(seams(mesh) == expected);
  const auto texture = *find_map(mesh, attribute::texture);
  const auto rest = *find_map(mesh, attribute::rest_length);
  double worst = 0;
  for (Halfedge h : mesh.halfedges()) {
    if (mesh.is_border(h)) continue;
    const auto &a = texture[mesh.prev(h)], &b = texture[h];
    worst = std::max(worst, std::abs(std::hypot(b[0] - a[0], b[1] - a[1]) / scale - rest[mesh.edge(h)]));
  }
  CHECK(worst < 3e-5);  // [m]: faces are chords of the cone, edges of 22 mm
  for (double area : texture_areas(mesh)) CHECK(area / (scale * scale) > 2e-6);
}

}  // namespace furrow::tests
