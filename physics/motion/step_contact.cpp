// SPDX-License-Identifier: MIT
#include "physics/motion/step_contact.h"

#include <algorithm>
#include <utility>

namespace furrow::physics {
namespace {

constexpr int most_pieces = 32;          // of a way along the body
constexpr double contact_moment = 0.01;  // of a step, for a velocity

const Collider& asked(const BodyAround& body) {
  return body.animated ? static_cast<const Collider&>(*body.animated) : *body.collider;
}

}  // namespace

StepContact::StepContact(const BodyAround& body, double stiffness, std::size_t particles, double time)
    : AnchoredContact(asked(body), AnchoredContactOptions{body.friction, body.gap, stiffness}, particles),
      body_(body) {
  if (body_.motion) place_body(place_at(time));
}

BodyPlace StepContact::place_at(double time) const {
  return body_.motion ? BodyPlace(pose(*body_.motion, time)) : BodyPlace();
}

const Collider& StepContact::collider() const { return asked(body_); }

std::vector<Vec3> StepContact::move_body(double from, double to, std::span<const Vec3> x) {
  std::vector<Vec3> carried(x.begin(), x.end());
  if (body_.animated) {
    AnimatedBody& body = *body_.animated;
    body.prepare(from, to);
    carry_anchors([&](const Vec3& p) -> Vec3 { return body.share() * body.way(p); });
    forget_levels();
    for (std::size_t i = 0; i < carried.size(); ++i) {
      const AnimatedBody::Beside surface = body.beside(carried[i]);
      const double level = body.at(carried[i], surface).value;
      know_level(i, carried[i], level);
      if (level < 2 * body_.gap + body.travel()) carried[i] += body.share() * surface.way;
    }
  } else if (body_.motion) {
    const BodyPlace before = place_at(from);
    place_body(place_at(to));
    for (Vec3& p : carried) p = before.to_body(p);
  }
  return carried;
}

std::vector<Vec3> StepContact::ways(std::span<const Vec3> carried, std::span<const Vec3> x) const {
  std::vector<Vec3> ways(carried.begin(), carried.end());
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (place()) ways[i] = place()->to_world(carried[i]);
    ways[i] -= x[i];
  }
  return ways;
}

StepContact::Beside StepContact::beside(std::span<const Vec3> carried, std::vector<Vec3> ways,
                                        std::span<const Vec3> x0, std::span<const Vec3> v0,
                                        std::span<const Vec3> x1, double from, double to) const {
  const double h = to - from, little = contact_moment * h;
  Beside result{std::move(ways), {}};
  for (Vec3& v : result.surface) v /= h;
  for (std::size_t i = 0; i < x0.size(); ++i)
    result.slip.push_back(0.5 * (v0[i] + (x1[i] - x0[i]) / h) - result.surface[i]);
  if (!place()) return result;
  const BodyPlace& now = *place();
  const BodyPlace sooner = place_at(to - little), later = place_at(to + little), before = place_at(from - h);
  const Mat3 turn = now.rotation * place_at(from).rotation.transpose();
  for (std::size_t i = 0; i < x0.size(); ++i) {
    const Vec3 on_body = carried[i], at_end = now.to_body(x1[i]);
    const Vec3 slip_before = v0[i] - (x0[i] - before.to_world(on_body)) / h;
    const Vec3 slip_now = (x1[i] - now.to_world(on_body)) / h;
    result.slip[i] = 0.5 * (slip_now + turn * slip_before);
    result.surface[i] =
        ((later.rotation - sooner.rotation) * at_end + later.translation - sooner.translation) / (2 * little);
  }
  return result;
}

/// The end of a particle's way in the body's frame, without what leads from within the gap farther in.
Vec3 StepContact::slid(std::size_t i, Vec3 from, const Vec3& to) const {
  Vec3 rest = to - from;
  if (is_beyond(i, from, body_.gap + rest.norm())) return to;
  for (int piece = 0; piece < most_pieces; ++piece) {
    const SignedDistance field = collider().at(from);
    const double room = field.value - body_.gap, length = rest.norm();
    if (room >= length) return from + rest;
    double share = std::max(room, body_.gap / 4) / length;
    if (room < body_.gap / 4) {
      const Vec3 n = field.gradient.normalized();
      rest += std::max(0.0, -n.dot(rest) - std::max(0.0, room)) * n;
      share = std::min(1.0, body_.gap / std::max(rest.norm(), 1e-300));
    }
    from += share * rest;
    rest *= 1 - share;
    if (share == 1) return from;
  }
  return from;
}

bool StepContact::cut_ways(std::span<const Vec3> x, std::span<const double> inv_mass, std::span<Vec3> to,
                           ThreadPool& pool) const {
  std::vector<Vec3> from(x.begin(), x.end());
  for (Vec3& p : from) p = in_frame(p);
  const std::vector<Vec3> whole(to.begin(), to.end());
  keep_out(from, inv_mass, to, pool);
  return !std::equal(to.begin(), to.end(), whole.begin());
}

void StepContact::keep_out(std::span<const Vec3> start, std::span<const double> inv_mass, std::span<Vec3> x,
                           ThreadPool& pool) const {
  pool.run(int(x.size()), [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const auto i = std::size_t(k);
      if (!(inv_mass[i] > 0)) continue;
      const Vec3 to = in_frame(x[i]);
      const Vec3 end_of_way = slid(i, start[i], to);
      if (end_of_way == to) continue;
      x[i] = place() ? place()->to_world(end_of_way) : end_of_way;
    }
  });
}

}  // namespace furrow::physics
