// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/attach_parts.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/figure/attached_parts.h"
#include "geometry/figure/ends_on_cloth.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "jobs/base/measure_crossings.h"
#include "jobs/base/seam_ties.h"

namespace furrow::jobs {

namespace {

void let_ride(io::MeshFile& file, const std::string& name, const std::vector<std::vector<int>>& pins,
              const Context& context) {
  geometry::Mesh& mesh = file.mesh;
  if (geometry::find_map(mesh, geometry::attribute::rides)) return geometry::free_drawn_parts(mesh);
  const geometry::Parts parts = geometry::find_parts(mesh);
  std::vector<geometry::AttachedPart> attached = geometry::find_attached(mesh, parts);
  std::vector<char> pinned(parts.list.size(), 0);
  for (const std::vector<int>& list : pins)
    for (const int v : list)
      if (parts.of_vertex[std::size_t(v)] >= 0) pinned[std::size_t(parts.of_vertex[std::size_t(v)])] = 1;
  std::erase_if(attached, [&](const auto& a) { return pinned[std::size_t(a.part)] != 0; });
  if (attached.empty()) return;
  geometry::set_rides(mesh, parts, attached);
  constexpr std::size_t most = 3;
  std::string names;
  for (std::size_t i = 0; i < std::min(most, attached.size()); ++i)
    names += (i ? ", " : "") + name_of_part(file, parts, attached[i].part);
  if (attached.size() > most) names += " and " + std::to_string(attached.size() - most) + " more";
  context.warn("parts_attached",
               name + ": " + std::to_string(attached.size()) + " of its " +
                   std::to_string(parts.list.size()) + " parts lie on other cloth, and go with it: " + names +
                   "; `garment.attach=false` lets them move by themselves",
               name, "garment.attach");
}

void tie_ends_of(io::MeshFile& file, const io::SceneMaterial& material, const std::string& name,
                 const std::vector<std::vector<int>>& pins, const Context& context) {
  std::vector<geometry::EndOnCloth> ends = geometry::find_ends_on_cloth(file.mesh);
  for (const std::vector<int>& list : pins)
    std::erase_if(ends, [&](const geometry::EndOnCloth& end) {
      return std::find(list.begin(), list.end(), int(end.vertex)) != list.end();
    });
  if (ends.empty()) return;
  geometry::tie_ends(file.mesh, ends, tie_stiffness(material));
  const auto farthest = std::max_element(
      ends.begin(), ends.end(), [](const auto& a, const auto& b) { return a.distance < b.distance; });
  const geometry::Point& at = file.mesh->point(farthest->vertex);
  context.warn(
      "ends_tied",
      fmt::format("{}: {} border vertices lie on other cloth that nothing joins them to, up to {:.1f} "
                  "mm off at ({:.3f}, {:.3f}, {:.3f}) m, and are tied to it; `garment.attach=false` "
                  "leaves them open",
                  name, ends.size(), 1000 * farthest->distance, at.x(), at.y(), at.z()),
      name, "garment.attach");
}

bool has_other_struts(const geometry::Mesh& mesh) {
  return geometry::struts(mesh).size() > seam_ties(mesh).size();
}

}  // namespace

void attach_parts(io::MeshFile& file, const io::SceneMaterial& material, const std::string& name,
                  const std::vector<std::vector<int>>& pins, const Context& context) {
  let_ride(file, name, pins, context);
  tie_ends_of(file, material, name, pins, context);
}

void tie_refined_ends(geometry::Mesh& mesh, const geometry::Mesh& as_read,
                      const io::SceneMaterial& material) {
  if (mesh.num_vertices() == as_read.num_vertices() || !has_other_struts(as_read)) return;
  geometry::tie_ends(mesh, geometry::find_ends_on_cloth(mesh), tie_stiffness(material));
}

std::size_t own_struts(const geometry::Mesh& mesh) {
  if (!has_other_struts(mesh)) return 0;
  geometry::Mesh bare = mesh;
  geometry::set_struts(bare, {});
  const std::size_t of_ends = 3 * geometry::find_ends_on_cloth(bare).size();
  return geometry::struts(mesh).size() -
         std::min(geometry::struts(mesh).size(), seam_ties(mesh).size() + of_ends);
}

}  // namespace furrow::jobs
