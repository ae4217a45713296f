// SPDX-License-Identifier: MIT
#include "physics/pairs/edge_face_crossings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/pairs/box_tree.h"
#include "physics/pairs/pair_distance.h"

namespace furrow::physics {
namespace {

constexpr double sign_in_doubt = 1e-13;  // of a volume, over the product of its sides

/// Sign of the volume of the tetrahedron that v makes with three sides; 0: rounding may have made it.
int side_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double volume = a.dot(b.cross(c));
  const double doubt = sign_in_doubt * std::sqrt(a.squaredNorm() * b.squaredNorm() * c.squaredNorm());
  return volume > doubt ? 1 : volume < -doubt ? -1 : 0;
}

/// Of an edge and a triangle, to rounding.
bool touches(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  double least = std::min(vertex_triangle_distance(p, a, b, c).squared(),
                          vertex_triangle_distance(q, a, b, c).squared());
  least = std::min({least, edge_edge_distance(p, q, a, b).squared(), edge_edge_distance(p, q, b, c).squared(),
                    edge_edge_distance(p, q, c, a).squared()});
  return least <= sign_in_doubt * ((q - p).squaredNorm() + (b - a).squaredNorm() + (c - a).squaredNorm());
}

bool crosses(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int start = side_of(a - p, b - p, c - p), end = side_of(a - q, b - q, c - q);
  if (start * end > 0) return false;
  const Vec3 pq = q - p;
  const int ab = side_of(pq, a - p, b - p), bc = side_of(pq, b - p, c - p), ca = side_of(pq, c - p, a - p);
  if (!(ab >= 0 && bc >= 0 && ca >= 0) && !(ab <= 0 && bc <= 0 && ca <= 0)) return false;
  const bool in_doubt = start * end == 0 || ab * bc * ca == 0;  // all signs may be rounding where all is flat
  return !in_doubt || touches(p, q, a, b, c);
}

/// Numbers of edges so that neighbours stand next to each other: sorted by the bits of their middles'
/// coordinates, those of the three axes in turns (a Z-order curve).
std::vector<int> along_a_curve(const std::vector<std::array<int, 2>>& edges, const FloatSweep& sweep) {
  LaneBox all = empty_box();
  for (const Float4& p : sweep.at) all = {min(all.low, p), max(all.high, p)};
  const Float4 side = all.high - all.low;
  const float longest = std::max({side[0], side[1], side[2]}), scale = longest > 0 ? 1023 / longest : 0;
  std::vector<std::pair<std::uint32_t, int>> keyed;
  for (const auto& [a, b] : edges) {
    const Float4 middle = 0.5f * (sweep.at[std::size_t(a)] + sweep.at[std::size_t(b)]) - all.low;
    std::uint32_t key = 0;
    for (int bit = 9; bit >= 0; --bit)
      for (int axis = 0; axis < 3; ++axis) key = key << 1 | (std::uint32_t(middle[axis] * scale) >> bit & 1);
    keyed.emplace_back(key, int(keyed.size()));
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<int> order;
  for (const auto& [key, edge] : keyed) order.push_back(edge);
  return order;
}

}  // namespace

std::vector<EdgeFaceCrossing> edge_face_crossings(const PairMesh& mesh, std::span<const Vec3> x) {
  std::vector<EdgeFaceCrossing> found;
  if (mesh.edges.empty()) return found;
  const auto at = [&x](int v) -> const Vec3& { return x[std::size_t(v)]; };
  FloatSweep sweep;
  sweep.assign(x, {}, at(mesh.edges[0][0]));
  const std::vector<int> order = along_a_curve(mesh.edges, sweep);
  std::vector<FourBoxes> boxes;
  for (std::size_t i = 0; i < order.size(); i += 4) {
    std::array<LaneBox, 4> four;
    for (std::size_t j = 0; j < 4; ++j)
      four[j] = i + j < order.size() ? sweep.box(mesh.edges[std::size_t(order[i + j])], 0) : empty_box();
    boxes.push_back(FourBoxes::of(four));
  }
  BoxTree tree;
  tree.assign(std::move(boxes));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& f = mesh.triangles[t];
    tree.each_meeting(sweep.box(f, 0), 0, [&](int place) {
      const int number = order[std::size_t(place)];
      const auto& e = mesh.edges[std::size_t(number)];
      if (are_neighbours(mesh, e, f) || !may_touch(mesh, f[0], e[0])) return;
      if (crosses(at(e[0]), at(e[1]), at(f[0]), at(f[1]), at(f[2]))) found.push_back({number, int(t)});
    });
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

void add_pairs_of(const EdgeFaceCrossing& crossing, const PairMesh& mesh, std::vector<PairKey>& keys) {
  const auto& e = mesh.edges[std::size_t(crossing.edge)];
  const auto& t = mesh.triangles[std::size_t(crossing.triangle)];
  for (const int v : e) keys.push_back({0, v, crossing.triangle});
  for (std::size_t i = 0; i < 3; ++i) {
    const std::array<int, 2> side{std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])};
    const auto at = std::lower_bound(mesh.edges.begin(), mesh.edges.end(), side);
    const int other = int(at - mesh.edges.begin());
    keys.push_back({1, std::min(other, crossing.edge), std::max(other, crossing.edge)});
  }
}

}  // namespace furrow::physics
