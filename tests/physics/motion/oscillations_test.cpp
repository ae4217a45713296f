// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/oscillations.h"

#include <catch2/catch.hpp>

#include "tests/cases/flat_meshes.h"
#include "tests/cases/modes.h"

using namespace furrow::physics;
using namespace furrow::cases;

namespace {

constexpr double two_pi = 6.28318530717958647692;

double error(double computed, double exact) { return computed / exact - 1; }

}  // namespace

TEST_CASE("oscillations: frequencies of a chain between walls", "[release]") {
  const std::vector<double> f = computed_frequencies(walled_chain(20, 0.01, 100), 0, 20),
                            exact = walled_chain_frequencies(20, 0.01, 100);
  CHECK(exact[0] == Approx(2.3787327584).epsilon(1e-10));
  CHECK(exact[19] == Approx(31.7419827183).epsilon(1e-10));
  for (int j = 0; j < 20; ++j) CHECK(std::abs(error(f[j], exact[j])) < 1e-10);
}

TEST_CASE("oscillations: frequencies of a hanging chain at its exact static state", "[release]") {
  // An independent program's zeros of Laguerre polynomials.
  const std::array<double, 3> coarse{1.13243059537, 2.63455356434, 4.24698612757},
      fine{1.19413233325, 2.74120146486, 4.29781094467};
  for (const int links : {4, 64}) {
    const std::vector<double> f = computed_frequencies(furrow::cases::hanging_chain(links, 0.25), 0, 3),
                              exact = hanging_chain_frequencies(links, 0.25, 3);
    for (int j = 0; j < 3; ++j) {
      CHECK(exact[j] == Approx((links == 4 ? coarse : fine)[j]).epsilon(1e-10));
      CHECK(std::abs(error(f[j], exact[j])) < 1e-9);
    }
  }
  // Newton finds the same state from another one.
  Cloth chain = furrow::cases::hanging_chain(16, 0.5);
  const std::vector<Vec3> rest = chain.particles.x;
  for (std::size_t i = 1; i < rest.size(); ++i) chain.particles.x[i] += Vec3(0.002 * i, 0.001 * i, 0);
  find_rest(chain, Unknowns(chain, {true, true, true}), {0, -9.81, 0}, 1e-12);
  for (std::size_t i = 0; i < rest.size(); ++i) CHECK((chain.particles.x[i] - rest[i]).norm() < 1e-9);
}

TEST_CASE(
    "oscillations: leapfrog's frequency is 2 asin(z/2) / z of the true one and its energy stays in its "
    "band",
    "[release]") {
  for (const double z : {0.01, 0.05, 0.1, 0.2, 0.5, 1.0, 1.5, 1.9}) {
    const LeapfrogRun run = run_oscillator(z, 20000);
    CAPTURE(z);
    CHECK(std::abs(error(run.frequency_ratio, 2 * std::asin(z / 2) / z)) < 1e-9);
    CHECK(run.energy_most < 1 + 1e-9);
    CHECK(run.energy_least > 1 - z * z / 4 - 1e-9);
  }
}

TEST_CASE("oscillations: the step limit located by running is 2 / omega_max within a thousandth",
          "[release]") {
  Cloth oscillator = walled_chain(1, 0.1, 20);
  CHECK(located_limit(oscillator, std::sqrt(2 * 20 / 0.1), 20000, {true, false, false}) ==
        Approx(1).margin(1e-3));
  const double omega = two_pi * walled_chain_frequencies(20, 0.01, 100).back();
  CHECK(2 / omega == Approx(0.0100280404349).epsilon(1e-10));
  CHECK(located_limit(walled_chain(20, 0.01, 100), omega, 20000, {true, false, false}) ==
        Approx(1).margin(1e-3));
}

TEST_CASE("oscillations: the step limit of hinges located by running is that of their stiffness",
          "[release]") {
  Cloth plate = triangular_sheet(0.1, 0.1, 10, equilateral_rows(0.1, 0.1, 10), 0.15);
  plate.structural.clear();
  add_flat_hinges(plate, 1e-5);
  const Unknowns unknowns(plate, {false, false, true});
  const double omega =
      highest_frequency(stiffness(plate, plate.particles.x, unknowns), masses(plate, unknowns));
  CHECK(located_limit(plate, omega, 4000, {false, false, true}) == Approx(1).margin(2e-3));
}

TEST_CASE("oscillations: frequencies of a stretched membrane converge with order two", "[release]") {
  const double exact[] = {drum_frequency(50, 0.2, 0.4, 0.3, 1, 1), drum_frequency(50, 0.2, 0.4, 0.3, 2, 1),
                          drum_frequency(50, 0.2, 0.4, 0.3, 1, 2)};
  CHECK(exact[0] == Approx(32.9403922934).epsilon(1e-10));
  CHECK(exact[1] == Approx(47.5073093791).epsilon(1e-10));
  CHECK(exact[2] == Approx(56.2885670254).epsilon(1e-10));
  const std::vector<double> coarse = computed_frequencies(drum(50, 0.2, 0.4, 0.3, 12), 2, 3),
                            fine = computed_frequencies(drum(50, 0.2, 0.4, 0.3, 24), 2, 3);
  for (int i = 0; i < 3; ++i) {
    CAPTURE(error(coarse[i], exact[i]), error(fine[i], exact[i]));
    CHECK(std::abs(error(fine[i], exact[i])) < 0.01);
    CHECK(error(coarse[i], exact[i]) / error(fine[i], exact[i]) == Approx(4).margin(1));
  }
}

TEST_CASE("oscillations: frequencies of plates of hinges", "[release]") {
  const double supported = supported_plate_frequency(1e-5, 0.15, 0.05),
               clamped = cantilever_frequency(1e-5, 0.15, 0.05);
  CHECK(supported == Approx(10.2603986413).epsilon(1e-10));
  CHECK(clamped == Approx(1.82761723863).epsilon(1e-10));
  // Columns for which the rows are equilateral to a thousandth: the rigidity of hinges depends on that.
  const double coarse =
                   error(computed_frequencies(supported_plate(1e-5, 0.15, 0.05, 13), 2, 1)[0], supported),
               fine = error(computed_frequencies(supported_plate(1e-5, 0.15, 0.05, 26), 2, 1)[0], supported);
  CAPTURE(coarse, fine);
  CHECK(std::abs(coarse) < 0.02);
  CHECK(std::abs(fine) < 0.01);
  // The lattice of hinges is a plate with nu = -1/3. A narrow strip of it has the rigidity D (1 - nu^2), a
  // wide one nearly D, so that the first frequency lies between sqrt(8/9) and 1 times that of the beam.
  for (const int rows : {8, 16, 32}) {
    const double f = computed_frequencies(cantilever(1e-5, 0.15, 0.05, 0.0125, rows), 2, 1)[0];
    CHECK(f > std::sqrt(8.0 / 9) * clamped * 0.99);
    CHECK(f < clamped);
  }
}
