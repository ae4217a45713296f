// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/gather.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "bridge/convert.h"
#include "geometry/bending_springs.h"
#include "geometry/edge_metric.h"
#include "geometry/errors.h"
#include "geometry/property_names.h"
#include "geometry/rest_metric.h"
#include "geometry/stiffness.h"
#include "physics/membrane.h"

namespace furrow::bridge {
namespace {

using namespace geometry;

void check(const Mesh& mesh, const GatherOptions& o) {
  const auto fail = [](const std::string& what) { throw std::invalid_argument("gather: " + what); };
  const auto range = [&](const char* name, double value, bool fine) {
    if (!fine) fail(std::string(name) + " = " + std::to_string(value) + " is out of its range");
  };
  range("structural_stiffness", o.structural_stiffness, o.structural_stiffness > 0);
  range("bending_stiffness", o.bending_stiffness, o.bending_stiffness >= 0);
  range("mean_structural_length", o.mean_structural_length, o.mean_structural_length > 0);
  range("mean_bending_length", o.mean_bending_length, o.mean_bending_length >= 0);
  range("stretch", o.stretch, o.stretch > 0 && std::isfinite(o.stretch));
  range("poisson", o.poisson, o.poisson > -1 && o.poisson < 1);
  range("rigidity", o.rigidity, o.rigidity >= 0 && std::isfinite(o.rigidity));
  if (mesh.has_garbage()) fail("the mesh has removed elements");
  if (!find_map(mesh, kMass)) fail(std::string("the mesh has no map ") + kMass.name);
  if (!find_map(mesh, kRestLength)) fail(std::string("the mesh has no map ") + kRestLength.name);
}

double require_length(double rest, Vertex a, Vertex b) {
  if (!(rest > 0) || !std::isfinite(rest))
    throw ContentError("the spring between vertices " + std::to_string(a.idx()) + " and " +
                       std::to_string(b.idx()) + " has rest length " + std::to_string(rest) +
                       "; remove the edge (furrow info counts degenerate faces)");
  return rest;
}

physics::Spring spring(Vertex a, Vertex b, double rest, double stiffness) {
  const int i = static_cast<int>(a), j = static_cast<int>(b);
  return {std::min(i, j), std::max(i, j), require_length(rest, a, b), stiffness};
}

void sort_by_pair(std::vector<physics::Spring>& springs) {
  std::sort(springs.begin(), springs.end(), [](const physics::Spring& s, const physics::Spring& t) {
    return s.a != t.a ? s.a < t.a : s.b < t.b;
  });
}

physics::Particles particles_of(const Mesh& mesh) {
  const auto mass = *find_map(mesh, kMass);
  const auto velocity = find_map(mesh, kVelocity);
  physics::Particles p;
  for (Vertex v : mesh.vertices()) {
    const double m = mesh.is_isolated(v) ? 0 : mass[v];
    if (!(m >= 0) || (m == 0 && !mesh.is_isolated(v)))
      throw ContentError("vertex " + std::to_string(v) + " has mass " + std::to_string(m) +
                         "; remove its faces (furrow info counts degenerate ones)");
    p.x.push_back(to_eigen(mesh.point(v)));
    p.v.push_back(velocity ? to_eigen(CGAL::ORIGIN + (*velocity)[v]) : physics::Vec3::Zero());
    p.mass.push_back(m);
    p.inv_mass.push_back(m > 0 ? 1 / m : 0);
  }
  return p;
}

/// The cloth under construction.
class Gatherer {
 public:
  Gatherer(const Mesh& mesh, const GatherOptions& options)
      : mesh_(mesh), o_(options), rest_(*find_map(mesh, kRestLength)), rest_of_(rest_lengths(mesh)) {}

  physics::Cloth gather() {
    cloth_.particles = particles_of(mesh_);
    cloth_.triangles = triangles_of(mesh_);
    for (Edge e : mesh_.edges()) require_length(rest_[e], mesh_.vertex(e, 0), mesh_.vertex(e, 1));
    if (o_.membrane == Membrane::triangles)
      add_triangles();
    else
      add_structural_springs();
    if (o_.bending == Bending::cross)
      add_bending_springs();
    else
      add_hinges();
    return std::move(cloth_);
  }

 private:
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
    for (Edge e : mesh_.edges())
      cloth_.structural.push_back(spring(mesh_.vertex(e, 0), mesh_.vertex(e, 1), rest_[e], stiffness_of(e)));
    sort_by_pair(cloth_.structural);
  }

  void add_triangles() {
    const physics::PlaneLame lame = physics::plane_stress(o_.stretch, o_.poisson);
    for (Face f : mesh_.faces()) {
      physics::MembraneTriangle t{{}, {}, lame.lambda, lame.mu};
      int i = 0;
      Halfedge first =
          mesh_.halfedge(f);  // to the lowest corner, so that a mesh that was saved gives the same bits
      for (Halfedge h : mesh_.halfedges_around_face(mesh_.halfedge(f)))
        if (mesh_.target(h) < mesh_.target(first)) first = h;
      for (Halfedge h : mesh_.halfedges_around_face(first)) {
        t.vertices[i] = static_cast<int>(mesh_.target(h));
        t.rest_lengths[i] = rest_[mesh_.edge(mesh_.prev(h))];  // joins the other two corners
        ++i;
      }
      if (!(rest_area(f) > 0))
        throw ContentError("face " + std::to_string(f.idx()) +
                           " has no area at rest; remove it, or choose a law of springs");
      cloth_.membrane.push_back(t);
    }
  }

  void add_bending_springs() {
    for (const BendingSpring& b : bending_springs(mesh_))
      cloth_.bending.push_back(
          spring(b.a, b.b, b.rest_length,
                 b.count * spring_stiffness(b.rest_length, o_.mean_bending_length, o_.bending_stiffness)));
    sort_by_pair(cloth_.bending);
  }

  void add_hinges() {
    const auto angle = find_map(mesh_, kRestAngle);
    cloth_.hinge_law = o_.bending == Bending::hinge ? physics::HingeLaw::linear : physics::HingeLaw::cosine;
    for (Edge e : mesh_.edges()) {
      if (mesh_.is_border(e)) continue;
      const double areas = areas_beside(e);
      if (!(areas > 0)) continue;
      Halfedge h =
          mesh_.halfedge(e);  // from the lower end, so that a mesh that was saved gives the same bits
      if (mesh_.target(h) < mesh_.source(h)) h = mesh_.opposite(h);
      const auto index = [](Vertex v) { return static_cast<int>(v); };
      const double rest = angle && !std::isnan((*angle)[e]) ? (*angle)[e] : 0;
      cloth_.hinges.push_back(
          {{index(mesh_.source(h)), index(mesh_.target(h)), index(mesh_.target(mesh_.next(h))),
            index(mesh_.target(mesh_.next(mesh_.opposite(h))))},
           rest,
           o_.rigidity * rest_[e] * rest_[e] / areas});
    }
    std::sort(cloth_.hinges.begin(), cloth_.hinges.end(),
              [](const physics::Hinge& s, const physics::Hinge& t) { return s.vertices < t.vertices; });
  }

  const Mesh& mesh_;
  const GatherOptions& o_;
  EdgeMap<double> rest_;
  std::vector<double> rest_of_;
  physics::Cloth cloth_;
};

}  // namespace

physics::Cloth gather(const Mesh& mesh, const GatherOptions& options) {
  check(mesh, options);
  return Gatherer(mesh, options).gather();
}

double spring_constant_of(double stretch) { return std::sqrt(3.0) / 2 * stretch; }

}  // namespace furrow::bridge
