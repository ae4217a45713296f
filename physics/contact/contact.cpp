// SPDX-License-Identifier: MIT
#include "physics/contact/contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "physics/contact/residual_force.h"

namespace furrow::physics {
namespace {

constexpr double small_depth = 1e-4;   // m: below, the field is linear and one Newton step is exact
constexpr double longest_push = 0.02;  // m
constexpr int most_pieces = 1000;

void check_positive(double value, const char* name) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw std::invalid_argument(std::string(name) + " = " + std::to_string(value) + " is not > 0");
  }
}

/// The field with a count of what it is asked for.
struct Field {
  const Collider& body;
  ContactCounts& counts;
  SignedDistance at(const Vec3& x) const {
    ++counts.queries;
    return body.at(x);
  }
};

/// The end of the move from `before`, where the field is `level`, to x.
Vec3 advance(const Field& body, const Vec3& before, double level, const Vec3& x, double gap) {
  Vec3 p = before;
  for (int piece = 0; piece < most_pieces; ++piece) {
    const double rest = (x - p).norm(), room = std::max(level, 0.0) + gap / 2;
    if (rest <= room) return x;
    const bool inside = level < 0;
    p += (room / rest) * (x - p);
    if (inside) break;
    level = body.at(p).value;
    if (level < 0) break;
  }
  ++body.counts.truncations;
  return p;
}

/// Moves x out until the field reaches target; returns the length of the moves. `field` is that at x on
/// entry; its gradient is that of the last move on return.
double push_out(const Field& body, double target, SignedDistance& field, Vec3& x) {
  const double depth = target - field.value, slope = field.gradient.norm();
  if (depth < small_depth) {
    const double move = depth / std::max(slope, 0.5);
    x += (move / slope) * field.gradient;
    return move;
  }
  double pushed = 0;
  for (int round = 0; round < 3; ++round) {
    const double move = std::min(target - field.value, longest_push);
    x += move * field.gradient.normalized();
    pushed += move;
    if (round == 2) break;
    const SignedDistance next = body.at(x);
    // A projection that leaves less depth is good enough.
    if (next.value >= target - contact_tolerance || !(next.gradient.norm() > 0)) break;
    field = next;
  }
  return pushed;
}

}  // namespace

ContactCounts& ContactCounts::operator+=(const ContactCounts& other) {
  queries += other.queries;
  truncations += other.truncations;
  return *this;
}

BodyContact::BodyContact(const Collider& collider, const ContactOptions& options, int particles)
    : collider_(collider), options_(options), clear_level_(options.gap) {
  check_positive(options.gap, "contact gap");
  check_positive(options.recovery_speed, "recovery speed");
  if (!(options.friction >= 0) || !std::isfinite(options.friction)) {
    throw std::invalid_argument("friction = " + std::to_string(options.friction) + " is not >= 0");
  }
  memory_.assign(std::size_t(particles), {Vec3::Zero(), std::numeric_limits<double>::quiet_NaN()});
}

void BodyContact::respond(int i, const Vec3& before, double dt, Vec3& x, Vec3& v, ContactCounts& counts) {
  ContactMemory& known = memory_[std::size_t(i)];
  if (std::isnan(known.level)) known = {before, Field{collider_, counts}.at(before).value};
  if (!std::isfinite((x - before).norm()) || is_clear(i, x)) return;
  if (const auto arrived = resolve(collider_, known, before, dt, x, counts)) v = (*arrived - before) / dt;
}

std::optional<Vec3> BodyContact::resolve(const Collider& collider, ContactMemory& known, const Vec3& before,
                                         double dt, Vec3& x, ContactCounts& counts) const {
  const Field body{collider, counts};
  const double gap = options_.gap, step = (x - before).norm();
  const auto level_before = [&] {
    if (before != known.x) known = {before, body.at(before).value};
    return known.level;
  };
  const double least_level = known.level - lipschitz * (before - known.x).norm();
  if (step > std::max(least_level, 0.0) + gap / 2) x = advance(body, before, level_before(), x, gap);
  SignedDistance field = body.at(x);
  if (field.value >= gap || !(field.gradient.norm() > 0)) {
    known = {x, field.value};
    return std::nullopt;
  }

  const double old_depth = std::max(0.0, gap - level_before()), target = gap - old_depth;
  const double recovery = std::min({old_depth, options_.recovery_speed * dt, gap - field.value});
  const double pushed = field.value < target ? push_out(body, target, field, x) : 0;
  const Vec3 n = field.gradient.normalized();
  if (pushed > 0) {
    const Vec3 moved = x - before, normal = moved.dot(n) * n, tangential = moved - normal;
    const double most = options_.friction * pushed, slip = tangential.norm();
    x = slip <= most ? Vec3(before + normal) : Vec3(x - (most / slip) * tangential);
  }
  const Vec3 arrived = x;
  x += recovery * n;
  known = {x, body.at(x).value};
  return pushed > 0 ? std::optional(arrived) : std::nullopt;
}

int count_contacts(std::span<const Vec3> x, const Collider& collider, double gap) {
  return int(std::count_if(x.begin(), x.end(), [&](const Vec3& p) {
    return p.allFinite() && collider.at(p).value <= gap + contact_tolerance;
  }));
}

}  // namespace furrow::physics
