// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/base/thread_pool.h"
#include "physics/pairs/pair_mesh.h"

namespace furrow::physics {

/// A pair that may touch while the cloth is where the list expects it.
struct ListedPair {
  double bound;  ///< its distance, less its range and what the plan brings it nearer, is at least this [m]
  double range;  ///< range_of() [m]
  PairKey key;
  std::array<int, 4> vertices;
};

/// The pairs of a cloth that may come nearer than their range while no vertex v is farther than a margin from
/// the line x_v + s plan_v, with one s in [0, 1] for all; sorted by their bound, then by key, so that near
/// the line a look reads only the front of the list. Pairs that share a vertex and those with all vertices
/// held are none. The same pairs in the same order for any number of threads.
class PairList {
 public:
  /// An empty list, which holds nowhere.
  PairList() = default;
  /// plan: the motion to come, one a particle [m]; empty: none. margin >= 0 [m]. The mesh must outlive the
  /// list. Throws std::invalid_argument if lengths differ. Cost: about 1 us a triangle where reach (range,
  /// margin and motion) is small against the edges, more with the cube of it beyond.
  PairList(const PairMesh& mesh, std::span<const Vec3> x, std::span<const Vec3> plan, double margin,
           ThreadPool* pool = nullptr);

  std::span<const ListedPair> pairs() const { return pairs_; }
  double margin() const { return margin_; }
  /// How far the farthest vertex is from the plan's line, s chosen to fit x [m]; infinite for an empty list.
  /// The list says all as long as this is at most margin().
  double excess(std::span<const Vec3> x) const;
  /// The front of the list: all pairs that may be nearer than their range where excess() is this much.
  std::span<const ListedPair> within(double excess) const;

 private:
  double margin_ = -1;
  std::vector<Vec3> x_, plan_;
  std::vector<ListedPair> pairs_;
};

}  // namespace furrow::physics
