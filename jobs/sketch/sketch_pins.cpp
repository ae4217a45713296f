// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sketch/sketch_pins.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "geometry/mesh/border_loops.h"
#include "jobs/base/read_inputs.h"
#include "jobs/cloth/pins.h"

namespace furrow::jobs {
namespace {

using geometry::BorderLoop;

Json pins_of(const Sketch& sketch) { return sketch.scene.settings.root->value("pins", Json::array()); }

bool is_of(const Json& pin, const char* key) { return pin.size() == 1 && pin.contains(key); }

std::string name_of_loop(const std::vector<BorderLoop>& loops, std::size_t i) {
  for (const char* name : {"top", "bottom"})
    if (geometry::find_border_loop(loops, name) == i) return name;
  return std::to_string(i);
}

/// The loop that a pin of a loop names; text or number.
std::size_t loop_of(const std::vector<BorderLoop>& loops, const Json& pin) {
  const Json& name = pin.at("loop");
  return geometry::find_border_loop(loops, name.is_string() ? name.get<std::string>() : name.dump());
}

std::set<int> held_vertices(const Sketch& sketch) {
  std::set<int> held;
  for (const auto& group : sketch.pins) held.insert(group.begin(), group.end());
  return held;
}

bool holds_all(const std::set<int>& held, const BorderLoop& loop) {
  return std::all_of(loop.vertices.begin(), loop.vertices.end(),
                     [&](geometry::Vertex v) { return held.count(int(v)) > 0; });
}

/// The vertices of all pins that name nothing else, which are the page's; the rest of the pins stays in
/// `pins`.
std::set<int> take_single(Json& pins) {
  std::set<int> single;
  Json others = Json::array();
  for (const Json& pin : pins) {
    if (!is_of(pin, "vertices")) {
      others.push_back(pin);
      continue;
    }
    for (const Json& v : pin["vertices"]) single.insert(v.get<int>());
  }
  pins = std::move(others);
  return single;
}

Json with_single(Json pins, const std::set<int>& single) {
  if (!single.empty()) pins.push_back({{"vertices", single}});
  return pins;
}

int nearest_vertex(const geometry::Mesh& mesh, const geometry::Point& point, double reach) {
  int nearest = -1;
  double least = reach * reach;
  for (const geometry::Vertex v : mesh.vertices()) {
    const double d = CGAL::squared_distance(mesh.point(v), point);
    if (d > least || mesh.is_isolated(v)) continue;
    least = d;
    nearest = int(v);
  }
  if (nearest < 0) throw std::invalid_argument("there is no vertex of the cloth near enough");
  return nearest;
}

}  // namespace

std::vector<SketchBorder> borders_of(const Sketch& sketch) {
  const geometry::Mesh& mesh = sketch.garment.mesh;
  const std::vector<BorderLoop> loops = geometry::border_loops(mesh);
  const std::set<int> held = held_vertices(sketch);
  std::vector<SketchBorder> borders;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    SketchBorder border{name_of_loop(loops, i), loops[i].length, {}, holds_all(held, loops[i])};
    for (const geometry::Vertex v : loops[i].vertices)
      for (int k = 0; k < 3; ++k)
        border.at[std::size_t(k)] += mesh.point(v)[k] / double(loops[i].vertices.size());
    borders.push_back(border);
  }
  return borders;
}

std::size_t nearest_border(const Sketch& sketch, const std::array<double, 3>& point) {
  const geometry::Mesh& mesh = sketch.garment.mesh;
  const std::vector<BorderLoop> loops = geometry::border_loops(mesh);
  const geometry::Point at(point[0], point[1], point[2]);
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < loops.size(); ++i)
    for (const geometry::Vertex v : loops[i].vertices) {
      const double d = CGAL::squared_distance(mesh.point(v), at);
      if (d >= least) continue;
      least = d;
      nearest = i;
    }
  if (loops.empty()) throw std::invalid_argument("the cloth is closed: it has no border to hold");
  return nearest;
}

Json with_border(const Sketch& sketch, std::size_t border, bool held) {
  const std::vector<BorderLoop> loops = geometry::border_loops(sketch.garment.mesh);
  if (border >= loops.size())
    throw std::invalid_argument("border: the cloth has " + std::to_string(loops.size()) + " border loops");
  Json pins = Json::array();
  for (const Json& pin : pins_of(sketch))
    if (!is_of(pin, "loop") || loop_of(loops, pin) != border) pins.push_back(pin);
  std::set<int> single = take_single(pins);
  for (const geometry::Vertex v : loops[border].vertices) single.erase(int(v));
  pins = with_single(std::move(pins), single);
  if (held) {
    pins.push_back({{"loop", name_of_loop(loops, border)}});
    return pins;
  }
  Sketch left = sketch;
  left.scene.settings.root["pins"] = pins;
  left.pins = find_pins(sketch.garment, scene_of(left.scene.settings, sketch.scene.folder).pins);
  if (holds_all(held_vertices(left), loops[border]))
    throw std::invalid_argument("the scene has pins of its own there, which stay as they are");
  return pins;
}

Json with_vertex_toggled(const Sketch& sketch, const std::array<double, 3>& point, double reach) {
  const int v = nearest_vertex(sketch.garment.mesh, {point[0], point[1], point[2]}, reach);
  Json pins = pins_of(sketch);
  std::set<int> single = take_single(pins);
  if (!single.erase(v)) {
    if (held_vertices(sketch).count(v))
      throw std::invalid_argument("a border or pins of the scene hold this vertex; let that border go");
    single.insert(v);
  }
  return with_single(std::move(pins), single);
}

Json with_vertices(const Sketch& sketch, const std::vector<int>& vertices, bool held) {
  const geometry::Mesh& mesh = sketch.garment.mesh;
  const std::set<int> before = held_vertices(sketch);
  Json pins = pins_of(sketch);
  std::set<int> single = take_single(pins);
  const std::size_t singles = single.size();
  bool others = false;  // pins of another kind hold one
  for (const int v : vertices) {
    if (v < 0 || std::size_t(v) >= mesh.number_of_vertices() || mesh.is_isolated(geometry::Vertex(v)))
      continue;
    const bool is_single = single.count(v) > 0;
    if (!is_single && before.count(v))
      others = true;
    else if (held)
      single.insert(v);
    else
      single.erase(v);
  }
  if (single.size() != singles) return with_single(std::move(pins), single);
  if (others && !held)
    throw std::invalid_argument("a border or pins of the scene hold these vertices; let that border go");
  throw std::invalid_argument(held ? "there is no vertex to hold in there that is not held already"
                                   : "nothing in there is held");
}

Json pins_after(const Sketch& sketch, const io::MeshFile& made) {
  const std::vector<BorderLoop> before = geometry::border_loops(sketch.garment.mesh);
  const std::vector<BorderLoop> after = geometry::border_loops(made.mesh);
  Json pins = pins_of(sketch);
  for (Json& pin : pins) {
    if (is_of(pin, "loop")) {
      const geometry::Vertex first = before.at(loop_of(before, pin)).vertices.front();
      for (std::size_t i = 0; i < after.size(); ++i)
        if (std::count(after[i].vertices.begin(), after[i].vertices.end(), first))
          pin["loop"] = name_of_loop(after, i);
    } else if (is_of(pin, "vertices")) {
      std::vector<std::vector<int>> list{pin["vertices"].get<std::vector<int>>()};
      pin_new_vertices(made.mesh, sketch.garment.mesh->number_of_vertices(), list);
      pin["vertices"] = list[0];
    }
  }
  return pins;
}

}  // namespace furrow::jobs
