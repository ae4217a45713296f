// SPDX-License-Identifier: MIT
#include "physics/pairs/pair_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace furrow::physics {
namespace {

constexpr int group_size = 8;       // triangles
constexpr double come_apart = 1.5;  // spread of groups, over that when they were made
struct Centre {
  std::array<float, 3> at;
  int triangle;
};

std::vector<Centre> centres_of(const PairMesh& mesh, const FloatSweep& sweep) {
  std::vector<Centre> centres;
  centres.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const Float4 sum =
        sweep.at[std::size_t(v[0])] + sweep.at[std::size_t(v[1])] + sweep.at[std::size_t(v[2])];
    const bool known = std::isfinite(sum[0]) && std::isfinite(sum[1]) && std::isfinite(sum[2]);
    centres.push_back({known ? std::array{sum[0], sum[1], sum[2]} : std::array{0.0f, 0.0f, 0.0f}, int(t)});
  }
  return centres;
}

/// Puts neighbours next to each other: cuts across the longest side, a power of two groups in the first part.
void put_in_order(std::span<Centre> centres) {
  const int n = int(centres.size());
  if (n <= group_size) return;
  std::array<float, 3> low = centres[0].at, high = low;
  for (const Centre& c : centres)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], c.at[k]);
      high[k] = std::max(high[k], c.at[k]);
    }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  int part = group_size;
  while (2 * part < n) part *= 2;
  std::nth_element(centres.begin(), centres.begin() + part, centres.end(),
                   [axis](const Centre& a, const Centre& b) {
                     return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.triangle < b.triangle;
                   });
  put_in_order(centres.first(std::size_t(part)));
  put_in_order(centres.subspan(std::size_t(part)));
}

/// Takes those of the numbers that no group took, for this one.
template <std::size_t k>
void take_new(const std::array<int, k>& numbers, int group, std::vector<int>& group_of,
              std::vector<int>& list) {
  for (const int i : numbers) {
    if (group_of[std::size_t(i)] >= 0) continue;
    group_of[std::size_t(i)] = group;
    list.push_back(i);
  }
}

void sort_by_group(std::vector<int>& numbers, const std::vector<int>& group_of) {
  std::sort(numbers.begin(), numbers.end(), [&](int a, int b) {
    const int g = group_of[std::size_t(a)], h = group_of[std::size_t(b)];
    return g != h ? g < h : a < b;
  });
}

/// Of numbers in the order of their groups; none: beyond all groups.
int first_group(std::span<const int> numbers, const std::vector<int>& group_of) {
  return numbers.empty() ? std::numeric_limits<int>::max() : group_of[std::size_t(numbers[0])];
}

/// The first of them, which are of this group.
std::span<const int> of_group(std::span<const int> numbers, const std::vector<int>& group_of, int group) {
  std::size_t n = 0;
  while (n < numbers.size() && group_of[std::size_t(numbers[n])] == group) ++n;
  return numbers.first(n);
}

/// A vertex has itself as vertex.
struct Itself {
  std::array<int, 1> operator[](std::size_t i) const { return {int(i)}; }
};

/// Rows of numbers and of the knots of their vertices, -1 where there are no more.
template <class Primitives, class Fours>
void add_fours(std::span<const int> numbers, std::size_t rows, const Primitives& primitives,
               const std::vector<int>& knot, Fours& fours) {
  constexpr Int4 none{-1, -1, -1, -1};
  for (std::size_t row = 0; row < rows; ++row) {
    fours.numbers.push_back(none);
    fours.vertices.emplace_back().fill(none);
    for (std::size_t i = 4 * row; i < std::min(numbers.size(), 4 * row + 4); ++i) {
      fours.numbers.back()[i % 4] = numbers[i];
      const auto v = primitives[std::size_t(numbers[i])];
      for (std::size_t j = 0; j < v.size(); ++j) fours.vertices.back()[j][i % 4] = knot[std::size_t(v[j])];
    }
  }
}

}  // namespace

/// `triangles`: eight at most; they always fill two fours.
void PairSearch::add_group(std::span<const int> triangles, std::span<const int> edges,
                           std::span<const int> vertices) {
  add_fours(edges, rows_of(edges.size()), mesh_->edges, mesh_->knot, edges_);
  add_fours(vertices, rows_of(vertices.size()), Itself{}, mesh_->knot, vertices_);
  add_fours(triangles, 2, mesh_->triangles, mesh_->knot, triangles_);
  fours_of_edges_.push_back(int(edges_.numbers.size()));
  fours_of_vertices_.push_back(int(vertices_.numbers.size()));
}

