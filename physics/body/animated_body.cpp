// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "physics/body/depth_map_collider.h"
#include "physics/body/moving_body.h"
#include "physics/body/triangle_bvh.h"

namespace furrow::physics {
namespace {

constexpr double small_shift = 1e-3;  // m: surface next to x then and now is the same

[[noreturn]] void refuse_frames(const std::string& what) {
  throw std::invalid_argument("animated body: " + what);
}

/// Weights of the corners at a point of a triangle (Ericson, Real-Time Collision Detection, 3.4); those of
/// the nearest corner if the triangle has no area.
Vec3 weights(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a, w = x - a;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), determinant = uu * vv - uv * uv;
  if (determinant > 1e-14 * uu * vv) {
    const double s = (vv * w.dot(u) - uv * w.dot(v)) / determinant,
                 t = (uu * w.dot(v) - uv * w.dot(u)) / determinant;
    return {1 - s - t, s, t};
  }
  int nearest = 0;
  Vec3((x - a).squaredNorm(), (x - b).squaredNorm(), (x - c).squaredNorm()).minCoeff(&nearest);
  return Vec3::Unit(nearest);
}

}  // namespace

/// A frame with what its distance is asked from, once it is built: exact, or bvh and maps.
struct AnimatedBody::Frame {
  int index;
  std::vector<Vec3> vertices;
  std::optional<ExactDistance> exact;
  std::optional<TriangleBvh> bvh;
  std::unique_ptr<DepthMapCollider> maps;

  bool is_built() const { return exact || maps; }
  SignedDistance at(const Vec3& x) const { return maps ? maps->at(x) : exact->at(x); }
  SignedDistance at(const Vec3& x, int guess) const { return maps ? maps->at(x) : exact->at(x, guess); }
  ClosestPoint closest(const Vec3& x) const { return maps ? bvh->closest(x) : exact->closest(x); }
  ClosestPoint closest(const Vec3& x, int guess) const {
    return maps ? bvh->closest(x, guess) : exact->closest(x, guess);
  }
};

AnimatedBody::AnimatedBody(BodyFrames frames, const std::optional<DepthMapOptions>& maps)
    : frames_(std::move(frames)), maps_(maps) {
  const std::vector<double>& times = frames_.times;
  if (times.size() < 2) refuse_frames(std::to_string(times.size()) + " frames; at least two are needed");
  if (frames_.triangles.empty()) refuse_frames("no triangles");
  if (!frames_.vertices) refuse_frames("no source of vertices");
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1]))) {
      refuse_frames("time of frame " + std::to_string(i) + " is not finite or not after the one before");
    }
  }
}

AnimatedBody::~AnimatedBody() = default;
AnimatedBody::AnimatedBody(AnimatedBody&&) noexcept = default;
AnimatedBody& AnimatedBody::operator=(AnimatedBody&&) noexcept = default;

int AnimatedBody::interval_at(double time) const {
  const std::vector<double>& t = frames_.times;
  const auto next = std::upper_bound(t.begin(), t.end(), time) - t.begin();
  return int(std::clamp<std::ptrdiff_t>(next - 1, 0, std::ptrdiff_t(t.size()) - 2));
}

/// Of the present interval; below 0 before it, at most 1.
double AnimatedBody::fraction_at(double time) const {
  const double begin = frames_.times[std::size_t(interval_)], end = frames_.times[std::size_t(interval_) + 1];
  return std::min((time - begin) / (end - begin), 1.0);
}

std::shared_ptr<AnimatedBody::Frame> AnimatedBody::read(int index) {
  auto frame = std::make_shared<Frame>();
  frame->index = index;
  frame->vertices = frames_.vertices(index);
  if (vertex_count_ == 0) vertex_count_ = frame->vertices.size();
  if (frame->vertices.size() != vertex_count_) {
    refuse_frames("frame " + std::to_string(index) + " has " + std::to_string(frame->vertices.size()) +
                  " vertices instead of " + std::to_string(vertex_count_));
  }
  const std::string name = "animated body, frame " + std::to_string(index);
  check_body({frame->vertices, frames_.triangles}, name.c_str());
  return frame;
}

/// One of those in memory, else read.
std::shared_ptr<AnimatedBody::Frame> AnimatedBody::find(int index) {
  for (const std::shared_ptr<Frame>& known : {first_, second_, left_})
    if (known && known->index == index) return known;
  return read(index);
}

