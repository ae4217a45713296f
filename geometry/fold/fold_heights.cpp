// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/fold_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

using Vec3 = Eigen::Vector3d;
constexpr std::size_t block_size = 16;
constexpr double narrowest = 0.6;                      ///< width at a free end, in that of the fold
constexpr double beyond_border = 0.6;                  ///< in widths
constexpr double detour = 1.25;                        ///< way over distance that a curved surface explains
constexpr double whole_pass = 1.25, pass_ends = 1.75;  ///< in half widths along the curve
constexpr double next_pass = 2.75, clear_pass = 3.75;  ///< the same: from there on it is another one
constexpr double highest_of_passes = 8;                ///< (a^p + b^p)^(1/p)
constexpr double fading = 0.5;  ///< in half widths: way beyond that in which a fold fades out

/// 0 up to t = 0, 1 from t = 1 on, with two derivatives.
double smoothstep(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (10 + t * (6 * t - 15));
}

/// (1 - q)^2, q = r^2 / R^2, 0 beyond R.
double bump(double squared_distance, double radius) {
  const double q = squared_distance / (radius * radius);
  return q < 1 ? (1 - q) * (1 - q) : 0;
}

double distance_to_segment(const Vec3& x, const Vec3& a, const Vec3& b, double& t) {
  const Vec3 e = b - a;
  t = std::clamp((x - a).dot(e) / std::max(e.squaredNorm(), 1e-300), 0.0, 1.0);
  return (a + t * e - x).norm();
}

}  // namespace

FoldHeight::FoldHeight(const FoldCurve& curve)
    : arc_(curve.arc),
      heights_(curve.height),
      length_(curve.length),
      sharpness_(curve.sharpness),
      rise_(curve.rise),
      closed_(curve.closed),
      meets_itself_(!curve.cuts.empty()) {
  greatest_width_ = *std::max_element(curve.width.begin(), curve.width.end());
  const std::size_t n = curve.points.size();
  const double ds = length_ / static_cast<double>(closed_ ? n : n - 1);
  step_ = ds;
  if (curve.begins_at_border) extend(curve, false, ds);
  before_ = places_.size();
  own_ = n;
  for (std::size_t i = 0; i < n; ++i) {
    const bool free_end =
        !closed_ && ((i == 0 && !curve.begins_at_border) || (i + 1 == n && !curve.ends_at_border));
    add(curve, curve.points[i], i, free_end ? ds / 2 : ds);
  }
  if (curve.ends_at_border) extend(curve, true, ds);
  divide_by_crest(curve);
  make_blocks();
  reach_height();
}

/// A line so short that T is below 1 on most of its width would stay below its height: the highest place of
/// its crest is taken to it.
void FoldHeight::reach_height() {
  double most = 0;
  for (const Place& place : places_) {
    physics::throw_if_cancelled("wrinkle");
    if (place.height == 0) continue;
    const double asked = place.height / std::max(place.taper, 1e-300);
    most = std::max(most, (meets_itself_ ? passes_at(place.point) : sum_at(place.point)) / asked);
  }
  if (!(most > 0) || most >= 1) return;
  for (Place& place : places_) place.weight /= most;
}

double FoldHeight::rise(double along) const {
  double t = 1;
  if (rise_[0] > 0) t *= smoothstep(along / rise_[0]);
  if (rise_[1] > 0) t *= smoothstep((length_ - along) / rise_[1]);
  return t;
}

double FoldHeight::taper_at(double along) const { return rise(along); }

double FoldHeight::height_at(double along) const {
  const auto next =
      static_cast<std::size_t>(std::lower_bound(arc_.begin(), arc_.end(), along) - arc_.begin());
  if (next == 0) return heights_.front();
  if (next == arc_.size()) return heights_.back();
  const double t = (along - arc_[next - 1]) / (arc_[next] - arc_[next - 1]);
  return (1 - t) * heights_[next - 1] + t * heights_[next];
}

void FoldHeight::add(const FoldCurve& curve, const Vec3& point, std::size_t i, double ds) {
  const double t = rise(curve.arc[i]);
  const double radius = curve.width[i] * (narrowest + (1 - narrowest) * t) / 2;
  places_.push_back({point, radius, curve.height[i] * t, t, 15 / (16 * radius) * ds});
}

void FoldHeight::extend(const FoldCurve& curve, bool at_end, double ds) {
  const std::size_t n = curve.points.size(), i = at_end ? n - 1 : 0, inner = at_end ? n - 2 : 1;
  const Vec3 step = ds * (curve.points[i] - curve.points[inner]).normalized();
  const auto steps = static_cast<int>(std::ceil(beyond_border * curve.width[i] / ds));
  for (int k = 1; k <= steps; ++k) {
    const int far = at_end ? k : steps + 1 - k;  // in the order of the curve
    add(curve, curve.points[i] + far * step, i, ds);
  }
}

