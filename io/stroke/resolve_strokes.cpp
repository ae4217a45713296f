// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/stroke/resolve_strokes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "geometry/mesh/errors.h"
#include "geometry/stroke/place_path_stroke.h"
#include "geometry/stroke/place_texture_stroke.h"
#include "geometry/stroke/place_view_stroke.h"
#include "io/base/nearest_word.h"

namespace furrow::io {
namespace {

using namespace geometry;

class Resolving {
 public:
  Resolving(const MeshFile& garment, double max_distance) : garment_(garment), max_distance_(max_distance) {}

  PlacedStroke place(const Stroke& stroke, const PictureStroke& drawn) {
    if (!projector_) projector_ = std::make_unique<SurfaceProjector>(garment_.mesh);
    std::vector<SightLine> sight;
    for (const auto& [column, row] : drawn.pixels) sight.push_back(line_of_sight(drawn.picture, column, row));
    PlacedStroke placed =
        place_view_stroke(garment_.mesh, *projector_, sight, drawn.picture.camera.parallel_height.has_value(),
                          stroke.closed, stroke.name, max_distance_);
    warn_of_pixels_outside(stroke, drawn, placed.warnings);
    return placed;
  }

  PlacedStroke place(const Stroke& stroke, const TextureStroke& drawn) const {
    TextureChoice choice{{}, drawn.near};
    if (!drawn.group.empty()) choice.group = group_index(stroke, drawn.group);
    return place_texture_stroke(garment_.mesh, drawn.points, stroke.closed, choice, stroke.name,
                                max_distance_);
  }

  PlacedStroke place(const Stroke& stroke, const VertexStroke& drawn) const {
    return place_path_stroke(garment_.mesh, drawn.vertices, stroke.closed, stroke.name);
  }

  PlacedStroke place(const Stroke& stroke, std::monostate) const {
    return {{stroke.points.begin(), stroke.points.end()}, stroke.breaks, stroke.closed, {}};
  }

 private:
  /// They may lie beside the garment, but mostly they are those of a picture of another size.
  static void warn_of_pixels_outside(const Stroke& stroke, const PictureStroke& drawn,
                                     std::vector<std::string>& warnings) {
    const auto width = drawn.picture.width, height = drawn.picture.height;
    const auto outside = [&](const auto& pixel) {
      return !(pixel[0] >= -0.5 && pixel[0] <= width - 0.5 && pixel[1] >= -0.5 && pixel[1] <= height - 0.5);
    };
    const auto at = std::find_if(drawn.pixels.begin(), drawn.pixels.end(), outside);
    if (at == drawn.pixels.end()) return;
    warnings.push_back("stroke \"" + stroke.name + "\": point " + std::to_string(at - drawn.pixels.begin()) +
                       " lies outside of the camera's picture of " + std::to_string(width) + " by " +
                       std::to_string(height) + " pixels");
  }

  int group_index(const Stroke& stroke, const std::string& group) const {
    const auto& names = garment_.group_names;
    const auto at = std::find(names.begin(), names.end(), group);
    if (at != names.end()) return static_cast<int>(at - names.begin());
    throw ContentError("stroke '" + stroke.name + "': the garment has no group '" + group + "'" +
                       (names.empty() ? "" : "; did you mean '" + nearest_word(group, names) + "'?"));
  }

  const MeshFile& garment_;
  double max_distance_;
  std::unique_ptr<SurfaceProjector> projector_;
};

/// Where each point of a polyline lies along it, as a share of its length [-]: in [0, 1], ascending.
std::vector<double> shares(std::size_t points, bool closed,
                           const std::function<double(std::size_t, std::size_t)>& apart) {
  std::vector<double> along(points, 0);
  for (std::size_t i = 1; i < points; ++i) along[i] = along[i - 1] + apart(i - 1, i);
  const double whole = points == 0 ? 0 : along.back() + (closed ? apart(points - 1, 0) : 0);
  for (double& a : along) a = whole > 0 ? a / whole : 0;
  return along;
}

std::vector<double> drawn_shares(const DrawnStroke& drawn) {
  const auto planar = [&](const std::vector<std::array<double, 2>>& p) {
    return shares(p.size(), drawn.stroke.closed, [&](std::size_t i, std::size_t j) {
      return std::hypot(p[j][0] - p[i][0], p[j][1] - p[i][1]);
    });
  };
  if (const auto* on = std::get_if<PictureStroke>(&drawn.on)) return planar(on->pixels);
  if (const auto* on = std::get_if<TextureStroke>(&drawn.on)) return planar(on->points);
  const auto* on = std::get_if<VertexStroke>(&drawn.on);
  return shares(on ? on->vertices.size() : 0, drawn.stroke.closed,
                [](std::size_t, std::size_t) { return 1; });
}

/// Numbers at the points drawn become numbers at the points placed, at the same share of the length.
void move_numbers(const DrawnStroke& drawn, Stroke& stroke) {
  if (std::holds_alternative<std::monostate>(drawn.on)) return;
  const std::vector<double> from = drawn_shares(drawn);
  const std::vector<Point> points(stroke.points.begin(), stroke.points.end());
  const std::vector<double> to = shares(points.size(), stroke.closed, [&](std::size_t i, std::size_t j) {
    return std::sqrt(CGAL::squared_distance(points[i], points[j]));
  });
  for (std::vector<double>* list : {&stroke.heights, &stroke.widths}) {
    if (list->empty()) continue;
    std::vector<double> placed;
    for (double share : to) {
      const auto next = std::upper_bound(from.begin(), from.end(), share) - from.begin();
      const std::size_t i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - 1, 0));
      const bool last = i + 1 == from.size();
      const double end = last ? 1 : from[i + 1];
      const double after = !last ? (*list)[i + 1] : stroke.closed ? list->front() : list->back();
      const double t = end > from[i] ? std::clamp((share - from[i]) / (end - from[i]), 0.0, 1.0) : 0;
      placed.push_back((1 - t) * (*list)[i] + t * after);
    }
    *list = std::move(placed);
  }
}

}  // namespace

ResolvedStrokes resolve_strokes(std::span<const DrawnStroke> strokes, const MeshFile& garment,
                                double max_distance) {
  Resolving resolving(garment, max_distance);
  ResolvedStrokes resolved;
  StrokeFaults faults;
  for (const DrawnStroke& drawn : strokes) {
    PlacedStroke placed;
    try {
      placed = std::visit([&](const auto& on) { return resolving.place(drawn.stroke, on); }, drawn.on);
    } catch (const ContentError& e) {
      faults.add(e.what());
      continue;
    }
    Stroke stroke = drawn.stroke;
    stroke.points.assign(placed.points.begin(), placed.points.end());
    stroke.breaks = std::move(placed.breaks);
    stroke.closed = placed.closed;
    move_numbers(drawn, stroke);
    resolved.strokes.push_back(std::move(stroke));
    for (std::string& warning : placed.warnings) resolved.warnings.push_back(std::move(warning));
  }
  faults.raise();
  return resolved;
}

}  // namespace furrow::io
