// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/posed_body.h"

#include <catch2/catch.hpp>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather.h"
#include "geometry/figure/repair_body.h"
#include "geometry/mesh/self_intersections.h"
#include "io/mesh/mesh_file.h"
#include "physics/body/compare_colliders.h"
#include "physics/body/depth_map_collider.h"
#include "tests/test_paths.h"

namespace {

using namespace furrow;
using physics::DepthMapCollider, physics::DepthMaps, physics::ExactDistance, physics::TriangleMesh,
    physics::Vec3;

TriangleMesh mannequin() {
  return bridge::to_triangle_mesh(
      geometry::repair_body(io::read_mesh(tests::source_dir() / "meshes" / "mannequin.obj").mesh));
}

std::size_t self_intersections(const TriangleMesh& mesh) {
  std::vector<geometry::Point> points;
  for (const Vec3& x : mesh.vertices) points.push_back(bridge::to_cgal(x));
  return geometry::count_self_intersections(points, mesh.triangles);
}

physics::ColliderComparison compare(const TriangleMesh& mesh, DepthMaps maps) {
  physics::DepthMapOptions options;
  options.maps = maps;
  return physics::compare_colliders(DepthMapCollider(mesh, options), ExactDistance(mesh), mesh);
}

}  // namespace

TEST_CASE("posed_body: the mannequin's arms go where they are told, and through nothing") {
  const TriangleMesh figure = mannequin(), front = cases::arms_in_front(figure);
  const cases::ArmPose out = cases::a_pose(40);
  const TriangleMesh a_pose = cases::posed(figure, cases::mannequin_arm(), out, out);
  CHECK(self_intersections(a_pose) == 0);
  CHECK(self_intersections(front) == 0);
  CHECK(front.triangles == figure.triangles);
  double reach = 0, width = 0;
  int turned = 0, legs = 0;
  for (std::size_t i = 0; i < figure.vertices.size(); ++i) {
    reach = std::max(reach, a_pose.vertices[i].x());
    width = std::max(width, front.vertices[i].x());
    turned += (front.vertices[i] - figure.vertices[i]).norm() > 0.1;
    if (figure.vertices[i].y() < 0.75) legs += front.vertices[i] != figure.vertices[i];
  }
  CHECK(reach == Approx(0.16 + 0.693 * std::cos(40 * 3.14159265 / 180)).margin(0.02));
  CHECK(width < 0.35);
  CHECK(turned > 800);
  CHECK(legs == 0);
  CHECK_THROWS_AS(cases::posed(figure, cases::mannequin_arm(), out, {Vec3::Zero(), out.fore}),
                  std::invalid_argument);
}

TEST_CASE(
    "posed_body: the depth maps of a figure fail where its arms hide its belly, and the self-test says so",
    "[long]") {
  const TriangleMesh figure = mannequin(), front = cases::arms_in_front(figure);
  CHECK_FALSE(compare(figure, DepthMaps::front_back_top).disagrees());
  const auto two = compare(front, DepthMaps::front_back), three = compare(front, DepthMaps::front_back_top),
             six = compare(front, DepthMaps::six);
  CHECK(three.disagrees());
  CHECK_FALSE(six.disagrees());
  CHECK(two.false_inside_share() > 1.5 * three.false_inside_share());
  CHECK(three.false_inside_share() > 5 * six.false_inside_share());
  CHECK(six.push_out.p95 < 1e-3);
}
