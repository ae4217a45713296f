// SPDX-License-Identifier: MIT
#include "physics/simulate_state.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace furrow::physics {
namespace {

template <typename... Parts>
void require(bool condition, const Parts&... parts) {
  if (condition) return;
  std::ostringstream text;
  text << "simulation state: ";
  (text << ... << parts);
  throw std::invalid_argument(text.str());
}

}  // namespace

void check(const SimulateState& s, std::size_t particles) {
  require(s.time >= 0 && std::isfinite(s.time), "time = ", s.time, " is not >= 0");
  require(s.step >= 0, "step = ", s.step, " is not >= 0");
  require(s.body_travel >= 0 && std::isfinite(s.body_travel), "body_travel = ", s.body_travel,
          " is not >= 0");
  check(s.compensation, particles);
  for (const Vec3& home : s.homes) require(home.allFinite(), "a pin's home is not finite");
  if (!s.planned) return;
  require(s.steps_left >= 0, "steps_left = ", s.steps_left, " is not >= 0");
  require(s.steps_left == 0 || (s.dt > 0 && std::isfinite(s.dt)), "dt = ", s.dt, " is not > 0");
  const double rest = double(s.steps_left) * s.dt;
  require(s.steps_left == 0 || std::abs(s.time + rest - s.end) <= 1e-6 * std::max(s.end, s.dt), s.steps_left,
          " steps of ", s.dt, " s do not lead from ", s.time, " s to ", s.end, " s");
  require(s.dt_limit >= 0, "dt_limit = ", s.dt_limit, " is not >= 0");
  require(s.contact.empty() || s.contact.size() == particles, "of a cloth with ", s.contact.size(),
          " particles instead of ", particles);
  for (const ContactMemory& known : s.contact) require(known.x.allFinite(), "a contact is not finite");
}

}  // namespace furrow::physics
