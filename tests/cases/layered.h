// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "physics/rest/settle.h"

namespace furrow::cases {

/// Cloth on cloth at rest, with closed forms, or numbers from one-dimensional equations (docs/figures.md).

/// What one number of a case is to be, and is.
struct LayeredNumber {
  std::string what;
  double answer = 0, found = 0;
  double tolerance = 0;   ///< of found - answer
  bool relative = false;  ///< of found / answer - 1
  double error() const { return relative ? found / answer - 1 : found - answer; }
  bool holds() const { return error() <= tolerance && error() >= -tolerance; }
};
struct LayeredCase {
  std::vector<LayeredNumber> numbers;
  int vertices = 0;
  bool rests = false;  ///< each search for rest ended so
  int iterations = 0;  ///< of all searches
  int crossings = 0;   ///< edges through faces at the end, exactly
  std::vector<physics::Vec3> x;
};

/// V1, V2: n sheets of different meshes over a held one, without friction. The force on each is the weight of
/// all above, the first gap lies in [0.95, 1] mm. columns: of the lowest.
LayeredCase stacked_sheets(int n, int columns, int threads = 1);
/// V3: a vertex pressed on a face, or an edge on an edge, with force over stiffness times range in [0, 1].
LayeredCase pressed_pair(bool edges, double load);
/// V4: a sheet on a held sheet on an incline, tan(angle) = share * friction. It rests where share <= 1.
LayeredCase on_incline(double share, int columns);
/// V5: the middle one of three sheets is pulled by a share of what friction on both its sides can bear,
/// friction * (N1 + N2). It rests where share <= 1.
LayeredCase pulled_sheet(double share, int columns);
/// V6: a strip over a cylinder that wears a held sleeve hangs down on one side by a share of the length that
/// capstan_length() says it can bear; what hangs beyond 4 cm is a load at its end.
LayeredCase capstan_on_sleeve(double share, int around);
/// V7: a strip on a table, folded over onto itself, its layers `apart` lengths (B/w)^(1/3). `cells`: edges in
/// such a length.
LayeredCase heavy_fold(double apart, int cells);
/// V8: a strip coiled up in a smooth cylinder, without weight. `around`: edges in a turn.
LayeredCase coil_in_tube(int around);
/// V9: a sleeve stretched over another one on a cylinder.
LayeredCase sleeve_over_sleeve(int around);

/// V15, V16: how an upper sheet begins that crosses the lower one, which is 0.3 m wide.
enum class CrossingStart { bulge, corner, line, noise, coincident };
inline constexpr CrossingStart crossing_starts[] = {CrossingStart::bulge, CrossingStart::corner,
                                                    CrossingStart::line, CrossingStart::noise,
                                                    CrossingStart::coincident};
const char* name_of(CrossingStart start);
/// Taken apart by the order of the layers: what is left, and the longest way over the mean edge.
LayeredCase untangled(CrossingStart start, int columns);

}  // namespace furrow::cases
