// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "physics/base/contact_term.h"
#include "physics/base/thread_pool.h"
#include "physics/linear/free_stiffness.h"
#include "physics/pairs/ease_around.h"
#include "physics/pairs/edge_face_crossings.h"
#include "physics/pairs/pair_friction.h"
#include "physics/pairs/pair_list.h"

namespace furrow::physics {

struct ClothContactOptions {
  double thickness = 0.001;  ///< of the cloth: layers are that far apart, a little less under load [m]; > 0
  double stiffness = 500;    ///< k of barrier() [N/m]; > 0
  double friction = 0;       ///< Coulomb coefficient of cloth on cloth [-]; >= 0
  std::span<const double> thicknesses = {};  ///< of each particle, in place of `thickness` [m]; empty: none
  std::span<const int> groups = {};          ///< PairMesh::group
};

/// Contact of a cloth with itself as a potential, for callers that look for rest: pairs of vertex and
/// triangle, and of edges, repel each other nearer than their range (pair_mesh.h) by barrier(), and have
/// PairFriction. A cloth that does not cross itself never will if each position it takes is reached by a
/// straight way within what safe_share() allows. Nothing changes where nothing is near, bit by bit. \details
/// Pairs that start, or were drawn, nearer than their range have a range of 0.9 of that distance: nothing
/// that was drawn is pushed, but where cloth was drawn through cloth, and two rings of vertices around that.
/// Those that were not drawn so grow by a fifth with each call of widen(). Pairs of
/// an edge and a face that cross at the start, and those nearer than 1e-7 m, do not count until widen() finds
/// them apart; within a ring around them, neither do pairs that cross in their place, so that crossings can
/// leave as they came. Results depend neither on the number of threads nor on the list's margin.
class ClothContact : public ContactTerm {
 public:
  /// start: positions at the start. drawn: in which nothing is to be pushed; may be empty. Throws
  /// std::invalid_argument if an option is out of its range or lengths differ.
  ClothContact(const Cloth& cloth, const ClothContactOptions& options, std::span<const Vec3> start,
               std::span<const Vec3> drawn, ThreadPool* pool = nullptr);
  /// A pair whose range is not that of its primitives; 0: it is exempt.
  struct SpecialPair {
    PairKey key;
    double range, target;  ///< [m]
  };
  /// All that later results depend on, beside positions.
  struct Memory {
    std::vector<SpecialPair> special;  ///< sorted by key
    std::vector<int> loose;            ///< vertices where something crossed at the start, or next to such
    int crossed_at_start = 0;
    std::vector<PairAnchor> friction;  ///< sorted by key
    std::vector<int>
        fresh;  ///< vertices of which, and of their neighbours, it knows nothing; of memory(): none
  };
  Memory memory() const;
  /// Goes on at x, which counts with friction only, as one that had this memory there; where that knows
  /// nothing, as it was made. Throws std::invalid_argument if it is of another cloth.
  void recall(const Memory& memory, std::span<const Vec3> x, ThreadPool* pool);
  /// A new search begins: no way of it was cut.
  void forget_cuts();

  ClothContact(const ClothContact&) = delete;
  ClothContact& operator=(const ClothContact&) = delete;

  /// The largest share, at most `most`, of a move [m] from x at which nothing has passed through anything:
  /// less than `most` only where the way is cut, or leads a thousand kilometres; 0 if it is not finite.
  double safe_share(std::span<const Vec3> x, std::span<const Vec3> move, double most,
                    ThreadPool* pool) override;
  /// Moves x towards other positions [m], each vertex until something is in its way. Returns how many did not
  /// arrive. For starts: a vertex that was stopped stays, however far the others go.
  /// Throws Cancelled, some way gone.
  int approach(std::span<Vec3> x, std::span<const Vec3> to, ThreadPool* pool);
  /// A pair that is near on a way.
  struct Met {
    PairKey key;
    std::array<int, 4> vertices;
    double range;         ///< at which its primitives push each other now [m]; > 0
    PairDistance before;  ///< where the way begins
    double share;         ///< of the way that it can go (time_of_impact())
  };
  /// The pairs nearer than the thickness at x or at x + move [m], and those that would touch on the way; by
  /// key, without those that are exempt. The same for any list. Valid until the next call.
  const std::vector<Met>& meet(std::span<const Vec3> x, std::span<const Vec3> move, ThreadPool* pool);
  /// Finds the pairs that touch at x. The answers below are for these positions.
  void look(std::span<const Vec3> x, ThreadPool* pool);
  void look(std::span<const Vec3> x, std::span<const double>, ThreadPool* pool) override { look(x, pool); }
  /// [J]; infinite where something touches
  double energy() const override { return energy_ + friction_.energy(); }
  void add_forces(std::span<Vec3> force) const override;
  /// The particles (i, j), i after j, that pairs couple now: sorted, each once.
  std::vector<std::array<int, 2>> couples() const;
  /// Whether the matrix lacks blocks that pairs need.
  bool misses_blocks(const FreeStiffness& stiffness) const;
  /// Gives the matrix the blocks that pairs need and that are not there yet; before it is assembled.
  void couple(FreeStiffness& stiffness) const;
  /// Positive semidefinite; after couple(). Where the way was cut to less than 1/32, the pairs that did so
  /// count as if they were half their range apart.
  void add_stiffness(FreeStiffness& stiffness, SlipStiffness of_slip = SlipStiffness::none) const override;
  /// As those of AnchoredContact, of the friction between layers. Limits change once in a search.
  void move_anchors(std::span<const Vec3> x) override { friction_.move_anchors(active_, x); }
  void expect(std::span<const Vec3> move, bool again = false) override {
    if (!again) friction_.expect(active_, move);
  }
  /// Pairs that push each other since the last move_anchors() have friction from the start on.
  bool hold_new(const StageStart& start, std::span<const Vec3> x) override;
  /// Short where cloth touches cloth [m]: few pairs are on its way.
  double longest_move() const override { return acts() ? 0.02 : ContactTerm::longest_move(); }
  std::optional<std::vector<int>> pushed() const override {
    return acts() ? std::nullopt : std::optional(std::vector<int>{});
  }
  std::vector<PairAnchor> anchors() const { return friction_.anchors(); }
  /// As before, x being where move_anchors() was called then: looks there.
  void set_anchors(std::span<const PairAnchor> anchors, std::span<const Vec3> x, ThreadPool* pool);
  /// Once an iteration: ranges grow, and pairs that were exempt take part once they are apart. Whether
  /// something changed or will go on changing; then look() again.
  bool widen(std::span<const Vec3> x);

