// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bench/charts/sampled_field.h"

namespace furrow::bench {
namespace {

using physics::ExactDistance;
using physics::SignedDistance;
using physics::Vec3;

constexpr int block = 8;  // nodes

class UniformGrid : public SampledField {
 public:
  UniformGrid(const ExactDistance& exact, double cell, const Band& band)
      : cell_(cell), low_(exact.low().array() - band.outer - cell) {
    const Vec3 size = exact.high() - low_;
    for (int k = 0; k < 3; ++k) nodes_[k] = int(std::ceil((size[k] + band.outer + cell) / cell)) + 1;
    values_.resize(std::size_t(nodes_[0]) * nodes_[1] * nodes_[2]);
    for (int z = 0; z < nodes_[2]; z += block) {
      for (int y = 0; y < nodes_[1]; y += block) {
        for (int x = 0; x < nodes_[0]; x += block) fill({x, y, z}, exact, band);
      }
    }
  }

  void at_many(std::span<const Vec3> x, std::span<SignedDistance> result) const override {
    for (std::size_t i = 0; i < x.size(); ++i) result[i] = at(x[i]);
  }
  std::size_t memory() const override { return values_.size() * sizeof(float); }

 private:
  std::size_t index(int x, int y, int z) const { return (std::size_t(z) * nodes_[1] + y) * nodes_[0] + x; }
  Vec3 place(double x, double y, double z) const { return low_ + cell_ * Vec3(x, y, z); }

  void fill(const std::array<int, 3>& first, const ExactDistance& exact, const Band& band) {
    const double half = 0.5 * (block - 1), reach = (half + 1) * std::sqrt(3.0) * cell_;
    Vec3 from = place(first[0] + half, first[1] + half, first[2] + half);
    ExactDistance::Sample sample = exact.sample(from);
    const bool far = sample.value > band.outer + reach || sample.value < -band.inner - reach;
    std::array<int, 3> last;
    for (int k = 0; k < 3; ++k) last[k] = std::min(first[k] + block, nodes_[k]);
    for (int z = first[2]; z < last[2]; ++z) {
      for (int y = first[1]; y < last[1]; ++y) {
        for (int x = first[0]; x < last[0]; ++x) {
          if (!far) {
            const Vec3 to = place(x, y, z);
            sample = exact.sample(to, from, sample);
            from = to;
          }
          values_[index(x, y, z)] = float(sample.value);
        }
      }
    }
  }

  SignedDistance at(const Vec3& x) const {
    std::array<float, 3> u;
    std::array<int, 3> i;
    for (int k = 0; k < 3; ++k) {
      const double t = std::clamp((x[k] - low_[k]) * (1 / cell_), 0.0, nodes_[k] - 1.0);
      i[k] = std::min(int(t), nodes_[k] - 2);
      u[k] = float(t - i[k]);
    }
    const float* c = values_.data() + index(i[0], i[1], i[2]);
    const std::size_t row = nodes_[0], plane = row * nodes_[1];
    // Along x first, in the four edges of the cell, then along y and z.
    const float e00 = c[1] - c[0], e10 = c[row + 1] - c[row], e01 = c[plane + 1] - c[plane],
                e11 = c[plane + row + 1] - c[plane + row];
    const float a00 = c[0] + u[0] * e00, a10 = c[row] + u[0] * e10, a01 = c[plane] + u[0] * e01,
                a11 = c[plane + row] + u[0] * e11;
    const float b0 = a00 + u[1] * (a10 - a00), b1 = a01 + u[1] * (a11 - a01);
    const float g0 = e00 + u[1] * (e10 - e00), g1 = e01 + u[1] * (e11 - e01);
    const float y0 = a10 - a00, y1 = a11 - a01;
    return {b0 + u[2] * (b1 - b0), Vec3(g0 + u[2] * (g1 - g0), y0 + u[2] * (y1 - y0), b1 - b0) * (1 / cell_)};
  }

  double cell_;
  Vec3 low_;
  std::array<int, 3> nodes_;
  std::vector<float> values_;  ///< [m], x fastest
};

}  // namespace

std::unique_ptr<SampledField> uniform_grid(const physics::TriangleMesh& mesh, double cell, const Band& band) {
  return std::make_unique<UniformGrid>(ExactDistance(mesh), cell, band);
}

}  // namespace furrow::bench
