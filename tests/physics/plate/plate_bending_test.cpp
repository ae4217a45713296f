// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/plate/plate_bending.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <numeric>

#include "physics/cloth/element_blocks.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/packed_energy.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/plates.h"
#include "tests/physics/cloth/finite_differences.h"
#include "tests/physics/cloth/shell_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;
using namespace furrow::cases;

namespace {

/// A sheet with hinges of random rest angles as a plate, some of it pinned, crumpled.
Cloth crumpled_plate(SheetKind kind, int seed, bool pinned = true, double size = 0.06) {
  Cloth cloth = sheet_of(kind, 1, 1, 4);
  cloth.structural.clear();
  add_flat_hinges(cloth, 1);
  Noise noise(seed);
  for (Hinge& h : cloth.hinges) h.rest_angle = 0.6 * noise();
  if (pinned)
    for (const int i : {0, 1, 5, 6}) cloth.particles.inv_mass[i] = 0;
  couple_hinges(cloth, lengths_of(cloth), {PlateRigidity{2, 1, 0.3, 0.2}, warp_along(cloth, 0.3)});
  for (Vec3& x : cloth.particles.x) x += size * noise.vector();
  return cloth;
}

const PlateBending& plate_in(const Cloth& cloth) {
  return dynamic_cast<const PlateBending&>(*cloth.energies.at(0));
}

}  // namespace

TEST_CASE("plate_bending: derivatives agree with finite differences at random configurations") {
  for (const SheetKind kind : {SheetKind::one_diagonal, SheetKind::jittered, SheetKind::lined}) {
    const Cloth cloth = crumpled_plate(kind, 3);
    REQUIRE(cloth.energies.size() == 1);
    const DerivativeErrors errors = derivative_errors(cloth, cloth.particles.x, 1e-5);
    CAPTURE(name_of(kind), errors.force, errors.stiffness, errors.symmetry);
    CHECK(errors.force < 1e-7);
    CHECK(errors.stiffness < 1e-7);
    CHECK(errors.symmetry < 1e-13);
    const Eigen::MatrixXd part = stiffness_matrix(cloth, cloth.particles.x, Stiffness::positive_part);
    CHECK(least_eigenvalue(part) > -1e-12 * part.norm());
  }
}

TEST_CASE("plate_bending: no total force or moment, and rigid motions change nothing") {
  const Cloth cloth = crumpled_plate(SheetKind::blue_noise, 5);
  const Positions& x = cloth.particles.x;
  const Eigen::VectorXd force = forces(cloth, x);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += force.segment<3>(Eigen::Index(3 * i));
    moment += x[i].cross(Vec3(force.segment<3>(Eigen::Index(3 * i))));
  }
  CHECK(sum.norm() < 1e-12 * force.norm());
  CHECK(moment.norm() < 1e-12 * force.norm());
  const Eigen::AngleAxisd turn(2.1, Vec3(1, -2, 1).normalized());
  Positions turned = x;
  for (Vec3& p : turned) p = turn * p + Vec3(1, 1, -2);
  CHECK(potential_energy(cloth, turned) == Approx(potential_energy(cloth, x)).epsilon(1e-11));
}

