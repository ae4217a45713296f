// SPDX-License-Identifier: MIT
#include "physics/cloth/element_forces.h"

#include <array>
#include <concepts>
#include <stdexcept>
#include <string>

#include "physics/cloth/cloth.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/kinds.h"

namespace furrow::physics {
namespace {

/// Calls work(i) for the first (0) or the second (1) half of `all`.
template <class Element, class Work>
void for_half(const std::vector<Element>& all, int which, const Work& work) {
  const std::size_t middle = all.size() / 2;
  for (std::size_t i = which ? middle : 0; i < (which ? all.size() : middle); ++i) work(i);
}

}  // namespace

ElementForces::ElementForces(const Cloth& cloth) : cloth_(cloth) {
  check_elements(cloth, cloth.particles.size());
  for (const MembraneTriangle& t : cloth.membrane) membrane_.push_back(membrane_constants(t));
}

double ElementForces::add_half(std::span<const Vec3> x, int which, std::span<Vec3> force) const {
  double e = 0;
  for_each_kind(cloth_, [&](const auto& kind, auto... law) {
    for_half(kind, which, [&](std::size_t i) {
      if constexpr (std::same_as<KindOf<decltype(kind)>, MembraneTriangle>)
        e += add_forces(x, kind[i], membrane_[i], force);
      else
        e += add_forces(x, kind[i], law..., force);
    });
  });
  if (which == 0) return e;
  for (const auto& own : cloth_.energies) e += own->add_energy_and_forces(x, force);
  return e;
}

double ElementForces::operator()(std::span<const Vec3> x, std::span<Vec3> force, ThreadPool& pool) {
  if (x.size() != cloth_.particles.size() || force.size() != x.size())
    throw std::invalid_argument("ElementForces: " + std::to_string(x.size()) + " positions and " +
                                std::to_string(force.size()) + " forces of " +
                                std::to_string(cloth_.particles.size()) + " particles");
  second_.resize(x.size());
  std::array<double, 2> energy{};
  pool.run(2, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const std::span<Vec3> sum = i ? std::span<Vec3>(second_) : force;
      for (Vec3& f : sum) f.setZero();
      energy[std::size_t(i)] = add_half(x, i, sum);
    }
  });
  for (std::size_t i = 0; i < force.size(); ++i) force[i] += second_[i];
  return energy[0] + energy[1];
}

}  // namespace furrow::physics
