// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/run/rest_stage.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "bridge/drape.h"
#include "bridge/gather.h"
#include "geometry/fold/fold_base.h"
#include "jobs/read_inputs.h"
#include "jobs/run/drape_garment.h"
#include "jobs/run/drape_plan.h"
#include "jobs/run/measure_crossings.h"
#include "jobs/run/prepare_garment.h"
#include "jobs/run/scene_cloth.h"

namespace furrow::jobs {
namespace {

bridge::DrapeOptions rest_options(const io::Scene& scene, double gap, const io::MeshFile& garment) {
  bridge::DrapeOptions options;
  options.soft_start = soft_start_of(garment, !scene.pins.empty());
  options.settle.gravity = scene.simulation.gravity;
  options.settle.friction = scene.simulation.friction;
  options.settle.gap = gap;
  options.settle.threads = threads_of(scene, garment.mesh.number_of_vertices());
  return options;
}

}  // namespace

RestStage rest_stage(io::MeshFile& garment, const io::Scene& scene, const std::vector<std::vector<int>>& pins,
                     const WorldBody* body, double gap, const Context& context) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  RestStage stage;
  stage.angle_defect_before = geometry::angle_defect(garment.mesh);
  const std::unique_ptr<physics::Collider> collider = body ? body->at_start() : nullptr;
  const std::unique_ptr<physics::Collider> precise = body ? body->precise_at_start() : nullptr;
  bridge::DrapeOptions options = rest_options(scene, gap, garment);
  if (precise) options.settle.faces = {precise.get(), body->tolerance()};
  const ProgressScope progress(context.listener, "settling");
  WayToRest to_rest(physics::SettleOptions{}.tolerance);
  const auto observe = [&](int, const physics::SettleProgress& p, const physics::Cloth&) {
    return progress(to_rest.share(p));
  };
  const auto make = [&](geometry::Mesh& mesh) {
    physics::Cloth cloth = naming(scene.garment.string(), [&] {
      return bridge::gather(mesh, spring_options(garment, scene.material));
    });
    pin_cloth(cloth, pins, body, 0, context);
    couple_cloth(garment, scene, cloth, context);
    return cloth;
  };
  geometry::Mesh mesh = garment.mesh;
  physics::Cloth cloth;
  const bridge::DrapeReport report = bridge::drape(mesh, cloth, collider.get(), options, make, observe);
  stop_if_cancelled(context);
  for (const geometry::Vertex v : mesh.vertices()) garment.mesh.point(v) = mesh.point(v);
  stage.settle = report.levels.back().settle;
  stage.settle.iterations += report.levels.back().soft.iterations;
  stage.settle.factorisations += report.levels.back().soft.factorisations;
  stage.angle_defect = geometry::angle_defect(garment.mesh);
  stage.crossings = measure_crossings(garment);
  stage.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return stage;
}

Fault words_of_unrest(const io::Scene& scene, const RestStage& stage, bool moved) {
  return {
      moved ? "not at rest before it moved" : "not at rest",
      {"not_at_rest",
       fmt::format("the garment was not at rest after {} iterations of settle, residual force {:.2g} of a "
                   "vertex's weight; look at what holds it: pins, or where it lies on the body",
                   stage.settle.iterations, stage.settle.residual),
       scene.garment.string(), "simulation.settle"}};
}

Json to_json(const RestStage& stage) {
  return {{"converged", stage.settle.converged},
          {"residual_force", stage.settle.residual},
          {"iterations", stage.settle.iterations},
          {"factorisations", stage.settle.factorisations},
          {"touching", stage.settle.touching},
          {"face_contacts", stage.settle.face_contacts},
          {"angle_defect_before", stage.angle_defect_before},
          {"angle_defect", stage.angle_defect},
          {"crossings", jobs::to_json(stage.crossings)},
          {"seconds", stage.seconds}};
}

}  // namespace furrow::jobs
