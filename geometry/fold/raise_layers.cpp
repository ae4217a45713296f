// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/raise_layers.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "geometry/mesh/face_point.h"
#include "geometry/mesh/patch.h"
#include "geometry/stroke/project_onto_surface.h"

namespace furrow::geometry {
namespace {

constexpr double least_raise = 1e-6;         // [m]
constexpr double reach_of_raise = 3;         // distance over the raise, beyond which a layer stays
constexpr double beside = 0.3, above = 0.7;  // cosines with the normal: none and all of it lies over
constexpr double enough = 1e-3;              // of a raise that may be missing
constexpr int most_passes = 20;

/// Connected faces that lines raised, where they lay, and how far each vertex is raised.
struct RaisedPatch {
  Mesh flat;
  std::vector<Vertex> vertices;  ///< of the whole
  std::vector<Vector> raise;     ///< by vertex of the patch [m]
  CGAL::Bbox_3 box;              ///< of all that may be raised with it
};

/// What a place of a face over a patch asks for.
struct LayerLift {
  Vertex below;  ///< of the patch
  Face face;     ///< of the whole
  Barycentrics b;
  Vector raise;  ///< [m]
};

/// Of a vertex or a face, by its index.
struct LayerBox : CGAL::Box_intersection_d::Box_d<double, 3> {
  LayerBox(const CGAL::Bbox_3& box, std::size_t i) : Box_d(box), index(i) {}
  std::size_t index;
};

double clamp01(double x) { return std::clamp(x, 0.0, 1.0); }

/// The share of a raise that a place takes over, which lies so far off.
double share_over(const Vector& off, const Vector& normal, double raise) {
  const double distance = std::sqrt(off.squared_length());
  const double near = clamp01((reach_of_raise - distance / raise) / (reach_of_raise - 1));
  const double cosine = distance > least_raise ? off * normal / distance : 1;
  return near * clamp01((cosine - beside) / (above - beside));
}

Vector unit_normal(const Mesh& mesh, Face f) { return normalized(area_normal_of(mesh, f)); }

class LayerRaiser {
 public:
  LayerRaiser(Mesh& mesh, const std::vector<Coordinates<Point>>& undisplaced,
              std::span<const Index<Vertex>> held)
      : mesh_(mesh), flat_(undisplaced.begin(), undisplaced.end()), held_(mesh.num_vertices(), 0) {
    for (const Vertex v : held) held_[v.idx()] = 1;
    for (const Vertex v : mesh.vertices()) lines_.push_back(mesh.point(v) - flat_[v.idx()]);
  }

  RaisedLayers raise() {
    std::vector<Vector> sum(mesh_.num_vertices(), CGAL::NULL_VECTOR);
    for (std::vector<Face>& faces : raised_faces()) raise_over(patch_of(std::move(faces)), sum);
    RaisedLayers result;
    for (const Vertex v : mesh_.vertices()) {
      const double length = std::sqrt(sum[v.idx()].squared_length());
      if (length < least_raise) continue;
      mesh_.point(v) = mesh_.point(v) + sum[v.idx()];
      ++result.vertices;
      result.most = std::max(result.most, length);
    }
    return result;
  }

 private:
  bool is_raised(Face f) const {
    const auto c = corners_of(mesh_, f);
    const Vector sum = lines_[c[0].idx()] + lines_[c[1].idx()] + lines_[c[2].idx()];
    if (sum.squared_length() < least_raise * least_raise) return false;
    const Point& p = flat_[c[0].idx()];
    return sum * normalized(CGAL::cross_product(flat_[c[1].idx()] - p, flat_[c[2].idx()] - p)) >
           3 * least_raise;
  }

  /// By connected patch, ascending.
  std::vector<std::vector<Face>> raised_faces() const {
    std::vector<char> open(mesh_.num_faces(), 0);
    for (const Face f : mesh_.faces()) open[f.idx()] = is_raised(f);
    std::vector<std::vector<Face>> patches;
    for (const Face first : mesh_.faces()) {
      if (!open[first.idx()]) continue;
      std::vector<Face> patch{first};
      open[first.idx()] = 0;
      for (std::size_t i = 0; i < patch.size(); ++i)
        for (const Halfedge h : halfedges_of(mesh_, patch[i])) {
          const Face f = mesh_.face(mesh_.opposite(h));
          if (f == Mesh::null_face() || !open[f.idx()]) continue;
          open[f.idx()] = 0;
          patch.push_back(f);
        }
      std::sort(patch.begin(), patch.end());
      patches.push_back(std::move(patch));
    }
    return patches;
  }

