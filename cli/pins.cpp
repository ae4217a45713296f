// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/pins.h"

#include <algorithm>

#include "cli/common.h"
#include "geometry/border_loops.h"
#include "geometry/select_vertices.h"
#include "physics/pins.h"

namespace furrow::cli {
namespace {

using geometry::Vertex;

void add_named(std::vector<int>& pins, const std::vector<Vertex>& vertices, const std::string& name) {
  if (vertices.empty()) throw UsageError(name + " names no vertex");
  for (Vertex v : vertices) pins.push_back(static_cast<int>(v));
}

std::vector<Vertex> box(const geometry::Mesh& mesh, const std::string& text) {
  const std::vector<double> b = parse_numbers(text, 6, "--pin-box");
  return geometry::vertices_in_box(mesh, {b[0], b[1], b[2]}, {b[3], b[4], b[5]});
}

std::vector<Vertex> group(const io::MeshFile& file, const std::string& name) {
  const auto at = std::find(file.group_names.begin(), file.group_names.end(), name);
  if (at == file.group_names.end()) return {};
  return geometry::vertices_of_group(file.mesh, static_cast<int>(at - file.group_names.begin()));
}

}  // namespace

void add_pin_options(CLI::App& sub, PinArguments& a) {
  sub.add_option("--pin-box", a.boxes,
                 "hold the vertices in a box x0,y0,z0,x1,y1,z1 [m, y up]; may be given again")
      ->allow_extra_args(false);
  sub.add_option("--pin-loop", a.loops, "hold a boundary loop: top, bottom, or its index (the longest is 0)")
      ->allow_extra_args(false);
  sub.add_option("--pin-group", a.groups, "hold the vertices of a group, by its name")
      ->allow_extra_args(false);
  sub.add_option("--pin-vertices", a.vertices, "hold vertices, by their indices from 0")
      ->delimiter(',')
      ->allow_extra_args(false);
}

std::vector<int> pin(physics::Cloth& cloth, const io::MeshFile& file, const PinArguments& a) {
  std::vector<int> pins;
  for (const std::string& text : a.boxes) add_named(pins, box(file.mesh, text), "--pin-box " + text);
  const std::vector<geometry::BorderLoop> loops = geometry::border_loops(file.mesh);
  for (const std::string& name : a.loops)
    add_named(pins, loops.at(geometry::find_border_loop(loops, name)).vertices, "--pin-loop " + name);
  for (const std::string& name : a.groups) add_named(pins, group(file, name), "--pin-group " + name);
  for (int v : a.vertices) {
    if (v < 0 || v >= static_cast<int>(cloth.particles.size()))
      throw UsageError("--pin-vertices " + std::to_string(v) + ": the mesh has vertices 0 to " +
                       std::to_string(cloth.particles.size() - 1));
    pins.push_back(v);
  }
  physics::pin(cloth.particles, pins);
  return pins;
}

}  // namespace furrow::cli
