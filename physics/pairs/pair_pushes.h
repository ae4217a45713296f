// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <span>
#include <vector>

#include "physics/base/thread_pool.h"
#include "physics/pairs/cloth_contact.h"

namespace furrow::physics {

struct PairPushOptions {
  double thickness = 1e-3;                   ///< of the cloth [m]; > 0; where edges are short, it is thinner
  double friction = 0;                       ///< Coulomb coefficient of cloth on cloth [-]; >= 0
  std::span<const double> thicknesses = {};  ///< of each particle, in place of `thickness` [m]; empty: none
  std::span<const int> groups = {};          ///< PairMesh::group
  std::span<const Vec3> drawn = {};          ///< positions in which nothing is to be pushed; empty: none
  /// A step begins with the pushes of the one before it, which add_reactions() has put into the forces that
  /// moved it, and pairs rest at 0.99 of their range, where the next step finds them again.
  bool lasting = false;
};

/// Contact of a cloth with itself for steps that do not solve it (methods S2.9, S2.10), by positions alone.
/// Where a step brings the two of a pair nearer than their range, sweeps push them apart along the line
/// between them, and Coulomb friction shortens their relative tangential way. Both sides get the same,
/// opposite push. What was nearer before the step keeps its distance. A guard comes last, so that nothing
/// passes through anything. Where nothing is near, nothing changes, bit by bit.
/// \details The guard cuts the moves of all vertices of a pair whose way is not free (time_of_impact()) or
/// that closes in the last twentieth of its range, and of what comes to be in their way, each to less than
/// half of its distance to anything. Pairs are handled in the order of their keys: same bits for any number
/// of threads and any list.
class PairPushes {
 public:
  /// To a cloth as it is at x. Throws std::invalid_argument if an option is out of its range, lengths differ,
  /// or it has no triangles.
  PairPushes(const Cloth& cloth, std::span<const Vec3> x, const PairPushOptions& options, ThreadPool* pool);

  /// A step leads from x0 to x [m]: finds the pairs that are near. Whether there are any. x0 must stay until
  /// the step's guard().
  bool begin_step(std::span<const Vec3> x0, std::span<const Vec3> x, ThreadPool* pool);
  /// Corrects x once for each pair. mobility: how far a push moves each particle, in any unit [1/kg]; 0 does
  /// not move. Whether it should be done again.
  bool sweep(std::span<Vec3> x, std::span<const double> mobility);
  /// The particles that sweeps have moved in this step.
  const std::vector<int>& touched() const { return touched_list_; }
  /// Shortens moves from x0 to x, as the class says. Returns whose, ascending.
  const std::vector<int>& guard(std::span<Vec3> x, std::span<const double> mobility, ThreadPool* pool);

  /// A pair that was nearer than its range before the step and is so now.
  struct Deep {
    std::array<int, 4> vertices;
    std::array<double, 4> weights;
    Vec3 normal;
    double depth;     ///< [m]; > 0
    double mobility;  ///< of its distance, for an impulse along the normal; > 0
  };
  std::vector<Deep> deep(std::span<const Vec3> x, std::span<const double> mobility) const;
  /// Moves what is nearer than it is to rest apart by a share of what is missing, which is no push. Returns
  /// the most that was missing, as a share of a range; 0: none.
  double recover(std::span<Vec3> x, std::span<const double> mobility, double share);
  /// Adds the step's pushes as forces at x: `scale` times those which by their mobility move particles as the
  /// pushes did. Forgets pushes of pairs that are farther apart than their range now.
  void add_reactions(std::span<const Vec3> x, std::span<const double> mobility, double scale,
                     std::span<Vec3> force);

  struct Touching {
    int pairs = 0;       ///< that push each other
    int sliding = 0;     ///< of them, by all the friction that they can have
    double nearest = 0;  ///< of those that were near in the step [m]; infinite: none
  };
  Touching touching(std::span<const Vec3> x) const;
  ClothContact& contact() { return contact_; }
  const ClothContact& contact() const { return contact_; }

 private:
  /// What sweeps did to a pair in this step [m].
  struct Push {
    double along = 0;            ///< its normal; >= 0
    Vec3 across = Vec3::Zero();  ///< friction
  };
  void note_ways(std::span<const Vec3> x);
  void take_last(const std::vector<ClothContact::Met>& met, const std::vector<Push>& pushes);
  double push_apart(const ClothContact::Met& pair, Push& push, std::span<Vec3> x,
                    std::span<const double> mobility);
  double rest_gap(const ClothContact::Met& pair) const;
  bool is_clear() const;
  void touch(const std::array<int, 4>& vertices);
  bool closes_in(const ClothContact::Met& pair) const;
  bool bound(const std::vector<ClothContact::Met>& pairs);
  void cut(std::span<const Vec3> x, const Vec3& common);
  Vec3 common_way(std::span<const double> mobility) const;

  double friction_;
  bool lasting_;
  ClothContact contact_;
  std::vector<double> least_radius_;  ///< of the vertices that share a triangle with each [m]
  std::span<const Vec3> x0_;
  std::vector<Vec3> way_;  ///< [m]
  std::vector<char> touched_, bounded_;
  std::vector<double> room_;  ///< what a bounded one may move [m]
  std::vector<int> touched_list_, cut_list_;
  std::vector<ClothContact::Met> met_;
  std::vector<Push> pushes_;
};

}  // namespace furrow::physics
