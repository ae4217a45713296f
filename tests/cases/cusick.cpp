// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/cusick.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include "physics/cloth/elements.h"
#include "physics/cloth/patch_membrane.h"
#include "physics/cloth/pins.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/plates.h"

namespace furrow::cases {
namespace {

using physics::Cloth;
using physics::Vec3;

using std::numbers::pi;

double distance_from_axis(const Vec3& x) { return std::hypot(x.x(), x.y()); }

void check(const CusickOptions& o) {
  const auto need = [](bool good, const char* name, double value, const char* range) {
    if (good && std::isfinite(value)) return;
    throw std::invalid_argument(std::string("cusick_specimen: ") + name + " = " + std::to_string(value) +
                                " is not " + range);
  };
  need(o.support > 0, "support", o.support, "> 0");
  need(o.radius > o.support, "radius", o.radius, "> support");
  need(o.rings >= 2, "rings", o.rings, ">= 2");
  need(o.density > 0, "density", o.density, "> 0");
  need(o.bending_length > 0, "bending_length", o.bending_length, "> 0");
  need(o.folds >= 0, "folds", o.folds, ">= 0");
  need(true, "slope", o.slope, "finite");
  need(o.jitter >= 0 && o.jitter <= 0.3, "jitter", o.jitter, "in [0, 0.3]");
  const double held = o.rings * o.support / o.radius;
  need(std::abs(held - std::round(held)) < 1e-6, "rings * support / radius", held, "whole");
}

/// What bends, and the patches, over the flat specimen with its membrane.
void add_bending(Cloth& cloth, const CusickOptions& o) {
  const double rigidity = std::pow(o.bending_length, 3) * o.density * cusick_gravity;  // B = c^3 w an area
  if (o.patches) physics::join_patches(cloth);
  if (o.plate) return add_plate(cloth, physics::isotropic_plate(rigidity));
  add_flat_hinges(cloth, rigidity);
  if (o.stiff_clamp) physics::stiffen_clamps(cloth);
}

/// Where the triangle meets the line y: from, to; from > to if it does not.
std::array<double, 2> crossing(const Vec3& a, const Vec3& b, const Vec3& c, double y) {
  std::array<double, 2> span{1, 0};
  bool first = true;
  for (const auto& [p, q] : {std::pair(&a, &b), {&b, &c}, {&c, &a}}) {
    if ((p->y() > y) == (q->y() > y)) continue;
    const double x = p->x() + (y - p->y()) / (q->y() - p->y()) * (q->x() - p->x());
    span = first ? std::array{x, x} : std::array{std::min(span[0], x), std::max(span[1], x)};
    first = false;
  }
  return span;
}

/// Length that the spans cover together.
double covered(std::vector<std::array<double, 2>>& spans) {
  std::sort(spans.begin(), spans.end());
  double length = 0, end = -std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : spans) {
    length += std::max(0.0, to - std::max(from, end));
    end = std::max(end, to);
  }
  return length;
}

}  // namespace

Cusick cusick_specimen(const CusickOptions& o) {
  check(o);
  Cusick specimen{disc(o.radius, o.rings, o.density), {}, o.radius, o.support};
  Cloth& cloth = specimen.cloth;
  cloth.structural.clear();
  cloth.hinge_law = o.law;
  auto& [x, v, mass, inv_mass] = cloth.particles;
  std::mt19937_64 random(1);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = distance_from_axis(x[i]);
    if (r < o.support + 1e-9 * o.radius) inv_mass[i] = 0;
    if (r > o.radius * (1 - 1e-9))
      specimen.rim.push_back(int(i));
    else if (o.jitter > 0 && inv_mass[i] > 0)
      for (int axis : {0, 1})
        x[i][axis] += o.jitter * o.radius / o.rings * (double(random() >> 11) * 0x1p-52 - 1);
  }
  add_flat_membrane(cloth, o.young, o.poisson);
  add_bending(cloth, o);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double out = distance_from_axis(x[i]) - o.support, angle = std::atan2(x[i].y(), x[i].x());
    if (inv_mass[i] > 0) x[i].z() = -o.slope * out * (1 + std::cos(o.folds * angle));
  }
  return specimen;
}

double shadow_area(const Cloth& cloth, int lines) {
  const auto& x = cloth.particles.x;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : x) low = std::min(low, p.y()), high = std::max(high, p.y());
  const double step = (high - low) / lines;
  std::vector<std::vector<std::array<double, 2>>> spans(static_cast<std::size_t>(lines));
  for (const auto& [a, b, c] : cloth.triangles) {
    const auto [least, most] = std::minmax({x[a].y(), x[b].y(), x[c].y()});
    const int first = std::max(0, int((least - low) / step - 0.5));
    for (int i = first; i < lines && low + (i + 0.5) * step <= most; ++i) {
      const auto span = crossing(x[a], x[b], x[c], low + (i + 0.5) * step);
      if (span[0] < span[1]) spans[std::size_t(i)].push_back(span);
    }
  }
  double area = 0;
  for (auto& line : spans) area += step * covered(line);
  return area;
}

double drape_coefficient(const Cusick& s) {
  const double discs = pi * s.support * s.support;
  return (shadow_area(s.cloth) - discs) / (pi * s.radius * s.radius - discs);
}

int drape_nodes(const Cusick& s) {
  int strongest = 2;
  double most = -1;
  for (int n = 2; n <= 20; ++n) {
    std::complex<double> sum = 0;
    for (std::size_t k = 0; k < s.rim.size(); ++k)
      sum += distance_from_axis(s.cloth.particles.x[s.rim[k]]) *
             std::polar(1.0, -2 * pi * n * double(k) / double(s.rim.size()));
    if (std::abs(sum) > most) most = std::abs(sum), strongest = n;
  }
  return strongest;
}

double drape_energy(const Cusick& s) {
  const auto& p = s.cloth.particles;
  double energy = physics::potential_energy(s.cloth, p.x);
  for (std::size_t i = 0; i < p.size(); ++i) energy += p.mass[i] * cusick_gravity * p.x[i].z();
  return energy;
}

}  // namespace furrow::cases
