// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/ply_motion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/vertex_attributes.h"

namespace furrow::io {
namespace {

using namespace geometry;

struct VectorColumns {
  const PropertyName<Vertex, Vector>& map;
  std::array<const char*, 3> names;
};

const std::vector<VectorColumns>& vectors() {
  static const std::vector<VectorColumns> list{
      {attribute::velocity, {"vx", "vy", "vz"}},
      {attribute::force_jump, {"force_jump_x", "force_jump_y", "force_jump_z"}},
      {attribute::contact_point, {"contact_x", "contact_y", "contact_z"}}};
  return list;
}
constexpr const char* contact_level_column = "contact_level";

}  // namespace

const std::vector<std::string>& PlyMotion::names() {
  static const std::vector<std::string> list = [] {
    std::vector<std::string> all;
    for (const VectorColumns& v : vectors()) all.insert(all.end(), v.names.begin(), v.names.end());
    all.push_back(contact_level_column);
    return all;
  }();
  return list;
}

void PlyMotion::set_columns(const PlyElement& element) {
  columns_.clear();
  for (const std::string& name : names())
    columns_.push_back(find_column(element, {name.c_str()}, PlyKind::number));
}

std::vector<std::string> PlyMotion::used() const {
  std::vector<std::string> list;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const std::size_t first = i - i % 3,
                      last = std::min(first + 3, columns_.size());  // the last stands alone
    bool whole = true;
    for (std::size_t k = first; k < last; ++k) whole = whole && columns_[k];
    if (whole) list.push_back(names()[i]);
  }
  return list;
}

void PlyMotion::add(const PlyRow& row, const PlyRows& rows) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const double value = columns_[i] ? row.numbers[*columns_[i]] : unset_value;
    const bool may_be_unset = i + 1 == columns_.size();
    if (columns_[i] && (std::isinf(value) || (std::isnan(value) && !may_be_unset)))
      rows.fail("'" + names()[i] + "' is not finite; write the state again");
    values_.push_back(value);
  }
}

void PlyMotion::fill_maps(SoupMesh& mesh) const {
  for (std::size_t k = 0; k < vectors().size(); ++k) {
    if (columns_.empty() || !columns_[3 * k] || !columns_[3 * k + 1] || !columns_[3 * k + 2]) continue;
    auto map = ensure_map(mesh.mesh, vectors()[k].map);
    for (const Vertex v : mesh.mesh.vertices()) {
      const double* row = values_.data() + mesh.origin[v] * columns_.size() + 3 * k;
      map[v] = {row[0], row[1], row[2]};
    }
  }
  if (columns_.empty() || !columns_.back()) return;
  auto level = ensure_map(mesh.mesh, attribute::contact_level);
  for (const Vertex v : mesh.mesh.vertices()) level[v] = values_[(mesh.origin[v] + 1) * columns_.size() - 1];
}

void check_state_attributes(const Mesh& mesh) {
  for (const VertexAttribute& attribute : vertex_attributes(mesh))
    if (std::ranges::count(PlyMotion::names(), attribute.name))
      throw ContentError("the vertex attribute '" + attribute.name +
                         "' has the name of a column of saved states; rename it in the garment's file");
}

std::string ply_motion_header(const Mesh& mesh) {
  std::string text;
  for (const VectorColumns& v : vectors())
    if (find_map(mesh, v.map))
      for (const char* name : v.names) text += std::string("property double ") + name + "\n";
  if (find_map(mesh, attribute::contact_level))
    text += std::string("property double ") + contact_level_column + "\n";
  return text;
}

void put_ply_motion(const Mesh& mesh, Vertex v, const std::function<void(double)>& put) {
  for (const VectorColumns& columns : vectors())
    if (const auto map = find_map(mesh, columns.map))
      for (int k = 0; k < 3; ++k) put((*map)[v][k]);
  if (const auto level = find_map(mesh, attribute::contact_level)) put((*level)[v]);
}

}  // namespace furrow::io
