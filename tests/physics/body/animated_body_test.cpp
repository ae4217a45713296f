// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <limits>

#include "physics/body/moving_body.h"
#include "physics/motion/simulate.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

using VertexAt = std::function<Vec3(const Vec3&, double)>;

/// A mesh whose vertices move, as frames.
BodyFrames frames_of(const TriangleMesh& mesh, std::vector<double> times, const VertexAt& moved,
                     std::vector<int>* reads = nullptr) {
  BodyFrames frames{mesh.triangles, times, {}};
  frames.vertices = [=](int i) {
    if (reads) reads->push_back(i);
    std::vector<Vec3> x = mesh.vertices;
    for (Vec3& p : x) p = moved(p, times[std::size_t(i)]);
    return x;
  };
  return frames;
}

/// The body as it is at a time, its vertices on straight lines between the frames.
TriangleMesh mesh_at(const BodyFrames& frames, double time) {
  const auto& t = frames.times;
  std::size_t i = 0;
  while (i + 2 < t.size() && t[i + 1] <= time) ++i;
  const double s = std::clamp((time - t[i]) / (t[i + 1] - t[i]), 0.0, 1.0);
  TriangleMesh mesh{frames.vertices(int(i)), frames.triangles};
  const std::vector<Vec3> next = frames.vertices(int(i) + 1);
  for (std::size_t k = 0; k < next.size(); ++k) mesh.vertices[k] = (1 - s) * mesh.vertices[k] + s * next[k];
  return mesh;
}

const VertexAt shift = [](const Vec3& x, double t) { return Vec3(x + t * Vec3(0.5, 0.1, 0)); };
const VertexAt inflate = [](const Vec3& x, double t) { return Vec3((1 + t) * x); };
const VertexAt bend = [](const Vec3& x, double t) {
  return Vec3(x.x() + 0.1 * t, x.y() + t * (0.1 + 2 * x.x() * x.x()), x.z() * (1 - 0.3 * t));
};

Cloth lying_sheet(int n, double edge, double height) {
  Cloth cloth = sheet(n, n, edge, 0.1, 3);
  Vec3 centre = Vec3::Zero();
  for (const Vec3& x : cloth.particles.x) centre += x / double(cloth.particles.size());
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x() - centre.x(), height, centre.y() - x.y());
  return cloth;
}

}  // namespace

TEST_CASE("animated_body: between frames the distance is that of the body in between", "[release]") {
  const VertexAt motion = GENERATE(shift, inflate, bend);
  const BodyFrames frames = frames_of(sphere_mesh(0.1), {0, 0.5, 1}, motion);
  AnimatedBody body(frames);
  Noise noise(3);
  for (const double t : {-0.5, 0.0, 0.2, 0.5, 0.9, 1.0, 3.0}) {
    body.prepare(t, t);
    const ExactDistance exact(mesh_at(frames, t));
    for (int i = 0; i < 200; ++i) {
      const Vec3 on = mesh_at(frames, t).vertices[std::size_t(i)], x = on + 0.01 * noise.vector();
      CHECK(body.at(x).value == Approx(exact.at(x).value).margin(1.5e-3));
    }
  }
  CHECK(body.frames_built() == 3);
}

TEST_CASE("animated_body: between frames of depth maps, too", "[release]") {
  const VertexAt motion = GENERATE(shift, inflate, bend);
  const BodyFrames frames = frames_of(sphere_mesh(0.1, 64, 32), {0, 0.5, 1, 1.5}, motion);
  DepthMapOptions six;
  six.maps = DepthMaps::six;
  AnimatedBody body(frames, six);
  Noise noise(3);
  for (const double t : {-0.5, 0.0, 0.2, 0.5, 0.9, 1.0, 1.3, 3.0}) {
    body.prepare(t, t);
    const TriangleMesh mesh = mesh_at(frames, t);
    const ExactDistance exact(mesh);
    for (int i = 0; i < 200; ++i) {
      const Vec3 x = mesh.vertices[std::size_t(7 * i)] + 0.004 * noise.vector();
      CHECK(body.at(x).value == Approx(exact.at(x).value).margin(1e-3));
    }
  }
  CHECK(body.frames_built() == 4);
}

