// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "physics/base/progress.h"
#include "physics/body/lattice_samples.h"

namespace furrow::physics {

/// Where and how finely a distance is needed.
struct RefinementRule {
  double tolerance;               ///< largest error at the test points in the band [m]; > 0
  double outer_band;              ///< the band's reach outside the body [m]; >= 0
  double inner_band;              ///< and inside [m]; >= 0
  double far_slope;               ///< tolerance gained for each metre beyond the band [-]; >= 0
  int min_depth;                  ///< of every leaf
  int band_depth;                 ///< of every leaf that meets the band
  int max_depth;                  ///< of any leaf
  std::int64_t most_samples = 0;  ///< 0: as many as it takes

  /// allow(d) = tolerance + far_slope * (how far d lies outside the band) [m].
  double allowed_error(double distance) const;
};

/// A cube of an octree on the lattice [0, 2^max_depth]^3. Corner and child c lies at bit 0 of c in x, 1 in y,
/// 2 in z.
struct OctreeCell {
  LatticePoint low;
  int level;                  ///< edge = 2^(max_depth - level) lattice units
  int first_child = 0;        ///< of eight in a row; 0 in a leaf
  std::array<int, 8> corner;  ///< indices of samples
};

/// Octree whose leaves' trilinear interpolation of the corner values approximates a signed distance.
/// Refined top down with the 19-point test (centre, face centres, edge midpoints: the corners of the
/// children, so no sample is lost), balanced 2:1 over faces, edges and corners, and made continuous by "the
/// coarsest wins". Sources: Frisken et al. 2000; method S1.9.
class DistanceOctree {
 public:
  /// Throws Cancelled if `progress` says no, whose share counts levels; TooMuchWork before a level that would
  /// pass most_samples.
  DistanceOctree(LatticeSamples& samples, const RefinementRule& rule, double unit,
                 const Progress& progress = {});

  const std::vector<OctreeCell>& cells() const { return cells_; }  ///< the root first
  const std::vector<double>& values() const { return values_; }    ///< a sample: its value, continuous [m]
  double largest_repair() const { return largest_repair_; }        ///< change of a value for continuity [m]
  /// A sample: mean of the slopes of the leaves around it, continuous like the values [-]; zero where no
  /// corner is.
  std::vector<Vec3> corner_gradients() const;

 private:
  struct Hanging {
    int sample;
    int coarse;  ///< the coarsest leaf around it, of which it is no corner
  };
  void refine(const Progress& progress);
  double tolerance_of(const OctreeCell& cell, const std::array<int, 27>& lattice) const;
  double tolerance_for(std::size_t cells, const std::vector<std::array<int, 27>>& lattices,
                       std::size_t first) const;
  void check_next_level(std::size_t first, std::size_t last, int samples_before,
                        const std::vector<std::array<int, 27>>& lattices) const;
  bool must_split(const OctreeCell& cell, const std::array<int, 27>& lattice) const;
  std::array<int, 27> add_lattice(const OctreeCell& cell);
  void append_children(int cell);
  void balance();
  void split_down_to(const LatticePoint& p, int level, std::vector<std::vector<int>>& split);
  void find_hanging();
  void repair();
  int edge(const OctreeCell& cell) const { return 1 << (rule_.max_depth - cell.level); }
  int leaf_at(const LatticePoint& p) const;
  LatticePoint corner_point(const OctreeCell& cell, int corner) const;

  LatticeSamples& samples_;
  RefinementRule rule_;
  double unit_;
  std::vector<OctreeCell> cells_;
  std::vector<double> values_;
  std::vector<Hanging> hanging_;  ///< from the coarsest leaves to the finest
  std::vector<LatticePoint> hanging_points_;
  double largest_repair_ = 0;
};

}  // namespace furrow::physics
