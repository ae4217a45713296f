// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/base/thread_pool.h"
#include "physics/pairs/pair_distance.h"
#include "physics/pairs/pair_mesh.h"
#include "physics/pairs/pair_search.h"

namespace furrow::physics {

/// A pair that may touch while the cloth is where the list expects it.
struct ListedPair {
  double range;  ///< range_of() [m]
  PairKey key;
  std::array<int, 4> vertices;
};
PairDistance distance_of(const ListedPair& pair, std::span<const Vec3> x);

/// One to four pairs of one kind in lanes, the last of them in all that are left; points by vertex.
inline FourPairs four_of(std::span<const ListedPair> pairs, std::span<const Float4> points) {
  std::array<const Float4*, 16> at;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      at[4 * i + j] = &points[std::size_t(pairs[std::min(i, pairs.size() - 1)].vertices[j])];
  return four_pairs(at);
}
/// Calls work(pairs, edges) for all pairs, at most four of one kind at a time.
template <class Work>
void each_four(std::span<const ListedPair> pairs, const Work& work) {
  for (std::size_t i = 0, n = 0; i < pairs.size(); i += n) {
    n = std::min<std::size_t>(4, pairs.size() - i);
    while (pairs[i + n - 1].key.edges != pairs[i].key.edges) --n;
    work(pairs.subspan(i, n), pairs[i].key.edges == 1);
  }
}

/// The pairs of a cloth that may come nearer than their range, kept from one position to the next. A vertex v
/// may be as far as a margin from a line x_v + s plan_v that the list was made for, with one s in [0, 1] for
/// all; where some vertices are farther, only what has one of them is looked for anew. Pairs that share a
/// vertex and those with all vertices held are none. Pairs are sorted by key. Which pairs touch does not
/// depend on the number of threads; what else is listed depends on the way there.
/// \details After a complete detection each later one has a base, the vertices that are still near their
/// lines, and movers: edges and triangles with a mover ask all others, in boxes that hold their own way,
/// while a pair of the base alone is nearer than its bound by no more than what its vertices left their
/// lines. It begins anew when more than a quarter of all vertices move, or these parts have cost as much as
/// the whole.
class PairList {
 public:
  /// An empty list. The mesh must outlive it.
  explicit PairList(const PairMesh& mesh) : mesh_(&mesh), search_(mesh) {}

  /// All pairs that may be nearer than their range somewhere on x + s way, s in [0, 1] (an empty way: at x),
  /// and some that are not; by vertices first, as PairDistance has them. Valid until the next call. x, way:
  /// one a particle [m]; margin >= 0 [m], of what is detected anew. Throws std::invalid_argument otherwise.
  /// Cost: some 20 ns a vertex where the list still holds, some 0.2 us a triangle where it is made anew, and
  /// 0.1 us a pair; where reach (range, margin and motion) is beyond an edge, pairs grow with the cube of it.
  /// ahead: a list that is made anew is made for so many times the way; >= 1.
  std::span<const ListedPair> near(std::span<const Vec3> x, std::span<const Vec3> way, double margin,
                                   ThreadPool* pool = nullptr, double ahead = 1);

  int builds() const { return builds_; }    ///< complete detections
  int patches() const { return patches_; }  ///< those of movers alone
  std::size_t size() const;                 ///< pairs that are kept

 private:
  /// A place where the cloth was, and where it went.
  struct Line {
    std::vector<Vec3> x, plan;  ///< plan: maybe empty
  };
  /// A pair of one kind.
  struct Listed {
    float bound;  ///< its distance, less its range and what the plan brings it nearer, is at least this [m]
    int first, second;
  };
  using Lists = std::array<std::vector<Listed>, 2>;  ///< as PairKey::edges, each sorted
  static bool before(const Listed& a, const Listed& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  }
  class Lister;
  Lists sorted(std::span<Lists> parts) const;
  template <bool edges>
  void pick(std::span<const Listed> pairs, const std::vector<double>& off, double most_off,
            const std::vector<char>* moves, std::vector<int>& picked) const;
  template <bool edges>
  void offer();
  bool holds(std::span<const Vec3> x, std::span<const Vec3> way);
  void build(std::span<const Vec3> x, std::span<const Vec3> plan, double margin, ThreadPool* pool);
  void patch(std::span<const Vec3> x, std::span<const Vec3> plan);

  const PairMesh* mesh_;
  double margin_ = -1;
  Line base_, patch_;
  FloatSweep sweep_;
  Vec3 origin_ = Vec3::Zero();
  std::vector<int> used_;  ///< vertices that triangles have
  PairSearch search_;
  std::vector<char> moves_;                   ///< by vertex: it left its base's line
  double base_most_ = 0;                      ///< of base_off_, of what does not move [m]
  std::vector<double> base_off_, patch_off_;  ///< by vertex: from its line on the way asked for, at most [m]
  Lists base_pairs_, patch_pairs_;
  std::vector<ListedPair> near_;
  std::vector<int> picked_, picked_of_patch_;  ///< kept for their memory
  std::size_t movers_ = 0, patched_ = 0;       ///< now; in all patches since the base
  int builds_ = 0, patches_ = 0;
};

}  // namespace furrow::physics
