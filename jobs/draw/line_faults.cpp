// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/line_faults.h"

#include <CGAL/Origin.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/mesh/measures.h"
#include "geometry/mesh/parts.h"
#include "geometry/mesh/self_intersections.h"
#include "geometry/stroke/walk_surface.h"
#include "physics/base/cancel_scope.h"

namespace furrow::jobs {
namespace {

using geometry::Face;
using geometry::Mesh;
using geometry::Point;
using geometry::Vector;
using geometry::Vertex;

constexpr double short_way = 1.5;          ///< along the cloth, over the straight one
constexpr double least_volume = 0.005;     ///< enclosed, over area^(3/2): a ball has 0.094, a flat sheet 0
constexpr std::size_t most_looked = 2000;  ///< pairs

Point centre_of(const Mesh& mesh, Face f) {
  const auto c = geometry::corners_of(mesh, f);
  return CGAL::centroid(mesh.point(c[0]), mesh.point(c[1]), mesh.point(c[2]));
}

/// Whether a way along the cloth from f, not much longer than the straight one, leads to g.
bool lies_beside(const Mesh& mesh, Face f, Face g) {
  const Point from = centre_of(mesh, f), to = centre_of(mesh, g);
  double longest = 0;
  for (const Face face : {f, g})
    for (const geometry::Halfedge h : geometry::halfedges_of(mesh, face))
      longest =
          std::max(longest, CGAL::squared_distance(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))));
  const double radius = short_way * std::sqrt(CGAL::squared_distance(from, to)) + std::sqrt(longest);
  const std::vector<Face> near = geometry::faces_reachable_within(mesh, f, from, radius);
  return std::binary_search(near.begin(), near.end(), g);
}

/// Six times what the faces of each part enclose with its openings, each closed by a fan, and how many there
/// are.
struct Enclosed {
  double volume = 0;
  int openings = 0;
};

std::vector<Enclosed> enclosed_by(const Mesh& mesh, const geometry::Parts& parts) {
  std::vector<Enclosed> result(parts.list.size());
  const auto add = [&](int part, const Point& a, const Point& b, const Point& c) {
    const Point& o = parts.list[std::size_t(part)].centre;
    result[std::size_t(part)].volume += CGAL::determinant(a - o, b - o, c - o);
  };
  for (const Face f : mesh.faces()) {
    const auto c = geometry::corners_of(mesh, f);
    add(parts.of_face[f.idx()], mesh.point(c[0]), mesh.point(c[1]), mesh.point(c[2]));
  }
  std::vector<bool> seen(mesh.num_halfedges(), false);
  for (const geometry::Halfedge first : mesh.halfedges()) {
    if (!mesh.is_border(first) || seen[first.idx()]) continue;
    std::vector<geometry::Halfedge> loop;
    Vector sum = CGAL::NULL_VECTOR;
    for (geometry::Halfedge h = first; !seen[h.idx()]; h = mesh.next(h)) {
      seen[h.idx()] = true;
      loop.push_back(h);
      sum = sum + (mesh.point(mesh.source(h)) - CGAL::ORIGIN);
    }
    const Point middle = CGAL::ORIGIN + sum / double(loop.size());
    const int part = parts.of_vertex[mesh.source(first).idx()];
    if (part < 0) continue;
    for (const geometry::Halfedge h : loop)
      add(part, mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), middle);
    ++result[std::size_t(part)].openings;
  }
  return result;
}

std::string names_of(const std::vector<const geometry::WrinkledLine*>& lines) {
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, lines.size()); ++i)
    text += (i ? ", '" : "'") + lines[i]->name + "'";
  return lines.size() > most ? text + fmt::format(" and {} more", lines.size() - most) : text;
}

}  // namespace

std::optional<Warning> layers_crossed(const Mesh& mesh, const geometry::WrinkleReport& lines,
                                      const ClothCrossings& now) {
  if (now.pairs <= now.from_start || lines.undisplaced.size() != mesh.num_vertices()) return std::nullopt;
  Mesh flat = mesh;
  for (const Vertex v : flat.vertices()) flat.point(v) = lines.undisplaced[v.idx()];
  std::vector<char> crossed(mesh.num_faces(), 0);
  for (const auto& [f, g] : geometry::self_intersections(flat)) crossed[f.idx()] = crossed[g.idx()] = 1;
  std::size_t pairs = 0, looked = 0;
  Vector sum = CGAL::NULL_VECTOR;
  for (const auto& [f, g] : geometry::self_intersections(mesh)) {
    physics::throw_if_cancelled("layers_crossed");
    if (crossed[f.idx()] || crossed[g.idx()]) continue;
    if (++looked > most_looked || lies_beside(flat, f, g)) continue;
    ++pairs;
    sum = sum + (centre_of(mesh, f) - CGAL::ORIGIN);
  }
  if (pairs == 0) return std::nullopt;
  const Point at = CGAL::ORIGIN + sum / double(pairs);
  return Warning{
      "layers_cross",
      fmt::format("the lines raise one layer of cloth through another: {}{} pair{} of faces of different "
                  "layers cross that did not, around ({:.2f}, {:.2f}, {:.2f}) m; draw where the cloth lies "
                  "single, or lower, or where the layers are farther apart",
                  looked > most_looked ? "at least " : "", pairs, pairs == 1 ? "" : "s", at.x(), at.y(),
                  at.z()),
      "", "lines.height"};
}

std::optional<Warning> lines_inside_out(const Mesh& mesh, const geometry::WrinkleReport& lines) {
  const geometry::Parts parts = geometry::find_parts(mesh);
  const std::vector<Enclosed> enclosed = enclosed_by(mesh, parts);
  const auto is_inside_out = [&](int part) {
    if (part < 0) return false;
    const Enclosed& e = enclosed[std::size_t(part)];
    const double area = parts.list[std::size_t(part)].area;
    return e.openings != 1 && e.volume / 6 < -least_volume * std::pow(area, 1.5);
  };
  std::vector<const geometry::WrinkledLine*> found;
  for (const geometry::WrinkledLine& line : lines.lines)
    if (!line.chains.empty() && !line.chains.front().empty() &&
        is_inside_out(parts.of_vertex[line.chains.front().front().idx()]))
      found.push_back(&line);
  if (found.empty()) return std::nullopt;
  return Warning{
      "inside_out",
      names_of(found) + (found.size() == 1 ? ": drawn" : ": drawn") +
          " on cloth that is inside out (its normals point inwards), so that ridges go in and valleys come "
          "out; turn the faces of the garment, or give heights the other sign",
      "", "height"};
}

}  // namespace furrow::jobs
