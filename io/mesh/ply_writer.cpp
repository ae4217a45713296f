// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <tuple>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "geometry/mesh/vertex_attributes.h"
#include "io/base/number_text.h"
#include "io/mesh/mesh_writers.h"
#include "io/mesh/ply_edges.h"
#include "io/mesh/ply_motion.h"
#include "io/mesh/ply_triangles.h"

namespace furrow::io {
namespace {

using namespace geometry;

constexpr const char* ends = "property int vertex1\nproperty int vertex2\n";

class PlyWriter {
 public:
  PlyWriter(const MeshFile& file, const WriteOptions& options)
      : file_(file),
        mesh_(file.mesh),
        options_(options),
        colors_(find_map(mesh_, attribute::color)),
        lines_(find_map(mesh_, attribute::line)),
        masses_(find_map(mesh_, attribute::mass)),
        rest_positions_(find_map(mesh_, attribute::rest_position)),
        attributes_(vertex_attributes(mesh_)),
        textures_(find_map(mesh_, attribute::texture)),
        groups_(find_map(mesh_, attribute::group)),
        materials_(find_map(mesh_, attribute::material)),
        generations_(find_map(mesh_, attribute::generation)),
        triangle_lengths_(find_map(mesh_, attribute::triangle_rest_length)),
        bending_counts_(find_map(mesh_, attribute::bending_count)),
        line_edges_(find_map(mesh_, attribute::line_edge)),
        diagonals_(find_map(mesh_, attribute::diagonal)),
        struts_(struts(mesh_)) {
    for (const PlyEdgeNumber& number : ply_edge_numbers())
      if (const auto map = find_map(mesh_, number.map)) edge_numbers_.emplace_back(&number, *map);
    byte_colors_ =
        colors_ && std::ranges::all_of(mesh_.vertices(), [&](Vertex v) {
          return std::ranges::all_of((*colors_)[v], [](double c) { return std::round(c * 255) / 255 == c; });
        });
  }

  std::string bytes() {
    write_header();
    write_vertices();
    write_faces();
    if (has_edges()) write_edges();
    for (const Strut& s : struts_) write_strut(s);
    return std::move(out_);
  }

 private:
  bool has_edges() const { return !edge_numbers_.empty() || bending_counts_ || line_edges_ || diagonals_; }

  template <class T>
  void put(T value) {
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
    out_.append(bytes.data(), bytes.size());
  }
  void put_index(std::size_t value) { put(static_cast<std::int32_t>(value)); }
  /// Length in the file's unit.
  void put_length(double metres) { put(metres / options_.metres_per_unit); }

  void write_names(const char* kind, const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < names.size(); ++i)
      out_ +=
          std::string("comment furrow ") + kind + " " + std::to_string(i) + " " + one_line(names[i]) + "\n";
  }

  void declare(const char* element, std::size_t count) {
    out_ += std::string("element ") + element + " " + std::to_string(count) + "\n";
  }

  /// `vertex` is where the element begins.
  void declare_attribute(const std::string& name, std::size_t vertex) {
    if (out_.find(" " + name + "\n", vertex) != std::string::npos)
      throw ContentError("the vertex attribute '" + name +
                         "' has the name of another column of the PLY; rename it in the garment's file");
    out_ += "property double " + name + "\n";
  }

  void write_header() {
    out_ = "ply\nformat binary_little_endian 1.0\n";
    for (const std::string& comment : file_.comments) out_ += "comment " + one_line(comment) + "\n";
    write_names("group", file_.group_names);
    write_names("material", file_.material_names);
    const std::size_t vertex = out_.size();
    declare("vertex", mesh_.number_of_vertices());
    out_ += "property double x\nproperty double y\nproperty double z\n";
    if (colors_)
      for (const char* channel : {"red", "green", "blue", "alpha"})
        out_ += std::string("property ") + (byte_colors_ ? "uchar " : "double ") + channel + "\n";
    if (lines_) out_ += "property int line\n";
    if (masses_) out_ += "property double mass\n";
    out_ += ply_motion_header(mesh_);
    if (rest_positions_) out_ += "property double rest_x\nproperty double rest_y\nproperty double rest_z\n";
    for (const VertexAttribute& attribute : attributes_) declare_attribute(one_line(attribute.name), vertex);
    declare("face", mesh_.number_of_faces());
    out_ += "property list uchar int vertex_indices\n";
    if (textures_) out_ += "property list uchar double texcoord\n";
    if (groups_) out_ += "property int group\n";
    if (materials_) out_ += "property int material\n";
    if (generations_) out_ += "property int generation\n";
    if (triangle_lengths_)
      for (const char* name : ply_triangle_lengths) out_ += std::string("property double ") + name + "\n";
    declare_edges();
    if (!struts_.empty()) {
      declare("strut", struts_.size());
      out_ += std::string(ends) + "property double rest_length\nproperty double stiffness\n";
    }
    out_ += "end_header\n";
  }