void AnimatedBody::enter(int interval) {
  std::shared_ptr<Frame> first = find(interval), second = find(interval + 1);
  for (std::shared_ptr<Frame>& old : {std::ref(first_), std::ref(second_)})
    if (old && old != first && old != second) leave(std::move(old));
  if (left_ == first || left_ == second) left_.reset();
  first_ = std::move(first), second_ = std::move(second);
  interval_ = interval;
  longest_way_ = 0;
  for (const auto& t : frames_.triangles)
    for (const int v : t)
      longest_way_ = std::max(longest_way_,
                              (second_->vertices[std::size_t(v)] - first_->vertices[std::size_t(v)]).norm());
}

/// Keeps it as the one that time left last; the memory of the one before serves the next.
void AnimatedBody::leave(std::shared_ptr<Frame> frame) {
  if (left_ && left_.use_count() == 1) {
    if (left_->maps) spare_maps_ = std::move(left_->maps);
    spare_ = std::move(left_->exact);
  }
  left_ = std::move(frame);
}

const ExactDistance& AnimatedBody::model() {
  if (!model_) model_.emplace(TriangleMesh{find(0)->vertices, frames_.triangles});
  return *model_;
}

void AnimatedBody::build(Frame& frame) {
  if (frame.is_built()) return;
  const TriangleMesh mesh{frame.vertices, frames_.triangles};
  if (maps_) {
    frame.bvh.emplace(mesh);
    if (spare_maps_) spare_maps_->rebuild(mesh.vertices);
    frame.maps = spare_maps_ ? std::move(spare_maps_) : std::make_unique<DepthMapCollider>(mesh, *maps_);
  } else if (frame.index == 0) {
    frame.exact = model();
  } else {
    frame.exact = model().moved(mesh, std::exchange(spare_, std::nullopt));
  }
  ++frames_built_;
}

void AnimatedBody::prepare(double from, double to) {
  const int last = interval_at(to);
  if (interval_ != last || !first_ || !first_->is_built() || !second_->is_built()) {
    const auto started = std::chrono::steady_clock::now();
    advance_to(from, last);
    build(*first_);
    build(*second_);
    build_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  } else {
    travel_ = 0;
  }
  const double begin = interval_ == 0 ? std::max(fraction_at(from), 0.0) : fraction_at(from);
  fraction_ = std::max(fraction_at(to), 0.0);
  share_ = fraction_ - begin;
  travel_ += longest_way_ * (fraction_ - std::max(begin, 0.0));
}

/// Enters every interval from that of `from` to `last`; travel_ is then what the ones before `last` add.
void AnimatedBody::advance_to(double from, int last) {
  travel_ = 0;
  if (interval_ != interval_at(from)) enter(interval_at(from));
  while (interval_ < last) {
    travel_ += longest_way_ * (1 - std::max(fraction_at(from), 0.0));
    enter(interval_ + 1);
  }
}

/// Of a point of a frame's surface.
Vec3 AnimatedBody::way_of(const ClosestPoint& point, const Frame& frame) const {
  const auto& t = frames_.triangles[std::size_t(point.triangle)];
  const auto i = std::size_t(t[0]), j = std::size_t(t[1]), k = std::size_t(t[2]);
  const Vec3 w = weights(point.point, frame.vertices[i], frame.vertices[j], frame.vertices[k]);
  const std::vector<Vec3>&from = first_->vertices, &to = second_->vertices;
  return w[0] * (to[i] - from[i]) + w[1] * (to[j] - from[j]) + w[2] * (to[k] - from[k]);
}

AnimatedBody::Beside AnimatedBody::beside(const Vec3& x) const {
  const bool is_early = fraction_ < 0.5;
  const Frame& frame = is_early ? *first_ : *second_;
  const double shift = is_early ? -fraction_ : 1 - fraction_;  // share of the way from now to that frame
  const ClosestPoint q = frame.closest(x);
  if (longest_way_ == 0) return {Vec3::Zero(), q.triangle};
  const Vec3 u = way_of(q, frame);
  if (std::abs(shift) * u.norm() < small_shift) return {u, q.triangle};
  const ClosestPoint r = frame.closest(x + shift * u, q.triangle);
  return {way_of(r, frame), r.triangle};
}

SignedDistance AnimatedBody::at(const Vec3& x) const {
  const double s = longest_way_ == 0 ? 0 : fraction_;
  if (s == 0) return first_->at(x);
  if (s == 1) return second_->at(x);
  return at(x, beside(x));
}

SignedDistance AnimatedBody::at(const Vec3& x, const Beside& near) const {
  const double s = longest_way_ == 0 ? 0 : fraction_;
  if (s == 0) return first_->at(x, near.triangle);
  if (s == 1) return second_->at(x, near.triangle);
  const SignedDistance a = first_->at(x - s * near.way, near.triangle),
                       b = second_->at(x + (1 - s) * near.way, near.triangle);
  return {(1 - s) * a.value + s * b.value, (1 - s) * a.gradient + s * b.gradient};
}

}  // namespace furrow::physics