void PairSearch::make_groups(const FloatSweep& sweep) {
  const PairMesh& m = *mesh_;
  std::vector<Centre> order = centres_of(m, sweep);
  put_in_order(order);
  *this = PairSearch(m);
  edge_group_.assign(m.edges.size(), -1);
  vertex_group_.assign(m.radius.size(), -1);
  triangle_group_.assign(m.triangles.size(), -1);
  std::vector<int> triangles, edges, vertices;
  for (std::size_t i = 0; i < order.size(); i += group_size) {
    triangles.clear();
    edges.clear();
    vertices.clear();
    for (std::size_t j = i; j < std::min(order.size(), i + group_size); ++j) {
      const int t = order[j].triangle;
      triangles.push_back(t);
      triangle_group_[std::size_t(t)] = groups();
      take_new(m.triangle_edges[std::size_t(t)], groups(), edge_group_, edges);
      take_new(m.triangles[std::size_t(t)], groups(), vertex_group_, vertices);
    }
    add_group(triangles, edges, vertices);
  }
}

PairSearch PairSearch::among(std::vector<int> edges, std::vector<int> vertices, std::vector<int> triangles,
                             const FloatSweep& sweep, double margin) const {
  PairSearch part(*mesh_);
  sort_by_group(edges, edge_group_);
  sort_by_group(vertices, vertex_group_);
  sort_by_group(triangles, triangle_group_);
  std::span<const int> e = edges, v = vertices, t = triangles;
  while (!e.empty() || !v.empty() || !t.empty()) {
    const int g = std::min(
        {first_group(e, edge_group_), first_group(v, vertex_group_), first_group(t, triangle_group_)});
    const auto es = of_group(e, edge_group_, g), vs = of_group(v, vertex_group_, g),
               ts = of_group(t, triangle_group_, g);
    part.add_group(ts, es, vs);
    e = e.subspan(es.size());
    v = v.subspan(vs.size());
    t = t.subspan(ts.size());
  }
  part.refit(sweep, margin);
  return part;
}

template <std::size_t k>
void PairSearch::place_fours(const FloatSweep& sweep, const std::vector<double>& radius, double margin,
                             Fours<k>& fours) const {
  fours.boxes.resize(fours.numbers.size());
  for (std::size_t i = 0; i < fours.numbers.size(); ++i) {
    std::array<LaneBox, 4> four;
    for (std::size_t j = 0; j < 4; ++j) {
      const int number = fours.numbers[i][j];
      four[j] = number < 0
                    ? empty_box()
                    : sweep.box(fours.corners(int(4 * i + j)), float(radius[std::size_t(number)] + margin));
    }
    fours.boxes[i] = FourBoxes::of(four);
  }
}

std::vector<FourBoxes> PairSearch::group_boxes() const {
  std::vector<FourBoxes> boxes(rows_of(std::size_t(groups())));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    std::array<LaneBox, 4> four;
    for (std::size_t j = 0; j < 4; ++j) {
      const std::size_t g = 4 * i + j;
      four[j] = empty_box();
      if (g >= std::size_t(groups())) continue;
      FourBoxes all = triangles_.boxes[2 * g];
      all.add(triangles_.boxes[2 * g + 1]);
      for (int f = fours_of_edges_[g]; f < fours_of_edges_[g + 1]; ++f) all.add(edges_.boxes[std::size_t(f)]);
      for (int f = fours_of_vertices_[g]; f < fours_of_vertices_[g + 1]; ++f)
        all.add(vertices_.boxes[std::size_t(f)]);
      four[j] = all.all();
    }
    boxes[i] = FourBoxes::of(four);
  }
  return boxes;
}

/// The sum of the groups' longest sides, without margins and ways [m].
double PairSearch::spread(const FloatSweep& sweep) const {
  double sum = 0;
  for (std::size_t g = 0; g + 1 < triangles_.vertices.size(); g += 2) {
    LaneBox box = empty_box();
    for (std::size_t f = g; f < g + 2; ++f)
      for (const Int4& v : triangles_.vertices[f])
        for (std::size_t j = 0; j < 4; ++j)
          if (v[j] >= 0)
            box = {min(box.low, sweep.at[std::size_t(v[j])]), max(box.high, sweep.at[std::size_t(v[j])])};
    const Float4 side = box.high - box.low;
    sum += double(std::max({side[0], side[1], side[2]}));
  }
  return sum;
}

void PairSearch::place(const FloatSweep& sweep, double margin) {
  if (spread_ < 0 || !(spread(sweep) <= come_apart * spread_)) {
    make_groups(sweep);
    spread_ = spread(sweep);
  }
  refit(sweep, margin);
}

void PairSearch::refit(const FloatSweep& sweep, double margin) {
  place_fours(sweep, mesh_->edge_radius, margin, edges_);
  place_fours(sweep, mesh_->radius, margin, vertices_);
  place_fours(sweep, mesh_->triangle_radius, margin, triangles_);
  tree_.assign(group_boxes());
}

}  // namespace furrow::physics
