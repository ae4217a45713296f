// SPDX-License-Identifier: MIT
#include "physics/motion/step_elements.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "physics/cloth/elements.h"
#include "physics/cloth/kinds.h"
#include "physics/packed/packed_stiffness.h"

namespace furrow::physics {
namespace {

std::vector<int> own_places(std::size_t n) {
  std::vector<int> place(n);
  std::iota(place.begin(), place.end(), 0);
  return place;
}

}  // namespace

Cloth cloth_by_place(const PackedCloth& packed) {
  Cloth cloth = packed.shell;
  for (int i = 0; i < packed.springs(); ++i)
    if (packed.k[i] > 0)
      cloth.structural.push_back({packed.a[i], packed.b[i], packed.kL[i] / packed.k[i], packed.k[i]});
  std::stable_sort(cloth.structural.begin(), cloth.structural.end(),
                   [](const Spring& s, const Spring& t) { return std::tie(s.a, s.b) < std::tie(t.a, t.b); });
  sort_elements(cloth);
  Particles& p = cloth.particles;
  p = {};
  for (std::size_t i = 0; i < packed.x.size(); ++i) {
    p.x.push_back(xyz(packed.x[i]));
    p.v.push_back(xyz(packed.v[i]));
    p.inv_mass.push_back(packed.inv_mass[i]);
    p.mass.push_back(packed.inv_mass[i] > 0 ? 1 / packed.inv_mass[i] : 0);
  }
  return cloth;
}

void sort_elements(Cloth& cloth) {
  for_each_kind(cloth, [](auto& kind, auto...) {
    if constexpr (is_laid_out<KindOf<decltype(kind)>>) {
      const auto least = [](const auto& e) { return std::ranges::min(vertices(e)); };
      std::stable_sort(kind.begin(), kind.end(),
                       [&](const auto& a, const auto& b) { return least(a) < least(b); });
    }
  });
}

StepElements::StepElements(const Cloth& cloth) : cloth_(cloth), others_(cloth) {
  check_elements(cloth, cloth.particles.size());
  packed_ = pack_elements(cloth, own_places(cloth.particles.size()));
  others_.membrane.clear();
  others_.tension.clear();
  others_.hinges.clear();
  bool any = !others_.energies.empty();
  for_each_kind(others_, [&](const auto& kind, auto...) { any = any || !kind.empty(); });
  if (any) other_forces_.emplace(others_);
}

void StepElements::place(std::span<const Vec3> x) {
  x_.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) x_[i] = {x[i].x(), x[i].y(), x[i].z(), 0};
}

double StepElements::operator()(std::span<const Vec3> x, std::span<Vec3> force, ThreadPool& pool) {
  double energy = 0;
  if (other_forces_)
    energy = (*other_forces_)(x, force, pool);
  else
    for (Vec3& f : force) f.setZero();
  if (packed_.slot.empty()) return energy;
  place(x);
  force_.assign(x.size(), Vec4{});
  energy += add_element_forces_and_energy(packed_, x_, force_, pool);
  for (std::size_t i = 0; i < x.size(); ++i) force[i] += Vec3(force_[i].x, force_[i].y, force_[i].z);
  return energy;
}

void StepElements::assemble(FreeStiffness& matrix, std::span<const Vec3> x, ThreadPool& pool) {
  place(x);
  matrix.assemble([&](int begin, int end, Mat3* to) { blocks(matrix.counts(), x, begin, end, to); }, &pool);
}

/// Kind by kind, in the order of for_each_kind(), then the energies.
void StepElements::blocks(const ElementCounts& counts, std::span<const Vec3> x, int begin, int end,
                          Mat3* to) const {
  int first = 0;
  std::size_t kind = 0;
  const auto take = [&](const auto& own) {  // calls own(begin, end, to), numbers within the kind
    const int n = counts.elements[kind], from = std::clamp(begin - first, 0, n),
              until = std::clamp(end - first, 0, n);
    if (from < until) own(from, until);
    to += std::ptrdiff_t(until - from) * counts.blocks[kind++];
    first += n;
  };
  const auto plainly = [&](int from, int until) {
    stiffness_blocks(cloth_, counts, x, part, first + from, first + until, to);
  };
  for_each_kind(cloth_, [&](const auto& elements, auto... law) {
    using Kind = KindOf<decltype(elements)>;
    take([&](int from, int until) {
      if constexpr (std::same_as<Kind, MembraneTriangle>) {
        triangle_blocks(packed_, x_.data(), from, until, to);
      } else if constexpr (std::same_as<Kind, Hinge>) {
        const bool linear = ((law == HingeLaw::linear) && ...);
        if (linear)
          hinge_blocks(packed_, x_.data(), from, until, to);
        else
          plainly(from, until);
      } else {
        plainly(from, until);
      }
    });
  });
  for (std::size_t i = 0; i < cloth_.energies.size(); ++i) take(plainly);
}

}  // namespace furrow::physics
