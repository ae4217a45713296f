// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/mesh/property_names.h"
#include "geometry/quality/fold_quality.h"

namespace furrow::geometry {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr int half_window = 20;         ///< of a trend [rows]: half a width
constexpr std::size_t fewest_rows = 8;  ///< for a trend that tells anything
constexpr double least_crest = 1e-6;    ///< [m]
constexpr double normals_reach = 0.3;   ///< from the line [widths]
constexpr double flared_rise = 0.7;     ///< of the line
constexpr double varies = 0.02;

struct Mean {
  double sum = 0;
  std::size_t count = 0;
  void add(double value) { sum += value, ++count; }
  double value() const { return count ? sum / static_cast<double>(count) : unset_value; }
};

/// Calls with the rows of the window around one, and how far each is from it [windows, in [-1, 1]].
template <class Call>
void each_in_window(std::size_t rows, bool closed, std::size_t row, const Call& call) {
  const auto n = static_cast<int>(rows);
  const int reach = closed ? std::min(half_window, (n - 1) / 2) : half_window;
  for (int o = -reach; o <= reach; ++o) {
    const int j = static_cast<int>(row) + o;
    if (!closed && (j < 0 || j >= n)) continue;
    call(static_cast<std::size_t>((j % n + n) % n), static_cast<double>(o) / half_window);
  }
}

/// Of a least squares parabola through the values around a row, there; NaN: there are too few.
template <class Value>
double trend_at(std::size_t rows, bool closed, std::size_t row, const Value& value) {
  double m[5] = {0, 0, 0, 0, 0}, b[3] = {0, 0, 0};
  each_in_window(rows, closed, row, [&](std::size_t j, double x) {
    const double y = value(j);
    if (std::isnan(y)) return;
    double power = 1;
    for (int k = 0; k < 5; ++k, power *= x) {
      m[k] += power;
      if (k < 3) b[k] += power * y;
    }
  });
  if (m[0] < static_cast<double>(fewest_rows)) return unset_value;
  Eigen::Matrix3d a;
  a << m[0], m[1], m[2], m[1], m[2], m[3], m[2], m[3], m[4];
  return a.ldlt().solve(Vec3(b[0], b[1], b[2]))[0];
}

/// Along the surface: the path may run on facets below it.
double distance_to_path(const LinePath& path, const Vec3& x, const Vec3& up) {
  double least = std::numeric_limits<double>::infinity();
  Vec3 off = Vec3::Zero();
  for (const auto& [a, b] : path) {
    const Vec3 e = b - a;
    const double t = std::clamp((x - a).dot(e) / std::max(e.squaredNorm(), 1e-300), 0.0, 1.0);
    const Vec3 way = a + t * e - x;
    if (way.squaredNorm() < least) least = way.squaredNorm(), off = way;
  }
  return (off - off.dot(up) * up).norm();
}

void measure_crest(const FoldSections& cut, const LinePath& path, LineQuality& q) {
  Mean height, ripple, lateral;
  const std::size_t n = cut.along.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (std::isnan(cut.crest[i])) continue;
    height.add(cut.crest[i]);
    const double off = path.empty() ? cut.beside[i] : distance_to_path(path, cut.highest[i], cut.up[i]);
    lateral.add(off * off);
    const double trend = trend_at(n, cut.closed, i, [&](std::size_t j) { return cut.crest[j]; });
    if (!std::isnan(trend)) ripple.add((cut.crest[i] - trend) * (cut.crest[i] - trend));
  }
  q.sections = height.count;
  if (height.count < fewest_rows) {
    q.missing.push_back("the line is too short away from its ends, or no cloth lies under it");
    return;
  }
  q.crest_height = height.value();
  q.lateral = std::sqrt(lateral.value()) / cut.width;
  if (std::abs(*q.crest_height) < least_crest)
    q.missing.push_back("the line stands out nowhere");
  else
    q.crest_ripple = std::sqrt(ripple.value()) / std::abs(*q.crest_height);
}

void measure_sweep(const FoldSections& cut, LineQuality& q) {
  Mean squares;
  const std::size_t n = cut.along.size();
  for (std::size_t column = 0; column < cut.across.size(); ++column)
    for (std::size_t i = 0; i < n; ++i) {
      const auto value = [&](std::size_t j) { return cut.heights[cut.at(j, column)]; };
      if (std::isnan(value(i))) continue;
      const double trend = trend_at(n, cut.closed, i, value);
      if (!std::isnan(trend)) squares.add((value(i) - trend) * (value(i) - trend));
    }
  if (squares.count) q.sweep = std::sqrt(squares.value()) / std::abs(*q.crest_height);
}

