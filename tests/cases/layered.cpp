// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/layered.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "physics/cloth/join_cloths.h"
#include "physics/linear/free_stiffness.h"
#include "physics/pairs/cloth_contact.h"
#include "physics/pairs/untangle_layers.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/friction.h"
#include "tests/cases/gravity.h"
#include "tests/cases/plates.h"

namespace furrow::cases {
namespace {

using physics::Cloth;
using physics::Vec3;

using std::numbers::pi;
using Positions = std::vector<Vec3>;

constexpr double young = 450, cloth_density = 0.15, thick = 1e-3, mu_cloth = 0.3;
constexpr int most_of_a_slide = 40;  // iterations: what stays is at rest before

physics::SettleOptions rest_options(double tolerance = 1e-4) {
  physics::SettleOptions o;
  o.gravity = {0, 0, -gravity};
  o.tolerance = tolerance;
  o.max_iterations = 1000;
  o.self.on = true;
  o.self.thickness = thick;
  o.self.friction = 0;
  return o;
}

/// A flat sheet in its place; poisson 0. seed 0: equilateral, else its vertices are jittered.
Cloth sheet(double width, double height, int columns, std::uint64_t seed, double density = cloth_density) {
  Cloth cloth = triangular_sheet(width, height, columns, equilateral_rows(width, height, columns), density,
                                 seed ? 0.2 : 0, seed ? seed : 1);
  cloth.structural.clear();
  add_flat_membrane(cloth, young, 0);
  return cloth;
}

void hold_all(Cloth& cloth) {
  for (double& w : cloth.particles.inv_mass) w = 0;
}

void shift(Cloth& cloth, const Vec3& by) {
  for (Vec3& x : cloth.particles.x) x += by;
}

double weight_of(const Cloth& cloth) {
  double sum = 0;
  for (const double m : cloth.particles.mass) sum += gravity * m;
  return sum;
}

/// Runs settle() and adds what it came to.
void find_rest(Cloth& cloth, const physics::Collider* body, const physics::SettleOptions& o, LayeredCase& c) {
  const bool first = c.vertices == 0;
  const physics::SettleReport report = physics::settle(cloth, body, o);
  c.vertices = int(cloth.particles.size());
  c.rests = report.converged && (first || c.rests);
  c.iterations += report.iterations;
  c.crossings = int(
      physics::edge_face_crossings(physics::pair_mesh(cloth, o.self.thickness), cloth.particles.x).size());
  c.x = cloth.particles.x;
}

/// What pairs push with, without friction, by the stiffness that settle() takes from a start [N].
Positions pair_forces(const Cloth& cloth, const Positions& start, double thickness) {
  physics::FreeStiffness stiffness(cloth);
  stiffness.assemble(cloth, start, physics::Stiffness::positive_part);
  physics::ClothContact contact(cloth, {thickness, 0.5 * stiffness.mean_diagonal()}, start, {});
  contact.look(cloth.particles.x, nullptr);
  Positions force(start.size(), Vec3::Zero());
  contact.add_forces(force);
  return force;
}

/// A force that is the same wherever its vertices are.
struct Load : physics::Energy {
  std::vector<int> vertices;
  Vec3 each;  ///< [N]
  Load(std::vector<int> on, const Vec3& whole)
      : vertices(std::move(on)), each(whole / double(vertices.size())) {}
  double energy(std::span<const Vec3> x) const override {
    double sum = 0;
    for (const int v : vertices) sum -= each.dot(x[std::size_t(v)]);
    return sum;
  }
  void add_forces(std::span<const Vec3>, std::span<Vec3> force) const override {
    for (const int v : vertices) force[std::size_t(v)] += each;
  }
  bool add_stiffness(std::span<const Vec3>, physics::Stiffness, const physics::BlockSink&) const override {
    return true;  // none, and that is known
  }
};

/// Ties vertices to held particles far off, by springs at rest.
void tether(Cloth& cloth, const std::vector<int>& vertices, const Vec3& away, double stiffness) {
  auto& p = cloth.particles;
  for (const int v : vertices) {
    cloth.structural.push_back({v, int(p.size()), away.norm(), stiffness});
    const Vec3 far = p.x[std::size_t(v)] + away;
    p.x.push_back(far);
    p.v.push_back(Vec3::Zero());
    p.mass.push_back(1e-3);
    p.inv_mass.push_back(0);
  }
}

/// A closed tube around z from 0 to `length`, at rest where it is a prism over a polygon of that radius.
Cloth tube(double radius, double length, int around, int rows) {
  Cloth flat = right_sheet(around, rows, around, rows, 1, true), cloth;
  const auto at = [&](int i, int j, double r) {
    const double angle = 2 * pi * i / around;
    return Vec3(r * std::cos(angle), r * std::sin(angle), length * j / rows);
  };
  auto& p = cloth.particles;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i < around; ++i) p.x.push_back(at(i, j, radius));
  p.v.assign(p.x.size(), Vec3::Zero());
  p.mass.assign(p.x.size(), 0);
  for (const auto& t : flat.triangles) {
    std::array<int, 3> own;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3& x = flat.particles.x[std::size_t(t[c])];
      own[c] = int(std::lround(x.y())) * around + int(std::lround(x.x())) % around;
    }
    cloth.triangles.push_back(own);
    const auto edge = [&](int a, int b) {
      return Vec3(p.x[std::size_t(own[std::size_t(b)])] - p.x[std::size_t(own[std::size_t(a)])]);
    };
    cloth.membrane.push_back({own, {edge(1, 2).norm(), edge(2, 0).norm(), edge(0, 1).norm()}, 0, young / 2});
    for (const int v : own) p.mass[std::size_t(v)] += cloth_density * edge(0, 1).cross(edge(0, 2)).norm() / 6;
  }
  for (const double m : p.mass) p.inv_mass.push_back(1 / m);
  return cloth;
}

