// SPDX-License-Identifier: MIT
#include "physics/packed/packed_cloth.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>

#include "physics/cloth/membrane.h"
#include "physics/cloth/tension_forces.h"

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

std::vector<int> places(const std::vector<int>& particle) {
  std::vector<int> place(particle.size());
  for (std::size_t i = 0; i < particle.size(); ++i) place[std::size_t(particle[i])] = int(i);
  return place;
}

struct PackedSpring {
  int a, b;
  double k, kL, damping_k;
};

/// One for each edge of the membrane or tension, sorted; damping_k: the sum of its triangles'
/// edge_stiffness() and of tension's slope at the working strain.
std::vector<PackedSpring> element_dashpots(const Cloth& cloth, const std::vector<int>& place) {
  std::map<std::pair<int, int>, double> edges;
  for (const MembraneTriangle& t : cloth.membrane) {
    const MembraneConstants constants = membrane_constants(t);
    for (int i = 0; i < 3; ++i) {
      edges[std::minmax(place[std::size_t(t.vertices[(i + 1) % 3])],
                        place[std::size_t(t.vertices[(i + 2) % 3])])] += edge_stiffness(constants, i);
    }
  }
  for (const Tension& t : cloth.tension) {
    edges[std::minmax(place[std::size_t(t.a)], place[std::size_t(t.b)])] += tension_slope(t, working_strain);
  }
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

Cloth renumbered_shell(const Cloth& cloth, const std::vector<int>& place) {
  Cloth shell;
  shell.membrane = cloth.membrane;
  shell.tension = cloth.tension;
  shell.hinges = cloth.hinges;
  shell.hinge_law = cloth.hinge_law;
  for (MembraneTriangle& t : shell.membrane)
    for (int& v : t.vertices) v = place[std::size_t(v)];
  for (Tension& t : shell.tension) t.a = place[std::size_t(t.a)], t.b = place[std::size_t(t.b)];
  for (Hinge& h : shell.hinges)
    for (int& v : h.vertices) v = place[std::size_t(v)];
  return shell;
}

/// Which particles act on each other.
std::vector<std::array<int, 2>> neighbour_pairs(const Cloth& cloth) {
  std::vector<std::array<int, 2>> pairs;
  for (const Spring& s : cloth.structural) pairs.push_back({s.a, s.b});
  for (const Spring& s : cloth.bending) pairs.push_back({s.a, s.b});
  for (const MembraneTriangle& t : cloth.membrane)
    for (std::size_t i = 0; i < 3; ++i) pairs.push_back({t.vertices[i], t.vertices[(i + 1) % 3]});
  for (const Tension& t : cloth.tension) pairs.push_back({t.a, t.b});
  for (const Hinge& h : cloth.hinges)
    for (std::size_t i = 0; i < 4; ++i) pairs.push_back({h.vertices[i], h.vertices[(i + 1) % 4]});
  return pairs;
}

}  // namespace

PackedCloth pack(const Cloth& cloth, bool dashpots) {
  const Particles& from = cloth.particles;
  check_particles(from);
  check_springs(cloth.structural, from.size(), "structural");
  check_springs(cloth.bending, from.size(), "bending");
  check_elements(cloth);
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
  packed.shell = renumbered_shell(cloth, place);
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
