// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/cloth/patch_membrane.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <numeric>

#include "physics/base/vec4.h"
#include "physics/cloth/element_blocks.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/join_cloths.h"
#include "physics/cloth/membrane.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/plates.h"
#include "tests/physics/cloth/finite_differences.h"

using namespace furrow::physics;
using namespace furrow::tests;
using namespace furrow::cases;

namespace {

/// Woven, so that axes count; the warp leads x by 0.4.
Cloth woven_sheet_of(SheetKind kind, int columns = 5) {
  Cloth cloth = sheet_of(kind, 1, 0.8, columns);
  cloth.structural.clear();
  const WovenSheet sheet = woven_sheet({1000, 500, 30, 0.2});
  const auto lengths = lengths_of(cloth);
  const std::vector<double> warp = warp_along(cloth, 0.4);
  for (std::size_t t = 0; t < cloth.triangles.size(); ++t)
    cloth.membrane.push_back({cloth.triangles[t],
                              lengths[t],
                              sheet.lame.lambda,
                              sheet.lame.mu,
                              {warp[t], sheet.warp, sheet.weft}});
  return cloth;
}

Cloth joined(Cloth cloth, const PatchOptions& options = {}) {
  join_patches(cloth, options);
  return cloth;
}

Positions crumpled(const Cloth& cloth, int seed, double size = 0.05) {
  Noise noise(seed);
  Positions x = cloth.particles.x;
  for (Vec3& p : x) p += size * noise.vector();
  return x;
}

PatchCount count(Cloth cloth, const PatchOptions& options = {}) { return join_patches(cloth, options); }

/// The lowest eigenvalues of K at rest over the largest, how many are 0 to 1e-11.
int zero_modes(const Cloth& cloth) {
  const Eigen::MatrixXd k = stiffness_matrix(cloth, cloth.particles.x, Stiffness::exact);
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
  CHECK(values[0] > -1e-12 * values.maxCoeff());
  return int((values.array() < 1e-11 * values.maxCoeff()).count());
}

}  // namespace

TEST_CASE("patches: a uniform strain has the energy and the forces of triangles") {
  for (const SheetKind kind : sheet_kinds) {
    const Cloth plain = woven_sheet_of(kind), patched = joined(plain);
    CAPTURE(name_of(kind));
    REQUIRE(patched.energies.size() == 1);
    Noise noise(17);
    for (int round = 0; round < 5; ++round) {
      Mat3 f = Mat3::Identity();
      for (int i = 0; i < 9; ++i) f(i / 3, i % 3) += 0.4 * noise();
      Positions x = plain.particles.x;
      for (Vec3& p : x) p = f * p;
      CHECK(potential_energy(patched, x) == Approx(potential_energy(plain, x)).epsilon(1e-12));
      const Eigen::VectorXd wanted = forces(plain, x);
      CHECK((forces(patched, x) - wanted).cwiseAbs().maxCoeff() < 1e-12 * wanted.cwiseAbs().maxCoeff());
    }
    const Positions x = crumpled(plain, 3);  // another strain in each triangle has less
    CHECK(potential_energy(patched, x) < 0.9 * potential_energy(plain, x));
  }
}

TEST_CASE("patches: the energy is that of the formula") {
  const Cloth plain = woven_sheet_of(SheetKind::jittered, 3);
  const Positions x = crumpled(plain, 4);
  const MembraneTriangle& law = plain.membrane[0];
  std::vector<double> area(plain.particles.size(), 0);
  std::vector<Eigen::Matrix2d> mean(area.size(), Eigen::Matrix2d::Zero());
  const auto w_of = [&](const Eigen::Matrix2d& e) {
    const Eigen::Vector2d warp(std::cos(0.4), std::sin(0.4)), weft(-warp.y(), warp.x());
    const double a = warp.dot(e * warp), b = weft.dot(e * weft), trace = e.trace();
    return 0.5 * (law.lambda * trace * trace + law.threads.warp * a * a + law.threads.weft * b * b) +
           law.mu * (e * e).trace();
  };
  double energy = 0;
  for (const auto& [a, b, c] : plain.triangles) {
    const auto edges = [a = a, b = b, c = c](const Positions& at) {
      Eigen::Matrix<double, 3, 2> m;
      m << at[b] - at[a], at[c] - at[a];
      return m;
    };
    const Eigen::Matrix2d rest = edges(plain.particles.x).topRows<2>();
    const Eigen::Matrix<double, 3, 2> f = edges(x) * rest.inverse();
    const Eigen::Matrix2d e = 0.5 * (f.transpose() * f - Eigen::Matrix2d::Identity());
    const double own = rest.determinant() / 2;
    energy += 0.3 * own * w_of(e);
    for (const int v : {a, b, c}) area[v] += own, mean[v] += own * e;
  }
  for (std::size_t v = 0; v < area.size(); ++v) energy += 0.7 * area[v] / 3 * w_of(mean[v] / area[v]);
  CHECK(potential_energy(joined(plain, {.triangle_share = 0.3}), x) == Approx(energy).epsilon(1e-12));
}

