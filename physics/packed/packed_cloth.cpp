// SPDX-License-Identifier: MIT
#include "physics/packed/packed_cloth.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "physics/base/require.h"
#include "physics/cloth/check_cloth.h"
#include "physics/cloth/cloth.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/kinds.h"

namespace furrow::physics {
namespace {

std::vector<int> places(const std::vector<int>& particle) {
  std::vector<int> place(particle.size());
  for (std::size_t i = 0; i < particle.size(); ++i) place[std::size_t(particle[i])] = int(i);
  return place;
}

struct PackedSpring {
  int a, b;
  double k, kL, damping_k;
};

/// One for each edge of kinds that have an edge_stiffness(), sorted; damping_k: its sum.
std::vector<PackedSpring> element_dashpots(const Cloth& cloth, const std::vector<int>& place) {
  std::map<std::pair<int, int>, double> edges;
  for_each_kind(cloth, [&](const auto& kind, auto...) {
    if constexpr (requires { edge_stiffness(kind[0]); }) {
      for (const auto& e : kind) {
        const auto ends = physics::edges(e);
        const auto stiffness = edge_stiffness(e);
        for (std::size_t i = 0; i < ends.size(); ++i)
          edges[std::minmax(place[std::size_t(ends[i].a)], place[std::size_t(ends[i].b)])] += stiffness[i];
      }
    }
  });
  std::vector<PackedSpring> dashpots;
  for (const auto& [edge, k] : edges) dashpots.push_back({edge.first, edge.second, 0, 0, k});
  return dashpots;
}

/// All springs with their ends as places, sorted by (a, b), structural before bending before dashpots.
std::vector<PackedSpring> renumbered_springs(const Cloth& cloth, const std::vector<int>& place,
                                             const std::vector<PackedSpring>& dashpots) {
  std::vector<PackedSpring> springs;
  for (const auto* kind : {&cloth.structural, &cloth.bending}) {
    for (const Spring& s : *kind) {
      const auto [a, b] = std::minmax(place[std::size_t(s.a)], place[std::size_t(s.b)]);
      springs.push_back({a, b, s.stiffness, s.stiffness * s.rest_length, s.stiffness});
    }
  }
  springs.insert(springs.end(), dashpots.begin(), dashpots.end());
  std::stable_sort(springs.begin(), springs.end(), [](const PackedSpring& s, const PackedSpring& t) {
    return std::tie(s.a, s.b) < std::tie(t.a, t.b);
  });
  return springs;
}

void pack_springs(const std::vector<PackedSpring>& springs, PackedCloth& packed) {
  std::vector<std::array<int, 2>> pairs;
  for (const PackedSpring& s : springs) pairs.push_back({s.a, s.b});
  packed.sweep = sweep_order(packed.particles(), pairs);
  for (const int p : packed.sweep.pairs) {
    const PackedSpring& s = springs[std::size_t(p)];
    packed.a.push_back(s.a);
    packed.b.push_back(s.b);
    packed.k.push_back(s.k);
    packed.kL.push_back(s.kL);
    packed.damping_k.push_back(s.damping_k);
  }
  packed.sweep.pairs.clear();
  packed.inv_length2.assign(springs.size(), 0.0);
}

/// An energy of the cloth's particles, asked by places.
class PlacedEnergy : public Energy {
 public:
  PlacedEnergy(std::shared_ptr<const Energy> own, const std::vector<int>& particle,
               const std::vector<int>& place)
      : own_(std::move(own)), particle_(particle), place_(place) {}

  double energy(std::span<const Vec3> x) const override { return own_->energy(by_particle(x)); }
  void add_forces(std::span<const Vec3> x, std::span<Vec3> force) const override {
    std::vector<Vec3> sum(x.size(), Vec3::Zero());
    own_->add_forces(by_particle(x), sum);
    for (std::size_t i = 0; i < sum.size(); ++i) force[i] += sum[std::size_t(particle_[i])];
  }
  bool add_stiffness(std::span<const Vec3> x, Stiffness part, const BlockSink& sink) const override {
    return own_->add_stiffness(by_particle(x), part, [&](int i, int j, const Mat3& block) {
      if (i < 0 || j < 0 || std::size_t(std::max(i, j)) >= place_.size())
        refuse("cloth", "an energy names particles ", i, " and ", j, " of ", place_.size());
      sink(place_[std::size_t(i)], place_[std::size_t(j)], block);
    });
  }

