// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/pairs/pair_list.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/physics/pairs/random_pairs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

bool share_a_vertex(bool edges, const std::array<int, 4>& v) {
  const std::size_t split = edges ? 2 : 1;
  for (std::size_t i = 0; i < split; ++i)
    for (std::size_t j = split; j < 4; ++j)
      if (v[i] == v[j]) return true;
  return false;
}

double distance_at(const PairMesh& mesh, const PairKey& key, const std::vector<Vec3>& x) {
  const auto v = vertices_of(mesh, key);
  return std::sqrt(distance_of(key.edges, {x[std::size_t(v[0])], x[std::size_t(v[1])], x[std::size_t(v[2])],
                                           x[std::size_t(v[3])]})
                       .squared());
}

/// All pairs nearer than their range and 2 `more`, by looking at all.
std::vector<PairKey> all_near(const PairMesh& mesh, const std::vector<Vec3>& x, double more) {
  std::vector<PairKey> near;
  const auto ask = [&](const PairKey& key) {
    if (share_a_vertex(key.edges, vertices_of(mesh, key))) return;
    if (distance_at(mesh, key, x) - range_of(mesh, key) < 2 * more) near.push_back(key);
  };
  for (int v = 0; v < int(mesh.radius.size()); ++v)
    for (int t = 0; t < int(mesh.triangles.size()); ++t) ask({0, v, t});
  for (int a = 0; a < int(mesh.edges.size()); ++a)
    for (int b = a + 1; b < int(mesh.edges.size()); ++b) ask({1, a, b});
  return near;
}

std::vector<PairKey> keys_of(std::span<const ListedPair> pairs) {
  std::vector<PairKey> keys;
  for (const ListedPair& p : pairs) keys.push_back(p.key);
  std::sort(keys.begin(), keys.end());
  return keys;
}

std::vector<Vec3> random_moves(std::size_t n, double size, std::uint64_t seed) {
  Noise noise(seed);
  std::vector<Vec3> moves(n);
  const Vec3 common = 3 * size * noise.vector();
  for (Vec3& m : moves) m = common + size * noise.vector();
  return moves;
}

}  // namespace

TEST_CASE("pair_list: each front of the list is what looking at all pairs finds, on 100 random meshes") {
  std::size_t seen = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Cloth cloth = rough_sheet(6, 0.3 + 0.02 * double(seed), seed);
    const PairMesh mesh = pair_mesh(cloth, 0.02);
    const auto& x = cloth.particles.x;
    const double margin = 0.005 * double(seed % 5);
    const PairList list(mesh, x, {}, margin);
    CHECK(list.excess(x) == 0);
    for (const double excess : {0.0, 0.25 * margin, 0.5 * margin, margin}) {
      const auto front = keys_of(list.within(excess));
      CHECK(front == all_near(mesh, x, excess));
      seen += front.size();
    }
  }
  CHECK(seen > 10000);
}

TEST_CASE("pair_list: along the plan, and a margin beside it, no pair that touches is missing") {
  std::size_t seen = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Cloth cloth = rough_sheet(6, 0.8, seed);
    const PairMesh mesh = pair_mesh(cloth, 0.02);
    const auto& x = cloth.particles.x;
    const std::vector<Vec3> plan = random_moves(x.size(), 0.05, seed);
    const double margin = 0.01;
    const PairList list(mesh, x, plan, margin);
    for (const double s : {0.0, 0.3, 1.0}) {
      Noise noise(seed + 9);
      std::vector<Vec3> there = x;
      for (std::size_t i = 0; i < x.size(); ++i) there[i] += s * plan[i] + 0.4 * margin * noise.vector();
      const double excess = list.excess(there);
      CHECK(excess < margin);
      const auto listed = keys_of(list.within(excess)), near = all_near(mesh, there, 0);
      CHECK(std::includes(listed.begin(), listed.end(), near.begin(), near.end()));
      seen += near.size();
    }
  }
  CHECK(seen > 1000);
}

TEST_CASE("pair_list: two threads find the same pairs in the same order, and held pairs are none") {
  Cloth cloth = rough_sheet(20, 1.5, 4);
  const PairMesh mesh = pair_mesh(cloth, 0.01);
  ThreadPool two(2);
  const std::vector<Vec3> plan = random_moves(cloth.particles.size(), 0.02, 1);
  const PairList a(mesh, cloth.particles.x, plan, 0.003), b(mesh, cloth.particles.x, plan, 0.003, &two);
  REQUIRE(a.pairs().size() == b.pairs().size());
  CHECK(a.pairs().size() > 500);
  for (std::size_t i = 0; i < a.pairs().size(); ++i) {
    CHECK(a.pairs()[i].bound == b.pairs()[i].bound);
    CHECK(a.pairs()[i].key == b.pairs()[i].key);
  }
  for (double& w : cloth.particles.inv_mass) w = 0;
  const PairMesh held = pair_mesh(cloth, 0.01);
  CHECK(PairList(held, cloth.particles.x, plan, 0.003).pairs().empty());
  CHECK(PairList().excess(cloth.particles.x) > 1e300);
  CHECK_THROWS_AS(PairList(mesh, cloth.particles.x, std::span(plan).first(3), 0), std::invalid_argument);
}
