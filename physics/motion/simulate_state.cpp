// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "physics/cloth/kinds.h"
#include "physics/motion/compensation.h"
#include "physics/motion/simulate.h"

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
  if (!s.planned) return;
  require(s.steps_left >= 0, "steps_left = ", s.steps_left, " is not >= 0");
  require(s.steps_left == 0 || (s.dt > 0 && std::isfinite(s.dt)), "dt = ", s.dt, " is not > 0");
  require(s.steps_left > 0 || s.time >= s.end, "no steps left at ", s.time, " s, before the end at ", s.end,
          " s");
  const double rest = double(s.steps_left) * s.dt;
  require(s.steps_left == 0 || std::abs(s.time + rest - s.end) <= 1e-6 * std::max(s.end, s.dt), s.steps_left,
          " steps of ", s.dt, " s do not lead from ", s.time, " s to ", s.end, " s");
  require(s.dt_limit >= 0, "dt_limit = ", s.dt_limit, " is not >= 0");
  require(s.contact.empty() || s.contact.size() == particles, "of a cloth with ", s.contact.size(),
          " particles instead of ", particles);
  const StepMemory& steps = s.steps;
  for (const std::size_t n : {steps.anchors.size(), steps.acceleration.size()})
    require(n == 0 || n == particles, "what steps remember is of ", n, " particles instead of ", particles);
  require(steps.contact_stiffness >= 0 && std::isfinite(steps.contact_stiffness),
          "contact_stiffness = ", steps.contact_stiffness, " is not >= 0");
  require(steps.self.stiffness >= 0 && std::isfinite(steps.self.stiffness),
          "self.stiffness = ", steps.self.stiffness, " is not >= 0");
  for (const PairMemory& p : steps.self.pairs)
    require(p.range >= 0 && p.target >= p.range && std::isfinite(p.target), "a pair's range is not one");
  for (const PairFrictionMemory& f : steps.self.friction)
    require(f.tether.allFinite(), "a pair's friction is not finite");
  for (const auto* pairs : {&steps.self.coupled, &steps.self.ordered_for})
    for (const auto& pair : *pairs)
      for (const int i : pair)
        require(i >= 0 && std::size_t(i) < particles, "a pair is coupled that is not there");
  for (const ContactAnchor& a : steps.anchors)
    require(a.anchor.allFinite() && a.plane.allFinite() && std::isfinite(a.limit) && a.nearer >= 0 &&
                std::isfinite(a.nearer),
            "an anchor is not finite");
  for (const Vec3& a : steps.acceleration) require(a.allFinite(), "an acceleration is not finite");
  for (const ContactMemory& known : s.contact) require(known.x.allFinite(), "a contact is not finite");
}

}  // namespace furrow::physics
