// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/drape_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather_riders.h"
#include "bridge/draping/refine_where.h"
#include "geometry/figure/attached_parts.h"
#include "geometry/fold/fold_base.h"
#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/vertex_attributes.h"
#include "geometry/refine/local_refinement.h"
#include "geometry/rest/rest_metric.h"
#include "io/base/field_words.h"
#include "io/base/figure_path.h"
#include "jobs/base/gate.h"
#include "jobs/base/measure_crossings.h"
#include "jobs/base/read_inputs.h"
#include "jobs/base/seam_ties.h"
#include "jobs/cloth/attach_parts.h"
#include "jobs/cloth/measure_shape.h"
#include "jobs/cloth/scene_cloth.h"
#include "jobs/rest/drape_garment.h"
#include "jobs/rest/loose_parts.h"
#include "physics/base/cancel_scope.h"

namespace furrow::jobs {
namespace {

/// Vertices of a garment that was measured.
std::size_t count_nearer(const geometry::Mesh& mesh, double distance) {
  std::size_t n = 0;
  for (const geometry::VertexAttribute& a : geometry::vertex_attributes(mesh))
    if (a.name == bridge::fit_distance)
      for (geometry::Vertex v : mesh.vertices()) n += a.values[v] < distance;
  return n;
}

/// Of the refined garment: its edges are half as long a level, their sag a quarter.
double refined_sag(geometry::Mesh garment, int levels) {
  geometry::ensure_rest_lengths(garment);
  return edge_sag(garment) / std::pow(4, levels);
}

physics::ContourReport untangled_of(const std::vector<bridge::DrapeLevel>& levels) {
  physics::ContourReport all;
  for (const bridge::DrapeLevel& level : levels) physics::add_later(level.untangled, all);
  return all;
}

/// What crossed before, by vertices of the garment as it is refined now; where parts were taken out of one
/// that was refined locally, that is not known.
CrossedStart crossed_before(const DrapePlan& plan, const Draped& draped) {
  CrossedStart crossed = crossed_start(plan.as_read.mesh, draped.refinements);
  if (!draped.report.local() || crossed.pairs == 0) return crossed;
  if (geometry::uniform_indices(draped.file.mesh))
    crossed.vertices = geometry::take_of_uniform(draped.file.mesh, crossed.vertices);
  else
    crossed.vertices.clear();
  return crossed;
}

double gap_with(double wanted, double sag, double tolerance) { return std::max(wanted, sag + tolerance); }

/// By how much a part that goes with its cloth place by place, and lies between it and the body, is nearer to
/// that [m]; >= 0.
double inner_depth(const geometry::Mesh& garment, const physics::Collider& body) {
  struct Depth {
    double sum = 0, most = 0;  // of its vertices [m]
  };
  const std::vector<geometry::Ride> rides = geometry::rides_of(garment);
  if (rides.empty()) return 0;
  const std::vector<physics::Rider> riders = bridge::riders_of(garment);
  const geometry::Parts parts = geometry::find_parts(garment);
  const auto at = [&](int v) {
    return bridge::to_eigen(garment.point(geometry::Vertex(geometry::Vertex::size_type(v))));
  };
  std::vector<Depth> depths(parts.list.size());
  for (const physics::Rider& r : riders) {
    physics::Vec3 under = physics::Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) under += r.weights[Eigen::Index(i)] * at(r.triangle[i]);
    const double nearer = body.at(under).value - body.at(at(r.particle)).value;
    const int part = parts.of_vertex[std::size_t(r.particle)];
    if (part < 0) continue;  // it is one with another at a seam
    Depth& depth = depths[std::size_t(part)];
    depth.sum += nearer, depth.most = std::max(depth.most, nearer);
  }
  double most = 0;
  for (const geometry::Face f : garment.faces()) {
    const Depth& depth = depths[std::size_t(parts.of_face[f.idx()])];
    if (rides[f.idx()] == geometry::Ride::by_place && depth.sum > 0) most = std::max(most, depth.most);
  }
  return most;
}

/// What lowers a gap that the edges' sag and the field's tolerance raised, and an inner side by `depth`.
std::string remedy_of_gap(const geometry::Mesh& garment, double sag, int levels, double wanted,
                          double tolerance, double depth) {
  if (sag <= tolerance)
    return fmt::format("`body.tolerance={:.2g}` asks for a finer field of the body", tolerance / 2);
  const double vertices = double(garment.number_of_vertices()) * std::pow(4, levels + 1);
  const bool drawn = geometry::find_map(garment, geometry::attribute::line).has_value();
  return std::string("its edges are long: ") +
         (drawn ? "refine it before its lines are drawn (`furrow subdivide`), or " : "") +
         "with `subdivide=" + std::to_string(levels + 1) + "` (some " +
         std::to_string(std::llround(vertices)) + " vertices) it is " +
         geometry::length_text(gap_with(wanted, sag / 4, tolerance) + depth);
}

}  // namespace

