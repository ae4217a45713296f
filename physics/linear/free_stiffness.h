// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "physics/cloth/element_blocks.h"
#include "physics/linear/block_cholesky.h"

namespace furrow::physics {

/// The stiffness matrix K [N/m] of the particles that are not held (inv_mass > 0), sparse, and its factors.
/// Where the blocks lie, the orders of elimination and the factor's pattern are found once; assembly and
/// factorisation use them again.
class FreeStiffness {
 public:
  /// Cost: O(blocks log blocks) and later the symbolic factorisation. Throws std::invalid_argument if the
  /// particles' arrays differ in length, and as add_stiffness().
  /// narrow: the Stiffness that assemble() takes, whatever it is told.
  explicit FreeStiffness(const Cloth& cloth, bool narrow = false);

  /// Whether a cloth has the same elements between the same particles, and the same held ones: then
  /// assemble() serves it, too. Cost: as the constructor's first half.
  bool belongs_to(const Cloth& cloth) const;
  bool narrow() const { return narrow_; }

  /// K at positions x [m]. The cloth has the elements and held particles of the constructor's; other
  /// stiffnesses and rest states are welcome. pool: threads that share the work (null: the caller alone);
  /// same bits. Throws std::invalid_argument if a kind has another number of elements, and as
  /// add_stiffness().
  void assemble(const Cloth& cloth, std::span<const Vec3> x, Stiffness stiffness, ThreadPool* pool = nullptr);

  /// The same from blocks that `make` writes: those of the elements [begin, end), as stiffness_blocks().
  using MakeBlocks = std::function<void(int begin, int end, Mat3* blocks)>;
  void assemble(const MakeBlocks& make, ThreadPool* pool = nullptr);
  const ElementCounts& counts() const { return counts_; }

  /// Adds a symmetric block [N/m] to K's diagonal block of a particle, until the next assemble(); a held
  /// particle's is left out.
  void add(int particle, const Mat3& block);
  /// The same of the block (i, j) and its mirror image; elements, or couple(), couple the two.
  void add(int i, int j, const Mat3& block);
  using Pairs = std::vector<std::array<int, 2>>;
  /// Gives K's pattern the blocks of these pairs of particles beside those of the elements, in place of those
  /// of an earlier call. Call assemble() next. Cost: O(blocks), and fronts for the next factorisation, whose
  /// order of elimination is kept while it serves (BlockCholesky::analyse_like()).
  void couple(Pairs pairs);
  /// The pairs that were coupled when the order of elimination was last found.
  const Pairs& ordered_for() const { return ordered_for_; }
  /// Couples these and finds the order for them: then couple() goes on as where that was done before.
  void order_for(Pairs pairs);
  /// Whether K's pattern couples two particles, or one is held.
  bool couples(int i, int j) const { return matrix_.has(i, j); }

  /// Negative eigenvalues of K, -1 if that cannot be told (negative_pivots()).
  int negative_eigenvalues() const;
  /// K + shift I = L L^T, shift [N/m], by dense fronts (BlockCholesky); false if it is not positive definite.
  /// pool: threads that share the work (null: the caller alone).
  bool factorise_definite(double shift = 0, ThreadPool* pool = nullptr);
  /// The same of K in single precision (BlockCholesky::factorise_single()), for directions of a search.
  bool factorise_single(ThreadPool* pool = nullptr);
  /// b becomes the solution in rows of free particles, 0 in the others. Needs factorise_definite() true.
  void solve(std::span<Vec3> b, ThreadPool* pool = nullptr) const;
  /// The same with factors of single precision, which solve once more for what is left where that is more
  /// than `least` of b [-]. false, and b is as it was: it is too much then, too.
  bool solve_within(double least, std::span<Vec3> b, ThreadPool* pool = nullptr) const;

  /// Mean of the diagonal of K [N/m], 0 if nothing is free: a scale for shifts.
  double mean_diagonal() const;
  /// K v, 0 in rows of held particles, whose entries count as 0.
  std::vector<Vec3> times(std::span<const Vec3> v) const;
  int free_particles() const { return matrix_.rows(); }

 private:
  /// A block of an element that counts, and where.
  struct Addend {
    int block;  // in its chunk
    BlockMatrix::Place place;
  };
  void place_blocks(const Pairs& pairs);
  void analyse(bool anew = false);
  void sum(int chunk, int bucket);

  bool narrow_ = false;
  std::size_t particles_ = 0;
  std::uint64_t pattern_ = 0;         ///< a hash of the pairs that elements couple
  ElementCounts counts_;              ///< of elements of each kind
  std::vector<Addend> addends_;       ///< chunk by chunk of elements; in a chunk by buckets of columns
  std::vector<std::size_t> buckets_;  ///< where each begins, and the end
  std::vector<Mat3> blocks_;          ///< of a chunk
  BlockMatrix matrix_;
  BlockMatrix own_;                             ///< of elements alone, once more was coupled
  std::vector<BlockMatrix::Place> own_places_;  ///< of each addend in that
  Pairs coupled_, ordered_for_;
  BlockCholesky definite_;
  bool analysed_ = false, ordered_ = false;  // definite_: for this pattern; ever
};

}  // namespace furrow::physics
