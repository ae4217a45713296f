// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "jobs/base/inputs.h"

/// What is known of the state of a garment, above all of one in which a search for rest, or a motion, ended:
/// where its cloth crosses, what the body does to it; and which of two such ends is the better one.
namespace furrow::jobs {

/// A place where cloth passes through itself: faces that cross each other or share a vertex.
struct CrossingPlace {
  geometry::Coordinates<geometry::Point> centre;  ///< [m]
  double extent = 0;                              ///< longest side of the box around its faces [m]
  std::size_t pairs = 0;                          ///< of faces that cross here
  std::size_t from_start = 0;        ///< of them, where the garment crossed itself from the start
  std::array<std::string, 2> parts;  ///< of the garment that cross; twice the same: it crosses itself
};

/// Pairs of faces of a garment that cross or touch each other and share no vertex: none where it is sound.
struct ClothCrossings {
  std::optional<std::size_t> at_start;  ///< pairs as it was given; none: only one state was measured
  std::size_t pairs = 0;                ///< now
  std::size_t from_start = 0;           ///< of them, where it crossed itself from the start
  std::vector<geometry::Index<geometry::Face>> faces;  ///< that cross another, in ascending order
  std::vector<std::size_t> corners;   ///< vertices of those faces by index, in ascending order
  std::vector<CrossingPlace> places;  ///< most pairs first
};

/// How a garment crossed itself as it was given.
struct CrossedStart {
  std::size_t pairs = 0;
  std::vector<char> vertices;  ///< by index, whether a face at it crossed; of the refined mesh
};

/// "43 pairs of faces of the cloth cross (12 of them from the start), 40 of them within 6.0 cm of
/// (0.11, 1.32, -0.02) m, between 'shirt' and 'button'".
std::string words(const ClothCrossings& crossings);

/// The numbers, the corners (left out: nothing crosses), and the ten places that have most pairs.
Json to_json(const ClothCrossings& crossings);

/// What may be wrong with an end that is still accepted.
struct EndLimits {
  std::size_t crossings = 0;   ///< pairs of faces of the cloth that cross
  double penetration = 0.005;  ///< depth to which the body may come through the cloth [m]; >= 0
  double residual = 1e-3;      ///< residual force of what rests [-]; > 0
};

/// One part of a garment (geometry/mesh/parts.h).
struct PartEnd {
  std::string name;
  double fallen = 0;  ///< way down that nine tenths of its vertices have gone at least [m]
  bool lost = false;  ///< it falls, or lies where it was not worn
  bool held = false;  ///< aside, as nothing carries it: it went with the cloth that lay nearest
};

/// What the body does to the garment.
struct BodyEnd {
  std::size_t pierced_faces = 0;    ///< that it comes through
  std::size_t vertices_inside = 0;  ///< it
  double depth = 0;                 ///< of all points of the garment inside it [m]
  double gap = 0;                   ///< that was to be kept from it [m]; 0: none
};

/// What an independent check would find of the state.
struct EndFacts {
  bool finite = true;            ///< positions and forces are numbers that can be computed with
  std::optional<double> strain;  ///< that 99 of 100 parts of the cloth stay below [-]; none: no rest lengths
  std::size_t crossings = 0;     ///< pairs of faces that cross, with other garments, too
  std::optional<BodyEnd> body;   ///< none: there is no body, or nobody looked
  std::optional<double> residual;   ///< largest net force on a vertex, over its weight [-]; none: it moves
  bool settled = true;              ///< and nothing else than that force kept it from rest
  bool blocked = false;             ///< cloth left it no step
  std::vector<PartEnd> parts = {};  ///< of the garment; empty: nobody looked

  bool rests(const EndLimits& limits) const;       ///< its forces balance; false of a motion
  bool falls() const;                              ///< each of its parts is lost
  bool is_torn() const;                            ///< over a hundredth is at more than twice its length
  bool is_pierced(const EndLimits& limits) const;  ///< more deeply than was allowed
  std::size_t lost() const;                        ///< parts that fall or lost their place
  double fallen() const;                           ///< of the part that fell farthest [m]; 0: none did
};

/// How bad an end is, the gravest first; arrays compare as words in a dictionary do, and less is better.
/// Numbers that are none count as infinite.
using Badness = std::array<double, 9>;

/// What makes an end no success comes first: not finite, torn, more pairs of faces that cross than allowed,
/// faces pierced more deeply than allowed, parts lost, residual above what rests. Of ends that are alike in
/// all these: fewer pairs, fewer pierced faces, and less strain, by twentieths.
Badness badness_of(const EndFacts& end, const EndLimits& limits);
inline bool is_better(const EndFacts& a, const EndFacts& b, const EndLimits& limits) {
  return badness_of(a, limits) < badness_of(b, limits);
}

/// Whether nothing is wrong with it beyond the limits.
bool succeeds(const EndFacts& end, const EndLimits& limits);
/// "numerical failure", "torn", "falls", "at rest", "blocked" or "not at rest"; of a motion "" in place of
/// the last three.
std::string outcome_of(const EndFacts& end, const EndLimits& limits);

/// "the body comes through 15 faces, by up to 1.8 mm"; "" where it comes through none.
std::string words_of_piercing(const BodyEnd& body);

/// The list of facts, the same in the report of every job.
Json to_json(const EndFacts& end);

}  // namespace furrow::jobs
