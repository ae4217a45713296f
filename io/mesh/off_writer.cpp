// SPDX-License-Identifier: GPL-3.0-or-later
#include <ostream>

#include "geometry/mesh/property_names.h"
#include "io/base/number_text.h"
#include "io/base/own_mark.h"
#include "io/mesh/mesh_writers.h"

namespace furrow::io {
namespace {

using namespace geometry;

/// A colour's component: with a point or an exponent, since whole numbers would go from 0 to 255.
void append_component(std::string& out, double value) {
  const std::size_t first = out.size();
  append_number(out, value);
  if (out.find_first_of(".e", first) == out.npos) out += ".0";
}

}  // namespace

/// OFF, or COFF where the mesh has colours, in double. Everything else is left out.
void write_off(std::ostream& out, const MeshFile& file, const WriteOptions& options) {
  const Mesh& mesh = file.mesh;
  check_positions(mesh, options);
  const std::vector<std::size_t> numbers = vertex_numbers(mesh);
  const auto colors = find_map(mesh, attribute::color);
  std::string text = colors ? "COFF\n" : "OFF\n";
  append_number(text, mesh.number_of_vertices()), text += ' ';
  append_number(text, mesh.number_of_faces()), text += " 0\n";
  for (const Vertex v : mesh.vertices()) {
    const Vector p = to_file(mesh.point(v), options);
    for (int k = 0; k < 3; ++k) append_number(text, p[k]), text += k < 2 ? " " : "";
    if (colors)
      for (const double c : (*colors)[v]) text += ' ', append_component(text, c);
    text += '\n';
  }
  for (const Face f : mesh.faces()) {
    text += '3';
    for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f)))
      text += ' ', append_number(text, numbers[v]);
    text += '\n';
  }
  out << text << own_comment();
}

bool is_own_off(std::string_view head, std::string_view tail) {
  return (head.starts_with("OFF\n") || head.starts_with("COFF\n")) && tail.ends_with("\n" + own_comment());
}

}  // namespace furrow::io
