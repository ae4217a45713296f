// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "physics/base/contact_term.h"
#include "physics/base/thread_pool.h"
#include "physics/body/posed_collider.h"
#include "physics/linear/free_stiffness.h"

namespace furrow::physics {

struct AnchoredContactOptions {
  double friction = 0.3;    ///< Coulomb coefficient [-]; >= 0
  double gap = 0.003;       ///< distance at which the body begins to push [m]; > 0
  double stiffness = 1000;  ///< of that push beyond the soft layer [N/m]; > 0
};

/// Contact with a body as a potential, for searches of rest and of implicit steps. A particle nearer than the
/// gap is pushed along the body's gradient, by a force that grows with the square of the depth d in a soft
/// layer (a third of the gap, 1 mm at most) and then linearly, so that stiffness does not jump where cloth
/// comes to lie. Friction pulls it back to an anchor, linearly over a tenth of the layer and then with its
/// limit, friction times push. Cost: one query of the collider a particle and call of look(), shared by the
/// threads of the pool; the results do not depend on their number.
///
/// \details With anchors and limits held this is the derivative of an energy, and Newton's method may be used
/// between calls of expect(), make_room(), stiffen() and move_anchors(). There a particle that pulls more
/// than its limit drags its anchor along, and limits become those of the new push. So whatever rest is found,
/// contact forces are in the friction cone; which of many such rests it is depends on the way there.
class AnchoredContact : public ContactTerm {
 public:
  /// The collider must outlive this object. Throws std::invalid_argument if an option is out of its range.
  AnchoredContact(const Collider& collider, const AnchoredContactOptions& options, std::size_t particles);

  /// Asks the body at x. All answers below are for these positions, and for particles that can move (inv_mass
  /// > 0).
  void look(std::span<const Vec3> x, std::span<const double> inv_mass, ThreadPool* pool = nullptr) override;
  double energy() const override;
  void add_forces(std::span<Vec3> force) const override;
  void add_stiffness(FreeStiffness& stiffness, SlipStiffness of_slip = SlipStiffness::none) const override;
  bool rubs() const override { return true; }
  void expect(std::span<const Vec3> move, bool again = false) override;
  void relimit();  ///< limits become those of the push as it is
  void move_anchors(std::span<const Vec3> x = {}) override;
  double longest_move() const override { return 0.02; }  ///< less than half of any limb
  /// Where the body leaves less room than the gap (between two fingers, under an arm), pushes from both sides
  /// meet in a kink at which no step succeeds. A particle may be pushed at `from` and, less than the gap
  /// away, from another side at `to` (normals over 60 degrees apart). From now on it rests within half the
  /// distance [m] that it has there; the next look() sees it. Returns how many that are.
  int make_room(std::span<const Vec3> from, std::span<const Vec3> to, std::span<const double> inv_mass);
  /// From here on the soft layer is `factor` times thinner and the push beyond it factor^2 times as stiff. A
  /// pushed particle moves out to where the push is what it was, in x, the positions of the last look().
  void stiffen(double factor, std::span<Vec3> x);
  /// For a body that moves: from here on it stands at `place`, and all positions are the world's. Anchors
  /// stay where they are on it. Not together with stiffen().
  void place_body(const BodyPlace& place) { place_ = place; }
  /// For a body that changes its shape: each anchor goes the way [m] of the surface that it lies on.
  void carry_anchors(const std::function<Vec3(const Vec3&)>& way);
  /// What is pushed and has no anchor gets one at its place before the step that brought it here, in the
  /// body's frame: so friction in this step is bounded by this step's push. Whether there is such.
  bool hold_new(const StageStart& start, std::span<const Vec3> x) override;
  /// For motion, so that what begins in the gap is not shot out: a particle that begins (not 0) and is pushed
  /// by more than other forces [N, one a particle] press it to the body may lie as deep as it does for now,
  /// and is pushed by that. Call look() again.
  void let_in(std::span<const Vec3> force, std::span<const char> begins);
  /// What was let in, or has less room, may lie less deep by so much [m]; the next look() sees it. Returns
  /// the way out [m] of each particle, as it was looked at last; of what has no room there, none.
  std::vector<Vec3> lead_out(double by);
  std::vector<ContactAnchor> anchors() const;
  /// Throws std::invalid_argument for another number of anchors than of particles.
  void set_anchors(std::span<const ContactAnchor> anchors);
  /// The most by which SlipStiffness::secant holds back what slides, over mass times `inertia` [1/s^2] of it.
  double held_back(std::span<const double> mass, double inertia) const;
  int touching() const;                                     ///< particles that are pushed
  std::optional<std::vector<int>> pushed() const override;  ///< which ones, rising
  double deepest() const;                                   ///< of them, inside its gap [m]; 0: none

 protected:
  Vec3 in_frame(const Vec3& x) const;  ///< the body's [m]
  const BodyPlace* place() const { return place_ ? &*place_ : nullptr; }

  /// For a body that is dear to ask: look() leaves out what cannot be in the gap by the level that it was
  /// told, or found, since the last of these calls; as long as the body stands.
  void forget_levels();
  void know_level(std::size_t i, const Vec3& x,
                  double level);  ///< of particle i at x, in the body's frame [m]
  /// Whether a particle at x is surely farther from the body than a distance [m].
  bool is_beyond(std::size_t i, const Vec3& x, double distance) const {
    const Touch& t = touches_[i];
    return t.level - lipschitz * (x - t.asked).norm() > distance;
  }

 private:
  static constexpr double lipschitz = 2;  // bound on the change of the body's distance a metre
  struct Touch : ContactAnchor {
    Vec3 x = Vec3::Zero(), normal = Vec3::Zero();
    double energy = 0, push = 0, stiffness = 0;  ///< of the push [J], [N], [N/m]; 0: apart
    double depth = 0, slope = 1;                 ///< inside the gap [m]; length of the body's gradient [-]
    Vec3 asked = Vec3::Zero();                   ///< where its level was [m]
    double level = -std::numeric_limits<double>::infinity();  ///< -inf: unknown [m]
    /// From the anchor, along the surface [m].
    Vec3 way() const { return x - anchor - plane.dot(x - anchor) * plane; }
  };
  Vec3 force_of(const Touch& t) const;  ///< in the body's frame [N]
  double depth_of(double force) const;  ///< where soft_push() gives that force

  const Collider& collider_;
  AnchoredContactOptions options_;
  bool keeps_levels_ = false;
  std::optional<BodyPlace> place_;  ///< none: positions are the body's
  double soft_, slip_;  ///< depth at which the push becomes linear, way at which friction slides [m]
  std::vector<Touch> touches_;
};

}  // namespace furrow::physics
