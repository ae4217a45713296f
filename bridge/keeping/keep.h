// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "geometry/mesh/mesh_fwd.h"
#include "physics/body/collider.h"
#include "physics/motion/simulate.h"
#include "physics/rest/certificate.h"
#include "physics/rest/prestress.h"

namespace furrow::bridge {

struct KeptShape {
  physics::PrestressReport rest;
  physics::Certificate certificate;
  double turned = 0;              ///< about its pins into balance [rad]
  physics::PushOutReport pushed;  ///< of particles nearer to the body than the gap
};

/// Gives a pinned cloth the rest state with which it is in equilibrium as it lies, on the body where that
/// stands (physics/rest/prestress.h), and tells whether that equilibrium is stable
/// (physics/rest/certificate.h). Without a body, what hangs on a line of pins or on one pin is first turned
/// about it into balance, if by no more than largest_turn [rad] (physics/rest/rigid_imbalance.h); what is
/// nearer to a body than the gap is first brought out to it. Otherwise positions stay; velocities and
/// stiffnesses always do. Wind is no load here. count: how many ways it gives way, else only whether. Cost: a
/// factorisation or two. Throws std::invalid_argument, nothing changed, as require_still() and prestress()
/// do.
KeptShape keep_shape(physics::Cloth& cloth, const physics::World& world,
                     const physics::PrestressOptions& options, double largest_turn = 0, bool count = true);

/// Of a cloth that keep_shape() gave its rest state, with the same world and options.
physics::Certificate certify_kept(const physics::Cloth& cloth, const physics::World& world,
                                  const physics::PrestressOptions& options, bool count);

/// Throws std::invalid_argument if body or pins move.
void require_still(const physics::World& world);

/// How keep_lines() tries and helps.
struct KeepOptions {
  /// Of the forward runs; gravity, friction and gap also of balance and certificate.
  physics::SimulateOptions run;
  physics::PrestressOptions bounds;  ///< of the rest state; its gravity, friction and gap are those of `run`
  double seconds = 5;                ///< the first forward run, from rest [s]; > 0
  /// An acceleration to one side, then to the other, and the same across, level [m/s^2]; >= 0; 0: no gust.
  double gust = 12;
  double gust_seconds = 0.4, calm_seconds = 2;  ///< of each, and after the last [s]; > 0
  physics::Vec3 gust_direction{0, 0, 0};        ///< of the first; 0: level, as the cloth is thinnest
  /// Each run begins with every vertex pushed off by `push`, or a tenth of its shortest edge, in another
  /// direction each time. A shape that is not stable is run `pushes` times.
  int pushes = 2;      ///< >= 1
  double push = 1e-4;  ///< [m]; > 0
  double kept = 0.95;  ///< share of the height that a line must keep, and not outgrow by more [-]; in (0, 1)
  /// Factors on the hinges of a line, in the order tried [-]; rising, each > 1.
  std::vector<double> presses{10, 30, 100};
  std::vector<double> struts{0.3, 3, 30};  ///< then also struts [N/m]; each > 0
  /// A line that is lower than this, or than 1/200 of the mean edge at it, is refused at once: a push is as
  /// high [m]; >= 0.
  double least_height = 1e-4;
  int height_trials = 4;  ///< then bisections of the height; >= 0; 0: none
  /// A garment that hangs on a line of pins, or on one pin, is first turned about it into balance, if by no
  /// more than this [rad]; >= 0; 0: never.
  double largest_turn = 0.2;
  /// By line id: widths as drawn [m], NaN: none, which say where lines are measured and helped
  /// (geometry/fold/line_region.h); and presses [-] that the cloth's hinges have already, for the report.
  /// What is missing at the end counts as none, and as 1.
  std::vector<double> line_widths = {}, line_presses = {};
  /// By line id: the height that was asked for [m], as line_heights() measures it less `base`; NaN, 0 or
  /// missing: that at which the line lies.
  std::vector<double> line_heights = {};
  /// By line id: 1 for a line that is to have no height, and so has none to keep: it is not looked at.
  std::vector<char> flat_lines = {};
  bool whole = false;  ///< the rest of the garment is pressed, too, until nothing in it is unstable
};

/// Throws std::invalid_argument, with the option and its value, if one is out of its range.
void require_legal(const KeepOptions& options);

enum class Verdict {
  held,
  pressed,
  strutted,
  lowered,   ///< it stands, at less than `kept` of the height that was asked for
  may_hold,  ///< it stands where nothing blows, but not in gusts, or hardly: see reason
  cannot_hold,
  not_known  ///< the work was interrupted before that was found
};

/// Whether a line with that verdict stands at the height that was asked for, as far as trials can say.
constexpr bool holds(Verdict verdict) { return verdict < Verdict::lowered; }

struct KeptLine {
  int line = -1;  ///< its id in attribute::line
  Verdict verdict = Verdict::cannot_hold;
  double press = 1;    ///< factor on its hinges, its own and that of the help [-]
  double struts = 0;   ///< stiffness of its struts [N/m]; 0: none
  double height = 0;   ///< that it was balanced at, after lowering [m]
  double lowered = 1;  ///< that over the height that was asked for [-]; NaN: not known
  /// Shares of `height` after the two runs [-]; NaN: not run. Gusts are those that decided.
  double kept = 0, kept_gust = 0;
  std::string reason;  ///< of those that do not hold
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
  double drift = 0;          ///< of any vertex in the last trial's runs without gusts [m]
  bool interrupted = false;  ///< the last rest state stands; lines say what is known
};

/// How far keep_lines() is.
struct KeepProgress {
  int trial;     ///< number of the rest state that is tried, from 1
  int helped;    ///< lines with more help than in the trial before
  double share;  ///< of this trial [-]
};
/// false: stop.
using KeepObserver = std::function<bool(const KeepProgress&)>;

/// Gives a cloth the rest state that makes its drawn lines an equilibrium (physics/rest/prestress.h), and
/// tells of each line whether it will hold. mesh: the garment with attribute::line, from which `cloth` was
/// gathered and pinned. base: height that a line would have without displacement, by id [m]; may be empty.
/// go_on: asked between and within runs; may be empty. On return `cloth` has the new rest state,
/// stiffnesses and struts, at the positions of the mesh, at rest. Same input, same bits. Cost: a
/// factorisation or two each trial; the forward runs are most of it. Throws std::invalid_argument, nothing
/// changed, if an option is out of its range or cloth and mesh do not fit; and as prestress() and simulate()
/// do.
///
/// \details What takes part in a motion that nothing holds back (physics/rest/certificate.h), or loses its
/// height in a search for rest, is helped by a step, by two where it is off by a fifth or had help before:
/// press (its hinges stiffer), then struts on top of the strongest press, then a lower height. Once a line
/// without help fails in a later trial than the first, all lines get the first step. The first help with
/// which all lines rest stays, and then runs forward, from rest and through gusts, have the last word: what
/// moves without a gust is helped again; what gusts alone take may hold, and the report says what they left.
/// What is nearer to the body than the gap is first brought there: a valley on a body is as deep as there is
/// room.
///
/// With `whole` the hinges between the lines are pressed likewise, where the motion that nothing holds back
/// is theirs.
///
/// The positions of `mesh` are the drawn shape, and follow where heights were lowered.
/// attribute::rest_position tells where a line lies without its height; without that map nothing is lowered.
KeepReport keep_lines(geometry::Mesh& mesh, physics::Cloth& cloth, const physics::World& world,
                      const std::vector<double>& base, const KeepOptions& options,
                      const KeepObserver& go_on = {});

}  // namespace furrow::bridge
