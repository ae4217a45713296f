// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/parts.h"

namespace furrow::geometry {

/// How a part of a garment rides on the cloth that it lies on, the value of attribute::rides.
enum class Ride : int {
  none,      ///< it is cloth
  rigid,     ///< as one, with the face nearest to its middle: a button
  by_place,  ///< each vertex with what is nearest to it: a pocket, a belt, an inner side
  by_itself  ///< it is cloth that nothing holds to other cloth, since somebody chose so; rides_of(): none
};

/// A part that lies on other cloth, as the garment was made.
struct AttachedPart {
  int part;      ///< index into Parts::list
  Ride ride;     ///< not none
  double reach;  ///< as near as that is what makes it one [m]; infinity: it was chosen
};

/// Finds the parts that lie on larger ones, by attribute::rest_position where that is known. Nine tenths of
/// the vertices are within 4 mm of it, or of a part that lies on it: a loop over a belt; of a part of 60 mm
/// and less, which is rigid, the one that lies amid it is within 100 mm. A part with more than a quarter of
/// that cloth's area is one only as its inner side: all of it within 4 mm, and facing the other way. Parts
/// with drawn lines, and those that a strut joins to others, are none. `chosen`, by part, overrides all that:
/// how it rides, where it is not `none`; a part of 60 mm and less that goes by place is rigid. Empty: nothing
/// is chosen. Ascending. Cost: O(faces log faces); O(faces) with one part. Throws as find_parts().
std::vector<AttachedPart> find_attached(const Mesh& mesh, const Parts& parts,
                                        const std::vector<Ride>& chosen = {});

/// By part: of at most 60 mm across, as it was made, and not the largest: it carries nothing, and is stiff
/// where it rides. O(vertices).
std::vector<char> small_parts(const Mesh& mesh, const Parts& parts);

/// Notes them in attribute::rides, in place of what it said; without any it is taken off.
void set_rides(Mesh& mesh, const Parts& parts, const std::vector<AttachedPart>& attached);

/// Takes off what it says of parts with drawn lines. O(faces).
void free_drawn_parts(Mesh& mesh);

/// By face index: how its part rides; empty: nothing is noted of any. O(faces).
std::vector<Ride> rides_of(const Mesh& mesh);

/// Of a list by face, in the order of mesh.faces(), what belongs to cloth: to faces that do not ride.
template <class T>
std::vector<T> of_cloth(const Mesh& mesh, std::vector<T> by_face) {
  const std::vector<Ride> rides = rides_of(mesh);
  if (rides.empty()) return by_face;
  std::vector<T> result;
  auto value = by_face.begin();
  for (const Face f : mesh.faces()) {
    if (rides[f.idx()] == Ride::none) result.push_back(*value);
    ++value;
  }
  return result;
}

/// Where a vertex lay as the garment was made: attribute::rest_position, else where it lies.
std::vector<Point> places_as_made(const Mesh& mesh);

}  // namespace furrow::geometry
