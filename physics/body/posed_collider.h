// SPDX-License-Identifier: MIT
#pragma once
#include "physics/body/collider.h"
#include "physics/body/moving_body.h"

namespace furrow::physics {

/// A Pose as a matrix, for many points.
struct BodyPlace {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();  ///< [m]
  BodyPlace() = default;
  explicit BodyPlace(const Pose& p) : rotation(p.rotation.toRotationMatrix()), translation(p.translation) {}
  Vec3 to_body(const Vec3& x) const { return rotation.transpose() * (x - translation); }
  Vec3 to_world(const Vec3& x) const { return rotation * x + translation; }
};

/// A body somewhere else: `body`, given in its own frame, at a pose. The body must outlive it.
class PosedCollider : public Collider {
 public:
  PosedCollider(const Collider& body, const Pose& pose) : body_(body), pose_(pose) {}
  SignedDistance at(const Vec3& x) const override { return turned(body_.at(pose_.to_body(x))); }
  SignedDistance smooth_at(const Vec3& x) const override { return turned(body_.smooth_at(pose_.to_body(x))); }

 private:
  SignedDistance turned(const SignedDistance& d) const { return {d.value, pose_.rotation * d.gradient}; }

  const Collider& body_;
  Pose pose_;
};

}  // namespace furrow::physics
