// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/curve_cuts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "geometry/stroke/walk_surface.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr double touching = 0.03;          ///< in widths: nearer than that, vertices on one are on the other
constexpr double least_loop = 0.25;        ///< in widths, along the curve: what is nearer only bends
constexpr double small_loop = 0.5;         ///< in widths, along the curve
constexpr std::size_t most_meetings = 50;  ///< of a segment, in the mean

/// Two segments of a curve that meet, the first before the second.
struct Meeting {
  std::size_t from, to;
  bool crossing;  ///< or nearly touching
};

/// The distance of two segments.
double segment_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm(), uw = u.dot(w), vw = v.dot(w);
  const double det = uu * vv - uv * uv;
  const double s = det > 1e-12 * uu * vv ? std::clamp((uv * vw - vv * uw) / det, 0.0, 1.0) : 0;
  const double t = std::clamp((uv * s + vw) / std::max(vv, 1e-300), 0.0, 1.0);
  const double r = std::clamp((uv * t - uw) / std::max(uu, 1e-300), 0.0, 1.0);
  return (w + r * u - t * v).norm();
}

/// Whether two segments cross in the plane across `normal`.
bool cross_in_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& normal) {
  const auto side = [&](const Vec3& p, const Vec3& q, const Vec3& x) {
    return (q - p).cross(x - p).dot(normal);
  };
  const bool first = (side(a, b, c) < 0) != (side(a, b, d) < 0);
  return first && (side(c, d, a) < 0) != (side(c, d, b) < 0);
}

class Meetings {
 public:
  Meetings(const Mesh& mesh, const FoldCurve& curve)
      : mesh_(mesh), curve_(curve), segments_(curve.points.size() - (curve.closed ? 0 : 1)) {
    for (std::size_t i = 0; i < segments_; ++i) longest_ = std::max(longest_, (end(i) - begin(i)).norm());
  }

  /// Of a closed curve, counted from its first point. Segments far from each other are stepped over.
  std::vector<Meeting> find() const {
    std::vector<Meeting> meetings;
    for (std::size_t i = 0; i + 2 < segments_; ++i) {
      physics::throw_if_cancelled("wrinkle");
      for (std::size_t j = i + 2; j < segments_;) {
        const double reach = touching * width(i) + 2 * longest_;
        const double apart = (begin(j) - begin(i)).norm() - reach;
        if (apart > 0) {
          j += std::max<std::size_t>(1, static_cast<std::size_t>(apart / longest_));
          continue;
        }
        if (const auto meeting = meet(i, j)) meetings.push_back(*meeting);
        if (meetings.size() > most_meetings * segments_)
          throw ContentError("stroke \"" + curve_.name +
                             "\": it meets itself again and again; draw it in parts");
        ++j;
      }
    }
    return meetings;
  }

 private:
  const Vec3& begin(std::size_t i) const { return curve_.points[i]; }
  const Vec3& end(std::size_t i) const { return curve_.points[(i + 1) % curve_.points.size()]; }
  double width(std::size_t i) const { return curve_.width[i]; }

  std::optional<Meeting> meet(std::size_t i, std::size_t j) const {
    if (curve_.closed && i == 0 && j + 1 == segments_) return std::nullopt;  // neighbours
    const double distance = segment_distance(begin(i), end(i), begin(j), end(j));
    if (distance > touching * width(i)) return std::nullopt;
    const Vector n = area_normal_of(mesh_, curve_.places[i].face),
                 m = area_normal_of(mesh_, curve_.places[j].face);
    if (!(n * m > 0)) return std::nullopt;
    const bool crossing = cross_in_plane(begin(i), end(i), begin(j), end(j), Vec3(n.x(), n.y(), n.z()));
    double way = curve_.arc[j] - curve_.arc[i];
    if (curve_.closed) way = std::min(way, curve_.length - way);
    if (!crossing && way < least_loop * width(i)) return std::nullopt;
    return on_one_layer(i, j) ? std::optional(Meeting{i, j, crossing}) : std::nullopt;
  }

