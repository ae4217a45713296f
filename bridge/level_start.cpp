// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/level_start.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "bridge/convert.h"
#include "geometry/refine/subdivide.h"
#include "physics/base/thread_pool.h"
#include "physics/pairs/cloth_contact.h"

namespace furrow::bridge {
namespace {

using physics::Vec3;

/// How deep cloth at rest may lie inside the gap: moving it out would only strain it.
double rest_depth(double gap) { return std::min(gap / 6, 5e-4); }

}  // namespace

void disturb(physics::Cloth& cloth, const Disturbance& d) {
  std::vector<Vec3>& x = cloth.particles.x;
  std::vector<Vec3> normal(x.size(), Vec3::Zero());
  for (const auto& [a, b, c] : cloth.triangles) {
    const Vec3 n = (x[b] - x[a]).eval().cross((x[c] - x[a]).eval());
    for (const int corner : {a, b, c}) normal[std::size_t(corner)] += n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double length = normal[i].norm();
    if (cloth.particles.inv_mass[i] > 0 && length > 0)
      x[i] += d.by * d.noise(d.places[i]) / length * normal[i];
  }
}

std::vector<Vec3> lay_on_coarse(const std::vector<Vec3>& coarse, const physics::Cloth& cloth) {
  std::vector<Vec3> laid = cloth.particles.x, sum(laid.size(), Vec3::Zero());
  std::vector<double> count(sum.size(), 0);
  for (const auto& t : cloth.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      for (const int other : {t[(i + 1) % 3], t[(i + 2) % 3]}) {
        if (std::size_t(other) >= coarse.size()) continue;
        sum[std::size_t(t[i])] += coarse[std::size_t(other)];
        ++count[std::size_t(t[i])];
      }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (!(cloth.particles.inv_mass[i] > 0)) continue;
    if (i < coarse.size())
      laid[i] = coarse[i];
    else if (count[i] > 0)
      laid[i] = sum[i] / count[i];
  }
  return laid;
}

int move_guarded(physics::Cloth& cloth, const std::vector<Vec3>& to, const physics::SettleOptions& o) {
  physics::ThreadPool pool(o.threads);
  physics::ClothContact contact(cloth, {o.self.thickness, 1}, cloth.particles.x, {}, &pool);
  return contact.approach(cloth.particles.x, to, &pool);
}

void begin_level(physics::Cloth& cloth, const Carried& carried, const Disturbance& disturbance,
                 const physics::Collider* body, const DrapeOptions& o, DrapeLevel& level) {
  physics::Particles& p = cloth.particles;
  std::vector<Vec3> from = carried.coarse.empty() ? p.x : carried.coarse;
  for (std::size_t i = 0; i < carried.fine.size(); ++i)
    if (p.inv_mass[i] > 0) p.x[i] = carried.fine[i];
  if (disturbance.by > 0) disturb(cloth, disturbance);
  const double gap = o.settle.gap - (carried.fine.empty() ? 0 : rest_depth(o.settle.gap));
  if (body) level.pushed = physics::bring_out(p, *body, gap);
  if (!o.settle.self.on) return;
  p.x.swap(from);
  level.stopped = move_guarded(cloth, from, o.settle);
}

std::vector<Vec3> refine_level(const std::vector<Vec3>& found, geometry::Mesh& garment) {
  geometry::Mesh shape = garment;  // so that new vertices come in the same order
  for (const geometry::Vertex v : shape.vertices()) shape.point(v) = to_cgal(found[v.idx()]);
  geometry::loop_subdivide(shape, 1);
  geometry::loop_subdivide(garment, 1);
  return positions_of(shape);
}

physics::SettleOptions level_options(const DrapeOptions& o, bool last, bool stopped) {
  physics::SettleOptions settle = o.settle;
  if (!last) {
    settle.tolerance = std::max(settle.tolerance, o.coarse_tolerance);
    settle.contact_depth = std::numeric_limits<double>::infinity();
    settle.faces = {};
  }
  if (stopped) settle.max_iterations = 0;
  return settle;
}

}  // namespace furrow::bridge
