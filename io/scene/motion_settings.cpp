// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/motion_settings.h"

#include <cmath>

#include "io/scene/setting_row.h"

namespace furrow::io {
namespace {

using physics::Gust, physics::Keyframe, physics::RigidMotion, physics::Spin;

const Row<Spin> spin_rows[] = {
    {{.path = "spin.centre", .what = "a point of the axis"}, vector(FIELD(centre), "m")},
    {{.path = "spin.axis", .what = "of any length but 0"}, vector(FIELD(axis), "")},
    {{.path = "spin.rate", .what = "counter-clockwise, seen against the axis"},
     number(FIELD(rate), any("rad/s"))},
    {{.path = "spin.start", .what = "when it begins"}, number(FIELD(start), not_negative("s"))},
    {{.path = "spin.ramp", .what = "how long it takes to its rate"}, number(FIELD(ramp), not_negative("s"))},
};

const Row<Keyframe> keyframe_rows[] = {
    {{.path = "keyframes.time", .what = "later than that of the keyframe before"},
     number(FIELD(time), not_negative("s"))},
    {{.path = "keyframes.translation", .what = "from its place at first"}, vector(FIELD(translation), "m")},
    {{.path = "keyframes.rotation", .what = "axis times angle"}, vector(FIELD(rotation), "rad")},
};

const Row<Gust> gust_rows[] = {
    {{.path = "gusts.time", .what = "later than that of the gust before"},
     number(FIELD(time), not_negative("s"))},
    {{.path = "gusts.factor", .what = "of the wind"}, number(FIELD(factor), any())},
};

/// The elements of the list `key`, by time.
template <class T>
void read_timed(SettingsTable& parent, const char* key, std::span<const Row<T>> rows, const char* fault,
                std::vector<T>& list) {
  for (SettingsTable& table : parent.tables(key)) {
    T element{};
    read_rows<T>(table, key, rows, element);
    table.finish();
    if (!list.empty() && element.time <= list.back().time) table.fail("time", fault);
    list.push_back(element);
  }
}

const Row<RigidMotion> motion_rows[] = {
    {{.path = "motion.pivot", .what = "what keyframes turn it about"}, vector(FIELD(pivot), "m")},
    {{.path = "motion.keyframes", .what = "`[{time, translation, rotation}, …]`"},
     own(Kind::table, "tables",
         [](SettingsTable& table, const char* key, RigidMotion& m) {
           read_timed<Keyframe>(table, key, keyframe_rows, "must be later than that of the keyframe before",
                                m.keyframes);
         })},
    {{.path = "motion.ends",
      .what = "speed at the first and the last keyframe: 0, or that of the keyframes beside it"},
     choice<physics::EndSpeeds>(FIELD(ends),
                                {{"rest", physics::EndSpeeds::rest}, {"free", physics::EndSpeeds::free}})},
    {{.path = "motion.spin", .what = "`{centre, axis, rate, start, ramp}`"},
     own(Kind::table, "table",
         [](SettingsTable& table, const char* key, RigidMotion& m) { m.spin = read_spin(table, key); })},
};

}  // namespace

std::vector<Setting> settings_of_motion() {
  std::vector<Setting> list;
  for (const auto& row : motion_rows) list.push_back(row.setting);
  for (const auto& row : keyframe_rows) list.push_back(row.setting);
  for (const auto& row : spin_rows) list.push_back(row.setting);
  for (const auto& row : gust_rows) list.push_back(row.setting);
  return list;
}

void read_motion(SettingsTable& parent, const char* key, RigidMotion& motion) {
  auto table = parent.table(key);
  if (!table) return;
  read_rows<RigidMotion>(*table, "motion", motion_rows, motion);
  table->finish();
}

std::optional<Spin> read_spin(SettingsTable& parent, const char* key) {
  auto table = parent.table(key);
  if (!table) return std::nullopt;
  Spin spin;
  read_rows<Spin>(*table, "spin", spin_rows, spin);
  table->finish();
  if (!(spin.axis.norm() > 1e-12) || !std::isfinite(spin.axis.norm()))
    table->fail("axis", "must have a length above 0 that is no overflow; write a unit vector");
  return spin;
}

void read_gusts(SettingsTable& parent, const char* key, std::vector<Gust>& gusts) {
  read_timed<Gust>(parent, key, gust_rows, "must be later than that of the gust before", gusts);
}

}  // namespace furrow::io
