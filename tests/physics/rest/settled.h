// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "physics/rest/certificate.h"
#include "physics/rest/settle.h"

namespace furrow::tests {

/// Rest without a body, and whether it is a stable one.
struct Settled : physics::SettleReport {
  bool stable = false;  ///< as certify() finds
};

/// Steps as long as they need be, down to this residual [-].
inline physics::SettleOptions down_to(double residual, const physics::Vec3& gravity = {0, -9.81, 0}) {
  physics::SettleOptions options;
  options.gravity = gravity;
  options.tolerance = residual;
  options.max_iterations = 1000;
  options.longest_move = 1;
  return options;
}

inline Settled find_rest(physics::Cloth& cloth, const physics::SettleOptions& options) {
  const physics::SettleReport report = physics::settle(cloth, nullptr, options);
  return {report, physics::certify(cloth, {.gravity = options.gravity}).stable()};
}

}  // namespace furrow::tests
