// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bridge/arrays/gather.h"
#include "bridge/keeping/keep.h"
#include "geometry/mesh/mesh.h"

namespace furrow::cases {

enum class LineKind { plain, hem, curve, ring };

struct RandomLine {
  LineKind kind = LineKind::plain;
  double length = 0;  ///< [m]
  double turn = 0;    ///< from its first direction to its last; 0: straight [rad]
  double height = 0;  ///< as asked for [m]
  double base = 0;    ///< height of that place without the line [m]
};

/// A garment of few vertices with some wrinkles drawn at random places.
struct RandomGarment {
  std::string kind;     ///< sheet, jittered, corners (a sheet that hangs by two) or skirt
  double edge = 0;      ///< [m]
  geometry::Mesh mesh;  ///< wrinkled; the garment hangs along y
  bridge::GatherOptions springs;
  std::vector<int> pins;
  std::vector<RandomLine> lines;  ///< by id

  physics::Cloth cloth() const;      ///< gathered and pinned, clamps stiffened; a plate if springs say so
  std::vector<double> base() const;  ///< of keep_lines()
};

/// A garment of so many lines, 0.1 to 0.5 m long and 3 to 15 mm high or deep, straight or bent. Its cloth has
/// edges of 18 to 30 mm (edge: another length [m]), rigidity 1e-6 to 1e-4 N m, stretch 100 to 1000 N/m. The
/// same seed gives the same garment. ornate: lines begin at the hem, turn by half a circle, and are rings, in
/// turn, 0.1 to 0.5 m long and 3 to 12 mm high; where there are several most cross each other.
RandomGarment random_garment(std::uint64_t seed, int lines, double edge = 0, bool ornate = false);

/// The height of each line as the garment lies [m], by id, less `base`; NaN: it has none.
std::vector<double> heights_of(const RandomGarment& garment);

/// What is left of each line's height [m], by id, after so many seconds; NaN: no longer known. The garment is
/// stored with the rest state of `cloth` and gathered again, each free vertex is moved by 0.1 mm in some
/// direction, and it is let go from rest, with half the step and half the drag of `run`. gust [m/s^2] > 0:
/// then it blows for 0.4 s to each of four sides, with 1 s of calm after each and 5 s after the last.
std::vector<double> heights_after(const RandomGarment& garment, physics::Cloth cloth,
                                  const physics::SimulateOptions& run, std::uint64_t seed, double seconds = 2,
                                  double gust = 0);

}  // namespace furrow::cases
