// SPDX-License-Identifier: MIT
#include "physics/body/distance_octree.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "physics/base/cancel_scope.h"

namespace furrow::physics {
namespace {

/// Index in the 3 x 3 x 3 lattice of a cell; i, j, k in {0, 1, 2} halves of its edge.
constexpr int at3(int i, int j, int k) { return i + 3 * j + 9 * k; }
constexpr int corner_at3(int c) { return at3(2 * (c & 1), c & 2, (c & 4) / 2); }

/// Trilinear interpolation at the 27 lattice points from the values at the corners.
std::array<double, 27> interpolate(const std::array<double, 8>& corner) {
  std::array<double, 27> v{};
  for (int c = 0; c < 8; ++c) v[corner_at3(c)] = corner[c];
  for (int k = 0; k < 3; k += 2)
    for (int j = 0; j < 3; j += 2) v[at3(1, j, k)] = 0.5 * (v[at3(0, j, k)] + v[at3(2, j, k)]);
  for (int k = 0; k < 3; k += 2)
    for (int i = 0; i < 3; ++i) v[at3(i, 1, k)] = 0.5 * (v[at3(i, 0, k)] + v[at3(i, 2, k)]);
  for (int i = 0; i < 9; ++i) v[9 + i] = 0.5 * (v[i] + v[18 + i]);
  return v;
}

constexpr int cells_a_question = 1024;  // of whether the work is cancelled

/// Of the allowed error: between the tested points, and after the repair, the error is a little larger.
constexpr double reserve = 0.93;

/// Trilinear interpolation of eight corner values (numbers or vectors) at (u, v, w) in [0, 1]^3.
template <class T>
T trilinear(const std::array<T, 8>& f, double u, double v, double w) {
  const auto mix = [](const T& a, const T& b, double t) { return T(a + t * (b - a)); };
  return mix(mix(mix(f[0], f[1], u), mix(f[2], f[3], u), v), mix(mix(f[4], f[5], u), mix(f[6], f[7], u), v),
             w);
}

}  // namespace

double RefinementRule::allowed_error(double d) const {
  return tolerance + far_slope * std::max(0.0, d > 0 ? d - outer_band : -d - inner_band);
}

DistanceOctree::DistanceOctree(LatticeSamples& samples, const RefinementRule& rule, double unit,
                               const Progress& progress)
    : samples_(samples), rule_(rule), unit_(unit) {
  refine(progress);
  balance();
  samples_.evaluate();
  values_.resize(samples_.size());
  for (int i = 0; i < samples_.size(); ++i) values_[i] = samples_.value(i);
  find_hanging();
  repair();
}

LatticePoint DistanceOctree::corner_point(const OctreeCell& cell, int c) const {
  const int e = edge(cell);
  return {cell.low[0] + (c & 1) * e, cell.low[1] + (c >> 1 & 1) * e, cell.low[2] + (c >> 2) * e};
}

std::array<int, 27> DistanceOctree::add_lattice(const OctreeCell& cell) {
  const int half = edge(cell) / 2;
  std::array<int, 27> lattice;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        if (i == 1 || j == 1 || k == 1)
          samples_.expect({cell.low[0] + i * half, cell.low[1] + j * half, cell.low[2] + k * half});
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const int nearby = cell.corner[i / 2 + j / 2 * 2 + k / 2 * 4];
        const bool corner = i != 1 && j != 1 && k != 1;
        lattice[at3(i, j, k)] =
            corner ? nearby
                   : samples_.add({cell.low[0] + i * half, cell.low[1] + j * half, cell.low[2] + k * half},
                                  nearby);
      }
  return lattice;
}

bool DistanceOctree::must_split(const OctreeCell& cell, const std::array<int, 27>& lattice) const {
  if (cell.level < rule_.min_depth) return true;
  const auto in_band = [&](int sample) {
    return samples_.value(sample) <= rule_.outer_band && samples_.value(sample) >= -rule_.inner_band;
  };
  const bool surface_inside =
      std::any_of(lattice.begin(), lattice.end(), [&](int s) { return samples_.value(s) < 0; }) &&
      std::any_of(lattice.begin(), lattice.end(), [&](int s) { return samples_.value(s) >= 0; });
  if (cell.level < rule_.band_depth &&
      (surface_inside || std::any_of(lattice.begin(), lattice.end(), in_band)))
    return true;
  std::array<double, 8> corner;
  for (int c = 0; c < 8; ++c) corner[c] = samples_.value(cell.corner[c]);
  const std::array<double, 27> guess = interpolate(corner);
  return std::any_of(lattice.begin(), lattice.end(), [&, i = 0](int sample) mutable {
    const double exact = samples_.value(sample);
    return std::abs(exact - guess[i++]) > reserve * rule_.allowed_error(exact);
  });
}

