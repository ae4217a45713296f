// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/frame.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "io/mesh/wrinkle_record.h"

namespace furrow::jobs {
namespace {

constexpr std::pair<const char*, double> units[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"inch", 0.0254}};

const std::pair<const char*, double>* find_unit(const std::string& unit) {
  const auto* found =
      std::find_if(std::begin(units), std::end(units), [&](const auto& u) { return unit == u.first; });
  return found == std::end(units) ? nullptr : found;
}

double metres_per_unit(const Frame& frame) {
  const auto* unit = find_unit(frame.unit_in_use());
  if (!unit) throw std::invalid_argument("unit: '" + frame.unit_in_use() + "' is not m, cm, mm or inch");
  return unit->second;
}

io::Axis axis(const Frame& frame) { return frame.up_in_use() == "z" ? io::Axis::z : io::Axis::y; }

}  // namespace

bool is_unit(const std::string& unit) { return find_unit(unit) != nullptr; }

void take_noted_frame(Frame& frame, const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const auto record = io::read_wrinkle_record(file);
    if (!record || !is_unit(record->unit)) continue;
    frame.noted_unit = record->unit;
    frame.noted_up = record->up;
    return;
  }
}

io::ReadOptions read_options(const Frame& frame) { return {metres_per_unit(frame), axis(frame)}; }

io::WriteOptions write_options(const Frame& frame) { return {metres_per_unit(frame), axis(frame)}; }

}  // namespace furrow::jobs
