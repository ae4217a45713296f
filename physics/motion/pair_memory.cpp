// SPDX-License-Identifier: MIT
#include "physics/motion/pair_memory.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "physics/motion/state_memory.h"

namespace furrow::physics {
namespace {

/// Which numbers a mesh's triangles and edges have, by their vertices.
class PairNumbers {
 public:
  explicit PairNumbers(const PairMesh& mesh) : mesh_(mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) triangles_.push_back({mesh.triangles[i], int(i)});
    std::sort(triangles_.begin(), triangles_.end());
  }
  /// None if the mesh has no such triangle, or no such edge.
  std::optional<PairKey> key(bool edges, const std::array<int, 4>& v) const {
    if (edges) {
      const auto first = edge(v[0], v[1]), second = edge(v[2], v[3]);
      return first && second ? std::optional(PairKey{1, *first, *second}) : std::nullopt;
    }
    const std::array<int, 3> corners{v[1], v[2], v[3]};
    const auto at = std::lower_bound(triangles_.begin(), triangles_.end(), std::pair(corners, 0));
    if (at == triangles_.end() || at->first != corners) return std::nullopt;
    return PairKey{0, v[0], at->second};
  }

 private:
  std::optional<int> edge(int a, int b) const {
    const std::array<int, 2> ends{std::min(a, b), std::max(a, b)};
    const auto at = std::lower_bound(mesh_.edges.begin(), mesh_.edges.end(), ends);
    return at != mesh_.edges.end() && *at == ends ? std::optional(int(at - mesh_.edges.begin()))
                                                  : std::nullopt;
  }

  const PairMesh& mesh_;
  std::vector<std::pair<std::array<int, 3>, int>> triangles_;
};

/// The pairs that the mesh has, sorted; make(key, pair, way) says what each is, `way` being -1 where the two
/// edges of a pair have changed places.
template <class Of, class Pair, class Make>
std::vector<Of> with_keys(const PairNumbers& numbers, const std::vector<Pair>& pairs, const Make& make) {
  std::vector<Of> found;
  for (const Pair& p : pairs) {
    std::optional<PairKey> key = numbers.key(p.edges, p.vertices);
    if (!key) continue;
    const bool turned = p.edges && key->second < key->first;
    if (turned) std::swap(key->first, key->second);
    found.push_back(make(*key, p, turned ? -1.0 : 1.0));
  }
  std::sort(found.begin(), found.end(), [](const Of& a, const Of& b) { return a.key < b.key; });
  return found;
}

std::vector<int> places_of(std::span<const int> particle) {
  std::vector<int> place(particle.size());
  for (std::size_t i = 0; i < particle.size(); ++i) place[std::size_t(particle[i])] = int(i);
  return place;
}

}  // namespace

SelfContactMemory memory_of(const ClothContact& contact, double stiffness, std::span<const int> particle) {
  const ClothContact::Memory memory = contact.memory();
  SelfContactMemory result{stiffness, {}, memory.loose, memory.crossed_at_start, {}, {}, {}};
  const auto vertices = [&](const PairKey& key) { return vertices_of(contact.mesh(), key); };
  for (const ClothContact::SpecialPair& p : memory.special)
    result.pairs.push_back({p.key.edges == 1, vertices(p.key), p.range, p.target});
  for (const PairAnchor& a : memory.friction)
    result.friction.push_back({a.key.edges == 1, vertices(a.key), a.tether, a.slides});
  for_each_particle_number(result, [&](int& i) { i = particle[std::size_t(i)]; });
  return result;
}

SelfContactMemory by_place(SelfContactMemory known, std::span<const int> particle) {
  const std::vector<int> place = places_of(particle);
  for_each_particle_number(known, [&](int& i) { i = place.at(std::size_t(i)); });
  for (auto* couples : {&known.coupled, &known.ordered_for}) {
    for (auto& couple : *couples) std::sort(couple.begin(), couple.end(), std::greater<>());
    std::sort(couples->begin(), couples->end());
  }
  return known;
}

void recall_pairs(const SelfContactMemory& known, std::span<const int> fresh, std::span<const int> particle,
                  std::span<const Vec3> x, ClothContact& contact, ThreadPool* pool) {
  if (known.stiffness == 0) return;
  const SelfContactMemory placed = by_place(known, particle);
  const std::vector<int> place = places_of(particle);
  const PairNumbers numbers(contact.mesh());
  ClothContact::Memory memory{{}, placed.loose, placed.crossed_at_start, {}, {}};
  using Special = ClothContact::SpecialPair;
  memory.special =
      with_keys<Special>(numbers, placed.pairs, [](const PairKey& key, const PairMemory& p, double) {
        return Special{key, p.range, p.target};
      });
  memory.friction = with_keys<PairAnchor>(numbers, placed.friction,
                                          [](const PairKey& key, const PairFrictionMemory& f, double way) {
                                            return PairAnchor{key, way * f.tether, f.slides};
                                          });
  for (const int i : fresh) memory.fresh.push_back(place.at(std::size_t(i)));
  contact.recall(memory, x, pool);
}

Cloth with_free_leads(Cloth cloth, std::span<const int> led) {
  for (const int i : led) cloth.particles.inv_mass[std::size_t(i)] = 1;
  return cloth;
}

}  // namespace furrow::physics
