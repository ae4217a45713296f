// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sketch/sketch_tangles.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "jobs/base/measure_crossings.h"

namespace furrow::jobs {
namespace {

constexpr std::uint8_t magenta[] = {214, 0, 147};
constexpr std::uint8_t pale[] = {216, 210, 198};

}  // namespace

std::vector<std::uint8_t> marked_crossings(const geometry::Mesh& mesh,
                                           const std::vector<geometry::Index<geometry::Face>>& faces,
                                           std::vector<std::uint8_t> base) {
  std::vector<char> crosses(mesh.num_vertices(), 0);
  for (const geometry::Face f : faces)
    for (const geometry::Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) crosses[v.idx()] = 1;
  std::size_t at = 0;
  for (const geometry::Vertex v : mesh.vertices()) {
    if (crosses[v.idx()]) std::copy_n(magenta, 3, base.begin() + std::ptrdiff_t(at));
    at += 3;
  }
  return base;
}

SketchTangles find_tangles(const Sketch& sketch, const Json& strokes, Listener& listener) {
  const io::MeshFile file = draw_sketch(sketch, strokes, listener).file;
  const ClothCrossings crossings = measure_crossings(file);
  SketchTangles tangles{crossings.pairs, "The cloth crosses itself nowhere.", {}, {}};
  std::vector<std::uint8_t> base;
  for (std::size_t i = 0; i < file.mesh->number_of_vertices(); ++i) base.insert(base.end(), pale, pale + 3);
  tangles.colours = marked_crossings(file.mesh, crossings.faces, std::move(base));
  if (crossings.pairs == 0) return tangles;
  tangles.words = words(crossings) + ". It is magenta.";
  const auto& at = crossings.places.at(0).centre;
  tangles.worst = {at.x(), at.y(), at.z()};
  return tangles;
}

}  // namespace furrow::jobs
