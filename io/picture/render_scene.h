// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "geometry/stroke/stroke.h"
#include "io/picture/render.h"

namespace furrow::io {

/// How lines are coloured: a ridge (height > 0), a valley (< 0), or neither (height 0 or not known).
struct LineColours {
  Colour ridge = ridge_colour;
  Colour valley = valley_colour;
  Colour other{0.12f, 0.12f, 0.14f};
};

inline Position position_of(const geometry::Point& p) { return {p.x(), p.y(), p.z()}; }

/// The faces of a mesh to be drawn. Vertices removed but not yet collected are left out. With the map
/// v:color, where any vertex has a colour other than white, the vertices keep their colours. A texture is
/// laid on by the mesh's texture coordinates. Throws geometry::ContentError if a face is no triangle, or for
/// a texture if the mesh has no texture coordinates.
RenderMesh render_mesh_from(const geometry::Mesh& mesh, Style style = Style::cloth,
                            std::shared_ptr<const Image> texture = nullptr);

/// Gives faces of a mesh that was made by render_mesh_from() of one without removed faces a colour of their
/// own, with sharp edges. Throws std::invalid_argument, nothing changed, for an index out of range.
void mark_faces(RenderMesh& mesh, std::span<const geometry::Index<geometry::Face>> faces,
                const Colour& colour = mark_colour);

/// The lines that a mesh carries, one piece an edge, ordered by edge; empty if the mesh has no such maps.
/// `heights[id]` is the height of line `id`, of which only the sign is used [m]. Throws std::invalid_argument
/// for a height that is NaN.
///
/// \details A line edge is one of e:line_edge. Without this map it is an edge whose ends lie on one line
/// (v:line), except the longest side of a triangle whose corners all do. An edge whose ends belong to two
/// lines, or to none, takes the line that has fewer line edges at its end (then the greater id).
std::vector<RenderLine> render_lines_from(const geometry::Mesh& mesh, const std::vector<double>& heights,
                                          const LineColours& colours = {});

/// Strokes before they are inserted, as they lie on the surface: traced from face to face (trace_stroke.h),
/// so that a line never runs behind the cloth that it was drawn on. A stroke that cannot be traced is drawn
/// as it is, with a warning.
std::vector<RenderLine> render_lines_from(const geometry::Mesh& mesh,
                                          const std::vector<geometry::Stroke>& strokes,
                                          std::vector<std::string>& warnings,
                                          const LineColours& colours = {});

}  // namespace furrow::io
