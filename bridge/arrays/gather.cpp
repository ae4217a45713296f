// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/arrays/gather.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather_particles.h"
#include "bridge/arrays/gather_riders.h"
#include "bridge/arrays/tension_constants.h"
#include "geometry/figure/attached_parts.h"
#include "geometry/fold/line_press.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/rest/stiffness.h"
#include "geometry/rest/warp_directions.h"
#include "physics/cloth/membrane.h"

namespace furrow::bridge {
namespace {

using namespace geometry;

void check(const Mesh& mesh, const GatherOptions& o) {
  const auto fail = [](const std::string& what) { throw std::invalid_argument("gather: " + what); };
  const auto range = [&](const char* name, double value, bool fine) {
    if (!fine || !std::isfinite(value))
      fail(std::string(name) + " = " + std::to_string(value) + " is out of its range");
  };
  range("structural_stiffness", o.structural_stiffness, o.structural_stiffness > 0);
  range("bending_stiffness", o.bending_stiffness, o.bending_stiffness >= 0);
  range("mean_structural_length", o.mean_structural_length, o.mean_structural_length > 0);
  range("mean_bending_length", o.mean_bending_length, o.mean_bending_length >= 0);
  range("stretch", o.stretch, o.stretch > 0);
  range("poisson", o.poisson, o.poisson > -1 && o.poisson < 1);
  range("rigidity", o.rigidity, o.rigidity >= 0);
  range("tension", o.tension, o.tension > 0);
  range("compression", o.compression, o.compression >= 0 && o.compression <= 1);
  range("shear", o.shear, o.shear >= 0 && o.shear <= 1);
  check_mesh(mesh, "gather");
  if (!find_map(mesh, attribute::rest_length))
    fail(std::string("the mesh has no map ") + attribute::rest_length.name);
}

double require_length(double rest, Vertex a, Vertex b) {
  if (!(rest > 0) || !std::isfinite(rest))
    throw ContentError("the spring between vertices " + std::to_string(a.idx()) + " and " +
                       std::to_string(b.idx()) + " has rest length " + std::to_string(rest) +
                       "; remove the edge (`furrow info` counts degenerate faces)");
  return rest;
}

physics::Spring spring(Vertex a, Vertex b, double rest, double stiffness) {
  const int i = static_cast<int>(a), j = static_cast<int>(b);
  return {std::min(i, j), std::max(i, j), require_length(rest, a, b), stiffness};
}

/// The value of a map where it is set, else `by_law()`.
template <class Law>
double stiffness_or(const std::optional<EdgeMap<double>>& map, const Mesh& mesh, Edge e, Law by_law) {
  if (!map || std::isnan((*map)[e])) return by_law();
  const double own = (*map)[e];
  if (!(own >= 0) || !std::isfinite(own))
    throw ContentError("edge " + std::to_string(mesh.vertex(e, 0).idx()) + "-" +
                       std::to_string(mesh.vertex(e, 1).idx()) + " has the stiffness " + std::to_string(own) +
                       "; it must be >= 0 and finite, or unset (nan)");
  return own;
}

/// Sorts elements, and their origin with them, by their vertices.
template <class Element, class Vertices>
void sort_by(Vertices vertices, std::vector<Element>& elements, std::vector<Edge>& origin) {
  std::vector<std::pair<Element, Edge>> both;
  for (std::size_t i = 0; i < elements.size(); ++i) both.emplace_back(elements[i], origin[i]);
  std::stable_sort(both.begin(), both.end(),
                   [&](const auto& s, const auto& t) { return vertices(s.first) < vertices(t.first); });
  for (std::size_t i = 0; i < both.size(); ++i) std::tie(elements[i], origin[i]) = both[i];
}

template <class Element>
std::pair<int, int> ends(const Element& e) {
  return {e.a, e.b};
}

/// The cloth under construction.
class Gatherer {
 public:
  Gatherer(const Mesh& mesh, const GatherOptions& options)
      : mesh_(mesh),
        o_(options),
        rest_(*find_map(mesh, attribute::rest_length)),
        rest_of_(rest_lengths(mesh)),
        rides_(rides_of(mesh)) {}

