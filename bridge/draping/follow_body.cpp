// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/follow_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "bridge/arrays/convert.h"
#include "geometry/mesh/preconditions.h"

namespace furrow::bridge {
namespace {

using physics::Vec3;

constexpr double skin = 0.002;           // added to distances, so that no pull is endless [m]
constexpr double near_enough = 2e-5;     // that a push leaves [m]
constexpr double farthest_aside = 0.01;  // that a vertex is pushed which lacked nothing itself [m]
constexpr int most_rounds = 40, straight_rounds = 5;

/// Weights of a triangle's corners for the point of its plane below x, clamped to its inside.
Vec3 weights_in(const std::array<Vec3, 3>& corners, const Vec3& x) {
  const Vec3 a = corners[1] - corners[0], b = corners[2] - corners[0], p = x - corners[0];
  const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b), whole = aa * bb - ab * ab;
  if (!(whole > 0)) return {1, 0, 0};
  Vec3 weights(0, (bb * a.dot(p) - ab * b.dot(p)) / whole, (aa * b.dot(p) - ab * a.dot(p)) / whole);
  weights[0] = 1 - weights[1] - weights[2];
  weights = weights.cwiseMax(0);
  return weights / weights.sum();
}

}  // namespace

BodyFollower::BodyFollower(const geometry::Mesh& garment, const physics::TriangleMesh& body,
                           const FollowOptions& options)
    : options_(options), places_(positions_of(garment)), body_(body), distance_(body) {
  if (!(options.reach > 0) || !std::isfinite(options.reach))
    geometry::refuse("BodyFollower", "reach is " + std::to_string(options.reach) + ", not > 0");
  if (!(options.gap >= 0) || !std::isfinite(options.gap))
    geometry::refuse("BodyFollower", "gap is " + std::to_string(options.gap) + ", not >= 0");
  if (garment.number_of_faces() == 0) geometry::refuse("BodyFollower", "the garment has no faces");
  add_samples(garment);
  for (std::size_t v = 0; v < places_.size(); ++v) {
    const physics::ClosestPoint at = distance_.closest(places_[v]);
    samples_[v].triangle = at.triangle;
    const std::array<int, 3>& t = body_.triangles[std::size_t(at.triangle)];
    nearest_.push_back(
        weights_in({body_.vertices[t[0]], body_.vertices[t[1]], body_.vertices[t[2]]}, at.point));
  }
  factor(garment);
  find_outward();
}

/// The way from the skin, smoothed, so that it leads out of a crease, too.
void BodyFollower::find_outward() {
  for (const Vec3& place : places_) outward_.push_back(distance_.at(place).gradient);
  for (int round = 0; round < 5; ++round) {
    std::vector<Vec3> next = outward_;
    for (std::size_t v = 0; v < next.size(); ++v)
      for (const int n : neighbours_[v]) next[v] += outward_[n];
    outward_ = std::move(next);
    for (Vec3& way : outward_) way.normalize();
  }
}

void BodyFollower::add_samples(const geometry::Mesh& garment) {
  const auto add = [&](std::array<int, 3> vertices, const Vec3& weights) {
    Sample sample{vertices, weights};
    const physics::ExactDistance::Sample at = distance_.sample(place_of(sample, {}));
    sample.triangle = at.triangle, sample.clearance = at.value;
    samples_.push_back(sample);
  };
  for (int v = 0; v < int(places_.size()); ++v) add({v, v, v}, {1, 0, 0});
  for (const geometry::Edge e : garment.edges()) {
    const int a = int(garment.source(garment.halfedge(e)).idx()),
              b = int(garment.target(garment.halfedge(e)).idx());
    add({a, b, b}, {0.5, 0.5, 0});
  }
  for (const std::array<int, 3>& t : triangles_of(garment)) add(t, Vec3::Constant(1.0 / 3));
}

void BodyFollower::factor(const geometry::Mesh& garment) {
  const int n = int(places_.size());
  std::vector<double> area(places_.size(), 0);
  for (const auto& [a, b, c] : triangles_of(garment)) {
    const double third = (places_[b] - places_[a]).cross(places_[c] - places_[a]).norm() / 6;
    for (const int v : {a, b, c}) area[v] += third;
  }
  std::vector<Eigen::Triplet<double>> entries;
  neighbours_.resize(places_.size());
  const double r = options_.reach;
  for (const geometry::Edge e : garment.edges()) {
    const int a = int(garment.source(garment.halfedge(e)).idx()),
              b = int(garment.target(garment.halfedge(e)).idx());
    neighbours_[a].push_back(b), neighbours_[b].push_back(a);
    for (const int v : {a, b}) entries.emplace_back(v, v, r * r);
    entries.emplace_back(a, b, -r * r), entries.emplace_back(b, a, -r * r);
  }
  for (int v = 0; v < n; ++v) {
    const double share = r / (std::abs(samples_[v].clearance) + skin);
    pull_.push_back(std::max(area[v], 1e-12) * share * share);
    entries.emplace_back(v, v, pull_.back());
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factor_.compute(matrix);
  if (factor_.info() != Eigen::Success)
    geometry::refuse("BodyFollower", "a vertex of the garment is not finite");
}

Vec3 BodyFollower::place_of(const Sample& sample, std::span<const Vec3> moves) const {
  Vec3 place = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const std::size_t v = std::size_t(sample.vertices[k]);
    place += sample.weights[k] * (moves.empty() ? places_[v] : Vec3(places_[v] + moves[v]));
  }
  return place;
}

