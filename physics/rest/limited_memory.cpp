// SPDX-License-Identifier: MIT
#include "physics/rest/limited_memory.h"

#include <cmath>

#include "physics/base/require.h"
#include "physics/base/vector_sums.h"

namespace furrow::physics {

LimitedMemory::LimitedMemory(Base base, int pairs) : base_(std::move(base)), most_(std::size_t(pairs)) {
  if (pairs < 0) refuse("LimitedMemory", "pairs = ", pairs, " is not >= 0");
}

bool LimitedMemory::add(std::vector<Vec3> s, std::vector<Vec3> y) {
  if (s.size() != y.size() || (!pairs_.empty() && s.size() != pairs_.front().s.size()))
    refuse("LimitedMemory", "a step of ", s.size(), " particles with forces of ", y.size());
  const double curvature = dot(s, y);
  if (!(curvature > 1e-12 * std::sqrt(dot(s, s) * dot(y, y))) || most_ == 0) return false;
  if (pairs_.size() == most_) pairs_.pop_front();
  pairs_.push_back({std::move(s), std::move(y), 1 / curvature});
  return true;
}

void LimitedMemory::apply(std::span<Vec3> f) const {
  std::vector<double> along(pairs_.size());
  for (std::size_t i = pairs_.size(); i-- > 0;) {
    along[i] = pairs_[i].inverse * dot(pairs_[i].s, f);
    add_multiple(f, -along[i], pairs_[i].y);
  }
  base_(f);
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    add_multiple(f, along[i] - pairs_[i].inverse * dot(pairs_[i].y, f), pairs_[i].s);
}

}  // namespace furrow::physics
