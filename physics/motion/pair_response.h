// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "physics/base/thread_pool.h"
#include "physics/motion/simulate.h"
#include "physics/packed/packed_cloth.h"
#include "physics/pairs/cloth_contact.h"

namespace furrow::physics {

/// Contact of a cloth with itself for steps that do not solve it, as BodyContact is that with a body
/// (methods S2.9, S2.10). Where a step brings the two of a pair nearer than the cloth is thick, they are
/// pushed apart along the line between them, shared by mass, then Coulomb friction shortens their relative
/// tangential motion, in sweeps over all pairs; momentum is kept. What was nearer before the step is no
/// motion: a push that grows with it takes it out, and bears loads that sweeps do not.
/// \details After that a guard cuts the moves of what would still pass through cloth: of all vertices of a
/// pair whose way is not free (time_of_impact()) or that closes in the last twentieth of its range, and of
/// what comes to be in their way, each to less than half of its distance to anything. So no step crosses.
/// Where nothing is near, nothing changes, bit by bit. Pairs are handled in the order of their keys: same
/// bits for any number of threads and any list. Cost: some 20 ns a particle where nothing is near, some 0.2
/// us a pair that is.
class PairResponse {
 public:
  /// Throws std::invalid_argument if an option is out of its range.
  explicit PairResponse(const SelfContactOptions& options);
  /// To a cloth as it is, before all below. led: places of particles that move though they have no mass.
  /// Throws std::invalid_argument if it has no triangles.
  void attach(const PackedCloth& cloth, std::span<const int> led, ThreadPool& pool);

  /// The cloth came from x0 [m] to its positions: finds the pairs that are near. Whether there are any.
  bool begin_step(std::span<const Vec4> x0, const PackedCloth& cloth, ThreadPool& pool);
  /// Corrects positions and velocities of a step of dt seconds once for each pair. Whether it should be done
  /// again.
  bool sweep(double dt, PackedCloth& cloth);
  /// The places whose particles sweeps have moved in this step.
  const std::vector<int>& touched() const { return places_; }
  /// After the sweeps and what else moves the places that they touched: takes out old depth, and cuts what
  /// would pass through cloth. Throws StepBlocked, positions as in x0, if a particle that is held would have
  /// to be cut.
  void finish_step(std::span<const Vec4> x0, double dt, PackedCloth& cloth, ThreadPool& pool);

  /// Now and then, before a step: lets pairs that crossed at the start, or were too near, take part.
  void widen(const PackedCloth& cloth);
  SelfContactMemory memory() const;
  void recall(const SelfContactMemory& memory);
  SelfContactState state(const PackedCloth& cloth) const;
  std::int64_t cut_moves() const { return cut_moves_; }  ///< of particles, by the guard, since it is attached
  int list_builds() const { return contact_->list_builds(); }

 private:
  void note_ways(std::span<const Vec4> x0, const PackedCloth& cloth);
  /// What sweeps did to a pair in this step [m].
  struct Push {
    double along = 0;            ///< its normal; >= 0
    Vec3 across = Vec3::Zero();  ///< friction
  };
  double push_apart(const ClothContact::Met& pair, Push& push, const std::vector<double>& inv_mass);
  void take_out(double dt, PackedCloth& cloth);
  void guard(std::span<const Vec4> x0, double dt, PackedCloth& cloth, ThreadPool& pool);
  void touch(const std::array<int, 4>& vertices);
  bool closes_in(const ClothContact::Met& pair) const;
  bool bound(const std::vector<ClothContact::Met>& pairs);
  void cut(const PackedCloth& cloth, const Vec3& common);
  Vec3 common_way(const PackedCloth& cloth) const;

  SelfContactOptions options_;
  std::unique_ptr<ClothContact> contact_;
  std::vector<double> least_radius_;  ///< by place: of the vertices that share a triangle with it [m]
  std::vector<Vec3> x0_, x_, way_;    ///< [m]
  std::vector<char> touched_, bounded_;
  std::vector<double> room_;  ///< by place: what a bounded one may move [m]
  std::vector<int> places_;   ///< touched
  std::vector<ClothContact::Met> met_;
  std::vector<Push> pushes_;
  std::int64_t cut_moves_ = 0;
};

}  // namespace furrow::physics
