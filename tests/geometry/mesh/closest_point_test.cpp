// SPDX-License-Identifier: GPL-3.0-or-later
// Physics has no CGAL, so that its tree is compared with CGAL's here.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <catch2/catch.hpp>

#include "physics/body/triangle_bvh.h"
#include "tests/physics/body/field_inputs.h"

TEST_CASE("triangle_bvh: the closest point agrees with CGAL's tree on a dense sphere, also from its centre") {
  namespace physics = furrow::physics;
  using furrow::tests::uniform;
  using Kernel = CGAL::Simple_cartesian<double>;
  using Triangles = std::vector<Kernel::Triangle_3>;
  const physics::TriangleMesh m = furrow::tests::sphere(40, 0.8, {5, -3, 2});
  Triangles triangles;
  const auto point = [](const physics::Vec3& x) { return Kernel::Point_3(x[0], x[1], x[2]); };
  for (const auto& [a, b, c] : m.triangles)
    triangles.emplace_back(point(m.vertices[a]), point(m.vertices[b]), point(m.vertices[c]));
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>>> tree(
      triangles.begin(), triangles.end());
  const physics::TriangleBvh bvh(m);
  std::mt19937_64 random(1);
  for (int i = 0; i < 2000; ++i) {
    physics::Vec3 x(5, -3, 2);
    if (i > 0) x += physics::Vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    REQUIRE(bvh.closest(x).squared_distance ==
            Approx(tree.squared_distance(point(x))).epsilon(1e-11).margin(1e-22));
  }
}
