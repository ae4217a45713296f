// SPDX-License-Identifier: MIT
#include "physics/body/distance_field.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace furrow::physics {
namespace {

constexpr double widest = 1e-4;  // m, of the cube that smooth_at() takes the mean over

typedef float Float2 __attribute__((vector_size(8)));
typedef double Double2 __attribute__((vector_size(16)));

inline Double2 load2(const float* f) {
  Float2 pair;
  std::memcpy(&pair, f, sizeof pair);
  return __builtin_convertvector(pair, Double2);
}

/// Into [0, high]; NaN gives 0.
inline double clamp(double t, double high) {
  const double above = t > 0 ? t : 0;
  return above < high ? above : high;
}

/// An interval around a coordinate, split at a lattice plane that crosses it.
struct Pieces {
  int count = 1;
  std::array<double, 2> middle{}, share{1, 0};
};

Pieces pieces_of(double x, double half, double low, double cell) {
  const double plane = low + std::round((x - low) / cell) * cell;
  if (!(std::abs(plane - x) < half)) return {1, {x, 0}, {1, 0}};
  const double below = (plane - (x - half)) / (2 * half);
  return {2, {0.5 * (x - half + plane), 0.5 * (x + half + plane)}, {below, 1 - below}};
}

}  // namespace

double DistanceField::allowed_error(double d) const {
  return report_.tolerance + far_slope_ * std::max(0.0, d > 0 ? d - outer_band_ : -d - inner_band_);
}

std::size_t DistanceField::memory() const {
  return (top_.size() + bricks_.size()) * sizeof(Entry) + nodes_.size() * sizeof(nodes_[0]) +
         leaves_.size() * sizeof(Leaf) + leaf_gradients_.size() * sizeof(LeafGradient);
}

int DistanceField::depth_below(Entry entry) const {
  if (entry & leaf_bit) return 0;
  int depth = 0;
  for (Entry child : nodes_[entry]) depth = std::max(depth, depth_below(child));
  return depth + 1;
}

void DistanceField::fill_brick(Entry entry, int level, const std::array<int, 3>& low, int left, int depth,
                               std::size_t base) {
  if (left == 0 || (entry & leaf_bit)) {
    const int reach = 1 << left;
    const Entry stored = entry & leaf_bit ? entry | static_cast<Entry>(level) << level_shift : entry;
    for (int k = 0; k < reach; ++k)
      for (int j = 0; j < reach; ++j) {
        const auto row = static_cast<std::size_t>((((low[2] + k) << depth) + low[1] + j) << depth);
        std::fill_n(bricks_.begin() + static_cast<std::ptrdiff_t>(base + row) + low[0], reach, stored);
      }
    return;
  }
  const int half = 1 << (left - 1);
  for (int c = 0; c < 8; ++c)
    fill_brick(nodes_[entry][c], level + 1,
               {low[0] + (c & 1) * half, low[1] + (c >> 1 & 1) * half, low[2] + (c >> 2) * half}, left - 1,
               depth, base);
}

DistanceField::Entry DistanceField::add_brick(Entry entry, int level) {
  const std::size_t base = bricks_.size();
  const int depth = std::min(depth_below(entry), brick_depth);
  bricks_.resize(base + (std::size_t{1} << (3 * depth)));
  if (bricks_.size() > brick_mask)
    throw std::invalid_argument("DistanceField: too many leaves; raise the tolerance");
  fill_brick(entry, level, {0, 0, 0}, depth, depth, base);
  return static_cast<Entry>(base) | static_cast<Entry>(depth) << brick_shift;
}

