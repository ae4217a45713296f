// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/draped.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather.h"
#include "geometry/figure/repair_body.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/masses.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/rest/stiffness.h"
#include "io/mesh/mesh_file.h"
#include "physics/body/collider.h"
#include "physics/body/distance_field.h"
#include "physics/body/triangle_bvh.h"
#include "physics/cloth/pins.h"

namespace furrow::cases {
namespace {

using geometry::Mesh;
using physics::Vec3;

void rotate(Mesh& mesh, const physics::Mat3& rotation) {
  for (geometry::Vertex v : mesh.vertices()) {
    mesh.point(v) = bridge::to_cgal(rotation * bridge::to_eigen(mesh.point(v)));
  }
}

/// Vertex i becomes vertex place[i]; the faces come in another order, too.
Mesh permuted(const Mesh& mesh, const std::vector<int>& place, std::uint64_t seed) {
  std::vector<geometry::Point> points(place.size());
  for (geometry::Vertex v : mesh.vertices()) points[std::size_t(place[v.idx()])] = mesh.point(v);
  Mesh result;
  for (const geometry::Point& p : points) result.add_vertex(p);
  const auto triangles = bridge::triangles_of(mesh);
  for (const int t : shuffled(int(triangles.size()), seed)) {
    const auto at = [&](int corner) {
      return geometry::Vertex(std::uint32_t(place[std::size_t(triangles[std::size_t(t)][corner])]));
    };
    result.add_face(at(0), at(1), at(2));
  }
  return result;
}

Mesh through_file(const Mesh& mesh) {
  std::stringstream text;
  io::MeshFile file;
  file.mesh = mesh;
  io::write_mesh(text, io::MeshFormat::obj, file, {.metres_per_unit = 1e-3});
  return io::read_mesh(text, io::MeshFormat::obj, "drape", {.metres_per_unit = 1e-3}).mesh;
}

physics::Cloth cloth_of(const Drape& drape) {
  Mesh mesh = drape.garment;
  geometry::ensure_rest_lengths(mesh);
  geometry::ensure_bending_springs(mesh);
  geometry::ensure_rest_angles(mesh);
  geometry::lump_masses(mesh, drape.density);
  bridge::GatherOptions o = drape.springs;
  o.mean_structural_length = geometry::mean_rest_length(mesh);
  o.mean_bending_length = geometry::mean_bending_rest_length(mesh);
  return bridge::gather(mesh, o);
}

}  // namespace

Drape rotated(Drape drape, const physics::Mat3& rotation) {
  rotate(drape.garment, rotation);
  rotate(drape.body, rotation);
  drape.options.gravity = rotation * drape.options.gravity;
  drape.rotation = rotation * drape.rotation;
  return drape;
}

Drape permuted(Drape drape, std::uint64_t seed) {
  const std::vector<int> place = shuffled(int(drape.garment.number_of_vertices()), seed);
  drape.garment = permuted(drape.garment, place, seed);
  drape.body = permuted(drape.body, shuffled(int(drape.body.number_of_vertices()), seed), seed);
  for (int& v : drape.held) v = place[std::size_t(v)];
  if (drape.place.empty()) {
    drape.place = place;
  } else {
    for (int& i : drape.place) i = place[std::size_t(i)];
  }
  return drape;
}

Drape through_millimetres(Drape drape) {
  drape.garment = through_file(drape.garment);
  drape.body = through_file(drape.body);
  return drape;
}

DrapedCase draped(const Drape& drape) {
  const physics::ExactDistance exact(bridge::to_triangle_mesh(geometry::repair_body(drape.body)));
  const auto field = std::make_shared<physics::DistanceField>(physics::DistanceField::build(exact));
  RestCase rest;
  rest.cloth = cloth_of(drape);
  rest.options = drape.options;
  rest.body = field.get();
  physics::Particles& p = rest.cloth.particles;
  Vec3 centre = Vec3::Zero();
  for (const Vec3& x : p.x) centre += x / double(p.size());
  for (const Vec3& x : p.x) rest.size = std::max(rest.size, 2 * (x - centre).norm());
  pin(p, drape.held);
  push_out(p.x, drape.held, exact);
  rest.still = 1e-5;
  rest.rotation = drape.rotation;
  rest.place = drape.place;
  return {field, rest};
}

std::vector<double> surface_distances(const Mesh& mesh, const std::vector<Vec3>& x,
                                      const std::vector<Vec3>& y) {
  const auto triangles = bridge::triangles_of(mesh);
  std::vector<double> distances;
  for (const auto& [from, to] : {std::pair{&x, &y}, {&y, &x}}) {
    const physics::TriangleBvh surface({*to, triangles});
    for (const Vec3& p : *from) distances.push_back(std::sqrt(surface.closest(p).squared_distance));
  }
  std::sort(distances.begin(), distances.end());
  return distances;
}

double median_surface_distance(const Mesh& mesh, const std::vector<Vec3>& x, const std::vector<Vec3>& y) {
  const std::vector<double> distances = surface_distances(mesh, x, y);
  return distances[distances.size() / 2];
}

}  // namespace furrow::cases
