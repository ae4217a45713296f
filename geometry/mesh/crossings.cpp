// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/crossings.h"

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "geometry/mesh/face_point.h"
#include "geometry/mesh/self_intersections.h"

namespace furrow::geometry {
namespace {

using Pair = std::array<Face, 2>;

/// Sets of faces that are joined one by one.
class Joined {
 public:
  explicit Joined(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Joins faces that cross, and crossing faces that share a vertex.
Joined join_places(const Mesh& mesh, const std::vector<Pair>& pairs, const std::vector<Face>& faces) {
  Joined joined(mesh.num_faces());
  for (const auto& [f, g] : pairs) joined.join(f.idx(), g.idx());
  std::vector<std::ptrdiff_t> first(mesh.num_vertices(), -1);
  for (Face f : faces)
    for (Vertex v : corners_of(mesh, f)) {
      if (first[v.idx()] >= 0) joined.join(std::size_t(first[v.idx()]), f.idx());
      first[v.idx()] = std::ptrdiff_t(f.idx());
    }
  return joined;
}

/// What is gathered of a place before it is summed up.
struct Gathered {
  CrossingPlace place;
  CGAL::Bbox_3 box;
  std::map<std::array<int, 2>, std::size_t> parts;
};

CrossingPlace sum_up(const Gathered& g) {
  CrossingPlace place = g.place;
  place.centre = {(g.box.xmin() + g.box.xmax()) / 2, (g.box.ymin() + g.box.ymax()) / 2,
                  (g.box.zmin() + g.box.zmax()) / 2};
  place.extent =
      std::max({g.box.xmax() - g.box.xmin(), g.box.ymax() - g.box.ymin(), g.box.zmax() - g.box.zmin()});
  place.parts = std::max_element(g.parts.begin(), g.parts.end(), [](const auto& a, const auto& b) {
                  return a.second < b.second;
                })->first;
  return place;
}

}  // namespace

Crossings find_crossings(const Mesh& mesh, const Parts& parts, std::span<const char> crossed) {
  return find_crossings(mesh, parts, self_intersections(mesh), crossed);
}

Crossings find_crossings(const Mesh& mesh, const Parts& parts, std::span<const std::array<Face, 2>> pairs,
                         std::span<const char> crossed) {
  Crossings result;
  result.pairs = pairs.size();
  for (const Pair& pair : pairs) result.faces.insert(result.faces.end(), pair.begin(), pair.end());
  std::sort(result.faces.begin(), result.faces.end());
  result.faces.erase(std::unique(result.faces.begin(), result.faces.end()), result.faces.end());
  const auto was_crossed = [&](Face f) {
    const auto v = corners_of(mesh, f);
    return std::any_of(v.begin(), v.end(),
                       [&](Vertex c) { return c.idx() < crossed.size() && crossed[c.idx()]; });
  };
  Joined joined = join_places(mesh, {pairs.begin(), pairs.end()}, result.faces);
  std::map<std::size_t, Gathered> places;
  for (const auto& [f, g] : pairs) {
    Gathered& at = places[joined.root(f.idx())];
    const bool old = was_crossed(f) && was_crossed(g);
    const auto [low, high] = std::minmax(parts.of_face[f.idx()], parts.of_face[g.idx()]);
    ++at.place.pairs;
    at.place.from_start += old;
    result.from_start += old;
    ++at.parts[{low, high}];
    for (Face face : {f, g})
      for (Vertex v : corners_of(mesh, face)) at.box += mesh.point(v).bbox();
  }
  for (const auto& [root, gathered] : places) result.places.push_back(sum_up(gathered));
  std::stable_sort(result.places.begin(), result.places.end(),
                   [](const CrossingPlace& a, const CrossingPlace& b) { return a.pairs > b.pairs; });
  return result;
}

std::vector<char> crossed_vertices(const Mesh& mesh, const Crossings& crossings) {
  std::vector<char> crossed(mesh.num_vertices(), 0);
  for (Face f : crossings.faces)
    for (Vertex v : corners_of(mesh, f)) crossed[v.idx()] = 1;
  return crossed;
}

}  // namespace furrow::geometry
