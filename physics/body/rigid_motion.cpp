// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "physics/body/moving_body.h"

namespace furrow::physics {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;

[[noreturn]] void refuse_motion(const std::string& what) {
  throw std::invalid_argument("rigid motion: " + what);
}

Vec6 coordinates(const Keyframe& k) { return (Vec6() << k.translation, k.rotation).finished(); }

Vec6 secant(const std::vector<Keyframe>& keys, std::size_t i) {
  return (coordinates(keys[i + 1]) - coordinates(keys[i])) / (keys[i + 1].time - keys[i].time);
}

/// Of a coordinate with the secants a and b over intervals of lengths h and k: their weighted harmonic mean
///   3 (h + k) / ((h + 2 k) / a + (2 h + k) / b),  and 0 at an extremum.
Vec6 inner_slope(const std::vector<Keyframe>& keys, std::size_t i) {
  const Vec6 before = secant(keys, i - 1), after = secant(keys, i);
  const double h = keys[i].time - keys[i - 1].time, k = keys[i + 1].time - keys[i].time;
  Vec6 result;
  for (int c = 0; c < 6; ++c) {
    const double a = before[c], b = after[c];
    result[c] = a * b > 0 ? 3 * (h + k) / ((h + 2 * k) / a + (2 * h + k) / b) : 0;
  }
  return result;
}

/// At an end whose intervals, from it on, have the lengths h and k and the secants a and b: that of the
/// parabola, 0 where its sign is not a's, and at most 3 a.
Vec6 end_slope(double h, double k, const Vec6& a, const Vec6& b) {
  Vec6 result = ((2 * h + k) * a - h * b) / (h + k);
  for (int c = 0; c < 6; ++c) {
    if (result[c] * a[c] <= 0)
      result[c] = 0;
    else if (std::abs(result[c]) > 3 * std::abs(a[c]))
      result[c] = 3 * a[c];
  }
  return result;
}

Vec6 slope(const RigidMotion& motion, std::size_t i) {
  const std::vector<Keyframe>& keys = motion.keyframes;
  const std::size_t last = keys.size() - 1;
  if (i > 0 && i < last) return inner_slope(keys, i);
  if (motion.ends == EndSpeeds::rest) return Vec6::Zero();
  if (last == 1) return secant(keys, 0);
  const auto length = [&](std::size_t j) { return keys[j + 1].time - keys[j].time; };
  if (i == 0) return end_slope(length(0), length(1), secant(keys, 0), secant(keys, 1));
  return end_slope(length(last - 1), length(last - 2), secant(keys, last - 1), secant(keys, last - 2));
}

Vec6 interpolated(const RigidMotion& motion, double time) {
  const std::vector<Keyframe>& keys = motion.keyframes;
  if (time <= keys.front().time) return coordinates(keys.front());
  if (time >= keys.back().time) return coordinates(keys.back());
  const auto next = std::upper_bound(keys.begin(), keys.end(), time,
                                     [](double t, const Keyframe& k) { return t < k.time; });
  const auto i = std::size_t(next - keys.begin()) - 1;
  const double length = keys[i + 1].time - keys[i].time, s = (time - keys[i].time) / length;
  const Vec6 from = coordinates(keys[i]), way = coordinates(keys[i + 1]) - from;
  // Cubic Hermite, written so that two equal keyframes give exactly that pose.
  return from + (s * s * (3 - 2 * s)) * way + (s * (1 - s) * (1 - s) * length) * slope(motion, i) -
         (s * s * (1 - s) * length) * slope(motion, i + 1);
}

Eigen::Quaterniond rotation(const Vec3& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

}  // namespace

double spin_rate(const Spin& spin, double time) {
  if (time < spin.start) return 0;
  const double t = time - spin.start;
  return t < spin.ramp ? spin.rate * t / spin.ramp : spin.rate;
}

double spin_angle(const Spin& spin, double time) {
  if (time <= spin.start) return 0;
  const double t = time - spin.start;
  return t < spin.ramp ? spin.rate * t * t / (2 * spin.ramp) : spin.rate * (t - spin.ramp / 2);
}

void check(const Spin& spin) {
  if (!spin.centre.allFinite()) refuse_motion("the spin's centre is not finite");
  if (!std::isfinite(spin.axis.norm()) || !(spin.axis.norm() > 0))
    refuse_motion("the spin's axis has no direction");
  if (!std::isfinite(spin.rate)) refuse_motion("the spin's rate is not finite");
  if (!std::isfinite(spin.start)) refuse_motion("the spin's start is not finite");
  if (!(spin.ramp >= 0) || !std::isfinite(spin.ramp)) {
    refuse_motion("the spin's ramp = " + std::to_string(spin.ramp) + " is not >= 0");
  }
}

void check(const RigidMotion& motion) {
  if (!motion.pivot.allFinite()) refuse_motion("the pivot is not finite");
  for (std::size_t i = 0; i < motion.keyframes.size(); ++i) {
    const Keyframe& k = motion.keyframes[i];
    const std::string name = "keyframe " + std::to_string(i);
    if (!std::isfinite(k.time) || !k.translation.allFinite() || !k.rotation.allFinite()) {
      refuse_motion(name + " is not finite");
    }
    if (i > 0 && !(k.time > motion.keyframes[i - 1].time)) {
      refuse_motion(name + ": time " + std::to_string(k.time) + " is not after that of the one before");
    }
  }
  if (motion.spin) check(*motion.spin);
}

bool at_rest(const RigidMotion& motion) {
  if (motion.spin && motion.spin->rate != 0) return false;
  return std::all_of(motion.keyframes.begin(), motion.keyframes.end(),
                     [&](const Keyframe& k) { return coordinates(k) == coordinates(motion.keyframes[0]); });
}

bool is_identity(const RigidMotion& motion) {
  return at_rest(motion) && (motion.keyframes.empty() || coordinates(motion.keyframes[0]).isZero(0));
}

Pose pose(const RigidMotion& motion, double time) {
  Pose result;
  if (motion.spin && spin_angle(*motion.spin, time) != 0) {
    const Spin& spin = *motion.spin;
    result.rotation = Eigen::AngleAxisd(spin_angle(spin, time), spin.axis.normalized());
    result.translation = spin.centre - result.rotation * spin.centre;
  }
  if (!motion.keyframes.empty()) {
    const Vec6 key = interpolated(motion, time);
    const Eigen::Quaterniond turn = rotation(key.tail<3>());
    result.translation = turn * (result.translation - motion.pivot) + motion.pivot + key.head<3>();
    result.rotation = turn * result.rotation;
  }
  return result;
}

}  // namespace furrow::physics
