// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/resolve_strokes.h"

#include <algorithm>
#include <memory>

#include "geometry/errors.h"
#include "geometry/place_path_stroke.h"
#include "geometry/place_texture_stroke.h"
#include "geometry/place_view_stroke.h"
#include "io/nearest_word.h"

namespace furrow::io {
namespace {

using namespace geometry;

class Resolving {
 public:
  explicit Resolving(const MeshFile& garment) : garment_(garment) {}

  PlacedStroke place(const Stroke& stroke, const PictureStroke& drawn) {
    if (!projector_) projector_ = std::make_unique<SurfaceProjector>(garment_.mesh);
    std::vector<SightLine> sight;
    for (const auto& [column, row] : drawn.pixels) sight.push_back(line_of_sight(drawn.picture, column, row));
    return place_view_stroke(garment_.mesh, *projector_, sight,
                             drawn.picture.camera.parallel_height.has_value(), stroke.closed, stroke.name);
  }

  PlacedStroke place(const Stroke& stroke, const TextureStroke& drawn) const {
    TextureChoice choice{{}, drawn.near};
    if (!drawn.group.empty()) choice.group = group_index(stroke, drawn.group);
    return place_texture_stroke(garment_.mesh, drawn.points, stroke.closed, choice, stroke.name);
  }

  PlacedStroke place(const Stroke& stroke, const VertexStroke& drawn) const {
    return place_path_stroke(garment_.mesh, drawn.vertices, stroke.closed, stroke.name);
  }

  PlacedStroke place(const Stroke& stroke, std::monostate) const {
    return {stroke.points, stroke.breaks, stroke.closed, {}};
  }

 private:
  int group_index(const Stroke& stroke, const std::string& group) const {
    const auto& names = garment_.group_names;
    const auto at = std::find(names.begin(), names.end(), group);
    if (at != names.end()) return static_cast<int>(at - names.begin());
    throw ContentError("stroke '" + stroke.name + "': the garment has no group '" + group + "'" +
                       (names.empty() ? "" : "; did you mean '" + nearest_word(group, names) + "'?"));
  }

  const MeshFile& garment_;
  std::unique_ptr<SurfaceProjector> projector_;
};

}  // namespace

ResolvedStrokes resolve_strokes(std::span<const DrawnStroke> strokes, const MeshFile& garment) {
  Resolving resolving(garment);
  ResolvedStrokes resolved;
  for (const DrawnStroke& drawn : strokes) {
    PlacedStroke placed =
        std::visit([&](const auto& on) { return resolving.place(drawn.stroke, on); }, drawn.on);
    Stroke stroke = drawn.stroke;
    stroke.points = std::move(placed.points);
    stroke.breaks = std::move(placed.breaks);
    stroke.closed = placed.closed;
    resolved.strokes.push_back(std::move(stroke));
    for (std::string& warning : placed.warnings) resolved.warnings.push_back(std::move(warning));
  }
  return resolved;
}

}  // namespace furrow::io
