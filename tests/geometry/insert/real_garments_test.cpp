// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/border_loops.h"
#include "geometry/refine/subdivide.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/rest/rest_state.h"
#include "geometry/rest/stiffness.h"
#include "io/mesh/mesh_file.h"
#include "io/stroke/stroke_file.h"
#include "tests/cases/safe_rule.h"
#include "tests/geometry/insert/insertion_checks.h"
#include "tests/test_paths.h"

namespace furrow::tests {

using namespace geometry;

namespace {

Mesh refined(const std::string& garment) {
  Mesh mesh = io::read_mesh(shared_dir() / "meshes" / "pairs" / garment).mesh;
  loop_subdivide(mesh, 2);
  return mesh;
}

std::vector<Stroke> committed_strokes(const std::string& name) {
  return io::read_strokes(source_dir() / "meshes" / "strokes" / name);
}

/// Every line is whole, on a sound mesh, and near its stroke.
void draw(Mesh mesh, const std::vector<Stroke>& strokes) {
  ensure_rest_lengths(mesh);
  InsertionOptions options;
  options.mean_edge = mean_rest_length(mesh);
  for (std::size_t id = 0; id < strokes.size(); ++id) {
    CAPTURE(strokes[id].name);
    const Mesh before = mesh;
    const Insertion insertion = insert_along_stroke(mesh, strokes[id], static_cast<int>(id), options);
    CHECK(faults_of_insertion(before, mesh, insertion, false) == std::vector<std::string>{});
    CHECK(relative_deviation(before, mesh, strokes[id], insertion, *options.mean_edge) <= 1);
    CHECK(insertion.line.chains.size() == 1);
  }
  CHECK(audit_rest_metric(mesh).min_angle_deg >= 8);
}

}  // namespace

TEST_CASE("wrinkle: six lines on a T-shirt lie where they were drawn and stand out as asked", "[release]") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  Mesh mesh = refined("mh_male/tshirt.obj");
  const std::vector<Stroke> strokes = committed_strokes("tshirt.json");
  REQUIRE(strokes.size() == 6);
  draw(mesh, strokes);
  for (const WrinkledLine& line : wrinkle(mesh, strokes, furrow::tests::safe_rule()).lines) {
    CAPTURE(line.name);
    CHECK(line.drawn_height / line.height == Approx(1).margin(0.1));
    CHECK(line.smoothed_height / line.height > 0.5);
  }
}

TEST_CASE("wrinkle: eight lines over the hem of a skirt lengthen it by more than 15 percent", "[release]") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  Mesh mesh = refined("mh_female/skirt.obj");
  const std::vector<Stroke> strokes = committed_strokes("skirt.json");
  REQUIRE(strokes.size() == 8);
  draw(mesh, strokes);
  const auto hem = [&] {
    const std::vector<BorderLoop> loops = border_loops(mesh);
    return rest_length(mesh, loops.at(find_border_loop(loops, "bottom")));
  };
  const double before = hem();
  wrinkle(mesh, strokes, furrow::tests::safe_rule());
  CHECK(hem() > 1.15 * before);
}

}  // namespace furrow::tests
