// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/marching.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace furrow::meshes {
namespace {

using geometry::Mesh;
using geometry::Point;
using geometry::Vertex;
using Corner = std::array<int, 3>;  // of the lattice

/// The six ways from a cube's lowest corner to its highest along its edges. Each passes the four corners of a
/// tetrahedron.
constexpr std::array<std::array<int, 3>, 6> ways{
    {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};

class Marcher {
 public:
  Marcher(const Solid& solid, const Vec& low, const Vec& high, double cell)
      : solid_(solid), low_(low), cell_(cell) {
    for (int k = 0; k < 3; ++k) size_[k] = static_cast<int>(std::ceil((high[k] - low[k]) / cell)) + 1;
    value_.reserve(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2]);
    for_corners(size_, [&](const Corner& c) { value_.push_back(solid(at(c))); });
  }

  Mesh march() {
    for_corners({size_[0] - 1, size_[1] - 1, size_[2] - 1}, [&](const Corner& c) {
      if (!crossed(c)) return;
      for (const auto& way : ways) {
        std::array<Corner, 4> tetrahedron{c, c, c, c};
        for (int i = 0; i < 3; ++i)
          for (int j = i + 1; j < 4; ++j) ++tetrahedron[j][way[i]];
        add(tetrahedron);
      }
    });
    return std::move(mesh_);
  }

 private:
  template <class Visit>
  static void for_corners(const Corner& size, const Visit& visit) {
    for (int k = 0; k < size[2]; ++k)
      for (int j = 0; j < size[1]; ++j)
        for (int i = 0; i < size[0]; ++i) visit(Corner{i, j, k});
  }
  Vec at(const Corner& c) const { return low_ + cell_ * Vec(c[0], c[1], c[2]); }
  std::size_t index(const Corner& c) const {
    return (static_cast<std::size_t>(c[2]) * size_[1] + c[1]) * size_[0] + c[0];
  }
  bool inside(const Corner& c) const { return value_[index(c)] < 0; }
  bool crossed(const Corner& c) const {
    for (int corner = 1; corner < 8; ++corner)
      if (inside({c[0] + (corner & 1), c[1] + (corner >> 1 & 1), c[2] + (corner >> 2)}) != inside(c))
        return true;
    return false;
  }

  /// Where the surface crosses the edge from an inner corner to an outer one, by bisection; never so near a
  /// corner that a triangle loses its area.
  Vertex crossing(const Corner& in, const Corner& out) {
    const auto [found, is_new] = crossings_.try_emplace({index(in), index(out)});
    if (!is_new) return found->second;
    const Vec a = at(in), b = at(out);
    double below = 0, above = 1;
    for (int step = 0; step < 20; ++step) {
      const double middle = (below + above) / 2;
      (solid_(a + middle * (b - a)) < 0 ? below : above) = middle;
    }
    const Vec p = a + std::clamp(below, 0.05, 0.95) * (b - a);
    return found->second = mesh_.add_vertex({p.x(), p.y(), p.z()});
  }

  /// One or two triangles between the inner and the outer corners.
  void add(std::array<Corner, 4> t) {
    const auto outer = std::stable_partition(t.begin(), t.end(), [&](const Corner& c) { return inside(c); });
    const auto count = outer - t.begin();
    if (count == 0 || count == 4) return;
    const Vec outward = at(t[3]) - at(t[0]);
    if (count == 2) {
      const Vertex a = crossing(t[0], t[2]), b = crossing(t[0], t[3]), c = crossing(t[1], t[3]),
                   d = crossing(t[1], t[2]);
      add(a, b, c, outward);
      add(a, c, d, outward);
    } else if (count == 1) {
      add(crossing(t[0], t[1]), crossing(t[0], t[2]), crossing(t[0], t[3]), outward);
    } else {
      add(crossing(t[0], t[3]), crossing(t[1], t[3]), crossing(t[2], t[3]), outward);
    }
  }
  void add(Vertex a, Vertex b, Vertex c, const Vec& outward) {
    const geometry::Vector n =
        CGAL::cross_product(mesh_.point(b) - mesh_.point(a), mesh_.point(c) - mesh_.point(a));
    if (n * geometry::Vector(outward.x(), outward.y(), outward.z()) > 0)
      mesh_.add_face(a, b, c);
    else
      mesh_.add_face(a, c, b);
  }

  const Solid& solid_;
  Vec low_;
  double cell_;
  Corner size_;
  std::vector<double> value_;
  std::map<std::pair<std::size_t, std::size_t>, Vertex> crossings_;
  Mesh mesh_;
};

}  // namespace

Mesh march(const Solid& solid, const Vec& low, const Vec& high, double cell) {
  return Marcher(solid, low, high, cell).march();
}

}  // namespace furrow::meshes