double gap_of(const io::Scene& scene, const BodyCollider* body, const geometry::Mesh& garment,
              const Context& context) {
  const double wanted = scene.simulation.contact_gap;
  if (!body) return wanted;
  const double tolerance = body->field.report().tolerance;
  const double sag = refined_sag(garment, scene.subdivide), depth = inner_depth(garment, body->exact);
  const double gap = gap_with(wanted, sag, tolerance) + depth;
  if (gap <= 1.5 * wanted) return gap;
  const bool by_side = depth > gap - depth - wanted;
  context.warn("gap_raised",
               io::stem_of(scene.garment) + ": keeps " + geometry::length_text(gap) + " from the body, not " +
                   geometry::length_text(wanted) + ", so strain and ease come out too large; " +
                   (by_side ? "its inner side lies " + geometry::length_text(depth) +
                                  " nearer to the body: take that out of the file where it is not needed"
                            : remedy_of_gap(garment, sag, scene.subdivide, wanted, tolerance, depth)),
               scene.garment.string(),
               by_side           ? "garment.mesh"
               : sag > tolerance ? "garment.subdivide"
                                 : "body.tolerance");
  return gap;
}

double gap_in_use(const io::Scene& scene, const BodyCollider* body, const DrapeSettings& s,
                  const geometry::Mesh& garment, const Context& context) {
  return s.gap.value_or(0) > 0 ? *s.gap : gap_of(scene, body, garment, context);
}

double WayToRest::share(const physics::SettleProgress& p) {
  if (p.residual <= tolerance_) return 1;
  if (!std::isfinite(p.residual)) return 0;
  first_ = std::max(first_, p.residual);
  return std::log(first_ / p.residual) / std::log(first_ / tolerance_);
}

bool is_broken(const physics::SettleReport& last) {
  return !std::isfinite(last.residual) || last.residual > 1e9 || last.residual < 0.5;
}

double thickness_of(const io::Scene& scene, const DrapeSettings& s) {
  return s.thickness.value_or(scene.thickness.value_or(physics::SelfContact{}.thickness));
}

void hold_apart(bridge::DrapeOptions& options, const DrapeSettings& s) {
  options.settle.self.on = true;
  options.settle.self.max_iterations = s.iterations.value_or(1000);
}

void measure_draped(const DrapePlan& plan, Draped& draped) {
  if (plan.options.interrupted && plan.options.interrupted()) {
    draped.report.stopped = true;
    return;
  }
  const physics::CancelScope whole([] { return false; });  // one whose budget is spent is measured, too
  draped.measured = true;
  const CrossedStart crossed = crossed_before(plan, draped);
  draped.self_contact = plan.options.settle.self.on;
  draped.limits = {std::size_t(plan.scene.allow_crossings), plan.settings.penetration,
                   plan.settings.residual};
  draped.thickness = thickness_of(plan.scene, plan.settings);
  draped.untangled = untangled_of(draped.report.levels);
  draped.cloth_friction = plan.options.settle.self.friction;
  draped.crossings = measure_crossings(draped.file, &crossed);
  draped.angle_defect = geometry::angle_defect(draped.file.mesh);
  for (const geometry::BorderLoop& loop : geometry::border_loops(draped.file.mesh))
    draped.hem_height = std::min(draped.hem_height.value_or(loop.mean_height), loop.mean_height);
  draped.lines = measure_lines(draped.file, line_heights_by_id(plan.as_read));
  if (!plan.body) {
    draped.fit = bridge::strain_report(draped.file.mesh, draped.fit_options);
    return take_facts(draped);
  }
  draped.gap = plan.options.settle.gap;
  draped.wanted_gap = plan.scene.simulation.contact_gap;
  draped.fit_options.contact_distance = contact_distance(draped.gap);
  draped.fit =
      bridge::fit_report(draped.file.mesh, plan.body->triangles, plan.body->exact, draped.fit_options);
  if (draped.gap == draped.wanted_gap)
    draped.too_near = count_nearer(draped.file.mesh, 0.9 * draped.gap - plan.body->field.report().tolerance);
  take_facts(draped);
}