void DistanceField::fill_top(Entry entry, int level, const std::array<int, 3>& low) {
  if (level == top_depth_ || (entry & leaf_bit)) {
    const int reach = 1 << (top_depth_ - level);
    const Entry stored = add_brick(entry, level);
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

inline DistanceField::Place DistanceField::find(int ix, int iy, int iz) const {
  const int top_shift = max_depth_ - top_depth_;
  const Entry brick =
      top_[((((iz >> top_shift) << top_depth_) + (iy >> top_shift)) << top_depth_) + (ix >> top_shift)];
  const int depth = brick >> brick_shift, last = (1 << depth) - 1;
  int shift = top_shift - depth;
  Entry entry = bricks_[(brick & brick_mask) + (ix >> shift & last) + ((iy >> shift & last) << depth) +
                        ((iz >> shift & last) << 2 * depth)];
  int level = entry >> level_shift & level_mask;
  if (!(entry & leaf_bit)) [[unlikely]] {
    level = top_depth_ + depth;
    do {
      --shift;
      ++level;
      entry = nodes_[entry][(ix >> shift & 1) | (iy >> shift & 1) << 1 | (iz >> shift & 1) << 2];
    } while (!(entry & leaf_bit));
  }
  return {entry & index_mask, level};
}

inline DistanceField::Cell DistanceField::cell_of(const Vec3& x) const {
  const double side = 1 << max_depth_;
  const int last = (1 << max_depth_) - 1;
  Cell cell;
  for (int k = 0; k < 3; ++k) {
    cell.t[k] = clamp(per_unit_ * (x[k] - low_[k]), side);
    cell.i[k] = std::min(static_cast<int>(cell.t[k]), last);
  }
  return cell;
}

SignedDistance DistanceField::at(const Vec3& x) const {
  const Cell cell = cell_of(x);
  return value_at(x, cell, find(cell.i[0], cell.i[1], cell.i[2]));
}

inline SignedDistance DistanceField::value_at(const Vec3& x, const Cell& cell, const Place& place) const {
  const SignedDistance border = inside_at(cell, place);
  const Vec3 t = per_unit_ * (x - low_);
  if (cell.t[0] == t[0] && cell.t[1] == t[1] && cell.t[2] == t[2]) [[likely]]
    return border;
  const Vec3 beyond = (t - Vec3(cell.t[0], cell.t[1], cell.t[2])) / per_unit_;
  const double distance = beyond.norm();
  return {border.value + distance, beyond / distance};
}

inline SignedDistance DistanceField::inside_at(const Cell& cell, const Place& place) const {
  const auto& [ix, iy, iz] = cell.i;
  const auto& [tx, ty, tz] = cell.t;
  const int low_bits = ~((1 << (max_depth_ - place.level)) - 1);
  const double scale = cells_a_unit_[place.level], slope = scale * per_unit_;
  const double u = (tx - (ix & low_bits)) * scale, v = (ty - (iy & low_bits)) * scale,
               w = (tz - (iz & low_bits)) * scale;
  // both z layers at once: corner c and c + 4 lie side by side
  const float* f = leaves_[place.leaf].data();
  const Double2 f00 = load2(f), f10 = load2(f + 2), f01 = load2(f + 4), f11 = load2(f + 6);
  const Double2 x0 = f10 - f00, x1 = f11 - f01;
  const Double2 e0 = f00 + u * x0, e1 = f01 + u * x1;
  const Double2 dy = e1 - e0, dx = x0 + v * (x1 - x0), g = e0 + v * dy;
  const double dz = g[1] - g[0], value = g[0] + w * dz;
  if (gradient_ == GradientRule::interpolated_corners)
    return {value, corner_gradient_at(place.leaf, {u, v, w})};
  return {value,
          Vec3(slope * (dx[0] + w * (dx[1] - dx[0])), slope * (dy[0] + w * (dy[1] - dy[0])), slope * dz)};
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

SignedDistance DistanceField::smooth_at(const Vec3& x) const {
  const double cell = 1 / per_unit_, half = 0.5 * std::min(widest, 0.5 * cell);
  std::array<Pieces, 3> p;
  for (int k = 0; k < 3; ++k) p[k] = pieces_of(x[k], half, low_[k], cell);
  if (p[0].count * p[1].count * p[2].count == 1) return DistanceField::at(x);
  SignedDistance mean{0, Vec3::Zero()};
  for (int a = 0; a < p[0].count; ++a)
    for (int b = 0; b < p[1].count; ++b)
      for (int c = 0; c < p[2].count; ++c) {
        const double share = p[0].share[a] * p[1].share[b] * p[2].share[c];
        const SignedDistance d = DistanceField::at({p[0].middle[a], p[1].middle[b], p[2].middle[c]});
        mean.value += share * d.value;
        mean.gradient += share * d.gradient;
      }
  return mean;
}

}  // namespace furrow::physics
