// SPDX-License-Identifier: GPL-3.0-or-later
// Lines drawn into cloth that is worn and moves, by the default integrator.
#include <CGAL/bounding_box.h>

#include <catch2/catch.hpp>

#include "geometry/mesh/property_names.h"
#include "io/scene/state_file.h"
#include "journey.h"

using namespace furrow;
using namespace furrow::tests;
using geometry::Point;
using geometry::Vertex;

namespace {

Vertex nearest(const geometry::Mesh& mesh, const Point& p) {
  Vertex best(0);
  for (Vertex v : mesh.vertices())
    if (CGAL::squared_distance(mesh.point(v), p) < CGAL::squared_distance(mesh.point(best), p)) best = v;
  return best;
}

/// A ridge down the front of the tunic, which looks along +x, and a valley down its back.
std::string lines_on(const geometry::Mesh& mesh) {
  const auto box = CGAL::bbox_3(mesh.points().begin(), mesh.points().end());
  const auto at = [&](double x, double up) {
    const Point p(x, box.ymin() + up * box.y_span(), (box.zmin() + box.zmax()) / 2);
    return std::to_string(nearest(mesh, p).idx());
  };
  const auto line = [&](const std::string& name, const std::string& height, double x) {
    return R"({"name": ")" + name + R"(", "height": )" + height + R"(, "vertices": [)" + at(x, 0.6) + ", " +
           at(x, 0.3) + "]}";
  };
  return R"({"strokes": [)" + line("late", "0.012", box.xmax()) + ", " + line("dent", "-0.006", box.xmin()) +
         "]}";
}

/// Vertices that stay where they were keep how they move, what they touch and what holds them.
void check_kept(const io::SavedState& half, const io::SavedState& more) {
  const auto &before = half.simulation, &after = more.simulation;
  const auto v = *geometry::find_map(half.file.mesh, geometry::attribute::velocity),
             w = *geometry::find_map(more.file.mesh, geometry::attribute::velocity);
  std::size_t stayed = 0, held = 0, same_speed = 0;
  for (Vertex i : half.file.mesh->vertices()) {
    if (half.file.mesh->point(i) != more.file.mesh->point(i)) continue;
    ++stayed;
    same_speed += v[i] == w[i];
    if (before.steps.anchors.empty()) continue;
    held += before.steps.anchors[i].limit >= 0;
    REQUIRE(before.steps.anchors[i] == after.steps.anchors[i]);
  }
  CHECK(stayed > half.file.mesh->number_of_vertices() / 2);
  CHECK(same_speed > stayed / 2);  // the others share what momentum the lines took or brought
  CHECK(held > 10);
  CHECK(before.steps.self.friction.size() >= after.steps.self.friction.size());
  CHECK(more.file.mesh->number_of_vertices() > half.file.mesh->number_of_vertices());
}

void draw_on_the_way(const std::string& garment, const std::string& options) {
  step("simulate " + garment + " --body she.obj --seconds 0.5 --stop-at 0.25 --save-state half.ply" +
       options);
  const io::SavedState half = io::read_state("half.ply");
  write_text("more.json", lines_on(half.file.mesh));
  step("wrinkle --state half.ply more.json -o more.ply");
  check_kept(half, io::read_state("more.ply"));
  const auto end = step("simulate --state more.ply -o worn.ply");
  CHECK(end["time"] == Approx(0.5));
  CHECK(end["outcome"] == "finished");
  CHECK(std::filesystem::exists("worn.ply"));
}

}  // namespace

TEST_CASE("journeys: lines are drawn on a tunic that is worn, and it goes on to its end", "[release]") {
  const Journey here;
  here.bring("meshes/tunic.obj");
  here.bring_body_of_tunic("she.obj");
  SECTION("as it comes") { draw_on_the_way("tunic.obj", ""); }
  SECTION("that keeps off itself") {
    draw_on_the_way("tunic.obj", " --self-contact on --cloth-friction 0.3");
  }
  SECTION("that was draped before") {
    step("drape tunic.obj --body she.obj -o draped.ply");
    draw_on_the_way("draped.ply", "");
  }
}