void carry_and_measure(const DrapePlan& plan, std::span<const int> loose, Draped& draped) {
  carry_loose_parts(draped.file.mesh, plan.as_read.mesh, draped.refinements, loose);
  measure_draped(plan, draped);
}

void take_facts(Draped& d) {
  EndFacts& end = d.end;
  const physics::SettleReport& last = d.report.levels.back().settle;
  if (d.fit.strain) end.strain = d.fit.strain->p99;
  end.crossings = d.crossings.pairs + d.crossings_with_others;
  if (d.fit.on_body)
    end.body = {d.fit.piercing.faces, d.fit.distance.vertices_inside, d.fit.distance.deepest_penetration,
                d.gap};
  end.residual = last.residual;
  end.settled = last.converged || last.residual > d.limits.residual;
  end.blocked = last.self.blocked;
}

GivenGarment read_given(const io::Scene& scene, const BodyCollider* body, const DrapeSettings& s, bool choose,
                        const Context& context) {
  GivenGarment given{scene, {}};
  given.scene.subdivide = 0;
  given.scene.attach.on = scene.attach.on && s.loose == LooseUse::hold;
  given.file = begin_garment(given.scene, context);
  if (body && body->made_for)
    given.placed = place(given.file.mesh, *body->made_for, *body, scene.garment.string(), context);
  else if (body)
    heed(faults_of_pair(given.file.mesh, body->outline, scene.body->unit.has_value()), scene.garment.string(),
         context);
  given.scene.subdivide = scene.subdivide;
  if (s.finest && seam_ties(given.file.mesh).empty())
    given.scene.subdivide = refinements_for_edges(given.file.mesh, *s.finest);
  else if (choose && !s.plain && body)
    given.scene.subdivide =
        refinements_for_gap(given.file.mesh, scene.simulation.contact_gap, body->field.report().tolerance);
  if (s.finest && !seam_ties(given.file.mesh).empty())
    context.warn(
        "refined_everywhere",
        "`finest` does not refine a garment where three or more faces meet at an edge: it is refined "
        "everywhere, as its gap to the body needs; with `subdivide` in its place you say how often",
        "finest", "garment.subdivide");
  require_refinement(given.file.mesh->number_of_faces(), 4, given.scene.subdivide, "subdivide", context);
  if (given.scene.subdivide > 0 && own_struts(given.file.mesh) > 0)
    context.warn("struts_dropped",
                 std::string(s.finest ? "`finest`" : "`subdivide`") +
                     " drops the struts that the garment has, its bands among them; say `band` again",
                 "garment.subdivide", "bands");
  return given;
}

double soft_start_of(const io::MeshFile& garment, bool pinned) {
  constexpr double times_softer = 30;  // 10 and 100 do as well
  const auto record = io::find_wrinkle_record(garment);
  return pinned && record && record->options.find(io::flag_of("rule", "fold")) != std::string::npos
             ? times_softer
             : 1;
}

int refinements_for_gap(const geometry::Mesh& garment, double wanted, double tolerance) {
  constexpr double most_vertices = 60000, slack = 1.1;
  if (geometry::find_map(garment, geometry::attribute::rest_length) || garment.number_of_edges() == 0)
    return 0;
  int levels = 0;
  double sag = refined_sag(garment, 0), vertices = 4.0 * double(garment.number_of_vertices());
  while (levels < 4 && vertices <= most_vertices && sag > tolerance / 4 && sag + tolerance > slack * wanted) {
    ++levels;
    sag /= 4;
    vertices *= 4;
  }
  return levels;
}

int refinements_for_edges(const geometry::Mesh& garment, double finest) {
  constexpr double most_vertices = 1e6;  // of the uniform mesh, which is made to take places from
  const std::vector<double> rest = geometry::rest_lengths(garment);
  double largest = 0, vertices = double(garment.number_of_vertices());
  for (const geometry::Face f : garment.faces())
    largest = std::max(largest, bridge::size_of(garment, f, rest));
  int levels = 0;
  while (levels < 6 && largest >= 1.5 * finest && 4 * vertices <= most_vertices) {
    ++levels;
    largest /= 2;
    vertices *= 4;
  }
  return levels;
}

}  // namespace furrow::jobs
