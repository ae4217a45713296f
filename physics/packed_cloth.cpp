// SPDX-License-Identifier: MIT
#include "physics/packed_cloth.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

namespace furrow::physics {
namespace {

void check_particles(const Particles& p) {
  const std::size_t n = p.size();
  if (p.v.size() != n || p.mass.size() != n || p.inv_mass.size() != n) {
    throw std::invalid_argument("particles: x, v, mass and inv_mass differ in length");
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::string name = "particle " + std::to_string(i);
    if (!(p.mass[i] >= 0) || !std::isfinite(p.mass[i]))
      throw std::invalid_argument(name + ": mass is not >= 0");
    if (!(p.inv_mass[i] >= 0) || !std::isfinite(p.inv_mass[i])) {
      throw std::invalid_argument(name + ": inv_mass is not >= 0 and finite");
    }
    if (!p.x[i].allFinite() || !p.v[i].allFinite()) {
      throw std::invalid_argument(name + ": position or velocity is not finite");
    }
  }
}

void check_springs(const std::vector<Spring>& springs, std::size_t n, const char* kind) {
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const Spring& s = springs[i];
    const std::string name = std::string(kind) + " spring " + std::to_string(i);
    if (s.a < 0 || s.b < 0 || std::size_t(s.a) >= n || std::size_t(s.b) >= n || s.a == s.b) {
      throw std::invalid_argument(name + ": joins " + std::to_string(s.a) + " and " + std::to_string(s.b) +
                                  " of " + std::to_string(n) + " particles");
    }
    if (!(s.rest_length > 0) || !std::isfinite(s.rest_length)) {
      throw std::invalid_argument(name + ": rest length " + std::to_string(s.rest_length) + " is not > 0");
    }
    if (!(s.stiffness >= 0) || !std::isfinite(s.stiffness)) {
      throw std::invalid_argument(name + ": stiffness " + std::to_string(s.stiffness) + " is not >= 0");
    }
  }
}

/// All springs with their ends as places, sorted by (a, b), structural before bending.
std::vector<Spring> renumbered_springs(const Cloth& cloth, const std::vector<int>& particle) {
  std::vector<int> place(particle.size());
  for (std::size_t i = 0; i < particle.size(); ++i) place[std::size_t(particle[i])] = int(i);
  std::vector<Spring> springs = cloth.structural;
  springs.insert(springs.end(), cloth.bending.begin(), cloth.bending.end());
  for (Spring& s : springs) {
    const auto [a, b] = std::minmax(place[std::size_t(s.a)], place[std::size_t(s.b)]);
    s.a = a, s.b = b;
  }
  std::stable_sort(springs.begin(), springs.end(),
                   [](const Spring& s, const Spring& t) { return std::tie(s.a, s.b) < std::tie(t.a, t.b); });
  return springs;
}

void pack_springs(const std::vector<Spring>& springs, PackedCloth& packed) {
  std::vector<std::array<int, 2>> pairs;
  for (const Spring& s : springs) pairs.push_back({s.a, s.b});
  packed.sweep = sweep_order(packed.particles(), pairs);
  for (const int p : packed.sweep.pairs) {
    const Spring& s = springs[std::size_t(p)];
    packed.a.push_back(s.a);
    packed.b.push_back(s.b);
    packed.k.push_back(s.stiffness);
    packed.kL.push_back(s.stiffness * s.rest_length);
  }
  packed.sweep.pairs.clear();
  packed.inv_length2.assign(springs.size(), 0.0);
}

}  // namespace

PackedCloth pack(const Cloth& cloth) {
  const Particles& from = cloth.particles;
  check_particles(from);
  check_springs(cloth.structural, from.size(), "structural");
  check_springs(cloth.bending, from.size(), "bending");
  std::vector<std::array<int, 2>> pairs;
  for (const Spring& s : cloth.structural) pairs.push_back({s.a, s.b});
  for (const Spring& s : cloth.bending) pairs.push_back({s.a, s.b});
  PackedCloth packed;
  packed.particle = breadth_first_order(int(from.size()), pairs);
  packed.force.assign(from.size(), Vec4{});
  for (const int i : packed.particle) {
    packed.x.push_back({from.x[i].x(), from.x[i].y(), from.x[i].z(), 0});
    packed.inv_mass.push_back(from.inv_mass[i]);
    const bool moves = from.inv_mass[i] > 0;
    packed.v.push_back(moves ? Vec4{from.v[i].x(), from.v[i].y(), from.v[i].z(), 0} : Vec4{});
  }
  pack_springs(renumbered_springs(cloth, packed.particle), packed);
  return packed;
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
