// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "physics/linear/free_stiffness.h"
#include "physics/motion/motion.h"
#include "physics/motion/step_contact.h"
#include "physics/motion/step_elements.h"
#include "physics/pairs/cloth_contact.h"

namespace furrow::physics {

/// A stage of an implicit step as a minimum over the free particles' positions x of
///   s/2 |x - y|^2_M + E(x) - (m g + f) . x + C(x) + c/(2p) |p x + q - w|^2_M,
/// E of the elements, C of contact, c the air's drag; p x + q is the stage's velocity.
struct Stage {
  double s;                ///< [1/s^2]; > 0
  double p;                ///< [1/s]; > 0
  std::vector<Vec3> y, q;  ///< one a particle [m], [m/s]
};

/// What is given in a whole step.
struct StepLoads {
  std::vector<Vec3> force;  ///< f, one a particle [N]; empty: none
  std::vector<Vec3> air;    ///< w [m/s]; empty: at rest
};

struct SearchOptions {
  double tolerance;  ///< root mean square of the next move that ends it, a third of the longest [m]; > 0
  /// Newton's iterations: after `few` a next move 20 times as long is good enough that changes no edge by
  /// more than a fifth, and after `most`, where that is more, it need be so short in the mean alone.
  int few, most;
  /// In the first iteration, and after a move that was shortened, what slides is held back by its secant
  /// (SlipStiffness); limits of friction of what came to touch are those of the second move's push.
  bool careful = false;
  /// The factors of searches before serve one whose first move is short and that touches what they did.
  bool keep_factors = false;
};

/// What elements do at a place.
struct ElementAnswer {
  double energy = 0;       ///< [J]
  std::vector<Vec3> pull;  ///< one a particle [N]
};

/// Forces where a search ended, one a particle [N].
struct FoundForces {
  ElementAnswer elements;
  std::vector<Vec3> body;   ///< of the body, as the motion had it; empty: none
  std::vector<Vec3> cloth;  ///< of cloth on cloth, and of all other contacts; empty: none
};

struct SearchEnd {
  bool converged;  ///< as the options ask
  int iterations;
};

/// Looks for the minima of stages, all on one cloth, by Newton's method with the positive part of the
/// stiffness, a fresh factorisation each iteration, and a line search. A factorisation serves twice where the
/// move is short. Where the body was met, a search that has ended goes on until the limits of friction are
/// those of the push that it found, so that what lands or slides loses the momentum that Coulomb's law says.
/// It keeps room and symbolic work, but nothing that a result depends on unless `keep_factors`.
class StepSearch {
 public:
  /// cloth: that of the motion, by place; its particles' masses and elements count, and must stay. contact:
  /// null: no body; pairs: null: the cloth passes through itself; others: further ones, by place.
  StepSearch(const Cloth& cloth, Motion& motion, StepContact* contact, ClothContact* pairs,
             std::span<const std::unique_ptr<ContactTerm>> others);

  /// From x, which becomes where the search ended. Throws Cancelled.
  SearchEnd find(const Stage& stage, const StepLoads& given, const StageStart& start,
                 const SearchOptions& options, std::vector<Vec3>& x);
  /// Where the last search ended, before anchors are moved.
  FoundForces found() const;
  /// Friction takes hold where the last search ended, at x.
  void hold(std::span<const Vec3> x);
  ElementAnswer elements_at(std::span<const Vec3> x);
  /// Half of the mean diagonal of the elements' stiffness at x [N/m], 1 without: a scale for contact.
  double contact_stiffness(std::span<const Vec3> x);
  double mean_mass() const;  ///< of a free particle [kg]; 0 without
  /// Pairs of particles that the matrix has blocks for beside those of elements.
  const FreeStiffness::Pairs& coupled() const { return coupled_; }
  /// And those that it had when its order of elimination was found.
  const FreeStiffness::Pairs& ordered_for() const { return stiffness_.ordered_for(); }
  /// Goes on as one that had these.
  void couple(FreeStiffness::Pairs pairs, FreeStiffness::Pairs ordered_for);