  /// The faces where they lay.
  Patch flat_patch(std::vector<Face> faces) const {
    Patch patch = cut_patch(mesh_, std::move(faces));
    for (const Vertex v : patch.mesh.vertices()) patch.mesh.point(v) = flat_[patch.vertices[v.idx()].idx()];
    return patch;
  }

  RaisedPatch patch_of(std::vector<Face> faces) const {
    Patch cut = flat_patch(std::move(faces));
    RaisedPatch patch{std::move(cut.mesh), std::move(cut.vertices), {}, {}};
    double most = 0;
    for (const Vertex v : patch.vertices) {
      patch.raise.push_back(lines_[v.idx()]);
      patch.box += flat_[v.idx()].bbox();
      most = std::max(most, std::sqrt(patch.raise.back().squared_length()));
    }
    const double r = reach_of_raise * most;
    patch.box = {patch.box.xmin() - r, patch.box.ymin() - r, patch.box.zmin() - r,
                 patch.box.xmax() + r, patch.box.ymax() + r, patch.box.zmax() + r};
    return patch;
  }

  static bool is_of(const RaisedPatch& patch, Vertex v) {
    return std::binary_search(patch.vertices.begin(), patch.vertices.end(), v);
  }

  /// The vertices of the whole that may lie over a patch, but its own.
  std::vector<Vertex> near_to(const RaisedPatch& patch) const {
    std::vector<Vertex> near;
    for (const Vertex v : mesh_.vertices())
      if (CGAL::do_overlap(patch.box, flat_[v.idx()].bbox()) && !held_[v.idx()] && !mesh_.is_isolated(v) &&
          !is_of(patch, v))
        near.push_back(v);
    return near;
  }

  static Vector raise_at(const RaisedPatch& patch, const FacePoint& at) {
    Vector raise = CGAL::NULL_VECTOR;
    const auto corners = corners_of(patch.flat, at.face);
    for (std::size_t k = 0; k < 3; ++k) raise = raise + at.barycentrics[k] * patch.raise[corners[k].idx()];
    return raise;
  }

  /// Adds what the patch raises to the sums of the vertices over it, and of the corners of faces that span
  /// it.
  void raise_over(const RaisedPatch& patch, std::vector<Vector>& sum) const {
    const SurfaceProjector lower(patch.flat);
    std::vector<Vector> own(mesh_.num_vertices(), CGAL::NULL_VECTOR);
    for (const Vertex v : near_to(patch)) {
      const SurfaceHit hit = lower.closest(flat_[v.idx()]);
      const Vector raise = raise_at(patch, hit.point);
      const double length = std::sqrt(raise.squared_length());
      if (length < least_raise) continue;
      const double share =
          share_over(flat_[v.idx()] - hit.position, unit_normal(patch.flat, hit.point.face), length);
      own[v.idx()] = share * raise;
    }
    clear(patch, own);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = sum[i] + own[i];
  }

  /// The faces that each vertex of a patch, raised as far as layers go along, would come upon.
  std::vector<LayerLift> lifts_over(const RaisedPatch& patch) const {
    std::vector<LayerBox> ways, faces;
    for (const Vertex v : patch.flat.vertices())
      if (patch.raise[v.idx()].squared_length() > least_raise * least_raise)
        ways.emplace_back(way_over(patch, v).bbox(), v.idx());
    for (const Face f : mesh_.faces())
      if (const CGAL::Bbox_3 box = flat_triangle(f).bbox();
          CGAL::do_overlap(patch.box, box) && !touches(patch, f))
        faces.emplace_back(box, f.idx());
    std::vector<LayerLift> lifts;
    CGAL::box_intersection_d(ways.begin(), ways.end(), faces.begin(), faces.end(),
                             [&](const LayerBox& way, const LayerBox& face) {
                               const Vertex v(Vertex::size_type(way.index));
                               if (const auto lift = lift_at(patch, v, Face(Face::size_type(face.index))))
                                 lifts.push_back(*lift);
                             });
    std::sort(lifts.begin(), lifts.end(), [](const auto& a, const auto& b) {
      return std::tie(a.below, a.face) < std::tie(b.below, b.face);
    });
    return lifts;
  }

