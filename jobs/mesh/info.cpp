// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/info.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/self_intersections.h"
#include "io/mesh/mesh_file.h"
#include "jobs/base/part_names.h"
#include "jobs/cloth/attach_parts.h"
#include "jobs/cloth/chain.h"
#include "jobs/cloth/measure_shape.h"

namespace furrow::jobs {
namespace {

Json to_json(const geometry::Point& p) { return Json::array({p.x(), p.y(), p.z()}); }

Json to_json(const io::RepairReport& r) {
  return {{"triangulated_faces", r.triangulated_faces}, {"degenerate_faces", r.degenerate_faces},
          {"duplicate_faces", r.duplicate_faces},       {"reversed_faces", r.reversed_faces},
          {"lining_textures", r.lining_textures},       {"duplicated_vertices", r.duplicated_vertices},
          {"isolated_vertices", r.isolated_vertices},   {"merged_vertices", r.merged_vertices}};
}

/// null: too many faces lie at one place to count.
Json self_intersections_of(const geometry::Mesh& mesh) {
  try {
    return geometry::count_self_intersections(mesh);
  } catch (const geometry::ContentError&) {
    return nullptr;
  }
}

/// The parts of a garment, largest first, and whether they go with other cloth.
Json parts_of(const io::MeshFile& file) {
  constexpr std::size_t most = 100;
  const geometry::Parts parts = geometry::find_parts(file.mesh);
  Json list = Json::array();
  for (std::size_t p = 0; p < std::min(most, parts.list.size()); ++p) {
    const geometry::Part& part = parts.list[p];
    list.push_back({{"name", name_of_part(file, parts, int(p))},
                    {"vertices", part.vertices},
                    {"area", part.area},
                    {"centre", to_json(part.centre)},
                    {"goes", "by itself"}});
  }
  for (const geometry::AttachedPart& a : attached_parts(file, parts, {}))
    if (std::size_t(a.part) < list.size() && a.ride != geometry::Ride::by_itself)
      list[std::size_t(a.part)]["goes"] = a.ride == geometry::Ride::rigid ? "as one" : "place by place";
  return list;
}

}  // namespace

Json info(const io::MeshFile& file) {
  const geometry::MeshInfo i = geometry::measure(file.mesh);
  Json report{{"vertices", i.vertices},
              {"edges", i.edges},
              {"faces", i.faces},
              {"components", i.components},
              {"boundary_loops", i.boundary_loops},
              {"euler_characteristic", i.euler_characteristic},
              {"closed", i.closed},
              {"manifold", i.manifold && file.repairs.duplicated_vertices == 0},
              {"degenerate_faces", i.degenerate_faces},
              {"self_intersections", self_intersections_of(file.mesh)},
              {"area", i.area},
              {"volume", i.volume ? Json(*i.volume) : Json(nullptr)},
              {"bounding_box", {{"min", to_json(i.box_min)}, {"max", to_json(i.box_max)}}},
              {"mean_edge_length", i.mean_edge_length},
              {"min_angle_deg", i.min_angle_deg}};
  report["borders"] = jobs::to_json(measure_borders(file.mesh));
  if (i.components > 1) report["parts"] = parts_of(file);
  report["groups"] = file.group_names;
  report["materials"] = file.material_names;
  report["texture_coordinates"] = geometry::find_map(file.mesh, geometry::attribute::texture).has_value();
  if (geometry::is_chain(file.mesh)) {
    const std::vector<geometry::Strut> links = chain_links(file);
    report["chain"] = {{"links", links.size()}, {"length", length_of(links)}};
  }
  if (const auto record = io::find_wrinkle_record(file))
    for (const io::WrinkleRecord::Line& line : record->lines) report["lines"].push_back(line.name);
  report["repairs"] = to_json(file.repairs);
  return report;
}

}  // namespace furrow::jobs
