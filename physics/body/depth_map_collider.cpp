// SPDX-License-Identifier: MIT
#include "physics/body/depth_map_collider.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "physics/base/thread_pool.h"

namespace furrow::physics {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double wanted_reach = 0.02, least_reach = 4, most_reach = 100;  // m, texels, texels
constexpr int most_feet = 4;
constexpr double crease_cosine = 0.906;  // 25 degrees between a face and a vertex normal: the edge is sharp
constexpr double clearly_behind = 12;    // texels: no sub-texel correction changes the side

void check_range(int value, int low, int high, const char* name) {
  if (value < low || value > high)
    throw std::invalid_argument("depth maps: " + std::string(name) + " = " + std::to_string(value) +
                                " is not " + std::to_string(low) + " ... " + std::to_string(high));
}

void check(const DepthMapOptions& o) {
  check_range(o.size, 16, 4096, "size");
  check_range(o.up, 0, 2, "up");
  check_range(o.front, 0, 2, "front");
  check_range(o.threads, 1, 256, "threads");
  if (o.front == o.up)
    throw std::invalid_argument("depth maps: front = " + std::to_string(o.front) + " is up, too");
}

std::vector<DepthMap> maps_of(const DepthMapOptions& o) {
  std::vector<DepthMap> maps = {{o.front, 1}, {o.front, -1}};
  if (o.maps != DepthMaps::front_back) maps.emplace_back(o.up, 1);
  if (o.maps == DepthMaps::six) {
    maps.emplace_back(o.up, -1);
    maps.emplace_back(3 - o.up - o.front, 1);
    maps.emplace_back(3 - o.up - o.front, -1);
  }
  return maps;
}

}  // namespace

/// A point of the surface as a map shows it.
struct DepthMapCollider::Point {
  Vec3 x, n;    // n: unit vertex normal, interpolated
  double away;  // as DepthPlace
};
/// For the nearest of the points that the maps show.
struct DepthMapCollider::Search {
  Vec3 x;  // from here
  double squared = infinity;
  Vec3 found = Vec3::Zero(), normal = Vec3::Zero();

  bool take(const Point& p) {
    const double d = (x - p.x).squaredNorm();
    if (!(d < squared)) return false;
    squared = d, found = p.x, normal = p.n;
    return true;
  }
};

DepthMapCollider::DepthMapCollider(const TriangleMesh& mesh, const DepthMapOptions& options)
    : options_(options), triangles_(mesh.triangles) {
  check(options);
  check_body(mesh, "depth maps");
  vertices_.resize(mesh.vertices.size());
  normals_.resize(mesh.vertices.size());
  creases_.resize(mesh.triangles.size());
  maps_ = maps_of(options);
  rebuild(mesh.vertices);
}

void DepthMapCollider::rebuild(std::span<const Vec3> vertices) {
  if (vertices.size() != vertices_.size())
    throw std::invalid_argument("depth maps: " + std::to_string(vertices.size()) + " vertices instead of " +
                                std::to_string(vertices_.size()));
  Eigen::AlignedBox3d box;
  for (const auto& t : triangles_)
    for (const int v : t) {
      const Vec3& x = vertices[std::size_t(v)];
      if (!(x.cwiseAbs().sum() <= 1e9))  // also false for NaN
        throw std::invalid_argument("depth maps: vertex " + std::to_string(v) +
                                    " is not finite or beyond 1e9 m");
      box.extend(x);
    }
  const double longest = box.sizes().maxCoeff();
  if (!(longest > 0)) throw std::invalid_argument("depth maps: the body is a point");
  low_ = box.min(), high_ = box.max();
  raster_.texel = longest / options_.size;
  raster_.reach = int(std::clamp(std::ceil(wanted_reach / raster_.texel), least_reach, most_reach));
  const Vec3 margin = Vec3::Constant((raster_.reach + 1) * raster_.texel);
  raster_.low = low_ - margin, raster_.high = high_ + margin;
  std::copy(vertices.begin(), vertices.end(), vertices_.begin());
  find_normals();
  ThreadPool pool(std::min(options_.threads, int(maps_.size())));
  pool.run(int(maps_.size()), [&](int begin, int end) {
    for (int m = begin; m < end; ++m) maps_[std::size_t(m)].draw(vertices_, triangles_, raster_);
  });
}

