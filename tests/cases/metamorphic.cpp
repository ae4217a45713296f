// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/metamorphic.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace furrow::cases {
namespace {

using physics::Vec3;

constexpr double window = 0.25;  // s

void need_no_body(const RestCase& c) {
  if (c.body) throw std::invalid_argument("metamorphic: the body must be changed, too");
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(2 * seed + 1) {}
  /// Below n.
  std::size_t operator()(std::size_t n) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return std::size_t(state_ >> 33) % n;
  }

 private:
  std::uint64_t state_;
};

template <typename T>
void shuffle(std::vector<T>& things, Random& random) {
  for (std::size_t i = things.size(); i > 1; --i) std::swap(things[i - 1], things[random(i)]);
}

template <typename T>
std::vector<T> placed(const std::vector<T>& things, const std::vector<int>& place) {
  std::vector<T> result = things;
  for (std::size_t i = 0; i < things.size(); ++i) result[std::size_t(place[i])] = things[i];
  return result;
}

void permute(std::vector<physics::Spring>& springs, const std::vector<int>& place) {
  for (physics::Spring& s : springs) {
    std::tie(s.a, s.b) = std::minmax(place[std::size_t(s.a)], place[std::size_t(s.b)]);
  }
  std::sort(springs.begin(), springs.end(),
            [](const auto& s, const auto& t) { return std::pair(s.a, s.b) < std::pair(t.a, t.b); });
}

template <typename Corners>
void rename(Corners& corners, const std::vector<int>& place) {
  for (int& v : corners) v = place[std::size_t(v)];
}

}  // namespace

physics::Mat3 askew() { return Eigen::AngleAxisd(2, Vec3(1, -2, 1.5).normalized()).toRotationMatrix(); }

std::vector<int> shuffled(int n, std::uint64_t seed) {
  std::vector<int> place(std::size_t(n), 0);
  std::iota(place.begin(), place.end(), 0);
  Random random(seed);
  shuffle(place, random);
  return place;
}

RestCase rotated(RestCase c, const physics::Mat3& rotation) {
  need_no_body(c);
  for (Vec3& x : c.cloth.particles.x) x = rotation * x;
  for (Vec3& v : c.cloth.particles.v) v = rotation * v;
  c.options.gravity = rotation * c.options.gravity;
  c.rotation = rotation * c.rotation;
  return c;
}

RestCase permuted(RestCase c, std::uint64_t seed) {
  need_no_body(c);
  physics::Cloth& cloth = c.cloth;
  physics::Particles& p = cloth.particles;
  const std::vector<int> place = shuffled(int(p.size()), seed);
  p = {placed(p.x, place), placed(p.v, place), placed(p.mass, place), placed(p.inv_mass, place)};
  permute(cloth.structural, place);
  permute(cloth.bending, place);
  Random random(seed);
  for (auto& t : cloth.triangles) rename(t, place);
  for (auto& t : cloth.membrane) rename(t.vertices, place);
  for (auto& h : cloth.hinges) rename(h.vertices, place);
  shuffle(cloth.triangles, random);
  shuffle(cloth.membrane, random);
  shuffle(cloth.hinges, random);
  if (c.place.empty()) {
    c.place = place;
  } else {
    for (int& i : c.place) i = place[std::size_t(i)];
  }
  return c;
}

RestCase in_small_units(RestCase c) {
  need_no_body(c);
  constexpr double length = 1000, mass = 1000, time = 1000;
  constexpr double stiffness = mass / (time * time), energy = stiffness * length * length;
  physics::Particles& p = c.cloth.particles;
  for (Vec3& x : p.x) x *= length;
  for (Vec3& v : p.v) v *= length / time;
  for (double& m : p.mass) m *= mass;
  for (double& w : p.inv_mass) w /= mass;
  for (auto* springs : {&c.cloth.structural, &c.cloth.bending}) {
    for (physics::Spring& s : *springs) s.rest_length *= length, s.stiffness *= stiffness;
  }
  for (physics::MembraneTriangle& t : c.cloth.membrane) {
    for (double& l : t.rest_lengths) l *= length;
    t.lambda *= stiffness, t.mu *= stiffness;
  }
  for (physics::Hinge& h : c.cloth.hinges) h.stiffness *= energy;
  physics::SimulateOptions& o = c.options;
  o.seconds *= time, o.dt_max *= time, o.gravity *= length / (time * time), o.air_drag /= time;
  if (o.dt) *o.dt *= time;
  o.speed_limit *= length / time;
  c.metre *= length, c.second *= time;
  return c;
}

RestCase with_half_step(RestCase c) {
  c.options.dt_factor /= 2, c.options.dt_max /= 2;
  if (c.options.dt) *c.options.dt /= 2;
  return c;
}

RestCase with_tenfold_damping(RestCase c) {
  c.options.air_drag *= 10, c.options.spring_damping *= 10;
  return c;
}

Rest come_to_rest(const RestCase& c) {
  physics::Cloth cloth = c.cloth;
  std::vector<Vec3> before = cloth.particles.x;
  double asked = 0;
  Rest rest;
  const auto looks_still = [&](const physics::SimulateProgress& now) {
    if (now.time - asked < window * c.second) return true;
    asked = now.time;
    rest.at_rest = farthest(cloth.particles.x, before) <= c.still * c.size * c.metre;
    before = cloth.particles.x;
    return !rest.at_rest;
  };
  physics::SimulateOptions options = c.options;
  options.observe_steps = 8;
  const physics::SimulateReport report = simulate(cloth, c.body, options, looks_still);
  rest.residual = report.residual_force;
  rest.contacts = report.contacts;
  rest.seconds = report.time / c.second;
  rest.cpu_seconds = report.cpu_seconds;
  rest.dt = report.dt / c.second;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    const std::size_t j = c.place.empty() ? i : std::size_t(c.place[i]);
    rest.x.push_back(c.rotation.transpose() * cloth.particles.x[j] / c.metre);
  }
  return rest;
}

double farthest(const std::vector<Vec3>& x, const std::vector<Vec3>& y) {
  double most = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double d = (x[i] - y[i]).norm();
    if (std::isnan(d)) return d;
    most = std::max(most, d);
  }
  return most;
}

}  // namespace furrow::cases
