// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/attach_parts.h"

#include <algorithm>

#include "geometry/figure/attached_parts.h"
#include "geometry/mesh/property_names.h"
#include "jobs/base/measure_crossings.h"

namespace furrow::jobs {

void attach_parts(io::MeshFile& file, const std::string& name, const std::vector<std::vector<int>>& pins,
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

}  // namespace furrow::jobs
