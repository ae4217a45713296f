// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insert/mesh_editor.h"

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>

namespace furrow::geometry {
namespace {

double cross(const TextureCoordinate& o, const TextureCoordinate& p, const TextureCoordinate& q) {
  return (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
}

}  // namespace

MeshEditor::MeshEditor(Mesh& mesh)
    : mesh_(mesh),
      rest_(ensure_rest_lengths(mesh)),
      line_(ensure_map(mesh, attribute::line)),
      line_edge_(ensure_map(mesh, attribute::line_edge)),
      generation_(ensure_map(mesh, attribute::generation)),
      texture_(mesh),
      group_(find_map(mesh, attribute::group)),
      material_(find_map(mesh, attribute::material)),
      lining_(find_map(mesh, attribute::lining)),
      attributes_((ensure_rest_positions(mesh), mesh)) {}

/// Texture coordinate of `vertex` in the face of `inside`.
CornerTexture MeshEditor::corner_in(Halfedge inside, Vertex vertex) const {
  Halfedge h = inside;
  while (mesh_.target(h) != vertex) h = mesh_.next(h);
  return texture_.at(h);
}

void MeshEditor::make_part(Face whole, Face part) {
  attributes_.copy(whole, part);
  attributes_.change(part);
  generation_[part] = generation_[whole];
  changed_.insert(part);
}

Vertex MeshEditor::split_face(const FacePoint& point) {
  const Point position = position_of(mesh_, point);
  const auto corners = corners_of(mesh_, point.face);
  const auto sides = halfedges_of(mesh_, point.face);
  const auto spokes = lengths_to_corners(rest_lengths_of(mesh_, rest_, point.face), point.barycentrics);
  std::array<CornerTexture, 3> texture{};
  for (int i = 0; i < 3; ++i) texture[i] = texture_.at(sides[(i + 2) % 3]);
  ++generation_[point.face];
  const Halfedge in = CGAL::Euler::add_center_vertex(mesh_.halfedge(point.face), mesh_);
  const Vertex centre = mesh_.target(in);
  mesh_.point(centre) = position;
  attributes_.blend(centre, corners, point.barycentrics);
  for (int i = 0; i < 3; ++i) {
    // The part on side i: corner i, corner i + 1, centre.
    const Halfedge to_centre = mesh_.next(sides[i]), from_centre = mesh_.next(to_centre);
    const Edge spoke = mesh_.edge(from_centre);
    rest_[spoke] = spokes[i];
    attributes_.change(spoke);
    attributes_.change(mesh_.edge(sides[i]));
    make_part(point.face, mesh_.face(sides[i]));
    if (!texture_) continue;
    texture_.set(to_centre, blend_corners(texture, point.barycentrics));
    texture_.set(from_centre, texture[i]);
  }
  return centre;
}

Vertex MeshEditor::split_edge(Halfedge halfedge, double t) {
  const Vertex a = mesh_.source(halfedge), b = mesh_.target(halfedge);
  const Halfedge opposite = mesh_.opposite(halfedge);
  const Edge edge = mesh_.edge(halfedge);
  const bool border = mesh_.is_border(opposite);
  const double length = rest_[edge];
  const auto left = lengths_to_corners(
      {length, rest_[mesh_.edge(mesh_.next(halfedge))], rest_[mesh_.edge(mesh_.prev(halfedge))]},
      {1 - t, t, 0});
  const auto right = lengths_to_corners(
      {length, rest_[mesh_.edge(mesh_.next(opposite))], rest_[mesh_.edge(mesh_.prev(opposite))]},
      {t, 1 - t, 0});
  std::array<std::array<CornerTexture, 3>, 2> texture{};  // a, b, apex of both sides
  const std::array<Halfedge, 2> inside{halfedge, opposite};
  for (int side = 0; texture_ && side < (border ? 1 : 2); ++side) {
    texture[side] = {corner_in(inside[side], a), corner_in(inside[side], b),
                     texture_.at(mesh_.next(inside[side]))};
  }
  const Point& pa = mesh_.point(a);
  const Point position = pa + t * (mesh_.point(b) - pa);
  const Halfedge first =
      CGAL::Euler::split_edge(halfedge, mesh_);  // a to the new vertex; halfedge goes on to b
  const Vertex middle = mesh_.target(first);
  mesh_.point(middle) = position;
  attributes_.blend(middle, {a, b, b}, {1 - t, t, 0});
  rest_[mesh_.edge(first)] = t * length;
  rest_[mesh_.edge(halfedge)] = (1 - t) * length;
  attributes_.halve(edge, mesh_.edge(first));
  const std::array<Halfedge, 2> to_middle{first, mesh_.opposite(halfedge)};
  split_side(to_middle[0], left[2], {a, b}, texture[0], t);
  if (!border) split_side(to_middle[1], right[2], {a, b}, texture[1], t);
  return middle;
}

/// Cuts the quadrangle of `to_middle`, which ends at the new vertex of the split edge with these ends, into
/// two triangles. `texture`: of the ends (the new vertex lies at t between) and of the apex.
void MeshEditor::split_side(Halfedge to_middle, double spoke_length, const std::array<Vertex, 2>& ends,
                            const std::array<CornerTexture, 3>& texture, double t) {
  const Face face = mesh_.face(to_middle);
  const Vertex middle = mesh_.target(to_middle);
  const Halfedge to_apex = mesh_.next(mesh_.next(to_middle));
  const Vertex apex = mesh_.target(to_apex);
  const Halfedge spoke = CGAL::Euler::split_face(to_middle, to_apex, mesh_);
  rest_[mesh_.edge(spoke)] = spoke_length;
  ++generation_[face];
  for (Halfedge part : {spoke, mesh_.opposite(spoke)}) {
    make_part(face, mesh_.face(part));
    for (Halfedge h : halfedges_of(mesh_, mesh_.face(part))) {
      attributes_.change(mesh_.edge(h));
      if (!texture_) continue;
      const Vertex v = mesh_.target(h);
      if (v == middle) texture_.set(h, blend_corners({texture[0], texture[1], texture[1]}, {1 - t, t, 0}));
      if (v == apex) texture_.set(h, texture[2]);
      if (v == ends[0]) texture_.set(h, texture[0]);
      if (v == ends[1]) texture_.set(h, texture[1]);
    }
  }
}

void MeshEditor::flip_edge(Edge edge) {
  const Halfedge h = mesh_.halfedge(edge), to_c = mesh_.next(h), to_d = mesh_.next(mesh_.opposite(h));
  const Vertex c = mesh_.target(to_c);
  const double length = unfold(mesh_, rest_, edge).flipped_length();
  const std::array<Face, 2> faces{mesh_.face(h), mesh_.face(mesh_.opposite(h))};
  const int generation = std::max(generation_[faces[0]], generation_[faces[1]]);
  for (Halfedge side : {to_c, mesh_.prev(h), to_d, mesh_.prev(mesh_.opposite(h))})
    attributes_.change(mesh_.edge(side));
  CGAL::Euler::flip_edge(h, mesh_);
  rest_[edge] = length;
  attributes_.flip(edge);
  for (Face face : faces) {
    generation_[face] = generation;
    attributes_.change(face);
    changed_.insert(face);
  }
  if (!texture_) return;
  for (Halfedge part : {h, mesh_.opposite(h)})
    texture_.set(part, texture_.at(mesh_.target(part) == c ? to_c : to_d));
}

void MeshEditor::set_texture(Vertex vertex, const CornerTexture& at) {
  if (!texture_) return;
  for (Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(vertex)))
    if (!mesh_.is_border(h)) texture_.set(h, at);
}

void MeshEditor::note_moved(Vertex vertex) {
  for (Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(vertex))) {
    attributes_.change(mesh_.edge(h));
    if (mesh_.is_border(h)) continue;
    attributes_.change(mesh_.edge(mesh_.prev(mesh_.prev(h))));
    attributes_.change(mesh_.face(h));
    changed_.insert(mesh_.face(h));
  }
}

