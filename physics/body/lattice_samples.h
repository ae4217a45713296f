// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "physics/base/thread_pool.h"
#include "physics/body/exact_distance.h"

namespace furrow::physics {

using LatticePoint = std::array<int, 3>;

/// Exact distances at points of a cubic lattice, each point once. Points are added first and evaluated
/// together, so that several threads can share the work; the values depend on the order of adding only.
class LatticeSamples {
 public:
  /// A lattice of points low + unit * p, p in [0, 2^20]^3; `exact` must outlive it. threads >= 1.
  LatticeSamples(const ExactDistance& exact, const Vec3& low, double unit, int threads);

  /// Index of a point, new or not. `guess` is the index of an evaluated sample nearby.
  int add(const LatticePoint& p, int guess);
  /// The same without a guess.
  int add(const LatticePoint& p) { return add(p, static_cast<int>(samples_.size())); }
  /// Tells the processor that the point is to be added soon: the table of all points does not fit into its
  /// caches. Changes nothing.
  void expect(const LatticePoint& p) const;
  /// Evaluates what was added since the last call. Same values for any number of threads. `tell` is called by
  /// this thread, about every millisecond, with the share of the call that is done [0, 1]; what it throws
  /// ends the call, and the samples are then good for nothing.
  void evaluate(const std::function<void(double)>& tell = {});

  double value(int index) const { return samples_[index].value; }  ///< [m]
  int size() const { return static_cast<int>(samples_.size()); }

 private:
  Vec3 position(const LatticePoint& p) const { return low_ + unit_ * Vec3(p[0], p[1], p[2]); }
  struct Slot {
    std::uint64_t key;
    int next_index = 0;  ///< index + 1; 0 = free
  };
  std::size_t slot_of(std::uint64_t key) const;
  void evaluate_range(int begin, int end);
  std::optional<bool> inside_by_corners(const LatticePoint& p, double distance) const;
  void grow();

  const ExactDistance& exact_;
  Vec3 low_;
  double unit_;
  ThreadPool pool_;
  int evaluated_ = 0;
  std::vector<ExactDistance::Sample> samples_;
  std::vector<LatticePoint> points_;
  std::vector<int> guesses_;
  std::vector<Slot> slots_;  ///< open addressing
};

}  // namespace furrow::physics
