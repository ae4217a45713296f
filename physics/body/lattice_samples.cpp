// SPDX-License-Identifier: MIT
#include "physics/body/lattice_samples.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace furrow::physics {
namespace {

std::uint64_t key_of(const LatticePoint& p) {
  return static_cast<std::uint64_t>(p[0]) | static_cast<std::uint64_t>(p[1]) << 21 |
         static_cast<std::uint64_t>(p[2]) << 42;
}

std::uint64_t scramble(std::uint64_t key) {
  key *= 0x9e3779b97f4a7c15ull;
  return key ^ (key >> 32);
}

}  // namespace

LatticeSamples::LatticeSamples(const ExactDistance& exact, const Vec3& low, double unit, int threads)
    : exact_(exact), low_(low), unit_(unit), pool_(threads), slots_(1 << 16) {}

std::size_t LatticeSamples::slot_of(std::uint64_t key) const {
  std::size_t slot = scramble(key) & (slots_.size() - 1);
  while (slots_[slot].next_index != 0 && slots_[slot].key != key) slot = (slot + 1) & (slots_.size() - 1);
  return slot;
}

void LatticeSamples::grow() {
  slots_.assign(2 * slots_.size(), {});
  for (int i = 0; i < size(); ++i) {
    const std::uint64_t key = key_of(points_[i]);
    slots_[slot_of(key)] = {key, i + 1};
  }
}

void LatticeSamples::expect(const LatticePoint& p) const {
#if defined(__GNUC__)
  __builtin_prefetch(&slots_[scramble(key_of(p)) & (slots_.size() - 1)]);
#else
  (void)p;
#endif
}

int LatticeSamples::add(const LatticePoint& p, int guess) {
  const std::uint64_t key = key_of(p);
  const std::size_t slot = slot_of(key);
  if (slots_[slot].next_index != 0) return slots_[slot].next_index - 1;
  samples_.push_back({0, 0});
  points_.push_back(p);
  guesses_.push_back(guess);
  slots_[slot] = {key, size()};
  if (3 * samples_.size() > 2 * slots_.size()) grow();
  return size() - 1;
}

/// The points a step up the lattice around p, at +-half its own step in each odd coordinate, are the corners
/// of the cells that p was added for. Where the balls that the surface leaves free around p and around one of
/// them meet, nothing lies between the two.
std::optional<bool> LatticeSamples::inside_by_corners(const LatticePoint& p, double distance) const {
  const int all = p[0] | p[1] | p[2], step = all & -all;
  double far2 = 0;
  for (int k = 0; k < 3; ++k) far2 += p[k] & step ? 1 : 0;
  const double away = unit_ * step * std::sqrt(far2);
  for (int corner = 0; corner < 8; ++corner) {
    LatticePoint c = p;
    bool twice = false;  // in an even coordinate there is no other side
    for (int k = 0; k < 3; ++k) {
      const bool up = corner >> k & 1;
      if (p[k] & step)
        c[k] += up ? step : -step;
      else
        twice = twice || up;
    }
    if (twice) continue;
    const int index = slots_[slot_of(key_of(c))].next_index - 1;
    if (index < 0 || index >= evaluated_) continue;
    const double value = samples_[index].value;
    if (away < (distance + std::abs(value)) * (1 - 1e-9)) return value < 0;
  }
  return std::nullopt;
}

void LatticeSamples::evaluate_range(int begin, int end) {
  LatticePoint p;
  const std::function<std::optional<bool>(double)> beside = [&](double d) { return inside_by_corners(p, d); };
  for (int i = begin; i < end; ++i) {
    p = points_[i];
    const int guess = guesses_[i];
    samples_[i] = guess < evaluated_
                      ? exact_.sample(position(p), position(points_[guess]), samples_[guess], beside)
                      : exact_.sample(position(p));
  }
}

void LatticeSamples::evaluate(const std::function<void(double)>& tell) {
  constexpr int block = 512;
  const int first = evaluated_, count = size() - first;
  std::atomic<bool> stop = false;  // the others' work is in vain once `tell` threw
  const auto work = [&](int i, int thread) {
    if (stop) return;
    const int end = std::min(first + (i + 1) * block, size());
    evaluate_range(first + i * block, end);
    if (thread > 0 || !tell) return;
    try {
      tell(double(end - first) / count);
    } catch (...) {
      stop = true;
      throw;
    }
  };
  const int blocks = (count + block - 1) / block;
  if (blocks > 1)
    pool_.share(blocks, work);
  else if (blocks == 1)
    work(0, 0);
  evaluated_ = size();
}

}  // namespace furrow::physics
