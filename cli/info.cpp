// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/self_intersections.h"
#include "io/mesh/wrinkle_record.h"
#include "jobs/run/measure_shape.h"

namespace furrow::cli {
namespace {

struct InfoArguments : CommonArguments {
  std::string mesh;
};

Json to_json(const geometry::Point& p) { return Json::array({p.x(), p.y(), p.z()}); }

void info(const InfoArguments& a) {
  const io::MeshFile file = read_mesh(a.mesh, a);
  if (const std::string hint = too_tall(file.mesh, "mesh"); !hint.empty()) warn(a.mesh + ": " + hint, a);
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
              {"self_intersections", geometry::count_self_intersections(file.mesh)},
              {"area", i.area},
              {"volume", i.volume ? Json(*i.volume) : Json(nullptr)},
              {"bounding_box", {{"min", to_json(i.box_min)}, {"max", to_json(i.box_max)}}},
              {"mean_edge_length", i.mean_edge_length},
              {"min_angle_deg", i.min_angle_deg}};
  report["borders"] = to_json(measure_borders(file.mesh));
  report["groups"] = file.group_names;
  report["materials"] = file.material_names;
  report["texture_coordinates"] = geometry::find_map(file.mesh, geometry::attribute::texture).has_value();
  if (const auto record = io::find_wrinkle_record(file))
    for (const io::WrinkleRecord::Line& line : record->lines) report["lines"].push_back(line.name);
  const io::RepairReport& r = file.repairs;
  report["repairs"] = {
      {"triangulated_faces", r.triangulated_faces},   {"degenerate_faces", r.degenerate_faces},
      {"duplicate_faces", r.duplicate_faces},         {"reversed_faces", r.reversed_faces},
      {"duplicated_vertices", r.duplicated_vertices}, {"isolated_vertices", r.isolated_vertices},
      {"merged_vertices", r.merged_vertices}};
  print_report(report, a);
}

}  // namespace

void add_info(CLI::App& app) {
  auto a = std::make_shared<InfoArguments>();
  CLI::App* sub = app.add_subcommand("info", "Say what a mesh is: counts, topology, lengths, areas, faults");
  sub->add_option("mesh", a->mesh,
                  "mesh to read: obj, ply, off, stl, gltf, glb; - is OBJ from standard input")
      ->required();
  add_common_options(*sub, *a);
  sub->callback([a] { info(*a); });
}

}  // namespace furrow::cli