TEST_CASE("patches: derivatives agree with finite differences, the positive part is one") {
  for (const SheetKind kind : {SheetKind::one_diagonal, SheetKind::jittered, SheetKind::lined}) {
    Cloth cloth = woven_sheet_of(kind, 4);
    for (const int i : {0, 1, 5}) cloth.particles.inv_mass[i] = 0;
    join_patches(cloth);
    const Positions x = crumpled(cloth, 3);
    const DerivativeErrors errors = derivative_errors(cloth, x, 1e-4);
    CAPTURE(name_of(kind), errors.force, errors.stiffness, errors.symmetry);
    CHECK(errors.force < 1e-9);
    CHECK(errors.stiffness < 1e-8);
    CHECK(errors.symmetry < 1e-14);
    const Eigen::MatrixXd part = stiffness_matrix(cloth, x, Stiffness::positive_part),
                          exact = stiffness_matrix(cloth, x, Stiffness::exact),
                          half = stiffness_matrix(cloth, x, Stiffness{0.5});
    CHECK(least_eigenvalue(exact) < -1e-4 * part.norm());
    CHECK(least_eigenvalue(part) > -1e-12 * part.norm());
    CHECK(least_eigenvalue(part - exact) > -1e-12 * part.norm());
    CHECK((half - 0.5 * (part + exact)).norm() < 1e-13 * part.norm());
    Stiffness narrow = Stiffness::exact;
    narrow.narrow = true;
    CHECK(stiffness_matrix(cloth, x, narrow) == exact);
    CHECK(block_pairs(cloth, Stiffness::exact) == block_pairs(cloth, narrow));
  }
}

TEST_CASE("patches: no total force or moment, and rigid motions change nothing") {
  const Cloth cloth = joined(woven_sheet_of(SheetKind::blue_noise));
  const Positions x = crumpled(cloth, 5);
  const Eigen::VectorXd force = forces(cloth, x);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 f = force.segment<3>(Eigen::Index(3 * i));
    sum += f, moment += x[i].cross(f);
  }
  CHECK(sum.norm() < 1e-12 * force.norm());
  CHECK(moment.norm() < 1e-12 * force.norm());
  const Mat3 turn = Eigen::AngleAxisd(1.2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  Positions turned = x;
  for (Vec3& p : turned) p = turn * p + Vec3(3, -1, 2);
  CHECK(potential_energy(cloth, turned) == Approx(potential_energy(cloth, x)).epsilon(1e-12));
  CHECK(potential_energy(cloth, cloth.particles.x) < 1e-25);
}

TEST_CASE(
    "patches: a free flat sheet with a plate has six zero modes, without one all that leave the plane") {
  for (const SheetKind kind : {SheetKind::one_diagonal, SheetKind::union_jack, SheetKind::equilateral,
                               SheetKind::jittered, SheetKind::blue_noise}) {
    Cloth cloth = joined(woven_sheet_of(kind, 6));
    add_plate(cloth, isotropic_plate(1));
    CAPTURE(name_of(kind));
    CHECK(zero_modes(cloth) == 6);
  }
  Cloth limp = joined(woven_sheet_of(SheetKind::jittered, 6));
  CHECK(zero_modes(limp) == 3 + int(limp.particles.size()));
}