/// Vertex normals by the weights that are exact on spheres (Max 1999): of a face's corner between the edges
/// a and b, a x b / (|a|^2 |b|^2).
void DepthMapCollider::find_normals() {
  std::fill(normals_.begin(), normals_.end(), Vec3::Zero());
  for (const auto& t : triangles_) {
    const auto i = std::size_t(t[0]), j = std::size_t(t[1]), k = std::size_t(t[2]);
    const Vec3 ij = vertices_[j] - vertices_[i], jk = vertices_[k] - vertices_[j],
               ki = vertices_[i] - vertices_[k], normal = ki.cross(ij);
    const double a = ij.squaredNorm(), b = jk.squaredNorm(), c = ki.squaredNorm();
    if (!(normal.squaredNorm() > 0)) continue;
    normals_[i] += normal / (a * c), normals_[j] += normal / (a * b), normals_[k] += normal / (b * c);
  }
  for (Vec3& n : normals_) n.normalize();  // leaves a zero alone
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Vec3 normal = face_normal(int(t));
    creases_[t] = 0;
    for (int k = 0; k < 3; ++k)
      if (normals_[std::size_t(triangles_[t][std::size_t(k)])].dot(normal) < crease_cosine)
        creases_[t] |= char(1 << k);
  }
}

Vec3 DepthMapCollider::face_normal(int face) const {
  const auto& t = triangles_[std::size_t(face)];
  const Vec3& a = vertices_[std::size_t(t[0])];
  return (vertices_[std::size_t(t[1])] - a).cross(vertices_[std::size_t(t[2])] - a).normalized();
}

DepthMapCollider::Point DepthMapCollider::point_of(int face, const DepthMap& map, const Vec3& x) const {
  const auto& t = triangles_[std::size_t(face)];
  const auto i = std::size_t(t[0]), j = std::size_t(t[1]), k = std::size_t(t[2]);
  const DepthPlace place = map.nearest(x, vertices_[i], vertices_[j], vertices_[k]);
  const auto& w = place.weights;
  Vec3 n = w[0] * normals_[i] + w[1] * normals_[j] + w[2] * normals_[k];
  if (const char creases = creases_[std::size_t(face)]) {
    n.setZero();
    for (std::size_t c = 0; c < 3; ++c)
      n += w[c] * (creases >> c & 1 ? face_normal(face) : normals_[std::size_t(t[c])]);
  }
  return {w[0] * vertices_[i] + w[1] * vertices_[j] + w[2] * vertices_[k], n.normalized(), place.away};
}

/// From a point on to that under the foot of x on its tangent plane, as long as that is nearer.
void DepthMapCollider::descend(const DepthMap& map, Point p, Search& search) const {
  for (int round = 0; round < most_feet && search.take(p); ++round) {
    const Vec3 foot = search.x - (search.x - p.x).dot(p.n) * p.n;
    if ((p.x - foot).squaredNorm() < raster_.texel * raster_.texel) return;
    const DepthMap::Texel& texel = map.texel_at(foot);
    const int face = texel.face != DepthMap::none ? texel.face : texel.rim;
    if (face == DepthMap::none) return;
    p = point_of(face, map, foot);
  }
}

