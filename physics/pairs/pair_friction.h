// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/base/contact_term.h"
#include "physics/linear/free_stiffness.h"
#include "physics/pairs/active_pair.h"

namespace furrow::physics {

/// What a pair's friction leaves to the next search.
struct PairAnchor {
  PairKey key;
  Vec3 tether;  ///< what of the way in its plane is from before [m]
  bool slides;
};

/// Friction between layers of cloth as a potential, for callers that look for rest: the law of
/// AnchoredContact, for each pair. It pulls back the way u that the two primitives went against each other
/// along their plane, linearly over a slip of a thirtieth of the pair's range, and then with its limit,
/// friction times push. Cost: a few operations a pair; results do not depend on threads.
/// \details Between calls of move_anchors() and expect(), normals, weights and limits are held, and this is
/// the derivative of an energy. Pairs come and go while cloth slides over edges, so u is handed on: a new
/// pair begins with the mean of what the pairs of its vertices had, on the same side of the cloth, in its own
/// plane. Without that a sheet would creep by a slip an edge.
class PairFriction {
 public:
  /// Coulomb coefficient [-]; throws std::invalid_argument unless >= 0.
  explicit PairFriction(double coefficient);

  /// The pairs that push each other now, sorted by key, take the place of those before: with the way that
  /// they went since, at most a slip, and limits of their push. Ways are those of the last look(), which was
  /// at x. Answers are for x then.
  void move_anchors(std::span<const ActivePair> active, std::span<const Vec3> x);
  /// Pairs that have come to push each other since the last move_anchors() get friction, too, at once: over
  /// the way since positions `from`, with what their vertices had on it there. Then look() again.
  void hold_new(std::span<const ActivePair> active, std::span<const Vec3> from);
  std::vector<PairAnchor> anchors() const;
  /// As after the move_anchors() that left these, `active` being the pairs of then. Those that do not push
  /// are forgotten.
  void set_anchors(std::span<const PairAnchor> anchors, std::span<const ActivePair> active);
  /// Limits become those of the push after a move [m], by the pairs' stiffness where they lie.
  void expect(std::span<const ActivePair> active, std::span<const Vec3> move);
  /// All answers below are for these positions.
  void look(std::span<const Vec3> x);
  double energy() const { return energy_; }      ///< [J]
  void add_forces(std::span<Vec3> force) const;  ///< [N]
  /// Positive semidefinite.
  void add_stiffness(FreeStiffness& stiffness, SlipStiffness of_slip = SlipStiffness::none) const;
  /// The blocks that add_stiffness() writes, by two particles.
  void list_couples(std::vector<std::array<int, 2>>& couples) const;
  bool empty() const { return pairs_.empty(); }  ///< no pair has friction
  int sliding() const;                           ///< pairs at their limit, at the last move_anchors()

 private:
  struct Pair {
    PairKey key;
    std::array<int, 4> vertices;
    std::array<double, 4> weights;
    Vec3 normal, tether;  ///< tether: what of the way is from before [m]
    double limit, slip;   ///< [N], [m]
    bool slides;
    Vec3 way = Vec3::Zero();  ///< u, where it was looked last [m]
  };
  /// What a vertex has of a pair, as seen from its side.
  struct Share {
    int vertex;
    Vec3 normal, way;
    double weight;
  };
  Pair held(const ActivePair& pair, const Vec3& tether, bool slides, const Vec3& way) const;
  std::vector<Share> shares() const;
  static Vec3 inherited(const ActivePair& pair, std::span<const Share> shares);
  void sum_energy();

  double coefficient_;
  std::vector<Pair> pairs_;  ///< sorted by key
  double energy_ = 0;
};

}  // namespace furrow::physics
