// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstring>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <type_traits>

#include "physics/cloth/kinds.h"
#include "physics/motion/compensation.h"
#include "physics/motion/simulate.h"
#include "physics/motion/state_memory.h"

namespace furrow::physics {
namespace {

template <typename... Parts>
void require(bool condition, const Parts&... parts) {
  if (condition) return;
  std::ostringstream text;
  text << "simulation state: ";
  (text << ... << parts);
  throw std::invalid_argument(text.str());
}

/// FNV-1a, 64 bits (RFC 9923).
class Hash {
 public:
  template <class Number>
  void add(Number number) {
    unsigned char bytes[sizeof number];
    std::memcpy(bytes, &number, sizeof number);
    for (const unsigned char byte : bytes) hash_ = (hash_ ^ byte) * 0x100000001b3;
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

/// A kind that came later counts only where there is any of it, so that older states keep their fingerprints.
template <class Element>
constexpr bool always_counted =
    std::same_as<Element, Spring> || std::same_as<Element, MembraneTriangle> || std::same_as<Element, Hinge>;

/// Fields that came later count only where they say anything, for the same reason.
template <class Element>
void add_later_fields(Hash&, const Element&) {}
void add_later_fields(Hash& hash, const MembraneTriangle& t) {
  if (!t.threads.any()) return;
  for (const double field : {t.threads.angle, t.threads.warp, t.threads.weft}) hash.add(field);
}

/// What an array has for a particle of which nothing is known.
Vec3 nothing_of(const Vec3&) { return Vec3::Zero(); }
ContactAnchor nothing_of(const ContactAnchor&) { return {}; }
ContactMemory nothing_of(const ContactMemory&) {
  return {Vec3::Zero(), std::numeric_limits<double>::quiet_NaN()};
}

void check_memory(const SimulateState& s, std::size_t particles) {
  for_each_particle_array(s, [&](const char* what, const auto& array, Carried) {
    require(array.empty() || array.size() == particles, array.size(), " ", what, " for ", particles,
            " particles");
  });
  const StepMemory& steps = s.steps;
  const auto is_there = [&](int i) {
    require(i >= 0 && std::size_t(i) < particles, "it names particle ", i, " of ", particles);
  };
  for_each_particle_number(steps.self, is_there);
  for (const int i : steps.fresh) is_there(i);
  require(steps.contact_stiffness >= 0 && std::isfinite(steps.contact_stiffness),
          "contact_stiffness = ", steps.contact_stiffness, " is not >= 0");
  require(steps.self.stiffness >= 0 && std::isfinite(steps.self.stiffness),
          "self.stiffness = ", steps.self.stiffness, " is not >= 0");
  for (const PairMemory& p : steps.self.pairs)
    require(p.range >= 0 && p.target >= p.range && std::isfinite(p.target), "a pair's range is not one");
  for (const PairFrictionMemory& f : steps.self.friction)
    require(f.tether.allFinite(), "a pair's friction is not finite");
  for (const ContactAnchor& a : steps.anchors)
    require(a.anchor.allFinite() && a.plane.allFinite() && std::isfinite(a.limit) && a.nearer >= 0 &&
                std::isfinite(a.nearer),
            "an anchor is not finite");
  for (const Vec3& a : steps.acceleration) require(a.allFinite(), "an acceleration is not finite");
  for (const ContactMemory& known : s.contact) require(known.x.allFinite(), "a contact is not finite");
}

}  // namespace

std::uint64_t fingerprint(const Cloth& cloth) {
  Hash hash;
  for (const double inv_mass : cloth.particles.inv_mass) hash.add(inv_mass);
  for_each_kind(cloth, [&](const auto& kind, auto... law) {
    if (!kind.empty() || always_counted<KindOf<decltype(kind)>>) hash.add(kind.size());
    (hash.add(int(law)), ...);
    for (const auto& e : kind) {
      std::apply([&](auto... field) { (hash.add(field), ...); }, fields(e));
      add_later_fields(hash, e);
    }
  });
  if (!cloth.energies.empty()) hash.add(cloth.energies.size());  // what they are nobody knows
  return hash.value();
}

void check(const SimulateState& s, std::size_t particles) {
  require(s.time >= 0 && std::isfinite(s.time), "time = ", s.time, " is not >= 0");
  require(s.step >= 0, "step = ", s.step, " is not >= 0");
  require(s.body_travel >= 0 && std::isfinite(s.body_travel), "body_travel = ", s.body_travel,
          " is not >= 0");
  check(s.compensation, particles);
  for (const Vec3& home : s.homes) require(home.allFinite(), "a pin's home is not finite");
  check_memory(s, particles);
  if (!s.planned) return;
  require(s.steps_left >= 0, "steps_left = ", s.steps_left, " is not >= 0");
  require(s.steps_left == 0 || (s.dt > 0 && std::isfinite(s.dt)), "dt = ", s.dt, " is not > 0");
  require(s.steps_left > 0 || s.time >= s.end, "no steps left at ", s.time, " s, before the end at ", s.end,
          " s");
  const double rest = double(s.steps_left) * s.dt;
  require(s.steps_left == 0 || std::abs(s.time + rest - s.end) <= 1e-6 * std::max(s.end, s.dt), s.steps_left,
          " steps of ", s.dt, " s do not lead from ", s.time, " s to ", s.end, " s");
  require(s.dt_limit >= 0, "dt_limit = ", s.dt_limit, " is not >= 0");
}

void carry_memory(const Cloth& before, const Cloth& after, SimulateState& state) {
  const std::size_t old = before.particles.size(), all = after.particles.size();
  require(all >= old, all, " particles after, but ", old, " before");
  check_memory(state, old);
  std::vector<char> begins(all, 1);
  for (const int i : state.steps.fresh) begins[std::size_t(i)] = 2;  // it has not begun yet
  for (std::size_t i = 0; i < old; ++i)
    if (begins[i] == 1) begins[i] = char(before.particles.x[i] != after.particles.x[i]);
  for_each_particle_array(state, [&](const char*, auto& array, Carried carried) {
    using Entry = typename std::remove_cvref_t<decltype(array)>::value_type;
    if (carried == Carried::never) array.clear();
    if (array.empty()) return;
    array.resize(all, nothing_of(Entry{}));
    for (std::size_t i = 0; i < old; ++i)
      if (carried == Carried::in_place && begins[i]) array[i] = nothing_of(Entry{});
  });
  SelfContactMemory& self = state.steps.self;
  self.coupled.clear();
  self.ordered_for.clear();
  const auto is_gone = [&](const auto& pair) {
    return std::ranges::any_of(pair.vertices, [&](int i) { return begins[std::size_t(i)] != 0; });
  };
  std::erase_if(self.pairs, is_gone);
  std::erase_if(self.friction, is_gone);
  state.steps.fresh.clear();
  for (std::size_t i = 0; i < all; ++i)
    if (begins[i]) state.steps.fresh.push_back(int(i));
}
}  // namespace furrow::physics