  static CGAL::Segment_3<Point::R> way_over(const RaisedPatch& patch, Vertex v) {
    const Point& p = patch.flat.point(v);
    return {p, p + reach_of_raise * patch.raise[v.idx()]};
  }

  bool touches(const RaisedPatch& patch, Face f) const {
    const auto c = corners_of(mesh_, f);
    return std::any_of(c.begin(), c.end(), [&](Vertex v) { return is_of(patch, v); });
  }

  CGAL::Triangle_3<Point::R> flat_triangle(Face f) const {
    const auto c = corners_of(mesh_, f);
    return {flat_[c[0].idx()], flat_[c[1].idx()], flat_[c[2].idx()]};
  }

  /// Where the way of a vertex meets a face, if it does.
  std::optional<LayerLift> lift_at(const RaisedPatch& patch, Vertex v, Face f) const {
    const auto way = way_over(patch, v);
    const auto t = flat_triangle(f);
    const std::array<double, 3> volumes{CGAL::volume(way[0], way[1], t[1], t[2]),
                                        CGAL::volume(way[0], way[1], t[2], t[0]),
                                        CGAL::volume(way[0], way[1], t[0], t[1])};
    const double sum = volumes[0] + volumes[1] + volumes[2];
    if (sum == 0 || std::any_of(volumes.begin(), volumes.end(), [&](double x) { return x / sum < 0; }))
      return std::nullopt;
    LayerLift lift{v, f, {volumes[0] / sum, volumes[1] / sum, volumes[2] / sum}, patch.raise[v.idx()]};
    Vector off = way[0] - CGAL::ORIGIN;
    for (std::size_t k = 0; k < 3; ++k) off = off - lift.b[k] * (t[int(k)] - CGAL::ORIGIN);
    const double length = std::sqrt(lift.raise.squared_length());
    if (off * lift.raise > 0) return std::nullopt;  // it lies below
    lift.raise = share_over(-off, lift.raise / length, length) * lift.raise;
    return lift;
  }

  /// Raises corners of the faces over a patch until these clear it.
  void clear(const RaisedPatch& patch, std::vector<Vector>& own) const {
    const std::vector<LayerLift> lifts = lifts_over(patch);
    for (int pass = 0; pass < most_passes; ++pass)
      if (!std::count_if(lifts.begin(), lifts.end(), [&](const LayerLift& lift) { return meet(lift, own); }))
        return;
  }

  /// Raises the corners by what is missing at a place; whether anything was.
  bool meet(const LayerLift& lift, std::vector<Vector>& own) const {
    const double wanted = lift.raise.squared_length();
    if (wanted < least_raise * least_raise) return false;
    const auto corners = corners_of(mesh_, lift.face);
    double has = 0, squares = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      has += lift.b[k] * (own[corners[k].idx()] * lift.raise);
      if (!held_[corners[k].idx()]) squares += lift.b[k] * lift.b[k];
    }
    if (wanted - has <= enough * wanted || squares == 0) return false;
    for (std::size_t k = 0; k < 3; ++k)
      if (const std::size_t v = corners[k].idx(); !held_[v])
        own[v] = own[v] + (1 - has / wanted) * lift.b[k] / squares * lift.raise;
    return true;
  }

  Mesh& mesh_;
  std::vector<Point> flat_;  ///< by vertex: where it lay
  std::vector<char> held_;
  std::vector<Vector> lines_;  ///< by how far lines moved each vertex [m]
};

}  // namespace

RaisedLayers raise_layers(Mesh& mesh, const std::vector<Coordinates<Point>>& undisplaced,
                          std::span<const Index<Vertex>> held) {
  return LayerRaiser(mesh, undisplaced, held).raise();
}

}  // namespace furrow::geometry
