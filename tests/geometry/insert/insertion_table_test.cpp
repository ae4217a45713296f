// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>

#include "geometry/rest/rest_metric.h"
#include "geometry/rest/rest_state.h"
#include "geometry/rest/stiffness.h"
#include "tests/geometry/insert/insertion_checks.h"
#include "tests/geometry/insert/insertion_meshes.h"

namespace furrow::tests {

using namespace geometry;

namespace {

void draw_all(const MeshCase& on, const StrokeCase& kind) {
  Mesh mesh = on.mesh;
  ensure_rest_lengths(mesh);
  const double h = mean_rest_length(mesh);
  const double least = std::min(8.0, 0.8 * audit_rest_metric(mesh).min_angle_deg);
  InsertionOptions options;
  options.mean_edge = h;
  for (std::size_t id = 0; id < kind.strokes.size(); ++id) {
    CAPTURE(id);
    const Mesh before = mesh;
    const Insertion insertion = insert_along_stroke(mesh, kind.strokes[id], static_cast<int>(id), options);
    CHECK(faults_of_insertion(before, mesh, insertion, on.flat) == std::vector<std::string>{});
    CHECK(audit_rest_metric(mesh).min_angle_deg >= least);
    CHECK(relative_deviation(before, mesh, kind.strokes[id], insertion, h) <= 1);
    CHECK(insertion.report.warnings.empty());
    if (kind.name == "through vertices" || kind.name == "along edges") CHECK(insertion.report.nudges >= 1);
    CHECK(insertion.line.chains.size() == 1);
    CHECK(insertion.line.vertices.size() >= 10);
    if (kind.strokes[id].closed) CHECK(insertion.line.chains[0].front() == insertion.line.chains[0].back());
  }
}

}  // namespace

TEST_CASE(
    "insert_along_stroke: every kind of stroke on every kind of mesh becomes a whole line on a sound mesh",
    "[long]") {
  for (const MeshCase& on : mesh_zoo()) {
    for (const StrokeCase& kind : strokes_for(on)) {
      CAPTURE(on.name, kind.name);
      draw_all(on, kind);
    }
  }
}

TEST_CASE("insert_along_stroke: the third time along the same stroke adds next to nothing") {
  for (const MeshCase& on : mesh_zoo()) {
    CAPTURE(on.name);
    const Stroke stroke = strokes_for(on)[1].strokes[0];
    Mesh mesh = on.mesh;
    InsertionOptions options;
    ensure_rest_lengths(mesh);
    options.mean_edge = mean_rest_length(mesh);
    const std::size_t first = insert_along_stroke(mesh, stroke, 0, options).report.inserted;
    const Insertion second = insert_along_stroke(mesh, stroke, 1, options);
    const Insertion third = insert_along_stroke(mesh, stroke, 2, options);
    CHECK(first >= 30);
    CHECK(second.report.inserted + third.report.inserted <= first / 10);
    CHECK(third.report.reused > first);
  }
}

TEST_CASE("insert_along_stroke: the paper's rule flips every original inner edge and tells what it folds") {
  Mesh regular = regular_sheet(20), jack = union_jack_sheet(20);
  InsertionOptions paper;
  paper.rule = InsertionRule::paper;
  Stroke stroke;
  stroke.points = {Point(0.21, 0.23, 0), Point(0.78, 0.71, 0)};
  const Insertion on_regular = insert_along_stroke(regular, stroke, 0, paper);
  const std::size_t n = on_regular.report.inserted;
  CHECK(on_regular.line.chains[0].size() == n);
  // n faces in a strip: n - 1 shared edges and n + 2 at the rim.
  CHECK(on_regular.report.flipped == 2 * n + 1);
  CHECK(on_regular.report.delaunay_flips == 0);
  CHECK(on_regular.report.missing_edges.empty());
  const Insertion on_jack = insert_along_stroke(jack, stroke, 0, paper);
  CHECK(on_jack.report.flipped == 2 * on_jack.report.inserted + 1);
  std::size_t inverted = 0;
  for (Face f : jack.faces()) inverted += !(area_normal_of(jack, f).z() > 0);
  CHECK(inverted > 0);
  CHECK(on_jack.report.folded_flips > 0);
}

}  // namespace furrow::tests
