// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/vertex_attributes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"

namespace furrow::geometry {
namespace {

const std::string prefix = "v:attribute:";
const std::string weight = "weight_";

/// Leaves the `strongest` largest weights and makes their sum 1. False if all is well already.
bool normalize(std::vector<double>& weights, int strongest) {
  std::vector<std::size_t> order(weights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return weights[a] > weights[b]; });
  bool dropped = false;
  for (std::size_t i = strongest ? strongest : order.size(); i < order.size(); ++i) {
    dropped = dropped || weights[order[i]] > 0;
    weights[order[i]] = 0;
  }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(sum > 0) || (!dropped && std::abs(sum - 1) <= 1e-6)) return false;
  for (double& w : weights) w /= sum;
  return true;
}

}  // namespace

std::vector<VertexAttribute> vertex_attributes(const Mesh& mesh) {
  std::vector<VertexAttribute> result;
  for (const std::string& name : mesh.properties<Vertex>()) {
    if (!name.starts_with(prefix)) continue;
    const PropertyName<Vertex, double> property{name.c_str(), 0};
    if (const auto map = find_map(mesh, property)) result.push_back({name.substr(prefix.size()), *map});
  }
  return result;
}

VertexMap<double> ensure_vertex_attribute(Mesh& mesh, const std::string& name) {
  const std::string full = prefix + name;
  return ensure_map(mesh, PropertyName<Vertex, double>{full.c_str(), 0});
}

VertexMap<RestPosition> ensure_rest_positions(Mesh& mesh) {
  auto rest = ensure_map(mesh, attribute::rest_position);
  for (Vertex v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    if (std::isnan(rest[v][0])) rest[v] = {p.x(), p.y(), p.z()};
  }
  return rest;
}

std::string key_attribute(const std::string& key, int axis) { return "key_" + key + "_" + "xyz"[axis]; }

std::vector<std::string> shape_key_names(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const VertexAttribute& a : vertex_attributes(mesh))
    for (int axis = 0; axis < 3; ++axis) {
      if (a.name.size() < 7) continue;
      const std::string key = a.name.substr(4, a.name.size() - 6);
      if (a.name == key_attribute(key, axis) && std::ranges::find(names, key) == names.end())
        names.push_back(key);
    }
  return names;
}

std::vector<Vector> shape_key(const Mesh& mesh, const std::string& key) {
  std::vector<std::array<double, 3>> moves(mesh.num_vertices(), {0, 0, 0});
  for (const VertexAttribute& a : vertex_attributes(mesh))
    for (int axis = 0; axis < 3; ++axis)
      if (a.name == key_attribute(key, axis))
        for (const Vertex v : mesh.vertices()) moves[v.idx()][static_cast<std::size_t>(axis)] = a.values[v];
  std::vector<Vector> result;
  for (const auto& [x, y, z] : moves) result.emplace_back(x, y, z);
  return result;
}

void set_shape_key(Mesh& mesh, const std::string& key, const std::vector<Vector>& moves) {
  if (key.empty() || key.find_first_of(" \t\r\n") != key.npos)
    refuse("set_shape_key", "'" + key + "' is no name");
  if (moves.size() != mesh.num_vertices())
    refuse("set_shape_key",
           std::to_string(moves.size()) + " moves for " + std::to_string(mesh.num_vertices()) + " vertices");
  for (int axis = 0; axis < 3; ++axis) {
    auto values = ensure_vertex_attribute(mesh, key_attribute(key, axis));
    for (const Vertex v : mesh.vertices()) values[v] = moves[v.idx()][axis];
  }
}

std::size_t normalize_skin_weights(Mesh& mesh, int strongest) {
  if (strongest < 0)
    refuse("normalize_skin_weights", "strongest is " + std::to_string(strongest) + ", not >= 0");
  std::vector<VertexAttribute> joints = vertex_attributes(mesh);
  std::erase_if(joints, [](const VertexAttribute& a) { return !a.name.starts_with(weight); });
  for (const VertexAttribute& joint : joints)
    for (Vertex v : mesh.vertices())
      if (!(joint.values[v] >= 0) || std::isinf(joint.values[v]))
        throw ContentError("vertex " + std::to_string(v.idx()) + ": " + joint.name + " is " +
                           std::to_string(joint.values[v]) + "; skin weights must be >= 0 and finite");
  std::size_t changed = 0;
  std::vector<double> weights(joints.size());
  for (Vertex v : mesh.vertices()) {
    for (std::size_t j = 0; j < joints.size(); ++j) weights[j] = joints[j].values[v];
    if (!normalize(weights, strongest)) continue;
    for (std::size_t j = 0; j < joints.size(); ++j) joints[j].values[v] = weights[j];
    ++changed;
  }
  return changed;
}

}  // namespace furrow::geometry
