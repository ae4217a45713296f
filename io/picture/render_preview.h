// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/mesh.h"
#include "io/picture/render_scene.h"

namespace furrow::io {

/// What a preview of lines points out.
struct PreviewColours {
  Colour selected{0.98f, 0.86f, 0.55f};  ///< triangles that the lines change
  Colour edge{0.30f, 0.28f, 0.25f};      ///< their edges
  Colour vertex{0.10f, 0.10f, 0.12f};    ///< inserted vertices
  LineColours lines;
};

/// A picture of what an insertion does, before anything is displaced. The triangles that it changes are
/// highlighted with their edges, inserted vertices are dots, lines are coloured by the sign of their height.
/// `inserted`: the mesh at Stage::inserted; `changed`: InsertionReport::changed_faces; `old_vertices`: how
/// many vertices the mesh had before (a new one has an index from there on); `heights`: of the lines by id
/// [m]. Throws what render_mesh_from and render_lines_from throw.
RenderScene preview_scene(const geometry::Mesh& inserted,
                          const std::vector<geometry::Index<geometry::Face>>& changed,
                          std::size_t old_vertices, const std::vector<double>& heights,
                          const PreviewColours& colours = {});

}  // namespace furrow::io
