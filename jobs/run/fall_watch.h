// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "geometry/mesh/parts.h"
#include "jobs/run/body.h"
#include "physics/cloth/cloth.h"

namespace furrow::jobs {

/// Finds parts of a garment that fall: nothing pins them, and they left the body (null: none) behind. The
/// body must outlive it.
class FallWatch {
 public:
  /// mesh: the garment before it is draped. gap: that cloth keeps from the body [m].
  FallWatch(const geometry::Mesh& mesh, const BodyCollider* body, double gap);

  std::size_t count() const { return parts_.list.size(); }
  const geometry::Parts& parts() const { return parts_; }

  /// A vertex of each part that falls; none where all do, or where there is one part alone. cloth: of the
  /// first level, with the vertices of the mesh; held: of its particles. Parts that struts tie to a carried
  /// one are carried. Cost: one question to the field a particle, at most.
  std::vector<int> find(const physics::Cloth& cloth, const std::vector<char>& held) const;

 private:
  std::vector<physics::Vec3> start_;
  geometry::Parts parts_;
  std::vector<std::array<int, 2>> tied_;  ///< parts that a strut joins
  const BodyCollider* body_;
  double gap_;
};

}  // namespace furrow::jobs
