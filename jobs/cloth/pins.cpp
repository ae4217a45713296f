// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/pins.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/select_vertices.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {
namespace {

using geometry::Vertex;

void add_named(std::vector<int>& pins, const std::vector<Vertex>& vertices, const std::string& name) {
  if (vertices.empty()) throw std::invalid_argument(name + " names no vertex");
  for (Vertex v : vertices) pins.push_back(static_cast<int>(v));
}

std::string box_text(const std::vector<double>& box) {
  std::string text;
  for (double x : box) text += (text.empty() ? "" : ",") + Json(x).dump();
  return text;
}

std::vector<Vertex> group(const io::MeshFile& file, const std::string& name) {
  const auto at = std::find(file.group_names.begin(), file.group_names.end(), name);
  if (at == file.group_names.end()) return {};
  return geometry::vertices_of_group(file.mesh, static_cast<int>(at - file.group_names.begin()));
}

/// On the border: whether both neighbours along it are pinned. Inside: whether all its neighbours that were
/// there before are.
template <class IsPinned>
bool belongs_to(const geometry::Mesh& mesh, Vertex v, std::size_t old_count, IsPinned is_pinned) {
  const geometry::Halfedge in = mesh.halfedge(v);  // the border's one, as CGAL keeps it
  if (mesh.is_border(in)) return is_pinned(mesh.source(in)) && is_pinned(mesh.target(mesh.next(in)));
  int old = 0;
  for (Vertex w : mesh.vertices_around_target(in)) {
    if (w.idx() >= old_count) continue;
    if (!is_pinned(w)) return false;
    ++old;
  }
  return old >= 2;
}

}  // namespace

std::vector<std::vector<int>> find_pins(const io::MeshFile& file, const std::vector<io::ScenePins>& scene) {
  std::vector<std::vector<int>> all;
  std::set<int> taken;
  const auto joined = geometry::find_map(file.mesh, geometry::attribute::joined);
  for (const io::ScenePins& p : scene) {
    std::vector<int> pins = p.vertices;
    for (int v : pins)
      if (v >= static_cast<int>(file.mesh->number_of_vertices()))
        throw std::invalid_argument("pinned vertex " + std::to_string(v) + ": the mesh has vertices 0 to " +
                                    std::to_string(file.mesh->number_of_vertices() - 1));
    if (const std::vector<double>& b = p.box; !b.empty())
      add_named(pins, geometry::vertices_in_box(file.mesh, {b[0], b[1], b[2]}, {b[3], b[4], b[5]}),
                "the pin box " + box_text(b));
    if (!p.loop.empty()) {
      const std::vector<geometry::BorderLoop> loops = geometry::border_loops(file.mesh);
      add_named(pins, loops.at(geometry::find_border_loop(loops, p.loop)).vertices, "the pin loop " + p.loop);
    }
    if (!p.group.empty()) add_named(pins, group(file, p.group), "the pin group " + p.group);
    for (int& v : pins)
      if (const int with = joined ? (*joined)[Vertex(Vertex::size_type(v))] : -1; with >= 0) v = with;
    std::erase_if(pins, [&](int v) { return !taken.insert(v).second; });  // the first that names it leads it
    all.push_back(std::move(pins));
  }
  return all;
}

void pin_new_vertices(const geometry::Mesh& mesh, std::size_t old_count,
                      std::vector<std::vector<int>>& pins) {
  for (std::vector<int>& list : pins) {
    std::set<int> pinned(list.begin(), list.end());
    const auto is_pinned = [&](Vertex v) { return pinned.count(static_cast<int>(v)) > 0; };
    for (bool grown = true; std::exchange(grown, false);)
      for (std::size_t i = old_count; i < mesh.number_of_vertices(); ++i) {
        const Vertex v(static_cast<Vertex::size_type>(i));
        if (mesh.is_isolated(v) || is_pinned(v) || !belongs_to(mesh, v, old_count, is_pinned)) continue;
        pinned.insert(static_cast<int>(i));
        list.push_back(static_cast<int>(i));
        grown = true;
      }
  }
}

}  // namespace furrow::jobs
