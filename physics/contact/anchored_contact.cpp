// SPDX-License-Identifier: MIT
#include "physics/contact/anchored_contact.h"

#include <algorithm>
#include <cmath>

#include "physics/base/require.h"
#include "physics/contact/soft_push.h"

namespace furrow::physics {
namespace {

/// work(i) of all i in [0, n), by the pool's threads where there is one.
template <class Work>
void for_all(ThreadPool* pool, std::size_t n, const Work& work) {
  const auto range = [&](int begin, int end) {
    for (int i = begin; i < end; ++i) work(std::size_t(i));
  };
  if (pool)
    pool->run(int(n), range);
  else
    range(0, int(n));
}

}  // namespace

AnchoredContact::AnchoredContact(const Collider& collider, const AnchoredContactOptions& options,
                                 std::size_t particles)
    : collider_(collider),
      options_(options),
      soft_(std::min(options.gap / 3, 1e-3)),
      slip_(0.1 * soft_),
      touches_(particles) {
  const char* const operation = "AnchoredContact";
  require(operation, "friction", options.friction, options.friction >= 0, ">= 0");
  require(operation, "gap", options.gap, options.gap > 0, "> 0");
  require(operation, "stiffness", options.stiffness, options.stiffness > 0, "> 0");
}

double AnchoredContact::depth_of(double force) const {
  const double k = options_.stiffness, s = soft_;
  return force < 0.5 * k * s ? std::sqrt(2 * force * s / k) : force / k + 0.5 * s;
}

Vec3 AnchoredContact::in_frame(const Vec3& x) const { return place_ ? place_->to_body(x) : x; }

void AnchoredContact::look(std::span<const Vec3> x, std::span<const double> inv_mass, ThreadPool* pool) {
  for_all(pool, x.size(), [&](std::size_t i) {
    Touch& t = touches_[i];
    t.x = in_frame(x[i]);
    t.energy = t.push = t.stiffness = 0;
    if (!(inv_mass[i] > 0) || is_beyond(i, t.x, options_.gap)) return;
    const SignedDistance field = collider_.smooth_at(t.x);
    if (keeps_levels_) know_level(i, t.x, field.value);
    const double slope = field.gradient.norm();
    const double depth = options_.gap - t.nearer - field.value;
    const SoftPush push = soft_push(depth, options_.stiffness, soft_);
    t.energy = push.energy;
    if (!(push.force > 0) || !(slope > 0)) return;
    t.push = push.force * slope;
    t.stiffness = push.stiffness * slope * slope;
    t.normal = field.gradient / slope;
    t.depth = depth;
    t.slope = slope;
  });
}

void AnchoredContact::forget_levels() {
  keeps_levels_ = true;
  for (Touch& t : touches_) t.level = -std::numeric_limits<double>::infinity();
}

void AnchoredContact::know_level(std::size_t i, const Vec3& x, double level) {
  touches_[i].asked = x;
  touches_[i].level = level;
}

double AnchoredContact::energy() const {
  double sum = 0;
  for (const Touch& t : touches_) {
    sum += t.energy;
    if (t.limit < 0) continue;
    const double u = t.way().norm();
    sum += t.limit * (u <= slip_ ? 0.5 * u * u / slip_ : u - 0.5 * slip_);
  }
  return sum;
}

Vec3 AnchoredContact::force_of(const Touch& t) const {
  Vec3 force = Vec3::Zero();
  if (t.push > 0) force += t.push * t.normal;
  if (t.limit < 0) return force;
  const Vec3 u = t.way();
  return force - t.limit / std::max(slip_, u.norm()) * u;
}

void AnchoredContact::add_forces(std::span<Vec3> force) const {
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    const Touch& t = touches_[i];
    if (place_) {
      force[i] += place_->rotation * force_of(t);
      continue;
    }
    if (t.push > 0) force[i] += t.push * t.normal;
    if (t.limit < 0) continue;
    const Vec3 u = t.way();
    force[i] -= t.limit / std::max(slip_, u.norm()) * u;
  }
}

void AnchoredContact::add_stiffness(FreeStiffness& stiffness, SlipStiffness of_slip) const {
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    const Touch& t = touches_[i];
    if (!(t.push > 0) && t.limit < 0) continue;
    Mat3 block = t.stiffness * t.normal * t.normal.transpose();
    if (t.limit >= 0) {
      const Vec3 u = t.way();
      const double length = u.norm();
      Mat3 along = Mat3::Identity() - t.plane * t.plane.transpose();
      // A sliding particle goes on sliding: nothing holds it back along its way.
      const bool slides = length > slip_ || (t.slides && length > 0);
      if (slides && of_slip == SlipStiffness::none) along -= u * u.transpose() / (length * length);
      block += t.limit / std::max(slip_, length) * along;
    }
    if (place_) block = place_->rotation * block * place_->rotation.transpose();
    stiffness.add(int(i), block);
  }
}

void AnchoredContact::expect(std::span<const Vec3> move, bool) {
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    Touch& t = touches_[i];
    if (t.limit < 0) continue;
    const double outwards = t.normal.dot(place_ ? Vec3(place_->rotation.transpose() * move[i]) : move[i]);
    t.limit = options_.friction * std::max(0.0, t.push - t.stiffness * outwards);
  }
}