TEST_CASE("animated_body: a body that shifts by more than its size between frames keeps its shape",
          "[release]") {
  const auto far = [](const Vec3& x, double t) { return Vec3(x + t * Vec3(0.3, 0, 0)); };
  AnimatedBody body(frames_of(sphere_mesh(0.1), {0, 1}, far));
  body.prepare(0.5, 0.5);
  Noise noise(8);
  for (int i = 0; i < 200; ++i) {
    const Vec3 x = Vec3(0.15, 0, 0) + (0.1 + 0.01 * noise()) * noise.vector().normalized();
    CHECK(body.at(x).value == Approx((x - Vec3(0.15, 0, 0)).norm() - 0.1).margin(2e-3));
    CHECK((body.way(x) - Vec3(0.3, 0, 0)).norm() < 1e-12);
  }
}

TEST_CASE("animated_body: frames are read once, in order, and the one that was left is not forgotten",
          "[long]") {
  std::vector<int> reads;
  AnimatedBody body(frames_of(sphere_mesh(0.1, 8, 6), {0, 0.1, 0.2, 0.3, 0.4, 0.5}, shift, &reads));
  CHECK(reads.empty());
  for (int i = 0; i < 30; ++i) body.prepare(0.01 * i, 0.01 * (i + 1));
  CHECK(reads == std::vector<int>{0, 1, 2, 3, 4});
  CHECK(body.frames_built() == 5);
  CHECK(body.travel() == Approx(0.01 * Vec3(0.5, 0.1, 0).norm()));
  CHECK(body.share() == Approx(0.1));
  body.prepare(0.25, 0.25);  // back into the interval before, and on again
  body.prepare(0.25, 0.31);
  CHECK(body.frames_built() == 5);
  body.prepare(0.3, 0.9);  // the last frame holds
  CHECK(body.travel() == Approx(0.2 * Vec3(0.5, 0.1, 0).norm()));
  CHECK(body.way(Vec3(0.3, 0, 0)).norm() > 0);
  body.prepare(0.9, 1.0);
  CHECK(body.share() == 0);
  CHECK(body.travel() == 0);
}

