// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "physics/motion/stepper.h"
#include "tests/cases/membrane_laws.h"

namespace furrow::cases {

/// A motion to measure all integrators on, short enough that its end does not depend on rounding.
struct Swing {
  physics::Cloth cloth;
  physics::Loads loads;
  double seconds;  ///< [s]
};

struct SheetOptions {
  int columns = 16;  ///< over 0.4 m; >= 1
  double stiffness =
      200;            ///< of a spring of a regular lattice [N/m]; Y = 2/sqrt(3) of it, see membrane_laws.h
  double jitter = 0;  ///< of the mesh [edges]; in [0, 0.3]
  MembraneLaw law = MembraneLaw::paper;  ///< calibrated to Y
  double spring_damping = 0.02;          ///< share of critical [-]
  double seconds = 0.3;                  ///< [s]
};
/// A square sheet of springs, 0.4 m, 0.15 kg/m^2, that lies level and hangs by two corners: it swings down.
/// Air drag 0.2 1/s.
Swing sheet_swing(const SheetOptions& options = {});
/// 32 springs of uneven length (0.3 to 1.7 of the mean), 1 m, 0.1 kg, EA = 147 N, level at first and held at
/// one end; 0.5 s.
Swing chain_swing();
/// One spring of 1 m and 50 N/m with 0.1 kg at its end, let go at (1.1, 0.2), undamped; 2 s. Its end, by a
/// method of order 8 with an error of 1e-13, is (0.389103045248, -0.920914325687).
Swing elastic_pendulum();

struct SwingRun {
  std::vector<physics::Vec3> x;  ///< at the end, or where it diverged
  bool diverged = false;         ///< not finite, or a particle was faster than 1000 m/s
  double dt = 0;                 ///< asked for, shortened so that steps fit [s]
  double cpu_seconds = 0;        ///< of this thread
  physics::WorkCounts work;
};
/// Runs on one thread. Divergence is looked for every 16 steps and at the end.
SwingRun run(const Swing& swing, const physics::StepperOptions& options, double dt);

double thread_seconds();  ///< processor time of this thread [s]

/// Not finite, or a particle is faster than 1000 m/s.
bool has_diverged(const physics::PackedCloth& cloth);

/// Root mean square, weighted by mass, of the distances between two ends, over that of the way from the start
/// to `exact` [-]. A cloth that does not move has 1.
double relative_error(const Swing& swing, const std::vector<physics::Vec3>& end,
                      const std::vector<physics::Vec3>& exact);

/// 2 / omega_max of the cloth as it lies, to 1e-4 [s].
double step_limit(const Swing& swing);

}  // namespace furrow::cases
