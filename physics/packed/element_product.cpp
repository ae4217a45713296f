// SPDX-License-Identifier: MIT
#include "physics/packed/element_product.h"

#include <algorithm>
#include <cstdint>

#include "physics/cloth/hinge_forces.h"
#include "physics/cloth/membrane.h"
#include "physics/cloth/tension_forces.h"
#include "physics/packed/packed_elements.h"

namespace furrow::physics {
namespace {

void hand_out(const Cloth& cloth, const BlockSink& sink) {
  add_membrane_stiffness(cloth.particles.x, cloth.membrane, Stiffness::positive_part, sink);
  add_tension_stiffness_bound(cloth.particles.x, cloth.tension, sink);
  add_hinge_stiffness_bound(cloth.particles.x, cloth.hinges, cloth.hinge_law, sink);
}

/// (i, j) of all blocks, sorted, each once.
std::vector<std::uint64_t> keys_of(const Cloth& cloth) {
  std::vector<std::uint64_t> keys;
  keys.reserve(9 * cloth.membrane.size() + 4 * cloth.tension.size() + 16 * cloth.hinges.size());
  const auto add = [&](const auto& vertices) {
    for (const int i : vertices)
      for (const int j : vertices) keys.push_back(std::uint64_t(i) << 32 | std::uint64_t(j));
  };
  for (const MembraneTriangle& t : cloth.membrane) add(t.vertices);
  for (const Tension& t : cloth.tension) add(std::array{t.a, t.b});
  for (const Hinge& h : cloth.hinges) add(h.vertices);
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

}  // namespace

ElementProduct::ElementProduct(const Cloth& cloth) {
  if (cloth.membrane.empty() && cloth.tension.empty() && cloth.hinges.empty()) return;
  check_elements(cloth);
  const std::vector<std::uint64_t> keys = keys_of(cloth);
  row_begin_.assign(cloth.particles.size() + 1, 0);
  for (const std::uint64_t key : keys) {
    ++row_begin_[std::size_t(key >> 32) + 1];
    column_.push_back(int(key & 0xffffffffu));
  }
  for (std::size_t i = 1; i < row_begin_.size(); ++i) row_begin_[i] += row_begin_[i - 1];
  block_.assign(keys.size(), Mat3::Zero());
  hand_out(cloth, [&](int i, int j, const Mat3& block) {
    const auto first = column_.begin() + std::ptrdiff_t(row_begin_[std::size_t(i)]),
               last = column_.begin() + std::ptrdiff_t(row_begin_[std::size_t(i) + 1]);
    block_[std::size_t(std::lower_bound(first, last, j) - column_.begin())] += block;
  });
}

void ElementProduct::add(std::span<const Vec3> u, std::span<Vec3> product) const {
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
