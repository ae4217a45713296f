// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/limb_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace furrow::geometry {
namespace {

constexpr double half_pi = std::numbers::pi / 2;

/// A slice between slices; above and below them the last one.
struct Slice {
  const TrunkOutline *below, *above;
  double share;
  double x() const { return below->centre[0] + share * (above->centre[0] - below->centre[0]); }
  double z() const { return below->centre[1] + share * (above->centre[1] - below->centre[1]); }
  double towards(double angle) const {
    const double r = below->towards(angle);
    return r + share * (above->towards(angle) - r);
  }
};

Slice slice_at(std::span<const TrunkOutline> slices, double y) {
  const auto above = std::lower_bound(slices.begin(), slices.end(), y,
                                      [](const TrunkOutline& o, double height) { return o.height < height; });
  if (above == slices.begin()) return {&*above, &*above, 0};
  if (above == slices.end()) return {&slices.back(), &slices.back(), 0};
  const TrunkOutline& below = *(above - 1);
  return {&below, &*above, (y - below.height) / (above->height - below.height)};
}

/// As far off the skin as it was; what lies inside keeps its share of the radius.
double off_skin(double r, double skin_from, double skin_to) {
  return r > skin_from ? r + skin_to - skin_from : skin_from > 0 ? r * skin_to / skin_from : r;
}

Point between_slices(const Point& p, const Slice& a, const Slice& b, double y) {
  const double x = p.x() - a.x(), z = p.z() - a.z(), r = std::hypot(x, z);
  if (!(r > 0)) return Point(b.x(), y, b.z());
  const double angle = std::atan2(z, x), scale = off_skin(r, a.towards(angle), b.towards(angle)) / r;
  return Point(b.x() + scale * x, y, b.z() + scale * z);
}

double off_slice(const Point& p, const Slice& s) {
  const double x = p.x() - s.x(), z = p.z() - s.z();
  return std::hypot(x, z) - s.towards(std::atan2(z, x));
}

/// The ring at so far along an arm; beyond the ends the last one, moved along the axis.
ArmRing ring_at(const Arm& arm, double along) {
  const auto& rings = arm.rings;
  const auto beyond = [&](const ArmRing& r) {
    return ArmRing{along, r.centre + (along - r.along) * arm.axis, r.radius};
  };
  if (along <= rings.front().along) return beyond(rings.front());
  if (along >= rings.back().along) return beyond(rings.back());
  const auto above = std::lower_bound(rings.begin(), rings.end(), along,
                                      [](const ArmRing& r, double at) { return r.along < at; });
  const ArmRing &a = *(above - 1), &b = *above;
  const double t = (along - a.along) / (b.along - a.along);
  return {along, a.centre + t * (b.centre - a.centre), a.radius + t * (b.radius - a.radius)};
}

double along_arm(const Arm& arm, const Point& p) { return (p - arm.rings.front().centre) * arm.axis; }

/// By the shortest way from one direction of length 1 to another.
Vector turned(const Vector& v, const Vector& from, const Vector& to) {
  const Vector axis = CGAL::cross_product(from, to);
  const double cosine = from * to, squared = axis.squared_length();
  if (squared < 1e-24) return v;
  // Rodrigues' formula, with the axis not of length 1.
  return cosine * v + CGAL::cross_product(axis, v) + (1 - cosine) / squared * (axis * v) * axis;
}

double at_share(double t, double a, double b) { return a + std::clamp(t, 0.0, 1.0) * (b - a); }

}  // namespace

int nearest_part(const Skeleton& body, const Point& p) {
  int nearest = 0;
  double least = off_slice(p, slice_at(body.trunk, std::max(p.y(), body.crotch)));
  const double middle = body.trunk.front().centre[0];
  if (p.y() < body.crotch) {
    const int side = p.x() >= middle ? 0 : 1;
    nearest = leg_part(side);
    least = off_slice(p, slice_at(body.legs[std::size_t(side)].slices, p.y()));
  }
  for (int side = 0; side < 2; ++side) {
    const auto& arm = body.arms[std::size_t(side)];
    if (!arm || (p.x() - middle) * (side ? -1 : 1) <= 0) continue;
    const double along = along_arm(*arm, p);
    if (along < 0) continue;
    const ArmRing ring = ring_at(*arm, along);
    const double off = std::sqrt((p - ring.centre).squared_length()) - ring.radius;
    if (off < least) least = off, nearest = arm_part(side);
  }
  return nearest;
}

