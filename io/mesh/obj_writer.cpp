// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <ostream>

#include "geometry/mesh/face_point.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "io/base/number_text.h"
#include "io/base/own_mark.h"
#include "io/mesh/chain_segments.h"
#include "io/mesh/material_libraries.h"
#include "io/mesh/mesh_writers.h"

namespace furrow::io {
namespace {

using namespace geometry;

class ObjWriter {
 public:
  ObjWriter(const MeshFile& file, const WriteOptions& options, const std::filesystem::path& folder)
      : file_(file), mesh_(file.mesh), options_(options), folder_(folder), numbers_(vertex_numbers(mesh_)) {}

  std::string text() {
    out_ = own_comment();
    for (const std::string& comment : file_.comments) out_ += "# " + one_line(comment) + "\n";
    for (const std::string& library : file_.material_libraries)
      out_ += "mtllib " + one_line(library_from(library, file_.folder, folder_)) + "\n";
    write_vertices();
    write_textures();
    write_faces();
    write_lines();
    return std::move(out_);
  }

 private:
  void write_position(const Point& p) {
    const Vector v = to_file(p, options_);
    out_ += "v ";
    append_number(out_, v.x()), out_ += ' ';
    append_number(out_, v.y()), out_ += ' ';
    append_number(out_, v.z());
  }

  void write_vertices() {
    const auto colors = find_map(mesh_, attribute::color);
    for (const Vertex v : mesh_.vertices()) {
      write_position(mesh_.point(v));
      if (colors) {
        const Color& c = (*colors)[v];
        for (int k = 0; k < (c[3] == 1 ? 3 : 4); ++k) out_ += ' ', append_number(out_, c[k]);
      }
      out_ += '\n';
    }
  }

  /// Numbers the texture coordinates of all corners, equal ones once.
  void write_textures() {
    const auto textures = find_map(mesh_, attribute::texture);
    if (!textures) return;
    texture_numbers_.resize(mesh_.num_halfedges(), 0);
    std::map<std::pair<std::uint64_t, std::uint64_t>, std::size_t> known;
    for (const Face f : mesh_.faces())
      for (const Halfedge h : mesh_.halfedges_around_face(mesh_.halfedge(f))) {
        const TextureCoordinate& t = (*textures)[h];
        if (!std::isfinite(t[0]) || !std::isfinite(t[1])) continue;
        const auto key = std::pair(std::bit_cast<std::uint64_t>(t[0]), std::bit_cast<std::uint64_t>(t[1]));
        const auto [found, is_new] = known.emplace(key, known.size() + 1);
        texture_numbers_[h] = found->second;
        if (!is_new) continue;
        out_ += "vt ";
        append_number(out_, t[0]), out_ += ' ';
        append_number(out_, t[1]), out_ += '\n';
      }
  }

  /// Writes "g NAME" or "usemtl NAME" where the index changes; the bare word stands for none.
  void write_name(const char* word, const std::vector<std::string>& names, int index, int& last) {
    if (index == last) return;
    last = index;
    out_ += word;
    if (index >= 0 && static_cast<std::size_t>(index) < names.size() && !names[index].empty())
      out_ += ' ' + one_line(names[index]);
    else if (index >= 0)
      out_ += ' ' + std::to_string(index);
    out_ += '\n';
  }

  void write_faces() {
    const auto groups = find_map(mesh_, attribute::group), materials = find_map(mesh_, attribute::material),
               linings = find_map(mesh_, attribute::lining);
    int group = -1, material = -1;
    for (const Face f : mesh_.faces()) {
      if (groups) write_name("g", file_.group_names, (*groups)[f], group);
      if (materials) write_name("usemtl", file_.material_names, (*materials)[f], material);
      write_face(f, false);
    }
    for (const Face f : mesh_.faces()) {
      if (!linings || (*linings)[f] < 0) continue;
      if (groups) write_name("g", file_.group_names, (*groups)[f], group);
      write_name("usemtl", file_.material_names, (*linings)[f], material);
      write_face(f, true);
    }
  }

  void write_face(Face f, bool turned) {
    std::array<Halfedge, 3> corners = halfedges_of(mesh_, f);
    if (turned) std::reverse(corners.begin(), corners.end());
    const bool textured = !texture_numbers_.empty() &&
                          std::ranges::all_of(corners, [&](Halfedge h) { return texture_numbers_[h] > 0; });
    out_ += 'f';
    for (const Halfedge h : corners) {
      out_ += ' ';
      append_number(out_, numbers_[mesh_.target(h)] + 1);
      if (textured) out_ += '/', append_number(out_, texture_numbers_[h]);
    }
    out_ += '\n';
  }

  void write_line(const std::vector<std::size_t>& numbers, bool closed) {
    if (numbers.size() < 2) return;
    out_ += 'l';
    for (const std::size_t n : numbers) out_ += ' ', append_number(out_, n + 1);
    if (closed) out_ += ' ', append_number(out_, numbers.front() + 1);
    out_ += '\n';
  }

  void write_lines() {
    std::vector<std::array<std::size_t, 2>> segments;
    if (const auto line_edges = find_map(mesh_, attribute::line_edge))
      for (const Edge e : mesh_.edges())
        if ((*line_edges)[e])
          segments.push_back({numbers_[mesh_.vertex(e, 0)], numbers_[mesh_.vertex(e, 1)]});
    if (is_chain(mesh_))
      for (const Strut& link : struts(mesh_)) segments.push_back({numbers_[link.a], numbers_[link.b]});
    for (const Chain& chain : chain_segments(segments)) write_line(chain.vertices, chain.closed);
    if (segments.empty()) write_polylines();
  }

  bool lies_on_mesh(const Polyline& line) const {
    if (line.vertices.size() != line.points.size()) return false;
    for (std::size_t i = 0; i < line.vertices.size(); ++i) {
      if (line.vertices[i] >= mesh_.num_vertices()) return false;
      const Vertex v(static_cast<Mesh::size_type>(line.vertices[i]));
      if (mesh_.is_removed(v) || mesh_.point(v) != line.points[i]) return false;
    }
    return true;
  }

  void write_polylines() {
    std::size_t next = mesh_.number_of_vertices();
    for (const Polyline& line : file_.polylines) {
      std::vector<std::size_t> numbers;
      const bool on_mesh = lies_on_mesh(line);
      for (std::size_t i = 0; i < line.points.size(); ++i) {
        if (!on_mesh) write_position(line.points[i]), out_ += '\n';
        numbers.push_back(on_mesh ? numbers_[line.vertices[i]] : next++);
      }
      write_line(numbers, line.closed);
    }
  }

  const MeshFile& file_;
  const Mesh& mesh_;
  const WriteOptions& options_;
  const std::filesystem::path& folder_;
  std::vector<std::size_t> numbers_;
  std::vector<std::size_t> texture_numbers_;  ///< by half-edge, from 1; 0 = none
  std::string out_;
};

}  // namespace

void write_obj(std::ostream& out, const MeshFile& file, const WriteOptions& options,
               const std::filesystem::path& folder) {
  check_positions(file.mesh, options);
  out << ObjWriter(file, options, folder).text();
}

/// Of another program's text, which `transfer` keeps, UTF-8's mark stands before it.
bool is_own_obj(std::string_view head, std::string_view) {
  return head.starts_with(own_comment()) || head.starts_with("\xEF\xBB\xBF" + own_comment());
}

}  // namespace furrow::io
