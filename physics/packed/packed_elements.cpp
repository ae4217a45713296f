// SPDX-License-Identifier: MIT
#include "physics/packed/packed_elements.h"

#include <algorithm>

#include "physics/cloth/kinds.h"

namespace furrow::physics {
namespace {

/// The elements with places for vertices, sorted by the least.
template <typename Element>
std::vector<Element> renumbered(std::vector<Element> elements, const std::vector<int>& place) {
  for (Element& e : elements) renumber(e, place);
  const auto least = [](const Element& e) { return std::ranges::min(vertices(e)); };
  std::stable_sort(elements.begin(), elements.end(),
                   [&](const Element& e, const Element& f) { return least(e) < least(f); });
  return elements;
}

void put(const MembraneTriangle& t, int lane, PackedElements::FourTriangles& four) {
  const MembraneConstants c = membrane_constants(t);
  for (int i = 0; i < 3; ++i) {
    four.corner[i][lane] = t.vertices[i];
    four.length2[i][lane] = c.length2[i];
    four.quadratic[i][lane] = c.quadratic(i, i);
    four.quadratic[3 + i][lane] = c.quadratic((i + 1) % 3, (i + 2) % 3);
  }
}

void put(const Tension& t, int lane, PackedElements::FourTensions& four) {
  four.end[0][lane] = t.a, four.end[1][lane] = t.b;
  four.rest_length[lane] = t.rest_length;
  four.stretch[lane] = t.stretch;
  four.compress[lane] = t.compress;
}

void put(const Hinge& h, int lane, PackedElements::FourHinges& four) {
  for (int i = 0; i < 4; ++i) four.vertex[i][lane] = h.vertices[i];
  four.rest_angle[lane] = h.rest_angle;
  four.stiffness[lane] = h.stiffness;
}

template <typename Four, typename Element>
std::vector<Four> by_fours(const std::vector<Element>& elements) {
  std::vector<Four> fours((elements.size() + 3) / 4);
  for (std::size_t i = 0; i < 4 * fours.size(); ++i) {
    put(elements[std::min(i, elements.size() - 1)], int(i % 4), fours[i / 4]);
  }
  return fours;
}

/// For each place the slots that belong to it, in order. slots: the place of each, -1 of nobody's.
void plan_gathering(const std::vector<int>& slots, std::size_t places, PackedElements& packed) {
  packed.gather_begin.assign(places + 1, 0);
  for (const int p : slots)
    if (p >= 0) ++packed.gather_begin[std::size_t(p) + 1];
  for (std::size_t i = 0; i < places; ++i) packed.gather_begin[i + 1] += packed.gather_begin[i];
  std::vector<int> next = packed.gather_begin;
  packed.gather.resize(std::size_t(packed.gather_begin.back()));
  for (std::size_t s = 0; s < slots.size(); ++s)
    if (slots[s] >= 0) packed.gather[std::size_t(next[std::size_t(slots[s])]++)] = int(s);
}

}  // namespace

PackedElements pack_elements(const Cloth& cloth, const std::vector<int>& place) {
  const auto triangles = renumbered(cloth.membrane, place);
  const auto tensions = renumbered(cloth.tension, place);
  const auto hinges = renumbered(cloth.hinges, place);
  PackedElements packed;
  packed.law = cloth.hinge_law;
  packed.triangle_count = int(triangles.size());
  packed.tension_count = int(tensions.size());
  packed.hinge_count = int(hinges.size());
  if (triangles.empty() && tensions.empty() && hinges.empty()) return packed;
  packed.triangles = by_fours<PackedElements::FourTriangles>(triangles);
  packed.tensions = by_fours<PackedElements::FourTensions>(tensions);
  packed.hinges = by_fours<PackedElements::FourHinges>(hinges);
  const std::size_t first_tension = 12 * packed.triangles.size(),
                    first_hinge = first_tension + 8 * packed.tensions.size();
  std::vector<int> slots(first_hinge + 16 * packed.hinges.size(), -1);
  const auto own_slots = [&](const auto& elements, std::size_t first) {
    for (const auto& e : elements)
      for (const int v : vertices(e)) slots[first++] = v;
  };
  own_slots(triangles, 0);
  own_slots(tensions, first_tension);
  own_slots(hinges, first_hinge);
  packed.slot.resize(slots.size());
  plan_gathering(slots, place.size(), packed);
  return packed;
}

}  // namespace furrow::physics
