// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <tuple>
#include <type_traits>

#include "geometry/mesh/attribute_register.h"

namespace furrow::geometry {

/// A tuple of one Slot<A>(attribute) for each attribute of the register whose key is one of `Keys`.
template <template <class> class Slot, class... Keys>
auto make_slots() {
  const auto slot = []<class A>(const A& attribute) {
    if constexpr ((std::is_same_v<typename A::Key, Keys> || ...))
      return std::tuple<Slot<A>>(Slot<A>(attribute));
    else
      return std::tuple<>();
  };
  return std::apply([&](const auto&... a) { return std::tuple_cat(slot(a)...); }, attribute_register);
}

/// Something for each attribute of the register that vertices, edges, halfedges or faces have, in its order.
template <template <class> class Slot, class... Keys>
class AttributeSlots {
 public:
  template <class Visit>
  void for_each(Visit&& visit) {
    std::apply([&](auto&... slot) { (visit(slot), ...); }, slots_);
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    std::apply([&](const auto&... slot) { (visit(slot), ...); }, slots_);
  }

 private:
  decltype(make_slots<Slot, Keys...>()) slots_ = make_slots<Slot, Keys...>();
};

/// An attribute's maps of a mesh before and after an operation; of one mesh, twice the same.
template <class A>
struct MapSlot {
  explicit MapSlot(const A& a) : attribute(a) {}
  using Handle = std::optional<Map<typename A::Key, typename A::Value>>;
  const A& attribute;
  Handle before, after;
};

/// Handles of the registered maps that a mesh has.
template <class... Keys>
class AttributeMaps {
 public:
  explicit AttributeMaps(const Mesh& mesh) : AttributeMaps(mesh, mesh) {}
  AttributeMaps(const Mesh& before, const Mesh& after) {
    slots_.for_each([&](auto& slot) {
      slot.before = find_map(before, slot.attribute);
      slot.after = find_map(after, slot.attribute);
    });
  }
  /// visit(attribute, map before, map after) for each attribute that both have.
  template <class Visit>
  void for_each(Visit&& visit) const {
    slots_.for_each([&](const auto& slot) {
      if (slot.before && slot.after) visit(slot.attribute, *slot.before, *slot.after);
    });
  }

 private:
  AttributeSlots<MapSlot, Keys...> slots_;
};

}  // namespace furrow::geometry
