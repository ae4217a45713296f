// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <tuple>

#include "geometry/mesh/attribute_slots.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/struts.h"
#include "geometry/mesh/vertex_attributes.h"
#include "io/base/byte_order.h"
#include "io/base/number_text.h"
#include "io/base/own_mark.h"
#include "io/mesh/mesh_writers.h"
#include "io/mesh/ply_motion.h"

namespace furrow::io {
namespace {

using namespace geometry;

constexpr const char* edge_ends = "property int vertex1\nproperty int vertex2\n";

bool are_bytes(const Mesh& mesh, const VertexMap<Color>& colors) {
  return std::ranges::all_of(mesh.vertices(), [&](Vertex v) {
    return std::ranges::all_of(colors[v], [](double c) { return std::round(c * 255) / 255 == c; });
  });
}

/// The texture coordinates of the vertices, by index, as Blender reads them (columns s and t); none where two
/// corners of a vertex differ, as at a seam of the texture, where a corner has none, or where the names are
/// those of other attributes. A vertex without faces has (0, 0).
std::vector<TextureCoordinate> textures_of_vertices(const Mesh& mesh) {
  const auto textures = find_map(mesh, attribute::texture);
  if (!textures) return {};
  for (const VertexAttribute& other : vertex_attributes(mesh))
    if (other.name == "s" || other.name == "t") return {};
  std::vector<TextureCoordinate> result(mesh.num_vertices(), {0, 0});
  std::vector<char> known(mesh.num_vertices(), 0);
  for (const Face f : mesh.faces())
    for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      const Vertex v = mesh.target(h);
      const TextureCoordinate& t = (*textures)[h];
      if (!std::isfinite(t[0]) || !std::isfinite(t[1])) return {};
      if (known[v] && result[v] != t) return {};
      result[v] = t, known[v] = 1;
    }
  return result;
}

/// Every registered attribute that the mesh has becomes its columns, in the register's order.
class PlyWriter {
 public:
  PlyWriter(const MeshFile& file, const WriteOptions& options)
      : file_(file),
        mesh_(file.mesh),
        options_(options),
        of_vertices_(mesh_),
        of_faces_(mesh_),
        of_edges_(mesh_),
        others_(vertex_attributes(mesh_)),
        struts_(struts(mesh_)) {
    const auto colors = find_map(mesh_, attribute::color);
    byte_colors_ = colors && are_bytes(mesh_, *colors);
    of_edges_.for_each([&](const auto& attribute, const auto&, const auto&) {
      has_edges_ = has_edges_ || attribute.ply.value != PlyValue::none;
    });
  }

  std::string bytes() {
    write_header();
    write_vertices();
    write_faces();
    if (has_edges_) write_edges();
    for (const Strut& s : struts_) write_strut(s);
    return std::move(out_);
  }

 private:
  template <class T>
  void put(T value) {
    append_in_order(out_, value, std::endian::little);
  }
  void put_index(std::size_t value) { put(static_cast<std::int32_t>(value)); }
  /// Length in the file's unit.
  void put_length(double metres) { put(metres / options_.metres_per_unit); }

  void put_value(PlyValue, int value) { put(static_cast<std::int32_t>(value)); }
  void put_value(PlyValue, bool value) { put(static_cast<std::uint8_t>(value)); }
  void put_value(PlyValue kind, double value) { kind == PlyValue::length ? put_length(value) : put(value); }
  void put_value(PlyValue, const Vector& value) {
    for (int k = 0; k < 3; ++k) put(value[k]);
  }
  void put_value(PlyValue kind, const RestPosition& p) {
    WriteOptions frame = options_;
    if (kind == PlyValue::direction) frame.metres_per_unit = 1;
    put_value(kind, to_file({p[0], p[1], p[2]}, frame));
  }
  void put_value(PlyValue, const Color& color) {
    for (const double c : color) byte_colors_ ? put(static_cast<std::uint8_t>(std::lround(c * 255))) : put(c);
  }

