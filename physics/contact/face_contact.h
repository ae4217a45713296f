// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <map>
#include <span>
#include <vector>

#include "physics/base/contact_term.h"
#include "physics/base/thread_pool.h"
#include "physics/body/collider.h"
#include "physics/linear/free_stiffness.h"

namespace furrow::physics {

struct FaceContactOptions {
  double clearance = 5e-4;  ///< to which a face is brought out [m]; > 0
  double error = 0;         ///< by which the collider may differ from the precise body [m]; >= 0
  double stiffness = 1000;  ///< of the push beyond its soft layer, half of the clearance [N/m]; > 0
};

/// Contact with a body at points within faces, for callers that look for rest: where vertices keep their gap,
/// an edge or a face may still cut through a knee. find() sets a point where the body comes through, or next
/// to it; it stays at its place of the cloth until the next find(), and is pushed along the collider's
/// gradient while it is nearer than its level. The force is spread on the face's vertices by the point's
/// barycentrics. No friction: the vertices around it have theirs. Points are few, so all calls but find()
/// cost next to nothing.
///
/// \details With the points held this is the derivative of an energy. Levels are in the collider's distance,
/// but set by the precise body's: a sampled field may be off by more than the gap, so each level is raised by
/// what the precise distance lacks of the clearance, again by each find() that still sees the body there.
class FaceContact : public ContactTerm {
 public:
  struct Found {
    int through = 0;  ///< faces with a point inside the precise body, as far as find() sees
    int changed = 0;  ///< points that were set or raised
  };
  /// The colliders must outlive this object, the triangles are copied. Throws std::invalid_argument if an
  /// option is out of its range.
  FaceContact(const Collider& collider, const Collider& precise,
              std::span<const std::array<int, 3>> triangles, const FaceContactOptions& options);

  /// Looks for the deepest point of each face: of 15 points those that the collider says may be near are
  /// asked precisely, and from the least three ways lead downhill. Sets a point where that is nearer
  /// than a quarter of the clearance. Cost: a query a vertex, 15 for each face within reach, and some 10 to
  /// 25 precise ones where the body is that near; shared by the pool's threads, the results do not depend on
  /// their number.
  Found find(std::span<const Vec3> x, std::span<const double> inv_mass, ThreadPool* pool = nullptr);
  /// Asks the collider where the points are at x.
  void look(std::span<const Vec3> x, std::span<const double> inv_mass = {},
            ThreadPool* pool = nullptr) override;
  double energy() const override;
  void add_forces(std::span<Vec3> force) const override;
  /// Without the body's curvature.
  void add_stiffness(FreeStiffness& stiffness, SlipStiffness of_slip = SlipStiffness::none) const override;
  int points() const { return int(points_.size()); }
  int touching() const;  ///< points that are pushed

 private:
  using Weights = std::array<double, 3>;
  struct Point {
    int face;
    Weights weights;
    double level;  ///< of the collider [m]
    Vec3 normal = Vec3::Zero();
    double energy = 0, push = 0, stiffness = 0;  ///< [J], [N], [N/m]; 0: apart
  };
  struct Deepest {
    Weights weights{};
    double value;  ///< of the precise body [m]; infinite: out of reach
  };
  Vec3 at(int face, const Weights& w, std::span<const Vec3> x) const;
  Deepest deepest_of(int face, std::span<const Vec3> x, std::span<const double> vertex_values) const;
  Deepest descend(int face, Deepest from, std::span<const Vec3> x) const;
  void set_or_raise(int face, const Deepest& deepest, std::span<const Vec3> x);

  const Collider& collider_;
  const Collider& precise_;
  const std::vector<std::array<int, 3>> triangles_;
  FaceContactOptions options_;
  std::vector<Point> points_;
  std::multimap<int, std::size_t> of_face_;  ///< its points
};

}  // namespace furrow::physics