PartMaps::PartMaps(const Skeleton& from, const Skeleton& to) : from_(from), to_(to) {
  heights_ = {{{from.low, to.low},
               {from.crotch, to.crotch},
               {from.waist, to.waist},
               {from.armpits, to.armpits},
               {from.shoulders, to.shoulders},
               {from.high, to.high}}};
}

double PartMaps::height_to(double y) const {
  if (y <= heights_.front().from) return heights_.front().to + (y - heights_.front().from);
  for (std::size_t i = 1; i < heights_.size(); ++i) {
    const Pair &a = heights_[i - 1], &b = heights_[i];
    if (y <= b.from && b.from > a.from) return a.to + (y - a.from) / (b.from - a.from) * (b.to - a.to);
  }
  return heights_.back().to + (y - heights_.back().from);
}

Point PartMaps::moved(int part, const Point& p) const {
  for (int side = 0; side < 2; ++side) {
    if (part == leg_part(side)) return on_leg(side, p);
    if (part == arm_part(side) && from_.arms[std::size_t(side)] && to_.arms[std::size_t(side)])
      return on_arm(side, p);
  }
  return on_trunk(p);
}

Point PartMaps::on_trunk(const Point& p) const {
  const double y = height_to(p.y()), begins = (from_.waist + from_.armpits) / 2;
  if (p.y() >= from_.armpits) return on_shoulders(p);
  const Point low = between_slices(p, slice_at(from_.trunk, p.y()), slice_at(to_.trunk, y), y);
  if (p.y() <= begins) return low;
  const double t = (p.y() - begins) / (from_.armpits - begins);
  return low + t * (on_shoulders(p) - low);
}

/// Breadth and depth scaled: by those of the armpits' slice, of the shoulders, of the neck, and between them.
Point PartMaps::on_shoulders(const Point& p) const {
  const auto depth = [](const TrunkOutline& o) { return o.towards(half_pi) + o.towards(-half_pi); };
  const auto broad = [](const TrunkOutline& o) { return o.towards(0) + o.towards(2 * half_pi); };
  const TrunkOutline &a = from_.trunk.back(), &b = to_.trunk.back();
  const TrunkOutline &c = from_.neck_slice, &d = to_.neck_slice;
  const double up = (p.y() - from_.armpits) / (from_.shoulders - from_.armpits),
               on = (p.y() - from_.shoulders) / (from_.neck - from_.shoulders),
               all = (p.y() - from_.armpits) / (from_.neck - from_.armpits);
  const double shoulders = to_.shoulder_half / from_.shoulder_half;
  const double scale_x =
      on > 0 ? at_share(on, shoulders, broad(d) / broad(c)) : at_share(up, broad(b) / broad(a), shoulders);
  const double scale_z = at_share(all, depth(b) / depth(a), depth(d) / depth(c));
  return Point(
      at_share(all, b.centre[0], d.centre[0]) + scale_x * (p.x() - at_share(all, a.centre[0], c.centre[0])),
      height_to(p.y()),
      at_share(all, b.centre[1], d.centre[1]) + scale_z * (p.z() - at_share(all, a.centre[1], c.centre[1])));
}

Point PartMaps::on_arm(int side, const Point& p) const {
  const Arm &a = *from_.arms[std::size_t(side)], &b = *to_.arms[std::size_t(side)];
  const double along = along_arm(a, p), along_to = along * b.length / a.length;
  const ArmRing ring = ring_at(a, along), ring_to = ring_at(b, along_to);
  const Vector across = p - ring.centre;
  const double r = std::sqrt(across.squared_length());
  if (!(r > 0)) return ring_to.centre;
  return ring_to.centre + off_skin(r, ring.radius, ring_to.radius) / r * turned(across, a.axis, b.axis);
}

Point PartMaps::on_leg(int side, const Point& p) const {
  const double y = height_to(p.y());
  return between_slices(p, slice_at(from_.legs[std::size_t(side)].slices, p.y()),
                        slice_at(to_.legs[std::size_t(side)].slices, y), y);
}

}  // namespace furrow::geometry
