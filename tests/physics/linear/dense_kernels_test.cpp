// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/linear/dense_kernels.h"

#include <catch2/catch.hpp>
#include <string>

#include "physics/linear/dense_front.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;

namespace {

/// Everything that kernels compute, of one matrix: factor and product below the diagonal, substitutions.
std::vector<double> results(const DenseKernels& k, int width, int rest) {
  const int height = width + rest, stride = padded(height), square = padded(width), left = padded(rest);
  furrow::tests::Noise noise(std::uint64_t(1000 * width + rest));
  std::vector<double> a(std::size_t(stride * width + 8), 0.0), x(std::size_t(stride), 0.0);
  for (int c = 0; c < width; ++c)
    for (int r = c; r < height; ++r) a[std::size_t(c * stride + r)] = r == c ? 2 * height : noise();
  for (int r = 0; r < height; ++r) x[std::size_t(r)] = noise();
  REQUIRE(k.factorise(a.data(), stride, width, square));
  k.solve_rows(a.data(), stride, width, square, stride);
  std::vector<double> update(std::size_t(left * rest), 0.0), all = x;
  k.product({update.data(), left, a.data() + width, stride, 0, left, rest, width, true});
  k.product({update.data(), left, a.data() + width, stride, 0, left, rest, width, false});
  k.forward(a.data(), stride, width, x.data());
  all.insert(all.end(), x.begin(), x.end());
  k.backward(a.data(), stride, width, x.data());
  all.insert(all.end(), x.begin(), x.end());
  for (int c = 0; c < width; ++c)
    for (int r = c; r < height; ++r) all.push_back(a[std::size_t(c * stride + r)]);
  for (int c = 0; c < rest; ++c)
    for (int r = c; r < rest; ++r) all.push_back(update[std::size_t(c * left + r)]);
  return all;
}

}  // namespace

TEST_CASE("dense_kernels: every version of a processor with fused multiply-add gives the same bits") {
  const auto versions = all_dense_kernels();
  REQUIRE(!versions.empty());
  CHECK(&dense_kernels() == versions.front());
  CHECK(versions.back()->name == std::string("plain"));
  for (const auto& [width, rest] : {std::array{3, 0}, {6, 27}, {15, 9}, {24, 120}, {60, 300}, {63, 45}}) {
    const std::vector<double> first = results(*versions.front(), width, rest);
    for (const DenseKernels* k : versions) {
      CAPTURE(width, rest, k->name);
      const std::vector<double> other = results(*k, width, rest);
      if (k->name != std::string("plain")) CHECK(other == first);
      double apart = 0;
      for (std::size_t i = 0; i < first.size(); ++i) apart = std::max(apart, std::abs(other[i] - first[i]));
      CHECK(apart < 1e-13);
    }
  }
}
