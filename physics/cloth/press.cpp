// SPDX-License-Identifier: MIT
#include "physics/cloth/press.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace furrow::physics {

int press(Cloth& cloth, std::span<const int> patch, double factor) {
  if (!(factor > 0) || !std::isfinite(factor)) {
    throw std::invalid_argument("press: factor = " + std::to_string(factor) + " is not > 0");
  }
  std::vector<char> inside(cloth.particles.size());
  for (const int i : patch) {
    if (i < 0 || std::size_t(i) >= inside.size()) {
      throw std::invalid_argument("press: no particle " + std::to_string(i) + " among " +
                                  std::to_string(inside.size()));
    }
    inside[i] = 1;
  }
  int pressed = 0;
  for (Hinge& h : cloth.hinges) {
    if (!inside[h.vertices[0]] || !inside[h.vertices[1]]) continue;
    h.stiffness *= factor;
    ++pressed;
  }
  return pressed;
}

}  // namespace furrow::physics
