// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/implicit_shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace furrow::meshes {
namespace {

using Eigen::Array;

/// To first order the distance from the ellipse or ellipsoid of radii r, where |p / r| = 1.
template <int N>
double from_ellipse(const Array<double, N, 1>& p, const Array<double, N, 1>& r) {
  const double k0 = std::sqrt((p / r).square().sum()), k1 = std::sqrt((p / (r * r)).square().sum());
  return k1 > 0 ? k0 * (k0 - 1) / k1 : -r.minCoeff();
}

using Numbers = Array<double, 4, 1>;
Numbers numbers(const Station& s) { return {s.across, s.deep, s.shift_deep, s.shift_across}; }

}  // namespace

double ellipsoid(const Vec& p, const Vec& center, const Vec& radii) {
  return from_ellipse<3>(p - center, radii);
}

double round_cone(const Vec& p, const Vec& a, const Vec& b, double ra, double rb) {
  // In the plane of p and the axis: x along it from a, y away from it. The cone touches both balls.
  const double length = (b - a).norm();
  const Vec axis = (b - a) / length;
  const double x = (p - a).dot(axis);
  const double y = std::sqrt(std::max(0.0, (p - a).squaredNorm() - x * x));
  const double sine = (ra - rb) / length, cosine = std::sqrt(1 - sine * sine);
  const double along = x - y * sine / cosine;  // of the foot on the axis
  if (along <= 0) return std::sqrt(x * x + y * y) - ra;
  if (along >= length) return std::sqrt((x - length) * (x - length) + y * y) - rb;
  return x * sine + y * cosine - ra;
}

double smooth_union(double a, double b, double blend) {
  const double h = std::max(blend - std::abs(a - b), 0.0);
  return std::min(a, b) - h * h / (4 * blend);
}

double smooth_intersection(double a, double b, double blend) { return -smooth_union(-a, -b, blend); }

Loft::Loft(const Vec& origin, const Vec& axis, const Vec& across, const Vec& deep,
           std::vector<Station> stations)
    : origin_(origin), axis_(axis), across_(across), deep_(deep), stations_(std::move(stations)) {}

Station Loft::section(double at) const {
  const int n = static_cast<int>(stations_.size());
  at = std::clamp(at, stations_.front().at, stations_.back().at);
  int i = 0;
  while (i + 2 < n && at > stations_[i + 1].at) ++i;
  const auto slope = [&](int j) -> Numbers {
    const Station &before = stations_[std::max(j - 1, 0)], &after = stations_[std::min(j + 1, n - 1)];
    return (numbers(after) - numbers(before)) / (after.at - before.at);
  };
  const Station &s = stations_[i], &e = stations_[i + 1];
  const double width = e.at - s.at, t = (at - s.at) / width, u = 1 - t;
  // Cubic Hermite
  const Numbers v = u * u * (1 + 2 * t) * numbers(s) + t * t * (3 - 2 * t) * numbers(e) +
                    width * t * u * (u * slope(i) - t * slope(i + 1));
  return {at, v[0], v[1], v[2], v[3]};
}

double Loft::operator()(const Vec& p) const {
  const double at = along(p);
  const Station s = section(at);
  const double side =
      from_ellipse<2>({(p - origin_).dot(across_) - s.shift_across, (p - origin_).dot(deep_) - s.shift_deep},
                      {s.across, s.deep});
  const double beyond = std::max(stations_.front().at - at, at - stations_.back().at);
  return side > 0 && beyond > 0 ? std::sqrt(side * side + beyond * beyond) : std::max(side, beyond);
}

double Loft::from_axis(const Vec& p) const {
  const double at = along(p);
  return std::sqrt(std::max(0.0, (p - origin_).squaredNorm() - at * at));
}

}  // namespace furrow::meshes
