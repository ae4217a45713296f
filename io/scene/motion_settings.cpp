// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/motion_settings.h"

#include <cmath>

namespace furrow::io {

void read_motion(SettingsTable& parent, physics::RigidMotion& motion) {
  auto table = parent.table("motion");
  if (!table) return;
  table->read("pivot", motion.pivot);
  for (SettingsTable& key : table->tables("keyframes")) {
    physics::Keyframe keyframe{0};
    key.read("time", keyframe.time, not_negative("s"));
    key.read("translation", keyframe.translation);
    key.read("rotation", keyframe.rotation);
    key.finish();
    if (!motion.keyframes.empty() && keyframe.time <= motion.keyframes.back().time)
      key.fail("time", "must be later than that of the keyframe before");
    motion.keyframes.push_back(keyframe);
  }
  motion.spin = read_spin(*table, "spin");
  table->finish();
}

std::optional<physics::Spin> read_spin(SettingsTable& parent, const char* key) {
  auto table = parent.table(key);
  if (!table) return std::nullopt;
  physics::Spin spin;
  table->read("centre", spin.centre);
  table->read("axis", spin.axis);
  table->read("rate", spin.rate, any("rad/s"));
  table->read("start", spin.start, not_negative("s"));
  table->read("ramp", spin.ramp, not_negative("s"));
  table->finish();
  if (!(spin.axis.norm() > 1e-12) || !std::isfinite(spin.axis.norm()))
    table->fail("axis", "must have a length above 0 that is no overflow; write a unit vector");
  return spin;
}

}  // namespace furrow::io
