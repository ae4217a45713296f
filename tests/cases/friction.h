// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <vector>

#include "physics/body/collider.h"
#include "physics/motion/simulate.h"

namespace furrow::cases {

/// Bodies, each endless along z. First the half-space below a plane through the origin. slope != 1 is a field
/// that is off by a factor, as an interpolated field is in places.
struct Plane : physics::Collider {
  physics::Vec3 n;
  double slope;
  explicit Plane(const physics::Vec3& normal, double s = 1) : n(normal.normalized()), slope(s) {}
  physics::SignedDistance at(const physics::Vec3& x) const override { return {slope * n.dot(x), slope * n}; }
};

/// A cylinder around z.
struct Cylinder : physics::Collider {
  double radius;
  explicit Cylinder(double r) : radius(r) {}
  physics::SignedDistance at(const physics::Vec3& x) const override;
};

/// A table to the left with a quarter of a cylinder around z as its edge: top y = radius for x < 0, side x =
/// radius for y < 0.
struct RoundedTable : physics::Collider {
  double radius;
  explicit RoundedTable(double r) : radius(r) {}
  physics::SignedDistance at(const physics::Vec3& x) const override;
};

/// Heavy flexible strips that slip as soon as the right end hangs down far enough. R: radius in which the
/// strip lies; lengths beside or before the arc. Friction mu. Both functions follow from the balance of an
/// arc element, dT/dtheta = mu (T + w R cos theta) - w R sin theta, theta from the top. From a half cylinder:
/// l1 e^(mu pi) + 2 mu R (1 + e^(mu pi)) / (1 + mu^2).
double capstan_length(double mu, double radius, double left);
/// From a table's edge, below the quarter turn:  (mu l - a) e^(mu pi/2) + b,  a = R (1 - mu^2)/(1 + mu^2),
/// b = 2 mu R / (1 + mu^2).
double tablecloth_length(double mu, double radius, double on_table);

/// A strip in place: `turn` springs on the half or quarter circle of that radius, others as long or shorter,
/// on the table up to 4 mm; masses 0.15 kg/m times half the springs beside. balance() sets the rest lengths.
physics::Cloth strip_over_cylinder(double radius, double left, double right, int turn);
physics::Cloth strip_over_edge(double radius, double on_table, double right, int turn);

/// Stretches the strip's springs (of 300 N) so that every node is in balance with the friction mu N against
/// sliding to the right, where the field of `body` is at most gap + 1e-9 m. Returns the upward force [N] that
/// is left over at the right end.
double balance(physics::Cloth& strip, double mu, const physics::Collider& body, double gap);

struct SlipOptions {
  double friction = 0.3;
  double gap = 0.003;    ///< [m]
  double seconds = 0.8;  ///< [s]
};
struct Slip {
  double moved;  ///< of the left end [m]
  double share;  ///< friction that holds the strip as it lies, by balance() [-]
};
/// Releases a strip that is in balance with the friction that holds it.
Slip slip(physics::Cloth strip, const physics::Collider& body, const SlipOptions& options);

/// The right end's length at which strips begin to move by more than 1 mm, by bisection between low and high
/// to a thousandth.  make(right) builds the strip.
struct CriticalLength {
  double simulated, balanced;  ///< [m]; balanced: of the polygon, without time
};
CriticalLength critical_length(const std::function<physics::Cloth(double)>& make,
                               const physics::Collider& body, double low, double high,
                               const SlipOptions& options);

/// How far a sheet at rest (springs, 5 x 5 vertices, 4 cm) slides on an incline in 2 s [m].
double slide_of_sheet(double angle, double friction, double dt);
/// The angle [rad] beyond which it slides by more than 1e-5 m, by bisection to 1e-4 rad.
double incline_threshold(double friction, double dt);

/// A sheet of springs of that membrane stiffness [N/m], 10 cm wide, that starts so far above where it rests
/// on the plane y = 0 with that gap [m]; less than 0: below.
physics::Cloth sheet_over_floor(double above, double gap, double stiffness);
/// The eight starts that landings are tried from [m].
inline const std::vector<double> landing_starts{-2e-3, -1e-3, -5e-4, -1e-4, 1e-4, 5e-4, 1e-3, 2e-3};

/// Integrator, step, gap and friction are those of the options; nothing is damped.
/// How far it slides down an incline in 2 s, beyond the way that it falls along it before it lands [m].
double slide_of_landing(double angle, double above, double stiffness, physics::SimulateOptions options);
/// How far it slides on the floor until it stands [m]; speed: along it at the start [m/s].
double braking_way(double speed, double above, double stiffness, physics::SimulateOptions options);

}  // namespace furrow::cases
