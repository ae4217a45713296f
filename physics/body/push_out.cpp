// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "physics/body/collider.h"

namespace furrow::physics {

PushOutReport push_out(std::span<Vec3> x, std::span<const int> which, const Collider& body, double level) {
  constexpr int moves = 20;
  constexpr double enough = 1e-9;  // [m], the rounding of positions
  if (!std::isfinite(level)) throw std::invalid_argument("push_out: level = " + std::to_string(level));
  for (int i : which)
    if (i < 0 || i >= static_cast<int>(x.size()))
      throw std::invalid_argument("push_out: there is no point " + std::to_string(i));
  PushOutReport report;
  for (int i : which) {
    const Vec3 start = x[i];
    SignedDistance d = body.at(x[i]);
    if (!(d.value < level - enough)) continue;
    for (int move = 0; move < moves && d.value < level - enough; ++move) {
      const double slope = d.gradient.norm();
      if (!(slope > 0)) break;
      x[i] += (level - d.value) / slope * d.gradient;
      d = body.at(x[i]);
    }
    ++report.moved;
    report.farthest = std::max(report.farthest, (x[i] - start).norm());
    report.still_inside += d.value < level - enough;
  }
  return report;
}

PushOutReport bring_out(Particles& particles, const Collider& body, double gap) {
  if (particles.inv_mass.size() != particles.size())
    throw std::invalid_argument("bring_out: " + std::to_string(particles.inv_mass.size()) +
                                " inverse masses of " + std::to_string(particles.size()) + " particles");
  std::vector<int> free;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (particles.inv_mass[i] > 0) free.push_back(int(i));
  return push_out(particles.x, free, body, gap);
}

}  // namespace furrow::physics
