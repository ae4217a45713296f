// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/doctor.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "geometry/figure/close_holes.h"
#include "geometry/figure/repair_body.h"
#include "geometry/mesh/measures.h"
#include "io/mesh/weld.h"
#include "jobs/base/card.h"
#include "jobs/base/gate.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "jobs/base/seam_ties.h"
#include "jobs/body/world_body.h"
#include "physics/base/cancel_scope.h"

namespace furrow::jobs {
namespace {

constexpr std::size_t small_hole = 8;  // edges of one that is closed in a garment

void check(const DoctorJob& job, Listener& listener) {
  if (job.body && job.is_body) throw std::invalid_argument("`body`: the mesh is examined as a body itself");
  if (job.body_unit && !is_unit(*job.body_unit))
    throw std::invalid_argument("`body_unit`: '" + *job.body_unit + "' is not m, cm, mm or inch");
  const std::string output = job.output.string();
  if (!output.empty()) check_output(output);
  if (!output.empty() && !job.repair)
    throw std::invalid_argument("`output` writes the mended mesh; say `repair`, too");
  std::vector<std::string> outputs{output};
  outputs.insert(outputs.end(), job.more_outputs.begin(), job.more_outputs.end());
  check_replaced(outputs, {name_of(job.mesh, ""), job.body ? name_of(*job.body, "") : ""}, listener);
}

void append(std::vector<Ailment>& all, std::vector<Ailment> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

bool has(const std::vector<Ailment>& found, const std::string& code) {
  for (const Ailment& a : found)
    if (a.code == code) return true;
  return false;
}

/// Of a size that no person or garment has; its unit is asked for.
void add_odd_size(const geometry::Mesh& mesh, const std::string& what, const Frame& frame,
                  std::vector<Ailment>& found) {
  const std::string odd = odd_size(mesh, what, frame);
  if (odd.empty()) return;
  Ailment a{"size", odd, "`unit`"};
  a.fatal = true;
  found.push_back(std::move(a));
}

/// Vertices at one place are joined in every body, and its borders become caps.
std::vector<Ailment> examine_body(const io::MeshFile& file, const Frame& frame) {
  std::vector<Ailment> found = faults_of_mesh(file);
  std::erase_if(
      found, [](const Ailment& a) { return a.code == "soup" || a.code == "unjoined" || a.code == "holes"; });
  append(found, faults_of_body(file.mesh, frame.up.has_value()));
  add_odd_size(file.mesh, "body", frame, found);
  const geometry::BodyReport report = geometry::repair_body(file.mesh).report;
  if (report.filled_holes == 0) return found;
  Ailment open{"open", "the body has " + std::to_string(report.filled_holes) + " holes, which become caps",
               "`furrow doctor repair` closes them"};
  open.count = report.filled_holes;
  open.mendable = true;
  found.push_back(std::move(open));
  return found;
}

std::vector<Ailment> examine(const io::MeshFile& file, const DoctorJob& job, const Frame& frame) {
  if (job.is_body) return examine_body(file, frame);
  std::vector<Ailment> found = faults_of_mesh(file);
  append(found, faults_of_garment(file.mesh));
  add_odd_size(file.mesh, "garment", frame, found);
  return found;
}

std::vector<Ailment> examine_pair(const geometry::Mesh& garment, const DoctorJob& job,
                                  const Context& context) {
  if (!job.body) return {};
  const Context its{with_unit(context.frame, job.body_unit), context.listener, context.memory};
  const io::MeshFile body = read_mesh(*job.body, its);
  std::vector<Ailment> found = faults_of_body(body.mesh, job.frame.up.has_value());
  add_odd_size(body.mesh, "body", its.frame, found);
  const bool odd = has(found, "size") || !odd_size(garment, "garment", context.frame).empty();
  std::vector<Ailment> pair = faults_of_pair(garment, outline_of(body.mesh), job.body_unit.has_value());
  if (odd) std::erase_if(pair, [](const Ailment& a) { return a.code == "two_units"; });  // is told already
  append(found, std::move(pair));
  return found;
}

/// A body closed and wound outwards; what was on its faces is gone.
geometry::Mesh closed_body(const geometry::Mesh& mesh) {
  const geometry::Body body = geometry::repair_body(mesh);
  geometry::Mesh closed;
  for (const geometry::Point& p : body.points) closed.add_vertex(p);
  using Index = geometry::Vertex::size_type;
  for (const auto& [a, b, c] : body.triangles)
    closed.add_face(geometry::Vertex(Index(a)), geometry::Vertex(Index(b)), geometry::Vertex(Index(c)));
  return closed;
}

bool any_mendable(const std::vector<Ailment>& found) {
  for (const Ailment& a : found)
    if (a.mendable) return true;
  return false;
}

/// Repairs of the reader are in the mesh already.
void mend(DoctorReport& report, const DoctorJob& job) {
  io::MeshFile& file = report.mesh;
  if (any_mendable(report.found)) {
    constexpr std::array joined = {"soup", "unjoined", "two_sided", "seams_apart", "t_junctions"};
    if (std::ranges::any_of(joined, [&](const char* code) { return has(report.found, code); }))
      file = io::welded(file, name_of(job.mesh, "the mesh"));
    SeamTies ties = seam_ties(file.mesh);
    const SeamTies doubled = doubled_vertices(file);
    ties.insert(ties.end(), doubled.begin(), doubled.end());
    file.repairs = {};
    if (job.is_body)
      file.mesh = closed_body(file.mesh);
    else
      geometry::close_small_holes(file.mesh, small_hole);
    if (!job.is_body && !ties.empty()) set_seam_ties(file.mesh, ties, {});
  }
  report.left = examine(file, job, report.frame);
  report.repaired = true;
}

Json to_json(const Ailment& a) {
  Json places = Json::array();
  for (const geometry::Point& p : a.places) places.push_back({p.x(), p.y(), p.z()});
  return {{"code", a.code},   {"text", a.text},         {"help", a.help},  {"count", a.count},
          {"fatal", a.fatal}, {"mendable", a.mendable}, {"places", places}};
}

Json to_json(const std::vector<Ailment>& all) {
  Json list = Json::array();
  for (const Ailment& a : all) list.push_back(to_json(a));
  return list;
}

}  // namespace

DoctorReport doctor(const DoctorJob& job, Listener& listener) {
  const physics::CancelScope cancelling([&listener] { return listener.cancelled(); });
  check(job, listener);
  DoctorReport report;
  report.frame = job.frame;
  take_noted_frame(report.frame, {name_of(job.mesh, "")});
  SilentListener silent(listener);  // what reading repairs is in the report
  const Context context{report.frame, silent};
  report.mesh = read_mesh(job.mesh, context);
  stop_if_cancelled(context);
  report.found = examine(report.mesh, job, report.frame);
  append(report.found, examine_pair(report.mesh.mesh, job, context));
  stop_if_cancelled(context);
  if (job.repair) mend(report, job);
  warn_of_lost_ties(report.mesh.mesh, job.output, listener);
  if (!job.output.empty() && job.output != "-") write_mesh(job.output, report.mesh, {report.frame, listener});
  return report;
}

std::vector<CardRow> card(DoctorJob& job) {
  return {
      {"body", &job.body, "body that the garment goes with: sizes, axes, which is which"},
      {"body_unit", unit_choice(job.body_unit), "unit of the body's file, where it is not the garment's"},
      {"as_body", &job.is_body, "examine the mesh as a body: closed, wound outwards"},
      {"repair", &job.repair,
       "join vertices at the same place and seams that lie open by a rounding, drop faces that are twice "
       "there, wind neighbours alike, part what "
       "is not manifold, close holes (small ones of a garment, all of a body)"},
      {"output", &job.output, "mended mesh to write: " + io::mesh_formats()},
  };
}

Json to_json(const DoctorReport& r) {
  const geometry::MeshInfo info = geometry::measure(r.mesh.mesh);
  Json json{{"well", r.well()}, {"found", to_json(r.found)}};
  if (r.repaired) json["left"] = to_json(r.left);
  json["vertices"] = info.vertices;
  json["faces"] = info.faces;
  json["components"] = info.components;
  json["boundary_loops"] = info.boundary_loops;
  json["closed"] = info.closed;
  json["size"] = {info.box_max.x() - info.box_min.x(), info.box_max.y() - info.box_min.y(),
                  info.box_max.z() - info.box_min.z()};
  return json;
}

}  // namespace furrow::jobs
