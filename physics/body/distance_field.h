// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "physics/base/progress.h"
#include "physics/body/exact_distance.h"

namespace furrow::physics {

enum class GradientRule {
  exact_derivative,     ///< the gradient of the interpolated value: jumps a little between cells
  interpolated_corners  ///< the paper's: trilinear in the corners' gradients; continuous, not the value's
                        ///< gradient
};

struct DistanceFieldOptions {
  std::optional<double> tolerance;  ///< error in the band [m]; > 0; default min(1e-3 diagonal, 2 mm)
  double outer_band = 0.03;         ///< where `tolerance` holds, outside the body [m]; >= 0
  double inner_band = 0.02;         ///< and inside [m]; >= 0
  double far_slope = 0.35;          ///< allowed error gained for each metre beyond the band [-]; 0 ... 1
  double margin = 0.06;             ///< of the field's cube around the bounding box [m]; > 0
  int band_depth = 6;               ///< least depth of cells that meet the band; 3 ... max_depth
  int max_depth = 10;               ///< edge of the smallest cell = cube / 2^max_depth; 3 ... 12
  GradientRule gradient = GradientRule::exact_derivative;
  std::int64_t most_samples = 0;  ///< exact distances that a build may take; 0: as many as it needs
  int threads = 1;                ///< of the build; 1 ... 256; the result does not depend on it
};

struct DistanceFieldReport {
  double tolerance = 0;         ///< [m]
  int leaves = 0, samples = 0;  ///< cells; exact distances computed
  int depth = 0;                ///< of the deepest leaf
  int leaves_at_max_depth = 0;  ///< where the tolerance may be missed
  double largest_repair = 0;    ///< largest change of a corner value for continuity [m]
  SignReport sign;
};

/// Adaptively sampled signed distance of a body, for many fast queries. Continuous everywhere; inside its
/// cube the error is about `tolerance` in the band and grows by far_slope beyond it. Outside the cube the
/// value is that of the closest point of the cube plus the distance to it, the gradient points away from the
/// cube. Sources: method S1.9 and S1.20; Frisken et al. 2000.
class DistanceField : public Collider {
 public:
  /// Any soup that ExactDistance takes. std::invalid_argument names a bad option or vertex, or says that the
  /// tolerance asks for more leaves than a field can hold; TooMuchWork for more samples than most_samples, at
  /// the first level of the tree that would pass it; Cancelled if `progress` said no.
  /// Cost: about 1 us and 110 bytes for each of the body's samples, some 300,000 at the default tolerance.
  static DistanceField build(const TriangleMesh& mesh, const DistanceFieldOptions& options = {},
                             const Progress& progress = {});
  static DistanceField build(const ExactDistance& exact, const DistanceFieldOptions& options = {},
                             const Progress& progress = {});

  /// 10 to 25 ns; NaN for a NaN point.
  SignedDistance at(const Vec3& x) const override;
  /// The mean of at() over a cube of 0.1 mm (at most half a cell of the finest lattice) around x: continuous
  /// in its gradient within the field's cube, and equal to at() farther than half of that from a cell's face.
  /// Exact, since what is averaged is trilinear on either side of a face. 1 to 8 queries, 1.2 in the mean.
  SignedDistance smooth_at(const Vec3& x) const override;

  const DistanceFieldReport& report() const { return report_; }
  double allowed_error(double distance) const;  ///< tolerance, and more beyond the band [m]
  const Vec3& low() const { return low_; }      ///< lowest corner of the cube [m]
  double size() const { return size_; }         ///< edge of the cube [m]
  std::size_t memory() const;                   ///< [bytes] of tables and leaves

  /// The whole field as one little-endian block with a magic word and a version; from_bytes() gives it back
  /// bit for bit, or throws std::invalid_argument when the block is cut, of another version or contradicts
  /// itself.
  std::vector<std::byte> to_bytes() const;
  static DistanceField from_bytes(std::span<const std::byte> bytes);

 private:
  /// How the leaf of a point is found in three steps without a loop: a dense top table names a brick, a dense
  /// table of 2^k cells along each edge, which names the leaf. 32 bits each:
  ///   top cell     k in the four highest bits, the place of the brick's first cell in the others;
  ///   brick cell   leaf: leaf_bit, its level in four bits, its index; node (below brick_depth levels only):
  ///   its index; node child   leaf: leaf_bit and its index; node: its index.
  using Entry = std::uint32_t;
  static constexpr Entry leaf_bit = 1u << 31;
  static constexpr int level_shift = 27;
  static constexpr Entry level_mask = 15, index_mask = (1u << level_shift) - 1;
  static constexpr int brick_shift = 28;
  static constexpr Entry brick_mask = (1u << brick_shift) - 1;
  static constexpr int brick_depth = 3;  ///< largest k

  using Leaf = std::array<float, 8>;
  using LeafGradient = std::array<std::array<float, 3>, 8>;

  DistanceField() = default;
  void take(const class DistanceOctree& octree);
  void index();
  void read_tree(class ByteReader& in);
  void fill_top(Entry entry, int level, const std::array<int, 3>& low);
  Entry add_brick(Entry entry, int level);
  void fill_brick(Entry entry, int level, const std::array<int, 3>& low, int left, int depth,
                  std::size_t base);
  int depth_below(Entry entry) const;
  struct TreeCheck;
  struct Cell {
    std::array<double, 3> t;  ///< lattice coordinates, clamped into the cube
    std::array<int, 3> i;     ///< of the finest cell there
  };
  struct Place {
    std::uint32_t leaf;
    int level;
  };
  Place find(int ix, int iy, int iz) const;
  Cell cell_of(const Vec3& x) const;
  SignedDistance value_at(const Vec3& x, const Cell& cell, const Place& place) const;
  SignedDistance inside_at(const Cell& cell, const Place& place) const;
  Vec3 corner_gradient_at(std::size_t leaf, const Vec3& u) const;

  Vec3 low_;
  double size_ = 0, per_unit_ = 0;  ///< per_unit_: lattice units a metre
  int max_depth_ = 0, top_depth_ = 0;
  double outer_band_ = 0, inner_band_ = 0, far_slope_ = 0;
  GradientRule gradient_ = GradientRule::exact_derivative;
  std::vector<Entry> top_;                    ///< dense table of bricks at depth top_depth_, z slowest
  std::vector<Entry> bricks_;                 ///< tables of 2^k x 2^k x 2^k leaves (or nodes), z slowest
  std::vector<std::array<Entry, 8>> nodes_;   ///< depth first, the root is node 0
  std::vector<Leaf> leaves_;                  ///< values of the corners 0 4 1 5 2 6 3 7 [m]
  std::vector<LeafGradient> leaf_gradients_;  ///< only with interpolated_corners
  std::array<double, 13> cells_a_unit_{};     ///< a level: 1 / edge in lattice units
  DistanceFieldReport report_;
};

}  // namespace furrow::physics