  template <class K, class V>
  void put_at(const Attribute<K, V>& attribute, const Map<K, V>& map, K key) {
    const V& value = map[key];
    if (attribute.ply.value != PlyValue::none) put_value(attribute.ply.value, value);
  }

  void write_names(const char* kind, const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < names.size(); ++i)
      out_ +=
          std::string("comment furrow ") + kind + " " + std::to_string(i) + " " + one_line(names[i]) + "\n";
  }

  void declare(const char* element, std::size_t count) {
    out_ += std::string("element ") + element + " " + std::to_string(count) + "\n";
  }

  const char* type_of(PlyValue kind) const {
    switch (kind) {
      case PlyValue::color:
        return byte_colors_ ? "uchar " : "double ";
      case PlyValue::index:
      case PlyValue::count:
        return "int ";
      case PlyValue::flag:
        return "uchar ";
      case PlyValue::texture:
        return "list uchar double ";
      default:
        return "double ";
    }
  }

  template <class Maps>
  void declare_columns(const Maps& maps) {
    maps.for_each([&](const auto& attribute, const auto&, const auto&) {
      const PlyColumns& columns = attribute.ply;
      for (std::size_t k = 0; columns.value != PlyValue::none && k < columns.size(); ++k)
        out_ += std::string("property ") + type_of(columns.value) + columns.names[k] + "\n";
    });
  }

  /// `vertex` is where the element begins.
  void declare_other(const std::string& name, std::size_t vertex) {
    if (out_.find(" " + name + "\n", vertex) != std::string::npos)
      throw ContentError("the vertex attribute '" + name +
                         "' has the name of another column of the PLY; rename it in the garment's file");
    out_ += "property double " + name + "\n";
  }

  void write_header() {
    out_ = "ply\nformat binary_little_endian 1.0\ncomment " + std::string(own_mark) + "\n";
    for (const std::string& comment : file_.comments) out_ += "comment " + one_line(comment) + "\n";
    write_names("group", file_.group_names);
    write_names("material", file_.material_names);
    const std::size_t vertex = out_.size();
    declare("vertex", mesh_.number_of_vertices());
    out_ += "property double x\nproperty double y\nproperty double z\n";
    declare_columns(of_vertices_);
    for (const VertexAttribute& attribute : others_) declare_other(one_line(attribute.name), vertex);
    if (!vertex_textures_.empty()) out_ += "property double s\nproperty double t\n";
    declare("face", mesh_.number_of_faces());
    out_ += "property list uchar int vertex_indices\n";
    declare_columns(of_faces_);
    if (has_edges_) {
      declare("edge", mesh_.number_of_edges());
      out_ += edge_ends;
      declare_columns(of_edges_);
    }
    if (!struts_.empty()) {
      declare("strut", struts_.size());
      out_ += edge_ends;
      out_ += "property double rest_length\nproperty double stiffness\n";
    }
    out_ += "end_header\n";
  }

  void write_vertices() {
    for (const Vertex v : mesh_.vertices()) {
      const Vector p = to_file(mesh_.point(v), options_);
      for (int k = 0; k < 3; ++k) put(p[k]);
      of_vertices_.for_each(
          [&](const auto& attribute, const auto&, const auto& map) { put_at(attribute, map, v); });
      for (const VertexAttribute& attribute : others_) put(attribute.values[v]);
      if (!vertex_textures_.empty())
        for (const double t : vertex_textures_[v]) put(t);
    }
  }

