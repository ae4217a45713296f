// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/arrays/gather_riders.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "bridge/arrays/convert.h"
#include "geometry/figure/attached_parts.h"
#include "geometry/mesh/property_names.h"
#include "geometry/stroke/project_onto_surface.h"
#include "physics/cloth/riders.h"

namespace furrow::bridge {
namespace {

using geometry::Ride;

bool has_area(const geometry::Mesh& mesh, geometry::Face f) {
  const geometry::Halfedge h = mesh.halfedge(f);
  const geometry::Point &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h)),
                        &c = mesh.point(mesh.target(mesh.next(h)));
  return CGAL::cross_product(b - a, c - a).squared_length() > 0;
}

/// What may carry and has an area, as it was made; elements keep their numbers.
geometry::Mesh carriers_as_made(const geometry::Mesh& mesh, const geometry::Parts& parts,
                                const std::vector<Ride>& rides) {
  const std::vector<char> small = geometry::small_parts(mesh, parts);
  geometry::Mesh made = mesh;
  const std::vector<geometry::Point> places = geometry::places_as_made(mesh);
  for (const geometry::Vertex v : made.vertices()) made.point(v) = places[v.idx()];
  for (std::size_t f = 0; f < rides.size(); ++f)
    if (const geometry::Face face{geometry::Face::size_type(f)};
        rides[f] != Ride::none || small[std::size_t(parts.of_face[f])] || !has_area(made, face))
      made.remove_face(face);
  return made;
}

class RiderGatherer {
 public:
  RiderGatherer(const geometry::Mesh& mesh, const std::vector<Ride>& rides)
      : rides_(rides),
        parts_(geometry::find_parts(mesh)),
        places_(geometry::places_as_made(mesh)),
        made_(carriers_as_made(mesh, parts_, rides)),
        surface_(made_) {}

  std::vector<physics::Rider> gather() {
    for (std::size_t part = 0; part < parts_.list.size(); ++part) {
      const Ride ride = rides_[parts_.list[part].first.idx()];
      std::vector<std::size_t> vertices;
      for (std::size_t v = 0; v < parts_.of_vertex.size(); ++v)
        if (parts_.of_vertex[v] == int(part)) vertices.push_back(v);
      if (ride == Ride::rigid) add_rigid(vertices);
      if (ride != Ride::by_place) continue;
      const std::size_t first = riders_.size();
      for (const std::size_t v : vertices) add(v, surface_.closest(places_[v]));
      keep_to_one_side(std::span(riders_).subspan(first));
    }
    return std::move(riders_);
  }

 private:
  void add_rigid(const std::vector<std::size_t>& vertices) {
    geometry::Vector middle = CGAL::NULL_VECTOR;
    for (const std::size_t v : vertices)
      middle = middle + (places_[v] - CGAL::ORIGIN) / double(vertices.size());
    const geometry::SurfaceHit hit = surface_.closest(CGAL::ORIGIN + middle);
    for (const std::size_t v : vertices) add(v, hit);
  }

  /// Most of a part lies before the cloth, or behind it: so does all of it, a millimetre off at least.
  static void keep_to_one_side(std::span<physics::Rider> part) {
    constexpr double least = 0.001;  // [m]
    const auto before =
        std::count_if(part.begin(), part.end(), [](const auto& r) { return r.offset.z() > 0; });
    const double side = 2 * before >= std::ssize(part) ? 1 : -1;
    for (physics::Rider& r : part) r.offset.z() = side * std::max(side * r.offset.z(), least);
  }

  void add(std::size_t v, const geometry::SurfaceHit& hit) {
    const geometry::Halfedge h = made_.halfedge(hit.point.face);
    const std::array<geometry::Vertex, 3> corners{made_.source(h), made_.target(h),
                                                  made_.target(made_.next(h))};
    std::array<int, 3> triangle;
    std::array<physics::Vec3, 3> at;
    for (std::size_t i = 0; i < 3; ++i) {
      triangle[i] = int(corners[i]);
      at[i] = to_eigen(made_.point(corners[i]));
    }
    const auto& [a, b, c] = hit.point.barycentrics;
    const physics::Vec3 weights(a, b, c);
    riders_.push_back(physics::rider_at(to_eigen(places_[v]), int(v), triangle, at, weights));
  }

  const std::vector<Ride>& rides_;
  std::vector<physics::Rider> riders_;
  geometry::Parts parts_;
  std::vector<geometry::Point> places_;
  geometry::Mesh made_;
  geometry::SurfaceProjector surface_;
};

/// A vertex that is one with another at a seam goes with that one, which may ride itself.
void add_joined(const geometry::Mesh& mesh, std::vector<physics::Rider>& riders) {
  const auto joined = geometry::find_map(mesh, geometry::attribute::joined);
  if (!joined) return;
  std::map<int, physics::Rider> known;
  for (const physics::Rider& rider : riders) known.emplace(rider.particle, rider);
  for (const geometry::Vertex v : mesh.vertices()) {
    const geometry::Vertex with{geometry::Vertex::size_type((*joined)[v])};
    if ((*joined)[v] < 0 || !mesh.is_isolated(v) || !mesh.has_valid_index(with) || mesh.is_isolated(with))
      continue;
    if (const auto rides = known.find(int(with)); rides != known.end()) {
      riders.push_back(rides->second);
      riders.back().particle = int(v);
      continue;
    }
    for (const geometry::Halfedge h : mesh.halfedges_around_target(mesh.halfedge(with))) {
      if (mesh.is_border(h)) continue;
      riders.push_back({int(v),
                        {int(with), int(mesh.target(mesh.next(h))), int(mesh.source(h))},
                        physics::Vec3::UnitX(),
                        physics::Vec3::Zero()});
      break;
    }
  }
}

void give_mass(const physics::Rider& rider, physics::Particles& p) {
  const double mass = std::exchange(p.mass[std::size_t(rider.particle)], 0);
  p.inv_mass[std::size_t(rider.particle)] = 0;
  const physics::Vec3 shares = rider.weights.cwiseMax(0) / rider.weights.cwiseMax(0).sum();
  for (int i = 0; i < 3; ++i) {
    const auto corner = std::size_t(rider.triangle[std::size_t(i)]);
    p.mass[corner] += mass * shares[i];
    p.inv_mass[corner] = 1 / p.mass[corner];
  }
}

}  // namespace

std::vector<physics::Rider> riders_of(const geometry::Mesh& mesh) {
  const std::vector<Ride> rides = geometry::rides_of(mesh);
  const auto of_cloth = std::count(rides.begin(), rides.end(), Ride::none);
  std::vector<physics::Rider> riders;
  if (of_cloth != std::ssize(rides) && of_cloth != 0) riders = RiderGatherer(mesh, rides).gather();
  add_joined(mesh, riders);
  return riders;
}

void gather_riders(const geometry::Mesh& mesh, physics::Cloth& cloth) {
  cloth.riders = riders_of(mesh);
  for (const physics::Rider& rider : cloth.riders) give_mass(rider, cloth.particles);
  physics::place_riders(cloth);
}

void bring_riders_along(geometry::Mesh& mesh) {
  physics::Cloth places;
  places.riders = riders_of(mesh);
  places.particles.x = positions_of(mesh);
  places.particles.v.assign(places.particles.size(), physics::Vec3::Zero());
  physics::place_riders(places);
  for (const physics::Rider& rider : places.riders)
    mesh.point(geometry::Vertex(geometry::Vertex::size_type(rider.particle))) =
        to_cgal(places.particles.x[std::size_t(rider.particle)]);
}

}  // namespace furrow::bridge