/// N of each place: the curve, extended at free ends, too, raised by 1.
void FoldHeight::divide_by_crest(const FoldCurve& curve) {
  struct Weight {
    Vec3 point;
    double radius, weight;
  };
  std::vector<Weight> all;
  const std::size_t n = curve.points.size();
  const double ds = length_ / static_cast<double>(closed_ ? n : n - 1);
  for (const Place& p : places_) all.push_back({p.point, p.radius, 15 / (16 * p.radius) * ds});
  for (const bool at_end : {false, true}) {
    if (closed_ || (at_end ? curve.ends_at_border : curve.begins_at_border)) continue;
    const Place& end = at_end ? places_.back() : places_.front();
    const Vec3 step =
        ds *
        (at_end ? curve.points[n - 1] - curve.points[n - 2] : curve.points[0] - curve.points[1]).normalized();
    for (int k = 1; k * ds < end.radius; ++k)
      all.push_back({end.point + k * step, end.radius, 15 / (16 * end.radius) * ds});
  }
  std::vector<double> crest(places_.size(), 0);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    physics::throw_if_cancelled("wrinkle");
    for (std::size_t j = 0; j < all.size(); ++j) {
      const double near = bump((all[j].point - places_[i].point).squaredNorm(), all[j].radius);
      if (near == 0) continue;
      const double share = meets_itself_ && j < places_.size() ? share_of_pass(i, j) : 1;
      crest[i] += share * all[j].weight * near;
    }
  }
  // Beyond a border the extension ends, too: it takes the integral at the border.
  const std::size_t first = before_, last = before_ + n - 1;
  for (std::size_t i = 0; i < places_.size(); ++i)
    places_[i].weight *= places_[i].height / crest[std::clamp(i, first, last)];
}

void FoldHeight::make_blocks() {
  for (std::size_t first = 0; first < places_.size(); first += block_size) {
    const std::size_t last = std::min(first + block_size, places_.size());
    Vec3 centre = Vec3::Zero();
    for (std::size_t i = first; i < last; ++i) centre += places_[i].point / static_cast<double>(last - first);
    double reach = 0;
    for (std::size_t i = first; i < last; ++i)
      reach = std::max(reach, (places_[i].point - centre).norm() + places_[i].radius);
    double spread = 0;
    for (std::size_t i = first; i <= last; ++i)
      spread = std::max(spread, (places_[i % places_.size()].point - centre).norm());
    blocks_.push_back({centre, reach, spread});
  }
}

/// Of the curve itself, without what goes on beyond a border.
FoldHeight::Nearest FoldHeight::nearest(const Vec3& x) const {
  Nearest best{std::numeric_limits<double>::infinity(), 0};
  const std::size_t end = before_ + own_, segments_end = closed_ ? end : end - 1;
  for (std::size_t b = before_ / block_size; b * block_size < segments_end; ++b) {
    if ((x - blocks_[b].centre).norm() - blocks_[b].spread >= best.distance) continue;
    const std::size_t last = std::min((b + 1) * block_size, segments_end);
    for (std::size_t i = std::max(before_, b * block_size); i < last; ++i) {
      const Place &from = places_[i], &to = places_[i + 1 < end ? i + 1 : before_];
      double t = 0;
      const double distance = distance_to_segment(x, from.point, to.point, t);
      if (distance < best.distance) best = {distance, (1 - t) * from.radius + t * to.radius};
    }
  }
  return best;
}

double FoldHeight::reach() const { return detour * (1 + fading) * greatest_width_ / 2; }

double FoldHeight::share_at(const Vec3& x, double way) const {
  const Nearest near = nearest(x);
  return 1 - smoothstep((way / detour - near.distance) / (fading * near.radius));
}

double FoldHeight::tent(const Vec3& x) const {
  double least = std::numeric_limits<double>::infinity(), height = 0;
  const std::size_t n = places_.size();
  for (std::size_t i = 0; i + (closed_ ? 0 : 1) < n; ++i) {
    const Place &a = places_[i], &b = places_[(i + 1) % n];
    double t = 0;
    const double distance = distance_to_segment(x, a.point, b.point, t);
    if (distance >= least) continue;
    least = distance;
    const double radius = (1 - t) * a.radius + t * b.radius;
    height = ((1 - t) * a.height + t * b.height) * std::max(0.0, 1 - distance / radius);
  }
  return height;
}

