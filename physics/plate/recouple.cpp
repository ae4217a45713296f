// SPDX-License-Identifier: MIT
#include "physics/plate/recouple.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <tuple>

#include "physics/cloth/carried_angle.h"
#include "physics/plate/plate_bending.h"

namespace furrow::physics {
namespace {

using Lengths = std::array<double, 3>;

/// Of the triangle's edges as the membrane has them; none if it is another triangle.
std::optional<Lengths> lengths_in(const MembraneTriangle& t, const std::array<int, 3>& corners) {
  for (std::size_t turn = 0; turn < 3; ++turn) {
    Lengths lengths;
    bool same = true;
    for (std::size_t i = 0; i < 3; ++i) {
      same = same && t.vertices[(i + turn) % 3] == corners[i];
      lengths[i] = t.rest_lengths[(i + turn) % 3];
    }
    if (same) return lengths;
  }
  return std::nullopt;
}

/// Rest length of the element that joins two particles, of elements sorted by them; else `missing`.
template <class Element>
double length_between(const std::vector<Element>& sorted, int a, int b, double missing) {
  const auto key = std::minmax(a, b);
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), key, [](const Element& e, const auto& k) {
    return std::tie(e.a, e.b) < std::tie(k.first, k.second);
  });
  return at != sorted.end() && at->a == key.first && at->b == key.second ? at->rest_length : missing;
}

std::vector<Lengths> rest_lengths_now(const Cloth& cloth, std::vector<Lengths> lengths) {
  const bool has_membrane = cloth.membrane.size() == cloth.triangles.size();
  for (std::size_t t = 0; t < lengths.size(); ++t) {
    const std::array<int, 3>& corners = cloth.triangles[t];
    if (has_membrane) {
      if (const auto own = lengths_in(cloth.membrane[t], corners)) lengths[t] = *own;
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = corners[(i + 1) % 3], b = corners[(i + 2) % 3];
      lengths[t][i] =
          length_between(cloth.structural, a, b, length_between(cloth.tension, a, b, lengths[t][i]));
    }
  }
  return lengths;
}

std::vector<double> warp_now(const PlateOrigin& origin, const std::vector<Lengths>& lengths) {
  std::vector<double> warp = origin.warp;
  for (std::size_t t = 0; t < warp.size(); ++t)
    warp[t] = carried_angle(warp[t], origin.rest_lengths[t], lengths[t]);
  return warp;
}

/// All hinges of the sheet, those that stayed plain among them.
std::vector<Hinge> sheet_of(const PlateBending& plate, const std::vector<Hinge>& plain) {
  const PlateOrigin& o = *plate.origin();
  std::vector<Hinge> sheet(o.coupled.size() + o.plain.size());
  for (std::size_t i = 0; i < o.coupled.size(); ++i)
    sheet[std::size_t(o.coupled[i])] = plate.plate().hinges[i];
  for (std::size_t i = 0; i < o.plain.size(); ++i) sheet[std::size_t(o.plain[i])] = plain[i];
  return sheet;
}

}  // namespace

bool recouple(Cloth& cloth) {
  bool any = false;
  for (std::shared_ptr<const Energy>& own : cloth.energies) {
    const auto* plate = dynamic_cast<const PlateBending*>(own.get());
    if (!plate || !plate->origin() || plate->origin()->plain.size() != cloth.hinges.size()) continue;
    any = true;
    const std::vector<Hinge> sheet = sheet_of(*plate, cloth.hinges);
    PlateOrigin origin = *plate->origin();
    const std::vector<Lengths> lengths = rest_lengths_now(cloth, origin.rest_lengths);
    origin.warp = warp_now(origin, lengths);
    origin.rest_lengths = lengths;
    PlateParts parts = make_plate(
        {cloth.triangles, origin.rest_lengths, sheet, cloth.particles.inv_mass, origin.apart, origin.press},
        {origin.rigidity, origin.warp});
    if (parts.plate.stiffness.size() == plate->plate().at_rest.size())
      parts.plate.at_rest = plate->plate().at_rest;
    origin.coupled = parts.coupled;
    origin.plain = parts.plain;
    cloth.hinges.clear();
    for (const int h : parts.plain) cloth.hinges.push_back(sheet[std::size_t(h)]);
    auto record = std::make_shared<PlateOrigin>(std::move(origin));
    own = plate->joins_as(parts.plate)
              ? std::make_shared<PlateBending>(std::move(parts.plate), *plate, std::move(record))
              : std::make_shared<PlateBending>(std::move(parts.plate), cloth.particles.size(),
                                               std::move(record));
  }
  return any;
}

}  // namespace furrow::physics