void AnchoredContact::relimit() {
  for (Touch& t : touches_)
    if (t.limit >= 0) t.limit = options_.friction * t.push;
}

void AnchoredContact::move_anchors(std::span<const Vec3>) {
  for (Touch& t : touches_) {
    if (!(t.push > 0)) {
      t.limit = -1;
      t.slides = false;
      continue;
    }
    if (t.limit < 0) t.anchor = t.x;
    t.limit = options_.friction * t.push;
    t.plane = t.normal;
    const Vec3 u = t.way();
    const double length = u.norm();
    t.slides = length > slip_;
    t.anchor = t.x - (t.slides ? slip_ / length : 1.0) * u;
  }
}

void AnchoredContact::carry_anchors(const std::function<Vec3(const Vec3&)>& way) {
  for (Touch& t : touches_)
    if (t.limit >= 0) t.anchor += way(t.anchor);
}

bool AnchoredContact::hold_new(const StageStart& start, std::span<const Vec3>) {
  bool found = false;
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    Touch& t = touches_[i];
    if (!(t.push > 0) || t.limit >= 0) continue;
    t.anchor = start.on_body[i];
    t.plane = t.normal;
    t.limit = options_.friction * t.push;
    t.slides = false;
    found = true;
  }
  return found;
}

void AnchoredContact::let_in(std::span<const Vec3> force, std::span<const char> begins) {
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    Touch& t = touches_[i];
    if (!(t.push > 0) || !begins[i]) continue;
    const Vec3 f = place_ ? Vec3(place_->rotation.transpose() * force[i]) : force[i];
    const double push = std::max(0.0, -t.normal.dot(f));
    if (t.push > push) t.nearer += t.depth - depth_of(push / t.slope);
  }
}

std::vector<Vec3> AnchoredContact::lead_out(double by) {
  std::vector<Vec3> ways(touches_.size(), Vec3::Zero());
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    Touch& t = touches_[i];
    const double rise = std::min(by, t.nearer);
    if (!(rise > 0)) continue;
    t.nearer -= rise;
    const SignedDistance here = collider_.smooth_at(t.x);
    const Vec3 way = rise / here.gradient.squaredNorm() * here.gradient;
    if (!(collider_.smooth_at(t.x + way).value > here.value + 0.5 * rise)) continue;
    ways[i] = place_ ? Vec3(place_->rotation * way) : way;
  }
  return ways;
}

std::vector<ContactAnchor> AnchoredContact::anchors() const { return {touches_.begin(), touches_.end()}; }

void AnchoredContact::set_anchors(std::span<const ContactAnchor> anchors) {
  if (anchors.size() != touches_.size())
    refuse("AnchoredContact", anchors.size(), " anchors for ", touches_.size(), " particles");
  for (std::size_t i = 0; i < anchors.size(); ++i) static_cast<ContactAnchor&>(touches_[i]) = anchors[i];
}

int AnchoredContact::make_room(std::span<const Vec3> from, std::span<const Vec3> to,
                               std::span<const double> inv_mass) {
  int squeezed = 0;
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    Touch& t = touches_[i];
    const double gap = options_.gap - t.nearer;
    if (!(inv_mass[i] > 0) || (to[i] - from[i]).norm() > gap) continue;
    const SignedDistance here = collider_.smooth_at(in_frame(from[i])),
                         there = collider_.smooth_at(in_frame(to[i]));
    const double most = std::max(here.value, there.value);
    if (!(most < gap)) continue;
    const double cosine = here.gradient.dot(there.gradient) / (here.gradient.norm() * there.gradient.norm());
    if (!(cosine < 0.5)) continue;
    t.nearer = options_.gap - (most > 0 ? 0.5 : 2) * most;
    ++squeezed;
  }
  return squeezed;
}

void AnchoredContact::stiffen(double factor, std::span<Vec3> x) {
  soft_ /= factor;
  options_.stiffness *= factor * factor;
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    const Touch& t = touches_[i];
    if (t.push > 0) x[i] += (t.depth - depth_of(t.push / t.slope)) / t.slope * t.normal;
  }
}

double AnchoredContact::deepest() const {
  double depth = 0;
  for (const Touch& t : touches_)
    if (t.push > 0) depth = std::max(depth, t.depth);
  return depth;
}

double AnchoredContact::held_back(std::span<const double> mass, double inertia) const {
  double most = 0;
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    const Touch& t = touches_[i];
    if (t.limit < 0) continue;
    const double length = t.way().norm();
    if (length > slip_ || (t.slides && length > 0))
      most = std::max(most, t.limit / std::max(slip_, length) / (mass[i] * inertia));
  }
  return most;
}

int AnchoredContact::touching() const {
  return int(std::count_if(touches_.begin(), touches_.end(), [](const Touch& t) { return t.push > 0; }));
}

std::optional<std::vector<int>> AnchoredContact::pushed() const {
  std::vector<int> result;
  for (std::size_t i = 0; i < touches_.size(); ++i)
    if (touches_[i].push > 0) result.push_back(int(i));
  return result;
}

}  // namespace furrow::physics
