// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/struts.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"

namespace furrow::geometry {
namespace {

/// At the lower vertex of each strut, so that copies of a mesh carry them as they carry every map.
const PropertyName<Vertex, std::vector<Strut>> strut_property{"v:struts", {}};

bool has(const Mesh& mesh, Vertex v) {
  return v.is_valid() && v.idx() < mesh.num_vertices() && !mesh.is_removed(v);
}

[[noreturn]] void refuse(const Strut& s, const std::string& what) {
  geometry::refuse("set_struts", "the strut between vertices " + std::to_string(s.a.idx()) + " and " +
                                     std::to_string(s.b.idx()) + what);
}

void check(const Mesh& mesh, const Strut& s) {
  if (!has(mesh, s.a) || !has(mesh, s.b)) refuse(s, " names one that is not in the mesh");
  if (!(s.a < s.b)) refuse(s, " must name the lower one first");
  if (!(s.rest_length > 0) || !std::isfinite(s.rest_length))
    refuse(s, ": rest_length = " + std::to_string(s.rest_length) + " m is not > 0 and finite");
  if (!(s.stiffness >= 0) || !std::isfinite(s.stiffness))
    refuse(s, ": stiffness = " + std::to_string(s.stiffness) + " N/m is not >= 0 and finite");
}

}  // namespace

std::vector<Strut> struts(const Mesh& mesh) {
  std::vector<Strut> list;
  const auto map = find_map(mesh, strut_property);
  if (!map) return list;
  for (Vertex v : mesh.vertices())
    for (const Strut& s : (*map)[v])
      if (has(mesh, s.b)) list.push_back({v, s.b, s.rest_length, s.stiffness});
  return list;
}

void set_struts(Mesh& mesh, std::span<const Strut> list) {
  for (const Strut& s : list) check(mesh, s);
  std::vector<Strut> sorted(list.begin(), list.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Strut& s, const Strut& t) { return std::tie(s.a, s.b) < std::tie(t.a, t.b); });
  if (auto old = find_map(mesh, strut_property)) mesh.remove_property_map(*old);
  if (sorted.empty()) return;
  auto map = ensure_map(mesh, strut_property);
  for (const Strut& s : sorted) map[s.a].push_back(s);
}

std::vector<char> loose_vertices(const Mesh& mesh) {
  std::vector<char> loose(mesh.num_vertices(), 0);
  for (Vertex v : mesh.vertices()) loose[v] = mesh.is_isolated(v);
  if (!is_chain(mesh)) return loose;
  for (const Strut& link : struts(mesh)) loose[link.a] = loose[link.b] = 0;
  return loose;
}

}  // namespace furrow::geometry
