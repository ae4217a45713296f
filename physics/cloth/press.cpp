// SPDX-License-Identifier: MIT
#include "physics/cloth/press.h"

#include <vector>

#include "physics/base/require.h"

namespace furrow::physics {

int press(Cloth& cloth, std::span<const int> patch, double factor) {
  require("press", "factor", factor, factor > 0, "> 0");
  std::vector<char> inside(cloth.particles.size());
  for (const int i : patch) {
    if (i < 0 || std::size_t(i) >= inside.size())
      refuse("press", "no particle ", i, " among ", inside.size());
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
