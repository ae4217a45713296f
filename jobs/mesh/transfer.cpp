// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/transfer.h"

#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/figure/border_seams.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/property_names.h"
#include "io/base/atomic_file.h"
#include "io/base/bytes_file.h"
#include "io/base/own_mark.h"
#include "io/mesh/material_libraries.h"
#include "io/mesh/rewrite_obj_vertices.h"
#include "jobs/base/card.h"
#include "jobs/base/gate.h"
#include "jobs/base/measure_crossings.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "jobs/body/world_body.h"
#include "physics/base/cancel_scope.h"

namespace furrow::jobs {
namespace {

std::vector<std::string> names_of_inputs(const TransferJob& job) {
  return {name_of(job.original, ""), name_of(job.wrinkled, ""), job.rest ? name_of(*job.rest, "") : "",
          job.body ? name_of(*job.body, "") : ""};
}

/// Rest positions from a mesh with the same vertices.
void set_rest_positions(geometry::Mesh& mesh, const TransferJob& job, const Context& context) {
  const io::MeshFile rest = read_mesh(*job.rest, context);
  if (rest.mesh->num_vertices() != mesh.num_vertices())
    throw geometry::ContentError(name_of(*job.rest, "the rest") + ": has " +
                                 std::to_string(rest.mesh->num_vertices()) + " vertices, but " +
                                 name_of(job.wrinkled, "the wrinkled mesh") + " has " +
                                 std::to_string(mesh.num_vertices()));
  auto map = geometry::ensure_map(mesh, geometry::attribute::rest_position);
  for (geometry::Vertex v : mesh.vertices()) {
    const geometry::Point& p = rest.mesh->point(v);
    map[v] = {p.x(), p.y(), p.z()};
  }
}

/// Vertices that keep off the body may lie farther apart than those that were draped: between them it comes
/// through.
BodyEnd end_on(const MeshInput& input, const geometry::Mesh& garment, const Context& context) {
  const physics::TriangleMesh body = read_body(input, context);
  const BodyEnd end = body_end(garment, body, physics::ExactDistance(body), 0);
  const std::string name = name_of(input, "body");
  if (end.pierced_faces)
    context.warn("body_comes_through",
                 words_of_piercing(end) +
                     ": its faces are larger than those that were worn; refine the original first (furrow "
                     "subdivide), or let what is worn keep farther off (`gap`)",
                 name, "`furrow subdivide`");
  return end;
}

bool is_obj(const std::string& path) { return io::mesh_format(path) == io::MeshFormat::obj; }

/// An OBJ file for an OBJ file: its text with other positions, so that polygons stay polygons.
std::optional<std::string> text_as_read(const TransferJob& job, const io::MeshFile& file,
                                        const Frame& frame) {
  const std::string original = name_of(job.original, "");
  if (original.empty() || original == "-" || job.output.empty() || !is_obj(original) ||
      !is_obj(job.output.string()))
    return std::nullopt;
  const std::vector<geometry::Point> positions(file.mesh->points().begin(), file.mesh->points().end());
  const std::string mark = "# " + std::string(io::own_mark) + "\n",
                    text = io::rewrite_obj_vertices(io::read_text(original), original, positions,
                                                    write_options(frame), file.folder,
                                                    io::folder_of(job.output));
  const std::size_t first = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  return text.compare(first, mark.size(), mark) == 0 ? text : std::string(text).insert(first, mark);
}

/// Where vertices lie amid an edge of their seam, an OBJ that keeps its faces shows slits once they have
/// moved.
void warn_of_slits(const TransferJob& job, const geometry::Mesh& moved, const Context& context) {
  SilentListener silent(context.listener);
  const geometry::Mesh in_file = read_mesh(job.original, {context.frame, silent}).mesh;
  const geometry::BorderSeams seams = geometry::find_border_seams(in_file);
  const std::vector<geometry::Vertex> own = geometry::joined_vertices(in_file, seams);
  double widest = 0;
  for (const geometry::SeamSplit& split : seams.splits) {
    const auto at = [&](geometry::Vertex v) { return moved.point(own[v.idx()]); };
    const geometry::Point a = at(in_file.source(split.border)), b = at(in_file.target(split.border));
    widest = std::max(widest, std::sqrt(CGAL::squared_distance(a + split.t * (b - a), at(split.at))));
  }
  if (widest > 1e-4)
    context.warn(
        "slits",
        job.output.string() + ": " + std::to_string(seams.splits.size()) +
            " vertices amid an edge of their seam come off it by up to " + geometry::length_text(widest) +
            ", as the file keeps its faces; mend the original first (`furrow doctor repair`), or write "
            "a .ply",
        job.output.string(), "`furrow doctor repair`");
}

void write(const TransferJob& job, const TransferReport& report, const Context& context) {
  if (job.output == "-" || job.output.empty()) return;
  if (report.obj_text) warn_of_slits(job, report.result.mesh, context);
  if (report.obj_text)
    return io::write_atomically(job.output, [&](std::ostream& out) { out << *report.obj_text; });
  if (const std::size_t cut = report.result.repairs.triangulated_faces)
    context.warn("polygons_cut",
                 job.output.string() + ": " + std::to_string(cut) +
                     " faces with more than three corners are written as triangles; from OBJ to OBJ they "
                     "stay whole",
                 job.output.string());
  write_mesh(job.output, report.result, context);
}

}  // namespace

TransferReport transfer(const TransferJob& job, Listener& listener) {
  const physics::CancelScope cancelling([&listener] { return listener.cancelled(); });
  check_card(job);
  if (!job.output.empty()) check_output(job.output.string());
  check_replaced({job.output.string()}, names_of_inputs(job), listener);
  TransferReport report;
  report.frame = job.frame;
  take_noted_frame(report.frame, names_of_inputs(job));
  const Context context{report.frame, listener};
  report.result = read_garment(job.original, context, "original");
  io::MeshFile wrinkled = read_mesh(job.wrinkled, context);
  require_area(wrinkled.mesh, name_of(job.wrinkled, "the wrinkled mesh"));
  if (job.rest) set_rest_positions(wrinkled.mesh, job, context);
  stop_if_cancelled(context);
  const CrossedStart crossed = crossed_start(report.result.mesh);
  report.moved = naming(name_of(job.wrinkled, "the wrinkled mesh"), [&] {
    return geometry::transfer_shape(report.result.mesh, wrinkled.mesh, job.options);
  });
  geometry::close_joined(report.result.mesh);
  report.crossings = measure_crossings(report.result, &crossed);
  if (report.crossings.pairs) context.warn("cloth_crosses", words(report.crossings), job.output.string());
  report.end.crossings = report.crossings.pairs;
  if (job.body) report.end.body = end_on(*job.body, report.result.mesh, context);
  stop_if_cancelled(context);
  report.obj_text = text_as_read(job, report.result, report.frame);
  write(job, report, context);
  return report;
}

std::vector<CardRow> card(TransferJob& job) {
  return {
      {"output", &job.output, "mesh to write: " + io::mesh_formats()},
      {"rest_shape", &job.rest,
       "the wrinkled mesh's vertices before lines and motion, if it does not know them, as PLY does"},
      {"body", &job.body,
       "body that it is worn on, in the same frame: where it comes through the mesh is reported"},
      {"max_distance", &job.options.max_distance, positive,
       "how far an original vertex may lie from the wrinkled mesh's rest surface [m]"},
  };
}

Json to_json(const TransferReport& r) {
  return {{"vertices", r.result.mesh->number_of_vertices()},
          {"copied", r.moved.copied},
          {"by_index", r.moved.by_index},
          {"interpolated", r.moved.interpolated},
          {"unchanged", r.moved.unchanged},
          {"max_distance", r.moved.max_distance},
          {"crossings", to_json(r.crossings)},
          {"end", to_json(r.end)}};
}

}  // namespace furrow::jobs
