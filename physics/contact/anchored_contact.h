// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/base/thread_pool.h"
#include "physics/body/collider.h"
#include "physics/linear/free_stiffness.h"

namespace furrow::physics {

struct AnchoredContactOptions {
  double friction = 0.3;    ///< Coulomb coefficient [-]; >= 0
  double gap = 0.003;       ///< distance at which the body begins to push [m]; > 0
  double stiffness = 1000;  ///< of that push beyond the soft layer [N/m]; > 0
};

/// Contact with a body as a potential, for callers that look for rest. A particle nearer than the gap is
/// pushed along the body's gradient, by a force that grows with the square of the depth d in a soft layer (a
/// third of the gap, 1 mm at most) and then linearly, so that stiffness does not jump where cloth comes to
/// lie. Friction pulls it back to an anchor, linearly over a tenth of the layer and then with its limit,
/// friction times push. Cost: one query of the collider a particle and call of look(), shared by the threads
/// of the pool; the results do not depend on their number.
///
/// \details With anchors and limits held this is the derivative of an energy, and Newton's method may be used
/// between calls of expect(), make_room(), stiffen() and move_anchors(). There a particle that pulls more
/// than its limit drags its anchor along, and limits become those of the new push. So whatever rest is found,
/// contact forces are in the friction cone; which of many such rests it is depends on the way there.
class AnchoredContact {
 public:
  /// The collider must outlive this object. Throws std::invalid_argument if an option is out of its range.
  AnchoredContact(const Collider& collider, const AnchoredContactOptions& options, std::size_t particles);

  /// Asks the body at x. All answers below are for these positions, and for particles that can move (inv_mass
  /// > 0).
  void look(std::span<const Vec3> x, std::span<const double> inv_mass, ThreadPool* pool = nullptr);
  double energy() const;                               ///< [J]
  void add_forces(std::span<Vec3> force) const;        ///< [N]
  void add_stiffness(FreeStiffness& stiffness) const;  ///< positive semidefinite
  void expect(std::span<const Vec3> move);             ///< limits become those of the push after a move [m]
  void move_anchors();
  /// Where the body leaves less room than the gap (between two fingers, under an arm), pushes from both sides
  /// meet in a kink at which no step succeeds. A particle may be pushed at `from` and, less than the gap
  /// away, from another side at `to` (normals over 60 degrees apart). From now on it rests within half the
  /// distance [m] that it has there; the next look() sees it.
  void make_room(std::span<const Vec3> from, std::span<const Vec3> to, std::span<const double> inv_mass);
  /// From here on the soft layer is `factor` times thinner and the push beyond it factor^2 times as stiff. A
  /// pushed particle moves out to where the push is what it was, in x, the positions of the last look().
  void stiffen(double factor, std::span<Vec3> x);
  int touching() const;    ///< particles that are pushed
  double deepest() const;  ///< of them, inside its gap [m]; 0: none

 private:
  struct Touch {
    Vec3 anchor = Vec3::Zero();
    double limit = -1;          ///< of friction [N]; < 0: no anchor
    bool slides = false;        ///< dragged its anchor last time
    Vec3 plane = Vec3::Zero();  ///< normal that the anchor was set with: friction is across it
    Vec3 x = Vec3::Zero(), normal = Vec3::Zero();
    double energy = 0, push = 0, stiffness = 0;  ///< of the push [J], [N], [N/m]; 0: apart
    double depth = 0, slope = 1;                 ///< inside the gap [m]; length of the body's gradient [-]
    double gap;                                  ///< [m]; the option, unless make_room() lowered it
    /// From the anchor, along the surface [m].
    Vec3 way() const { return x - anchor - plane.dot(x - anchor) * plane; }
  };
  double depth_of(double force) const;  ///< where soft_push() gives that force

  const Collider& collider_;
  AnchoredContactOptions options_;
  double soft_, slip_;  ///< depth at which the push becomes linear, way at which friction slides [m]
  std::vector<Touch> touches_;
};

}  // namespace furrow::physics
