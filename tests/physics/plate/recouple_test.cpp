// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/plate/recouple.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "physics/cloth/carried_angle.h"
#include "physics/cloth/elements.h"
#include "physics/plate/plate_bending.h"
#include "tests/cases/plates.h"
#include "tests/physics/cloth/shell_cloths.h"

using namespace furrow;
using namespace furrow::physics;
using namespace furrow::cases;
using furrow::tests::add_membrane;

namespace {

const PlateBending& plate_of_cloth(const Cloth& cloth) {
  return dynamic_cast<const PlateBending&>(*cloth.energies.at(0));
}

bool same_plate(const Cloth& a, const Cloth& b) {
  const Plate &p = plate_of_cloth(a).plate(), &q = plate_of_cloth(b).plate();
  bool same = p.share == q.share && p.stiffness == q.stiffness && p.hinge == q.hinge && p.begin == q.begin &&
              p.hinges.size() == q.hinges.size() && a.hinges.size() == b.hinges.size();
  for (std::size_t h = 0; same && h < p.hinges.size(); ++h)
    same = p.hinges[h].vertices == q.hinges[h].vertices && p.hinges[h].rest_angle == q.hinges[h].rest_angle;
  return same;
}

/// Flat hinges and a membrane; some hinges apart, and all pressed otherwise.
struct PressedSheet {
  Cloth cloth = sheet_of(SheetKind::jittered, 1, 1, 6);
  std::vector<char> apart;
  std::vector<double> press;
  PressedSheet() {
    cloth.structural.clear();
    add_membrane(cloth, 300);
    tests::add_hinges(cloth, 1e-4);
    for (std::size_t h = 0; h < cloth.hinges.size(); ++h) {
      apart.push_back(h % 7 == 3);
      press.push_back(1 + double(h % 5));
      cloth.hinges[h].rest_angle = 0.01 * double(h % 11);
    }
  }
  Cloth coupled(const std::vector<std::array<double, 3>>& lengths, std::span<const double> warp = {}) const {
    Cloth result = cloth;
    const PlateRigidity woven{2e-4, 1e-4, 4e-5, 0};
    couple_hinges(result, lengths, {warp.empty() ? isotropic_plate(1e-4) : woven, warp}, apart, press);
    return result;
  }
};

}  // namespace

TEST_CASE("recouple: nothing changed gives the same bits, other lengths the plate that they make") {
  const PressedSheet sheet;
  auto lengths = lengths_of(sheet.cloth);
  Cloth cloth = sheet.coupled(lengths);
  const Cloth before = cloth;
  REQUIRE(cloth.hinges.size() > 5);
  CHECK(recouple(cloth));
  CHECK(same_plate(cloth, before));
  for (std::size_t t = 0; t < lengths.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      cloth.membrane[t].rest_lengths[i] = lengths[t][i] *= 1 + 0.02 * std::sin(double(3 * t + i));
  CHECK(recouple(cloth));
  CHECK_FALSE(same_plate(cloth, before));
  CHECK(same_plate(cloth, sheet.coupled(lengths)));
}

TEST_CASE("recouple: springs and triangles with other first corners tell the same lengths") {
  const PressedSheet sheet;
  const auto lengths = lengths_of(sheet.cloth);
  auto longer = lengths;
  for (auto& l : longer)
    for (double& length : l) length *= 1.5;
  Cloth turned = sheet.coupled(lengths), springs = turned;
  for (MembraneTriangle& t : turned.membrane) {
    const auto [a, b, c] = t.vertices;
    const auto [l, m, n] = t.rest_lengths;
    t.vertices = {b, c, a};
    t.rest_lengths = {1.5 * m, 1.5 * n, 1.5 * l};
  }
  springs.membrane.clear();
  springs.structural = sheet_of(SheetKind::jittered, 1, 1, 6).structural;
  for (Spring& s : springs.structural) s.rest_length *= 1.5;
  for (Cloth* cloth : {&turned, &springs}) {
    CHECK(recouple(*cloth));
    CHECK(same_plate(*cloth, sheet.coupled(longer)));
  }
}

TEST_CASE("recouple: the warp stays where it lies in the cloth") {
  const std::array<double, 3> at_first{0.9, 1.1, 1.3}, stretched{1.0, 1.1, 1.2};
  // A thread from corner 0 to the middle of the opposite edge stays one.
  const auto to_middle = [](const std::array<double, 3>& l) {
    const double x = (l[2] * l[2] + l[1] * l[1] - l[0] * l[0]) / (2 * l[2]),
                 y = std::sqrt(l[1] * l[1] - x * x);
    return std::atan2(y, l[2] + x);
  };
  CHECK(carried_angle(to_middle(at_first), at_first, stretched) ==
        Approx(to_middle(stretched)).epsilon(1e-14));
  CHECK(carried_angle(0, at_first, stretched) == 0);
  CHECK(carried_angle(-2.5, at_first, at_first) == -2.5);
  const PressedSheet sheet;
  auto lengths = lengths_of(sheet.cloth);
  std::vector<double> warp(lengths.size());
  for (std::size_t t = 0; t < warp.size(); ++t) warp[t] = to_middle(lengths[t]);
  Cloth cloth = sheet.coupled(lengths, warp);
  for (std::size_t t = 0; t < lengths.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i)
      cloth.membrane[t].rest_lengths[i] = lengths[t][i] *= 1 + 0.02 * std::sin(double(3 * t + i));
    warp[t] = to_middle(lengths[t]);
  }
  CHECK(recouple(cloth));
  const Cloth wanted = sheet.coupled(lengths, warp);
  const auto &found = plate_of_cloth(cloth).plate().stiffness,
             &right = plate_of_cloth(wanted).plate().stiffness;
  REQUIRE(found.size() == right.size());
  for (std::size_t t = 0; t < found.size(); ++t)
    CHECK((found[t] - right[t]).norm() <= 1e-12 * right[t].norm());
}

TEST_CASE("recouple: a plate of a caller's own, and one whose hinges are gone, stay as they are") {
  const PressedSheet sheet;
  Cloth own = sheet.coupled(lengths_of(sheet.cloth));
  Cloth fewer = own;
  fewer.hinges.pop_back();
  CHECK_FALSE(recouple(fewer));
  own.energies[0] = std::make_shared<PlateBending>(plate_of_cloth(own).plate(), own.particles.size());
  CHECK_FALSE(recouple(own));
  Cloth none = sheet.cloth;
  CHECK_FALSE(recouple(none));
}
