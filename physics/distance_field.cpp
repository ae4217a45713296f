// SPDX-License-Identifier: MIT
#include "physics/distance_field.h"

#include <algorithm>
#include <cmath>

#include "physics/distance_field_layout.h"

namespace furrow::physics {

using namespace distance_field_layout;

double DistanceField::allowed_error(double d) const {
  return report_.tolerance + far_slope_ * std::max(0.0, d > 0 ? d - outer_band_ : -d - inner_band_);
}

std::size_t DistanceField::memory() const {
  return top_.size() * sizeof(Entry) + nodes_.size() * sizeof(nodes_[0]) + leaves_.size() * sizeof(Leaf) +
         leaf_gradients_.size() * sizeof(LeafGradient);
}

void DistanceField::fill_top(Entry entry, int level, const std::array<int, 3>& low) {
  if (level == top_depth_ || (entry & leaf_bit)) {
    const int reach = 1 << (top_depth_ - level);
    const Entry stored = entry & leaf_bit ? entry | static_cast<Entry>(level) << level_shift : entry;
    for (int k = 0; k < reach; ++k)
      for (int j = 0; j < reach; ++j) {
        const auto row = (((low[2] + k) << top_depth_) + low[1] + j) << top_depth_;
        std::fill_n(top_.begin() + row + low[0], reach, stored);
      }
    return;
  }
  const int half = 1 << (top_depth_ - level - 1);
  for (int c = 0; c < 8; ++c)
    fill_top(nodes_[entry][c], level + 1,
             {low[0] + (c & 1) * half, low[1] + (c >> 1 & 1) * half, low[2] + (c >> 2) * half});
}

void DistanceField::index() {
  top_depth_ = std::min(max_depth_, 6);
  per_unit_ = (1 << max_depth_) / size_;
  for (int level = 0; level <= max_depth_; ++level) cells_a_unit_[level] = 1.0 / (1 << (max_depth_ - level));
  top_.assign(std::size_t{1} << (3 * top_depth_), 0);
  fill_top(0, 0, {0, 0, 0});
}

SignedDistance DistanceField::at(const Vec3& x) const {
  const Vec3 t = per_unit_ * (x - low_);
  const double side = 1 << max_depth_;
  if (t[0] >= 0 && t[1] >= 0 && t[2] >= 0 && t[0] < side && t[1] < side && t[2] < side) return inside_at(t);
  Vec3 clamped;
  for (int k = 0; k < 3; ++k) clamped[k] = t[k] > 0 ? std::min(t[k], side) : 0;  // NaN gives 0
  const Vec3 beyond = (t - clamped) / per_unit_;
  const double distance = beyond.norm();
  const SignedDistance border = inside_at(clamped);
  if (distance == 0) return border;
  return {border.value + distance, beyond / distance};
}

SignedDistance DistanceField::inside_at(const Vec3& t) const {
  const int last = (1 << max_depth_) - 1;
  const int ix = std::min(static_cast<int>(t[0]), last), iy = std::min(static_cast<int>(t[1]), last),
            iz = std::min(static_cast<int>(t[2]), last);
  int shift = max_depth_ - top_depth_;
  Entry entry = top_[((((iz >> shift) << top_depth_) + (iy >> shift)) << top_depth_) + (ix >> shift)];
  int level = top_depth_;
  if (entry & leaf_bit) {
    level = entry >> level_shift & level_mask;
  } else {
    do {
      --shift;
      ++level;
      entry = nodes_[entry][(ix >> shift & 1) | (iy >> shift & 1) << 1 | (iz >> shift & 1) << 2];
    } while (!(entry & leaf_bit));
  }
  const std::size_t leaf = entry & index_mask;
  const Leaf& f = leaves_[leaf];
  const int low_bits = ~((1 << (max_depth_ - level)) - 1);
  const double scale = cells_a_unit_[level], slope = scale * per_unit_;
  const double u = (t[0] - (ix & low_bits)) * scale, v = (t[1] - (iy & low_bits)) * scale,
               w = (t[2] - (iz & low_bits)) * scale;
  const double x00 = double(f[1]) - f[0], x10 = double(f[3]) - f[2], x01 = double(f[5]) - f[4],
               x11 = double(f[7]) - f[6];
  const double e00 = f[0] + u * x00, e10 = f[2] + u * x10, e01 = f[4] + u * x01, e11 = f[6] + u * x11;
  const double y0 = e10 - e00, y1 = e11 - e01;
  const double g0 = e00 + v * y0, g1 = e01 + v * y1;
  const double x0 = x00 + v * (x10 - x00), x1 = x01 + v * (x11 - x01);
  const double value = g0 + w * (g1 - g0);
  if (gradient_ == GradientRule::interpolated_corners) return {value, corner_gradient_at(leaf, {u, v, w})};
  return {value, Vec3(slope * (x0 + w * (x1 - x0)), slope * (y0 + w * (y1 - y0)), slope * (g1 - g0))};
}

Vec3 DistanceField::corner_gradient_at(std::size_t leaf, const Vec3& u) const {
  const LeafGradient& corners = leaf_gradients_[leaf];
  Vec3 sum = Vec3::Zero();
  for (int c = 0; c < 8; ++c) {
    const double weight = (c & 1 ? u[0] : 1 - u[0]) * (c & 2 ? u[1] : 1 - u[1]) * (c & 4 ? u[2] : 1 - u[2]);
    sum += weight * Vec3(corners[c][0], corners[c][1], corners[c][2]);
  }
  return sum;
}

}  // namespace furrow::physics
