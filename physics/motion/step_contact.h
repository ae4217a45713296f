// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "physics/body/moving_body.h"
#include "physics/contact/anchored_contact.h"

namespace furrow::physics {

/// The body around a cloth for steps that solve contact with the rest. Pointers may be null.
struct BodyAround {
  const Collider* collider = nullptr;   ///< of a rigid body, in its own frame
  const RigidMotion* motion = nullptr;  ///< takes it into the world; null: it stands there
  AnimatedBody* animated = nullptr;     ///< or a body that changes its shape; not both
  double friction = 0.3;                ///< Coulomb coefficient [-]; >= 0
  double gap = 0.003;                   ///< distance at which the body begins to push [m]; > 0
  double recovery_speed = 0.1;          ///< of what starts nearer than that [m/s]; > 0
  bool any() const { return collider || animated; }
};

/// AnchoredContact with a body that may move: anchors go along with its surface.
class StepContact : public AnchoredContact {
 public:
  /// What `body` points to must outlive this object. stiffness: of the push [N/m]; > 0.
  StepContact(const BodyAround& body, double stiffness, std::size_t particles, double time);

  /// The body moves from one time to another [s]; all later answers are about the latter. Returns where
  /// particles at x [m] are then if each goes with the point of the body that is next to it: in the body's
  /// frame.
  std::vector<Vec3> move_body(double from, double to, std::span<const Vec3> x);
  /// How far the body's points next to x [m] go in a step; `carried` as of move_body().
  std::vector<Vec3> ways(std::span<const Vec3> carried, std::span<const Vec3> x) const;
  /// Of the body's point next to each particle at the end of a step, and the particle's along it, the mean of
  /// those at both ends, turned with the body to the end [m/s].
  struct Beside {
    std::vector<Vec3> surface, slip;
  };
  /// Of a step from x0, v0 to x1; `carried` as of move_body() then, `ways` of that.
  Beside beside(std::span<const Vec3> carried, std::vector<Vec3> ways, std::span<const Vec3> x0,
                std::span<const Vec3> v0, std::span<const Vec3> x1, double from, double to) const;
  /// Shortens the ways of particles that can move (inv_mass > 0) from `start`, as of move_body(), to x, in
  /// the world, along the normal only, so that none goes deeper into the gap than it is. Cost: a few queries
  /// a particle near the body, one for each other.
  void keep_out(std::span<const Vec3> start, std::span<const double> inv_mass, std::span<Vec3> x,
                ThreadPool& pool) const;
  /// The same of ways from x, in the world where the body is now. Whether any was shortened.
  bool cut_ways(std::span<const Vec3> x, std::span<const double> inv_mass, std::span<Vec3> to,
                ThreadPool& pool) const;

 private:
  BodyPlace place_at(double time) const;
  const Collider& collider() const;
  Vec3 slid(std::size_t i, Vec3 from, const Vec3& to) const;

  BodyAround body_;
};

}  // namespace furrow::physics
