// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/motion/strain_watch.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "physics/cloth/pins.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("strain_watch: the longest edge, its time and place") {
  Cloth cloth = sheet(5, 4, 0.05, 0.2, 3);
  PackedCloth packed = pack(cloth, false);
  const StrainWatch watch(cloth, packed);
  CHECK(watch.look(packed, 1, {}).strain < 1e-12);

  const Spring& edge = cloth.structural[7];
  std::size_t place = 0;
  while (packed.particle[place] != edge.b) ++place;
  const Vec3 a = cloth.particles.x[edge.a], along = (cloth.particles.x[edge.b] - a).normalized();
  const Vec3 b = a + 3 * edge.rest_length * along;
  packed.x[place] = {b.x(), b.y(), b.z(), 0};
  const LongestEdge longest = watch.look(packed, 0.25, {});
  double most = 0;
  for (const Spring& s : cloth.structural)
    if (s.a == edge.b || s.b == edge.b)
      most = std::max(most, (b - cloth.particles.x[s.a == edge.b ? s.b : s.a]).norm() / s.rest_length - 1);
  CHECK(longest.strain == Approx(most).epsilon(1e-12));
  CHECK(longest.strain >= 2 - 1e-12);
  CHECK(longest.time == 0.25);
  CHECK((longest.at - b).norm() < 0.2);
  CHECK(watch.look(packed, 0.5, longest).time == 0.25);  // the first of those as long
  CHECK(watch.look(packed, 0.5, {9, 0.1, Vec3::Zero()}).strain == 9);
}

TEST_CASE("strain_watch: a run tells how far a spring went, and not only where it ended") {
  const Integrator integrator = GENERATE(Integrator::leapfrog, Integrator::implicit, Integrator::tr_bdf2);
  const double k = 40, v = 2, w = std::sqrt(k), stop = 0.1;
  SimulateOptions o;
  o.integrator = integrator;
  o.gravity = Vec3::Zero();
  o.air_drag = 0;
  o.spring_damping = 0;
  o.dt = integrator == Integrator::leapfrog ? 2e-5 : 2e-4;
  o.seconds = 2 * std::acos(-1) / w;  // back where it began
  Cloth whole = pendulum(1, k, 1, {1, 0, 0}, {v, 0, 0}), parts = whole;
  const SimulateReport report = simulate(whole, World{}, o);
  CAPTURE(int(integrator));
  CHECK(report.strain.max < 0.01);
  CHECK(report.longest_edge.strain == Approx(v / w).epsilon(0.005));
  CHECK(report.longest_edge.time == Approx(0.5 * std::acos(-1) / w).margin(0.02));
  CHECK(report.longest_edge.at.x() == Approx(0.5 * (1 + v / w)).epsilon(0.005));

  SimulateState state;
  o.stop_at = stop;
  const LongestEdge early = simulate(parts, World{}, o, &state).longest_edge;
  CHECK(early.strain == Approx(v / w * std::sin(w * stop)).epsilon(0.05));
  o.stop_at = 0.5;
  CHECK(simulate(parts, World{}, o, &state).longest_edge.strain == report.longest_edge.strain);
}

TEST_CASE("strain_watch: fine cloth whose pins are led away at once is not torn for a moment") {
  Cloth cloth = sheet(40, 30, 0.005, 0.2, 3, 400, 0.05);
  std::vector<int> top;
  for (int i = 0; i < 40; ++i) top.push_back(i);
  pin(cloth.particles, top);
  World world;
  RigidMotion away;
  away.keyframes.resize(3);
  away.keyframes[1].time = 0.1;
  away.keyframes[2].time = 0.3;
  away.keyframes[2].translation = Vec3(0.35, 0.4, 0.3);  // 3 m/s
  away.ends = EndSpeeds::free;
  world.pins = {{top, away}};
  SimulateOptions o;
  o.integrator = Integrator::implicit;
  o.seconds = 0.3;
  o.dt = 1.0 / 30;
  const SimulateReport report = simulate(cloth, world, o, nullptr);
  CAPTURE(report.longest_edge.strain, report.longest_edge.time);
  CHECK(report.longest_edge.strain < 0.3);
}
