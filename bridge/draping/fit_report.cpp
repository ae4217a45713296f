// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/fit_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "bridge/arrays/convert.h"
#include "bridge/draping/fit_ease.h"
#include "bridge/draping/fit_piercing.h"
#include "bridge/draping/fit_zones.h"
#include "geometry/figure/principal_strain.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/vertex_attributes.h"
#include "physics/base/cancel_scope.h"

namespace furrow::bridge {
namespace {

using geometry::Face;
using geometry::Mesh;
using geometry::Vertex;

constexpr double around = 0.05;  // [m]

void check(const FitOptions& o) {
  const auto refuse = [](const char* name, double value, const char* range) {
    throw std::invalid_argument(std::string("fit_report: ") + name + " = " + std::to_string(value) +
                                " is not " + range);
  };
  if (!(o.tight_strain > 0 && std::isfinite(o.tight_strain))) refuse("tight_strain", o.tight_strain, "> 0");
  if (!(o.loose_distance > 0 && std::isfinite(o.loose_distance)))
    refuse("loose_distance", o.loose_distance, "> 0");
  if (!(o.contact_distance >= 0 && std::isfinite(o.contact_distance)))
    refuse("contact_distance", o.contact_distance, ">= 0");
  if (!(o.smallest_zone >= 0 && std::isfinite(o.smallest_zone)))
    refuse("smallest_zone", o.smallest_zone, ">= 0");
  const std::pair<const char*, std::optional<double>> heights[] = {
      {"chest", o.sections.chest}, {"waist", o.sections.waist}, {"hip", o.sections.hip}};
  for (const auto& [name, height] : heights)
    if (height && !std::isfinite(*height)) refuse(name, *height, "finite");
}

struct Weighted {
  double value, weight;
};

/// The least value that a share q of the weight does not pass; at least one weight > 0.
double quantile(const std::vector<Weighted>& sorted, double q) {
  double total = 0, sum = 0;
  for (const Weighted& w : sorted) total += w.weight;
  for (const Weighted& w : sorted)
    if ((sum += w.weight) >= q * total && w.weight > 0) return w.value;
  return sorted.back().value;
}

double share_where(const std::vector<Weighted>& values, const auto& holds) {
  double total = 0, sum = 0;
  for (const Weighted& w : values) {
    total += w.weight;
    if (holds(w.value)) sum += w.weight;
  }
  return total > 0 ? sum / total : 0;
}

void sort_by_value(std::vector<Weighted>& values) {
  std::erase_if(values, [](const Weighted& w) { return !(w.weight > 0); });
  std::stable_sort(values.begin(), values.end(),
                   [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
}

std::vector<double> face_areas(const Mesh& mesh) {
  std::vector<double> areas(mesh.num_faces(), 0);
  for (Face f : mesh.faces()) {
    const geometry::Halfedge h = mesh.halfedge(f);
    const geometry::Point& a = mesh.point(mesh.source(h));
    areas[f.idx()] = std::sqrt(CGAL::cross_product(mesh.point(mesh.target(h)) - a,
                                                   mesh.point(mesh.target(mesh.next(h))) - a)
                                   .squared_length()) /
                     2;
  }
  return areas;
}

bool has_rest(const Mesh& mesh) {
  const auto rest = geometry::find_map(mesh, geometry::attribute::rest_length);
  if (!rest) return false;
  return std::any_of(mesh.edges().begin(), mesh.edges().end(),
                     [&](geometry::Edge e) { return !std::isnan((*rest)[e]); });
}

/// At each vertex the mean over its faces, by their areas; 0 where none has a strain.
std::vector<double> strain_at_vertices(const Mesh& mesh,
                                       const std::vector<geometry::PrincipalStrain>& strains,
                                       const std::vector<double>& areas) {
  std::vector<double> sum(mesh.num_vertices(), 0), weight(mesh.num_vertices(), 0);
  for (Face f : mesh.faces()) {
    const double strain = strains[f.idx()].largest;
    if (std::isnan(strain)) continue;
    for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) {
      sum[v.idx()] += areas[f.idx()] * strain;
      weight[v.idx()] += areas[f.idx()];
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = weight[i] > 0 ? sum[i] / weight[i] : 0;
  return sum;
}

FitStrain summary_of(const Mesh& mesh, const std::vector<geometry::PrincipalStrain>& strains,
                     const std::vector<double>& areas, double threshold) {
  FitStrain s;
  std::vector<Weighted> values;
  for (Face f : mesh.faces()) {
    const double strain = strains[f.idx()].largest;
    if (std::isnan(strain))
      ++s.unknown_faces;
    else
      values.push_back({strain, areas[f.idx()]});
  }
  sort_by_value(values);
  if (values.empty()) return s;
  s.share_over = share_where(values, [&](double x) { return x > threshold; });
  s.p50 = quantile(values, 0.5);
  s.p99 = quantile(values, 0.99);
  s.max = values.back().value;
  return s;
}

FitDistance summary_of(const Mesh& mesh, const std::vector<double>& distances,
                       const std::vector<double>& areas, double contact) {
  std::vector<double> weight(mesh.num_vertices(), 0);
  for (Face f : mesh.faces())
    for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) weight[v.idx()] += areas[f.idx()] / 3;
  FitDistance d;
  std::vector<Weighted> values;
  for (Vertex v : mesh.vertices()) {
    values.push_back({distances[v.idx()], weight[v.idx()]});
    if (weight[v.idx()] > 0 && distances[v.idx()] < 0) ++d.vertices_inside;
  }
  sort_by_value(values);
  d.min = values.front().value;
  d.median = quantile(values, 0.5);
  d.p95 = quantile(values, 0.95);
  d.share_in_contact = share_where(values, [&](double x) { return x <= contact; });
  d.deepest_penetration = std::max(0.0, -d.min);
  return d;
}

/// Which way from the torso's middle at its height a zone lies; y up, the wearer looks along +z.
std::string side_of(const geometry::Point& p, const std::vector<geometry::TorsoLevel>& levels,
                    const std::array<double, 2>& middle) {
  std::array<double, 2> centre = middle;
  double nearest = std::numeric_limits<double>::infinity();
  for (const geometry::TorsoLevel& level : levels)
    if (const double away = std::abs(level.height - p.y()); away < nearest) {
      nearest = away;
      centre = level.centre;
    }
  const double x = p.x() - centre[0], z = p.z() - centre[1];
  if (std::hypot(x, z) < around) return "around";
  if (std::abs(z) >= std::abs(x)) return z > 0 ? "front" : "back";
  return x > 0 ? "left" : "right";
}

/// The body as geometry takes it, and what was found on it.
struct Measured {
  std::vector<geometry::Point> points;
  std::vector<geometry::TorsoLevel> levels;
  SectionHeights heights;
};

Measured measure_body(const physics::TriangleMesh& body, const physics::ExactDistance& distance,
                      const SectionHeights& told) {
  Measured m;
  for (const physics::Vec3& x : body.vertices) m.points.push_back(to_cgal(x));
  m.levels = geometry::torso_levels(m.points, body.triangles);
  m.heights = told;
  const auto found = geometry::torso_heights(m.levels, distance.low().y(), distance.high().y());
  if (!found) return m;
  if (!told.chest) m.heights.chest = found->chest;
  if (!told.waist) m.heights.waist = found->waist;
  if (!told.hip) m.heights.hip = found->hip;
  return m;
}

void write_attribute(Mesh& mesh, const char* name, const std::vector<double>& values) {
  auto map = geometry::ensure_vertex_attribute(mesh, name);
  for (Vertex v : mesh.vertices()) map[v] = values[v.idx()];
}

/// Zones of a garment, each placed on the figure, or on the garment, that `report` has the height of.
class ZoneFinder {
 public:
  ZoneFinder(const Mesh& garment, const FitOptions& options, const std::vector<geometry::TorsoLevel>& levels,
             const std::array<double, 2>& middle, FitReport& report)
      : garment_(garment), options_(options), levels_(levels), middle_(middle), report_(report) {}
  std::vector<FitZone> find(const std::vector<double>& values, double threshold) const {
    FitZones found = fit_zones(garment_, values, threshold, options_.smallest_zone);
    report_.left_out += found.left_out;
    place(found.zones);
    return std::move(found.zones);
  }
  void place(std::vector<FitZone>& zones) const {
    const double tall = std::max(report_.body_high - report_.body_low, 1e-9);
    for (FitZone& zone : zones) {
      zone.height_share = (zone.centre.y() - report_.body_low) / tall;
      zone.side = side_of(zone.centre, levels_, middle_);
    }
  }

 private:
  const Mesh& garment_;
  const FitOptions& options_;
  const std::vector<geometry::TorsoLevel>& levels_;
  std::array<double, 2> middle_;
  FitReport& report_;
};

/// Its area and its strain: a summary, tight zones, and the attribute.
void measure_strain(Mesh& garment, const FitOptions& options, const std::vector<double>& areas,
                    const ZoneFinder& zones, FitReport& report) {
  if (!has_rest(garment)) return;
  const auto strains = geometry::principal_strains(garment);
  report.strain = summary_of(garment, strains, areas, options.tight_strain);
  const std::vector<double> strain = strain_at_vertices(garment, strains, areas);
  report.tight = zones.find(strain, options.tight_strain);
  write_attribute(garment, fit_strain, strain);
}

std::vector<double> checked_areas(const Mesh& garment, const FitOptions& options, FitReport& report) {
  check(options);
  geometry::check_mesh(garment, "fit_report");
  std::vector<double> areas = face_areas(garment);
  for (Face f : garment.faces()) report.area += areas[f.idx()];
  if (!(report.area > 0)) throw geometry::ContentError("fit_report: the garment has no faces with an area");
  return areas;
}

}  // namespace

FitReport fit_report(Mesh& garment, const physics::TriangleMesh& body, const physics::ExactDistance& distance,
                     const FitOptions& options) {
  FitReport report;
  const std::vector<double> areas = checked_areas(garment, options, report);
  report.body_low = distance.low().y();
  report.body_high = distance.high().y();
  physics::throw_if_cancelled("fit_report");
  const Measured measured = measure_body(body, distance, options.sections);
  physics::throw_if_cancelled("fit_report");
  report.ease = measure_ease(garment, {measured.points, body.triangles, measured.levels}, measured.heights);

  std::vector<double> distances(garment.num_vertices(), 0);
  for (Vertex v : garment.vertices()) {
    physics::throw_if_cancelled("fit_report");
    distances[v.idx()] = distance.sample(to_eigen(garment.point(v))).value;
  }
  report.distance = summary_of(garment, distances, areas, options.contact_distance);
  const physics::Vec3 middle = (distance.low() + distance.high()) / 2;
  const ZoneFinder zones(garment, options, measured.levels, {middle.x(), middle.z()}, report);
  report.piercing = measure_piercing(garment, body, distance, distances);
  report.distance.deepest_penetration =
      std::max(report.distance.deepest_penetration, report.piercing.deepest);
  zones.place(report.piercing.zones);
  report.loose = zones.find(distances, options.loose_distance);
  measure_strain(garment, options, areas, zones, report);
  write_attribute(garment, fit_distance, distances);
  return report;
}

FitReport strain_report(Mesh& garment, const FitOptions& options) {
  FitReport report;
  report.on_body = false;
  const std::vector<double> areas = checked_areas(garment, options, report);
  physics::Vec3 low = physics::Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (Vertex v : garment.vertices()) {
    low = low.cwiseMin(to_eigen(garment.point(v)));
    high = high.cwiseMax(to_eigen(garment.point(v)));
  }
  report.body_low = low.y();
  report.body_high = high.y();
  const physics::Vec3 middle = (low + high) / 2;
  const std::vector<geometry::TorsoLevel> none;
  measure_strain(garment, options, areas, {garment, options, none, {middle.x(), middle.z()}, report}, report);
  return report;
}

}  // namespace furrow::bridge
