// SPDX-License-Identifier: MIT
#include "physics/packed/packed_elements.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "physics/cloth/hinge_forces.h"
#include "physics/cloth/membrane.h"
#include "physics/cloth/tension_forces.h"

namespace furrow::physics {
namespace {

void check_corners(const MembraneTriangle& t, std::size_t n) {
  for (int i = 0; i < 3; ++i) {
    const int v = t.vertices[i];
    if (v < 0 || std::size_t(v) >= n || v == t.vertices[(i + 1) % 3]) {
      throw std::invalid_argument("membrane triangle: names particle " + std::to_string(v) + " of " +
                                  std::to_string(n) + ", or one twice");
    }
  }
}

/// The elements with places for vertices, sorted by the least.
template <typename Element>
std::vector<Element> renumbered(std::vector<Element> elements, const std::vector<int>& place) {
  for (Element& e : elements)
    for (int& v : e.vertices) v = place[std::size_t(v)];
  const auto least = [](const Element& e) { return *std::min_element(e.vertices.begin(), e.vertices.end()); };
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

/// A Tension whose ends are in an array, as those of the other kinds.
struct PlacedTension {
  std::array<int, 2> vertices;
  Tension law;
};

std::vector<PlacedTension> with_vertices(const std::vector<Tension>& tension) {
  std::vector<PlacedTension> result;
  for (const Tension& t : tension) result.push_back({{t.a, t.b}, t});
  return result;
}

void put(const PlacedTension& t, int lane, PackedElements::FourTensions& four) {
  for (int i = 0; i < 2; ++i) four.end[i][lane] = t.vertices[i];
  four.rest_length[lane] = t.law.rest_length;
  four.stretch[lane] = t.law.stretch;
  four.compress[lane] = t.law.compress;
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

void check_elements(const Cloth& cloth) {
  for (const MembraneTriangle& t : cloth.membrane) {
    check_corners(t, cloth.particles.size());
    membrane_constants(t);
  }
  for (const Tension& t : cloth.tension) check(t, cloth.particles.size());
  for (const Hinge& h : cloth.hinges) check(h, cloth.particles.size());
}

PackedElements pack_elements(const Cloth& cloth, const std::vector<int>& place) {
  const auto triangles = renumbered(cloth.membrane, place);
  const auto tensions = renumbered(with_vertices(cloth.tension), place);
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
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) slots[3 * i + c] = triangles[i].vertices[c];
  for (std::size_t i = 0; i < tensions.size(); ++i)
    for (std::size_t c = 0; c < 2; ++c) slots[first_tension + 2 * i + c] = tensions[i].vertices[c];
  for (std::size_t i = 0; i < hinges.size(); ++i)
    for (std::size_t c = 0; c < 4; ++c) slots[first_hinge + 4 * i + c] = hinges[i].vertices[c];
  packed.slot.resize(slots.size());
  plan_gathering(slots, place.size(), packed);
  return packed;
}

}  // namespace furrow::physics
