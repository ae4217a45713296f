// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/refine/transfer_shape.h"
#include "io/base/atomic_file.h"
#include "io/base/bytes_file.h"
#include "io/mesh/rewrite_obj_vertices.h"

namespace furrow::cli {
namespace {

struct TransferArguments : CommonArguments {
  std::string original, wrinkled, rest;
  geometry::TransferOptions options;
};

/// Rest positions from a mesh with the same vertices.
void set_rest_positions(geometry::Mesh& mesh, const TransferArguments& a) {
  const io::MeshFile rest = read_mesh(a.rest, a);
  if (rest.mesh.num_vertices() != mesh.num_vertices())
    throw geometry::ContentError(a.rest + ": has " + std::to_string(rest.mesh.num_vertices()) +
                                 " vertices, but " + a.wrinkled + " has " +
                                 std::to_string(mesh.num_vertices()));
  auto map = geometry::ensure_map(mesh, geometry::attribute::rest_position);
  for (geometry::Vertex v : mesh.vertices()) {
    const geometry::Point& p = rest.mesh.point(v);
    map[v] = {p.x(), p.y(), p.z()};
  }
}

/// An OBJ file for an OBJ file: its text with other positions, so that polygons stay polygons.
void write_as_read(const io::MeshFile& file, const std::string& text, const TransferArguments& a) {
  std::vector<geometry::Point> positions;
  for (geometry::Vertex v : file.mesh.vertices()) positions.push_back(file.mesh.point(v));
  const std::string changed = io::rewrite_obj_vertices(text, a.original, positions, write_options(a));
  if (a.out != "-") return io::write_atomically(a.out, [&](std::ostream& out) { out << changed; });
  std::cout << changed;
  flush_output();
}

void write_result(const io::MeshFile& file, const TransferArguments& a) {
  const auto is_obj = [](const std::string& path) { return io::mesh_format(path) == io::MeshFormat::obj; };
  if (is_obj(a.original) && is_obj(a.out) && a.original != "-")
    return write_as_read(file, io::read_text(a.original), a);
  if (const std::size_t cut = file.repairs.triangulated_faces)
    warn(a.out + ": " + std::to_string(cut) +
             " faces with more than three corners are written as triangles; from OBJ to OBJ they stay whole",
         a);
  write_mesh(file, a);
}

void transfer(TransferArguments a) {
  check_output(a.out);
  refuse_same({a.out}, {a.original, a.wrinkled, a.rest});
  take_noted_frame(a, {a.original, a.wrinkled, a.rest});
  io::MeshFile original = read_mesh(a.original, a);
  io::MeshFile wrinkled = read_mesh(a.wrinkled, a);
  if (!a.rest.empty()) set_rest_positions(wrinkled.mesh, a);
  const geometry::TransferReport r = geometry::transfer_shape(original.mesh, wrinkled.mesh, a.options);
  write_result(original, a);
  print_report({{"vertices", original.mesh.number_of_vertices()},
                {"copied", r.copied},
                {"interpolated", r.interpolated},
                {"unchanged", r.unchanged},
                {"max_distance", r.max_distance},
                {"written", a.out}},
               a);
}

}  // namespace

void add_transfer(CLI::App& app) {
  auto a = std::make_shared<TransferArguments>();
  CLI::App* sub = app.add_subcommand(
      "transfer",
      "Bring the shape of a wrinkled mesh back to the mesh it was made of\n\n"
      "The original's texture coordinates, groups and attributes stay as they are. From OBJ to OBJ all but\n"
      "the coordinates of its vertices is copied as it stands, polygons too; otherwise faces are written as\n"
      "triangles.\n\n"
      "  furrow transfer shirt.obj worn.ply -o shirt-worn.obj");
  sub->add_option("original", a->original, "mesh whose vertices are to move")->required();
  sub->add_option("wrinkled", a->wrinkled, "mesh of wrinkle or simulate; PLY knows where its vertices lay")
      ->required();
  sub->add_option("-o,--output", a->out, "mesh to write: obj, ply, off or stl; - is OBJ to standard output")
      ->required();
  sub->add_option("--rest", a->rest, "the wrinkled mesh's vertices before lines and motion, if it is no PLY");
  sub->add_option("--max-distance", a->options.max_distance,
                  "how far an original vertex may lie from the wrinkled mesh's rest surface [m]")
      ->capture_default_str();
  add_common_options(*sub, *a);
  sub->callback([a] { transfer(*a); });
}

}  // namespace furrow::cli
