// SPDX-License-Identifier: MIT
#include "physics/plate/plate_net.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "physics/base/require.h"

namespace furrow::physics {
namespace {

using Eigen::Vector2d;

constexpr double least_height = 1e-4, no_height = 1e-8;  // over the longest edge [-]

/// A triangle's edge, from `from` to `to`.
struct DirectedEdge {
  int from, to, triangle, edge;
};

/// Kahan's stable form of Heron's formula; 0 if the lengths make no triangle.
double area_of(std::array<double, 3> l) {
  std::sort(l.begin(), l.end(), std::greater<>());
  const auto [a, b, c] = l;
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return product > 0 ? 0.25 * std::sqrt(product) : 0;
}

PlateNet::Triangle triangle_at_rest(const PlateSheet& sheet, std::size_t t) {
  PlateNet::Triangle result;
  result.length = sheet.rest_lengths[t];
  for (const double l : result.length) require("plate", "a rest length", l, l > 0, "> 0");
  const double longest = *std::max_element(result.length.begin(), result.length.end());
  const double area = area_of(result.length), height = 2 * area / longest;
  result.area = height > no_height * longest ? area : 0;
  result.sliver = height < least_height * longest;
  const auto& v = sheet.triangles[t];
  result.held = std::all_of(v.begin(), v.end(), [&](int i) { return sheet.inv_mass[std::size_t(i)] == 0; });
  return result;
}

void check(const PlateSheet& s) {
  const char* const me = "plate";
  if (s.rest_lengths.size() != s.triangles.size())
    refuse(me, s.triangles.size(), " triangles, but the lengths of ", s.rest_lengths.size());
  if (!s.apart.empty() && s.apart.size() != s.hinges.size())
    refuse(me, s.hinges.size(), " hinges, but ", s.apart.size(), " marks");
  if (!s.press.empty() && s.press.size() != s.hinges.size())
    refuse(me, s.hinges.size(), " hinges, but ", s.press.size(), " presses");
  for (const double p : s.press) require(me, "press", p, p >= 0, ">= 0");
  for (const auto& t : s.triangles)
    for (const int v : t)
      if (v < 0 || std::size_t(v) >= s.inv_mass.size())
        refuse(me, "a triangle names particle ", v, " of ", s.inv_mass.size());
}

std::vector<DirectedEdge> sorted_edges(std::span<const std::array<int, 3>> triangles) {
  std::vector<DirectedEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int i = 0; i < 3; ++i)
      edges.push_back(
          {triangles[t][std::size_t((i + 1) % 3)], triangles[t][std::size_t((i + 2) % 3)], int(t), i});
  std::sort(edges.begin(), edges.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
    return std::tie(a.from, a.to, a.triangle) < std::tie(b.from, b.to, b.triangle);
  });
  return edges;
}

/// The one triangle's edge from a to b; null: there is none, or there are several.
const DirectedEdge* only_edge(const std::vector<DirectedEdge>& edges, int from, int to) {
  const auto less = [](const DirectedEdge& e, const std::pair<int, int>& key) {
    return std::pair(e.from, e.to) < key;
  };
  const auto at = std::lower_bound(edges.begin(), edges.end(), std::pair(from, to), less);
  const auto is = [&](auto e) { return e != edges.end() && e->from == from && e->to == to; };
  return is(at) && !is(at + 1) ? &*at : nullptr;
}

}  // namespace

PlateNet plate_net(const PlateSheet& sheet) {
  check(sheet);
  PlateNet net;
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t)
    net.triangles.push_back(triangle_at_rest(sheet, t));
  const std::vector<DirectedEdge> edges = sorted_edges(sheet.triangles);
  for (std::size_t h = 0; h < sheet.hinges.size(); ++h) {
    const auto& [a, b, left, right] = sheet.hinges[h].vertices;
    PlateNet::Joint& joint = net.joints.emplace_back();
    const DirectedEdge *there = only_edge(edges, a, b), *back = only_edge(edges, b, a);
    if ((!sheet.apart.empty() && sheet.apart[h]) || !there || !back) continue;
    const auto apex = [&](const DirectedEdge& e) {
      return sheet.triangles[std::size_t(e.triangle)][std::size_t(e.edge)];
    };
    if (apex(*there) != left || apex(*back) != right) continue;
    PlateNet::Triangle &t = net.triangles[std::size_t(there->triangle)],
                       &u = net.triangles[std::size_t(back->triangle)];
    if (t.area == 0 || u.area == 0 || (t.held && u.held)) continue;
    if (t.hinge[std::size_t(there->edge)] >= 0) continue;  // a second hinge on one edge
    joint = {{{{there->triangle, there->edge}, {back->triangle, back->edge}}}, true};
    t.hinge[std::size_t(there->edge)] = u.hinge[std::size_t(back->edge)] = int(h);
  }
  return net;
}

FlatTriangle unfold(const PlateNet::Triangle& t, int edge, const Vector2d& a, const Vector2d& b) {
  const std::size_t i = std::size_t(edge), j = (i + 1) % 3, k = (i + 2) % 3;  // the edge runs from j to k
  const double l = t.length[i],
               along = (l * l + t.length[k] * t.length[k] - t.length[j] * t.length[j]) / (2 * l);
  const Vector2d u = (b - a).normalized(), left(-u.y(), u.x());
  FlatTriangle corners;
  corners[j] = a;
  corners[k] = a + l * u;
  corners[i] = a + along * u + 2 * t.area / l * left;
  return corners;
}

Eigen::Vector3d edge_turn(const FlatTriangle& corners, double area, int edge) {
  const Vector2d middle = (corners[0] + corners[1] + corners[2]) / 3;
  const auto outward = [&](std::size_t k) {  // times the length
    const Vector2d d = corners[(k + 2) % 3] - corners[(k + 1) % 3];
    return Vector2d(d.y(), -d.x());
  };
  const std::size_t i = std::size_t(edge);
  const Vector2d n = outward(i).normalized();
  const Vector2d m = 0.5 * (corners[(i + 1) % 3] + corners[(i + 2) % 3]) - middle;
  Eigen::Vector3d turn(n.x() * m.x(), n.y() * m.y(), n.x() * m.y() + n.y() * m.x());
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector2d p = corners[k] - middle;
    const double slope = -n.dot(outward(k)) / (2 * area);  // of the linear interpolant, of one corner
    turn -= slope * Eigen::Vector3d(0.5 * p.x() * p.x(), 0.5 * p.y() * p.y(), p.x() * p.y());
  }
  return turn;
}

}  // namespace furrow::physics
