// SPDX-License-Identifier: MIT
#include "physics/pairs/pair_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "physics/base/require.h"

namespace furrow::physics {
namespace {

constexpr double share_of_altitude = 0.25;
constexpr double no_length = 1e-9;  // [m] of a spring that joins its ends

using Edge = std::array<int, 2>;
struct KnownLength {
  Edge edge;
  double length;
};

Edge ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Sorted by edge; of several for one edge that of the first kind, and of one kind the least, comes first.
std::vector<KnownLength> known_lengths(const Cloth& cloth) {
  std::vector<KnownLength> known;
  const auto sorted_from = [&known](std::size_t begin) {
    std::sort(known.begin() + std::ptrdiff_t(begin), known.end(), [](const auto& a, const auto& b) {
      return a.edge != b.edge ? a.edge < b.edge : a.length < b.length;
    });
  };
  for (const MembraneTriangle& t : cloth.membrane)
    for (std::size_t i = 0; i < 3; ++i)
      known.push_back({ordered(t.vertices[(i + 1) % 3], t.vertices[(i + 2) % 3]), t.rest_lengths[i]});
  sorted_from(0);
  std::size_t begin = known.size();
  for (const Spring& s : cloth.structural) known.push_back({ordered(s.a, s.b), s.rest_length});
  sorted_from(begin);
  begin = known.size();
  for (const Tension& t : cloth.tension) known.push_back({ordered(t.a, t.b), t.rest_length});
  sorted_from(begin);
  std::stable_sort(known.begin(), known.end(),
                   [](const KnownLength& a, const KnownLength& b) { return a.edge < b.edge; });
  return known;
}

void find_edges(PairMesh& mesh, const Cloth& cloth) {
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) mesh.edges.push_back(ordered(t[i], t[(i + 1) % 3]));
  std::sort(mesh.edges.begin(), mesh.edges.end());
  mesh.edges.erase(std::unique(mesh.edges.begin(), mesh.edges.end()), mesh.edges.end());
  const std::vector<KnownLength> known = known_lengths(cloth);
  double sum = 0;
  for (const Edge& e : mesh.edges) {
    const auto at = std::lower_bound(known.begin(), known.end(), e,
                                     [](const KnownLength& k, const Edge& edge) { return k.edge < edge; });
    const auto& x = cloth.particles.x;
    const bool is_known = at != known.end() && at->edge == e;
    mesh.rest_lengths.push_back(is_known ? at->length : (x[std::size_t(e[1])] - x[std::size_t(e[0])]).norm());
    sum += mesh.rest_lengths.back();
  }
  mesh.mean_edge = mesh.edges.empty() ? 0 : sum / double(mesh.edges.size());
}

/// The least altitude of a triangle with such sides; 0 if there is none.
double least_altitude(std::array<double, 3> l) {
  std::sort(l.begin(), l.end());
  const double s = 0.5 * (l[0] + l[1] + l[2]);
  const double area2 = s * (s - l[0]) * (s - l[1]) * (s - l[2]);
  return area2 > 0 && l[2] > 0 ? 2 * std::sqrt(area2) / l[2] : 0;
}

/// Which edges triangles have, and which triangles are around a vertex.
void find_neighbours(PairMesh& mesh) {
  const std::size_t n = mesh.radius.size();
  std::vector<int> first(n + 1, 0);
  for (const Edge& e : mesh.edges) ++first[std::size_t(e[0]) + 1];
  for (std::size_t v = 0; v < n; ++v) first[v + 1] += first[v];
  mesh.around_begin.assign(n + 1, 0);
  for (const auto& t : mesh.triangles) {
    std::array<int, 3> edges;
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge edge = ordered(t[i], t[(i + 1) % 3]);
      edges[i] = first[std::size_t(edge[0])];
      while (mesh.edges[std::size_t(edges[i])] != edge) ++edges[i];
      ++mesh.around_begin[std::size_t(t[i]) + 1];
    }
    mesh.triangle_edges.push_back(edges);
  }
  for (std::size_t v = 0; v < n; ++v) mesh.around_begin[v + 1] += mesh.around_begin[v];
  std::vector<int> next(mesh.around_begin.begin(), mesh.around_begin.end() - 1);
  mesh.around.resize(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int v : mesh.triangles[t]) mesh.around[std::size_t(next[std::size_t(v)]++)] = int(t);
}

/// Which vertices springs without length hold together.
void find_knots(PairMesh& mesh, const Cloth& cloth) {
  std::vector<int>& knot = mesh.knot;
  knot.resize(cloth.particles.size());
  std::iota(knot.begin(), knot.end(), 0);
  const auto lowest = [&](int v) {
    while (knot[std::size_t(v)] != v) v = knot[std::size_t(v)] = knot[std::size_t(knot[std::size_t(v)])];
    return v;
  };
  for (const Spring& s : cloth.bending) {
    if (s.rest_length > no_length) continue;
    const int a = lowest(s.a), b = lowest(s.b);
    knot[std::size_t(std::max(a, b))] = std::min(a, b);
  }
  for (int& v : knot) v = lowest(v);
}

void find_radii(PairMesh& mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const auto length = [&](std::size_t k) {
      return mesh.rest_lengths[std::size_t(mesh.triangle_edges[i][k])];
    };
    const double altitude = least_altitude({length(0), length(1), length(2)});
    for (const int v : t) {
      double& r = mesh.radius[std::size_t(v)];
      r = std::min(r, share_of_altitude * altitude);
      mesh.used[std::size_t(v)] = 1;
    }
  }
  const auto& r = mesh.radius;
  for (const Edge& e : mesh.edges)
    mesh.edge_radius.push_back(std::min(r[std::size_t(e[0])], r[std::size_t(e[1])]));
  for (const auto& t : mesh.triangles)
    mesh.triangle_radius.push_back(
        std::min({r[std::size_t(t[0])], r[std::size_t(t[1])], r[std::size_t(t[2])]}));
  for (std::size_t v = 0; v < r.size(); ++v)
    if (mesh.used[v]) mesh.largest_radius = std::max(mesh.largest_radius, r[v]);
}

}  // namespace

PairMesh pair_mesh(const Cloth& cloth, double thickness, std::span<const double> thicknesses) {
  require("pair_mesh", "thickness", thickness, thickness > 0, "> 0");
  const std::size_t n = cloth.particles.size(), own = thicknesses.size();
  if (own != 0 && own != n) refuse("pair_mesh", own, " thicknesses of ", n, " particles");
  for (const double t : thicknesses) require("pair_mesh", "thicknesses", t, t > 0, "> 0");
  for (const auto& t : cloth.triangles)
    for (const int v : t)
      if (v < 0 || std::size_t(v) >= n) refuse("pair_mesh", "a triangle names particle ", v, " of ", n);
  PairMesh mesh;
  mesh.triangles = cloth.triangles;
  mesh.radius.assign(n, 0.5 * thickness);
  for (std::size_t v = 0; v < own; ++v) mesh.radius[v] = 0.5 * thicknesses[v];
  mesh.used.assign(n, 0);
  for (const double w : cloth.particles.inv_mass) mesh.held.push_back(!(w > 0));
  find_edges(mesh, cloth);
  find_neighbours(mesh);
  find_knots(mesh, cloth);
  find_radii(mesh);
  return mesh;
}

}  // namespace furrow::physics
