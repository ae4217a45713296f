// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "io/mesh/file_frame.h"
#include "io/mesh/mesh_readers.h"
#include "io/mesh/ply_edges.h"
#include "io/mesh/ply_motion.h"
#include "io/mesh/ply_rows.h"
#include "io/mesh/ply_struts.h"
#include "io/mesh/ply_triangles.h"
#include "io/mesh/ply_vertex_columns.h"
#include "io/mesh/soup_to_mesh.h"

namespace furrow::io {
namespace {

using namespace geometry;
using Column = std::optional<std::size_t>;

class PlyReader {
 public:
  PlyReader(std::string_view text, const std::string& name, const ReadOptions& options)
      : name_(name),
        options_(options),
        scanner_(text, name),
        header_(read_ply_header(scanner_, text.size())),
        rows_(scanner_, text, header_.encoding) {}

  MeshFile read() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element);
      else if (element.name == "edge" && edges_.set_columns(element))
        read_into(edges_, element);
      else if (element.name == "strut" && struts_.set_columns(element))
        read_into(struts_, element);
      else
        skip(element);
    }
    finish_textures();
    take_comments();
    SoupMesh mesh = soup_to_mesh(soup_, name_);
    edges_.fill_maps(mesh, name_);
    struts_.set(mesh, soup_.points.size(), name_);
    motion_.fill_maps(mesh);
    file_.mesh = std::move(mesh.mesh);
    file_.repairs = mesh.repairs;
    return std::move(file_);
  }

 private:
  /// Whether the columns of a cloth in motion are ours; in another program's file they may mean anything.
  bool is_state() const {
    return std::ranges::any_of(header_.comments,
                               [](const std::string& c) { return c.starts_with("furrow state "); });
  }

  void warn_of_unknown(const PlyElement& element, const std::vector<std::string>& known) {
    std::string names;
    for (const PlyProperty& p : element.properties)
      if (std::find(known.begin(), known.end(), p.name) == known.end())
        names += (names.empty() ? "" : ", ") + p.name;
    if (!names.empty())
      file_.warnings.push_back(name_ + ": properties of '" + element.name + "' not read: " + names);
  }

  void skip(const PlyElement& element) {
    for (std::size_t i = 0; i < element.count; ++i) rows_.read(element, i, row_);
    file_.warnings.push_back(name_ + ": element '" + element.name + "' not read");
  }

  Column number(const PlyElement& e, std::initializer_list<const char*> names) const {
    return find_column(e, names, PlyKind::number);
  }

  void read_vertices(const PlyElement& element) {
    if (is_state()) motion_.set_columns(element);
    const PlyVertexColumns columns = find_vertex_columns(element, faces_have_texture(), motion_.used());
    if (columns.xyz.empty()) rows_.fail("the vertices have no x, y and z");
    take_names(element, columns);
    for (std::size_t i = 0; i < element.count; ++i) {
      rows_.read(element, i, row_);
      read_vertex(element, columns);
    }
  }

  void read_vertex(const PlyElement& element, const PlyVertexColumns& c) {
    const auto& n = row_.numbers;
    const auto point = from_file(n[c.xyz[0]], n[c.xyz[1]], n[c.xyz[2]], options_);
    if (!point) rows_.fail(bad_coordinate);
    soup_.points.push_back(*point);
    if (!c.rgba.empty()) soup_.colors.push_back(color(element, c.rgba));
    if (!c.texture.empty()) vertex_textures_.push_back({n[c.texture[0]], n[c.texture[1]]});
    if (c.line) soup_.lines.push_back(whole(n[*c.line], "line"));
    if (c.mass) soup_.masses.push_back(checked_mass(n[*c.mass]));
    motion_.add(row_, rows_);
    if (!c.rest.empty())
      soup_.rest_positions.push_back(rest_position(n[c.rest[0]], n[c.rest[1]], n[c.rest[2]]));
    for (std::size_t k = 0; k < c.others.size(); ++k) soup_.attributes[k].values.push_back(n[c.others[k]]);
  }

  bool faces_have_texture() const {
    return std::ranges::any_of(header_.elements, [](const PlyElement& e) {
      return e.name == "face" && find_column(e, {"texcoord"}, PlyKind::list);
    });
  }

  /// Numbers at vertices that we have no use for are kept under their names (vertex_attributes.h).
  void take_names(const PlyElement& element, const PlyVertexColumns& columns) {
    for (const std::size_t i : columns.others) soup_.attributes.push_back({element.properties[i].name, {}});
    std::string lists;
    for (const std::string& name : columns.not_read) lists += (lists.empty() ? "" : ", ") + name;
    if (!lists.empty()) file_.warnings.push_back(name_ + ": lists of 'vertex' not read: " + lists);
  }

  RestPosition rest_position(double x, double y, double z) const {
    if (std::isnan(x) && std::isnan(y) && std::isnan(z)) return attribute::rest_position.default_value;
    const auto point = from_file(x, y, z, options_);
    if (!point) rows_.fail(std::string("a rest position: ") + bad_coordinate);
    return {point->x(), point->y(), point->z()};
  }

  Color color(const PlyElement& element, const std::vector<std::size_t>& rgba) const {
    Color c = attribute::color.default_value;
    for (std::size_t k = 0; k < rgba.size(); ++k) {
      const PlyType type = element.properties[rgba[k]].type;
      const double most = !is_integer(type)    ? 1
                          : size_of(type) == 1 ? 255
                          : size_of(type) == 2 ? 65535
                                               : 4294967295.0;
      c[k] = row_.numbers[rgba[k]] / most;
      if (!std::isfinite(c[k])) rows_.fail("a colour is not finite; correct it");
    }
    return c;
  }

  int whole(double value, const char* what) const {
    constexpr double largest_value = std::numeric_limits<int>::max();
    if (!(value >= -1 && value <= largest_value) || value != std::floor(value))
      rows_.fail(std::string("the property '") + what + "' must be whole and at least -1 (none)");
    return static_cast<int>(value);
  }

  double checked_mass(double value) const {
    if (value < 0 || std::isinf(value))
      rows_.fail("a mass must be at least 0 kg and finite, or nan for none");
    return value;
  }

  void read_faces(const PlyElement& element) {
    const Column indices = find_column(element, {"vertex_indices", "vertex_index"}, PlyKind::list);
    const Column texcoord = find_column(element, {"texcoord"}, PlyKind::list);
    const Column group = number(element, {"group"}), material = number(element, {"material"});
    const Column generation = number(element, {"generation"});
    std::vector<std::string> known{"vertex_indices", "vertex_index", "texcoord",
                                   "group",          "material",     "generation"};
    if (triangles_.set_columns(element))
      known.insert(known.end(), ply_triangle_lengths.begin(), ply_triangle_lengths.end());
    warn_of_unknown(element, known);
    if (!indices) rows_.fail("the faces have no list vertex_indices");
    for (std::size_t i = 0; i < element.count; ++i) {
      rows_.read(element, i, row_);
      const auto& corners = row_.lists[*indices];
      for (const double c : corners) {
        if (!(c >= 0 && c < 9e15) || c != std::floor(c))
          rows_.fail("a corner is no index of a vertex; correct it");
        soup_.corners.push_back(static_cast<std::size_t>(c));
      }
      soup_.close_face();
      if (texcoord) add_textures(row_.lists[*texcoord], corners.size());
      triangles_.add(row_, rows_, corners.size(), options_.metres_per_unit, soup_);
      if (group) soup_.groups.push_back(whole(row_.numbers[*group], "group"));
      if (material) soup_.materials.push_back(whole(row_.numbers[*material], "material"));
      if (generation) soup_.generations.push_back(whole(row_.numbers[*generation], "generation"));
    }
  }

  void add_textures(const std::vector<double>& values, std::size_t corners) {
    if (values.size() != 2 * corners && !values.empty())
      rows_.fail("texcoord must hold two numbers a corner, or none");
    for (std::size_t k = 0; k < corners; ++k)
      soup_.textures.push_back(values.empty() ? attribute::texture.default_value
                                              : TextureCoordinate{values[2 * k], values[2 * k + 1]});
  }

  template <class Part>
  void read_into(Part& part, const PlyElement& element) {
    warn_of_unknown(element, Part::names());
    for (std::size_t i = 0; i < element.count; ++i) {
      rows_.read(element, i, row_);
      part.add(row_, rows_, options_.metres_per_unit);
    }
  }

  /// Texture coordinates of vertices go to all their corners, if the faces bring none.
  void finish_textures() {
    if (vertex_textures_.empty() || !soup_.textures.empty()) return;
    for (const std::size_t c : soup_.corners)
      soup_.textures.push_back(c < vertex_textures_.size() ? vertex_textures_[c]
                                                           : attribute::texture.default_value);
  }

  /// "furrow group 3 sleeve" names a group, "furrow material 0 cotton" a material; the rest is kept.
  void take_comments() {
    for (std::string& comment : header_.comments)
      if (!take_name(comment, "furrow group ", file_.group_names) &&
          !take_name(comment, "furrow material ", file_.material_names))
        file_.comments.push_back(std::move(comment));
  }

  static bool take_name(std::string_view comment, std::string_view mark, std::vector<std::string>& names) {
    if (!comment.starts_with(mark)) return false;
    comment.remove_prefix(mark.size());
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(comment.data(), comment.data() + comment.size(), index);
    if (error != std::errc() || index > 100000) return false;
    comment.remove_prefix(static_cast<std::size_t>(end - comment.data()));
    if (comment.starts_with(' ')) comment.remove_prefix(1);
    if (names.size() <= index) names.resize(index + 1);
    names[index] = comment;
    return true;
  }

  std::string name_;
  ReadOptions options_;
  TextScanner scanner_;
  PlyHeader header_;
  PlyRows rows_;
  PlyRow row_;
  PolygonSoup soup_;
  PlyEdges edges_;
  PlyStruts struts_;
  PlyTriangles triangles_;
  PlyMotion motion_;
  std::vector<TextureCoordinate> vertex_textures_;
  MeshFile file_;
};

}  // namespace

MeshFile read_ply(std::string_view text, const std::string& name, const ReadOptions& options) {
  return PlyReader(text, name, options).read();
}

}  // namespace furrow::io
