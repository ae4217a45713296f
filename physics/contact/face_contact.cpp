// SPDX-License-Identifier: MIT
#include "physics/contact/face_contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/base/require.h"
#include "physics/contact/soft_push.h"

namespace furrow::physics {
namespace {

constexpr double out_of_reach = std::numeric_limits<double>::infinity();
constexpr int lattice = 4;               // parts of an edge
constexpr int descent_tries = 24;        // of a way downhill
constexpr int most_starts = 3;           // samples of a face from which ways lead downhill
constexpr double least_step = 0.01;      // of the first step
constexpr int face_piece = 256;          // faces that a thread does at once
constexpr double trigger_share = 0.25;   // of the clearance
constexpr double same_place = 0.25;      // in barycentrics
constexpr double longest_raise = 0.002;  // m

double longest_edge(const std::array<Vec3, 3>& c) {
  return std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
}

}  // namespace

FaceContact::FaceContact(const Collider& collider, const Collider& precise,
                         std::span<const std::array<int, 3>> triangles, const FaceContactOptions& options)
    : collider_(collider),
      precise_(precise),
      triangles_(triangles.begin(), triangles.end()),
      options_(options) {
  const char* const operation = "FaceContact";
  require(operation, "clearance", options.clearance, options.clearance > 0, "> 0");
  require(operation, "error", options.error, options.error >= 0, ">= 0");
  require(operation, "stiffness", options.stiffness, options.stiffness > 0, "> 0");
}

Vec3 FaceContact::at(int face, const Weights& w, std::span<const Vec3> x) const {
  const auto& t = triangles_[std::size_t(face)];
  return w[0] * x[std::size_t(t[0])] + w[1] * x[std::size_t(t[1])] + w[2] * x[std::size_t(t[2])];
}

/// Against the gradient within the face's plane, by steps that are halved where they lead up.
FaceContact::Deepest FaceContact::descend(int face, Deepest from, std::span<const Vec3> x) const {
  const auto& t = triangles_[std::size_t(face)];
  const Vec3 origin = x[std::size_t(t[0])], e1 = x[std::size_t(t[1])] - origin,
             e2 = x[std::size_t(t[2])] - origin;
  const double a = e1.dot(e1), b = e1.dot(e2), c = e2.dot(e2), det = a * c - b * b;
  if (!(det > 1e-12 * a * c)) return from;
  const Vec3 normal = e1.cross(e2).normalized();
  SignedDistance here = precise_.at(at(face, from.weights, x));
  from.value = here.value;
  const double first_step = std::sqrt(std::max(a, c)) / (2 * lattice);
  double step = first_step;
  for (int i = 0; i < descent_tries && step > least_step * first_step; ++i) {
    const Vec3 along = here.gradient - here.gradient.dot(normal) * normal;
    if (!(along.norm() > 1e-3)) break;
    const Vec3 p = at(face, from.weights, x) - step / along.norm() * along - origin;
    const double u = (c * e1.dot(p) - b * e2.dot(p)) / det, v = (a * e2.dot(p) - b * e1.dot(p)) / det;
    Weights w{std::max(0.0, 1 - u - v), std::max(0.0, u), std::max(0.0, v)};
    const double sum = w[0] + w[1] + w[2];
    for (double& share : w) share /= sum;
    const SignedDistance there = precise_.at(at(face, w, x));
    if (there.value < from.value) {
      from = {w, there.value};
      here = there;
    } else {
      step *= 0.5;
    }
  }
  return from;
}

/// A distance changes by no more than the way, so vertices and samples tell which faces are out of reach.
FaceContact::Deepest FaceContact::deepest_of(int face, std::span<const Vec3> x,
                                             std::span<const double> vertex_values) const {
  const double trigger = trigger_share * options_.clearance;
  const auto& t = triangles_[std::size_t(face)];
  const std::array<Vec3, 3> corners{x[std::size_t(t[0])], x[std::size_t(t[1])], x[std::size_t(t[2])]};
  const double reach = longest_edge(corners) / std::sqrt(3.0);
  double nearest = out_of_reach;
  for (const int i : t) nearest = std::min(nearest, vertex_values[std::size_t(i)]);
  if (!(nearest - reach < trigger + options_.error)) return {{}, out_of_reach};
  const double between = reach / lattice, far = trigger + options_.error + between;
  std::vector<Deepest> near;
  for (int i = 0; i <= lattice; ++i)
    for (int j = 0; j <= lattice - i; ++j) {
      const Weights w{double(i) / lattice, double(j) / lattice, double(lattice - i - j) / lattice};
      if (collider_.at(at(face, w, x)).value < far) near.push_back({w, 0});
    }
  for (Deepest& sample : near) sample.value = precise_.at(at(face, sample.weights, x)).value;
  std::stable_sort(near.begin(), near.end(),
                   [](const Deepest& a, const Deepest& b) { return a.value < b.value; });
  Deepest best{{}, out_of_reach};
  for (std::size_t i = 0; i < std::min<std::size_t>(near.size(), most_starts); ++i) {
    if (!(near[i].value < trigger + between)) break;
    const Deepest found = descend(face, near[i], x);
    if (found.value < best.value) best = found;
  }
  return best;
}

/// A point that is there already moves to the deepest place, and is pushed as before by what it was.
void FaceContact::set_or_raise(int face, const Deepest& deepest, std::span<const Vec3> x) {
  const auto value_at = [&](const Weights& w) { return collider_.smooth_at(at(face, w, x)).value; };
  const double missing = std::min(options_.clearance - deepest.value, longest_raise);
  const auto [first, last] = of_face_.equal_range(face);
  for (auto it = first; it != last; ++it) {
    Point& point = points_[it->second];
    double apart = 0;
    for (std::size_t k = 0; k < 3; ++k)
      apart = std::max(apart, std::abs(point.weights[k] - deepest.weights[k]));
    if (apart > same_place) continue;
    const double depth = std::max(0.0, point.level - value_at(point.weights));
    point.weights = deepest.weights;
    point.level = value_at(point.weights) + depth + missing;
    return;
  }
  of_face_.emplace(face, points_.size());
  points_.push_back({face, deepest.weights, value_at(deepest.weights) + missing});
}

FaceContact::Found FaceContact::find(std::span<const Vec3> x, std::span<const double> inv_mass,
                                     ThreadPool* pool) {
  const auto each = [pool](int n, const auto& work) {
    if (pool)
      return pool->run(n, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) work(i);
      });
    for (int i = 0; i < n; ++i) work(i);
  };
  std::vector<double> values(x.size());
  each(int(x.size()), [&](int i) { values[std::size_t(i)] = collider_.at(x[std::size_t(i)]).value; });
  const int faces = int(triangles_.size());
  std::vector<Deepest> deepest(triangles_.size(), Deepest{{}, out_of_reach});
  each((faces + face_piece - 1) / face_piece, [&](int piece) {
    for (int f = piece * face_piece; f < std::min(faces, (piece + 1) * face_piece); ++f) {
      const auto& t = triangles_[std::size_t(f)];
      const bool moves = std::any_of(t.begin(), t.end(), [&](int i) { return inv_mass[std::size_t(i)] > 0; });
      if (moves) deepest[std::size_t(f)] = deepest_of(f, x, values);
    }
  });
  Found found;
  for (int f = 0; f < faces; ++f) {
    const Deepest& d = deepest[std::size_t(f)];
    found.through += d.value < 0;
    if (!(d.value < trigger_share * options_.clearance)) continue;
    set_or_raise(f, d, x);
    ++found.changed;
  }
  return found;
}

