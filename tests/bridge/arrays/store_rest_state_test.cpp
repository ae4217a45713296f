// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/arrays/store_rest_state.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "bridge/arrays/couple_bending.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/press_map.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/masses.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/rest/stiffness.h"
#include "physics/plate/plate_bending.h"
#include "physics/plate/press.h"
#include "physics/plate/recouple.h"
#include "tests/test_meshes.h"

using namespace furrow;
using bridge::Bending;
using bridge::GatherOptions;
using bridge::Membrane;
using geometry::Edge;
using geometry::Mesh;
using geometry::Vertex;

namespace {

Mesh wavy_sheet() {
  Mesh mesh = tests::jittered(5, 4, 0.2, 3);
  tests::lift(mesh, [](double x, double y) { return 0.1 * std::sin(5 * x) * y; });
  geometry::ensure_rest_lengths(mesh);
  geometry::rebuild_bending_springs(mesh);
  geometry::ensure_rest_angles(mesh);
  geometry::lump_masses(mesh, 0.15);
  return mesh;
}

GatherOptions options_for(const Mesh& mesh, Membrane membrane, Bending bending) {
  GatherOptions o;
  o.mean_structural_length = geometry::mean_rest_length(mesh);
  o.mean_bending_length = geometry::mean_bending_rest_length(mesh);
  o.membrane = membrane;
  o.bending = bending;
  return o;
}

bool same(const std::vector<physics::Spring>& a, const std::vector<physics::Spring>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& s, const auto& t) {
    return s.a == t.a && s.b == t.b && s.rest_length == t.rest_length && s.stiffness == t.stiffness;
  });
}

/// All elements, to the last bit.
bool same(const physics::Cloth& a, const physics::Cloth& b) {
  const auto triangle = [](const auto& s, const auto& t) {
    return s.vertices == t.vertices && s.rest_lengths == t.rest_lengths && s.lambda == t.lambda &&
           s.mu == t.mu;
  };
  const auto hinge = [](const auto& s, const auto& t) {
    return s.vertices == t.vertices && s.rest_angle == t.rest_angle && s.stiffness == t.stiffness;
  };
  const auto tension = [](const auto& s, const auto& t) {
    return s.a == t.a && s.b == t.b && s.rest_length == t.rest_length && s.stretch == t.stretch &&
           s.compress == t.compress;
  };
  return same(a.structural, b.structural) &&
         std::equal(a.tension.begin(), a.tension.end(), b.tension.begin(), b.tension.end(), tension) &&
         same(a.bending, b.bending) &&
         std::equal(a.membrane.begin(), a.membrane.end(), b.membrane.begin(), b.membrane.end(), triangle) &&
         std::equal(a.hinges.begin(), a.hinges.end(), b.hinges.begin(), b.hinges.end(), hinge);
}

/// Another value for every element, as a solver for prestress would give.
void change(physics::Cloth& cloth) {
  int i = 0;
  const auto factor = [&] { return 1 + 0.01 * std::sin(++i); };
  for (auto* springs : {&cloth.structural, &cloth.bending})
    for (physics::Spring& s : *springs) s.rest_length *= factor(), s.stiffness *= factor();
  for (physics::MembraneTriangle& t : cloth.membrane)
    for (double& l : t.rest_lengths) l *= factor();
  for (physics::Tension& t : cloth.tension) {
    t.rest_length *= factor(), t.stretch *= factor();
    t.compress = GatherOptions{}.compression * t.stretch;
  }
  for (physics::Hinge& h : cloth.hinges) h.rest_angle += 0.1 * std::sin(++i), h.stiffness *= 10 * factor();
}

}  // namespace