/// Where a curve is after s [m], by many short pieces of its direction.
struct Curve {
  Positions points{Vec3::Zero()};
  double step;
  void go(double length, const std::function<double(double)>& angle) {
    const int n = std::max(1, int(std::lround(length / step)));
    for (int i = 0; i < n; ++i) {
      const double a = angle((i + 0.5) / n);
      points.push_back(points.back() + step * Vec3(std::cos(a), 0, std::sin(a)));
    }
  }
  double length() const { return step * double(points.size() - 1); }
  Vec3 at(double s) const {
    const double k = std::clamp(s / step, 0.0, double(points.size() - 1) - 1e-9);
    const std::size_t i = std::size_t(k);
    return points[i] + (k - double(i)) * (points[i + 1] - points[i]);
  }
};

/// Puts a flat strip along x on a curve in the plane of x and z.
void lay_on(Cloth& strip, const Curve& curve) {
  for (Vec3& x : strip.particles.x) {
    const Vec3 at = curve.at(x.x());
    x = {at.x(), x.y(), at.z()};
  }
}

/// The last vertex of a flat strip's border y = 0, and the one before.
std::array<std::size_t, 2> last_along_border(const Cloth& strip) {
  std::vector<std::size_t> border;
  const auto& x = strip.particles.x;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i].y() < 1e-9) border.push_back(i);
  std::sort(border.begin(), border.end(), [&](std::size_t a, std::size_t b) { return x[a].x() > x[b].x(); });
  return {border[0], border[1]};
}

/// The inside of an endless cylinder around y.
struct Tube : physics::Collider {
  double radius;
  explicit Tube(double r) : radius(r) {}
  physics::SignedDistance at(const Vec3& x) const override {
    const Vec3 out(x.x(), 0, x.z());
    const double r = out.norm();
    return {radius - r, r > 0 ? Vec3(-out / r) : Vec3(-1, 0, 0)};
  }
};

}  // namespace

