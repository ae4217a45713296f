// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/bake.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/property_names.h"
#include "geometry/refine/apply_displacement.h"
#include "geometry/refine/surface_deviation.h"
#include "geometry/stroke/project_onto_surface.h"
#include "io/picture/baked_maps.h"
#include "jobs/base/card.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"

namespace furrow::jobs {
namespace {

using geometry::Face;
using geometry::Mesh;

constexpr double moved = 1e-4;  // from the low surface: such faces are reported as wrinkled [m]

void check(const BakeJob& job, Listener& listener) {
  const std::string applied = job.applied.string();
  if (!applied.empty() && !job.check) throw std::invalid_argument("`applied` goes with `check`");
  check_card(job);
  if (job.prefix.empty()) {
    if (job.check)
      throw std::invalid_argument("bake: a check reads the maps that were written: name a prefix");
    return;
  }
  check_folder(job.prefix);
  if (!applied.empty()) check_output(applied);
  const io::BakedFiles files = io::baked_files(job.prefix);
  check_replaced({files.displacement.string(), files.normal.string(), files.record.string(), applied},
                 {name_of(job.low, ""), name_of(job.high, "")}, listener);
}

/// Both meshes must have texture coordinates.
io::MeshFile read_textured(const MeshInput& input, const char* what, const Context& context) {
  io::MeshFile file = read_mesh(input, context);
  if (!geometry::find_map(file.mesh, geometry::attribute::texture))
    throw geometry::ContentError(
        name_of(input, what) +
        ": has no texture coordinates, in which maps lie; unwrap and export it with them");
  return file;
}

/// What maps look like that are of no use.
void check_maps(const geometry::BakedMaps& maps, const Mesh& low, const BakeJob& job) {
  const std::string name = name_of(job.low, "the low mesh");
  if (maps.covered == 0)
    throw geometry::ContentError(name +
                                 ": its texture coordinates have no area, no texel lies in a face; "
                                 "unwrap it, or raise `texels`");
  const geometry::MeshInfo info = geometry::measure(low);
  const double diagonal = std::sqrt(CGAL::squared_distance(info.box_min, info.box_max));
  if (maps.largest > diagonal / 2)
    throw geometry::ContentError(name_of(job.high, "the high mesh") + ": lies " +
                                 std::to_string(maps.largest) + " m from " + name +
                                 ", more than half of its diagonal; maps need both in one unit (`unit`) and "
                                 "one pose (`furrow transfer`)");
}

std::vector<Face> faces_away_from(const Mesh& mesh, const Mesh& low) {
  const geometry::SurfaceProjector surface(low);
  std::vector<Face> faces;
  for (Face f : mesh.faces())
    for (geometry::Vertex v : mesh.vertices_around_face(mesh.halfedge(f)))
      if (surface.closest(mesh.point(v)).distance > moved) {
        faces.push_back(f);
        break;
      }
  return faces;
}

/// Reads the maps back from their files, applies them, and measures how well they tell the high mesh. What is
/// not measured yet when the listener cancels is left out.
BakeCheck measure_maps(const BakeJob& job, const io::MeshFile& low, const Mesh& high,
                       const io::BakedFiles& files, const Context& context) {
  BakeCheck result{low, {}};
  const io::MeshFile& applied = result.applied;
  {
    const physics::CancelScope whole([] { return false; });
    geometry::apply_displacement(result.applied.mesh, io::read_displacement(files.record), *job.check);
  }
  if (!job.applied.empty() && job.applied != "-") write_mesh(job.applied, applied, context);
  const auto measure = [&](const char* name, const Mesh& from, const Mesh& to, const auto&... faces) {
    const geometry::SurfaceDeviation d = geometry::surface_deviation(from, to, faces...);
    result.deviations.push_back({name, d.median, d.p95, d.largest, d.area});
  };
  try {
    measure("to_high", applied.mesh, high);
    measure("from_high", high, applied.mesh);
    const std::vector<Face> ours = faces_away_from(applied.mesh, low.mesh),
                            theirs = faces_away_from(high, low.mesh);
    if (!ours.empty()) measure("wrinkled_to_high", applied.mesh, high, ours);
    if (!theirs.empty()) measure("wrinkled_from_high", high, applied.mesh, theirs);
  } catch (const physics::Cancelled&) {
  }
  return result;
}

}  // namespace

BakeReport bake(const BakeJob& job, Listener& listener) {
  const physics::CancelScope cancelling([&listener] { return listener.cancelled(); });
  check(job, listener);
  BakeReport report;
  report.frame = job.frame;
  report.size = job.options.size;
  take_noted_frame(report.frame, {name_of(job.low, ""), name_of(job.high, "")});
  const Context context{report.frame, listener};
  const io::MeshFile low = read_textured(job.low, "the low mesh", context),
                     high = read_textured(job.high, "the high mesh", context);
  std::optional<geometry::BakedMaps> maps;
  try {
    const ProgressScope progress(listener, "baking");
    maps = geometry::bake_maps(low.mesh, high.mesh, job.options, std::cref(progress));
  } catch (const physics::Cancelled&) {
  }
  if (!maps) return report;
  if (maps->overlapping > 0)
    context.warn("charts_overlap",
                 name_of(job.low, "the low mesh") + ": " + std::to_string(maps->overlapping) +
                     " texels lie in two faces; charts that overlap cannot both be right",
                 name_of(job.low, ""));
  check_maps(*maps, low.mesh, job);
  report.ran = true;
  if (!job.prefix.empty()) {
    const io::BakedFiles files = io::write_baked_maps(job.prefix, *maps);
    report.written = {files.displacement.string(), files.normal.string(), files.record.string()};
    if (job.check && !listener.cancelled()) report.check = measure_maps(job, low, high.mesh, files, context);
  }
  report.cancelled = listener.cancelled();
  report.maps = std::move(*maps);
  return report;
}

std::vector<CardRow> card(BakeJob& job) {
  return {
      {"output", &job.prefix, "what the names of the files begin with"},
      {"texels", &job.options.size, between(1, 8192), "width and height of the maps [texels]"},
      {"padding", &job.options.padding, between(0, 1024),
       "how far the charts go on beyond their borders [texels]"},
      {"check", &job.check, between(0, 6),
       "apply the written map to the low mesh cut so many times into four, and report the distances between "
       "the result and the high mesh [m]"},
      {"applied", &job.applied, "mesh to write the result of `check` to"},
  };
}

Json to_json(const BakeReport& r) {
  Json json{{"size", r.size},
            {"covered_texels", r.maps.covered},
            {"unmatched_texels", r.maps.unmatched},
            {"overlapping_texels", r.maps.overlapping},
            {"largest_displacement", r.maps.largest}};
  if (r.check) {
    Json check{{"vertices", r.check->applied.mesh->number_of_vertices()}};
    for (const BakeDeviation& d : r.check->deviations)
      check[d.name] = {{"median", d.median}, {"p95", d.p95}, {"max", d.largest}, {"area", d.area}};
    json["check"] = std::move(check);
  }
  json["written"] = r.written;
  return json;
}

}  // namespace furrow::jobs