  template <class V>
  void put_of_face(const Attribute<Face, V>& attribute, const FaceMap<V>& map, Face f) {
    put_at(attribute, map, f);
  }
  void put_of_face(const Attribute<Halfedge, TextureCoordinate>&, const HalfedgeMap<TextureCoordinate>& map,
                   Face f) {
    put(std::uint8_t{6});
    for (const Halfedge h : mesh_.halfedges_around_face(mesh_.halfedge(f)))
      for (const double t : map[h]) put(t);
  }
  /// Of the edges between the corners 0 and 1, 1 and 2, 2 and 0.
  void put_of_face(const Attribute<Halfedge, double>& attribute, const HalfedgeMap<double>& map, Face f) {
    for (const Halfedge h : mesh_.halfedges_around_face(mesh_.next(mesh_.halfedge(f))))
      put_value(attribute.ply.value, map[h]);
  }

  void write_faces() {
    for (const Face f : mesh_.faces()) {
      put(std::uint8_t{3});
      for (const Vertex v : mesh_.vertices_around_face(mesh_.halfedge(f))) put_index(numbers_[v]);
      of_faces_.for_each([&](const auto& attribute, const auto&, const auto& map) {
        if (attribute.ply.value != PlyValue::none) put_of_face(attribute, map, f);
      });
    }
  }

  void write_edges() {
    for (const auto& [a, b, edge] : sorted_edges()) {
      put_index(a);
      put_index(b);
      const Edge e = edge;  // what a structured binding names cannot be captured by every compiler
      of_edges_.for_each(
          [&](const auto& attribute, const auto&, const auto& map) { put_at(attribute, map, e); });
    }
  }

  void write_strut(const Strut& s) {
    put_index(numbers_[s.a]);
    put_index(numbers_[s.b]);
    put_length(s.rest_length);
    put(s.stiffness);
  }

  /// By their vertices, so that a mesh that is read and written again gives the same bytes.
  std::vector<std::tuple<std::size_t, std::size_t, Edge>> sorted_edges() const {
    std::vector<std::tuple<std::size_t, std::size_t, Edge>> edges;
    for (const Edge e : mesh_.edges()) {
      const std::size_t a = numbers_[mesh_.vertex(e, 0)], b = numbers_[mesh_.vertex(e, 1)];
      edges.emplace_back(std::min(a, b), std::max(a, b), e);
    }
    std::ranges::sort(edges);
    return edges;
  }

  const MeshFile& file_;
  const Mesh& mesh_;
  const WriteOptions& options_;
  std::vector<std::size_t> numbers_ = vertex_numbers(mesh_);
  AttributeMaps<Vertex> of_vertices_;
  AttributeMaps<Face, Halfedge> of_faces_;
  AttributeMaps<Edge> of_edges_;
  std::vector<VertexAttribute> others_;
  std::vector<Strut> struts_;
  std::vector<TextureCoordinate> vertex_textures_ = textures_of_vertices(mesh_);
  bool byte_colors_ = false, has_edges_ = false;
  std::string out_;
};

template <class A>
struct Named {
  explicit Named(const A& a) : columns(a.ply) {}
  PlyColumns columns;
};

}  // namespace

void write_ply(std::ostream& out, const MeshFile& file, const WriteOptions& options) {
  check_positions(file.mesh, options);
  const std::string bytes = PlyWriter(file, options).bytes();
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void check_state_attributes(const Mesh& mesh) {
  AttributeSlots<Named, Vertex>().for_each([&](const auto& slot) {
    if (slot.columns.value != PlyValue::state) return;
    for (const VertexAttribute& attribute : vertex_attributes(mesh))
      for (std::size_t k = 0; k < slot.columns.size(); ++k)
        if (attribute.name == slot.columns.names[k])
          throw ContentError("the vertex attribute '" + attribute.name +
                             "' has the name of a column of saved states; rename it in the garment's file");
  });
}

/// Earlier versions had comments of other kinds, where they had any.
bool is_own_ply(std::string_view head, std::string_view) {
  if (!head.starts_with("ply\nformat binary_little_endian 1.0\n")) return false;
  const std::string_view header = head.substr(0, head.find("\nend_header\n"));
  return header.find("\ncomment " + std::string(own_mark) + "\n") != header.npos ||
         header.find("\ncomment furrow ") != header.npos;
}

}  // namespace furrow::io
