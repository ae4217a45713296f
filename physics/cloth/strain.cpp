// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "physics/base/require.h"
#include "physics/cloth/cloth.h"
#include "physics/cloth/kinds.h"

namespace furrow::physics {

StrainStatistics strain_statistics(std::span<const Vec3> x, std::span<const Spring> springs) {
  StrainStatistics result;
  if (springs.empty()) return result;
  std::vector<double> strains;
  strains.reserve(springs.size());
  double sum = 0;
  for (const Spring& s : springs) {
    if (std::min(s.a, s.b) < 0 || std::size_t(std::max(s.a, s.b)) >= x.size())
      refuse("strain_statistics", "a spring from ", s.a, " to ", s.b, " of ", x.size(), " particles");
    strains.push_back(std::abs((x[s.b] - x[s.a]).norm() - s.rest_length) / s.rest_length);
    sum += strains.back();
  }
  result.mean = sum / double(strains.size());
  // NaN has no order: a broken state reports NaN instead of sorting it.
  if (!std::isfinite(sum)) {
    result.max = result.p99 = sum;
    return result;
  }
  const std::size_t rank = std::size_t(std::ceil(0.99 * double(strains.size()))) - 1;
  std::nth_element(strains.begin(), strains.begin() + std::ptrdiff_t(rank), strains.end());
  result.p99 = strains[rank];
  result.max = *std::max_element(strains.begin() + std::ptrdiff_t(rank), strains.end());
  return result;
}

namespace {

/// Appends the edges of all kinds that have so many particles.
template <std::size_t particles>
void add_edges(const Cloth& cloth, std::vector<Spring>& to) {
  for_each_kind(cloth, [&](const auto& kind, auto...) {
    if constexpr (requires { edges(kind[0]); }) {
      if constexpr (decltype(vertices(kind[0])){}.size() == particles)
        for (const auto& e : kind)
          for (const Spring& edge : edges(e)) to.push_back(edge);
    }
  });
}

}  // namespace

std::vector<Spring> measured_edges(const Cloth& cloth) {
  std::vector<Spring> edges = cloth.structural;
  add_edges<2>(cloth, edges);
  if (edges.empty()) add_edges<3>(cloth, edges);
  return edges;
}

StrainStatistics strain_statistics(const Cloth& cloth) {
  if (cloth.tension.empty() && !cloth.structural.empty())
    return strain_statistics(cloth.particles.x, cloth.structural);
  return strain_statistics(cloth.particles.x, measured_edges(cloth));
}

double kinetic_energy(const Particles& particles) {
  for (const std::size_t n : {particles.v.size(), particles.mass.size(), particles.inv_mass.size()})
    if (n != particles.size())
      refuse("kinetic_energy", particles.size(), " particles, but an array of ", n, " of them");
  double energy = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.inv_mass[i] > 0) energy += 0.5 * particles.mass[i] * particles.v[i].squaredNorm();
  }
  return energy;
}

}  // namespace furrow::physics