bool MeshEditor::is_seam(Edge edge) const {
  const Halfedge h = mesh_.halfedge(edge), o = mesh_.opposite(h);
  const Face f = mesh_.face(h), g = mesh_.face(o);
  for (const auto& map : {group_, material_, lining_})
    if (map && (*map)[f] != (*map)[g]) return true;
  return texture_ && !(same_texture(texture_.at(h), texture_.at(mesh_.prev(o))) &&
                       same_texture(texture_.at(o), texture_.at(mesh_.prev(h))));
}

std::vector<std::array<double, 4>> MeshEditor::texture_areas(Edge edge) const {
  const Halfedge h = mesh_.halfedge(edge), o = mesh_.opposite(h);
  const CornerTexture at_a = texture_.at(o), at_b = texture_.at(h), at_c = texture_.at(mesh_.next(h)),
                      at_d = texture_.at(mesh_.next(o));
  std::vector<std::array<double, 4>> areas;
  for (std::size_t m = 0; m < 2; ++m) {
    const TextureCoordinate &a = at_a[m], &b = at_b[m], &c = at_c[m], &d = at_d[m];
    if (texture_.has(m)) areas.push_back({cross(a, b, c), cross(b, a, d), cross(a, d, c), cross(d, b, c)});
  }
  return areas;
}

std::optional<Edge> MeshEditor::edge_between(Vertex a, Vertex b) const {
  const Halfedge h = mesh_.halfedge(a, b);
  return h.is_valid() ? std::optional(mesh_.edge(h)) : std::nullopt;
}

}  // namespace furrow::geometry
