// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "jobs/base/ends.h"
#include "physics/body/exact_distance.h"
#include "physics/motion/simulate.h"

namespace furrow::jobs {

/// A border loop as it lies.
struct BorderReport {
  double rest_length, length;       ///< [m]
  double mean_height, mean_radius;  ///< horizontal radius [m]
  int radius_maxima;                ///< folds
};

/// A line's height against what it was.
struct LineReport {
  std::size_t id = 0;
  std::optional<std::string> name;     ///< name and drawn height: none where the garment notes no such line
  std::optional<double> drawn_height;  ///< [m]
  std::optional<double> width;         ///< [m]; none: it has none
  double press = 1;                    ///< factor on the stiffness of its hinges [-]
  double smoothed_height = 0;          ///< after it was drawn, or at the run's start [m]
  double height = 0;                   ///< now [m]
  std::optional<double> kept;  ///< height over smoothed_height [-]; none: it has no height of its own to keep
  std::optional<double> gather, gathered;  ///< its thread's share of its length, as asked for and now [-]
};

/// What the cloth does to the body, and it to the cloth.
struct ContactReport {
  double gap = 0;        ///< that was kept [m]
  double tolerance = 0;  ///< error of the body's field [m]
  physics::Penetration inside;
  physics::Vec3 deepest_at{0, 0, 0};  ///< of a vertex, where any is inside [m]
};

/// A garment as a simulation left it.
struct ReachedShape {
  physics::Vec3 centre{0, 0, 0};         ///< of mass [m]
  std::optional<ContactReport> contact;  ///< none: there is no body
  ClothCrossings crossings;
  EndFacts end;                          ///< without a residual of what moves
  physics::Vec3 strained_most{0, 0, 0};  ///< the middle of the edge that is [m]
  std::vector<BorderReport> borders;     ///< longest first
  std::vector<LineReport> lines;
};

/// Which steps a cloth is moved by where a scene leaves that open, and why.
struct ChosenSteps {
  physics::Integrator integrator = physics::Integrator::leapfrog;
  double leapfrog = 0, implicit = 0;  ///< predicted seconds of one thread for a second of motion [s]
};

Json to_json(const std::vector<BorderReport>& borders);
Json to_json(const std::vector<LineReport>& lines);

}  // namespace furrow::jobs
