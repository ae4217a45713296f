// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "geometry/mesh.h"
#include "physics/certificate.h"
#include "physics/prestress.h"
#include "physics/simulate.h"

namespace furrow::bridge {

struct KeepOptions {
  physics::SimulateOptions
      run;  ///< of the forward runs; gravity, friction and gap also of balance and certificate
  physics::PrestressOptions bounds;  ///< of the rest state; its gravity, friction and gap are those of `run`
  double seconds = 5;                ///< the first forward run, from rest [s]; > 0
  double gust = 12;                  ///< then an acceleration to one side [m/s^2]; >= 0; 0: no gust
  double gust_seconds = 0.4, calm_seconds = 2;  ///< [s]; > 0
  physics::Vec3 gust_direction{0, 0, 0};        ///< 0: level, the way in which the cloth is thinnest
  /// Each run begins with every vertex pushed off by `push`, or a tenth of its shortest edge, another way each
  /// time; a shape that is not stable is run so many times.
  int pushes = 2;      ///< >= 1
  double push = 5e-4;  ///< [m]; > 0
  double kept = 0.95;  ///< share of the height that a line must keep, and not outgrow by more [-]; in (0, 1)
  std::vector<double> presses{10, 30,
                              100};        ///< factors on the hinges of a line, in the order tried; each > 1
  std::vector<double> struts{0.3, 3, 30};  ///< then also struts [N/m]; each > 0
  int height_trials = 4;                   ///< then bisections of the height; >= 0; 0: none
  /// What hangs on a line of pins or on one is first turned about it into balance, if by no more than this
  /// [rad]; >= 0; 0: never.
  double largest_turn = 0.2;
  /// Of the lines by id, as drawn: widths [m], NaN: none, for where they are measured and helped
  /// (geometry/line_region.h), and presses [-] that the cloth's hinges have already, for the report. Missing
  /// at the end: none, and 1.
  std::vector<double> line_widths = {}, line_presses = {};
  bool whole = false;  ///< the rest of the garment is pressed, too, until nothing in it is unstable
};

enum class Verdict { held, pressed, strutted, lowered, cannot_hold };

struct KeptLine {
  int line = -1;  ///< its id in kLine
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

/// Gives a cloth the rest state that makes its drawn lines an equilibrium (physics/prestress.h), and tells of
/// each line whether it will hold: by the certificate of stability (physics/certificate.h) and by a run
/// forward, from rest and after a gust. What is nearer to the body than the gap is first brought there: a
/// valley on a body is as deep as there is room. Lines that do not hold are helped, one step more each time
/// and no line more than it needs: press (their hinges stiffer), then struts on top of the strongest press,
/// then a lower height; the least that holds stays. With `whole` the hinges between the lines are pressed
/// likewise where the motion that nothing holds back is theirs.
///
/// mesh: the garment with kLine, from which `cloth` was gathered and pinned; its positions are the drawn
/// shape, and follow where heights were lowered. kRestPosition tells where a line lies without its height;
/// without it nothing is lowered. base: height that a line would have without displacement, by id [m]
/// (curvature of the garment); may be empty. On return `cloth` has the new rest state, stiffnesses and
/// struts, at the positions of the mesh, at rest. go_on: asked between and within runs; false: stop. May be
/// empty. Cost: a factorisation or two each trial; the forward runs are most of it. Same input, same bits.
/// Throws std::invalid_argument, nothing changed, if an option is out of its range or cloth and mesh do not
/// fit; and as prestress() and simulate() do.
KeepReport keep_lines(geometry::Mesh& mesh, physics::Cloth& cloth, const physics::World& world,
                      const std::vector<double>& base, const KeepOptions& options,
                      const std::function<bool(double)>& go_on = {});

}  // namespace furrow::bridge
