// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/torso_levels.h"

#include <algorithm>
#include <cmath>

namespace furrow::geometry {
namespace {

// Thousandths of the body's height: whole numbers, because g++ 12 with -frounding-math counts the rounds of a
// loop over constants of type double wrongly.
constexpr int step_length = 5, seed = 620, lowest = 400, highest = 850;
constexpr double waist_low = 0.55, waist_high = 0.70, chest_high = 0.78;  // of the body's height
constexpr double least = 0.9, largest_value = 2.5;                        // heights of bodies [m]
constexpr double jump = 0.1;                                              // of the girth in one step
// Of the breadth, upwards: a bust and the back above the waist grow by 4 % in a step and 13 % in four, the
// armpit of an arm that is stretched out by more.
constexpr double arm_step = 0.06, arm_four_steps = 0.18, arm_begins = 0.02;

using Triangles = std::span<const std::array<int, 3>>;

std::array<double, 2> range_of_y(std::span<const Point> points, Triangles triangles) {
  std::array<double, 2> range{INFINITY, -INFINITY};
  for (const auto& t : triangles)
    for (int v : t) {
      if (v < 0 || static_cast<std::size_t>(v) >= points.size()) continue;  // horizontal_section() tells
      const double y = points[static_cast<std::size_t>(v)].y();
      range = {std::min(range[0], y), std::max(range[1], y)};
    }
  return range;
}

/// The largest closed curve, around a centre if one is given; the number of curves if there is none.
std::size_t find_torso(std::span<const SectionLoop> loops, const std::array<double, 2>* centre) {
  std::size_t best = loops.size();
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (!loops[i].closed || (centre && !encloses(loops[i], (*centre)[0], (*centre)[1]))) continue;
    if (best == loops.size() || enclosed_area(loops[i]) > enclosed_area(loops[best])) best = i;
  }
  return best;
}

std::optional<TorsoLevel> level_at(std::span<const Point> points, Triangles triangles, double height,
                                   const TorsoLevel* last) {
  const std::vector<SectionLoop> loops = horizontal_section(points, triangles, height);
  const std::size_t torso = find_torso(loops, last ? &last->centre : nullptr);
  if (torso == loops.size()) return std::nullopt;
  const TorsoLevel level{height, tape_measure(loops[torso]), centre_of(loops[torso]), breadth(loops[torso])};
  if (last && !(std::abs(level.girth - last->girth) <= jump * last->girth)) return std::nullopt;
  return level;
}

/// How much broader the last level is than the one so many steps below it [-].
double broader(std::span<const TorsoLevel> levels, std::size_t steps) {
  return levels.size() > steps ? levels.back().breadth / levels[levels.size() - 1 - steps].breadth - 1 : 0;
}

/// Takes off the uppermost levels that arms are in, if the last step has reached them.
bool cut_off_arms(std::vector<TorsoLevel>& levels) {
  if (broader(levels, 1) <= arm_step && broader(levels, 4) <= arm_four_steps) return false;
  do levels.pop_back();
  while (broader(levels, 1) > arm_begins);
  return true;
}

bool lies_between(const TorsoLevel& level, double low, double high) {
  return level.height >= low && level.height <= high;
}

}  // namespace

std::vector<TorsoLevel> torso_levels(std::span<const Point> points, Triangles triangles) {
  const auto [low, high] = range_of_y(points, triangles);
  const double tall = high - low;
  if (!(tall >= least && tall <= largest_value)) return {};
  std::vector<TorsoLevel> levels;
  const auto follow = [&, low = low](int thousandths) {
    const auto next = level_at(points, triangles, low + thousandths / 1000.0 * tall,
                               levels.empty() ? nullptr : &levels.back());
    if (next) levels.push_back(*next);
    return next.has_value();
  };
  for (int i = seed; i >= lowest && follow(i); i -= step_length) {
  }
  if (levels.empty()) return {};
  std::reverse(levels.begin(), levels.end());
  for (int i = seed + step_length; i <= highest && follow(i); i += step_length)
    if (cut_off_arms(levels)) break;
  const double slack = step_length / 2000.0;
  if (levels.front().height > low + (waist_low + slack) * tall ||
      levels.back().height < low + (waist_high - slack) * tall)
    return {};
  return levels;
}

std::optional<TorsoHeights> torso_heights(std::span<const TorsoLevel> levels, double low, double high) {
  if (levels.empty()) return std::nullopt;
  const double tall = high - low;
  TorsoLevel waist, chest, hip;
  for (const TorsoLevel& level : levels)
    if (lies_between(level, low + waist_low * tall, low + waist_high * tall) &&
        (waist.girth == 0 || level.girth < waist.girth))
      waist = level;
  for (const TorsoLevel& level : levels) {
    if (level.height <= waist.height && level.girth > hip.girth) hip = level;
    if (lies_between(level, waist.height, low + chest_high * tall) && level.girth > chest.girth)
      chest = level;
  }
  return TorsoHeights{chest.height, waist.height, hip.height};
}

std::optional<TorsoSection> torso_section(std::span<const Point> points, Triangles triangles,
                                          std::span<const TorsoLevel> levels, double height) {
  std::vector<SectionLoop> loops = horizontal_section(points, triangles, height);
  const TorsoLevel* nearest = nullptr;
  for (const TorsoLevel& level : levels)
    if (!nearest || std::abs(level.height - height) < std::abs(nearest->height - height)) nearest = &level;
  const std::size_t torso = find_torso(loops, nearest ? &nearest->centre : nullptr);
  if (torso == loops.size()) return std::nullopt;
  TorsoSection section{std::move(loops[torso]), {}};
  loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(torso));
  section.others = std::move(loops);
  return section;
}

}  // namespace furrow::geometry
