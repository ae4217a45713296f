// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/keeping/keep.h"
#include "geometry/mesh/mesh.h"

namespace furrow::bridge {

/// Measures the heights of a garment's lines at other positions of its vertices.
class LineMeter {
 public:
  /// Measures the lines that have a height where the mesh lies. base: see keep_lines(); widths, flat:
  /// KeepOptions::line_widths, flat_lines.
  LineMeter(const geometry::Mesh& mesh, const std::vector<double>& base, std::vector<double> widths,
            const std::vector<char>& flat = {});
  const std::vector<int>& lines() const { return lines_; }  ///< their ids, rising
  const std::vector<int>& unmeasured() const {
    return unmeasured_;
  }                                                          ///< ids of those whose height is not known
  std::vector<double> heights(const physics::Particles& p);  ///< of each [m]; NaN: no more known
  /// A line that is lower than `least` [m] can be told.
  struct TooLow {
    int line;
    double height, least;  ///< [m]
  };
  /// Leaves lines out that are lower, where p lies, than `least` [m] or than 1/200 of the mean edge at them.
  std::vector<TooLow> leave_out_low(const physics::Particles& p, double least);

 private:
  double mean_edge_at(int line) const;  ///< of shape_ [m]

  geometry::Mesh shape_;        ///< a copy that is moved about
  std::vector<double> widths_;  ///< by id [m]
  std::vector<int> lines_, unmeasured_;
  std::vector<double> base_;  ///< of each [m]
};

/// The acceleration of the options' gust [m/s^2]: where they name no direction, level, and the one in which
/// the cloth is thinnest.
physics::Vec3 gust_of(const KeepOptions& options, const std::vector<physics::Vec3>& x);

/// Moves each free particle by so much [m], or a tenth of the shortest edge at it, in some direction, which
/// is the same in every run of this number.
void push_off(physics::Cloth& cloth, double by, std::uint64_t number);

/// Heights over those at the start [-].
std::vector<double> shares_of_heights(std::vector<double> heights, const std::vector<double>& at_start);
/// The longest way between two places of a particle [m].
double farthest_apart(const std::vector<physics::Vec3>& a, const std::vector<physics::Vec3>& b);

struct KeepTrial {
  std::vector<double> kept,
      kept_gust;         ///< of each line, shares of the height at the start [-]; NaN: not reached
  double drift = 0;      ///< of any particle in the runs without gusts [m]
  bool stopped = false;  ///< by go_on
};
/// Asked with what lines keep after a fifth of the first run. true: the trial ends.
using InVain = std::function<bool(const std::vector<double>& shares)>;

/// Runs a cloth forward from rest for a fifth of the options' seconds; from there through gusts to both sides
/// along two level axes, and a calm; and from there, too, without gusts to the end. The cloth is not changed.
/// stable: what its certificate says; if not, there are options.pushes runs without gusts, and of `kept` the
/// worst counts, at any time from 0.5 s on. The calm after gusts, and that of a stable shape, end once no
/// vertex has moved for 0.3 s fast enough to take a line out of its bounds within a second. Implicit steps
/// are those of backward Euler: their gusts are 1.6 times as strong, and where nothing blows they go on with
/// factors of steps before, 1/30 s long unless the options name a step. What a trial that ends early does not
/// know is NaN. Both functions may be empty.
///
/// \details Each run begins with a push of every vertex: an unstable shape would stand still like a pencil on
/// its tip, and a stable one may lie in a shallow hollow.
KeepTrial try_shape(const physics::Cloth& start, bool stable, const physics::World& world,
                    const KeepOptions& options, LineMeter& meter, const InVain& in_vain,
                    const std::function<bool(double)>& go_on);

}  // namespace furrow::bridge
