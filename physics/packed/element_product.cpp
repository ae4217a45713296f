// SPDX-License-Identifier: MIT
#include "physics/packed/element_product.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>

#include "physics/base/cancel_scope.h"
#include "physics/base/require.h"
#include "physics/cloth/cloth.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/kinds.h"

namespace furrow::physics {
namespace {

constexpr double least_reach = 1e-6;  // of a difference, over the cloth's size

/// Calls visit(e, law...) on each element but springs.
void for_elements(const Cloth& cloth, const auto& visit) {
  for_each_kind(cloth, [&](const auto& kind, auto... law) {
    if constexpr (!std::same_as<KindOf<decltype(kind)>, Spring>)
      for (const auto& e : kind) {
        if ((&e - &*kind.begin()) % 4096 == 0) throw_if_cancelled("ElementProduct");
        visit(e, law...);
      }
  });
}

void hand_out_all(const Cloth& cloth, const BlockSink& sink) {
  const std::span<const Vec3> x = cloth.particles.x;
  for_elements(cloth, [&](const auto& e, auto... law) {
    const auto particles = vertices(e);
    Mat3 lower[lower_blocks(int(particles.size()))];
    if constexpr (requires { stiffness_bound_blocks(x, e, law..., lower); })
      stiffness_bound_blocks(x, e, law..., lower);
    else
      stiffness_blocks(x, e, law..., Stiffness::positive_part, lower);
    hand_out(particles, lower, sink);
  });
  for (const auto& own : cloth.energies) own->add_stiffness(x, Stiffness::positive_part, sink);
}

std::uint64_t key(int i, int j) { return std::uint64_t(i) << 32 | std::uint64_t(j); }

/// (i, j) of all blocks, sorted, each once. Those without stiffness go to `rough`.
std::vector<std::uint64_t> keys_of(const Cloth& cloth, std::vector<std::shared_ptr<const Energy>>& rough) {
  std::vector<std::uint64_t> keys;
  for_elements(cloth, [&](const auto& e, auto...) {
    for (const int i : vertices(e))
      for (const int j : vertices(e)) keys.push_back(key(i, j));
  });
  const std::vector<Vec3>& x = cloth.particles.x;
  for (const auto& own : cloth.energies) {
    const bool known = own->add_stiffness(x, Stiffness::positive_part, [&](int i, int j, const Mat3&) {
      if (i < 0 || j < 0 || std::size_t(std::max(i, j)) >= x.size())
        refuse("ElementProduct", "an energy names particles ", i, " and ", j, " of ", x.size());
      keys.push_back(key(i, j));
    });
    if (!known) rough.push_back(own);
  }
  throw_if_cancelled("ElementProduct");
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

}  // namespace

ElementProduct::ElementProduct(const Cloth& cloth) {
  check_elements(cloth, cloth.particles.size());
  const std::vector<std::uint64_t> keys = keys_of(cloth, rough_);
  if (!rough_.empty()) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : x_ = cloth.particles.x) box.extend(p);
    reach_ = least_reach * (box.isEmpty() ? 0 : box.diagonal().norm());
    if (!(reach_ > 0)) reach_ = least_reach;
  }
  if (keys.empty()) return;
  row_begin_.assign(cloth.particles.size() + 1, 0);
  for (const std::uint64_t key : keys) {
    ++row_begin_[std::size_t(key >> 32) + 1];
    column_.push_back(int(key & 0xffffffffu));
  }
  for (std::size_t i = 1; i < row_begin_.size(); ++i) row_begin_[i] += row_begin_[i - 1];
  block_.assign(keys.size(), Mat3::Zero());
  hand_out_all(cloth, [&](int i, int j, const Mat3& block) {
    const auto first = column_.begin() + std::ptrdiff_t(row_begin_[std::size_t(i)]),
               last = column_.begin() + std::ptrdiff_t(row_begin_[std::size_t(i) + 1]);
    block_[std::size_t(std::lower_bound(first, last, j) - column_.begin())] += block;
  });
}

/// K u = -(f(x + h u) - f(x - h u)) / (2 h), the longest h u as long as the reach.
void ElementProduct::add_differences(std::span<const Vec3> u, std::span<Vec3> product) const {
  double longest = 0;
  for (const Vec3& v : u) longest = std::max(longest, v.norm());
  if (!(longest > 0)) return;
  const double h = reach_ / longest;
  const auto forces = [&](double share) {
    std::vector<Vec3> x = x_, force(u.size(), Vec3::Zero());
    for (std::size_t i = 0; i < u.size(); ++i) x[i] += share * u[i];
    for (const auto& own : rough_) own->add_forces(x, force);
    return force;
  };
  const std::vector<Vec3> before = forces(-h), after = forces(h);
  for (std::size_t i = 0; i < u.size(); ++i) product[i] += (before[i] - after[i]) / (2 * h);
}

void ElementProduct::add(std::span<const Vec3> u, std::span<Vec3> product) const {
  if (!rough_.empty()) add_differences(u, product);
  for (std::size_t i = 0; i + 1 < row_begin_.size(); ++i) {
    for (std::size_t b = row_begin_[i]; b < row_begin_[i + 1]; ++b)
      product[i] += block_[b] * u[std::size_t(column_[b])];
  }
}

void ElementProduct::add_row_sums(std::span<const double> scale, std::span<double> row) const {
  for (std::size_t i = 0; i + 1 < row_begin_.size(); ++i) {
    for (std::size_t b = row_begin_[i]; b < row_begin_[i + 1]; ++b)
      row[i] += scale[i] * block_[b].norm() * scale[std::size_t(column_[b])];
  }
}

}  // namespace furrow::physics
