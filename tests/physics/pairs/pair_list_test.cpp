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

std::vector<Vec3> moved(std::vector<Vec3> x, double share, const std::vector<Vec3>& way) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += share * way[i];
  return x;
}

}  // namespace

TEST_CASE("pair_list: made for one place, it is what looking at all pairs finds, on 100 random meshes") {
  std::size_t seen = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Cloth cloth = rough_sheet(6, 0.3 + 0.02 * double(seed), seed);
    const PairMesh mesh = pair_mesh(cloth, 0.02);
    const auto& x = cloth.particles.x;
    PairList list(mesh);
    const auto found = keys_of(list.near(x, {}, 0.005 * double(seed % 5)));
    CHECK(found == all_near(mesh, x, 0));
    seen += found.size();
  }
  CHECK(seen > 3000);
}

TEST_CASE("pair_list: on a way, and where it is kept beside it, no pair that touches is missing", "[long]") {
  std::size_t seen = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Cloth cloth = rough_sheet(6, 0.8, seed);
    const PairMesh mesh = pair_mesh(cloth, 0.02);
    const auto& x = cloth.particles.x;
    const std::vector<Vec3> plan = random_moves(x.size(), 0.05, seed);
    const double margin = 0.01;
    PairList list(mesh);
    const auto on_way = keys_of(list.near(x, plan, margin));
    for (const double s : {0.0, 0.3, 1.0}) {
      std::vector<Vec3> there = moved(x, s, plan);
      const auto near = all_near(mesh, there, 0);
      CHECK(std::includes(on_way.begin(), on_way.end(), near.begin(), near.end()));
      Noise noise(seed + 9);
      for (Vec3& p : there) p += 0.4 * margin * noise.vector();
      const auto beside = all_near(mesh, there, 0), listed = keys_of(list.near(there, {}, margin));
      CHECK(std::includes(listed.begin(), listed.end(), beside.begin(), beside.end()));
      seen += beside.size();
    }
    CHECK(list.builds() == 1);
    CHECK(list.patches() == 0);
  }
  CHECK(seen > 1000);
}

TEST_CASE("pair_list: where a few vertices go far, only theirs are looked for anew, and none is missing",
          "[release]") {
  std::size_t seen = 0;
  int builds = 0, patches = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Cloth cloth = rough_sheet(9, 0.8, seed);
    const PairMesh mesh = pair_mesh(cloth, 0.02);
    std::vector<Vec3> x = cloth.particles.x;
    PairList list(mesh);
    Noise noise(seed);
    for (int step = 0; step < 25; ++step) {
      // All go a little, some far, and the step ends anywhere on its way.
      std::vector<Vec3> way = random_moves(x.size(), 2e-4, seed + std::uint64_t(step));
      for (int i = 0; i < 1 + step % 5; ++i)
        way[std::size_t(13 * i + 7 * step) % x.size()] = 0.2 * noise.vector();
      const auto on_way = keys_of(list.near(x, way, 0.01));
      for (const double s : {0.0, 0.5, 1.0}) {
        const auto near = all_near(mesh, moved(x, s, way), 0);
        REQUIRE(std::includes(on_way.begin(), on_way.end(), near.begin(), near.end()));
      }
      x = moved(x, 0.25 * double(step % 5), way);
      const auto near = all_near(mesh, x, 0), listed = keys_of(list.near(x, {}, 0.01));
      REQUIRE(std::includes(listed.begin(), listed.end(), near.begin(), near.end()));
      CHECK(std::adjacent_find(listed.begin(), listed.end()) == listed.end());
      seen += near.size();
    }
    builds += list.builds();
    patches += list.patches();
  }
  CHECK(seen > 1000);
  CHECK(patches > 200);
  CHECK(builds < 150);
}

TEST_CASE("pair_list: two threads find the same pairs in the same order, and held pairs are none") {
  Cloth cloth = rough_sheet(20, 1.5, 4);
  const PairMesh mesh = pair_mesh(cloth, 0.01);
  ThreadPool two(2);
  const auto& x = cloth.particles.x;
  const std::vector<Vec3> plan = random_moves(x.size(), 0.02, 1);
  PairList a(mesh), b(mesh);
  const auto one = a.near(x, plan, 0.003), other = b.near(x, plan, 0.003, &two);
  REQUIRE(one.size() == other.size());
  CHECK(one.size() > 500);
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].range == other[i].range);
    CHECK(one[i].key == other[i].key);
  }
  for (double& w : cloth.particles.inv_mass) w = 0;
  const PairMesh held = pair_mesh(cloth, 0.01);
  CHECK(PairList(held).near(x, plan, 0.003).empty());
  CHECK_THROWS_AS(a.near(x, std::span(plan).first(3), 0), std::invalid_argument);
  CHECK_THROWS_AS(a.near(x, {}, -1), std::invalid_argument);
}
