// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/seam_ties.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "bridge/arrays/gather.h"
#include "geometry/mesh/struts.h"
#include "geometry/rest/tie_length.h"
#include "io/base/figure_path.h"
#include "io/mesh/merge_points.h"

namespace furrow::jobs {
namespace {

using geometry::Vertex;

/// For each vertex the lowest one that it is tied to, through others, too.
std::vector<std::size_t> knots_of(std::size_t vertices, const SeamTies& ties) {
  std::vector<std::size_t> knot(vertices);
  std::iota(knot.begin(), knot.end(), std::size_t{0});
  const auto first = [&](std::size_t v) {
    while (knot[v] != v) v = knot[v] = knot[knot[v]];
    return v;
  };
  for (const auto& [a, b] : ties) {
    const std::size_t p = first(a.idx()), q = first(b.idx());
    knot[std::max(p, q)] = std::min(p, q);
  }
  for (std::size_t v = 0; v < vertices; ++v) knot[v] = first(v);
  return knot;
}

}  // namespace

SeamTies doubled_vertices(const io::MeshFile& file) {
  SeamTies ties;
  const std::size_t own = file.mesh->num_vertices() - file.repairs.duplicated_vertices;
  if (own == file.mesh->num_vertices()) return ties;
  io::PointNumbers numbers;
  std::vector<Vertex> first;  // of each point
  for (const Vertex v : file.mesh->vertices()) {
    if (file.mesh->is_isolated(v)) continue;
    const auto [number, is_new] = numbers.number(file.mesh->point(v));
    if (is_new)
      first.push_back(v);
    else if (v.idx() >= own)
      ties.push_back({first[number], v});
  }
  return ties;
}

SeamTies seam_ties(const geometry::Mesh& mesh) {
  SeamTies ties;
  for (const geometry::Strut& s : geometry::struts(mesh))
    if (s.rest_length <= geometry::tie_length) ties.push_back({s.a, s.b});
  return ties;
}

SeamTies all_ties(const io::MeshFile& file, const std::string& name, const Context& context) {
  SeamTies ties = seam_ties(file.mesh);
  const SeamTies doubled = doubled_vertices(file);
  ties.insert(ties.end(), doubled.begin(), doubled.end());
  if (!doubled.empty())
    context.warn(
        "seams_tied",
        name + ": " + std::to_string(doubled.size()) +
            " vertices that reading doubled, where three or more faces meet, are tied together again",
        name, "`furrow doctor`");
  return ties;
}

void warn_of_lost_ties(const geometry::Mesh& mesh, const std::filesystem::path& output, Listener& listener) {
  if (output.empty() || io::ending_of(output) == ".ply" || seam_ties(mesh).empty()) return;
  listener.warn({"ties_lost",
                 output.string() + ": ties of seams where three or more faces meet go into a .ply alone",
                 output.string(), "-o OUT.ply"});
}

SeamTies refined_ties(const geometry::Mesh& before, const SeamTies& ties) {
  SeamTies refined = ties;
  if (ties.empty()) return refined;
  const std::size_t vertices = before.num_vertices();
  const std::vector<std::size_t> knot = knots_of(vertices, ties);
  struct Side {
    std::array<std::size_t, 2> knots;
    std::size_t edge;
  };
  std::vector<char> tied(vertices, 0);
  for (const auto& [a, b] : ties) tied[knot[a.idx()]] = 1;
  std::vector<Side> sides;
  for (const geometry::Edge e : before.edges()) {
    const std::size_t a = knot[before.vertex(e, 0).idx()], b = knot[before.vertex(e, 1).idx()];
    if (tied[a] && tied[b]) sides.push_back({{std::min(a, b), std::max(a, b)}, e.idx()});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
    return std::tie(s.knots, s.edge) < std::tie(t.knots, t.edge);
  });
  using Index = Vertex::size_type;
  for (std::size_t i = 1, first = 0; i < sides.size(); ++i) {
    if (sides[i].knots != sides[first].knots)
      first = i;
    else
      refined.push_back(
          {Vertex(Index(vertices + sides[first].edge)), Vertex(Index(vertices + sides[i].edge))});
  }
  return refined;
}

double tie_stiffness(const io::SceneMaterial& material) {
  return material.stretch ? bridge::spring_constant_of(*material.stretch) : material.stiffness;
}

void set_seam_ties(geometry::Mesh& mesh, const SeamTies& ties, const io::SceneMaterial& material) {
  const double stiffness = tie_stiffness(material);
  std::vector<geometry::Strut> all = geometry::struts(mesh);
  std::erase_if(all, [](const geometry::Strut& s) { return s.rest_length <= geometry::tie_length; });
  for (const auto& [a, b] : ties) all.push_back({a, b, geometry::tie_length, stiffness});
  geometry::set_struts(mesh, all);
}

void part_seam_ties(geometry::Mesh& mesh) {
  constexpr double apart = 1e-8;  // [m]
  std::vector<char> parted(mesh.num_vertices(), 0);
  for (const auto& [a, b] : seam_ties(mesh))
    if (CGAL::squared_distance(mesh.point(a), mesh.point(b)) < apart * apart / 4)
      parted[a.idx()] = parted[b.idx()] = 1;
  for (const Vertex v : mesh.vertices()) {
    if (!parted[v.idx()]) continue;
    geometry::Vector inwards = CGAL::NULL_VECTOR;
    for (const Vertex u : mesh.vertices_around_target(mesh.halfedge(v)))
      inwards = inwards + (mesh.point(u) - mesh.point(v));
    const double length = std::sqrt(inwards.squared_length());
    if (length > 0) mesh.point(v) = mesh.point(v) + apart / length * inwards;
  }
}

void close_seam_ties(geometry::Mesh& mesh) {
  const SeamTies ties = seam_ties(mesh);
  if (ties.empty()) return;
  const std::vector<std::size_t> knot = knots_of(mesh.num_vertices(), ties);
  std::vector<geometry::Vector> sum(knot.size(), CGAL::NULL_VECTOR);
  std::vector<int> count(knot.size(), 0);
  for (const Vertex v : mesh.vertices()) {
    sum[knot[v.idx()]] = sum[knot[v.idx()]] + (mesh.point(v) - CGAL::ORIGIN);
    ++count[knot[v.idx()]];
  }
  for (const Vertex v : mesh.vertices())
    if (const int n = count[knot[v.idx()]]; n > 1)
      mesh.point(v) = CGAL::ORIGIN + sum[knot[v.idx()]] / double(n);
}

}  // namespace furrow::jobs
