// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/measure_shape.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bridge/arrays/convert.h"
#include "geometry/figure/hem_folds.h"
#include "geometry/fold/gather_lines.h"
#include "geometry/fold/line_height.h"
#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "io/mesh/mesh_file.h"

namespace furrow::jobs {
namespace {

Json line_json(const LineReport& r) {
  Json line{{"id", r.id}};
  if (r.name) line["name"] = *r.name;
  if (r.drawn_height) line["drawn_height"] = *r.drawn_height;
  if (r.width) line["width"] = *r.width;
  if (r.press != 1) line["press"] = r.press;
  line["smoothed_height"] = r.smoothed_height;
  line["height"] = r.height;
  line["kept"] = r.kept ? Json(*r.kept) : Json();
  if (r.gather) line["gather"] = *r.gather;
  if (r.gathered) line["gathered"] = *r.gathered;
  return line;
}

LineReport measure_line(std::size_t id, double now, double before, const io::WrinkleRecord& record) {
  LineReport line;
  line.id = id;
  if (id < record.lines.size()) {
    line.name = record.lines[id].name;
    line.drawn_height = record.lines[id].drawn_height;
    line.width = record.lines[id].width;
    line.press = record.lines[id].press;
  }
  const bool known = id < record.lines.size() && std::isfinite(record.lines[id].smoothed_height);
  line.smoothed_height = known ? record.lines[id].smoothed_height : before;
  line.height = known ? now - record.lines[id].base_height : now;
  // Lines so close together that they made one shape have no height of their own to keep; one that is drawn
  // to have an edge there, of height 0, has none at all.
  constexpr double least_height = 1e-4;  // [m]
  const auto crest = id < record.lines.size() ? record.lines[id].crest_height : std::nullopt;
  const bool alone = !crest || std::abs(line.smoothed_height) > 0.35 * std::abs(*crest);
  if (alone && std::abs(line.smoothed_height) > least_height &&
      std::abs(line.smoothed_height) > 0.1 * std::abs(line.drawn_height.value_or(line.smoothed_height)))
    line.kept = line.height / line.smoothed_height;
  return line;
}

physics::Vec3 centre_of_mass(const geometry::Mesh& mesh) {
  const auto mass = *geometry::find_map(mesh, geometry::attribute::mass);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0;
  const std::vector<char> loose = geometry::loose_vertices(mesh);
  for (geometry::Vertex v : mesh.vertices()) {
    if (loose[v]) continue;
    sum += mass[v] * bridge::to_eigen(mesh.point(v));
    total += mass[v];
  }
  sum /= total;
  return sum;
}

/// The middle of the edge, or of a chain's link, that is strained most; the mesh has rest lengths.
physics::Vec3 strained_most(const geometry::Mesh& mesh) {
  const auto rest = *geometry::find_map(mesh, geometry::attribute::rest_length);
  physics::Vec3 place{0, 0, 0};
  double most = -1;
  const auto look_at = [&](geometry::Vertex v, geometry::Vertex w, double rest_length) {
    const physics::Vec3 a = bridge::to_eigen(mesh.point(v)), b = bridge::to_eigen(mesh.point(w));
    const double strain = std::abs((b - a).norm() / rest_length - 1);
    if (!(strain > most)) return;
    most = strain;
    place = (a + b) / 2;
  };
  for (geometry::Edge e : mesh.edges()) look_at(mesh.vertex(e, 0), mesh.vertex(e, 1), rest[e]);
  if (geometry::is_chain(mesh))
    for (const geometry::Strut& link : geometry::struts(mesh)) look_at(link.a, link.b, link.rest_length);
  return place;
}

ContactReport measure_contact(const geometry::Mesh& mesh, const WorldBody& body, double gap, double time) {
  ContactReport contact;
  contact.gap = gap;
  contact.tolerance = body.tolerance();
  const std::vector<physics::Vec3> x = bridge::positions_of(mesh);
  contact.inside = body.penetration(x, time);
  if (contact.inside.inside) contact.deepest_at = body.deepest_of(x, time);
  return contact;
}

}  // namespace

std::vector<BorderReport> measure_borders(const geometry::Mesh& mesh) {
  std::vector<BorderReport> borders;
  const std::vector<double> lengths = geometry::rest_lengths(mesh);
  for (const geometry::BorderLoop& loop : geometry::border_loops(mesh))
    borders.push_back({geometry::rest_length(mesh, loop, lengths), loop.length, loop.mean_height,
                       loop.mean_radius, geometry::count_folds(mesh, loop)});
  return borders;
}

std::vector<double> line_heights_by_id(const io::MeshFile& file) {
  const auto record = io::find_wrinkle_record(file);
  const std::vector<double> widths = record ? io::line_widths(*record) : std::vector<double>{};
  std::vector<double> heights;
  for (const geometry::LineHeight& h : geometry::line_heights(file.mesh, widths)) {
    heights.resize(std::max(heights.size(), static_cast<std::size_t>(h.line) + 1), geometry::unset_value);
    heights[h.line] = h.height;
  }
  return heights;
}

std::vector<LineReport> measure_lines(const io::MeshFile& file, const std::vector<double>& before) {
  std::vector<LineReport> lines;
  const io::WrinkleRecord record = io::find_wrinkle_record(file).value();
  const std::vector<double> now = line_heights_by_id(file);
  for (std::size_t i = 0; i < now.size(); ++i)
    if (std::isfinite(now[i]))  // else its vertices went to later lines
      lines.push_back(measure_line(i, now[i], i < before.size() ? before[i] : now[i], record));
  for (const geometry::GatherThread& thread : geometry::gather_threads(file.mesh, io::gathered_lines(record)))
    for (LineReport& line : lines)
      if (int(line.id) == thread.line) {
        line.gather = record.lines[line.id].gather;
        line.gathered = *line.gather * thread.length / thread.rest_length;
      }
  return lines;
}

ReachedShape measure_shape(const io::MeshFile& file, const std::vector<double>& before, const WorldBody* body,
                           double contact_gap, double time) {
  ReachedShape shape;
  shape.centre = centre_of_mass(file.mesh);
  if (body) {
    shape.contact = measure_contact(file.mesh, *body, contact_gap, time);
    shape.end.body = body->end_of(file.mesh, contact_gap, time);
  }
  shape.strained_most = strained_most(file.mesh);
  shape.borders = measure_borders(file.mesh);
  shape.lines = measure_lines(file, before);
  return shape;
}

Json to_json(const std::vector<BorderReport>& borders) {
  Json loops = Json::array();
  for (const BorderReport& border : borders)
    loops.push_back({{"rest_length", border.rest_length},
                     {"length", border.length},
                     {"mean_height", border.mean_height},
                     {"mean_radius", border.mean_radius},
                     {"radius_maxima", border.radius_maxima}});
  return loops;
}

Json to_json(const std::vector<LineReport>& lines) {
  Json list = Json::array();
  for (const LineReport& line : lines) list.push_back(line_json(line));
  return list;
}

}  // namespace furrow::jobs