LayeredCase stacked_sheets(int n, int columns, int threads) {
  std::vector<Cloth> sheets{sheet(0.3, 0.3, columns, 1)};
  hold_all(sheets[0]);
  for (int k = 1; k <= n; ++k) {
    Cloth& above = sheets.emplace_back(sheet(0.2, 0.2, columns * 2 / 3 + k % 3, std::uint64_t(k) + 1));
    shift(above, Vec3(0.05, 0.05, 1.5e-3 * k));
    add_flat_hinges(above, 1e-5);
  }
  Cloth cloth = physics::join_cloths(sheets);
  const Positions start = cloth.particles.x;
  physics::SettleOptions o = rest_options();
  o.threads = threads;
  LayeredCase c;
  find_rest(cloth, nullptr, o, c);
  const Positions force = pair_forces(cloth, start, thick);
  double total = 0, borne = 0, lowest = 1;
  for (int k = 1; k <= n; ++k) total += weight_of(sheets[std::size_t(k)]);
  std::size_t end = start.size();
  double answer = 0;
  for (int k = n; k >= 1; --k) {
    const std::size_t begin = end - sheets[std::size_t(k)].particles.size();
    for (std::size_t i = begin; i < end; ++i) borne += force[i].z();
    answer += weight_of(sheets[std::size_t(k)]);
    c.numbers.push_back({"force on sheet " + std::to_string(k - 1) + " over the whole weight", answer / total,
                         borne / total, 1e-3});
    if (k == 1)
      for (std::size_t i = begin; i < end; ++i) lowest = std::min(lowest, cloth.particles.x[i].z());
    end = begin;
  }
  if (n == 1) c.numbers.push_back({"least gap [mm]", 0.975, 1e3 * lowest, 0.025});
  return c;
}

LayeredCase pressed_pair(bool edges, double load) {
  Cloth cloth;
  auto& p = cloth.particles;
  const auto add = [&](const Vec3& x, bool held) {
    p.x.push_back(x);
    p.v.push_back(Vec3::Zero());
    p.mass.push_back(1);
    p.inv_mass.push_back(held ? 0 : 1);
  };
  const double free_ones = edges ? 2 : 1, above = 0.9e-3;
  if (edges) {
    for (const Vec3& x : {Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, -1)}) add(x, true);
    for (const double y : {-1.0, 1.0}) add({0, y, above}, false);
    add({0, 0, 1}, true);
  } else {
    for (const Vec3& x : {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)}) add(x, true);
    add({0, 0, above}, false);
    for (const double y : {-1.0, 1.0}) add({0, y, 1}, true);
  }
  cloth.triangles = {{0, 1, 2}, {3, 4, 5}};
  physics::SettleOptions o = rest_options(1e-11);
  // Nothing else is stiff, so that settle() takes 1 N/m.
  o.gravity = {0, 0, -load * thick / free_ones};
  LayeredCase c;
  find_rest(cloth, nullptr, o, c);
  const double u = 1 + load - std::sqrt(load * load + 2 * load);  // (1 - u)^2 / u = 2 load
  c.numbers.push_back({"distance over range", u, p.x[3].z() / thick, 1e-9});
  return c;
}

LayeredCase on_incline(double share, int columns) {
  Cloth below = sheet(0.2, 0.2, columns, 1), above = sheet(0.1, 0.1, columns / 2, 2);
  hold_all(below);
  shift(above, {0.02, 0.05, 1.2e-3});
  add_flat_hinges(above, 1e-5);
  const std::vector<Cloth> both{below, above};
  Cloth cloth = physics::join_cloths(both);
  physics::SettleOptions o = rest_options(1e-3);
  o.self.friction = mu_cloth;
  const double angle = std::atan(share * mu_cloth);
  o.gravity = gravity * Vec3(std::sin(angle), 0, -std::cos(angle));
  o.max_iterations = most_of_a_slide;
  LayeredCase c;
  find_rest(cloth, nullptr, o, c);
  c.rests = c.rests && c.x.back().z() > -0.01;
  return c;
}

LayeredCase pulled_sheet(double share, int columns) {
  std::vector<Cloth> sheets{sheet(0.2, 0.14, columns, 1), sheet(0.1, 0.1, columns / 2, 2),
                            sheet(0.08, 0.08, columns * 2 / 5, 3, 1.0)};
  hold_all(sheets[0]);
  for (const std::size_t k : {1, 2}) {
    shift(sheets[k], Vec3(0.03 + 0.01 * double(k), 0.01 + 0.01 * double(k), 1.1e-3 * double(k)));
    add_flat_hinges(sheets[k], 1e-5);
  }
  Cloth cloth = physics::join_cloths(sheets);
  const std::size_t middle = sheets[0].particles.size(), top = middle + sheets[1].particles.size();
  std::vector<int> pulled, left;
  for (std::size_t i = middle; i < cloth.particles.size(); ++i) {
    if (i < top) pulled.push_back(int(i));
    if (i >= top && cloth.particles.x[i].x() < 0.05 + 1e-9) left.push_back(int(i));
  }
  const double n1 = weight_of(sheets[2]), n2 = n1 + weight_of(sheets[1]), held = mu_cloth * (n1 + n2);
  cloth.energies.push_back(std::make_shared<Load>(pulled, Vec3(share * held, 0, 0)));
  tether(cloth, left, {-1, 0, 0}, 400.0 / double(left.size()));
  physics::SettleOptions o = rest_options(1e-3);
  o.self.friction = mu_cloth;
  o.max_iterations = most_of_a_slide;
  LayeredCase c;
  find_rest(cloth, nullptr, o, c);
  return c;
}

