// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/arrays/place_noise.h"

#include <cmath>
#include <numbers>

namespace furrow::bridge {
namespace {

using physics::Vec3;

constexpr int noise_waves = 64;
constexpr double longest_share = 1.0 / 5, shortest_share = 1.0 / 40;  // of the diagonal

/// SplitMix64 (Steele, Lea and Flood 2014): bits that belong to a number.
std::uint64_t scrambled(std::uint64_t n) {
  n += 0x9e3779b97f4a7c15;
  n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9;
  n = (n ^ (n >> 27)) * 0x94d049bb133111eb;
  return n ^ (n >> 31);
}

/// The k-th number of a seed's wave, in [0, 1).
double hashed(std::uint64_t seed, int wave, int k) {
  return double(scrambled(scrambled(seed) ^ std::uint64_t(4 * wave + k)) >> 11) * 0x1p-53;
}

}  // namespace

PlaceNoise::PlaceNoise(const std::vector<Vec3>& positions, std::uint64_t seed) {
  if (positions.empty()) return;
  Vec3 high = corner_ = positions[0];
  for (const Vec3& x : positions) corner_ = corner_.cwiseMin(x), high = high.cwiseMax(x);
  diagonal_ = (high - corner_).norm();
  if (!(diagonal_ > 0)) return;
  constexpr double turn = 2 * std::numbers::pi;
  for (int i = 0; i < noise_waves; ++i) {
    const double z = 2 * hashed(seed, i, 0) - 1, azimuth = turn * hashed(seed, i, 1),
                 r = std::sqrt(1 - z * z);
    const double place = (i + hashed(seed, i, 2)) / noise_waves;
    const double length = diagonal_ * shortest_share * std::pow(longest_share / shortest_share, place);
    waves_.push_back(
        {turn / length * Vec3(r * std::cos(azimuth), r * std::sin(azimuth), z), turn * hashed(seed, i, 3)});
  }
}

double PlaceNoise::operator()(const Vec3& x) const {
  double sum = 0;
  for (const Wave& w : waves_) sum += std::cos(w.k.dot(x - corner_) + w.phase);
  return sum * std::sqrt(2.0 / noise_waves);
}

}  // namespace furrow::bridge
