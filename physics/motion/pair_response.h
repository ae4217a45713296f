// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "physics/base/thread_pool.h"
#include "physics/motion/simulate.h"
#include "physics/packed/packed_cloth.h"
#include "physics/pairs/pair_pushes.h"

namespace furrow::physics {

/// Contact of a cloth with itself for steps that do not solve it, as BodyContact is that with a body
/// (methods S2.9, S2.10): PairPushes on positions, shared by mass, so momentum is kept, and the velocities of
/// a step that goes that way. What was nearer before the step is no motion: a push that grows with it takes
/// it out, and bears loads that sweeps do not. After that the guard: so no step crosses.
/// \details Where nothing is near, nothing changes, bit by bit. Same bits for any number of threads. Cost:
/// some 20 ns a particle where nothing is near, some 0.2 us a pair that is.
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
  const std::vector<int>& touched() const { return pushes_->touched(); }
  /// After the sweeps and what else moves the places that they touched: takes out old depth, and cuts what
  /// would pass through cloth. Throws StepBlocked, positions as in x0, if a particle that is held would have
  /// to be cut.
  void finish_step(std::span<const Vec4> x0, double dt, PackedCloth& cloth, ThreadPool& pool);

  /// Now and then, before a step: lets pairs that crossed at the start, or were too near, take part.
  void widen(const PackedCloth& cloth);
  SelfContactMemory memory(const PackedCloth& cloth) const;
  void recall(const StepMemory& known, const PackedCloth& cloth);
  SelfContactState state(const PackedCloth& cloth) const;
  std::int64_t cut_moves() const { return cut_moves_; }  ///< of particles, by the guard, since it is attached
  int list_builds() const { return pushes_->contact().list_builds(); }

 private:
  void take_touched(const PackedCloth& cloth);
  void take_out(double dt, PackedCloth& cloth);

  SelfContactOptions options_;
  std::unique_ptr<PairPushes> pushes_;
  std::vector<Vec3> x0_, x_;  ///< [m]
  std::int64_t cut_moves_ = 0;
};

}  // namespace furrow::physics