 private:
  /// What was made of a move.
  struct Way {
    double share;  ///< 0: nothing
    bool cut;      ///< as the cloth is in its own way, to less than half
    bool room;     ///< was made for what the body pushes from two sides: the energy is another one now
  };
  /// Of a move [m].
  struct Lengths {
    double mean, longest;  ///< root mean square by mass; of any particle
  };
  struct Answer {
    std::vector<Vec3> net;   ///< minus the gradient [N]; 0 on what is held
    std::vector<Vec3> pull;  ///< of the elements alone [N]
    double energy;           ///< [J]
    double elements;         ///< of these alone [J]
    double terms;            ///< sum of the sizes of what it is the sum of: rounding's scale [J]
  };
  Answer look(const std::vector<Vec3>& x);
  /// What a contact costs counts as a part of its own.
  struct Contact {
    ContactTerm* term;
    WorkPart part;
  };
  bool rubs() const;
  std::optional<std::vector<int>> pushed() const;
  bool hold_new(const StageStart& start, const std::vector<Vec3>& x);
  void add_contact(const std::vector<Vec3>& x, Answer& answer);
  void add_stage(const std::vector<Vec3>& x, Answer& answer) const;
  void assemble(const std::vector<Vec3>& x, SlipStiffness of_slip);
  void couple(FreeStiffness::Pairs pairs);
  void couple_pairs();
  void factorise(const std::vector<Vec3>& x, SlipStiffness of_slip);
  double inertia_of(const Stage& stage) const;
  bool kept_factors_serve() const;
  bool factors_go_on_serving(int iteration, Lengths lengths, const SearchOptions& options) const;
  std::vector<Vec3> pushes() const;
  SearchEnd descend(const StageStart& start, const SearchOptions& options, std::vector<Vec3>& x,
                    Answer& here);
  void follow_friction(const StageStart& start, const SearchOptions& options, std::vector<Vec3>& x,
                       Answer& here);
  double friction_bias() const;
  std::vector<Vec3> solve(std::vector<Vec3> net);
  std::optional<Answer> land(const std::vector<Vec3>& from, std::vector<Vec3>& to);
  bool make_room(const std::vector<Vec3>& from, const std::vector<Vec3>& to);
  Way advance(const std::vector<Vec3>& move, std::vector<Vec3>& x, Answer& here);
  double mean_length(const std::vector<Vec3>& move) const;
  double stretch_of(const std::vector<Vec3>& move, const std::vector<Vec3>& x) const;
  bool is_good_enough(int iteration, const std::vector<Vec3>& move, Lengths lengths,
                      const std::vector<Vec3>& x, const SearchOptions& options) const;

  const Cloth& cloth_;
  const Loads& loads_;
  StepContact* contact_;
  ClothContact* pairs_;
  std::vector<Contact> contacts_;  ///< the sum of these two and others
  ThreadPool& pool_;
  WorkCounts& work_;
  WorkClock& clock_;
  StepElements elements_;
  std::vector<Spring> edges_;  ///< where strain is measured
  FreeStiffness stiffness_;
  bool single_ = false;  ///< whether the factors are of single precision
  bool secant_ = false;  ///< whether they hold back what slides
  bool met_ = false;     ///< the body was touched somewhere in this search
  /// What the factors were made for, as far as it is compared: a particle's mass counts so many times
  /// [1/s^2], and these are pushed. 0: there are none.
  double factored_ = 0;
  std::optional<std::vector<int>> factored_pushed_;
  FreeStiffness::Pairs coupled_;
  double mass_ = 0;  ///< of all free particles [kg]
  Answer found_;     ///< of where the last search ended
  const Stage* stage_ = nullptr;
  const StepLoads* given_ = nullptr;
};

}  // namespace furrow::physics