TEST_CASE("animated_body: broken frames are refused") {
  const TriangleMesh mesh = sphere_mesh(0.1, 8, 6);
  const auto make = [&](std::vector<double> times) { return AnimatedBody(frames_of(mesh, times, shift)); };
  CHECK_THROWS_WITH(make({0}), Catch::Contains("1 frames"));
  CHECK_THROWS_WITH(make({0, 0}), Catch::Contains("time of frame 1"));
  CHECK_THROWS_AS(make({0, std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
  BodyFrames frames = frames_of(mesh, {0, 1}, shift);
  frames.vertices = nullptr;
  CHECK_THROWS_AS(AnimatedBody(frames), std::invalid_argument);
  frames.vertices = [&](int i) {
    std::vector<Vec3> x = mesh.vertices;
    if (i == 1) x.pop_back();
    return x;
  };
  AnimatedBody body(frames);
  CHECK_THROWS_WITH(body.prepare(0, 0.1), Catch::Contains("frame 1 has"));
}

TEST_CASE("animated_body: a shifting body as frames does to cloth what the rigid one does", "[release]") {
  const TriangleMesh mesh = sphere_mesh(0.2);
  const ExactDistance exact(mesh);
  const Vec3 v(0.3, 0.1, 0);
  const double friction = GENERATE(0.0, 0.5);
  World rigid, animated;
  rigid.collider = &exact;
  rigid.body_motion = uniform_motion(v, 2);
  AnimatedBody body(
      frames_of(mesh, {-0.1, 0.1, 0.2, 0.6}, [&](const Vec3& x, double t) { return Vec3(x + t * v); }));
  animated.animated = &body;
  Cloth a = lying_sheet(15, 0.04, 0.205), b = a;
  SimulateOptions options;
  options.seconds = 0.15;  // buckling makes more of any difference the longer it lasts
  options.friction = friction;
  const SimulateReport ra = simulate(a, rigid, options), rb = simulate(b, animated, options);
  CHECK(ra.contacts > 5);
  CHECK(rb.contacts == ra.contacts);
  CHECK(rb.frames_built == 3);
  CHECK(rb.frame_seconds > 0);
  double worst = 0;
  for (std::size_t i = 0; i < a.particles.size(); ++i) {
    worst = std::max(worst, (a.particles.x[i] - b.particles.x[i]).norm());
  }
  INFO("largest difference " << worst);
  CHECK(worst < 1e-6);
}

TEST_CASE("animated_body: a body that inflates or bends pushes cloth away and takes it along", "[release]") {
  const VertexAt motion = GENERATE(inflate, bend);
  const bool maps = GENERATE(false, true);
  const BodyFrames frames = frames_of(sphere_mesh(0.1), {0, 0.2, 0.4, 0.6, 0.8, 1}, motion);
  AnimatedBody body(frames, maps ? std::optional(DepthMapOptions()) : std::nullopt);
  World world;
  world.animated = &body;
  Cloth cloth = lying_sheet(12, 0.03, 0.11);
  SimulateOptions options;
  options.seconds = 0.8;
  options.friction = 0.5;
  options.observe_steps = 100;
  double deepest = 0;
  const SimulateReport report = simulate(cloth, world, options, nullptr, [&](const SimulateProgress& p) {
    deepest =
        std::max(deepest, penetration(ExactDistance(mesh_at(frames, p.time)), cloth.particles.x).deepest);
    return true;
  });
  CHECK(report.outcome == Outcome::finished);
  CHECK(report.contacts > 5);
  CHECK(deepest == 0);
}

TEST_CASE("animated_body: a particle on a conveyor of frames gains mu g", "[release]") {
  // A long box whose vertices shift: the surface next to the particle moves, its distance does not change.
  TriangleMesh box;
  for (int i = 0; i < 8; ++i)
    box.vertices.push_back({i & 1 ? 2.0 : -2.0, i & 2 ? 0.0 : -0.2, i & 4 ? 0.3 : -0.3});
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  AnimatedBody body(frames_of(box, {-0.1, 0.05, 0.2, 0.4, 0.6},
                              [](const Vec3& x, double t) { return Vec3(x + Vec3(t, 0, 0)); }));
  World world;
  world.animated = &body;
  Cloth cloth;
  add_particle(cloth, {0, 0.003, 0.01}, 1e-4);
  SimulateOptions options;
  options.air_drag = 0;
  options.friction = 0.5;
  options.dt = 5e-4;
  options.seconds = 0.5;
  options.stop_at = 0.15;
  SimulateState state;
  simulate(cloth, world, options, &state);
  CHECK(cloth.particles.v[0].x() == Approx(0.5 * 9.81 * state.time).epsilon(0.01));
  CHECK(cloth.particles.x[0].x() == Approx(0.25 * 9.81 * state.time * state.time).epsilon(0.01));
  options.stop_at.reset();
  simulate(cloth, world, options, &state);
  CHECK(cloth.particles.v[0].x() == Approx(1).epsilon(1e-6));
}

TEST_CASE("animated_body: a run over an animated body that is stopped and resumed gives the same bits",
          "[release]") {
  const BodyFrames frames = frames_of(sphere_mesh(0.1), {0, 0.1, 0.2, 0.3}, inflate);
  AnimatedBody body(frames), second(frames);
  World world;
  world.animated = &body;
  Cloth whole = lying_sheet(12, 0.03, 0.11), parts = whole;
  SimulateOptions options;
  options.seconds = 0.3;
  const SimulateReport one = simulate(whole, world, options);
  CHECK(one.contacts > 5);
  world.animated = &second;
  SimulateState state;
  for (const double stop : {0.03, 0.1, 0.17, 0.18, 0.25}) {
    options.threads = 3 - options.threads;
    options.stop_at = stop;
    simulate(parts, world, options, &state);
    AnimatedBody fresh(frames);  // as if read from files again
    std::swap(second, fresh);
  }
  options.stop_at.reset();
  const SimulateReport rest = simulate(parts, world, options, &state);
  CHECK(whole.particles.x == parts.particles.x);
  CHECK(whole.particles.v == parts.particles.v);
  CHECK(one.collider_queries == rest.collider_queries);
}
