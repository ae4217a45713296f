// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/level_start.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "bridge/arrays/convert.h"
#include "geometry/refine/subdivide.h"
#include "physics/base/cancel_scope.h"
#include "physics/base/thread_pool.h"
#include "physics/pairs/cloth_contact.h"
#include "physics/pairs/untangle_contours.h"

namespace furrow::bridge {
namespace {

using physics::Vec3;

/// How deep cloth at rest may lie inside the gap: moving it out would only strain it.
double rest_depth(double gap) { return std::min(gap / 6, 5e-4); }

/// Positions that a cloth leaves on ways which pass through no cloth.
class GuardedStart {
 public:
  GuardedStart(const physics::Cloth& cloth, std::vector<Vec3> at, const DrapeOptions& o)
      : cloth_(cloth),
        x_(std::move(at)),
        thickness_(o.settle.self.thickness),
        cancels_(cancels_way_up(o)),
        pool_(o.settle.threads) {
    look();
  }

  /// Where the cloth crosses itself, it is taken apart; `to` goes with it. Adds to what is told. A spent
  /// budget ends it, too.
  void take_apart(std::vector<Vec3>& to, physics::ContourReport& told) {
    if (contact_->crossed_at_start() == 0) return;
    const std::vector<Vec3> before = x_;
    const physics::ContourReport found =
        physics::untangle_contours(x_, physics::pair_mesh(cloth_, thickness_));
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += x_[i] - before[i];
    look();
    physics::add_later(found, told);
  }

  /// `to` becomes what can be reached of it. Returns how many vertices do not arrive.
  int go_to(std::vector<Vec3>& to) {
    const physics::CancelScope way_up(cancels_);
    const int stopped = contact_->approach(x_, to, &pool_);
    to = x_;
    return stopped;
  }

 private:
  void look() {
    const physics::CancelScope way_up(cancels_);
    physics::throw_if_cancelled("drape");
    contact_.emplace(cloth_, physics::ClothContactOptions{thickness_, 1}, x_, std::span<const Vec3>{},
                     &pool_);
  }

  const physics::Cloth& cloth_;
  std::vector<Vec3> x_;
  double thickness_;
  std::function<bool()> cancels_;
  physics::ThreadPool pool_;
  std::optional<physics::ClothContact> contact_;
};

}  // namespace

void disturb(physics::Cloth& cloth, const Disturbance& d) {
  std::vector<Vec3>& x = cloth.particles.x;
  const std::vector<Vec3> normal = physics::vertex_normals(cloth.triangles, x);
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

void begin_level(physics::Cloth& cloth, const Carried& carried, const Disturbance& disturbance,
                 const physics::Collider* body, const DrapeOptions& o, DrapeLevel& level) {
  physics::Particles& p = cloth.particles;
  std::vector<Vec3> start = carried.coarse.empty() ? p.x : carried.coarse;
  for (std::size_t i = 0; i < carried.fine.size(); ++i)
    if (p.inv_mass[i] > 0) p.x[i] = carried.fine[i];
  if (disturbance.by > 0) disturb(cloth, disturbance);
  std::optional<GuardedStart> guarded;
  if (o.settle.self.on) guarded.emplace(cloth, start, o);
  if (guarded) guarded->take_apart(p.x, level.untangled);
  const double gap = o.settle.gap - (carried.fine.empty() ? 0 : rest_depth(o.settle.gap));
  if (body) level.pushed = physics::bring_out(p, *body, gap);
  if (!guarded) return;
  level.stopped = guarded->go_to(p.x);
  if (level.untangled.left > 0) guarded->take_apart(p.x, level.untangled);  // the push gave it other places
}

std::function<bool()> cancels_way_up(const DrapeOptions& o) {
  if (o.interrupted) return o.interrupted;
  return [] { return false; };
}

std::vector<Vec3> refine_level(const std::vector<Vec3>& found, geometry::Mesh& garment,
                               const DrapeOptions& o) {
  const physics::CancelScope way_up(cancels_way_up(o));
  geometry::Mesh shape = garment;  // so that new vertices come in the same order
  for (const geometry::Vertex v : shape.vertices()) shape.point(v) = to_cgal(found[v.idx()]);
  geometry::loop_subdivide(shape, 1);
  geometry::loop_subdivide(garment, 1);
  return positions_of(shape);
}

physics::SettleReport settle_level(physics::Cloth& cloth, const physics::Collider* body,
                                   const physics::SettleOptions& settle, const DrapeOptions& o,
                                   const physics::SettleObserver& observer) {
  const physics::SettleReport found = physics::settle(cloth, body, settle, observer);
  if (!found.stopped || std::isfinite(found.residual)) return found;
  const physics::CancelScope way_up(cancels_way_up(o));
  physics::throw_if_cancelled("drape");
  physics::SettleOptions none = settle;
  none.max_iterations = none.self.max_iterations = 0;
  physics::SettleReport report = physics::settle(cloth, body, none);
  if (!std::isfinite(report.residual)) physics::throw_if_cancelled("drape");
  report.stopped = true;
  return report;
}

physics::SettleOptions level_options(const DrapeOptions& o, bool last, bool stopped) {
  physics::SettleOptions settle = o.settle;
  if (!last) {
    settle.tolerance = std::max(settle.tolerance, o.coarse_tolerance);
    settle.contact_depth = std::numeric_limits<double>::infinity();
    settle.faces = {};
  }
  if (stopped) settle.max_iterations = settle.self.max_iterations = 0;
  return settle;
}

}  // namespace furrow::bridge