LayeredCase capstan_on_sleeve(double share, int around) {
  const double radius = 0.03, width = 0.012, h = 2 * pi * radius / around;
  Cloth sleeve = tube(radius, 0.03, around, std::max(2, int(std::lround(0.03 / h))));
  for (Vec3& x : sleeve.particles.x) x = {x.x(), x.z() - 0.009, x.y()};  // around y
  hold_all(sleeve);
  const double left = 0.05, right = 0.04, r = radius + 1.05 * thick;
  Curve curve{{Vec3(-r, 0, -left)}, 1e-4};
  curve.go(left, [](double) { return pi / 2; });
  curve.go(pi * r, [](double s) { return pi / 2 - pi * s; });
  curve.go(right, [](double) { return -pi / 2; });
  Cloth strip = sheet(curve.length(), width, int(std::lround(curve.length() / h)), 0);
  std::vector<int> end, free_end;
  for (std::size_t i = 0; i < strip.particles.size(); ++i) {
    const double s = strip.particles.x[i].x(), n = double(sleeve.particles.size());
    if (s > curve.length() - 1e-9) end.push_back(int(i + std::size_t(n)));
    if (s < 1e-9) free_end.push_back(int(i + std::size_t(n)));
  }
  add_flat_hinges(strip, 2e-8);
  lay_on(strip, curve);
  const std::vector<Cloth> both{sleeve, strip};
  Cloth cloth = physics::join_cloths(both);
  const double line = cloth_density * gravity * width,
               pull = share * capstan_length(mu_cloth, radius + 0.98 * thick, left) - right;
  cloth.energies.push_back(std::make_shared<Load>(end, Vec3(0, 0, -pull * line)));
  physics::SettleOptions o = rest_options(1e-3);
  o.self.friction = mu_cloth;
  o.max_iterations = most_of_a_slide;
  LayeredCase c;
  find_rest(cloth, nullptr, o, c);
  const double l1 = -c.x[std::size_t(free_end[0])].z(), l2 = pull - c.x[std::size_t(end[0])].z();
  c.numbers.push_back(
      {"held length [mm]", 1e3 * capstan_length(mu_cloth, radius + 0.98 * thick, l1), 1e3 * l2, 0.03, true});
  return c;
}

LayeredCase heavy_fold(double apart, int cells) {
  const double unit = 0.04, h = unit / cells, w = cloth_density * gravity, width = unit / 2;
  Curve curve{{Vec3::Zero()}, unit / 400};
  const double r = 0.46 * unit, lower = 4.6 * unit, down = 2.4 * unit;
  const double slope = std::atan2(2 * r - 1.05 * apart * unit, 0.75 * down);
  curve.go(lower, [](double) { return 0.0; });
  curve.go(pi * r, [](double s) { return pi * s; });
  curve.go(down, [&](double s) {
    const double ramp = std::min({1.0, 4 * s, 4 * (1 - s)});
    return pi + slope * ramp;
  });
  curve.go(2 * unit, [](double) { return pi; });
  Cloth cloth = sheet(curve.length(), width, int(std::lround(curve.length() / h)), 0);
  add_plate(cloth, physics::isotropic_plate(w * unit * unit * unit));
  const double longest = curve.length();
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    const double s = cloth.particles.x[i].x();
    if (s < 1e-9 || s > longest - 1.5 * h) cloth.particles.inv_mass[i] = 0;
  }
  const double gap = 3e-3, t = apart * unit, end = curve.points.back().z();
  lay_on(cloth, curve);
  for (Vec3& x : cloth.particles.x) x.z() += gap;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i)  // held as high as the layer lies
    if (cloth.particles.inv_mass[i] == 0 && cloth.particles.x[i].z() > gap + 0.5 * end)
      cloth.particles.x[i].z() = gap + t;
  physics::SettleOptions o = rest_options(1e-3);
  o.friction = 0;
  o.gap = gap;
  o.self.thickness = t;
  const Plane table(Vec3(0, 0, 1));
  LayeredCase c;
  find_rest(cloth, &table, o, c);
  double highest = 0, lowest = 1;
  for (const Vec3& x : c.x) highest = std::max(highest, x.z()), lowest = std::min(lowest, x.z());
  // By the closed form at 0, 0.05 and 0.1.
  const double answer = 0.906597 + 0.11517 * apart + 0.049 * apart * apart;
  c.numbers.push_back({"height [(B/w)^(1/3)]", answer, (highest - lowest) / unit, 0.02, true});
  return c;
}