/// From a rim that x lies beside and above, inwards by doubled steps, as long as that is nearer: the tangent
/// planes there lead to no other point.
void DepthMapCollider::climb(const DepthMap& map, const Point& rim, Search& search) const {
  const Vec3 way = rim.x - search.x, inwards = (way - way.dot(map.direction()) * map.direction()) / rim.away;
  for (double step = raster_.texel; step < -map.height(way); step *= 2) {
    const Vec3 place = rim.x + step * inwards;
    const DepthMap::Texel& texel = map.texel_at(place);
    if (texel.face == DepthMap::none) return;
    const Point p = point_of(texel.face, map, place);
    if ((search.x - p.x).squaredNorm() >= search.squared) return;
    descend(map, p, search);
  }
}

/// Whether x lies before the surface in a map, or beside it; the search goes on in this map.
bool DepthMapCollider::is_before(const DepthMap& map, const DepthMap::Texel& texel, Search& search) const {
  const Vec3& x = search.x;
  const auto is_before = [&](const Point& p) {
    return p.away > 0 ? (x - p.x).dot(p.n) > 0 : map.height(x) > map.height(p.x);
  };
  bool before = true;
  if (texel.face != DepthMap::none) {
    const Point p = point_of(texel.face, map, x);
    before = is_before(p);
    descend(map, p, search);
  }
  const double rim_away = texel.rim_away;
  if (texel.rim == DepthMap::none || rim_away * rim_away >= search.squared) return before;
  Point rim = point_of(texel.rim, map, x);
  // Under a triangle that covers less than half of the texel?
  if (texel.face == DepthMap::none && rim.away == 0) before = is_before(rim);
  const Vec3 way = x - rim.x;
  if (before && rim.away > 0 && way.dot(rim.n) <= 0) {  // beside a wall along the line of sight
    rim.n = (way - way.dot(map.direction()) * map.direction()) / rim.away;
    search.take(rim);
    return before;
  }
  descend(map, rim, search);
  if (before && rim.away > 0) climb(map, rim, search);
  return before;
}

SignedDistance DepthMapCollider::at(const Vec3& x) const {
  if (x.array().isNaN().any()) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, Vec3::Constant(nan)};
  }
  const Vec3 beyond = x - x.cwiseMax(low_).cwiseMin(high_);
  const double to_box = beyond.norm();
  if (to_box < reach()) {
    const SignedDistance here = in_maps(x);
    if (to_box == 0 || here.value >= to_box) return here;
  }
  return {to_box, beyond.normalized()};
}

/// Of a point in the raster's box.
SignedDistance DepthMapCollider::in_maps(const Vec3& x) const {
  const std::size_t count = maps_.size();
  std::array<const DepthMap::Texel*, 6> texels;
  std::array<double, 6> depth;
  double least = infinity, aside = 0;  // aside: where there is nothing in a map, the body is no nearer
  for (std::size_t m = 0; m < count; ++m) {
    texels[m] = &maps_[m].texel_at(x);
    depth[m] = texels[m]->height - maps_[m].height(x);
    least = std::min(least, depth[m]);
    if (texels[m]->face == DepthMap::none) aside = std::max(aside, double(texels[m]->rim_away));
  }
  if (aside >= reach()) return {reach(), (x - (low_ + high_) / 2).normalized()};
  const double near = std::max(least, clearly_behind * raster_.texel);
  Search search{x};
  bool outside = false;
  for (std::size_t m = 0; m < count; ++m)
    if (depth[m] <= near && is_before(maps_[m], *texels[m], search)) outside = true;
  // The maps say on which side x is, and how far, the tangent plane; where x lies on the other side of that
  // plane (near a sharp crease) the distance of the point.
  const double plane = (x - search.found).dot(search.normal), distance = std::sqrt(search.squared);
  if (!outside) return {plane < 0 ? plane : -distance, search.normal};
  return {std::clamp(plane > 0 ? plane : distance, aside, reach()), search.normal};
}

std::size_t DepthMapCollider::memory() const {
  std::size_t bytes = 2 * vertices_.size() * sizeof(Vec3) + triangles_.size() * (sizeof(triangles_[0]) + 1);
  for (const DepthMap& map : maps_) bytes += map.memory();
  return bytes;
}

}  // namespace furrow::physics
