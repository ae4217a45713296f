// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/tangent_frames.h"

#include <algorithm>
#include <cmath>

#include "geometry/mesh/property_names.h"

namespace furrow::geometry {
namespace {

double angle_between(const Vector& a, const Vector& b) {
  return std::atan2(std::sqrt(CGAL::cross_product(a, b).squared_length()), a * b);
}

Vector in_plane(const Vector& v, const Vector& normal) { return normalized(v - (v * normal) * normal); }

/// Some unit vector orthogonal to n.
Vector any_across(const Vector& n) {
  return normalized(CGAL::cross_product(std::abs(n.x()) < 0.7 ? Vector(1, 0, 0) : Vector(0, 1, 0), n));
}

class Tangents {
 public:
  explicit Tangents(const Mesh& mesh)
      : mesh_(mesh), texture_(find_map(mesh, attribute::texture)), normals_(vertex_normals(mesh)) {
    u_.assign(mesh.num_faces(), Vector(0, 0, 0));
    sign_.assign(mesh.num_faces(), 0);
    if (!texture_) return;
    for (Face f : mesh.faces()) set_face(f);
  }

  CornerFrame at(Halfedge out) const {  // of the corner at source(out) of face(out)
    CornerFrame frame;
    const Face own = mesh_.face(out);
    frame.normal = normals_[mesh_.source(out).idx()];
    frame.sign = sign_[own.idx()] < 0 ? -1 : 1;
    Vector sum(0, 0, 0);
    if (sign_[own.idx()] != 0) {
      Halfedge h = out;
      do {
        sum = sum + part_of(h, frame.normal);
        h = next_in_group(h, own);
      } while (h.is_valid() && h != out);
      for (h = h == out ? Halfedge() : previous_in_group(out, own); h.is_valid();
           h = previous_in_group(h, own))
        sum = sum + part_of(h, frame.normal);
    }
    frame.tangent = normalized(sum);
    if (!(frame.tangent.squared_length() > 0.5)) frame.tangent = any_across(frame.normal);
    return frame;
  }

 private:
  /// texture at the source of h in face(h).
  const TextureCoordinate& texture(Halfedge h) const { return (*texture_)[mesh_.prev(h)]; }

  void set_face(Face f) {
    const auto h = halfedges_of(mesh_, f);
    const Point& p = mesh_.point(mesh_.source(h[0]));
    const Vector e1 = mesh_.point(mesh_.source(h[1])) - p, e2 = mesh_.point(mesh_.source(h[2])) - p;
    const auto &a = texture(h[0]), &b = texture(h[1]), &c = texture(h[2]);
    const double x1 = b[0] - a[0], y1 = b[1] - a[1], x2 = c[0] - a[0], y2 = c[1] - a[1];
    const double area = x1 * y2 - x2 * y1;
    if (!(std::abs(area) > 0)) return;
    sign_[f.idx()] = area > 0 ? 1 : -1;
    u_[f.idx()] = double(sign_[f.idx()]) * normalized(y2 * e1 - y1 * e2);
  }

  Vector part_of(Halfedge out, const Vector& normal) const {
    const Point& p = mesh_.point(mesh_.source(out));
    const Vector a = in_plane(mesh_.point(mesh_.target(out)) - p, normal);
    const Vector b = in_plane(mesh_.point(mesh_.source(mesh_.prev(out))) - p, normal);
    return angle_between(a, b) * in_plane(u_[mesh_.face(out).idx()], normal);
  }

  /// Whether the texture goes on across the edge of h, and both faces are mirrored alike.
  bool joined(Halfedge h, Face own) const {
    const Halfedge o = mesh_.opposite(h);
    if (mesh_.is_border(h) || mesh_.is_border(o)) return false;
    return sign_[mesh_.face(h).idx()] == sign_[own.idx()] && sign_[mesh_.face(o).idx()] == sign_[own.idx()] &&
           texture(h) == (*texture_)[o] && texture(o) == (*texture_)[h];
  }
  Halfedge next_in_group(Halfedge out, Face own) const {
    const Halfedge in = mesh_.prev(out);
    return joined(in, own) ? mesh_.opposite(in) : Halfedge();
  }
  Halfedge previous_in_group(Halfedge out, Face own) const {
    return joined(out, own) ? mesh_.next(mesh_.opposite(out)) : Halfedge();
  }

  const Mesh& mesh_;
  std::optional<HalfedgeMap<TextureCoordinate>> texture_;
  std::vector<Vector> normals_;
  std::vector<Vector> u_;
  std::vector<int> sign_;
};

}  // namespace

std::vector<Vector> vertex_normals(const Mesh& mesh) {
  std::vector<Vector> normals(mesh.num_vertices(), Vector(0, 0, 0));
  for (Face f : mesh.faces()) {
    const auto c = corners_of(mesh, f);
    const Vector n = normalized(area_normal_of(mesh, f));
    for (int i = 0; i < 3; ++i) {
      const Point& p = mesh.point(c[i]);
      const double angle = angle_between(mesh.point(c[(i + 1) % 3]) - p, mesh.point(c[(i + 2) % 3]) - p);
      normals[c[i].idx()] = normals[c[i].idx()] + angle * n;
    }
  }
  for (Vector& n : normals) n = normalized(n);
  return normals;
}

TangentFrames tangent_frames(const Mesh& mesh) {
  const Tangents tangents(mesh);
  TangentFrames frames(mesh.num_faces());
  for (Face f : mesh.faces()) {
    const auto h = halfedges_of(mesh, f);
    for (int i = 0; i < 3; ++i) frames[f.idx()][i] = tangents.at(h[i]);
  }
  return frames;
}

InnerFrame frame_inside(const std::array<CornerFrame, 3>& corners, const Barycentrics& barycentrics) {
  InnerFrame frame{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  for (int i = 0; i < 3; ++i) {
    frame.tangent = frame.tangent + barycentrics[i] * corners[i].tangent;
    frame.normal = frame.normal + barycentrics[i] * corners[i].normal;
  }
  frame.bitangent = corners[0].sign * CGAL::cross_product(frame.normal, frame.tangent);
  return frame;
}

InnerFrame orthonormal(const InnerFrame& frame) {
  const Vector n = normalized(frame.normal), t = in_plane(frame.tangent, n);
  const Vector b = CGAL::cross_product(n, t);
  return {t, b * frame.bitangent < 0 ? -b : b, n};
}

}  // namespace furrow::geometry