LayeredCase coil_in_tube(int around) {
  const double radius = 0.05, gap = 1e-3, rigidity = 1e-4, t = 5e-4, width = 0.01;
  const double h = 2 * pi * radius / around, turns = 2 * pi + 2.9;
  // On the wall, then over its beginning.
  const auto radius_at = [&](double angle) {
    return radius - 2.2 * t * std::clamp((angle - 4.8) / 1.2, 0.0, 1.0);
  };
  Curve curve{{}, 0};
  curve.points.clear();
  double length = 0;
  constexpr int parts = 40000;
  std::vector<double> along{0};
  for (int i = 0; i <= parts; ++i) {
    const double a = turns * i / parts, r = radius_at(a);
    curve.points.push_back({r * std::cos(a), 0, r * std::sin(a)});
    if (i > 0)
      along.push_back(length += (curve.points[std::size_t(i)] - curve.points[std::size_t(i) - 1]).norm());
  }
  Cloth cloth = sheet(length, width, int(std::lround(length / h)), 0);
  add_plate(cloth, physics::isotropic_plate(rigidity));
  const std::array<std::size_t, 2> last = last_along_border(cloth);
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    Vec3& x = cloth.particles.x[i];
    if (x.x() < 1.5 * h) cloth.particles.inv_mass[i] = 0;
    const auto k = std::min<std::ptrdiff_t>(
        parts, std::lower_bound(along.begin(), along.end(), x.x() - 1e-12) - along.begin());
    const Vec3& at = curve.points[std::size_t(k)];
    x = {at.x(), x.y(), at.z()};
  }
  const Positions start = cloth.particles.x;
  physics::SettleOptions o = rest_options(1e-3);
  o.gravity = Vec3::Zero();
  o.friction = 0;
  o.gap = gap;
  o.self.thickness = t;
  const Tube wall(radius + gap);
  LayeredCase c;
  find_rest(cloth, &wall, o, c);
  const Positions force = pair_forces(cloth, start, t);
  const Vec3 end = c.x[last[0]], before = c.x[last[1]], out = Vec3(end.x(), 0, end.z()).normalized();
  const double angle = std::asin((end - before).normalized().dot(out)) * 180 / pi;
  Vec3 push = Vec3::Zero();
  for (std::size_t i = 0; i < c.x.size(); ++i)
    if ((c.x[i] - end).norm() < 0.4 * radius && std::hypot(c.x[i].x(), c.x[i].z()) < radius - 0.6 * t)
      push += force[i];
  c.numbers.push_back({"angle of the end to what it touches [degrees]", 24.117, angle, 1});
  const double inner = radius - t;
  c.numbers.push_back(
      {"force of the end [B/R^2]", 1.223685, push.norm() / width * inner * inner / rigidity, 0.03, true});
  return c;
}

