// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/border_loops.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/preconditions.h"

namespace furrow::geometry {
namespace {

double mean_radius(const Mesh& mesh, const std::vector<Vertex>& loop) {
  const double n = static_cast<double>(loop.size());
  double x = 0, z = 0, sum = 0;
  for (Vertex v : loop) {
    x += mesh.point(v).x() / n;
    z += mesh.point(v).z() / n;
  }
  for (Vertex v : loop) sum += std::hypot(mesh.point(v).x() - x, mesh.point(v).z() - z);
  return sum / n;
}

BorderLoop walk(const Mesh& mesh, Halfedge start, std::vector<char>& seen) {
  BorderLoop loop;
  double height_integral = 0, height_sum = 0;
  Halfedge h = start;
  do {
    seen[h.idx()] = 1;
    const Vertex v = mesh.source(h);
    const double length = spatial_length(mesh, mesh.edge(h));
    loop.vertices.push_back(v);
    loop.length += length;
    height_integral += length * 0.5 * (mesh.point(v).y() + mesh.point(mesh.target(h)).y());
    height_sum += mesh.point(v).y();
    h = mesh.next(h);
  } while (h != start);
  loop.mean_height = loop.length > 0 ? height_integral / loop.length
                                     : height_sum / static_cast<double>(loop.vertices.size());
  loop.mean_radius = mean_radius(mesh, loop.vertices);
  std::rotate(loop.vertices.begin(), std::min_element(loop.vertices.begin(), loop.vertices.end()),
              loop.vertices.end());
  return loop;
}

}  // namespace

std::vector<BorderLoop> border_loops(const Mesh& mesh) {
  std::vector<BorderLoop> loops;
  std::vector<char> seen(mesh.num_halfedges(), 0);
  for (Halfedge h : mesh.halfedges())
    if (mesh.is_border(h) && !seen[h.idx()]) loops.push_back(walk(mesh, h, seen));
  std::stable_sort(loops.begin(), loops.end(), [](const BorderLoop& a, const BorderLoop& b) {
    return a.length != b.length ? a.length > b.length : a.vertices.front() < b.vertices.front();
  });
  return loops;
}

std::size_t find_border_loop(std::span<const BorderLoop> loops, std::string_view name) {
  const auto by_height = [](const BorderLoop& a, const BorderLoop& b) {
    return a.mean_height < b.mean_height;
  };
  if (!loops.empty() && name == "top")
    return static_cast<std::size_t>(std::max_element(loops.begin(), loops.end(), by_height) - loops.begin());
  if (!loops.empty() && name == "bottom")
    return static_cast<std::size_t>(std::min_element(loops.begin(), loops.end(), by_height) - loops.begin());
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  if (error == std::errc() && end == name.data() + name.size() && index < loops.size()) return index;
  throw std::invalid_argument(
      "border loop '" + std::string(name) + "': " +
      (loops.empty() ? "the mesh has no border"
                     : "choose top, bottom or an index from 0 to " + std::to_string(loops.size() - 1)));
}

double rest_length(const Mesh& mesh, const BorderLoop& loop) {
  return rest_length(mesh, loop, rest_lengths(mesh));
}

double rest_length(const Mesh& mesh, const BorderLoop& loop, const std::vector<double>& lengths) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
    const Vertex a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.vertices.size()];
    const Halfedge h = mesh.halfedge(a, b);
    if (!h.is_valid())
      refuse("border loop", "vertices " + std::to_string(a.idx()) + " and " + std::to_string(b.idx()) +
                                " are not joined by an edge");
    sum += lengths[mesh.edge(h).idx()];
  }
  return sum;
}

}  // namespace furrow::geometry
