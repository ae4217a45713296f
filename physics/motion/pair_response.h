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
/// tangential motion; momentum is kept. What was nearer before the step is no motion: it is taken out at a
/// speed of its own, without a velocity.
/// \details After that a guard cuts the moves of what would still pass through cloth: of all vertices of a
/// pair whose way is not free (time_of_impact()), and of what comes to be in their way, each to less than
/// half of its distance to anything. So no step ever crosses. Where nothing is near, nothing changes, bit by
/// bit. Pairs are handled in the order of their keys: same bits for any number of threads and any list.
/// Cost: some 20 ns a particle where nothing is near, some 0.2 us a pair that is.
class PairResponse {
 public:
  /// recovery_speed: of what was too near before [m/s]; > 0. Throws std::invalid_argument if an option is out
  /// of its range.
  PairResponse(const SelfContactOptions& options, double recovery_speed);
  /// To a cloth as it is, before all below. led: places of particles that move though they have no mass.
  /// Throws std::invalid_argument if it has no triangles.
  void attach(const PackedCloth& cloth, std::span<const int> led, ThreadPool& pool);

  /// The cloth came from x0 [m] to its positions in dt seconds: corrects positions and velocities. Returns
  /// the places whose particles were moved, valid until the next call.
  const std::vector<int>& respond(std::span<const Vec4> x0, double dt, PackedCloth& cloth, ThreadPool& pool);
  /// After respond() and what else moves the places that it returned. Throws StepBlocked, positions as in x0, if a particle
  /// that is held would have to be cut.
  void guard(std::span<const Vec4> x0, double dt, PackedCloth& cloth, ThreadPool& pool);

  /// Now and then, before a step: lets pairs that crossed at the start, or were too near, take part.
  void widen(const PackedCloth& cloth);
  SelfContactMemory memory() const;
  void recall(const SelfContactMemory& memory);
  SelfContactState state(const PackedCloth& cloth) const;
  std::int64_t cut_moves() const { return cut_moves_; }  ///< of particles, by the guard, since it is attached
  int list_builds() const { return contact_->list_builds(); }

 private:
  struct Pushed {
    bool edges;
    std::array<int, 4> vertices;
  };
  void note_ways(std::span<const Vec4> x0, const PackedCloth& cloth);
  void push_apart(const ClothContact::Met& pair, double dt, const std::vector<double>& inv_mass);
  void take_out(const ClothContact::Met& pair, double depth, const Vec3& along, double dt,
                const std::vector<double>& inv_mass);
  void touch(const std::array<int, 4>& vertices);
  bool bound(const std::vector<ClothContact::Met>& pairs);
  void cut(const PackedCloth& cloth, const Vec3& common);
  Vec3 common_way(const PackedCloth& cloth) const;

  SelfContactOptions options_;
  double recovery_speed_;
  std::unique_ptr<ClothContact> contact_;
  std::vector<double> least_radius_;  ///< by place: of the vertices that share a triangle with it [m]
  std::vector<Vec3> x0_, x_, way_;    ///< [m]
  std::vector<Vec3> taken_;           ///< out of old depth [m]
  std::vector<char> touched_, bounded_;
  std::vector<double> room_;  ///< by place: what a bounded one may move [m]
  std::vector<int> places_;   ///< touched
  std::vector<Pushed> pushed_;
  bool clear_ = true;  ///< of the last step: nothing was pushed, and nothing passes through anything
  std::int64_t cut_moves_ = 0;
};

}  // namespace furrow::physics
