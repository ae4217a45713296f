// SPDX-License-Identifier: MIT
#include "physics/plate/press.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "physics/base/require.h"
#include "physics/plate/plate_bending.h"

namespace furrow::physics {
namespace {

/// The plate with the hinges `on` pressed.
std::shared_ptr<const PlateBending> pressed(const PlateBending& own, const std::vector<char>& on,
                                            double factor) {
  Plate plate = own.plate();
  for (std::size_t e = 0; e < plate.hinge.size(); ++e)
    if (on[std::size_t(plate.hinge[e])]) plate.share[e] *= std::sqrt(factor);
  if (!own.origin()) return std::make_shared<PlateBending>(std::move(plate), own, nullptr);
  PlateOrigin origin = *own.origin();
  for (std::size_t h = 0; h < on.size(); ++h)
    if (on[h]) origin.press[std::size_t(origin.coupled[h])] *= factor;
  return std::make_shared<PlateBending>(std::move(plate), own,
                                        std::make_shared<PlateOrigin>(std::move(origin)));
}

}  // namespace

int press_hinges(Cloth& cloth, const std::function<bool(const Hinge&)>& which, double factor) {
  require("press", "factor", factor, factor > 0, "> 0");
  int count = 0;
  for (Hinge& h : cloth.hinges) {
    if (!which(h)) continue;
    h.stiffness *= factor;
    ++count;
  }
  for (std::shared_ptr<const Energy>& energy : cloth.energies) {
    const auto* plate = dynamic_cast<const PlateBending*>(energy.get());
    if (!plate) continue;
    std::vector<char> on;
    for (const Hinge& h : plate->plate().hinges) on.push_back(which(h));
    const int of_plate = int(std::count(on.begin(), on.end(), 1));
    if (of_plate > 0) energy = pressed(*plate, on, factor);
    count += of_plate;
  }
  return count;
}

int press(Cloth& cloth, std::span<const int> patch, double factor) {
  std::vector<char> inside(cloth.particles.size());
  for (const int i : patch) {
    if (i < 0 || std::size_t(i) >= inside.size())
      refuse("press", "no particle ", i, " among ", inside.size());
    inside[std::size_t(i)] = 1;
  }
  const auto in_patch = [&](const Hinge& h) {
    return inside[std::size_t(h.vertices[0])] && inside[std::size_t(h.vertices[1])];
  };
  return press_hinges(cloth, in_patch, factor);
}

}  // namespace furrow::physics
