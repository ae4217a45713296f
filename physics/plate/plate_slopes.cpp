// SPDX-License-Identifier: MIT
#include "physics/plate/plate_slopes.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>

namespace furrow::physics {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

constexpr double tolerance = 1e-4;     // epsilon: what exactness may cost in size of the factors
constexpr double least_spread = 3e-3;  // of the directions that the hinges around tell
constexpr double nothing_to_mend = 1e-12;
constexpr std::array ring_weights = {1.0, 0.1, 0.01};

/// A hinge near the edge: its angle for the three curvatures over the edge's length, and how much it may
/// carry.
struct NearHinge {
  int hinge;
  Vector3d turn;
  double weight;
};
struct Placed {
  int triangle;
  FlatTriangle corners;
};

/// k of the hinge but for the rigidity: length^2 over the areas that bend.
double hinge_weight(const PlateNet& net, int hinge) {
  const PlateNet::Joint& joint = net.joints[std::size_t(hinge)];
  double area = 0, length = 0;
  for (const PlateNet::Side& s : joint.side) {
    const PlateNet::Triangle& t = net.triangles[std::size_t(s.triangle)];
    if (!t.held) area += t.area;
    length = t.length[std::size_t(s.edge)];
  }
  return length * length / area;
}

/// The triangles and hinges around an edge, unfolded into the plane of its middle.
class Surroundings {
 public:
  Surroundings(const PlateNet& net, int hinge) : net_(net), middle_(hinge) {
    const PlateNet::Joint& joint = net.joints[std::size_t(hinge)];
    const double l = edge_length(joint.side[0]);
    const Vector2d a(-0.5 * l, 0), b(0.5 * l, 0);
    known_.push_back({joint.side[0].triangle, unfold(at(joint.side[0]), joint.side[0].edge, a, b)});
    known_.push_back({joint.side[1].triangle, unfold(at(joint.side[1]), joint.side[1].edge, b, a)});
    left_turn_ = turn(known_[0], joint.side[0].edge) / l;
    add(hinge, left_turn_ + turn(known_[1], joint.side[1].edge) / l, 1);
    length_ = l;
  }

  /// The hinges over the outer edges of all triangles that the last call reached.
  void add_ring(double weight) {
    const std::size_t end = known_.size();
    for (; first_ < end; ++first_)
      for (int edge = 0; edge < 3; ++edge) cross(first_, edge, weight);
  }

  const Vector3d& left_turn() const { return left_turn_; }
  const std::vector<NearHinge>& hinges() const { return hinges_; }

 private:
  const PlateNet::Triangle& at(const PlateNet::Side& s) const {
    return net_.triangles[std::size_t(s.triangle)];
  }
  double edge_length(const PlateNet::Side& s) const { return at(s).length[std::size_t(s.edge)]; }
  Vector3d turn(const Placed& p, int edge) const {
    return edge_turn(p.corners, net_.triangles[std::size_t(p.triangle)].area, edge);
  }
  void add(int hinge, const Vector3d& turn, double weight) {
    hinges_.push_back({hinge, turn, weight * hinge_weight(net_, hinge) / hinge_weight(net_, middle_)});
  }
  bool knows(int triangle) const {
    return std::any_of(known_.begin(), known_.end(), [&](const Placed& p) { return p.triangle == triangle; });
  }

  void cross(std::size_t from, int edge, double weight) {
    const Placed here = known_[from];
    const PlateNet::Triangle& t = net_.triangles[std::size_t(here.triangle)];
    const int hinge = t.hinge[std::size_t(edge)];
    if (hinge < 0 || t.held || t.sliver) return;
    if (std::any_of(hinges_.begin(), hinges_.end(), [&](const NearHinge& h) { return h.hinge == hinge; }))
      return;
    const PlateNet::Joint& joint = net_.joints[std::size_t(hinge)];
    const bool left = joint.side[0].triangle == here.triangle && joint.side[0].edge == edge;
    const PlateNet::Side& beyond = joint.side[left ? 1 : 0];
    const std::size_t i = std::size_t(edge);
    const Placed next{beyond.triangle,
                      unfold(at(beyond), beyond.edge, here.corners[(i + 2) % 3], here.corners[(i + 1) % 3])};
    Vector3d angle = turn(here, edge);
    if (!at(beyond).held) angle += turn(next, beyond.edge);
    add(hinge, angle / length_, weight);
    if (!knows(beyond.triangle)) known_.push_back(next);
  }

  const PlateNet& net_;
  int middle_;
  double length_ = 1;
  Vector3d left_turn_;
  std::vector<Placed> known_;
  std::vector<NearHinge> hinges_;
  std::size_t first_ = 0;
};

/// B W B^T: how well the hinges tell the three curvatures.
Matrix3d told_by(const std::vector<NearHinge>& hinges) {
  Matrix3d sum = Matrix3d::Zero();
  for (const NearHinge& h : hinges) sum += h.weight * h.turn * h.turn.transpose();
  return sum;
}

bool is_told(const Matrix3d& m) {
  const Vector3d values = Eigen::SelfAdjointEigenSolver<Matrix3d>(m, Eigen::EigenvaluesOnly).eigenvalues();
  return values[0] >= least_spread * values[2];
}

}  // namespace

std::vector<HingeShare> left_share(const PlateNet& net, int hinge) {
  const PlateNet::Joint& joint = net.joints[std::size_t(hinge)];
  const PlateNet::Triangle &t = net.triangles[std::size_t(joint.side[0].triangle)],
                           &u = net.triangles[std::size_t(joint.side[1].triangle)];
  if (t.held) return {};
  if (u.held) return {{hinge, 1}};
  const double both = t.area + u.area, by_area = t.area / both;
  std::vector<HingeShare> share{{hinge, by_area}};
  if (t.sliver || u.sliver) return share;
  Surroundings around(net, hinge);
  const Vector3d missing = around.left_turn() - by_area * around.hinges()[0].turn;
  if (missing.norm() < nothing_to_mend) return share;
  around.add_ring(ring_weights[0]);
  Matrix3d told = told_by(around.hinges());
  for (std::size_t ring = 1; ring < ring_weights.size() && !is_told(told); ++ring) {
    around.add_ring(ring_weights[ring]);
    told = told_by(around.hinges());
  }
  // c = W B^T (B W B^T + epsilon kappa I)^-1 r
  const double l = t.length[std::size_t(joint.side[0].edge)];
  const double kappa = std::min(3.0, 0.25 * both * both * (1 / t.area + 1 / u.area) / (l * l));
  const Vector3d y = (told + tolerance * kappa * Matrix3d::Identity()).ldlt().solve(missing);
  for (const NearHinge& h : around.hinges()) share.push_back({h.hinge, h.weight * h.turn.dot(y)});
  return share;
}

}  // namespace furrow::physics
