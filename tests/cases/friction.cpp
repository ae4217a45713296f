// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/friction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/cases/flat_meshes.h"
#include "tests/cases/gravity.h"
#include "tests/cases/membrane_laws.h"

namespace furrow::cases {
namespace {

using physics::Cloth;
using physics::Vec3;

using std::numbers::pi;
constexpr double density = 0.15;   // kg/m
constexpr double membrane = 300;   // N, stiffness of a strip times its length
constexpr double longest = 0.004;  // m, springs on the table

/// Springs without rest lengths between neighbours, masses by the lengths beside.
Cloth strip_along(const std::vector<Vec3>& x) {
  Cloth cloth;
  cloth.particles.x = x;
  cloth.particles.v.assign(x.size(), Vec3::Zero());
  cloth.particles.mass.assign(x.size(), 0);
  for (int i = 0; i + 1 < int(x.size()); ++i) {
    cloth.structural.push_back({i, i + 1, 0, 0});
    for (const int end : {i, i + 1}) cloth.particles.mass[end] += density * (x[i + 1] - x[i]).norm() / 2;
  }
  for (const double m : cloth.particles.mass) cloth.particles.inv_mass.push_back(1 / m);
  return cloth;
}

/// Points after `from` towards `to`, in equal parts of at most h.
void go(std::vector<Vec3>& x, const Vec3& to, double h) {
  const Vec3 from = x.back();
  const int parts = std::max(1, int(std::ceil((to - from).norm() / h - 1e-9)));
  for (int i = 1; i <= parts; ++i) x.push_back(from + (to - from) * (double(i) / parts));
}

template <typename Holds>
double bisect(double low, double high, double width, const Holds& holds) {
  while (high - low > width) {
    const double middle = (low + high) / 2;
    (holds(middle) ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// The friction that holds the strip as it lies; leaves it stretched for that.
double holding_friction(Cloth& strip, const physics::Collider& body, double gap) {
  const double mu =
      bisect(0, 3, 1e-14, [&](double middle) { return balance(strip, middle, body, gap) <= 0; });
  balance(strip, mu, body, gap);
  return mu;
}

}  // namespace

physics::SignedDistance Cylinder::at(const Vec3& x) const {
  const double l = std::hypot(x.x(), x.y());
  return {l - radius, Vec3(x.x() / l, x.y() / l, 0)};
}

physics::SignedDistance RoundedTable::at(const Vec3& x) const {
  if (x.x() > 0 && x.y() > 0) return Cylinder(radius).at(x);
  if (x.y() > x.x()) return {x.y() - radius, Vec3::UnitY()};
  return {x.x() - radius, Vec3::UnitX()};
}

double capstan_length(double mu, double radius, double left) {
  const double e = std::exp(mu * pi);
  return left * e + 2 * mu * radius * (1 + e) / (1 + mu * mu);
}

double tablecloth_length(double mu, double radius, double on_table) {
  const double a = radius * (1 - mu * mu) / (1 + mu * mu), b = 2 * mu * radius / (1 + mu * mu);
  return (mu * on_table - a) * std::exp(mu * pi / 2) + b;
}

Cloth strip_over_cylinder(double radius, double left, double right, int turn) {
  const double h = pi * radius / turn;
  std::vector<Vec3> x{{-radius, -left, 0}};
  go(x, {-radius, 0, 0}, h);
  for (int i = 1; i <= turn; ++i) {
    x.push_back(radius * Vec3(-std::cos(pi * i / turn), std::sin(pi * i / turn), 0));
  }
  go(x, {radius, -right, 0}, h);
  return strip_along(x);
}

Cloth strip_over_edge(double radius, double on_table, double right, int turn) {
  const double h = pi / 2 * radius / turn;
  std::vector<Vec3> x{{-on_table, radius, 0}};
  go(x, {0, radius, 0}, std::max(h, longest));
  for (int i = 1; i <= turn; ++i) {
    const double angle = pi / 2 * i / turn;
    x.push_back(radius * Vec3(std::sin(angle), std::cos(angle), 0));
  }
  go(x, {radius, -right, 0}, std::max(h, longest));
  return strip_along(x);
}

double balance(Cloth& strip, double mu, const physics::Collider& body, double gap) {
  const auto& x = strip.particles.x;
  double tension = 0;
  Vec3 along_before = Vec3::UnitY();
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const Vec3 load = -tension * along_before - strip.particles.mass[i] * gravity * Vec3::UnitY();
    const double l = (x[i + 1] - x[i]).norm();
    const Vec3 along = (x[i + 1] - x[i]) / l;
    const physics::SignedDistance field = body.at(x[i]);
    const Vec3 n = field.gradient, tangent(n.y(), -n.x(), 0);
    const bool on_body = field.value < gap + 1e-9;
    const Vec3 test = on_body ? Vec3(tangent + mu * n) : along;
    tension = -load.dot(test) / along.dot(test);
    const double r = l / (1 + tension / membrane);
    strip.structural[i].rest_length = r;
    strip.structural[i].stiffness = membrane / r;
    along_before = along;
  }
  return tension - strip.particles.mass.back() * gravity;
}

Slip slip(Cloth strip, const physics::Collider& body, const SlipOptions& options) {
  const double share = holding_friction(strip, body, options.gap);
  const Vec3 start = strip.particles.x[0];
  physics::SimulateOptions o;
  o.friction = options.friction;
  o.contact_gap = options.gap;
  o.seconds = options.seconds;
  o.air_drag = 0;
  simulate(strip, &body, o);
  return {(strip.particles.x[0] - start).norm(), share};
}

CriticalLength critical_length(const std::function<Cloth(double)>& make, const physics::Collider& body,
                               double low, double high, const SlipOptions& options) {
  const double width = 1e-3 * low;
  const auto stays = [&](double right) { return slip(make(right), body, options).moved < 1e-3; };
  const auto balanced = [&](double right) {
    Cloth strip = make(right);
    return holding_friction(strip, body, options.gap) < options.friction;
  };
  return {bisect(low, high, width, stays), bisect(low, high, 1e-3 * width, balanced)};
}

double slide_of_sheet(double angle, double friction, double dt) {
  const Vec3 n(-std::sin(angle), std::cos(angle), 0), down(-std::cos(angle), -std::sin(angle), 0);
  Cloth cloth = right_sheet(0.04, 0.04, 4, 4, 0.15, true);
  const std::vector<double> areas = rest_areas(cloth);
  // Soft enough for the step: dt below 0.4 h sqrt(rho/Y).
  set_membrane_stiffness(cloth, MembraneLaw::van_gelder, std::min(50.0, 2.4e-6 / (dt * dt)), areas);
  for (Vec3& x : cloth.particles.x) x = x.x() * down + x.y() * Vec3::UnitZ() + 0.003 * n;
  const std::vector<Vec3> start = cloth.particles.x;
  physics::SimulateOptions o;
  o.friction = friction;
  o.air_drag = 0;
  o.dt = dt;
  const Plane plane(n);
  simulate(cloth, &plane, o);
  double farthest = 0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    farthest = std::max(farthest, (cloth.particles.x[i] - start[i]).norm());
  }
  return farthest;
}

double incline_threshold(double friction, double dt) {
  const double exact = std::atan(friction);
  return bisect(exact - 0.02, exact + 0.033, 1e-4,
                [&](double angle) { return slide_of_sheet(angle, friction, dt) < 1e-5; });
}

Cloth sheet_over_floor(double above, double gap, double stiffness) {
  Cloth cloth = right_sheet(0.1, 0.1, 5, 5, 0.15, true);
  const std::vector<double> areas = rest_areas(cloth);
  set_membrane_stiffness(cloth, MembraneLaw::van_gelder, stiffness, areas);
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x(), gap + above, -x.y());
  return cloth;
}

namespace {

/// Of the mean of all particles along x.
double way_along(Cloth cloth, physics::SimulateOptions options) {
  const Plane floor(Vec3::UnitY());
  options.air_drag = 0;
  options.spring_damping = 0;
  double way = 0;
  for (const Vec3& x : cloth.particles.x) way -= x.x();
  simulate(cloth, &floor, options);
  for (const Vec3& x : cloth.particles.x) way += x.x();
  return way / double(cloth.particles.size());
}

}  // namespace

double slide_of_landing(double angle, double above, double stiffness, physics::SimulateOptions options) {
  options.gravity = gravity * Vec3(std::sin(angle), -std::cos(angle), 0);
  options.seconds = 2;
  return way_along(sheet_over_floor(above, options.contact_gap, stiffness), options) -
         std::max(0.0, above) * std::tan(angle);
}

double braking_way(double speed, double above, double stiffness, physics::SimulateOptions options) {
  Cloth cloth = sheet_over_floor(above, options.contact_gap, stiffness);
  for (Vec3& v : cloth.particles.v) v = Vec3(speed, 0, 0);
  options.seconds = 2 * speed / (options.friction * gravity);
  return way_along(std::move(cloth), options);
}

}  // namespace furrow::cases