physics::ExactDistance BodyFollower::moved_body(std::span<const Vec3> body_moves) const {
  physics::TriangleMesh moved = body_;
  for (std::size_t i = 0; i < moved.vertices.size(); ++i) moved.vertices[i] += body_moves[i];
  return distance_.moved(moved);
}

std::vector<Vec3> BodyFollower::follow(std::span<const Vec3> body_moves) const {
  if (body_moves.size() != body_.vertices.size())
    geometry::refuse("BodyFollower", "the moves are not those of the body's vertices");
  Eigen::MatrixX3d wanted(Eigen::Index(places_.size()), 3);
  for (std::size_t v = 0; v < places_.size(); ++v) {
    const std::array<int, 3>& t = body_.triangles[std::size_t(samples_[v].triangle)];
    Vec3 move = Vec3::Zero();
    for (int k = 0; k < 3; ++k) move += nearest_[v][k] * body_moves[t[k]];
    wanted.row(Eigen::Index(v)) = pull_[v] * move.transpose();
  }
  const Eigen::MatrixX3d solved = factor_.solve(wanted);
  std::vector<Vec3> moves;
  for (Eigen::Index v = 0; v < solved.rows(); ++v) moves.emplace_back(solved.row(v).transpose());
  return moves;
}

/// Where nothing is pushed, vertices go half as far as their neighbours do.
void BodyFollower::spread(std::vector<Vec3>& pushes, const std::vector<char>& pushed) const {
  for (int ring = 0; ring < 3; ++ring) {
    std::vector<Vec3> next = pushes;
    for (std::size_t v = 0; v < pushes.size(); ++v) {
      if (pushed[v] || neighbours_[v].empty()) continue;
      Vec3 sum = Vec3::Zero();
      for (const int n : neighbours_[v]) sum += pushes[n];
      next[v] = sum / (2 * double(neighbours_[v].size()));
    }
    pushes = std::move(next);
  }
}

void BodyFollower::push_out(std::vector<Vec3>& moves, std::span<const Vec3> body_moves) const {
  const physics::ExactDistance body = moved_body(body_moves);
  const std::vector<Vec3> begun = moves;
  std::vector<double> most(moves.size(),
                           0);  // what a vertex lacked at first [m]: where a body meets itself, no push helps
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<Vec3> pushes(moves.size(), Vec3::Zero());
    std::vector<char> pushed(moves.size(), 0);
    for (const Sample& sample : samples_) {
      const physics::SignedDistance at = body.at(place_of(sample, moves), sample.triangle);
      const double lack = std::min(sample.clearance, options_.gap) - at.value;
      if (!(lack > near_enough)) continue;
      for (int k = 0; k < 3; ++k) {
        const std::size_t v = std::size_t(sample.vertices[k]);
        if (sample.weights[k] == 0) continue;
        if (round == 0) most[v] = std::max(most[v], lack);
        // Between two sides of a crease each push would lead to the other one.
        const Vec3 push =
            lack * (round < straight_rounds ? at.gradient : (at.gradient + outward_[v]).normalized());
        if (push.squaredNorm() > pushes[v].squaredNorm()) pushes[v] = push;  // the one that lacks most
        pushed[v] = 1;
      }
    }
    if (std::ranges::none_of(pushed, [](char p) { return p != 0; })) return;
    spread(pushes, pushed);
    for (std::size_t v = 0; v < moves.size(); ++v) {
      moves[v] += pushes[v];
      const Vec3 whole = moves[v] - begun[v];
      const double allowed = 3 * most[v] + farthest_aside;
      if (whole.norm() > allowed) moves[v] = begun[v] + allowed / whole.norm() * whole;
    }
  }
}

double BodyFollower::deepest(std::span<const Vec3> moves, std::span<const Vec3> body_moves) const {
  const physics::ExactDistance body = moved_body(body_moves);
  double deepest = 0;
  for (const Sample& sample : samples_) {
    const double at = body.at(place_of(sample, moves), sample.triangle).value;
    deepest = std::max(deepest, std::min(sample.clearance, 0.0) - at);
  }
  return deepest;
}

}  // namespace furrow::bridge