TEST_CASE("patches: triangles that start at another corner, and packed callers, get the same") {
  const Cloth plain = woven_sheet_of(SheetKind::jittered);
  Cloth turned = plain;
  for (std::size_t t = 0; t < turned.membrane.size(); t += 2) {
    MembraneTriangle& own = turned.membrane[t];
    const auto& x = plain.particles.x;
    std::rotate(own.vertices.begin(), own.vertices.begin() + 1, own.vertices.end());
    std::rotate(own.rest_lengths.begin(), own.rest_lengths.begin() + 1, own.rest_lengths.end());
    const Vec3 first = x[own.vertices[1]] - x[own.vertices[0]];
    own.threads.angle = 0.4 - std::atan2(first.y(), first.x());
  }
  const Cloth one = joined(plain), other = joined(turned);
  const Positions x = crumpled(plain, 6);
  CHECK(potential_energy(other, x) == Approx(potential_energy(one, x)).epsilon(1e-12));
  CHECK((forces(other, x) - forces(one, x)).norm() < 1e-12 * forces(one, x).norm());

  std::vector<int> place(x.size());
  std::iota(place.rbegin(), place.rend(), 0);
  std::vector<Vec4> at(x.size()), force(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) at[place[i]] = {x[i].x(), x[i].y(), x[i].z(), 0};
  const auto packed = one.energies[0]->packed(place);
  Positions wanted(x.size(), Vec3::Zero());
  const double energy = one.energies[0]->add_energy_and_forces(x, wanted);
  CHECK(packed->add_forces(at.data(), force.data()) == energy);
  CHECK(packed->add_forces(at.data(), nullptr) == energy);
  CHECK(one.energies[0]->energy(x) == energy);
  for (std::size_t i = 0; i < x.size(); ++i) CHECK(xyz(force[place[i]]) == wanted[i]);
}

TEST_CASE("patches: a curved rest is at rest, swells as triangles do, and is plain where it is too curved") {
  Cloth dome = sheet_of(SheetKind::blue_noise, 1, 1, 8);
  dome.structural.clear();
  for (Vec3& x : dome.particles.x)
    x.z() = -0.5 * ((x.x() - 0.5) * (x.x() - 0.5) + (x.y() - 0.5) * (x.y() - 0.5));
  add_flat_membrane(dome, 300);
  Cloth patched = dome;
  CHECK(join_patches(patched).plain == 0);
  CHECK(potential_energy(patched, dome.particles.x) < 1e-25);
  Positions x = dome.particles.x;
  for (Vec3& p : x) p *= 1.1;
  CHECK(potential_energy(patched, x) == Approx(potential_energy(dome, x)).epsilon(1e-12));
  const DerivativeErrors errors = derivative_errors(patched, crumpled(dome, 2, 0.02), 1e-4);
  CHECK(errors.force < 1e-9);
  CHECK(errors.stiffness < 1e-8);
  const std::vector<int> ring = rings_from_border(dome);
  const int inside = int(std::ranges::count_if(ring, [](int r) { return r > 0; }));
  CHECK(count(dome, {.most_defect = 1e-6}).plain == inside);  // borders have no defect
}

TEST_CASE("patches: what stays plain keeps the energy of its triangles") {
  const Cloth flat = woven_sheet_of(SheetKind::equilateral, 6);
  const int all = int(flat.particles.size());
  CHECK(count(flat).patches == all);
  const std::vector<int> ring = rings_from_border(flat);
  const int middle = int(std::ranges::find(ring, 2) - ring.begin());

  Cloth finned = flat;  // a third face at an edge within
  const auto& beside = *std::ranges::find_if(
      flat.membrane, [&](const MembraneTriangle& t) { return t.vertices[0] == middle; });
  finned.membrane.push_back(beside);
  finned.membrane.back().vertices[2] = all;
  add_particle(finned, {0, 0, 1}, 1);
  CHECK(count(finned).plain == 2);
  CHECK(count(finned).patches == all - 1);

  Cloth torn = flat;
  torn.membrane[10].rest_lengths[0] *= 1.001;
  CHECK(count(torn).plain == 4);
  Cloth stiffer = flat;
  stiffer.membrane[10].lambda *= 3, stiffer.membrane[10].mu *= 3;
  CHECK(count(stiffer).plain == 3);

  Cloth mixed = joined(torn);
  const MembraneTriangle &before = flat.membrane[10], &after = mixed.membrane[10];
  CHECK(after.mu == before.mu);
  CHECK(after.threads.warp == before.threads.warp);
  const DerivativeErrors errors = derivative_errors(mixed, crumpled(mixed, 8), 1e-4);
  CHECK(errors.force < 1e-9);
  CHECK(errors.stiffness < 1e-8);
}