void DistanceOctree::append_children(int parent) {
  const std::array<int, 27> lattice = add_lattice(cells_[parent]);
  cells_[parent].first_child = static_cast<int>(cells_.size());
  for (int c = 0; c < 8; ++c) {
    OctreeCell child;
    child.level = cells_[parent].level + 1;
    const int i = c & 1, j = c >> 1 & 1, k = c >> 2, half = edge(child);
    const LatticePoint& low = cells_[parent].low;
    child.low = {low[0] + i * half, low[1] + j * half, low[2] + k * half};
    for (int b = 0; b < 8; ++b) child.corner[b] = lattice[at3(i + (b & 1), j + (b >> 1 & 1), k + (b >> 2))];
    cells_.push_back(child);
  }
}

/// The smallest tolerance that the cell keeps as it is [m].
double DistanceOctree::tolerance_of(const OctreeCell& cell, const std::array<int, 27>& lattice) const {
  std::array<double, 8> corner;
  for (int c = 0; c < 8; ++c) corner[c] = samples_.value(cell.corner[c]);
  const std::array<double, 27> guess = interpolate(corner);
  double tolerance = 0;
  for (int i = 0; i < 27; ++i) {
    const double exact = samples_.value(lattice[i]);
    const double beyond_band = rule_.allowed_error(exact) - rule_.tolerance;
    tolerance = std::max(tolerance, std::abs(exact - guess[i]) / reserve - beyond_band);
  }
  return tolerance;
}

/// A tolerance, of one digit, that so many cells of the level from `first` on break at most [m].
double DistanceOctree::tolerance_for(std::size_t cells, const std::vector<std::array<int, 27>>& lattices,
                                     std::size_t first) const {
  std::vector<double> tolerances;
  for (std::size_t i = 0; i < lattices.size(); ++i)
    tolerances.push_back(tolerance_of(cells_[first + i], lattices[i]));
  std::sort(tolerances.begin(), tolerances.end(), std::greater<>());
  const double least =
      std::max(1.2 * tolerances[std::min(cells, tolerances.size() - 1)], 2 * rule_.tolerance);
  const double digit = std::pow(10, std::floor(std::log10(least)));
  return std::ceil(least / digit) * digit;
}

/// The cells from `first` to `last` are of one level, those behind it of the next one; `samples_before`: how
/// many there were before that level's. Further levels are guessed to grow as these did.
void DistanceOctree::check_next_level(std::size_t first, std::size_t last, int samples_before,
                                      const std::vector<std::array<int, 27>>& lattices) const {
  const double cells = double(last - first), next = double(cells_.size() - last);
  const int level = cells_[first].level;
  if (rule_.most_samples <= 0 || next == 0 || level + 1 >= rule_.max_depth) return;
  const double samples_a_cell = (samples_.size() - samples_before) / cells;
  const double most = double(rule_.most_samples);
  double total = samples_.size() + samples_a_cell * next;
  if (total <= most) return;
  // Of a tolerance's cells that still break it, each has eight children; their error is a quarter.
  const double left = std::max(0.0, most - samples_.size()) / samples_a_cell / 16;
  const double tolerance = tolerance_for(static_cast<std::size_t>(left), lattices, first);
  double growing = next;
  for (int l = level + 2; l < rule_.max_depth; ++l)
    total += samples_a_cell * (growing *= std::clamp(next / cells, 1.0, 8.0));
  constexpr double bytes_a_sample = 110;  // measured: samples, cells and tables while it is built
  char text[200];
  std::snprintf(text, sizeof text,
                "the distance field would take about %.1g samples, %.2g GB; raise the tolerance to %.1g m",
                total, 1e-9 * bytes_a_sample * total, tolerance);
  throw TooMuchWork(text);
}

void DistanceOctree::refine(const Progress& progress) {
  const auto tell = [&](double levels) {
    if (progress && !progress(std::min(levels / (rule_.max_depth + 1), 1.0)))
      throw Cancelled("DistanceField: cancelled");
  };
  OctreeCell root{{0, 0, 0}, 0, 0, {}};
  for (int c = 0; c < 8; ++c) root.corner[c] = samples_.add(corner_point(root, c));
  samples_.evaluate();
  cells_.push_back(root);
  std::vector<std::array<int, 27>> lattices;
  for (std::size_t first = 0; first < cells_.size() && cells_[first].level < rule_.max_depth;) {
    const std::size_t last = cells_.size();
    const int samples_before = samples_.size();
    lattices.clear();
    for (std::size_t i = first; i < last; ++i) lattices.push_back(add_lattice(cells_[i]));
    const int level = cells_[first].level;
    samples_.evaluate([&](double share) { tell(level + share); });
    for (std::size_t i = first; i < last; ++i) {
      if (i % cells_a_question == 0) throw_if_cancelled("DistanceField");
      if (must_split(cells_[i], lattices[i - first])) append_children(static_cast<int>(i));
    }
    check_next_level(first, last, samples_before, lattices);
    first = last;
  }
}

int DistanceOctree::leaf_at(const LatticePoint& p) const {
  int cell = 0;
  for (int bit = rule_.max_depth - 1; cells_[cell].first_child != 0; --bit)
    cell = cells_[cell].first_child + (p[0] >> bit & 1) + (p[1] >> bit & 1) * 2 + (p[2] >> bit & 1) * 4;
  return cell;
}