 private:
  std::vector<Vec3> by_particle(std::span<const Vec3> x) const {
    std::vector<Vec3> y(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) y[std::size_t(particle_[i])] = x[i];
    return y;
  }

  std::shared_ptr<const Energy> own_;
  std::vector<int> particle_, place_;
};

Cloth renumbered_shell(const Cloth& cloth, const std::vector<int>& particle, const std::vector<int>& place) {
  Cloth shell = cloth;
  shell.particles = {};
  for (auto& triangle : shell.triangles)
    for (int& v : triangle) v = place[std::size_t(v)];
  for_each_kind(shell, [&](auto& kind, auto...) {
    if constexpr (std::same_as<KindOf<decltype(kind)>, Spring>)
      kind.clear();
    else
      for (auto& e : kind) renumber(e, place);
  });
  for (auto& own : shell.energies) own = std::make_shared<PlacedEnergy>(own, particle, place);
  return shell;
}

/// Which particles act on each other: those that follow each other in an element, around.
std::vector<std::array<int, 2>> neighbour_pairs(const Cloth& cloth) {
  std::vector<std::array<int, 2>> pairs;
  for_each_kind(cloth, [&](const auto& kind, auto...) {
    for (const auto& e : kind) {
      const auto v = vertices(e);
      const std::size_t n = v.size(), sides = n == 2 ? 1 : n;
      for (std::size_t i = 0; i < sides; ++i) pairs.push_back({v[i], v[(i + 1) % n]});
    }
  });
  return pairs;
}

}  // namespace

PackedCloth pack(const Cloth& cloth, bool dashpots) {
  const Particles& from = cloth.particles;
  check_cloth(cloth, "cloth");
  PackedCloth packed;
  packed.particle = breadth_first_order(int(from.size()), neighbour_pairs(cloth));
  packed.force.assign(from.size(), Vec4{});
  for (const int i : packed.particle) {
    packed.x.push_back({from.x[i].x(), from.x[i].y(), from.x[i].z(), 0});
    packed.inv_mass.push_back(from.inv_mass[i]);
    const bool moves = from.inv_mass[i] > 0;
    packed.v.push_back(moves ? Vec4{from.v[i].x(), from.v[i].y(), from.v[i].z(), 0} : Vec4{});
  }
  const std::vector<int> place = places(packed.particle);
  std::vector<PackedSpring> edges;
  if (dashpots) edges = element_dashpots(cloth, place);
  packed.dashpots = int(edges.size());
  pack_springs(renumbered_springs(cloth, place, edges), packed);
  packed.elements = pack_elements(cloth, place);
  packed.shell = renumbered_shell(cloth, packed.particle, place);
  for (const auto& own : cloth.energies) packed.energies.push_back(own->packed(place));
  return packed;
}

void add_other_forces(PackedCloth& packed) {
  for (const auto& own : packed.energies)
    if (own) own->add_forces(packed.x.data(), packed.force.data());
  const Cloth& shell = packed.shell;
  bool any = std::ranges::any_of(packed.energies, [](const auto& own) { return !own; });
  for_each_kind(shell, [&](const auto& kind, auto...) {
    if constexpr (!is_laid_out<KindOf<decltype(kind)>>) any = any || !kind.empty();
  });
  if (!any) return;
  std::vector<Vec3> x, force(packed.x.size(), Vec3::Zero());
  for (const Vec4& p : packed.x) x.emplace_back(p.x, p.y, p.z);
  for_each_kind(shell, [&](const auto& kind, auto... law) {
    if constexpr (!is_laid_out<KindOf<decltype(kind)>>)
      for (const auto& e : kind) add_forces(x, e, law..., force);
  });
  for (std::size_t i = 0; i < shell.energies.size(); ++i)
    if (!packed.energies[i]) shell.energies[i]->add_forces(x, force);
  for (std::size_t i = 0; i < force.size(); ++i) {
    Vec4& sum = packed.force[i];
    sum = {sum.x + force[i].x(), sum.y + force[i].y(), sum.z + force[i].z(), 0};
  }
}

void unpack(const PackedCloth& packed, Particles& particles) {
  for (std::size_t i = 0; i < packed.x.size(); ++i) {
    if (packed.inv_mass[i] == 0) continue;
    const auto to = std::size_t(packed.particle[i]);
    particles.x[to] = Vec3(packed.x[i].x, packed.x[i].y, packed.x[i].z);
    particles.v[to] = Vec3(packed.v[i].x, packed.v[i].y, packed.v[i].z);
  }
}

}  // namespace furrow::physics
