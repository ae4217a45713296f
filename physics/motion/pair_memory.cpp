// SPDX-License-Identifier: MIT
#include "physics/motion/pair_memory.h"

namespace furrow::physics {

SelfContactMemory memory_of(const ClothContact& contact, double stiffness) {
  const ClothContact::Memory memory = contact.memory();
  SelfContactMemory result{stiffness, {}, memory.loose, memory.crossed_at_start, {}, {}, {}};
  for (const ClothContact::SpecialPair& p : memory.special)
    result.pairs.push_back({p.key.edges == 1, p.key.first, p.key.second, p.range, p.target});
  for (const PairAnchor& a : memory.friction)
    result.friction.push_back({a.key.edges == 1, a.key.first, a.key.second, a.tether, a.slides});
  return result;
}

void recall_pairs(const SelfContactMemory& known, std::span<const Vec3> x, ClothContact& contact,
                  ThreadPool* pool) {
  if (known.stiffness == 0) return;
  ClothContact::Memory memory{{}, known.loose, known.crossed_at_start, {}};
  for (const PairMemory& p : known.pairs)
    memory.special.push_back({{std::uint8_t(p.edges), p.first, p.second}, p.range, p.target});
  for (const PairFrictionMemory& f : known.friction)
    memory.friction.push_back({{std::uint8_t(f.edges), f.first, f.second}, f.tether, f.slides});
  contact.recall(memory, x, pool);
}

Cloth with_free_leads(Cloth cloth, std::span<const int> led) {
  for (const int i : led) cloth.particles.inv_mass[std::size_t(i)] = 1;
  return cloth;
}

}  // namespace furrow::physics