  void declare_edges() {
    if (!has_edges()) return;
    declare("edge", mesh_.number_of_edges());
    out_ += ends;
    for (const auto& [number, map] : edge_numbers_)
      out_ += std::string("property double ") + number->name + "\n";
    if (bending_counts_) out_ += "property int bending_count\n";
    if (line_edges_) out_ += "property uchar line_edge\n";
    if (diagonals_) out_ += "property uchar diagonal\n";
  }

  void write_vertices() {
    for (const Vertex v : mesh_.vertices()) {
      const Vector p = to_file(mesh_.point(v), options_);
      for (int k = 0; k < 3; ++k) put(p[k]);
      if (colors_)
        for (const double c : (*colors_)[v])
          byte_colors_ ? put(static_cast<std::uint8_t>(std::lround(c * 255))) : put(c);
      if (lines_) put(static_cast<std::int32_t>((*lines_)[v]));
      if (masses_) put((*masses_)[v]);
      put_ply_motion(mesh_, v, [&](double x) { put(x); });
      if (rest_positions_) put_rest_position((*rest_positions_)[v]);
      for (const VertexAttribute& attribute : attributes_) put(attribute.values[v]);
    }
  }

  void put_rest_position(const RestPosition& p) {
    const Vector v = to_file({p[0], p[1], p[2]}, options_);
    for (int k = 0; k < 3; ++k) put(v[k]);
  }

  void write_faces() {
    for (const Face f : mesh_.faces()) {
      put(std::uint8_t{3});
      for (const Vertex v : mesh_.vertices_around_face(mesh_.halfedge(f))) put_index(numbers_[v]);
      if (textures_) {
        put(std::uint8_t{6});
        for (const Halfedge h : mesh_.halfedges_around_face(mesh_.halfedge(f)))
          for (const double t : (*textures_)[h]) put(t);
      }
      if (groups_) put(static_cast<std::int32_t>((*groups_)[f]));
      if (materials_) put(static_cast<std::int32_t>((*materials_)[f]));
      if (generations_) put(static_cast<std::int32_t>((*generations_)[f]));
      if (!triangle_lengths_) continue;
      for (const Halfedge h : mesh_.halfedges_around_face(mesh_.next(mesh_.halfedge(f))))  // 01, 12, 20
        put_length((*triangle_lengths_)[h]);
    }
  }

  void write_edges() {
    for (const auto& [a, b, e] : sorted_edges()) {
      put_index(a);
      put_index(b);
      for (const auto& [number, map] : edge_numbers_)
        number->kind == PlyEdgeNumber::Kind::length ? put_length(map[e]) : put(map[e]);
      if (bending_counts_) put(static_cast<std::int32_t>((*bending_counts_)[e]));
      if (line_edges_) put(static_cast<std::uint8_t>((*line_edges_)[e]));
      if (diagonals_) put(static_cast<std::uint8_t>((*diagonals_)[e]));
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
  std::optional<VertexMap<Color>> colors_;
  std::optional<VertexMap<int>> lines_;
  std::optional<VertexMap<double>> masses_;
  std::optional<VertexMap<RestPosition>> rest_positions_;
  std::vector<VertexAttribute> attributes_;
  std::optional<HalfedgeMap<TextureCoordinate>> textures_;
  std::optional<FaceMap<int>> groups_, materials_, generations_;
  std::optional<HalfedgeMap<double>> triangle_lengths_;
  std::optional<EdgeMap<int>> bending_counts_;
  std::optional<EdgeMap<bool>> line_edges_, diagonals_;
  std::vector<std::pair<const PlyEdgeNumber*, EdgeMap<double>>> edge_numbers_;
  std::vector<Strut> struts_;
  bool byte_colors_ = false;
  std::string out_;
};

}  // namespace

void write_ply(std::ostream& out, const MeshFile& file, const WriteOptions& options) {
  check_positions(file.mesh, options);
  const std::string bytes = PlyWriter(file, options).bytes();
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace furrow::io