void DistanceOctree::split_down_to(const LatticePoint& p, int level, std::vector<std::vector<int>>& split) {
  for (int leaf = leaf_at(p); cells_[leaf].level < level; leaf = leaf_at(p)) {
    append_children(leaf);
    split[cells_[leaf].level].push_back(leaf);
  }
}

void DistanceOctree::balance() {
  const int side = 1 << rule_.max_depth;
  std::vector<std::vector<int>> split(rule_.max_depth + 1);  // by level; cells with children
  for (std::size_t i = 0; i < cells_.size(); ++i)
    if (cells_[i].first_child != 0) split[cells_[i].level].push_back(static_cast<int>(i));
  for (int level = rule_.max_depth - 1; level > 1; --level)
    for (std::size_t n = 0; n < split[level].size(); ++n) {
      if (n % cells_a_question == 0) throw_if_cancelled("DistanceField");
      const LatticePoint low = cells_[split[level][n]].low;
      const int step = edge(cells_[split[level][n]]);
      for (int way = 0; way < 27; ++way) {
        const LatticePoint p{low[0] + (way % 3 - 1) * step, low[1] + (way / 3 % 3 - 1) * step,
                             low[2] + (way / 9 - 1) * step};
        if (std::all_of(p.begin(), p.end(), [&](int a) { return a >= 0 && a < side; }))
          split_down_to(p, level, split);
      }
    }
}

void DistanceOctree::find_hanging() {
  const int side = 1 << rule_.max_depth;
  std::vector<char> seen(values_.size(), 0);
  std::vector<std::vector<Hanging>> by_level(rule_.max_depth + 1);
  std::vector<LatticePoint> point(values_.size());
  for (const OctreeCell& cell : cells_) {
    if ((&cell - cells_.data()) % cells_a_question == 0) throw_if_cancelled("DistanceField");
    for (int c = 0; cell.first_child == 0 && c < 8; ++c) {
      const int sample = cell.corner[c];
      if (seen[sample]) continue;
      seen[sample] = 1;
      const LatticePoint p = point[sample] = corner_point(cell, c);
      int coarsest = -1;
      for (int around = 0; around < 8; ++around) {
        const LatticePoint q{p[0] - (around & 1), p[1] - (around >> 1 & 1), p[2] - (around >> 2)};
        if (std::any_of(q.begin(), q.end(), [&](int a) { return a < 0 || a >= side; })) continue;
        const int leaf = leaf_at(q);
        if (coarsest < 0 || cells_[leaf].level < cells_[coarsest].level) coarsest = leaf;
      }
      const auto& corners = cells_[coarsest].corner;
      if (std::find(corners.begin(), corners.end(), sample) == corners.end())
        by_level[cells_[coarsest].level].push_back({sample, coarsest});
    }
  }
  for (const auto& level : by_level)
    for (const Hanging& h : level) {
      hanging_.push_back(h);
      hanging_points_.push_back(point[h.sample]);
    }
}

void DistanceOctree::repair() {
  for (std::size_t i = 0; i < hanging_.size(); ++i) {
    const OctreeCell& coarse = cells_[hanging_[i].coarse];
    const LatticePoint& p = hanging_points_[i];
    std::array<double, 8> f;
    for (int c = 0; c < 8; ++c) f[c] = values_[coarse.corner[c]];
    const double e = edge(coarse);
    double& value = values_[hanging_[i].sample];
    const double repaired =
        trilinear(f, (p[0] - coarse.low[0]) / e, (p[1] - coarse.low[1]) / e, (p[2] - coarse.low[2]) / e);
    largest_repair_ = std::max(largest_repair_, std::abs(repaired - value));
    value = repaired;
  }
}

std::vector<Vec3> DistanceOctree::corner_gradients() const {
  std::vector<Vec3> gradient(values_.size(), Vec3::Zero());
  std::vector<int> leaves(values_.size(), 0);
  for (const OctreeCell& cell : cells_)
    for (int c = 0; cell.first_child == 0 && c < 8; ++c) {
      Vec3 slope;
      for (int k = 0; k < 3; ++k)
        slope[k] =
            (values_[cell.corner[c | 1 << k]] - values_[cell.corner[c & ~(1 << k)]]) / (unit_ * edge(cell));
      gradient[cell.corner[c]] += slope;
      ++leaves[cell.corner[c]];
    }
  for (std::size_t i = 0; i < gradient.size(); ++i)
    if (leaves[i] > 0) gradient[i] /= leaves[i];
  for (std::size_t i = 0; i < hanging_.size(); ++i) {
    const OctreeCell& coarse = cells_[hanging_[i].coarse];
    const LatticePoint& p = hanging_points_[i];
    std::array<Vec3, 8> f;
    for (int c = 0; c < 8; ++c) f[c] = gradient[coarse.corner[c]];
    const double e = edge(coarse);
    gradient[hanging_[i].sample] =
        trilinear(f, (p[0] - coarse.low[0]) / e, (p[1] - coarse.low[1]) / e, (p[2] - coarse.low[2]) / e);
  }
  return gradient;
}

}  // namespace furrow::physics