TEST_CASE("patches: held triangles take no part, bow ties and slivers stay plain") {
  Cloth clamped = woven_sheet_of(SheetKind::one_diagonal);
  for (std::size_t i = 0; i < clamped.particles.size(); ++i)
    if (clamped.particles.x[i].x() < 0.5) clamped.particles.inv_mass[i] = 0;
  const Cloth patched = joined(clamped);
  for (std::size_t t = 0; t < clamped.membrane.size(); ++t) {
    const bool held = std::ranges::all_of(clamped.membrane[t].vertices,
                                          [&](int v) { return clamped.particles.inv_mass[v] == 0; });
    CHECK(patched.membrane[t].mu == Approx(held ? clamped.membrane[t].mu : 0.05 * clamped.membrane[t].mu));
  }
  Positions x = clamped.particles.x;  // what is not held, stretched: as triangles, up to the clamp
  for (Vec3& p : x) p.x() += 0.1 * std::max(0.0, p.x() - 0.4);
  CHECK(potential_energy(patched, x) == Approx(potential_energy(clamped, x)).epsilon(1e-12));

  Cloth tie;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)})
    add_particle(tie, p, 1);
  tie.triangles = {{0, 1, 2}, {0, 3, 4}};
  add_flat_membrane(tie, 100);
  CHECK(count(tie).plain == 1);
  CHECK(count(tie).patches == 4);
  tie.membrane[1].rest_lengths = {2 - 1e-9, 1, 1};
  CHECK(count(tie).patches == 2);
}

TEST_CASE("patches: joined cloths have the forces of each, a softened one a share of them") {
  std::array<Cloth, 2> two{woven_sheet_of(SheetKind::jittered), woven_sheet_of(SheetKind::one_diagonal)};
  for (Cloth& cloth : two) {
    join_patches(cloth);
    cloth.particles.x = crumpled(cloth, 9);
  }
  const Cloth all = join_cloths(two);
  REQUIRE(all.energies.size() == 2);
  const Eigen::VectorXd force = forces(all, all.particles.x);
  const Eigen::Index first = Eigen::Index(3 * two[0].particles.size());
  CHECK(force.head(first) == forces(two[0], two[0].particles.x));
  CHECK(force.tail(force.size() - first) == forces(two[1], two[1].particles.x));
  const Eigen::MatrixXd k = stiffness_matrix(all, all.particles.x, Stiffness::exact);
  CHECK(k.topRightCorner(first, k.cols() - first).isZero(0));
  CHECK(k.topLeftCorner(first, first) == stiffness_matrix(two[0], two[0].particles.x, Stiffness::exact));

  Cloth soft = two[0];
  soften_membrane(soft, 4);
  const double energy = potential_energy(two[0], soft.particles.x);
  CHECK(potential_energy(soft, soft.particles.x) == Approx(energy / 4).epsilon(1e-14));
  CHECK(potential_energy(two[0], soft.particles.x) == energy);  // copies share no patches that change
  CHECK_THROWS_AS(soften_membrane(soft, 0), std::invalid_argument);
}

TEST_CASE("patches: bad options and arrays are refused, nothing changed") {
  Cloth cloth = woven_sheet_of(SheetKind::equilateral);
  const double mu = cloth.membrane[0].mu;
  CHECK_THROWS_WITH(join_patches(cloth, {.triangle_share = 0}), Catch::Contains("triangle_share = 0.0"));
  CHECK_THROWS_AS(join_patches(cloth, {.triangle_share = 1.1}), std::invalid_argument);
  CHECK_THROWS_AS(join_patches(cloth, {.most_defect = -1}), std::invalid_argument);
  cloth.membrane.back().vertices[0] = 1000;
  CHECK_THROWS_AS(join_patches(cloth), std::invalid_argument);
  CHECK(cloth.membrane[0].mu == mu);
  CHECK(cloth.energies.empty());
  Cloth none;
  CHECK(join_patches(none).patches == 0);
  CHECK(none.energies.empty());
  Patches apart;
  apart.edges.push_back({0, 5, 1});
  CHECK_THROWS_AS(PatchMembrane(apart, 3), std::invalid_argument);
}
