// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "physics/motion/simulate.h"
#include "physics/rest/prestress.h"

namespace furrow::bridge {

/// How bridge/keep_lines.h tries and helps.
struct KeepOptions {
  /// Of the forward runs; gravity, friction and gap also of balance and certificate.
  physics::SimulateOptions run;
  physics::PrestressOptions bounds;  ///< of the rest state; its gravity, friction and gap are those of `run`
  double seconds = 5;                ///< the first forward run, from rest [s]; > 0
  double gust = 12;                  ///< then an acceleration to one side [m/s^2]; >= 0; 0: no gust
  double gust_seconds = 0.4, calm_seconds = 2;  ///< [s]; > 0
  physics::Vec3 gust_direction{0, 0, 0};        ///< 0: level, the way in which the cloth is thinnest
  /// Each run begins with every vertex pushed off by `push`, or a tenth of its shortest edge, in another
  /// direction each time. A shape that is not stable is run `pushes` times.
  int pushes = 2;      ///< >= 1
  double push = 1e-4;  ///< [m]; > 0
  double kept = 0.95;  ///< share of the height that a line must keep, and not outgrow by more [-]; in (0, 1)
  /// Factors on the hinges of a line, in the order tried [-]; rising, each > 1.
  std::vector<double> presses{10, 30, 100};
  std::vector<double> struts{0.3, 3, 30};  ///< then also struts [N/m]; each > 0
  int height_trials = 4;                   ///< then bisections of the height; >= 0; 0: none
  /// A garment that hangs on a line of pins, or on one pin, is first turned about it into balance, if by no
  /// more than this [rad]; >= 0; 0: never.
  double largest_turn = 0.2;
  /// By line id: widths as drawn [m], NaN: none, which say where lines are measured and helped
  /// (geometry/fold/line_region.h); and presses [-] that the cloth's hinges have already, for the report.
  /// What is missing at the end counts as none, and as 1.
  std::vector<double> line_widths = {}, line_presses = {};
  bool whole = false;  ///< the rest of the garment is pressed, too, until nothing in it is unstable
};

/// Throws std::invalid_argument, with the option and its value, if one is out of its range.
void require_legal(const KeepOptions& options);

}  // namespace furrow::bridge
