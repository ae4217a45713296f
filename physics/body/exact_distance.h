// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "physics/base/arrays.h"
#include "physics/body/collider.h"

namespace furrow::physics {

enum class Feature : std::uint8_t;  // closest_on_triangle.h: face, edge or corner

struct ClosestPoint {
  double squared_distance;  ///< [m^2]
  Vec3 point;               ///< [m]
  int triangle;             ///< index in the mesh
  Feature feature;          ///< of that triangle
};

enum class SignRule {
  pseudonormal,  ///< closed, equally oriented, free of crossings, and agreeing with the winding number
  sides,   ///< closed but crossing itself: the winding number of each side where the surface is sound, else
           ///< below
  winding  ///< open or contradictory: winding number > 1/2 at every point
};

/// What was found out about a body, and how its inside is told from its outside.
struct SignReport {
  SignRule rule = SignRule::winding;
  bool closed = false;        ///< every edge is run through as often forwards as backwards
  int border_edges = 0;       ///< edges of one triangle
  int irregular_edges = 0;    ///< edges of more than two triangles or of two that run the same way
  int crossed_triangles = 0;  ///< that meet others elsewhere than in shared corners and edges
  int dropped_triangles = 0;  ///< inner walls where parts overlap: no distance is measured to them
  int samples = 0;  ///< points near the surface at which pseudonormal and winding number were compared
  double disagreement = 0;   ///< share of them where the two differ [-]
  double signed_volume = 0;  ///< [m^3]; < 0 when the faces of a closed body look inwards
};

/// Exact signed distance to a triangle mesh: closest point by TriangleBvh, sign by SurfaceSides. About 1 us a
/// query for 100,000 triangles; DistanceField is the fast one. Copies share their data.
class ExactDistance : public Collider {
 public:
  /// A distance with the triangle it was measured to: a first guess for points nearby.
  struct Sample {
    double value;  ///< [m]; negative inside
    int triangle;
  };

  /// Any soup with at least one triangle with an area; std::invalid_argument as check_body() says. The mesh
  /// is not kept. Orientation matters: faces counter-clockwise from outside. Fill holes first: near an open
  /// border the sign jumps where the winding number passes 1/2.
  explicit ExactDistance(const TriangleMesh& mesh);

  /// The same triangles with their vertices elsewhere: distances and signs of ExactDistance(mesh), in a
  /// fraction of its time. The tree keeps what lies in which box, unless that has moved far apart; sides are
  /// told anew. The answer depends on this body and the mesh alone. `over`: one that is needed no more, whose
  /// memory then serves. Cost: about 1.2 us a triangle. Throws std::invalid_argument as the constructor does,
  /// or for another number of triangles.
  ExactDistance moved(const TriangleMesh& mesh, std::optional<ExactDistance> over = std::nullopt) const;

  /// Value and unit gradient; on the surface itself the pseudonormal. NaN for a NaN point.
  SignedDistance at(const Vec3& x) const override;
  SignedDistance at(const Vec3& x, int guess) const;  ///< faster if the triangle `guess` is near x
  Sample sample(const Vec3& x) const;
  /// The same value as sample(x), faster: from a point y nearby and its sample. Where |x - y| is less than
  /// either distance the two lie on the same side.
  Sample sample(const Vec3& x, const Vec3& y, const Sample& at_y) const;
  /// The same. Where the side would be summed up, `beside` is asked first, with the distance of x [m]:
  /// whether a point whose side is known tells that x is inside. It answers nothing where the two points
  /// are farther apart than either is from the surface.
  Sample sample(const Vec3& x, const Vec3& y, const Sample& at_y,
                const std::function<std::optional<bool>(double)>& beside) const;

  ClosestPoint closest(const Vec3& x) const;
  ClosestPoint closest(const Vec3& x, int guess) const;  ///< faster if the triangle `guess` is near x
  double winding_number(const Vec3& x) const;
  const SignReport& report() const;
  double diagonal() const;   ///< of the bounding box [m]
  const Vec3& low() const;   ///< lowest corner of the bounding box [m]
  const Vec3& high() const;  ///< highest corner of the bounding box [m]

 private:
  struct Parts;
  explicit ExactDistance(std::shared_ptr<Parts> parts);
  std::shared_ptr<Parts> parts_;  ///< moved() takes those that nothing else shares
};

struct Penetration {
  int inside = 0;      ///< points with a negative distance
  double deepest = 0;  ///< [m]; >= 0, the largest depth
};

/// Counts points inside a body. Points with a value that is not a number count as neither.
Penetration penetration(const Collider& body, std::span<const Vec3> points);

}  // namespace furrow::physics
