// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/pairs/pair_search.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "tests/physics/pairs/random_pairs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

using Pairs = std::multiset<std::pair<int, int>>;

bool meet(const LaneBox& a, const LaneBox& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  return true;
}

struct Found {
  Pairs edges, vertices;
};

Found found_by(const PairSearch& search) {
  Found found;
  // In two parts, as threads do.
  for (const auto& [begin, end] : {std::pair{0, search.groups() / 3}, {search.groups() / 3, search.groups()}})
    search.each_pair(
        begin, end,
        [&](const Candidate& c) {
          found.edges.insert({c.first, c.second});
        },
        [&](const Candidate& c) {
          found.vertices.insert({c.first, c.second});
        });
  return found;
}

/// All that have no vertex in common and whose boxes meet.
Found by_looking_at_all(const PairMesh& m, const FloatSweep& sweep, double margin) {
  std::vector<LaneBox> edges, vertices, triangles;
  for (std::size_t e = 0; e < m.edges.size(); ++e)
    edges.push_back(sweep.box(m.edges[e], float(m.edge_radius[e] + margin)));
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    triangles.push_back(sweep.box(m.triangles[t], float(m.triangle_radius[t] + margin)));
  Found found;
  for (int a = 0; a < int(edges.size()); ++a)
    for (int b = a + 1; b < int(edges.size()); ++b) {
      const auto v = vertices_of(m, {1, a, b});
      const bool share = v[0] == v[2] || v[0] == v[3] || v[1] == v[2] || v[1] == v[3];
      if (!share && meet(edges[std::size_t(a)], edges[std::size_t(b)])) found.edges.insert({a, b});
    }
  for (int v = 0; v < int(m.radius.size()); ++v) {
    const LaneBox box = sweep.box(std::array{v}, float(m.radius[std::size_t(v)] + margin));
    for (int t = 0; t < int(triangles.size()); ++t)
      if (std::ranges::count(m.triangles[std::size_t(t)], v) == 0 && meet(box, triangles[std::size_t(t)]))
        found.vertices.insert({v, t});
  }
  return found;
}

/// Two searches among a third and the rest, and the one with the other, tell the same.
void check_parts(const PairMesh& m, const FloatSweep& sweep, const PairSearch& search, const Found& all) {
  std::array<std::vector<int>, 2> e, v, t;
  for (int i = 0; i < int(m.edges.size()); ++i) e[i % 3 > 0].push_back(i);
  for (int i = 0; i < int(m.radius.size()); ++i) v[i % 7 > 2].push_back(i);
  for (int i = 0; i < int(m.triangles.size()); ++i) t[i % 5 > 1].push_back(i);
  const PairSearch a = search.among(e[0], v[0], t[0], sweep, 0.01),
                   b = search.among(e[1], v[1], t[1], sweep, 0.01);
  Found found = found_by(a), others = found_by(b);
  found.edges.merge(others.edges);
  found.vertices.merge(others.vertices);
  a.each_pair_with(
      b,
      [&](int i, int j) {
        found.edges.insert({std::min(i, j), std::max(i, j)});
      },
      [&](int vertex, int triangle) {
        found.vertices.insert({vertex, triangle});
      },
      [&](int triangle, int vertex) {
        found.vertices.insert({vertex, triangle});
      });
  CHECK(found.edges == all.edges);
  CHECK(found.vertices == all.vertices);
}

}  // namespace

TEST_CASE(
    "pair_search: each pair whose boxes meet is told once, wherever the cloth went since groups were made",
    "[long]") {
  std::size_t seen = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Cloth cloth = rough_sheet(4 + int(seed), 1.2, seed);
    const PairMesh mesh = pair_mesh(cloth, 0.02);
    PairSearch search(mesh);
    Noise noise(seed);
    std::vector<Vec3> x = cloth.particles.x, way(seed % 2 ? x.size() : 0);
    for (const double far : {0.0, 0.01, 0.5}) {  // the last tears all groups apart
      for (Vec3& p : x) p += far * noise.vector();
      for (Vec3& w : way) w = 0.05 * noise.vector();
      FloatSweep sweep;
      sweep.assign(x, way, x[0]);
      search.place(sweep, 0.01);
      const Found found = found_by(search), all = by_looking_at_all(mesh, sweep, 0.01);
      CHECK(found.edges == all.edges);
      CHECK(found.vertices == all.vertices);
      seen += all.edges.size();
      check_parts(mesh, sweep, search, all);
    }
  }
  CHECK(seen > 10000);
}