LayeredCase sleeve_over_sleeve(int around) {
  const double rest = 0.05, outer = 0.054, length = 0.04, gap = 3e-3;
  const int rows = std::max(2, int(std::lround(length * around / (2 * pi * outer))));
  const Cylinder body(outer - thick - gap);
  Cloth below = tube(outer - thick - 5e-4, 1.5 * length, around, 3 * rows / 2),
        above = tube(rest, length, around, rows);
  for (Vec3& x : below.particles.x) x = Vec3(x.x() * 1.01, x.y() * 1.01, x.z());
  const double turn = 0.4 * 2 * pi / around, wide = (outer + 5e-4) / rest;
  for (Vec3& x : above.particles.x)
    x = Vec3(wide * (x.x() * std::cos(turn) - x.y() * std::sin(turn)),
             wide * (x.x() * std::sin(turn) + x.y() * std::cos(turn)), x.z() + 0.26 * length);
  const std::vector<Cloth> both{below, above};
  Cloth cloth = physics::join_cloths(both);
  const Positions start = cloth.particles.x;
  physics::SettleOptions o = rest_options(1e-3);
  o.gravity = Vec3::Zero();
  o.friction = 0;
  o.gap = gap;
  LayeredCase c;
  find_rest(cloth, &body, o, c);
  const Positions force = pair_forces(cloth, start, thick);
  double push = 0, mean = 0, low = 1, high = 0;
  const std::size_t first = below.particles.size();
  for (std::size_t i = first; i < c.x.size(); ++i) {
    const Vec3 flat(c.x[i].x(), c.x[i].y(), 0);
    push += force[i].dot(flat.normalized());
    mean += flat.norm() / double(c.x.size() - first);
    low = std::min(low, c.x[i].z()), high = std::max(high, c.x[i].z());
  }
  const double stretch = mean / rest, tension = young * stretch * (stretch * stretch - 1) / 2;
  c.numbers.push_back({"pressure between the layers [Pa]", tension / mean,
                       push / (2 * pi * mean * (high - low)), 0.01, true});
  return c;
}

const char* name_of(CrossingStart start) {
  switch (start) {
    case CrossingStart::bulge:
      return "bulge through a sheet";
    case CrossingStart::corner:
      return "corner through a sheet";
    case CrossingStart::line:
      return "sheets that cross along a line";
    case CrossingStart::noise:
      return "sheets interlaced by noise";
    case CrossingStart::coincident:
      return "coincident sheets";
  }
  return "";
}

namespace {

/// Height of the upper sheet over the lower one at a place of [0, 1]^2 [m].
double start_height(CrossingStart start, double x, double y, double noise) {
  const double apart = 3e-3, r2 = (x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5);
  switch (start) {
    case CrossingStart::bulge:
      return apart - 0.012 * std::exp(-r2 / 0.03);
    case CrossingStart::corner:
      return apart - 0.03 * std::max(0.0, x + y - 1.6);
    case CrossingStart::line:
      return 0.02 * (x - 0.3);
    case CrossingStart::noise:
      return 3e-3 * noise;
    case CrossingStart::coincident:
      break;
  }
  return 0;
}

}  // namespace

LayeredCase untangled(CrossingStart start, int columns) {
  const bool same = start == CrossingStart::coincident;
  std::vector<Cloth> sheets{sheet(0.3, 0.3, columns, 1),
                            sheet(0.3, 0.3, same ? columns : columns + 1, same ? 1 : 2)};
  std::uint64_t state = 7;
  for (Vec3& x : sheets[1].particles.x) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    x.z() = start_height(start, x.x() / 0.3, x.y() / 0.3, double(state >> 11) * 0x1p-52 - 1);
  }
  Cloth cloth = physics::join_cloths(sheets);
  physics::ClothLayers layers;
  layers.of_vertex.assign(sheets[0].particles.size(), 0);
  layers.of_vertex.resize(cloth.particles.size(), 1);
  layers.turned = {0, 0};
  const physics::PairMesh mesh = physics::pair_mesh(cloth, thick);
  const physics::UntangleReport report = physics::untangle_layers(cloth.particles.x, mesh, layers);
  LayeredCase c;
  c.vertices = int(cloth.particles.size());
  c.rests = true;
  c.iterations = report.rounds;
  c.crossings = int(physics::edge_face_crossings(mesh, cloth.particles.x).size());
  c.x = cloth.particles.x;
  c.numbers.push_back({"crossings left of " + std::to_string(report.at_start), 0, double(c.crossings), 0});
  c.numbers.push_back({"longest way over the mean edge", 1.5, report.farthest / mesh.mean_edge, 1.5});
  return c;
}

}  // namespace furrow::cases
