// SPDX-License-Identifier: MIT
#include "physics/motion/wind.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace furrow::physics {
namespace {

/// The air of one time:  w(x) = uniform + turning x (x - centre).
struct Air {
  Vec3 uniform, turning = Vec3::Zero(), centre = Vec3::Zero();
  Air(const Wind& wind, double time) : uniform(gust_factor(wind, time) * wind.velocity) {
    if (!wind.swirl) return;
    turning = spin_rate(*wind.swirl, time) * wind.swirl->axis.normalized();
    centre = wind.swirl->centre;
  }
  Vec3 at(const Vec3& x) const { return uniform + turning.cross(x - centre); }
};

}  // namespace

void check(const Wind& wind) {
  if (!wind.velocity.allFinite()) throw std::invalid_argument("wind: the velocity is not finite");
  for (std::size_t i = 0; i < wind.gusts.size(); ++i) {
    const Gust& gust = wind.gusts[i];
    const std::string name = "wind: gust " + std::to_string(i);
    if (!std::isfinite(gust.time) || !std::isfinite(gust.factor)) {
      throw std::invalid_argument(name + " is not finite");
    }
    if (i > 0 && !(gust.time > wind.gusts[i - 1].time)) {
      throw std::invalid_argument(name + ": time " + std::to_string(gust.time) +
                                  " is not after that of the one before");
    }
  }
  if (wind.swirl) check(*wind.swirl);
}

bool is_still(const Wind& wind) {
  const bool calm = !wind.gusts.empty() && std::all_of(wind.gusts.begin(), wind.gusts.end(),
                                                       [](const Gust& g) { return g.factor == 0; });
  return (wind.velocity.isZero(0) || calm) && (!wind.swirl || wind.swirl->rate == 0);
}

double gust_factor(const Wind& wind, double time) {
  const std::vector<Gust>& gusts = wind.gusts;
  if (gusts.empty()) return 1;
  if (time <= gusts.front().time) return gusts.front().factor;
  if (time >= gusts.back().time) return gusts.back().factor;
  const auto next =
      std::upper_bound(gusts.begin(), gusts.end(), time, [](double t, const Gust& g) { return t < g.time; });
  const Gust &a = *(next - 1), &b = *next;
  return a.factor + (time - a.time) / (b.time - a.time) * (b.factor - a.factor);
}

Vec3 air_velocity(const Wind& wind, const Vec3& x, double time) { return Air(wind, time).at(x); }

void blow(PackedCloth& cloth, const Wind& wind, double time, double decay, ThreadPool& pool) {
  const Air air(wind, time);
  pool.run(cloth.particles(), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      if (cloth.inv_mass[i] == 0) continue;
      const Vec4& x = cloth.x[i];
      Vec4& v = cloth.v[i];
      const Vec3 w = air.at(Vec3(x.x, x.y, x.z)), u = w + decay * (Vec3(v.x, v.y, v.z) - w);
      v = {u.x(), u.y(), u.z(), 0};
    }
  });
}

void air_at(const PackedCloth& cloth, const Wind& wind, double time, std::vector<Vec4>& velocity,
            ThreadPool& pool) {
  const Air air(wind, time);
  velocity.resize(cloth.x.size());
  pool.run(cloth.particles(), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Vec4& x = cloth.x[i];
      const Vec3 w = air.at(Vec3(x.x, x.y, x.z));
      velocity[i] = {w.x(), w.y(), w.z(), 0};
    }
  });
}

}  // namespace furrow::physics
