// SPDX-License-Identifier: GPL-3.0-or-later
// Operations that take long ask whether they are cancelled (physics/base/cancel_scope.h): after bounded work,
// and what they were to change is then as it was.
#include <catch2/catch.hpp>
#include <functional>

#include "geometry/fold/line_height.h"
#include "geometry/fold/taubin_smooth.h"
#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/self_intersections.h"
#include "geometry/quality/fold_quality.h"
#include "geometry/quality/fold_surface.h"
#include "geometry/refine/bake_maps.h"
#include "geometry/refine/subdivide.h"
#include "geometry/refine/surface_deviation.h"
#include "geometry/refine/transfer_shape.h"
#include "geometry/stroke/place_path_stroke.h"
#include "geometry/stroke/place_view_stroke.h"
#include "geometry/stroke/project_onto_surface.h"
#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"
#include "tests/test_meshes.h"

using namespace furrow;
using namespace furrow::geometry;

namespace {

std::vector<Stroke> two_strokes() {
  std::vector<Stroke> list(2);
  list[0].points = {{0.15, 0.31, 0}, {0.86, 0.72, 0}};
  list[1].points = {{0.2, 0.8, 0}, {0.5, 0.83, 0}, {0.8, 0.79, 0}};
  for (Stroke& s : list) s.height = 0.02, s.width = 0.15;
  return list;
}

WrinkleOptions by(InsertionRule rule) {
  WrinkleOptions options;
  options.insertion.rule = rule;
  return options;
}

/// With texture coordinates inside the unit square.
Mesh textured(int n) {
  Mesh mesh = tests::jittered(n, n, 0.2, 3);
  auto texture = ensure_map(mesh, attribute::texture);
  for (Halfedge h : mesh.halfedges()) {
    const Point& p = mesh.point(mesh.target(h));
    texture[h] = {0.1 + 0.8 * p.x(), 0.1 + 0.8 * p.y()};
  }
  return mesh;
}

Mesh wavy(Mesh mesh) {
  tests::lift(mesh, [](double x, double y) { return 0.02 * std::sin(9 * x) * std::cos(7 * y); });
  return mesh;
}

/// A mesh of n x n cells, and what is done to it.
struct Operation {
  const char* name;
  std::function<Mesh(int)> make;
  std::function<void(Mesh&, int)> run;
  bool of_faces = true;  ///< the work is that of the mesh's faces; else of what is drawn
};

void lay_path(Mesh& mesh, int) {
  const std::vector<std::size_t> ends{0, mesh.number_of_vertices() - 1};
  place_path_stroke(mesh, ends, false, "path");
}

void lay_view(Mesh& mesh, int n) {
  std::vector<SightLine> sight;
  for (int i = 0; i <= n; ++i) sight.push_back({{0.05 + 0.9 * i / n, 0.4, 1}, {0, 0, -1}});
  place_view_stroke(mesh, SurfaceProjector(mesh), sight, true, false, "view");
}

void transfer_back(Mesh& mesh, int n) {
  Mesh wrinkled = tests::jittered(n, n, 0.2, 3);
  {
    const physics::CancelScope whole([] { return false; });
    wrinkle(wrinkled, two_strokes());
  }
  transfer_shape(mesh, wrinkled);
}

void measure_all_lines(Mesh& mesh, int) {
  const std::vector<Point> before(mesh.points().begin(), mesh.points().end());
  const FoldSurface surface = surface_over(mesh, before);
  for (const FoldCurve& curve : carried_curves(surface, std::vector<double>{0.15, 0.15}))
    measure_line(surface, curve);
}

Mesh jittered(int n) { return tests::jittered(n, n, 0.2, 3); }
/// So that no vertex is where one of the other mesh is.
Mesh shifted(int n) {
  Mesh mesh = jittered(n);
  for (Vertex v : mesh.vertices()) mesh.point(v) = mesh.point(v) + Vector(1e-4, 0, 0);
  return mesh;
}
Mesh with_lines(int n) {
  Mesh mesh = jittered(n);
  wrinkle(mesh, two_strokes(), by(InsertionRule::safe));
  return mesh;
}

const std::vector<Operation>& operations() {
  static const std::vector<Operation> all{
      {"strokes become folds", jittered, [](Mesh& m, int) { wrinkle(m, two_strokes()); }, false},
      {"strokes become lines", jittered,
       [](Mesh& m, int) { wrinkle(m, two_strokes(), by(InsertionRule::safe)); }},
      {"smoothing", jittered, [](Mesh& m, int) { taubin_smooth(m, {}); }},
      {"Loop's subdivision", jittered, [](Mesh& m, int) { loop_subdivide(m, 2); }},
      {"division at mid-points", jittered, [](Mesh& m, int) { midpoint_subdivide(m, 2); }},
      {"shape transfer", shifted, transfer_back, false},
      {"maps", textured,
       [](Mesh& m, int n) {
         bake_maps(m, wavy(m), {8 * n, 2});
       }},
      {"deviation", jittered, [](Mesh& m, int) { surface_deviation(m, wavy(m)); }},
      {"crossings", jittered, [](Mesh& m, int) { count_self_intersections(m); }},
      {"a stroke from vertex to vertex", jittered, lay_path},
      {"a stroke on a picture", jittered, lay_view},
      {"heights of lines", with_lines, [](Mesh& m, int) { line_heights(m); }},
      {"quality of lines", with_lines, measure_all_lines},
  };
  return all;
}

bool same(const Mesh& a, const Mesh& b) {
  return a.num_faces() == b.num_faces() && a.num_edges() == b.num_edges() &&
         std::equal(a.points().begin(), a.points().end(), b.points().begin(), b.points().end()) &&
         a.properties<Vertex>() == b.properties<Vertex>() && a.properties<Edge>() == b.properties<Edge>();
}

/// How often it asks.
int questions_of(const Operation& operation, int n) {
  Mesh mesh = operation.make(n);
  int asked = 0;
  const physics::CancelScope scope([&] { return ++asked < 0; });
  operation.run(mesh, n);
  return asked;
}

}  // namespace

TEST_CASE("cancelling: whenever it comes, an operation throws and its mesh is as it was") {
  for (const Operation& operation : operations()) {
    CAPTURE(operation.name);
    const int n = 8, all = questions_of(operation, n);
    REQUIRE(all > 4);
    for (const int at : {1, 2, all / 3, 2 * all / 3, all}) {
      CAPTURE(at, all);
      Mesh mesh = operation.make(n);
      const Mesh before = mesh;
      int asked = 0;
      const physics::CancelScope scope([&] { return ++asked >= at; });
      CHECK_THROWS_AS(operation.run(mesh, n), physics::Cancelled);
      CHECK(asked == at);
      CHECK(same(mesh, before));
    }
  }
}

TEST_CASE("cancelling: questions come with the work: four times the faces, twice to eight times as many") {
  for (const Operation& operation : operations()) {
    CAPTURE(operation.name);
    const double few = questions_of(operation, 10), many = questions_of(operation, 20);
    CAPTURE(few, many);
    CHECK(many > (operation.of_faces ? 1.4 : 0.5) * few);
    CHECK(many < 12 * few);
    CHECK(many > 20);
  }
}
