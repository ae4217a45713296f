// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/chain/wrinkle_stages.h"

#include <cmath>

#include "geometry/mesh/crossings.h"
#include "io/picture/render_preview.h"
#include "io/picture/render_scene.h"

namespace furrow::jobs {

namespace {

void mark_crossings(const geometry::Mesh& mesh, io::RenderMesh& shown) {
  const auto crossing = geometry::find_crossings(mesh, geometry::find_parts(mesh)).faces;
  io::mark_faces(shown, std::vector<geometry::Index<geometry::Face>>(crossing.begin(), crossing.end()));
}

}  // namespace

io::RenderScene preview_scene(const WrinkleReport& report) {
  if (report.rest) {
    io::RenderScene scene{{io::render_mesh_from(report.garment.mesh)}, {}};
    mark_crossings(report.garment.mesh, scene.meshes[0]);
    return scene;
  }
  std::vector<double> heights;
  const io::WrinkleRecord record = io::find_wrinkle_record(report.garment).value();
  for (const io::WrinkleRecord::Line& line : record.lines)
    heights.push_back(std::isfinite(line.height) ? line.height : 0);
  const WrinkleStages& stages = report.stages.value();
  // Steep flanks of folds are refined after insertion: those faces are not there yet.
  std::vector<geometry::Index<geometry::Face>> changed;
  for (geometry::Face f : report.drawn.round.report.insertion.changed_faces)
    if (stages.inserted->has_valid_index(f)) changed.push_back(f);
  io::RenderScene scene = io::preview_scene(stages.inserted, changed, stages.before->num_vertices(), heights);
  mark_crossings(stages.inserted, scene.meshes[0]);
  return scene;
}

io::MeshFile inserted_garment(const WrinkleReport& report) {
  io::MeshFile inserted = report.garment;
  inserted.mesh = report.stages.value().displaced;
  io::drop_motion(inserted);
  return inserted;
}

}  // namespace furrow::jobs
