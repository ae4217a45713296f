// SPDX-License-Identifier: MIT
#include "physics/body/surface_topology.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

namespace furrow::physics {
namespace {

struct HalfEdge {
  int low, high;  ///< its vertices, sorted
  int triangle;
  int side;  ///< 0: corners 0-1, 1: 1-2, 2: 2-0
  bool forwards;
};

std::size_t hash_of(const Vec3& place) {
  std::uint64_t sum = 0;
  for (const double c : place) {
    sum = (sum ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15ull;  // never -0
    sum ^= sum >> 29;
  }
  return sum;
}

/// Numbers places in the order in which vertices name them first. Unused vertices may be NaN: they have none.
void merge_vertices(const TriangleMesh& mesh, SurfaceTopology& s) {
  const std::vector<Vec3>& x = mesh.vertices;
  const std::size_t mask = std::bit_ceil(2 * x.size() + 2) - 1;
  std::vector<int> first(mask + 1, -1), merged(x.size(), 0);
  s.vertices = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!x[i].allFinite()) continue;
    std::size_t at = hash_of(x[i]) & mask;
    while (first[at] >= 0 && x[std::size_t(first[at])] != x[i]) at = (at + 1) & mask;
    if (first[at] < 0) first[at] = static_cast<int>(i), merged[i] = s.vertices++;
    merged[i] = merged[std::size_t(first[at])];
  }
  s.triangles.clear();
  s.triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) s.triangles.push_back({merged[a], merged[b], merged[c]});
}

void add_normals(const TriangleMesh& mesh, SurfaceTopology& s) {
  s.corner_normals.assign(s.vertices, Vec3::Zero());
  s.normals.assign(s.triangles.size(), Vec3::Zero());
  s.sound.assign(s.triangles.size(), 0);
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    std::array<Vec3, 3> p;
    for (int c = 0; c < 3; ++c) p[c] = mesh.vertices[mesh.triangles[t][c]];
    const Vec3 cross = (p[1] - p[0]).cross(p[2] - p[0]);
    const double longest2 =
        std::max({(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm()});
    if (!(cross.norm() > 1e-9 * longest2)) continue;
    s.sound[t] = s.joined[t];
    s.normals[t] = cross.normalized();
    for (int c = 0; c < 3; ++c) {
      const Vec3 e = p[(c + 1) % 3] - p[c], f = p[(c + 2) % 3] - p[c];
      s.corner_normals[s.triangles[t][c]] += std::atan2(e.cross(f).norm(), e.dot(f)) * s.normals[t];
    }
  }
}

std::vector<HalfEdge> sorted_half_edges(const SurfaceTopology& s) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * s.triangles.size());
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const auto& [a, b, c] = s.triangles[t];
    if (a == b || b == c || c == a) continue;
    for (int k = 0; k < 3; ++k) {
      const int i = s.triangles[t][k], j = s.triangles[t][(k + 1) % 3];
      edges.push_back({std::min(i, j), std::max(i, j), static_cast<int>(t), k, i < j});
    }
  }
  std::vector<int> first(s.vertices + 1, 0);  // by counting on `low`, then each short run by the rest
  for (const HalfEdge& e : edges) ++first[e.low + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<HalfEdge> sorted(edges.size());
  std::vector<int> at(first.begin(), first.end() - 1);
  for (const HalfEdge& e : edges) sorted[at[e.low]++] = e;
  for (int v = 0; v < s.vertices; ++v)
    std::stable_sort(sorted.begin() + first[v], sorted.begin() + first[v + 1],
                     [](const HalfEdge& x, const HalfEdge& y) { return x.high < y.high; });
  return sorted;
}

void join_neighbours(SurfaceTopology& s) {
  s.neighbours.assign(s.triangles.size(),
                      {SurfaceTopology::none, SurfaceTopology::none, SurfaceTopology::none});
  s.closed = true;
  s.border_edges = s.irregular_edges = 0;
  const std::vector<HalfEdge> edges = sorted_half_edges(s);
  for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
    int balance = 0;
    for (; j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high; ++j)
      balance += edges[j].forwards ? 1 : -1;
    s.closed = s.closed && balance == 0;
    if (j - i == 2 && balance == 0) {
      s.neighbours[edges[i].triangle][edges[i].side] = edges[i + 1].triangle;
      s.neighbours[edges[i + 1].triangle][edges[i + 1].side] = edges[i].triangle;
    } else {
      ++(j - i == 1 ? s.border_edges : s.irregular_edges);
    }
  }
}

/// Number of triangles met when one walks around corner c of triangle t; 0 at a border.
int fan_size(const SurfaceTopology& s, int t, int c) {
  const int v = s.triangles[t][c];
  int size = 0;
  for (int at = t;; ++size) {
    const auto& corners = s.triangles[at];
    const int k = corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
    if (size > 0 && at == t) return size;
    at = s.neighbours[at][k];
    if (at == SurfaceTopology::none) return 0;
  }
}

void find_joined(SurfaceTopology& s) {
  s.joined.assign(s.triangles.size(), 0);
  std::vector<int> uses(s.vertices, 0), fan(s.vertices, -1);
  for (const auto& t : s.triangles)
    for (int v : t) ++uses[v];
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const auto& [a, b, c] = s.triangles[t];
    if (a == b || b == c || c == a) continue;
    s.joined[t] = 1;
    for (int k = 0; k < 3; ++k) {
      const int v = s.triangles[t][k];
      if (fan[v] < 0) fan[v] = fan_size(s, static_cast<int>(t), k);
      if (fan[v] != uses[v] || s.neighbours[t][k] == SurfaceTopology::none) s.joined[t] = 0;
    }
  }
}

}  // namespace

SurfaceTopology surface_topology(const TriangleMesh& mesh) {
  SurfaceTopology s;
  move_vertices(s, mesh);
  return s;
}

void move_vertices(SurfaceTopology& s, const TriangleMesh& mesh) {
  const std::vector<std::array<int, 3>> before = std::move(s.triangles);
  merge_vertices(mesh, s);
  if (s.triangles != before) {
    join_neighbours(s);
    find_joined(s);
  }
  add_normals(mesh, s);
}

Vec3 pseudonormal(const SurfaceTopology& s, int triangle, Feature feature) {
  if (feature == Feature::face) return s.normals[triangle];
  const int k = static_cast<int>(feature);
  if (feature >= Feature::corner0)
    return s.corner_normals[s.triangles[triangle][k - static_cast<int>(Feature::corner0)]];
  const int other = s.neighbours[triangle][k - static_cast<int>(Feature::edge01)];
  return other == SurfaceTopology::none ? s.normals[triangle] : Vec3(s.normals[triangle] + s.normals[other]);
}

}  // namespace furrow::physics
