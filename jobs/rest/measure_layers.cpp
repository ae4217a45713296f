// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/measure_layers.h"

#include "bridge/arrays/convert.h"
#include "geometry/mesh/crossings.h"
#include "jobs/base/gate.h"
#include "physics/pairs/layer_order.h"

namespace furrow::jobs {
namespace {

constexpr double order_reach = 0.02;  // m

struct Between {
  std::size_t pairs = 0;
  std::vector<geometry::CrossingPlace> places;  ///< of both
};

/// Crossings of two meshes with each other; own: pairs of faces of either alone.
Between find_between(const geometry::Mesh& inner, const geometry::Mesh& outer, std::size_t own) {
  const std::array<const geometry::Mesh*, 2> both{&inner, &outer};
  const geometry::Mesh joined = joined_mesh(both);
  const geometry::Parts parts = geometry::find_parts(joined);
  const geometry::Crossings all = geometry::find_crossings(joined, parts);
  Between between{all.pairs - std::min(all.pairs, own), {}};
  const std::size_t border = inner.number_of_faces();
  const auto is_inner = [&](int part) { return parts.list[std::size_t(part)].first.idx() < border; };
  for (const geometry::CrossingPlace& p : all.places)
    if (between.pairs > 0 && is_inner(p.parts[0]) != is_inner(p.parts[1])) between.places.push_back(p);
  return between;
}

physics::LayerOrder order_of(const geometry::Mesh& inner, const geometry::Mesh& outer, bool turned) {
  return physics::layer_order(bridge::positions_of(outer),
                              {bridge::positions_of(inner), bridge::triangles_of(inner)}, turned,
                              order_reach);
}

LayerPair measure_pair(const Layer& inner, const Layer& outer, const Draped& a, const Draped& b) {
  LayerPair pair;
  pair.inner = a.name;
  pair.outer = b.name;
  pair.crossings_at_start = find_between(*inner.given, *outer.given,
                                         a.crossings.at_start.value_or(0) + b.crossings.at_start.value_or(0))
                                .pairs;
  const Between now = find_between(*inner.now, *outer.now, a.crossings.pairs + b.crossings.pairs);
  pair.crossings = now.pairs;
  for (const geometry::CrossingPlace& p : now.places)
    pair.places.push_back({p.centre, p.extent, p.pairs, p.from_start, {a.name, b.name}});
  const physics::LayerOrder before = order_of(*inner.given, *outer.given, inner.turned),
                            after = order_of(*inner.now, *outer.now, inner.turned);
  pair.compared_at_start = before.compared;
  pair.outside_at_start = before.outside;
  pair.compared = after.compared;
  pair.outside = after.outside;
  return pair;
}

constexpr double clearly_inside = 0.8;  // share of what is compared
constexpr int enough_compared = 20;     // vertices

}  // namespace

void require_order(std::span<const Layer> layers, std::span<const std::string> names,
                   const Context& context) {
  for (std::size_t outer = 1; outer < layers.size(); ++outer)
    for (std::size_t inner = 0; inner < outer; ++inner) {
      if (!layers[inner].touch || !layers[outer].touch) continue;
      const physics::LayerOrder order =
          order_of(*layers[inner].given, *layers[outer].given, layers[inner].turned);
      const int inside = order.compared - order.outside;
      if (order.compared < enough_compared || inside < clearly_inside * order.compared) continue;
      require_allowed(names[outer] + " lies inside " + names[inner] + " as they are given (" +
                          std::to_string(inside) + " of " + std::to_string(order.compared) +
                          " vertices that are near it), but is named after it; name the garments from the "
                          "inside to the outside: " +
                          names[outer] + " before " + names[inner],
                      context);
    }
}

geometry::Mesh joined_mesh(std::span<const geometry::Mesh* const> meshes) {
  geometry::Mesh joined;
  for (const geometry::Mesh* mesh : meshes) {
    const auto first = geometry::Vertex::size_type(joined.number_of_vertices());
    for (const geometry::Vertex v : mesh->vertices()) joined.add_vertex(mesh->point(v));
    for (const auto& [a, b, c] : bridge::triangles_of(*mesh)) {
      const auto vertex = [first](int i) { return geometry::Vertex(first + geometry::Vertex::size_type(i)); };
      joined.add_face(vertex(a), vertex(b), vertex(c));
    }
  }
  return joined;
}

std::vector<LayerPair> measure_layers(std::span<const Layer> layers, std::span<Draped> draped) {
  std::vector<LayerPair> pairs;
  for (std::size_t outer = 1; outer < layers.size(); ++outer)
    for (std::size_t inner = 0; inner < outer; ++inner) {
      pairs.push_back(measure_pair(layers[inner], layers[outer], draped[inner], draped[outer]));
      pairs.back().touch = layers[inner].touch && layers[outer].touch;
      if (!pairs.back().touch) continue;
      draped[inner].crossings_with_others += pairs.back().crossings;
      draped[outer].crossings_with_others += pairs.back().crossings;
    }
  return pairs;
}

}  // namespace furrow::jobs
