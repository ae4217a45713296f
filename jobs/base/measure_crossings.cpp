// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/measure_crossings.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "geometry/figure/attached_parts.h"
#include "geometry/mesh/crossings.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/self_intersections.h"
#include "geometry/mesh/vertex_attributes.h"
#include "geometry/refine/subdivide.h"
#include "jobs/base/part_names.h"

namespace furrow::jobs {
namespace {

constexpr std::size_t most_places = 10;
constexpr const char* crossed_column = "furrow_crossed";  // on a copy only

/// Whether a vertex of the refined mesh is made of one that crossed.
std::vector<char> refined(geometry::Mesh mesh, const std::vector<char>& crossed, int refinements) {
  auto column = geometry::ensure_vertex_attribute(mesh, crossed_column);
  for (geometry::Vertex v : mesh.vertices()) column[v] = crossed[v.idx()];
  geometry::loop_subdivide(mesh, refinements);
  std::vector<char> result(mesh.num_vertices(), 0);
  for (const geometry::VertexAttribute& a : geometry::vertex_attributes(mesh))
    if (a.name == crossed_column)
      for (geometry::Vertex v : mesh.vertices()) result[v.idx()] = a.values[v] != 0;
  return result;
}

using FacePairs = std::vector<std::array<geometry::Face, 2>>;

/// Without those of parts that ride on cloth as one and crossed it as they were given: a button may be sunk
/// into its cloth. crossed: by vertex, then.
void leave_out_sunken(const geometry::Mesh& mesh, const geometry::Parts& parts,
                      const std::vector<char>& crossed, FacePairs& pairs) {
  const std::vector<geometry::Ride> rides = geometry::rides_of(mesh);
  if (rides.empty()) return;
  std::vector<char> sunken(parts.list.size(), 0);
  for (std::size_t v = 0; v < std::min(crossed.size(), parts.of_vertex.size()); ++v)
    if (const int part = parts.of_vertex[v]; crossed[v] && part >= 0)
      sunken[std::size_t(part)] = rides[parts.list[std::size_t(part)].first.idx()] == geometry::Ride::rigid;
  const auto is_sunken = [&](geometry::Face f) { return sunken[std::size_t(parts.of_face[f.idx()])] != 0; };
  std::erase_if(pairs, [&](const auto& pair) { return is_sunken(pair[0]) || is_sunken(pair[1]); });
}

Json to_json(const CrossingPlace& p) {
  return {{"pairs", p.pairs},      {"new", p.pairs - p.from_start},
          {"x", p.centre.x()},     {"y", p.centre.y()},
          {"z", p.centre.z()},     {"extent", p.extent},
          {"parts", Json(p.parts)}};
}

}  // namespace

CrossedStart crossed_start(const geometry::Mesh& mesh, int refinements) {
  const geometry::Crossings found = geometry::find_crossings(mesh, geometry::find_parts(mesh));
  CrossedStart start;
  start.pairs = found.pairs;
  if (!found.pairs) return start;
  start.vertices = geometry::crossed_vertices(mesh, found);
  if (refinements > 0) start.vertices = refined(mesh, start.vertices, refinements);
  return start;
}

ClothCrossings measure_crossings(const io::MeshFile& file, const CrossedStart* start,
                                 geometry::CrossingMemory* memory) {
  FacePairs pairs =
      memory ? geometry::self_intersections(file.mesh, *memory) : geometry::self_intersections(file.mesh);
  const geometry::Parts parts = pairs.empty() ? geometry::Parts{} : geometry::find_parts(file.mesh);
  if (start && !pairs.empty()) leave_out_sunken(file.mesh, parts, start->vertices, pairs);
  const geometry::Crossings found =
      geometry::find_crossings(file.mesh, parts, pairs, start ? start->vertices : std::vector<char>{});
  ClothCrossings result;
  if (start) result.at_start = start->pairs;
  result.pairs = found.pairs;
  result.from_start = found.from_start;
  result.faces.assign(found.faces.begin(), found.faces.end());
  const std::vector<char> crossed = geometry::crossed_vertices(file.mesh, found);
  for (std::size_t v = 0; v < crossed.size(); ++v)
    if (crossed[v]) result.corners.push_back(v);
  for (const geometry::CrossingPlace& p : found.places)
    result.places.push_back({p.centre,
                             p.extent,
                             p.pairs,
                             p.from_start,
                             {name_of_part(file, parts, p.parts[0]), name_of_part(file, parts, p.parts[1])}});
  return result;
}

std::string words(const ClothCrossings& c) {
  std::string text = fmt::format("{} pair{} of faces of the cloth cross{}", c.pairs, c.pairs == 1 ? "" : "s",
                                 c.pairs == 1 ? "es" : "");
  if (c.from_start) text += fmt::format(" ({} of them from the start)", c.from_start);
  if (c.places.empty()) return text;
  const CrossingPlace& p = c.places.front();
  text += fmt::format(", {}within {:.1f} cm of ({:.2f}, {:.2f}, {:.2f}) m",
                      c.places.size() > 1 ? fmt::format("most ({}) ", p.pairs) : "", 100 * p.extent / 2,
                      p.centre.x(), p.centre.y(), p.centre.z());
  return text + (p.parts[0] == p.parts[1] ? "" : ", between " + p.parts[0] + " and " + p.parts[1]);
}

Json to_json(const ClothCrossings& c) {
  Json json = Json::object();
  if (c.at_start) json["at_start"] = *c.at_start;
  json["pairs"] = c.pairs;
  if (c.at_start) json["new"] = c.pairs - c.from_start;
  json["faces"] = c.faces.size();
  if (c.places.empty()) return json;
  json["corners"] = c.corners;
  json["places"] = Json::array();
  for (std::size_t i = 0; i < std::min(most_places, c.places.size()); ++i)
    json["places"].push_back(to_json(c.places[i]));
  if (c.places.size() > most_places) json["places_left_out"] = c.places.size() - most_places;
  return json;
}

}  // namespace furrow::jobs