double FoldHeight::sum_at(const Vec3& x) const {
  double sum = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if ((x - blocks_[b].centre).squaredNorm() >= blocks_[b].reach * blocks_[b].reach) continue;
    const std::size_t last = std::min((b + 1) * block_size, places_.size());
    for (std::size_t i = b * block_size; i < last; ++i)
      sum += places_[i].weight * bump((x - places_[i].point).squaredNorm(), places_[i].radius);
  }
  return sum;
}

/// The way along the curve between two places.
double FoldHeight::way_between(std::size_t i, std::size_t j) const {
  const double way = step_ * std::abs(static_cast<double>(i) - static_cast<double>(j));
  return closed_ ? std::min(way, length_ - way) : way;
}

/// How much place `of` belongs to the pass of place i: 1 near it along the curve, 0 far from it.
double FoldHeight::share_of_pass(std::size_t i, std::size_t of) const {
  const double radius = std::max(places_[i].radius, places_[of].radius);
  return 1 - smoothstep((way_between(i, of) / radius - whole_pass) / (pass_ends - whole_pass));
}

/// Of each term the sum over its pass. Cost: O(terms) for each of the places within a pass.
std::vector<double> FoldHeight::passes_of(const std::vector<Term>& terms) const {
  double widest = 0;
  for (const Term& term : terms) widest = std::max(widest, places_[term.first].radius);
  const auto n = static_cast<std::ptrdiff_t>(places_.size()),
             reach = static_cast<std::ptrdiff_t>(std::min(pass_ends * widest / step_ + 2, double(n)));
  const auto from = [&](std::ptrdiff_t i) {
    const Term first{static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, n)), 0};
    return std::lower_bound(terms.begin(), terms.end(), first,
                            [](const Term& a, const Term& b) { return a.first < b.first; });
  };
  std::vector<double> passes;
  for (const Term& term : terms) {
    const auto i = static_cast<std::ptrdiff_t>(term.first);
    double sum = 0;
    const auto add = [&](auto begin, auto end) {
      for (auto of = begin; of < end; ++of) sum += share_of_pass(term.first, of->first) * of->second;
    };
    const auto begin = from(i - reach), end = from(i + reach + 1);
    if (closed_) add(terms.begin(), std::min(begin, from(i + reach + 1 - n)));
    add(begin, end);
    if (closed_) add(std::max(end, from(i - reach + n)), terms.end());
    passes.push_back(sum);
  }
  return passes;
}

/// Of a curve that meets itself: the integral over the highest pass, joined with that over the highest of the
/// others. Passes come and go smoothly with x, as all places have shares in all passes.
double FoldHeight::passes_at(const Vec3& x) const {
  std::vector<Term> terms;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if ((x - blocks_[b].centre).squaredNorm() >= blocks_[b].reach * blocks_[b].reach) continue;
    const std::size_t last = std::min((b + 1) * block_size, places_.size());
    for (std::size_t i = b * block_size; i < last; ++i) {
      const double term = places_[i].weight * bump((x - places_[i].point).squaredNorm(), places_[i].radius);
      if (term != 0) terms.push_back({i, term});
    }
  }
  const std::vector<double> passes = passes_of(terms);
  if (passes.empty()) return 0;
  const auto higher = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto top =
      static_cast<std::size_t>(std::max_element(passes.begin(), passes.end(), higher) - passes.begin());
  double second = 0;
  for (std::size_t k = 0; k < passes.size(); ++k) {
    const double way = way_between(terms[k].first, terms[top].first);
    const double radius = places_[terms[top].first].radius;
    const double apart = smoothstep((way / radius - next_pass) / (clear_pass - next_pass));
    second = std::max(second, apart * passes[k] / passes[top]);
  }
  return passes[top] * std::pow(1 + std::pow(second, highest_of_passes), 1 / highest_of_passes);
}

double FoldHeight::at(const Vec3& x) const {
  const double sum = meets_itself_ ? passes_at(x) : sum_at(x);
  return sharpness_ > 0 ? (1 - sharpness_) * sum + sharpness_ * tent(x) : sum;
}

double joined_heights(std::span<const double> heights) {
  constexpr double p = 1.7095112913514547;  // 2^(1/p) = 3/2
  double joined = 0;
  for (const double sign : {1.0, -1.0}) {
    double largest = 0, sum = 0;
    for (double h : heights) largest = std::max(largest, sign * h);
    if (!(largest > 0)) continue;
    for (double h : heights)
      if (sign * h > 0) sum += std::pow(sign * h / largest, p);
    joined += sign * largest * std::pow(sum, 1 / p);
  }
  return joined;
}

}  // namespace furrow::geometry