void measure_normals(const FoldSections& cut, LineQuality& q) {
  Mean squares;
  const std::size_t n = cut.along.size();
  for (std::size_t column = 0; column < cut.across.size(); ++column) {
    if (std::abs(cut.across[column]) > normals_reach * cut.width) continue;
    if (cut.across[column] == 0) continue;  // the crest is an edge: the face is one or the other by chance
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3& normal = cut.normals[cut.at(i, column)];
      if (std::isnan(normal[0])) continue;
      Vec3 mean = Vec3::Zero();
      each_in_window(n, cut.closed, i, [&](std::size_t j, double) {
        const Vec3& other = cut.normals[cut.at(j, column)];
        if (!std::isnan(other[0])) mean += other;
      });
      const double angle = std::atan2(normal.cross(mean).norm(), normal.dot(mean));
      squares.add(angle * angle);
    }
  }
  if (squares.count) q.normals_deg = std::sqrt(squares.value()) * 180 / std::numbers::pi;
}

double section(double t, double sharpness) {
  t = std::abs(t);
  return t < 1 ? (1 - sharpness) * std::pow(1 - t * t, 2.5) + sharpness * (1 - t) : 0;
}

/// Columns of the sections, summed over their rows.
struct ColumnSums {
  std::vector<double> count, sum, squares;
};

ColumnSums sums_of(const FoldSections& cut) {
  const std::size_t m = cut.across.size();
  ColumnSums sums{std::vector<double>(m, 0), std::vector<double>(m, 0), std::vector<double>(m, 0)};
  for (std::size_t column = 0; column < m; ++column)
    for (std::size_t i = 0; i < cut.along.size(); ++i)
      if (const double u = cut.heights[cut.at(i, column)]; !std::isnan(u))
        sums.count[column] += 1, sums.sum[column] += u, sums.squares[column] += u * u;
  return sums;
}

struct Fit {
  double height = 0, mean_square = std::numeric_limits<double>::infinity();
};

/// The best k of a width.
Fit fit_of(const FoldSections& cut, const ColumnSums& sums, double width, double sharpness) {
  double up = 0, pp = 0, uu = 0, count = 0;
  for (std::size_t c = 0; c < cut.across.size(); ++c) {
    const double p = section(2 * cut.across[c] / width, sharpness);
    up += p * sums.sum[c], pp += p * p * sums.count[c], uu += sums.squares[c], count += sums.count[c];
  }
  if (!(pp > 0)) return {};
  return {up / pp, std::max(0.0, uu - up * up / pp) / count};
}

void measure_fit(const FoldSections& cut, const FoldCurve& curve, LineQuality& q) {
  const ColumnSums sums = sums_of(cut);
  const auto at = [&](double share) { return fit_of(cut, sums, share * cut.width, curve.sharpness); };
  constexpr double step = 0.02;
  double best = 1;
  for (double share = 0.3; share < 2; share += step)
    if (at(share).mean_square < at(best).mean_square) best = share;
  double from = best - step, to = best + step;
  for (int i = 0; i < 60; ++i) {
    const double a = from + (to - from) / 3, b = to - (to - from) / 3;
    (at(a).mean_square < at(b).mean_square ? to : from) = at(a).mean_square < at(b).mean_square ? b : a;
  }
  const Fit fit = at((from + to) / 2);
  if (!std::isfinite(fit.mean_square) || std::abs(fit.height) < least_crest) return;
  q.fitted_height = fit.height;
  q.fitted_width = (from + to) / 2 * cut.width;
  q.fit = std::sqrt(fit.mean_square) / std::abs(fit.height);
}

bool is_varying(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least > varies * std::max(std::abs(*most), std::abs(*least));
}

/// Why its sections are not to have one k and one w; "": they are.
std::string why_unfit(const FoldCurve& curve) {
  if (std::max(curve.rise[0], curve.rise[1]) > flared_rise * curve.length)
    return "the line flares, so that no single section fits it";
  if (is_varying(curve.height) || is_varying(curve.width))
    return "height or width of the line varies, so that no single section fits it";
  return "";
}

}  // namespace

LineQuality measure_line(const FoldSurface& surface, const FoldCurve& curve, const LinePath& path,
                         bool crest_alone) {
  LineQuality q;
  q.line = curve.line;
  q.name = curve.name;
  q.length = curve.length;
  q.width = *std::max_element(curve.width.begin(), curve.width.end());
  q.asked = *std::max_element(curve.height.begin(), curve.height.end(),
                              [](double a, double b) { return std::abs(a) < std::abs(b); });
  const FoldSections cut = cut_sections(surface, curve, crest_alone);
  measure_crest(cut, path, q);
  if (crest_alone || !q.crest_ripple) return q;
  measure_sweep(cut, q);
  measure_normals(cut, q);
  const std::string unfit = why_unfit(curve);
  if (unfit.empty())
    measure_fit(cut, curve, q);
  else
    q.missing.push_back(unfit);
  return q;
}

}  // namespace furrow::geometry
