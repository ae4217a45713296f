// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/membrane_laws.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

namespace furrow::cases {
namespace {

using physics::Spring;

bool before(const Spring& s, const Spring& t) { return std::tie(s.a, s.b) < std::tie(t.a, t.b); }

void check_stiffness(double value, const char* function, const char* name) {
  if (value >= 0 && std::isfinite(value)) return;
  throw std::invalid_argument(std::string(function) + ": " + name + " = " + std::to_string(value) +
                              " is not >= 0");
}

void check(const Cloth& cloth, const char* function) {
  const std::vector<Spring>& springs = cloth.structural;
  if (!std::is_sorted(springs.begin(), springs.end(), before)) {
    throw std::invalid_argument(std::string(function) + ": structural springs are not sorted by (a, b)");
  }
  for (const Spring& s : springs) {
    if (s.rest_length > 0 && std::isfinite(s.rest_length)) continue;
    throw std::invalid_argument(std::string(function) + ": rest length = " + std::to_string(s.rest_length) +
                                " is not > 0");
  }
}

void check_areas(const Cloth& cloth, std::span<const double> areas, const char* function) {
  if (areas.size() != cloth.triangles.size()) {
    throw std::invalid_argument(std::string(function) + ": " + std::to_string(areas.size()) + " areas, but " +
                                std::to_string(cloth.triangles.size()) + " triangles");
  }
  for (const double area : areas) {
    if (area > 0 && std::isfinite(area)) continue;
    throw std::invalid_argument(std::string(function) + ": area = " + std::to_string(area) + " is not > 0");
  }
}

/// The index of the spring of the edge opposite corner c.
std::size_t spring_of(const Cloth& cloth, const std::array<int, 3>& triangle, int c) {
  const auto [a, b] = std::minmax(triangle[std::size_t(c + 1) % 3], triangle[std::size_t(c + 2) % 3]);
  const Spring edge{a, b, 0, 0};
  const auto found = std::lower_bound(cloth.structural.begin(), cloth.structural.end(), edge, before);
  if (found == cloth.structural.end() || before(edge, *found)) {
    throw std::invalid_argument("membrane laws: no structural spring from " + std::to_string(a) + " to " +
                                std::to_string(b));
  }
  return std::size_t(found - cloth.structural.begin());
}

/// What the law multiplies k_std (or Y) with, for each spring.
std::vector<double> factors(const Cloth& cloth, MembraneLaw law, std::span<const double> areas) {
  std::vector<double> result(cloth.structural.size(), law == MembraneLaw::van_gelder ? 0.0 : 1.0);
  if (law == MembraneLaw::van_gelder) {
    for (std::size_t t = 0; t < areas.size(); ++t) {
      for (int c = 0; c < 3; ++c) result[spring_of(cloth, cloth.triangles[t], c)] += areas[t];
    }
  }
  double sum = 0;
  for (const Spring& s : cloth.structural) sum += s.rest_length;
  const double average = sum / double(cloth.structural.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double r = cloth.structural[i].rest_length;
    if (law == MembraneLaw::paper) result[i] = r / average;
    if (law == MembraneLaw::inverse) result[i] = average / r;
    if (law == MembraneLaw::van_gelder) result[i] /= r * r;
  }
  return result;
}

}  // namespace

double lattice_stiffness(double young_times_thickness) {
  check_stiffness(young_times_thickness, "lattice_stiffness", "young_times_thickness");
  return std::sqrt(0.75) * young_times_thickness;
}

std::vector<double> rest_areas(const Cloth& cloth) {
  check(cloth, "rest_areas");
  std::vector<double> areas;
  for (const auto& triangle : cloth.triangles) {
    const auto length = [&](int c) { return cloth.structural[spring_of(cloth, triangle, c)].rest_length; };
    const double a = length(0), b = length(1), c = length(2), half = (a + b + c) / 2;
    const double square = half * (half - a) * (half - b) * (half - c);
    if (!(square > 0)) {
      throw std::invalid_argument("rest_areas: rest lengths " + std::to_string(a) + ", " + std::to_string(b) +
                                  ", " + std::to_string(c) + " make no triangle");
    }
    areas.push_back(std::sqrt(square));
  }
  return areas;
}

double calibrated_stiffness(const Cloth& cloth, MembraneLaw law, double young_times_thickness,
                            std::span<const double> areas) {
  check_stiffness(young_times_thickness, "calibrated_stiffness", "young_times_thickness");
  check(cloth, "calibrated_stiffness");
  check_areas(cloth, areas, "calibrated_stiffness");
  if (cloth.structural.empty()) throw std::invalid_argument("calibrated_stiffness: no structural springs");
  if (law == MembraneLaw::van_gelder) return young_times_thickness;
  const std::vector<double> factor = factors(cloth, law, areas);
  double area = 0, sum = 0;
  for (const double a : areas) area += a;
  for (std::size_t i = 0; i < factor.size(); ++i) {
    sum += factor[i] * cloth.structural[i].rest_length * cloth.structural[i].rest_length;
  }
  // 1/2 sum k (e r)^2 = A Y e^2 / (1 - nu)
  return 3 * young_times_thickness * area / sum;
}

void set_membrane_stiffness(Cloth& cloth, MembraneLaw law, double stiffness, std::span<const double> areas) {
  check_stiffness(stiffness, "set_membrane_stiffness", "stiffness");
  check(cloth, "set_membrane_stiffness");
  check_areas(cloth, areas, "set_membrane_stiffness");
  const std::vector<double> factor = factors(cloth, law, areas);
  for (std::size_t i = 0; i < factor.size(); ++i) cloth.structural[i].stiffness = factor[i] * stiffness;
}

}  // namespace furrow::cases