TEST_CASE("plate_bending: a cloth at rest angles of its own is at rest") {
  Cloth cloth = sheet_of(SheetKind::cut_jittered, 1, 1, 6);
  cloth.structural.clear();
  const auto lengths = lengths_of(cloth);
  Noise noise(2);
  for (Vec3& x : cloth.particles.x) x.z() += 0.05 * noise();
  add_hinges(cloth, 1);  // as it lies
  const Eigen::VectorXd before = forces(cloth, cloth.particles.x);
  couple_hinges(cloth, lengths, {isotropic_plate(1)});
  CHECK(cloth.hinges.empty());
  CHECK(forces(cloth, cloth.particles.x).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(potential_energy(cloth, cloth.particles.x) < 1e-24);
  CHECK(before.norm() < 1e-11);
  for (const double m : plate_in(cloth).moments(cloth.particles.x)) CHECK(std::abs(m) < 1e-13);
}

TEST_CASE("plate_bending: moments are the energy's derivatives by the angles") {
  const Cloth cloth = crumpled_plate(SheetKind::jittered, 4, false);
  const PlateBending& bending = plate_in(cloth);
  const std::vector<double> moments = bending.moments(cloth.particles.x);
  for (const std::size_t h : {std::size_t(0), moments.size() / 2, moments.size() - 1}) {
    const auto at = [&](double by) {
      Plate plate = bending.plate();
      plate.hinges[h].rest_angle -= by;
      return PlateBending(plate, cloth.particles.size()).energy(cloth.particles.x);
    };
    CHECK(moments[h] == Approx((at(1e-5) - at(-1e-5)) / 2e-5).epsilon(1e-7));
  }
}

TEST_CASE("plate_bending: coupling leaves plain hinges and changes nothing where there are none") {
  Cloth cloth = sheet_of(SheetKind::one_diagonal, 1, 1, 3);
  add_flat_hinges(cloth, 1);
  const std::size_t hinges = cloth.hinges.size();
  std::vector<char> apart(hinges, 0);
  apart[3] = 1;
  const Hinge kept = cloth.hinges[3];
  const CoupledHinges made = couple_hinges(cloth, lengths_of(cloth), {isotropic_plate(1)}, apart);
  CHECK(made.coupled == int(hinges) - 1);
  CHECK(made.plain == 1);
  REQUIRE(cloth.hinges.size() == 1);
  CHECK(cloth.hinges[0].vertices == kept.vertices);
  CHECK(cloth.hinges[0].stiffness == kept.stiffness);
  const CoupledHinges again =
      couple_hinges(cloth, lengths_of(cloth), {isotropic_plate(1)}, std::vector<char>{1});
  CHECK(again.coupled == 0);
  CHECK(cloth.energies.size() == 1);
  cloth.hinge_law = HingeLaw::cosine;
  CHECK_THROWS_WITH(couple_hinges(cloth, lengths_of(cloth), {isotropic_plate(1)}), Catch::Contains("linear"));
  CHECK_THROWS_AS(PlateBending(plate_in(cloth).plate(), 3), std::invalid_argument);
}

TEST_CASE("plate_bending: other orders of triangles and hinges give the same energy and forces") {
  Cloth cloth = sheet_of(SheetKind::jittered, 1, 1, 5);
  add_flat_hinges(cloth, 1);
  Cloth other = cloth;
  std::reverse(other.triangles.begin(), other.triangles.end());
  for (auto& t : other.triangles) std::rotate(t.begin(), t.begin() + 1, t.end());
  std::reverse(other.hinges.begin(), other.hinges.end());
  for (std::size_t h = 0; h < other.hinges.size(); h += 2) {
    auto& v = other.hinges[h].vertices;
    std::swap(v[0], v[1]), std::swap(v[2], v[3]);
  }
  for (Cloth* c : {&cloth, &other}) couple_hinges(*c, lengths_of(*c), {isotropic_plate(1, 0.2)});
  Noise noise(8);
  Positions x = cloth.particles.x;
  for (Vec3& p : x) p += 0.05 * noise.vector();
  CHECK(potential_energy(other, x) == Approx(potential_energy(cloth, x)).epsilon(1e-12));
  CHECK((forces(other, x) - forces(cloth, x)).norm() < 1e-11 * forces(cloth, x).norm());
}

TEST_CASE("plate_bending: a plate made like another is the same as one made anew") {
  Cloth cloth = crumpled_plate(SheetKind::jittered, 8), anew = cloth;
  const PlateBending& own = plate_in(cloth);
  Plate pressed = own.plate();
  for (auto& share : pressed.share) share *= 3;
  pressed.hinges[2].rest_angle += 0.1;
  anew.energies = {std::make_shared<PlateBending>(pressed, cloth.particles.size())};
  const auto like = std::make_shared<PlateBending>(pressed, own, nullptr);
  cloth.energies = {like};
  const Positions& x = cloth.particles.x;
  CHECK(potential_energy(cloth, x) == potential_energy(anew, x));
  CHECK(forces(cloth, x) == forces(anew, x));
  for (const Stiffness part : {Stiffness::exact, Stiffness{1, true}})
    CHECK(stiffness_matrix(cloth, x, part) == stiffness_matrix(anew, x, part));

  Plate other = pressed;
  std::swap(other.hinges[0], other.hinges[1]);
  CHECK_THROWS_WITH(PlateBending(other, *like, nullptr), Catch::Contains("not those of the other"));
}

TEST_CASE("plate_bending: its narrow stiffness couples what hinges couple, and is near the true one") {
  for (const SheetKind kind : sheet_kinds) {
    Cloth cloth = sheet_of(kind, 1, 1, 5);
    cloth.structural.clear();
    add_flat_hinges(cloth, 1);
    const auto hinges = block_pairs(cloth);
    couple_hinges(cloth, lengths_of(cloth), {isotropic_plate(1)});
    const auto narrow = block_pairs(cloth, {0, true}), wide = block_pairs(cloth);
    const auto distinct = [](std::vector<std::array<int, 2>> pairs) {
      for (auto& [i, j] : pairs)
        if (i < j) std::swap(i, j);
      std::sort(pairs.begin(), pairs.end());
      pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
      return pairs;
    };
    CHECK(distinct(narrow) == distinct(hinges));
    CHECK(distinct(wide).size() > distinct(narrow).size());
    const Positions& x = cloth.particles.x;
    Noise noise(6);
    const Eigen::MatrixXd near = stiffness_matrix(cloth, x, {1, true}),
                          exact = stiffness_matrix(cloth, x, Stiffness::positive_part);
    double least = 1e9, most = 0;
    for (int i = 0; i < 200; ++i) {
      Eigen::VectorXd u(near.rows());
      for (Eigen::Index k = 0; k < u.size(); ++k) u[k] = noise();
      const double ratio = u.dot(exact * u) / u.dot(near * u);
      least = std::min(least, ratio), most = std::max(most, ratio);
    }
    CAPTURE(name_of(kind), least, most);
    CHECK(least > 0.1);
    CHECK(most < 3);
  }
}

TEST_CASE("plate_bending: in vectors of four, at other places, its energy and forces are the same") {
  const Cloth cloth = crumpled_plate(SheetKind::blue_noise, 7);
  const Positions& x = cloth.particles.x;
  std::vector<int> place(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) place[i] = int(i * 7 % x.size());
  REQUIRE(x.size() % 7 != 0);
  const auto packed = plate_in(cloth).packed(place);
  REQUIRE(packed);
  std::vector<Vec4> at(x.size()), force(x.size(), Vec4{0, 0, 1, 0});
  for (std::size_t i = 0; i < x.size(); ++i) at[std::size_t(place[i])] = {x[i].x(), x[i].y(), x[i].z(), 0};
  const double energy = packed->add_forces(at.data(), force.data());
  CHECK(energy == Approx(plate_in(cloth).energy(x)).epsilon(1e-12));
  CHECK(packed->add_forces(at.data(), nullptr) == energy);
  Positions one(x.size(), Vec3::Zero());
  CHECK(plate_in(cloth).add_energy_and_forces(x, one) == plate_in(cloth).energy(x));
  double size = 0;
  for (const Vec3& f : one) size = std::max(size, f.norm());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec4& f = force[std::size_t(place[i])];
    CHECK((Vec3(f.x, f.y, f.z - 1) - one[i]).norm() < 1e-12 * size);
    CHECK(f.w == 0);
  }
}
