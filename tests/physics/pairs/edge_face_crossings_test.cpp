// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/pairs/edge_face_crossings.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "tests/physics/pairs/random_pairs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// By solving for the place: no edge here lies within rounding of a border.
bool passes_through(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  Mat3 m;
  m << b - a, c - a, p - q;
  const Vec3 s = m.inverse() * (p - a);
  return s[0] > 0 && s[1] > 0 && s[0] + s[1] < 1 && s[2] > 0 && s[2] < 1;
}

}  // namespace

TEST_CASE("edge_face_crossings: they are those that looking at all edges and faces finds", "[long]") {
  std::size_t seen = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Cloth cloth = rough_sheet(8, 1.2, seed);
    const PairMesh mesh = pair_mesh(cloth, 0.001);
    const auto& x = cloth.particles.x;
    std::vector<EdgeFaceCrossing> expected;
    for (int e = 0; e < int(mesh.edges.size()); ++e)
      for (int t = 0; t < int(mesh.triangles.size()); ++t) {
        const auto& [p, q] = mesh.edges[std::size_t(e)];
        const auto& [a, b, c] = mesh.triangles[std::size_t(t)];
        if (p == a || p == b || p == c || q == a || q == b || q == c) continue;
        if (passes_through(x[std::size_t(p)], x[std::size_t(q)], x[std::size_t(a)], x[std::size_t(b)],
                           x[std::size_t(c)]))
          expected.push_back({e, t});
      }
    CHECK(edge_face_crossings(mesh, x) == expected);
    seen += expected.size();
  }
  CHECK(seen > 100);
}

TEST_CASE("edge_face_crossings: what touches counts, what is beside it does not") {
  Cloth cloth;
  for (const Vec3& x :
       {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.2, 0.2, 0), Vec3(0.2, 0.2, 1), Vec3(9, 9, 1)})
    add_particle(cloth, x, 1);
  cloth.triangles = {{0, 1, 2}, {3, 4, 5}};
  const PairMesh mesh = pair_mesh(cloth, 0.001);
  CHECK(edge_face_crossings(mesh, cloth.particles.x).size() == 2);  // both edges at the vertex that touches
  auto lifted = cloth.particles.x;
  lifted[3].z() = 1e-9;
  CHECK(edge_face_crossings(mesh, lifted).empty());
  // Flat cloth lies in one plane, and touches nothing there but what it is joined to.
  const Cloth flat = rough_sheet(8, 0, 1);
  CHECK(edge_face_crossings(pair_mesh(flat, 0.001), flat.particles.x).empty());
  Cloth nearly = flat;  // as rounding leaves it: some signs are in doubt, others are not
  Noise noise(3);
  for (Vec3& x : nearly.particles.x) x.z() += 0.1 + 3e-14 * noise();
  CHECK(edge_face_crossings(pair_mesh(flat, 0.001), nearly.particles.x).empty());
  std::vector<PairKey> keys;
  add_pairs_of({0, 1}, mesh, keys);
  CHECK(keys.size() == 5);
}