TEST_CASE("store_rest_state: what is stored is gathered again with the same bits, under every law") {
  for (const Membrane membrane : {Membrane::paper, Membrane::uniform, Membrane::inverse, Membrane::van_gelder,
                                  Membrane::triangles, Membrane::tension})
    for (const Bending bending : {Bending::cross, Bending::hinge, Bending::cosine}) {
      CAPTURE(int(membrane), int(bending));
      Mesh mesh = wavy_sheet();
      const GatherOptions o = options_for(mesh, membrane, bending);
      physics::Cloth cloth = bridge::gather(mesh, o);
      bridge::store_rest_state(cloth, o, mesh);
      CHECK(same(bridge::gather(mesh, o), cloth));
      change(cloth);
      CHECK_FALSE(same(bridge::gather(mesh, o), cloth));
      bridge::store_rest_state(cloth, o, mesh);
      CHECK(same(bridge::gather(mesh, o), cloth));
      // What is stored goes before the material.
      GatherOptions stiffer = o;
      stiffer.structural_stiffness *= 3, stiffer.bending_stiffness *= 3, stiffer.rigidity *= 3;
      stiffer.tension *= 3;
      CHECK(same(bridge::gather(mesh, stiffer), cloth));
    }
}

TEST_CASE("store_rest_state: presses of a plate are stored where they are not those of the lines") {
  Mesh mesh = wavy_sheet();
  const GatherOptions o = options_for(mesh, Membrane::triangles, Bending::plate);
  const auto gathered = [&] {
    physics::Cloth cloth = bridge::gather(mesh, o);
    bridge::couple_bending(mesh, o, cloth);
    return cloth;
  };
  const auto share = [](const physics::Cloth& cloth) {
    return dynamic_cast<const physics::PlateBending&>(*cloth.energies.at(0)).plate().share;
  };
  physics::Cloth cloth = gathered();
  bridge::store_rest_state(cloth, o, mesh);
  CHECK_FALSE(geometry::find_map(mesh, geometry::attribute::press));
  CHECK(share(gathered()) == share(cloth));
  CHECK(physics::press(cloth, std::vector<int>{7, 8, 13, 14, 19}, 10) > 3);
  CHECK(physics::recouple(cloth));
  bridge::store_rest_state(cloth, o, mesh);
  REQUIRE(geometry::find_map(mesh, geometry::attribute::press));
  CHECK(share(gathered()) == share(cloth));
  // A press of the file counts for plain hinges, too, and goes before that of lines.
  GatherOptions plain = o;
  plain.bending = Bending::hinge;
  const physics::Cloth pressed = bridge::gather(mesh, plain);
  auto stored = *geometry::find_map(mesh, geometry::attribute::press);
  mesh.remove_property_map(stored);
  const physics::Cloth bare = bridge::gather(mesh, plain);
  int stiffer = 0;
  for (std::size_t h = 0; h < bare.hinges.size(); ++h)
    stiffer += pressed.hinges[h].stiffness == Approx(10 * bare.hinges[h].stiffness).epsilon(1e-12);
  CHECK(stiffer > 3);
  CHECK(stiffer < int(bare.hinges.size()));
}

TEST_CASE(
    "store_rest_state: bending springs that the mesh lacks are stored as struts, also beside a cross "
    "spring") {
  for (const Bending bending : {Bending::cross, Bending::hinge}) {
    Mesh mesh = wavy_sheet();
    const GatherOptions o = options_for(mesh, Membrane::triangles, bending);
    physics::Cloth cloth = bridge::gather(mesh, o);
    const std::vector<physics::Spring> own = cloth.bending;
    const geometry::BendingSpring pair = geometry::bending_springs(mesh)[3];
    cloth.bending.push_back({int(pair.a), int(pair.b), 0.3, 7});
    cloth.bending.push_back({0, 29, 0.5, 3});
    cloth.bending.push_back({0, 17, 0.4, 3});
    bridge::store_rest_state(cloth, o, mesh);
    CHECK(geometry::struts(mesh).size() == 3);
    const physics::Cloth again = bridge::gather(mesh, o);
    REQUIRE(again.bending.size() == own.size() + 3);
    const auto before = [](const physics::Spring& s, const physics::Spring& t) {
      return std::pair(s.a, s.b) < std::pair(t.a, t.b);
    };
    CHECK(std::is_sorted(again.bending.begin(), again.bending.end(), before));
    for (const int b : {17, 29})
      CHECK(std::count_if(again.bending.begin(), again.bending.end(),
                          [&](const auto& s) { return s.a == 0 && s.b == b && s.stiffness == 3; }) == 1);
    bridge::store_rest_state(again, o, mesh);
    CHECK(same(bridge::gather(mesh, o), again));
    CHECK(geometry::struts(mesh).size() == 3);
    physics::Cloth without = again;
    without.bending = own;
    bridge::store_rest_state(without, o, mesh);
    CHECK(geometry::struts(mesh).empty());
    CHECK(same(bridge::gather(mesh, o).bending, own));
  }
}

