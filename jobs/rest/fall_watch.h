// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <span>
#include <vector>

#include "geometry/mesh/parts.h"
#include "jobs/base/ends.h"
#include "jobs/body/world_body.h"
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

  /// A vertex of each part that falls; none where all do, or where there is one part alone. x: positions on
  /// any level [m], the mesh's vertices first (refinement leaves them their indices); held: whether a pin
  /// holds one. Parts that struts tie to a carried one are carried. Cost: one question to the field a vertex,
  /// at most.
  std::vector<int> find(std::span<const physics::Vec3> x, const std::vector<char>& held) const;

  /// What became of each part, where it lies now against where it lay before: one that went 10 cm down and
  /// has no vertex that is held has lost its place. `file`: of the mesh, for names; `aside`: a vertex of each
  /// part that was held aside; `gravity` [m/s^2].
  std::vector<PartEnd> ends(const io::MeshFile& file, std::span<const physics::Vec3> x,
                            const std::vector<char>& held, std::span<const int> aside,
                            const physics::Vec3& gravity) const;

 private:
  std::vector<char> pinned(const std::vector<char>& held) const;

  std::vector<physics::Vec3> start_;
  geometry::Parts parts_;
  std::vector<std::array<int, 2>> tied_;  ///< parts that a strut joins
  const BodyCollider* body_;
  double gap_;
};

}  // namespace furrow::jobs
