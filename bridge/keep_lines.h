// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "bridge/keep_options.h"
#include "geometry/mesh/mesh.h"
#include "physics/rest/certificate.h"

namespace furrow::bridge {

enum class Verdict { held, pressed, strutted, lowered, cannot_hold };

struct KeptLine {
  int line = -1;  ///< its id in attribute::line
  Verdict verdict = Verdict::cannot_hold;
  double press = 1;                ///< factor on its hinges, its own and that of the help [-]
  double struts = 0;               ///< stiffness of its struts [N/m]; 0: none
  double height = 0;               ///< that it was balanced at, after lowering [m]
  double lowered = 1;              ///< that over the height as drawn [-]
  double kept = 0, kept_gust = 0;  ///< shares of `height` after the two runs [-]; NaN: not run
  std::string reason;              ///< of cannot_hold
};

struct KeepReport {
  std::vector<KeptLine> lines;  ///< by id
  physics::PrestressReport rest;
  physics::Certificate certificate;
  double rest_press = 1;     ///< factor on the hinges outside of all lines' regions [-]
  double turned = 0;         ///< about its pins into balance [rad]
  int pushed_out = 0;        ///< particles nearer to the body than the gap, brought there first
  double farthest_push = 0;  ///< the longest way of one [m]
  int trials = 0, runs = 0;  ///< rest states that were solved for, and forward runs
  double drift = 0;          ///< of any vertex in the last run, before the gust [m]
  bool interrupted = false;  ///< the last rest state stands; lines say what is known
};

/// Gives a cloth the rest state that makes its drawn lines an equilibrium (physics/rest/prestress.h), and
/// tells of each line whether it will hold. mesh: the garment with attribute::line, from which `cloth` was
/// gathered and pinned. base: height that a line would have without displacement, by id [m]; may be empty.
/// go_on: asked between and within runs, false stops; may be empty. On return `cloth` has the new rest state,
/// stiffnesses and struts, at the positions of the mesh, at rest. Same input, same bits. Cost: a
/// factorisation or two each trial; the forward runs are most of it. Throws std::invalid_argument, nothing
/// changed, if an option is out of its range or cloth and mesh do not fit; and as prestress() and simulate()
/// do.
///
/// \details A verdict asks the certificate of stability (physics/rest/certificate.h) and a run forward, from
/// rest and after a gust. What is nearer to the body than the gap is first brought there: a valley on a body
/// is as deep as there is room. Lines that do not hold are helped, one step more each time and no line more
/// than it needs: press (their hinges stiffer), then struts on top of the strongest press, then a lower
/// height. The least that holds stays. With `whole` the hinges between the lines are pressed likewise, where
/// the motion that nothing holds back is theirs.
///
/// The positions of `mesh` are the drawn shape, and follow where heights were lowered.
/// attribute::rest_position tells where a line lies without its height; without that map nothing is lowered.
KeepReport keep_lines(geometry::Mesh& mesh, physics::Cloth& cloth, const physics::World& world,
                      const std::vector<double>& base, const KeepOptions& options,
                      const std::function<bool(double)>& go_on = {});

}  // namespace furrow::bridge