TEST_CASE("store_rest_state: a triangle of its own lengths changes no other triangle, and no metric") {
  Mesh mesh = wavy_sheet();
  const GatherOptions o = options_for(mesh, Membrane::triangles, Bending::hinge);
  physics::Cloth cloth = bridge::gather(mesh, o);
  const Mesh before = mesh;
  for (double& l : cloth.membrane[7].rest_lengths) l *= 0.99;
  bridge::store_rest_state(cloth, o, mesh);
  const auto rest = *geometry::find_map(mesh, geometry::attribute::rest_length),
             was = *geometry::find_map(before, geometry::attribute::rest_length);
  for (Edge e : mesh.edges()) CHECK(rest[e] == was[e]);
  CHECK(same(bridge::gather(mesh, o), cloth));
}

TEST_CASE(
    "store_rest_state: a cloth of another mesh, or with values out of range, is refused and nothing is "
    "stored") {
  const auto refused = [](Membrane membrane, Bending bending, const char* word,
                          const std::function<void(physics::Cloth&)>& spoil) {
    Mesh mesh = wavy_sheet();
    const GatherOptions o = options_for(mesh, membrane, bending);
    const physics::Cloth good = bridge::gather(mesh, o);
    physics::Cloth bad = good;
    change(bad);
    spoil(bad);
    CHECK_THROWS_WITH(bridge::store_rest_state(bad, o, mesh), Catch::Contains(word));
    CHECK(same(bridge::gather(mesh, o), good));
  };
  const auto springs = [&](const char* word, const std::function<void(physics::Cloth&)>& spoil) {
    refused(Membrane::paper, Bending::cross, word, spoil);
  };
  const auto shell = [&](const char* word, const std::function<void(physics::Cloth&)>& spoil) {
    refused(Membrane::triangles, Bending::hinge, word, spoil);
  };
  springs("structural", [](auto& c) { c.structural.pop_back(); });
  springs("other vertices", [](auto& c) { std::swap(c.structural[0], c.structural[1]); });
  springs("rest length", [](auto& c) { c.structural[2].rest_length = 0; });
  springs("stiffness", [](auto& c) { c.structural[2].stiffness = NAN; });
  springs("missing", [](auto& c) { c.bending.pop_back(); });
  springs("joins no two", [](auto& c) { c.bending.push_back({3, 400, 1, 1}); });
  shell("membrane", [](auto& c) { c.membrane.pop_back(); });
  shell("Lame", [](auto& c) { c.membrane[1].mu *= 2; });
  shell("no area", [](auto& c) { c.membrane[1].rest_lengths[0] = 9; });
  shell("rest angle", [](auto& c) { c.hinges[1].rest_angle = 4; });
  shell("stiffness", [](auto& c) { c.hinges[1].stiffness = -1; });
  shell("hinge", [](auto& c) { c.hinges.clear(); });
}

TEST_CASE("store_rest_state: gather refuses a stiffness that makes no sense") {
  for (const double bad : {-1.0, HUGE_VAL}) {
    Mesh mesh = wavy_sheet();
    ensure_map(mesh, geometry::attribute::hinge_stiffness)[Edge(20)] = bad;
    CHECK_NOTHROW(bridge::gather(mesh, options_for(mesh, Membrane::paper, Bending::cross)));
    CHECK_THROWS_AS(bridge::gather(mesh, options_for(mesh, Membrane::paper, Bending::hinge)),
                    geometry::ContentError);
  }
}
