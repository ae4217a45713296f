// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/motion/work_clock.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("work_clock: what processor time went to is told where it is asked for, and changes no bit") {
  const Integrator integrator = GENERATE(Integrator::leapfrog, Integrator::implicit);
  Cloth plain = sheet(8, 8, 0.05, 0.1, 4);
  SimulateOptions o;
  o.integrator = integrator;
  o.seconds = 0.1;
  Cloth timed = plain;
  const SimulateReport without = simulate(plain, nullptr, o);
  o.times = true;
  const SimulateReport with = simulate(timed, nullptr, o);
  CHECK(plain.particles.x == timed.particles.x);
  CHECK(std::accumulate(without.times.begin(), without.times.end(), 0.0) == 0);
  const double sum = std::accumulate(with.times.begin(), with.times.end(), 0.0);
  CHECK(sum > 0);
  CHECK(sum <= with.cpu_seconds);
  const auto of = [&](WorkPart part) { return with.times[std::size_t(part)]; };
  CHECK(of(WorkPart::elements) > 0);
  CHECK((of(WorkPart::factorisation) > 0) == (integrator != Integrator::leapfrog));
  CHECK((of(WorkPart::assembly) > 0) == (integrator != Integrator::leapfrog));
  CHECK(of(WorkPart::self_contact) == 0);
}
