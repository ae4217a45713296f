// SPDX-License-Identifier: MIT
#include "physics/pairs/untangle_layers.h"

#include <catch2/catch.hpp>

#include "physics/cloth/join_cloths.h"
#include "physics/pairs/edge_face_crossings.h"
#include "physics/pairs/layer_order.h"
#include "tests/cases/layered.h"
#include "tests/physics/pairs/random_pairs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// Two sheets over a square of 1 m that look up.
struct TwoSheets {
  Cloth cloth;
  ClothLayers layers;
  std::size_t inner;

  TwoSheets(int n, int m, double crumple) {
    const std::array<Cloth, 2> both{rough_sheet(n, crumple, 1), rough_sheet(m, crumple, 2)};
    cloth = join_cloths(both);
    inner = both[0].particles.size();
    layers.of_vertex.assign(cloth.particles.size(), 1);
    std::fill_n(layers.of_vertex.begin(), inner, 0);
    layers.turned = {0, 0};
  }
  PairMesh mesh() const { return pair_mesh(cloth, 0.001); }
  LayerOrder order() const {
    const auto& x = cloth.particles.x;
    const auto middle = x.begin() + std::ptrdiff_t(inner);
    TriangleMesh below{{x.begin(), middle}, {}};
    for (const auto& t : cloth.triangles)
      if (std::size_t(t[0]) < inner) below.triangles.push_back(t);
    return layer_order(std::vector<Vec3>(middle, x.end()), below, layers.turned[0] != 0, 0.1);
  }
};

}  // namespace

TEST_CASE("untangle_layers: sheets that noise interlaces come apart in their order") {
  for (const bool turned : {false, true}) {
    TwoSheets two(20, 23, 0.2);
    two.layers.turned[0] = turned;
    const std::vector<Vec3> before = two.cloth.particles.x;
    const PairMesh mesh = two.mesh();
    REQUIRE(edge_face_crossings(mesh, before).size() > 300);
    const UntangleReport report = untangle_layers(two.cloth.particles.x, mesh, two.layers);
    CHECK(report.at_start > 300);
    CHECK(report.left == 0);
    CHECK(report.near == 0);
    CHECK(edge_face_crossings(mesh, two.cloth.particles.x).empty());
    CHECK(report.farthest < 2 * mesh.mean_edge);
    CHECK(std::equal(before.begin(), before.begin() + std::ptrdiff_t(two.inner),
                     two.cloth.particles.x.begin()));
    const LayerOrder order = two.order();
    CHECK(order.compared > 300);
    CHECK(order.outside == order.compared);
  }
}

TEST_CASE("untangle_layers: sheets come apart that cross by a bulge, a corner, along a line or everywhere") {
  for (const furrow::cases::CrossingStart start : furrow::cases::crossing_starts) {
    const furrow::cases::LayeredCase c = furrow::cases::untangled(start, 20);
    INFO(furrow::cases::name_of(start));
    CHECK(c.crossings == 0);
    CHECK(c.iterations > 0);
    for (const furrow::cases::LayeredNumber& n : c.numbers) {
      INFO(n.what << ": " << n.found);
      CHECK(n.holds());
    }
  }
}

TEST_CASE("untangle_layers: coincident sheets come apart, held ones stay", "[long]") {
  TwoSheets two(12, 12, 0);
  const PairMesh mesh = two.mesh();
  const UntangleReport report = untangle_layers(two.cloth.particles.x, mesh, two.layers);
  CHECK(report.at_start > 0);
  CHECK(report.left == 0);
  CHECK(report.near == 0);
  CHECK(two.order().outside == two.order().compared);
  TwoSheets held(12, 12, 0);
  for (double& w : held.cloth.particles.inv_mass) w = 0;
  const std::vector<Vec3> before = held.cloth.particles.x;
  const UntangleReport none = untangle_layers(held.cloth.particles.x, held.mesh(), held.layers);
  CHECK(none.left == none.at_start);
  CHECK(none.rounds == 30);
  CHECK(held.cloth.particles.x == before);
}

TEST_CASE("untangle_layers: what does not cross does not move, and layers that are not there are refused") {
  TwoSheets two(8, 8, 0);
  for (std::size_t i = two.inner; i < two.cloth.particles.size(); ++i) two.cloth.particles.x[i].z() += 0.01;
  const std::vector<Vec3> before = two.cloth.particles.x;
  CHECK(untangle_layers(two.cloth.particles.x, two.mesh(), two.layers).rounds == 0);
  CHECK(two.cloth.particles.x == before);
  two.layers.turned.pop_back();
  CHECK_THROWS_AS(untangle_layers(two.cloth.particles.x, two.mesh(), two.layers), std::invalid_argument);
  two.layers.of_vertex.pop_back();
  CHECK_THROWS_AS(untangle_layers(two.cloth.particles.x, two.mesh(), two.layers), std::invalid_argument);
}

TEST_CASE("layer_order: vertices are compared near a layer and off its border alone") {
  TwoSheets two(8, 8, 0);
  auto& x = two.cloth.particles.x;
  for (std::size_t i = two.inner; i < x.size(); ++i) x[i].z() += i % 2 ? 0.01 : -0.01;
  const LayerOrder order = two.order();
  CHECK(order.compared == 49);
  CHECK(order.outside >= 24);
  CHECK(order.outside <= 25);
  for (std::size_t i = two.inner; i < x.size(); ++i) x[i].z() += 1;
  CHECK(two.order().compared == 0);
}