  bool on_one_layer(std::size_t i, std::size_t j) const {
    const Face from = curve_.places[i].face, to = curve_.places[j].face;
    if (from == to) return true;
    const Vec3& p = begin(i);
    const auto near =
        faces_reachable_within(mesh_, from, Point(p.x(), p.y(), p.z()), touching * width(i) + 2 * longest_);
    return std::find(near.begin(), near.end(), to) != near.end();
  }

  const Mesh& mesh_;
  const FoldCurve& curve_;
  const std::size_t segments_;
  double longest_ = 0;
};

/// The middle of the widest gap between visits, within two of them.
std::size_t middle_of_gap(const std::vector<std::size_t>& visits, std::size_t from, std::size_t to) {
  std::size_t best = (from + to + 1) / 2, widest = 0, last = from;
  for (auto next = std::upper_bound(visits.begin(), visits.end(), from); next != visits.end(); ++next) {
    const std::size_t until = std::min(*next, to);
    if (until - last > widest) widest = until - last, best = (last + until + 1) / 2;
    if (until == to) break;
    last = until;
  }
  return best;
}

/// Cuts between the two visits of each pair, as few as one after the other allows; ascending.
std::vector<std::size_t> cuts_between(std::vector<std::pair<std::size_t, std::size_t>> pairs) {
  std::vector<std::size_t> visits, cuts;
  for (const auto& [a, b] : pairs) visits.push_back(a), visits.push_back(b);
  std::sort(visits.begin(), visits.end());
  std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) {
    return std::pair(a.second, a.first) < std::pair(b.second, b.first);
  });
  for (const auto& [a, b] : pairs) {
    const bool between =
        std::any_of(cuts.begin(), cuts.end(), [&, a = a, b = b](std::size_t c) { return a < c && c <= b; });
    if (!between) cuts.push_back(middle_of_gap(visits, a, b));
  }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

}  // namespace

std::size_t drop_small_loops(const Mesh& mesh, FoldCurve& curve) {
  std::vector<bool> gone(curve.points.size(), false);
  std::size_t until = 0;
  for (const Meeting& m : Meetings(mesh, curve).find()) {
    if (!m.crossing || m.from < until ||
        curve.arc[m.to] - curve.arc[m.from] > small_loop * curve.width[m.from])
      continue;
    std::fill(gone.begin() + m.from + 1, gone.begin() + m.to + 1, true);
    until = m.to;
  }
  std::size_t left = 0;
  for (std::size_t i = 0; i < gone.size(); ++i) {
    if (gone[i]) continue;
    curve.points[left] = curve.points[i];
    curve.places[left] = curve.places[i];
    curve.width[left] = curve.width[i];
    curve.height[left++] = curve.height[i];
  }
  curve.points.resize(left), curve.width.resize(left), curve.height.resize(left);
  curve.places.erase(curve.places.begin() + static_cast<std::ptrdiff_t>(left), curve.places.end());
  return gone.size() - left;
}

void cut_where_it_meets_itself(const Mesh& mesh, FoldCurve& curve) {
  curve.cuts.clear();
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::vector<std::size_t> visits;
  for (const Meeting& m : Meetings(mesh, curve).find()) {
    pairs.push_back({m.from, m.to});
    visits.push_back(m.from), visits.push_back(m.to);
  }
  if (pairs.empty()) return;
  const std::size_t n = curve.points.size();
  std::size_t first = 0;
  if (curve.closed) {  // opened at the middle of the widest gap, the one over the first point among them
    std::sort(visits.begin(), visits.end());
    std::vector<std::size_t> wrapped = visits;
    for (std::size_t v : visits) wrapped.push_back(v + n);
    first = middle_of_gap(wrapped, visits.front(), visits.front() + n) % n;
    for (auto& [a, b] : pairs) {
      a = (a + n - first) % n, b = (b + n - first) % n;
      if (a > b) std::swap(a, b);
    }
  }
  for (std::size_t cut : cuts_between(std::move(pairs))) curve.cuts.push_back((cut + first) % n);
  if (curve.closed) curve.cuts.insert(curve.cuts.begin(), first);
}

}  // namespace furrow::geometry
