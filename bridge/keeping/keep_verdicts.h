// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "bridge/keeping/keep.h"
#include "bridge/keeping/keep_trial.h"
#include "bridge/keeping/line_help.h"

namespace furrow::bridge {

using LineFlags = std::vector<char>;  // one a line

/// The lines and their help.
struct KeepPlan {
  std::vector<HelpedLine> lines;
  std::size_t rest_step = 0;  ///< of presses, on what lies in no line's patch
};
/// Where a plan leads.
struct KeepOutcome {
  physics::Cloth cloth;                 ///< with its rest state
  KeptShape shape;                      ///< of that
  double rest_press;                    ///< factor on the hinges outside of all patches [-]
  std::vector<double> kept, kept_gust;  ///< of each line, shares of its height [-]; NaN: not run
  bool blown = false;                   ///< there were gusts; else kept_gust is what calm left
};
struct TriedPlan {
  KeepPlan plan;
  KeepOutcome outcome;
};

/// Shares in the motion that nothing holds back, of each line and last of the rest [-]; 0 if there is no such
/// motion.
std::vector<double> loose_shares(const TriedPlan& found);
LineFlags loose_lines(const TriedPlan& found);  ///< with a good part in it
bool rest_is_loose(const TriedPlan& found);     ///< what lies between the lines has one
bool hangs_wrong(const KeepOutcome& outcome);   ///< nothing holds the garment in balance
/// Whether the rest state's bounds leave a line no balance.
bool is_bound(const HelpedLine& line, const KeepOutcome& outcome);

/// Of its height, or win [-]; least: share that it must keep. An unstable shape ends elsewhere each time: a
/// run is a sample, and the next one may be worse.
double may_lose(const KeepOutcome& outcome, double least);
/// The same after gusts: where one leaves a line is a sample, too, whether the shape is stable or not.
double may_lose_in_gusts(const KeepOutcome& outcome, double least);

/// Lines that keep their height where nothing blows, as far as is known; least: share of its height that a
/// line must keep [-].
LineFlags lines_at_rest(const TriedPlan& found, double least);
/// Lines that hold: gusts leave them their height, too.
LineFlags good_lines(const TriedPlan& found, double least);

/// What is told of each line that was tried, with reasons. heights: of each line in the outcome's cloth [m];
/// interrupted: what is not known is told so.
std::vector<KeptLine> verdicts(const TriedPlan& found, const std::vector<double>& heights,
                               const KeepOptions& options, bool interrupted);
KeptLine unmeasured_line(int id);  ///< of one whose height is not known
KeptLine too_low_line(const LineMeter::TooLow& low, const KeepOptions& options);  ///< of one that was refused

}  // namespace furrow::bridge
