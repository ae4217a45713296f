// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/attach_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "geometry/figure/attached_parts.h"
#include "geometry/figure/ends_on_cloth.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "jobs/base/part_names.h"
#include "jobs/base/seam_ties.h"

namespace furrow::jobs {

namespace {

using geometry::Ride;

bool names_any(const io::SceneAttach& attach) { return !attach.parts.empty() || !attach.free.empty(); }

/// The parts of that name, of which there is one at least.
std::vector<int> require_parts(const io::MeshFile& file, const geometry::Parts& parts, const char* setting,
                               const std::string& name) {
  std::vector<int> called = parts_called(file, parts, name);
  if (!called.empty()) return called;
  constexpr std::size_t most = 12;
  std::string all;
  for (std::size_t part = 0; part < std::min(most, parts.list.size()); ++part)
    all += (part ? ", " : "") + name_of_part(file, parts, int(part));
  throw std::invalid_argument(std::string(setting) + ": no part of the garment is called '" + name +
                              "'; it has " + all + (parts.list.size() > most ? ", …" : ""));
}

/// By part: what was chosen for it.
std::vector<Ride> chosen_rides(const io::MeshFile& file, const geometry::Parts& parts,
                               const io::SceneAttach& attach) {
  std::vector<Ride> chosen(parts.list.size(), attach.on ? Ride::none : Ride::by_itself);
  std::vector<char> freed(parts.list.size(), 0);
  for (const std::string& name : attach.free)
    for (const int part : require_parts(file, parts, "garment.free_parts", name)) {
      chosen[std::size_t(part)] = Ride::by_itself;
      freed[std::size_t(part)] = 1;
    }
  for (const std::string& name : attach.parts)
    for (const int part : require_parts(file, parts, "garment.attach_parts", name)) {
      if (part == 0)
        throw std::invalid_argument("garment.attach_parts: '" + name +
                                    "' is the largest part of the garment, and nothing carries it");
      if (freed[std::size_t(part)])
        throw std::invalid_argument("garment.attach_parts: '" + name +
                                    "' is one of `garment.free_parts`, too; name it in one of them");
      chosen[std::size_t(part)] = Ride::by_place;
    }
  return chosen;
}

std::vector<char> pinned_parts(const geometry::Parts& parts, const std::vector<std::vector<int>>& pins) {
  std::vector<char> pinned(parts.list.size(), 0);
  for (const std::vector<int>& list : pins)
    for (const int v : list)
      if (parts.of_vertex[std::size_t(v)] >= 0) pinned[std::size_t(parts.of_vertex[std::size_t(v)])] = 1;
  return pinned;
}

void warn_of_attached(const io::MeshFile& file, const geometry::Parts& parts,
                      const std::vector<geometry::AttachedPart>& attached, const std::string& name,
                      const Context& context) {
  constexpr std::size_t most = 3;
  std::size_t found = 0;
  std::string names;
  for (const geometry::AttachedPart& a : attached) {
    if (std::isinf(a.reach)) continue;
    if (found++ < most) names += (found > 1 ? ", " : "") + name_of_part(file, parts, a.part);
  }
  if (found == 0) return;
  if (found > most) names += " and " + std::to_string(found - most) + " more";
  context.warn("parts_attached",
               name + ": " + std::to_string(found) + " of its " + std::to_string(parts.list.size()) +
                   (found == 1 ? " parts lies on other cloth, and goes with it: "
                               : " parts lie on other cloth, and go with it: ") +
                   names +
                   "; `garment.attach=false` lets parts move by themselves, `garment.free_parts` those that "
                   "it names",
               name, "garment.attach");
}

void let_ride(io::MeshFile& file, const io::SceneAttach& attach, const std::string& name,
              const std::vector<std::vector<int>>& pins, const Context& context) {
  if (!names_any(attach)) {
    if (!attach.on) return geometry::set_rides(file.mesh, {}, {});
    if (geometry::find_map(file.mesh, geometry::attribute::rides))
      return geometry::free_drawn_parts(file.mesh);
  }
  const geometry::Parts parts = geometry::find_parts(file.mesh);
  std::vector<geometry::AttachedPart> attached = attached_parts(file, parts, attach);
  const std::vector<char> pinned = pinned_parts(parts, pins);
  std::erase_if(attached, [&](const geometry::AttachedPart& a) {
    const bool is_pinned = a.ride != Ride::by_itself && pinned[std::size_t(a.part)] != 0;
    if (is_pinned && std::isinf(a.reach))
      throw std::invalid_argument("garment.attach_parts: " + name_of_part(file, parts, a.part) +
                                  " is pinned, so cloth cannot carry it");
    return is_pinned;
  });
  if (attached.empty()) return;
  geometry::set_rides(file.mesh, parts, attached);
  warn_of_attached(file, parts, attached, name, context);
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

std::vector<geometry::AttachedPart> attached_parts(const io::MeshFile& file, const geometry::Parts& parts,
                                                   const io::SceneAttach& attach) {
  const auto noted = geometry::find_map(file.mesh, geometry::attribute::rides);
  if (!noted || names_any(attach))
    return geometry::find_attached(file.mesh, parts, chosen_rides(file, parts, attach));
  std::vector<geometry::AttachedPart> attached;
  for (std::size_t part = 0; part < parts.list.size(); ++part)
    if (const Ride ride = Ride((*noted)[parts.list[part].first]); ride != Ride::none)
      attached.push_back({int(part), ride, std::numeric_limits<double>::infinity()});
  return attached;
}

void attach_parts(io::MeshFile& file, const io::SceneAttach& attach, const io::SceneMaterial& material,
                  const std::string& name, const std::vector<std::vector<int>>& pins,
                  const Context& context) {
  let_ride(file, attach, name, pins, context);
  if (attach.on) tie_ends_of(file, material, name, pins, context);
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