void FaceContact::look(std::span<const Vec3> x, std::span<const double>, ThreadPool*) {
  const double k = options_.stiffness, s = 0.5 * options_.clearance;
  for (Point& p : points_) {
    p.energy = p.push = p.stiffness = 0;
    const SignedDistance field = collider_.smooth_at(at(p.face, p.weights, x));
    const double d = p.level - field.value, slope = field.gradient.norm();
    if (!(d > 0) || !(slope > 0)) continue;
    const SoftPush push = soft_push(d, k, s);
    p.energy = push.energy;
    p.push = slope * push.force;
    p.stiffness = slope * slope * push.stiffness;
    p.normal = field.gradient / slope;
  }
}

double FaceContact::energy() const {
  double sum = 0;
  for (const Point& p : points_) sum += p.energy;
  return sum;
}

void FaceContact::add_forces(std::span<Vec3> force) const {
  for (const Point& p : points_) {
    if (!(p.push > 0)) continue;
    const auto& t = triangles_[std::size_t(p.face)];
    for (std::size_t k = 0; k < 3; ++k) force[std::size_t(t[k])] += p.weights[k] * p.push * p.normal;
  }
}

/// Where the elements do not couple two corners, their block stands on both diagonals instead, which is never
/// less: 2 wi wj ai aj <= wi wj (ai^2 + aj^2).
void FaceContact::add_stiffness(FreeStiffness& stiffness, SlipStiffness) const {
  for (const Point& p : points_) {
    if (!(p.push > 0)) continue;
    const auto& t = triangles_[std::size_t(p.face)];
    const Mat3 block = p.stiffness * p.normal * p.normal.transpose();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      stiffness.add(t[k], p.weights[k] * p.weights[k] * block);
      const double both = p.weights[k] * p.weights[next];
      if (stiffness.couples(t[k], t[next])) {
        stiffness.add(t[k], t[next], both * block);
      } else {
        stiffness.add(t[k], both * block);
        stiffness.add(t[next], both * block);
      }
    }
  }
}

int FaceContact::touching() const {
  return int(std::count_if(points_.begin(), points_.end(), [](const Point& p) { return p.push > 0; }));
}

}  // namespace furrow::physics
