// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>
#include <ostream>

#include "geometry/mesh/mesh.h"
#include "io/base/byte_order.h"
#include "io/base/own_mark.h"
#include "io/mesh/mesh_writers.h"

namespace furrow::io {
namespace {

using namespace geometry;

const std::string own_head = "binary STL " + std::string(own_mark);  // must not begin with "solid"

void put(std::string& out, const Vector& v) {
  for (int k = 0; k < 3; ++k) append_in_order(out, static_cast<float>(v[k]), std::endian::little);
}

}  // namespace

/// Binary STL: single precision, no vertex is shared. Everything but the triangles is left out.
void write_stl(std::ostream& out, const MeshFile& file, const WriteOptions& options) {
  const Mesh& mesh = file.mesh;
  check_positions(mesh, options);
  std::string bytes = own_head;
  bytes.resize(80, ' ');
  append_in_order(bytes, static_cast<std::uint32_t>(mesh.number_of_faces()), std::endian::little);
  for (const Face f : mesh.faces()) {
    Vector corners[3];
    int k = 0;
    for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f)))
      corners[k++] = to_file(mesh.point(v), options);
    const Vector area = CGAL::cross_product(corners[1] - corners[0], corners[2] - corners[0]);
    const double length = std::sqrt(area.squared_length());
    put(bytes, length > 0 && std::isfinite(length) ? area / length : Vector(0, 0, 0));
    for (const Vector& corner : corners) put(bytes, corner);
    bytes.append(2, '\0');
  }
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

bool is_own_stl(std::string_view head, std::string_view) { return head.starts_with(own_head); }

}  // namespace furrow::io
