// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/band_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace furrow::geometry {

BandCurve::BandCurve(const FoldCurve& curve, std::vector<double> h)
    : line_(curve.line), closed_(curve.closed) {
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const Point p(curve.points[i].x(), curve.points[i].y(), curve.points[i].z());
    if (!points_.empty() && p == points_.back()) continue;
    points_.push_back(p);
    h_.push_back(h[i]);
  }
  if (closed_ && points_.front() != points_.back()) {
    points_.push_back(points_.front());
    h_.push_back(h_.front());
  }
  arc_.push_back(0);
  for (std::size_t i = 1; i < points_.size(); ++i)
    arc_.push_back(arc_.back() + std::sqrt((points_[i] - points_[i - 1]).squared_length()));
}

double BandCurve::wrapped(double along) const {
  if (!closed_) return std::clamp(along, 0.0, length());
  along = std::fmod(along, length());
  if (along < 0) along += length();
  return along < length() ? along : 0;
}

double BandCurve::ahead(double from, double to) const { return closed_ ? wrapped(to - from) : to - from; }

std::size_t BandCurve::segment_at(double along) const {
  const auto next = std::upper_bound(arc_.begin(), arc_.end(), along);
  const std::ptrdiff_t i = next - arc_.begin() - 1;
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, std::ssize(arc_) - 2));
}

Point BandCurve::at(double along) const {
  const std::size_t i = segment_at(along);
  const double t = std::clamp((along - arc_[i]) / (arc_[i + 1] - arc_[i]), 0.0, 1.0);
  return points_[i] + t * (points_[i + 1] - points_[i]);
}

double BandCurve::h_at(double along) const {
  const std::size_t i = segment_at(along);
  const double t = std::clamp((along - arc_[i]) / (arc_[i + 1] - arc_[i]), 0.0, 1.0);
  return h_[i] + t * (h_[i + 1] - h_[i]);
}

BandCurve::Near BandCurve::nearest(const Point& p, std::ptrdiff_t first, std::ptrdiff_t last) const {
  const auto n = static_cast<std::ptrdiff_t>(segments());
  if (!closed_) first = std::max<std::ptrdiff_t>(first, 0), last = std::min(last, n - 1);
  if (closed_ && last - first >= n) last = first + n - 1;
  Near best{0, std::numeric_limits<double>::infinity()};
  for (std::ptrdiff_t k = first; k <= last; ++k) {
    const std::ptrdiff_t i = ((k % n) + n) % n;
    const Vector along = points_[i + 1] - points_[i];
    const double t = std::clamp(((p - points_[i]) * along) / along.squared_length(), 0.0, 1.0);
    const double d = std::sqrt((p - (points_[i] + t * along)).squared_length());
    if (d < best.distance) best = {arc_[i] + t * (arc_[i + 1] - arc_[i]), d};
  }
  best.along = wrapped(best.along);
  return best;
}

BandCurve::Near BandCurve::nearest(const Point& p, double along, double span) const {
  const auto n = static_cast<std::ptrdiff_t>(segments());
  const auto index = [&](double s) {
    if (!closed_) return static_cast<std::ptrdiff_t>(segment_at(std::clamp(s, 0.0, length())));
    const double turns = std::floor(s / length());
    return static_cast<std::ptrdiff_t>(turns) * n + static_cast<std::ptrdiff_t>(segment_at(wrapped(s)));
  };
  return nearest(p, index(along - span), index(along + span));
}

}  // namespace furrow::geometry
