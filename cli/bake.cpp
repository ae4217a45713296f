// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <memory>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/property_names.h"
#include "geometry/refine/apply_displacement.h"
#include "geometry/refine/bake_maps.h"
#include "geometry/refine/subdivide.h"
#include "geometry/refine/surface_deviation.h"
#include "geometry/stroke/project_onto_surface.h"
#include "io/picture/baked_maps.h"

namespace furrow::cli {
namespace {

using geometry::Face;
using geometry::Mesh;

struct BakeArguments : CommonArguments {
  std::string low, high, applied;
  int check = -1;
  geometry::BakeOptions options;
};

constexpr double moved = 1e-4;  // from the low surface: such faces are reported as wrinkled [m]

std::vector<Face> faces_away_from(const Mesh& mesh, const Mesh& low) {
  const geometry::SurfaceProjector surface(low);
  std::vector<Face> faces;
  for (Face f : mesh.faces())
    for (geometry::Vertex v : mesh.vertices_around_face(mesh.halfedge(f)))
      if (!interrupted() && surface.closest(mesh.point(v)).distance > moved) {
        faces.push_back(f);
        break;
      }
  return faces;
}

Json to_json(const geometry::SurfaceDeviation& d) {
  return {{"median", d.median}, {"p95", d.p95}, {"max", d.largest}, {"area", d.area}};
}

/// Reads the maps back from their files, applies them, and measures how well they tell the high mesh. What is
/// not measured yet when the user interrupts is left out.
Json check(const io::MeshFile& low, const Mesh& high, const io::BakedFiles& files, const BakeArguments& a) {
  io::MeshFile applied = low;
  geometry::apply_displacement(applied.mesh, io::read_displacement(files.record), a.check);
  if (!a.applied.empty()) write_mesh(a.applied, applied, a);
  Json report{{"vertices", applied.mesh.number_of_vertices()}};
  const auto measure = [&](const char* name, const Mesh& from, const Mesh& to, const auto&... faces) {
    if (!interrupted()) report[name] = to_json(geometry::surface_deviation(from, to, faces...));
  };
  measure("to_high", applied.mesh, high);
  measure("from_high", high, applied.mesh);
  const std::vector<Face> ours = faces_away_from(applied.mesh, low.mesh),
                          theirs = faces_away_from(high, low.mesh);
  if (!ours.empty()) measure("wrinkled_to_high", applied.mesh, high, ours);
  if (!theirs.empty()) measure("wrinkled_from_high", high, applied.mesh, theirs);
  return report;
}

void check_call(const BakeArguments& a) {
  if (a.out == "-") throw UsageError("-o: maps need a prefix for their names");
  if (!a.applied.empty() && a.check < 0) throw UsageError("--applied goes with --check");
  check_folder(a.out);
  if (!a.applied.empty()) check_output(a.applied);
  const io::BakedFiles files = io::baked_files(a.out);
  refuse_same({files.displacement.string(), files.normal.string(), files.record.string(), a.applied},
              {a.low, a.high});
}

/// Both meshes must have texture coordinates.
io::MeshFile read_textured(const std::string& path, const BakeArguments& a) {
  io::MeshFile file = read_mesh(path, a);
  if (!geometry::find_map(file.mesh, geometry::attribute::texture))
    throw geometry::ContentError(path + ": has no texture coordinates; export them, maps lie in their space");
  return file;
}

/// What maps look like that are of no use.
void check_maps(const geometry::BakedMaps& maps, const Mesh& low, const BakeArguments& a) {
  if (maps.covered == 0)
    throw geometry::ContentError(a.low +
                                 ": its texture coordinates have no area, no texel lies in a face; "
                                 "unwrap it, or raise --size");
  const geometry::MeshInfo info = geometry::measure(low);
  const double diagonal = std::sqrt(CGAL::squared_distance(info.box_min, info.box_max));
  if (maps.largest > diagonal / 2)
    throw geometry::ContentError(a.high + ": lies " + std::to_string(maps.largest) + " m from " + a.low +
                                 ", more than half of its diagonal; maps need both in one unit (--unit) and "
                                 "one pose (furrow transfer)");
}

void bake(BakeArguments a, int& exit_code) {
  check_call(a);
  take_noted_frame(a, {a.low, a.high});
  const io::MeshFile low = read_textured(a.low, a), high = read_textured(a.high, a);
  catch_interrupts();
  std::optional<geometry::BakedMaps> maps;
  {
    Progress progress("baking", a);
    maps = geometry::bake_maps(low.mesh, high.mesh, a.options, [&](double share) {
      progress.show(share);
      return !interrupted();
    });
  }
  if (!maps) {
    exit_code = exit_interrupted;
    return warn("interrupted; nothing is written", a);
  }
  if (maps->overlapping > 0)
    warn(a.low + ": " + std::to_string(maps->overlapping) +
             " texels lie in two faces; charts that overlap cannot both be right",
         a);
  check_maps(*maps, low.mesh, a);
  const io::BakedFiles files = io::write_baked_maps(a.out, *maps);
  Json report{{"size", a.options.size},
              {"covered_texels", maps->covered},
              {"unmatched_texels", maps->unmatched},
              {"overlapping_texels", maps->overlapping},
              {"largest_displacement", maps->largest}};
  if (a.check >= 0 && !interrupted()) report["check"] = check(low, high.mesh, files, a);
  if (interrupted()) {  // the maps are written; what follows them is only a measurement
    exit_code = exit_interrupted;
    warn("interrupted; the maps are written, the check is not complete", a);
  }
  report["written"] = {files.displacement.string(), files.normal.string(), files.record.string()};
  print_report(report, a);
}

}  // namespace

void add_bake(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<BakeArguments>();
  CLI::App* sub = app.add_subcommand(
      "bake",
      "Bake a wrinkled mesh into textures of the mesh it was made of\n\n"
      "Writes PREFIX_normal.png, PREFIX_displacement.png (16 bits, tangent space) and PREFIX_maps.json.\n\n"
      "  furrow bake shirt.obj worn.ply -o shirt --size 2048");
  sub->add_option("low", a->low, "mesh that the maps are for; its texture charts must not overlap")
      ->required();
  sub->add_option("high", a->high, "wrinkled mesh with the same charts, in the same pose")->required();
  sub->add_option("-o,--output", a->out, "what the names of the files begin with")->required();
  sub->add_option("--size", a->options.size, "width and height of the maps [texels]")
      ->check(CLI::Range(1, 8192))
      ->capture_default_str();
  sub->add_option("--padding", a->options.padding, "how far the charts go on beyond their borders [texels]")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  sub->add_option("--check", a->check,
                  "apply the written map to the low mesh cut so many times into four, and report the "
                  "distances between the result and the high mesh [m]")
      ->check(CLI::Range(0, 6));
  sub->add_option("--applied", a->applied, "mesh to write the result of --check to");
  add_common_options(*sub, *a);
  sub->callback([a, &exit_code] { bake(*a, exit_code); });
}

}  // namespace furrow::cli
