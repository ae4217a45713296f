// SPDX-License-Identifier: GPL-3.0-or-later
#include <rapidcheck.h>

#include <catch2/catch.hpp>

#include "geometry/rest/rest_metric.h"
#include "geometry/rest/rest_state.h"
#include "geometry/rest/stiffness.h"
#include "tests/geometry/insert/insertion_checks.h"
#include "tests/geometry/insert/insertion_meshes.h"

namespace furrow::tests {

using namespace geometry;

namespace {

/// Any integer in [low, high), all alike from the first case on (inRange alone starts near `low`).
int any_of(int low, int high) { return *rc::gen::resize(100, rc::gen::inRange(low, high)); }

/// A stroke near a random sheet: points anywhere, now and then exactly at a vertex or beyond the border.
Stroke random_stroke(const Mesh& mesh) {
  Stroke stroke;
  const int n = any_of(1, 9);
  const auto coordinate = [] { return any_of(-30, 1031) / 1000.0; };
  for (int i = 0; i < n; ++i) {
    const Point p(coordinate(), coordinate(), 0);
    const Vertex near = nearest_vertex(mesh, p);
    const bool at_vertex = any_of(0, 5) == 0;
    const Point q(p.x(), p.y(), mesh.point(near).z());
    stroke.points.push_back(at_vertex ? mesh.point(near) : q);
  }
  stroke.closed = n > 2 && any_of(0, 4) == 0;
  return stroke;
}

/// The meshes and strokes that are tried: small, curved, any angle from 15 degrees.
void draw_random_lines() {
  Mesh mesh = random_sheet(static_cast<std::uint64_t>(any_of(0, 1 << 30)), 15);
  InsertionOptions options;
  options.max_distance = 0.3;
  ensure_rest_lengths(mesh);
  const double h = mean_rest_length(mesh);
  options.mean_edge = h;
  const double least = std::min(5.0, 0.4 * audit_rest_metric(mesh).min_angle_deg);
  const int lines = any_of(1, 4);
  for (int id = 0; id < lines; ++id) {
    const Stroke stroke = random_stroke(mesh);
    const Mesh before = mesh;
    const Insertion insertion = insert_along_stroke(mesh, stroke, id, options);
    for (const std::string& fault : faults_of_insertion(before, mesh, insertion, false)) RC_FAIL(fault);
    const double angle = audit_rest_metric(mesh).min_angle_deg;
    if (!(angle >= least)) RC_FAIL("smallest angle " + std::to_string(angle));
    // A way round is a refused flip with its reason.
    std::size_t refused = 0;
    for (const auto& [reason, count] : insertion.report.refused_flips) refused += count;
    RC_ASSERT(refused >= insertion.report.routed + insertion.report.split_edges.size());
    RC_ASSERT(relative_deviation(before, mesh, stroke, insertion, h) <= 1.5);
  }
}

}  // namespace

TEST_CASE("insert_along_stroke: random strokes on random sheets leave a sound mesh and whole lines",
          "[long]") {
  CHECK(rc::check(draw_random_lines));
}

}  // namespace furrow::tests
