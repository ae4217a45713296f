// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/physics/cloth/strips.h"

#include <numbers>

#include "tests/physics/cloth/shell_cloths.h"
#include "tests/physics/rest/settled.h"

namespace furrow::tests {
namespace {

/// Odd rows begin and end with half an edge.
void place_rows(Strip& strip, const StripOptions& o) {
  const double step = o.length / o.rows, edge = step / std::sqrt(0.75);
  Noise noise(o.seed);
  for (int r = -1; r <= o.rows + (o.far_clamp ? 1 : 0); ++r) {
    std::vector<int>& row = strip.rows.emplace_back();
    const bool odd = r % 2 != 0, end = r <= 0 || r >= o.rows, held = r <= 0 || (o.far_clamp && end);
    const int n = o.columns + (odd ? 1 : 0);
    for (int c = 0; c <= n; ++c) {
      const double y = odd ? std::clamp(c - 0.5, 0.0, double(o.columns)) : c;
      const double dx = o.jitter * edge * noise(), dy = o.jitter * edge * noise();
      row.push_back(int(strip.cloth.particles.size()));
      add_particle(strip.cloth, {r * step + (end ? 0 : dx), y * edge + (c == 0 || c == n ? 0 : dy), 0}, 0);
      if (held && r != -1 && r != o.rows + 1) strip.clamped.push_back(row.back());
    }
  }
  strip.width = o.columns * edge;
}

void join_rows(Strip& strip) {
  for (std::size_t r = 0; r + 1 < strip.rows.size(); ++r) {
    const bool ahead = strip.rows[r].size() < strip.rows[r + 1].size();  // the row with more particles
    const std::vector<int>&more = strip.rows[ahead ? r + 1 : r], &less = strip.rows[ahead ? r : r + 1];
    const auto add = [&](int a, int b, int c) {
      if (ahead) std::swap(a, b);
      strip.cloth.triangles.push_back({a, b, c});
    };
    for (std::size_t c = 0; c < less.size(); ++c) add(more[c + 1], more[c], less[c]);
    for (std::size_t c = 0; c + 1 < less.size(); ++c) add(less[c], less[c + 1], more[c + 1]);
  }
}

bool contains(const std::vector<int>& set, int i) {
  return std::find(set.begin(), set.end(), i) != set.end();
}

void hold(Cloth& cloth, const std::vector<int>& row) {
  for (const int i : row) cloth.particles.inv_mass[i] = 0;
}

/// Hinges whose edge lies on a clamp.
template <typename Change>
void for_clamp_hinges(Strip& strip, const Change& change) {
  for (physics::Hinge& h : strip.cloth.hinges) {
    if (contains(strip.clamped, h.vertices[0]) && contains(strip.clamped, h.vertices[1])) change(h);
  }
}

}  // namespace

Vec3 Strip::middle(std::size_t row) const {
  Vec3 sum = Vec3::Zero();
  for (const int i : rows[row]) sum += cloth.particles.x[i];
  return sum / double(rows[row].size());
}

Strip equilateral_strip(const StripOptions& o) {
  Strip strip{{}, {}, {}, o.length, 0, o.rigidity};
  place_rows(strip, o);
  join_rows(strip);
  Cloth& cloth = strip.cloth;
  add_springs_and_masses(cloth, 0, 0, o.density);
  cloth = without_springs(cloth);
  add_membrane(cloth, o.young, 1.0 / 3);
  add_hinges(cloth, o.rigidity);
  for_clamp_hinges(strip, [&](physics::Hinge& h) { h.stiffness *= o.clamp_factor; });
  hold(cloth, strip.clamped);
  hold(cloth, strip.rows.front());
  if (o.far_clamp) hold(cloth, strip.rows.back());
  return strip;
}

void replace_hinges_by_springs(Strip& strip, double stiffness) {
  Cloth& cloth = strip.cloth;
  for (physics::Hinge& h : cloth.hinges) h.stiffness = stiffness;
  for_clamp_hinges(strip, [&](physics::Hinge& h) { h.stiffness *= 8; });
  for (const physics::Hinge& h : cloth.hinges) {
    const auto [a, b] = std::minmax(h.vertices[2], h.vertices[3]);
    cloth.bending.push_back({a, b, (cloth.particles.x[b] - cloth.particles.x[a]).norm(), h.stiffness});
  }
  std::sort(cloth.bending.begin(), cloth.bending.end(),
            [](const Spring& s, const Spring& t) { return std::pair(s.a, s.b) < std::pair(t.a, t.b); });
  cloth.hinges.clear();
}

Strip ladder(const LadderOptions& o) {
  Strip strip{{}, {}, {2, 3}, o.length, o.width, o.rigidity};
  const double h = o.length / o.links, rung = o.density * h * o.width;
  Cloth& cloth = strip.cloth;
  const auto join = [&](int a, int b) {
    const double l = (cloth.particles.x[b] - cloth.particles.x[a]).norm();
    cloth.structural.push_back({a, b, l, o.stiffness});
  };
  for (int r = 0; r <= o.links + 1; ++r) {
    const int i = 2 * r;
    for (const double y : {0.0, o.width}) {
      add_particle(cloth, {(r - 1) * h, y, 0}, (r == o.links + 1 ? 0.25 : 0.5) * rung);
    }
    strip.rows.push_back({i, i + 1});
    if (r > 0) {
      join(i - 2, i), join(i - 2, i + 1), join(i - 1, i), join(i - 1, i + 1);
    }
    join(i, i + 1);
    if (r == 0 || r == o.links + 1) continue;
    if (o.bending > 0) {
      for (const int a : {i - 2, i - 1}) {
        cloth.bending.push_back({a, a + 4, 2 * h, o.bending * (r == 1 ? 8 : 1)});
      }
      continue;
    }
    const double k = (r == 1 ? o.clamp_factor : 1) * 0.5 * o.rigidity * o.width / h;
    cloth.hinges.push_back({{i, i + 1, i + 2, i - 1}, 0, k});
    cloth.hinges.push_back({{i, i + 1, i + 3, i - 2}, 0, k});
  }
  hold(cloth, {0, 1, 2, 3});
  return strip;
}

double gravity_for(double gamma, double density, double length, double rigidity) {
  return gamma * rigidity / (density * length * length * length);
}

Elastica heavy_elastica(double gamma, int n, int steps) {
  // From the tip, s its distance:  dM/ds = Gamma s cos t,  dt/ds = -M^(1/n),  dx/ds = cos t,  dy/ds = sin t.
  const auto slope = [&](double s, const Eigen::Vector4d& q) {
    return Eigen::Vector4d(gamma * s * std::cos(q[1]), -std::pow(std::max(q[0], 0.0), 1.0 / n),
                           std::cos(q[1]), std::sin(q[1]));
  };
  const auto shoot = [&](double tip) {
    Eigen::Vector4d q(0, tip, 0, 0);
    const double h = 1.0 / steps;
    for (int i = 0; i < steps; ++i) {
      const double s = i * h;
      const Eigen::Vector4d a = slope(s, q), b = slope(s + h / 2, q + h / 2 * a),
                            c = slope(s + h / 2, q + h / 2 * b), d = slope(s + h, q + h * c);
      q += h / 6 * (a + 2 * b + 2 * c + d);
    }
    return q;
  };
  double low = 0, high = std::numbers::pi / 2;
  for (int i = 0; i < 60; ++i) {
    const double tip = (low + high) / 2;
    (shoot(tip)[1] > 0 ? high : low) = tip;
  }
  const Eigen::Vector4d q = shoot(high);
  return {q[2], q[3], high};
}

double critical_gamma(const Strip& strip, const Vec3& direction, double below, double above) {
  const double density = strip.cloth.particles.mass.empty() ? 0 : [&] {
    double mass = 0, area = 0;
    for (const double m : strip.cloth.particles.mass) mass += m;
    for (const physics::MembraneTriangle& t : strip.cloth.membrane)
      area += physics::membrane_constants(t).area;
    return mass / area;
  }();
  Cloth cloth = strip.cloth;
  while (above - below > 1e-4 * above) {
    const double gamma = (below + above) / 2;
    const Vec3 gravity = gravity_for(gamma, density, strip.length, strip.rigidity) * direction;
    (find_rest(cloth, down_to(1e-4, gravity)).stable ? below : above) = gamma;
  }
  return (below + above) / 2;
}

}  // namespace furrow::tests