  bool acts() const { return !active_.empty() || !friction_.empty(); }  ///< it has forces
  bool rubs() const override { return options_.friction > 0 && acts(); }
  /// Whether it has changed anything so far: something crossed or lay nearer than its range, or a way was
  /// cut.
  bool has_acted() const { return acted_; }
  int touching() const { return int(active_.size()); }  ///< pairs nearer than their range
  int sliding() const { return friction_.sliding(); }   ///< of them, at the limit of their friction
  double nearest() const;                               ///< of them [m]; infinite: none
  int list_builds() const { return list_.builds(); }    ///< complete detections of what is near
  int cut_searches() const { return cut_searches_; }
  int blocked() const { return blocked_; }  ///< ways cut to less than 1/32, running
  /// What cut the way that was asked of last to less than half.
  std::span<const MoveCut> cuts() const { return cuts_; }
  std::optional<Vec3> blocked_at() const { return blocked_at_; }  ///< the pair that cut the last one [m]
  int crossed_at_start() const { return crossed_at_start_; }      ///< edges through faces
  int exempt() const;                                             ///< pairs that do not count yet
  const PairMesh& mesh() const { return mesh_; }

 private:
  /// A listed pair that is nearer than its range now.
  struct Touching {
    std::size_t listed;
    double range;  ///< [m]
    PairDistance distance;
  };
  class Ranges;
  static bool active_before(const ActivePair& a, const ActivePair& b);
  std::vector<char> around(const std::vector<EdgeFaceCrossing>& crossings) const;
  void note_drawn(std::span<const Vec3> drawn, PairList& list, ThreadPool* pool);
  void find_special(std::span<const Vec3> x, std::span<const Vec3> drawn, ThreadPool* pool);
  void note_near(std::span<const Vec3> x, bool at_start, PairList& list, ThreadPool* pool);
  const SpecialPair* special_of(const PairKey& key) const;
  bool is_loose(const EdgeFaceCrossing& crossing) const;
  std::vector<PairKey> crossed_now(std::span<const Vec3> x) const;
  void check(const Memory& memory) const;
  std::vector<char> with_neighbours(std::vector<char> marked) const;
  double range_now(const ListedPair& pair) const;
  std::vector<std::array<int, 2>> needed_blocks() const;
  ActivePair brace(const ListedPair& pair, std::span<const Vec3> x) const;
  void find_touching(std::span<const ListedPair> pairs, std::span<const Vec3> x, std::size_t begin,
                     std::size_t end, std::vector<Touching>& found) const;
  ActivePair answer(const ListedPair& pair, const Touching& touching, std::span<const Vec3> x) const;
  void find_met(std::span<const ListedPair> pairs, std::span<const Vec3> x, std::span<const Vec3> move,
                std::vector<Met>& found) const;
  const std::vector<double>& shares(std::span<const ListedPair> pairs, std::span<const Vec3> x,
                                    std::span<const Vec3> move, double most, ThreadPool* pool);
  std::span<const ListedPair> near(std::span<const Vec3> x, std::span<const Vec3> way, ThreadPool* pool,
                                   double ahead = 1);
  std::span<const ListedPair> pairs_on_way(std::span<const Vec3> x, std::span<const Vec3> move, double most,
                                           ThreadPool* pool);

  ClothContactOptions options_;
  PairMesh mesh_;
  PairList list_{mesh_};
  std::vector<SpecialPair> special_;  ///< sorted by key
  std::vector<char> loose_;           ///< by vertex: something crossed there at the start, or next to it
  FloatSweep lanes_;                  ///< where it was looked last, and the move that was asked for
  std::vector<std::vector<Touching>> touching_;  ///< by chunks; kept for its memory
  std::vector<double> shares_;                   ///< likewise
  std::vector<std::vector<Met>> met_of_;         ///< by chunks, likewise
  std::vector<Met> met_;
  std::vector<ActivePair> active_;  ///< sorted by key
  std::vector<ActivePair> braced_;  ///< that cut the last way short
  std::vector<MoveCut> cuts_;       ///< by half and more
  PairFriction friction_;
  double energy_ = 0, margin_share_;
  bool acted_ = false;
  int cut_searches_ = 0, blocked_ = 0, crossed_at_start_ = 0;
  std::optional<Vec3> blocked_at_;
};

}  // namespace furrow::physics
