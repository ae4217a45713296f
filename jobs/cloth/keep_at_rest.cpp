// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/keep_at_rest.h"

#include <fmt/format.h>

#include <algorithm>

#include "bridge/arrays/gather.h"
#include "bridge/arrays/store_rest_state.h"
#include "bridge/keeping/keep.h"
#include "geometry/fold/gather_lines.h"
#include "io/base/figure_path.h"
#include "jobs/cloth/prepare_garment.h"
#include "jobs/cloth/scene_cloth.h"
#include "physics/cloth/pins.h"

namespace furrow::jobs {
namespace {

constexpr double out_of_balance = 1e-6;
constexpr double largest_turn = 0.2;  // [rad]

void warn_of(const bridge::KeptShape& shape, bool moving, const Context& context) {
  const char* hint = "`furrow keep` finds out which lines hold and helps them";
  const bool swings = !shape.rest.imbalance.empty();
  if (shape.rest.residual > out_of_balance && !(moving && swings))
    context.warn(swings ? "shape_unbalanced" : "shape_out_of_bounds",
                 std::string(swings ? "nothing holds the garment in balance as it lies (" +
                                          words(shape.rest.imbalance.front()) + "), it will swing or fall; "
                                    : "the bounds on strain and angle leave no balance of the shape; ") +
                     hint,
                 "", "`furrow keep`");
  else if (!shape.certificate.stable())
    context.warn("shape_unstable",
                 std::string("the shape is balanced, but not stable: it will give way; ") + hint, "",
                 "`furrow keep`");
}

}  // namespace

std::string words(const physics::RigidImbalance& i) {
  const std::string who = fmt::format("{} vertices are free to ", i.piece.size());
  const auto text = [](const physics::Vec3& v) {
    return fmt::format("({:.2f}, {:.2f}, {:.2f})", v.x(), v.y(), v.z());
  };
  if (i.freedoms == 1)
    return who + fmt::format("turn about the line of their pins through {} m along {}, at {:.2g} rad/s^2",
                             text(i.point), text(i.axis), i.angular_acceleration.norm());
  if (i.freedoms == 3)
    return who + fmt::format("turn about their pin at {} m, about the axis {}, at {:.2g} rad/s^2",
                             text(i.point), text(i.axis), i.angular_acceleration.norm());
  const double pull = i.acceleration.norm();
  return who +
         fmt::format(
             "move, as no pin holds them: {:.2g} m/s^2 along {}, and turning about {} at {:.2g} rad/s^2",
             pull, text(pull > 0 ? physics::Vec3(i.acceleration / pull) : i.acceleration), text(i.axis),
             i.angular_acceleration.norm());
}

void warn_if_shape_only(const std::filesystem::path& mesh, const Context& context) {
  if (!mesh.empty() && io::ending_of(mesh) != ".ply")
    context.warn("shape_only",
                 mesh.string() + ": holds the shape alone; the rest state that keeps it goes into a .ply",
                 mesh.string());
}

bool keeps_first_shape(const io::Scene& scene) {
  return scene.keep || std::any_of(scene.lines.begin(), scene.lines.end(),
                                   [](const io::SceneLines& lines) { return lines.time == 0 && lines.keep; });
}

bridge::KeptShape keep_at_rest(io::MeshFile& file, const io::Scene& scene,
                               const std::vector<std::vector<int>>& pins, const WorldBody* body, double time,
                               double settled_gap, physics::SimulateState* moving, const Context& context) {
  complete_garment(file, scene.material);
  const auto record = io::find_wrinkle_record(file);
  const std::vector<geometry::Strut> threads =  // what they gather is not the shape as it lies
      geometry::cut_undrawn_threads(file.mesh, record ? io::gathered_lines(*record) : std::vector<int>{});
  physics::PrestressOptions options;
  options.gravity = scene.simulation.gravity;
  options.friction = scene.simulation.friction;
  options.gap = scene.simulation.contact_gap;
  if (body) options.gap = std::max(settled_gap, contact_gap(options.gap, body->tolerance(), file));
  const bridge::GatherOptions springs = spring_options(file, scene.material);
  SilentListener silent(context.listener);            // the run itself warns of pins
  const WorldBody* put_on = moving ? nullptr : body;  // in motion, pins were put on it before
  physics::Cloth cloth = cloth_of(file, scene, pins, put_on, time, {context.frame, silent});
  const bridge::KeptShape shape =
      bridge::keep_shape(cloth, world_of(scene, body, pins), options, moving ? 0 : largest_turn);
  if (shape.turned > 0 || shape.pushed.moved > 0) bridge::scatter(cloth.particles, file.mesh);
  physics::soften_clamps(cloth);
  bridge::store_rest_state(cloth, springs, file.mesh);
  geometry::sew(file.mesh, threads);
  if (moving) {
    moving->compensation.force.clear();
    moving->planned = false;
  }
  warn_of(shape, moving, context);
  return shape;
}

}  // namespace furrow::jobs