  GatheredCloth gather() {
    cloth_.particles = gather_particles(mesh_, o_.mass_rule);
    cloth_.triangles = of_cloth(mesh_, triangles_of(mesh_));
    for (Edge e : mesh_.edges()) require_length(rest_[e], mesh_.vertex(e, 0), mesh_.vertex(e, 1));
    if (!visit_triangles(o_.membrane, cloth_, [&](auto& elements) { add_triangles(elements); }))
      o_.membrane == Membrane::tension ? add_tension() : add_structural_springs();
    o_.bending == Bending::cross ? add_bending_springs() : add_hinges();
    add_struts();
    gather_riders(mesh_, cloth_);
    return std::move(result_);
  }

 private:
  bool is_cloth(Face f) const { return rides_.empty() || rides_[f.idx()] == Ride::none; }
  bool is_cloth(Edge e) const {
    const Halfedge h = mesh_.halfedge(e);
    return is_cloth(mesh_.face(mesh_.is_border(h) ? mesh_.opposite(h) : h));
  }

  double rest_area(Face f) const {
    const auto [a, b, c] = edge_lengths(mesh_, f, rest_of_);
    return triangle_area(a, b, c);
  }
  /// Of the faces beside an edge.
  double areas_beside(Edge e) const {
    double sum = 0;
    for (Halfedge h : {mesh_.halfedge(e), mesh_.opposite(mesh_.halfedge(e))})
      if (!mesh_.is_border(h)) sum += rest_area(mesh_.face(h));
    return sum;
  }

  double stiffness_of(Edge e) const {
    const auto by = [&](StiffnessLaw law) {
      return spring_stiffness(rest_[e], o_.mean_structural_length, o_.structural_stiffness, law);
    };
    switch (o_.membrane) {
      case Membrane::uniform:
        return by(StiffnessLaw::constant);
      case Membrane::inverse:
        return by(StiffnessLaw::inverse);
      case Membrane::van_gelder:
        return o_.stretch * areas_beside(e) / (rest_[e] * rest_[e]);
      default:
        return by(StiffnessLaw::proportional);
    }
  }

  void add_structural_springs() {
    const auto own = find_map(mesh_, attribute::stiffness);
    for (Edge e : mesh_.edges()) {
      if (!is_cloth(e)) continue;
      const double k = stiffness_or(own, mesh_, e, [&] { return stiffness_of(e); });
      cloth_.structural.push_back(spring(mesh_.vertex(e, 0), mesh_.vertex(e, 1), rest_[e], k));
      result_.structural.push_back(e);
    }
    sort_by(ends<physics::Spring>, cloth_.structural, result_.structural);
  }

  void add_tension() {
    const auto own = find_map(mesh_, attribute::tension);
    const std::vector<double> by_law = tension_constants(mesh_, o_.tension, o_.shear);
    for (Edge e : mesh_.edges()) {
      if (!is_cloth(e)) continue;
      const double c = stiffness_or(own, mesh_, e, [&] { return by_law[e.idx()]; });
      const auto [a, b] =
          std::minmax({static_cast<int>(mesh_.vertex(e, 0)), static_cast<int>(mesh_.vertex(e, 1))});
      cloth_.tension.push_back({a, b, rest_[e], c, o_.compression * c});
      result_.tension.push_back(e);
    }
    sort_by(ends<physics::Tension>, cloth_.tension, result_.tension);
  }

  /// The half-edge to the lowest corner, so that a mesh that was saved gives the same bits.
  Halfedge first_of(Face f) const {
    Halfedge first = mesh_.halfedge(f);
    for (Halfedge h : mesh_.halfedges_around_face(first))
      if (mesh_.target(h) < mesh_.target(first)) first = h;
    return first;
  }

  template <class Triangle>
  void add_triangles(std::vector<Triangle>& elements) {
    physics::WovenSheet sheet{physics::plane_stress(o_.stretch, o_.poisson), 0, 0};
    if (const auto& w = o_.weave) sheet = physics::woven_sheet({w->warp, w->weft, w->shear, w->poisson});
    const auto own = find_map(mesh_, attribute::triangle_rest_length);
    for (Face f : mesh_.faces()) {
      if (!is_cloth(f)) continue;
      Triangle t;
      t.lambda = sheet.lame.lambda, t.mu = sheet.lame.mu;
      if (o_.weave)  // corner 0 is the target of first_of(f)
        t.threads = {known_warp_angle(mesh_, mesh_.next(first_of(f)), rest_of_), sheet.warp, sheet.weft};
      int i = 0;
      for (Halfedge h : mesh_.halfedges_around_face(first_of(f))) {
        const Halfedge opposite = mesh_.prev(h);  // joins the other two corners
        const double rest =
            own && !std::isnan((*own)[opposite]) ? (*own)[opposite] : rest_[mesh_.edge(opposite)];
        t.vertices[i] = static_cast<int>(mesh_.target(h));
        t.rest_lengths[i++] = require_length(rest, mesh_.source(opposite), mesh_.target(opposite));
      }
      if (!(triangle_area(t.rest_lengths[0], t.rest_lengths[1], t.rest_lengths[2]) > 0))
        throw ContentError("face " + std::to_string(f.idx()) +
                           " has no area at rest; remove it, or choose a law of springs");
      elements.push_back(t);
      result_.membrane.push_back(first_of(f));
    }
  }

