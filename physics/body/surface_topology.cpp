// SPDX-License-Identifier: MIT
#include "physics/body/surface_topology.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace furrow::physics {
namespace {

struct HalfEdge {
  int low, high;  ///< its vertices, sorted
  int triangle;
  int side;  ///< 0: corners 0-1, 1: 1-2, 2: 2-0
  bool forwards;
};

void merge_vertices(const TriangleMesh& mesh, SurfaceTopology& s) {
  std::vector<int> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto less = [&](int i, int j) {
    const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j];
    if (a[0] != b[0]) return a[0] < b[0];
    if (a[1] != b[1]) return a[1] < b[1];
    return a[2] < b[2];
  };
  // an unused vertex may be NaN, which has no order
  std::erase_if(order, [&](int i) { return !mesh.vertices[i].allFinite(); });
  std::sort(order.begin(), order.end(), less);
  std::vector<int> merged(mesh.vertices.size(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && less(order[i - 1], order[i])) ++s.vertices;
    merged[order[i]] = s.vertices;
  }
  ++s.vertices;
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
    s.sound[t] = cross.norm() > 1e-9 * longest2;
    if (!s.sound[t]) continue;
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

void find_unsound(SurfaceTopology& s) {
  std::vector<int> uses(s.vertices, 0), fan(s.vertices, -1);
  for (const auto& t : s.triangles)
    for (int v : t) ++uses[v];
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const auto& [a, b, c] = s.triangles[t];
    if (a == b || b == c || c == a) continue;
    for (int k = 0; k < 3; ++k) {
      const int v = s.triangles[t][k];
      if (fan[v] < 0) fan[v] = fan_size(s, static_cast<int>(t), k);
      if (fan[v] != uses[v] || s.neighbours[t][k] == SurfaceTopology::none) s.sound[t] = 0;
    }
  }
}

}  // namespace

SurfaceTopology surface_topology(const TriangleMesh& mesh) {
  SurfaceTopology s;
  merge_vertices(mesh, s);
  add_normals(mesh, s);
  join_neighbours(s);
  find_unsound(s);
  return s;
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
