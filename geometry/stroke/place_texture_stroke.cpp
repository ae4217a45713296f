// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/place_texture_stroke.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/mesh/texture_charts.h"
#include "geometry/stroke/stroke_tracer.h"

namespace furrow::geometry {
namespace {

TextureCoordinate between(const TextureCoordinate& a, const TextureCoordinate& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

/// A point of the stroke in a face, strictly inside.
struct Spot {
  Face face;
  TextureCoordinate uv;
  Point position;
};

/// A straight way in the texture.
struct TextureWalk {
  std::vector<EdgeCrossing> crossings;
  std::optional<Face> reached;  ///< the face that holds the target
  bool border = false;          ///< the last crossing lies on the border of the mesh
};

class TexturePlacing {
 public:
  TexturePlacing(const Mesh& mesh, std::span<const TextureCoordinate> points, const TextureChoice& choice,
                 const std::string& name, double max_distance)
      : mesh_(mesh), charts_(mesh), points_(points), choice_(choice), placing_(mesh, name, max_distance) {}

  PlacedStroke run(bool closed) {
    std::vector<std::vector<Face>> faces;
    for (std::size_t i = 0; i < points_.size(); ++i) faces.push_back(allowed_at(i));
    const std::size_t n = points_.size(), steps = closed ? n + 1 : n;
    Spot at = spot(preferred(faces[0], 0, std::nullopt), points_[0]);
    placing_.add(at.position);
    for (std::size_t i = 1; i < steps; ++i) at = go(at, i % n, faces[i % n]);
    return placing_.take(closed);
  }

 private:
  std::vector<Face> allowed_at(std::size_t i) const {
    const TextureCoordinate& uv = points_[i];
    if (!std::isfinite(uv[0]) || !std::isfinite(uv[1])) placing_.refuse(i, "is not finite");
    const std::string place = "(" + std::to_string(uv[0]) + ", " + std::to_string(uv[1]) + ")";
    std::vector<Face> faces = charts_.faces_at(uv);
    if (faces.empty())
      placing_.refuse(i, place + " lies outside all triangles of the texture; move it onto a chart");
    if (choice_.group) {
      const auto group = find_map(mesh_, attribute::group);
      std::erase_if(faces, [&](Face f) { return !group || (*group)[f] != *choice_.group; });
      if (faces.empty()) placing_.refuse(i, place + " lies in no face of the stroke's group");
    }
    return faces;
  }

  /// Of the chart of the point before, if it may be; then the nearest to choice.near; then the lowest index.
  Face preferred(const std::vector<Face>& faces, std::size_t i, std::optional<int> chart) {
    std::vector<Face> list;
    if (chart)
      for (Face f : faces)
        if (charts_.chart(f) == *chart) list.push_back(f);
    if (list.empty()) list = faces;
    if (choice_.near) {
      const auto distance = [&](Face f) {
        return CGAL::squared_distance(spot(f, points_[i]).position, *choice_.near);
      };
      return *std::ranges::min_element(list, {}, distance);
    }
    const Point first = spot(list.front(), points_[i]).position;
    const auto elsewhere = std::count_if(list.begin(), list.end(), [&](Face f) {
      const Point p = spot(f, points_[i]).position;
      return CGAL::squared_distance(p, first) > 1e-4 * placing_.mean_edge() * placing_.mean_edge();
    });
    if (elsewhere > 0 && !chart)
      placing_.warn("point " + std::to_string(i) + " lies at " + std::to_string(1 + elsewhere) +
                    " places of the garment: that of the lowest face is taken; say which by group or near");
    return list.front();
  }

  Spot spot(Face face, const TextureCoordinate& uv) const {
    FacePoint p{face, charts_.barycentrics(face, uv)};
    double sum = 0;
    for (double& b : p.barycentrics) b = std::max(b, inside_margin), sum += b;
    for (double& b : p.barycentrics) b /= sum;
    const auto c = charts_.corners(face);
    TextureCoordinate inside{0, 0};
    for (int i = 0; i < 3; ++i)
      for (int k : {0, 1}) inside[k] += p.barycentrics[i] * c[i][k];
    return {face, inside, position_of(mesh_, p)};
  }

  Spot go(const Spot& from, std::size_t i, const std::vector<Face>& faces) {
    std::set<int> charts;
    for (Face f : faces) charts.insert(charts_.chart(f));
    const TextureWalk way = walk(from, points_[i], charts);
    if (way.reached) {
      const Spot to = spot(*way.reached, points_[i]);
      placing_.add_between(way.crossings);
      placing_.add(to.position);
      return to;
    }
    placing_.warn("a seam of the texture parts it before point " + std::to_string(i) +
                  ": it goes on as a new part");
    if (way.border)
      placing_.add_over_border(from.position, way.crossings);
    else
      placing_.add_between(way.crossings);
    placing_.begin_part();
    const Spot to = spot(preferred(faces, i, charts_.chart(from.face)), points_[i]);
    const TextureWalk back = walk(to, from.uv, {});
    if (back.border) {
      placing_.add_from_border(to.position, back.crossings);
    } else {
      for (std::size_t k = back.crossings.size(); k-- > 1;)
        placing_.add(CGAL::midpoint(back.crossings[k].position, back.crossings[k - 1].position));
    }
    placing_.add(to.position);
    return to;
  }

  static bool holds(const Barycentrics& b) { return std::min({b[0], b[1], b[2]}) >= -1e-9; }

  /// Straight to the target, over seams only to one of its charts.
  TextureWalk walk(const Spot& from, const TextureCoordinate& target, const std::set<int>& charts) const {
    TextureWalk way;
    Face face = from.face;
    TextureCoordinate start = from.uv;
    while (way.crossings.size() <= mesh_.number_of_faces()) {
      const bool wanted = charts.empty() || charts.count(charts_.chart(face)) > 0;
      if (wanted && holds(charts_.barycentrics(face, target))) return way.reached = face, way;
      const auto exit = exit_of(face, start, target);
      if (!exit) return way;
      way.crossings.push_back(*exit);
      const Halfedge beyond = mesh_.opposite(exit->halfedge);
      if (mesh_.is_border(beyond)) return way.border = true, way;
      if (charts_.is_seam(mesh_.edge(beyond))) {
        if (charts.count(charts_.chart(mesh_.face(beyond))) == 0) return way;
        start = between(charts_.at_source(beyond), charts_.at_target(beyond), 1 - exit->t);
        // The target must lie on the inner side of the seam, else the way would turn back at once.
        const Face next = mesh_.face(beyond);
        const auto h = halfedges_of(mesh_, next);
        const auto opposite = (std::find(h.begin(), h.end(), beyond) - h.begin() + 2) % 3;
        if (!(charts_.barycentrics(next, target)[opposite] > 0)) return way;
      }
      face = mesh_.face(beyond);
    }
    return way;
  }

  /// Where the line from `start` to `target` leaves a face. A corner on the line counts as beside it.
  std::optional<EdgeCrossing> exit_of(Face face, const TextureCoordinate& start,
                                      const TextureCoordinate& target) const {
    const double side = charts_.signed_area(face) < 0 ? -1 : 1;
    const auto height = [&](const TextureCoordinate& p) {
      return side * ((target[0] - start[0]) * (p[1] - start[1]) - (target[1] - start[1]) * (p[0] - start[0]));
    };
    for (Halfedge h : halfedges_of(mesh_, face)) {
      const double from = -height(charts_.at_source(h)), to = -height(charts_.at_target(h));
      if (!(from >= 0 && to < 0)) continue;
      const double t = from / (from - to);
      const Point &a = mesh_.point(mesh_.source(h)), &b = mesh_.point(mesh_.target(h));
      return EdgeCrossing{h, t, a + t * (b - a)};
    }
    return std::nullopt;
  }

  const Mesh& mesh_;
  TextureCharts charts_;
  std::span<const TextureCoordinate> points_;
  TextureChoice choice_;
  StrokePlacing placing_;
};

}  // namespace

PlacedStroke place_texture_stroke(const Mesh& mesh, std::span<const TextureCoordinate> points, bool closed,
                                  const TextureChoice& choice, const std::string& stroke_name,
                                  double max_distance) {
  if (points.empty()) StrokePlacing(mesh, stroke_name).refuse("has no points");
  return TexturePlacing(mesh, points, choice, stroke_name, max_distance).run(closed);
}

}  // namespace furrow::geometry
