// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/keeping/keep.h"
#include "bridge/keeping/keep_trial.h"

namespace furrow::bridge {

/// A line on the way to its verdict, and the help that it has so far.
struct HelpedLine {
  int id;
  std::vector<int> patch;       ///< its region, see geometry/fold/line_region.h
  double drawn;                 ///< height [m]
  int step = 0;                 ///< of presses, then of struts on top of the strongest press
  double height = 1;            ///< over that as drawn [-]
  double width = 0, press = 1;  ///< as drawn [m], 0: none; and [-]
};

/// The lines that a meter measures, as they lie on a garment, without help.
std::vector<HelpedLine> helped_lines(const geometry::Mesh& mesh, const physics::Particles& particles,
                                     LineMeter& meter, const KeepOptions& options);

int help_steps(const KeepOptions& options);                            ///< how many there are
double press_of(const HelpedLine& line, const KeepOptions& options);   ///< factor that helps [-]
double struts_of(const HelpedLine& line, const KeepOptions& options);  ///< [N/m]; 0: none

using Steps = std::vector<char>;  // of help that lines need more, one a line

/// Whether a line fails that had no help yet.
bool fails_anew(const Steps& steps, const std::vector<HelpedLine>& lines);
/// Adds these steps, but two to a line that had help before, and gives each line at least the step `least`,
/// as far as there is help. Returns how many lines get more.
int add_help(const Steps& steps, int least, const KeepOptions& options, std::vector<HelpedLine>& lines);

/// Whether some element of its patch is on a bound of the rest state.
bool on_bounds(const HelpedLine& line, const physics::PrestressReport& rest, const physics::Cloth& cloth);

/// Moves the patches of lines with height != 1 from `drawn` towards attribute::rest_position, where they lay
/// without a line; pins stay.
void place_lines(const std::vector<HelpedLine>& lines, const geometry::Mesh& mesh,
                 const physics::Particles& drawn, physics::Particles& particles);
/// Presses the lines' hinges and adds their struts. Where patches overlap, the stronger press counts.
/// rest_press: factor on all hinges that are in no line's patch [-].
void stiffen_lines(const std::vector<HelpedLine>& lines, const KeepOptions& options, double rest_press,
                   physics::Cloth& cloth);
/// Shares of a motion's kinetic energy [-]: that of each line's patch (they may overlap), and last that of
/// what lies in no patch. All are 0 for an empty motion.
std::vector<double> shares_of(const std::vector<HelpedLine>& lines, const physics::Particles& particles,
                              const std::vector<physics::Vec3>& motion);

}  // namespace furrow::bridge