  void add_bending_springs() {
    const auto own = find_map(mesh_, attribute::bending_stiffness);
    for (const BendingSpring& b : bending_springs(mesh_)) {
      if (!is_cloth(b.across)) continue;
      const double k = stiffness_or(own, mesh_, b.across, [&] {
        return b.count * spring_stiffness(b.rest_length, o_.mean_bending_length, o_.bending_stiffness);
      });
      cloth_.bending.push_back(spring(b.a, b.b, b.rest_length, k));
      result_.bending.push_back(b.across);
    }
  }

  void add_struts() {
    if (is_chain(mesh_)) return add_links();
    for (const Strut& s : struts(mesh_)) {
      cloth_.bending.push_back(spring(s.a, s.b, s.rest_length, s.stiffness));
      result_.bending.push_back(Mesh::null_edge());
    }
    sort_by(ends<physics::Spring>, cloth_.bending, result_.bending);  // of one pair the strut comes last
  }

  /// What a chain is made of resists stretching, so that its strain is that of structural springs.
  void add_links() {
    for (const Strut& s : struts(mesh_)) {
      cloth_.structural.push_back(spring(s.a, s.b, s.rest_length, s.stiffness));
      result_.structural.push_back(Mesh::null_edge());
    }
  }

  void add_hinges() {
    const auto angle = find_map(mesh_, attribute::rest_angle),
               own = find_map(mesh_, attribute::hinge_stiffness);
    const std::vector<double> presses = hinge_presses(mesh_, o_.line_presses, o_.line_widths);
    cloth_.hinge_law = o_.bending == Bending::cosine ? physics::HingeLaw::cosine : physics::HingeLaw::linear;
    for (Edge e : mesh_.edges()) {
      if (mesh_.is_border(e) || !is_cloth(e)) continue;
      const double areas = areas_beside(e);
      if (!(areas > 0) && !(own && !std::isnan((*own)[e]))) continue;
      Halfedge h = mesh_.halfedge(e);  // from the lower end: a mesh that was saved gives the same bits
      if (mesh_.target(h) < mesh_.source(h)) h = mesh_.opposite(h);
      const auto index = [](Vertex v) { return static_cast<int>(v); };
      const double rest = angle && !std::isnan((*angle)[e]) ? (*angle)[e] : 0;
      const double press = presses.empty() ? 1 : presses[e.idx()], b = o_.rigidity * press;
      const double k = stiffness_or(own, mesh_, e, [&] { return b * rest_[e] * rest_[e] / areas; });
      cloth_.hinges.push_back(
          {{index(mesh_.source(h)), index(mesh_.target(h)), index(mesh_.target(mesh_.next(h))),
            index(mesh_.target(mesh_.next(mesh_.opposite(h))))},
           rest,
           k});
      result_.hinges.push_back(e);
    }
    sort_by([](const physics::Hinge& h) { return h.vertices; }, cloth_.hinges, result_.hinges);
  }

  const Mesh& mesh_;
  const GatherOptions& o_;
  EdgeMap<double> rest_;
  std::vector<double> rest_of_;
  std::vector<Ride> rides_;
  GatheredCloth result_;
  physics::Cloth& cloth_ = result_.cloth;
};

}  // namespace

GatheredCloth gather_with_origin(const Mesh& mesh, const GatherOptions& options) {
  check(mesh, options);
  return Gatherer(mesh, options).gather();
}

physics::Cloth gather(const Mesh& mesh, const GatherOptions& options) {
  return gather_with_origin(mesh, options).cloth;
}

double spring_constant_of(double stretch) { return std::sqrt(3.0) / 2 * stretch; }

}  // namespace furrow::bridge
