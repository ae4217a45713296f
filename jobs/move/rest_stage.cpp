// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/rest_stage.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "bridge/arrays/gather.h"
#include "bridge/draping/drape.h"
#include "geometry/fold/fold_base.h"
#include "geometry/mesh/measures.h"
#include "jobs/base/measure_crossings.h"
#include "jobs/base/read_inputs.h"
#include "jobs/cloth/prepare_garment.h"
#include "jobs/cloth/scene_cloth.h"
#include "jobs/rest/drape_garment.h"
#include "jobs/rest/drape_plan.h"
#include "jobs/rest/fall_watch.h"

namespace furrow::jobs {
namespace {

bridge::DrapeOptions rest_options(const io::Scene& scene, double gap, const io::MeshFile& garment) {
  bridge::DrapeOptions options;
  options.soft_start = soft_start_of(garment, !scene.pins.empty());
  options.settle.gravity = scene.simulation.gravity;
  options.settle.friction = scene.simulation.friction;
  options.settle.gap = gap;
  options.settle.threads = threads_of(scene, garment.mesh->number_of_vertices());
  return options;
}

std::vector<char> held_in(const physics::Cloth& cloth) {
  std::vector<char> held(cloth.particles.size());
  for (std::size_t i = 0; i < held.size(); ++i) held[i] = cloth.particles.inv_mass[i] == 0;
  return held;
}

void take_facts(std::vector<PartEnd> parts, RestStage& stage) {
  EndFacts& end = stage.end;
  end.parts = std::move(parts);
  end.residual = stage.settle.residual;
  end.settled = stage.settle.converged || stage.settle.residual > EndLimits{}.residual;
  end.finite = std::isfinite(stage.settle.residual);
  end.crossings = stage.crossings.pairs;
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
  options.interrupted = [&context] { return context.listener.cancelled(); };
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
  const FallWatch watch(mesh, nullptr, gap);
  physics::Cloth cloth;
  const bridge::DrapeReport report = bridge::drape(mesh, cloth, collider.get(), options, make, observe);
  stop_if_cancelled(context);
  for (const geometry::Vertex v : mesh.vertices()) garment.mesh->point(v) = mesh.point(v);
  stage.settle = report.levels.back().settle;
  stage.settle.iterations += report.levels.back().soft.iterations;
  stage.settle.factorisations += report.levels.back().soft.factorisations;
  stage.angle_defect = geometry::angle_defect(garment.mesh);
  stage.crossings = measure_crossings(garment);
  take_facts(watch.ends(garment, cloth.particles.x, held_in(cloth), {}, options.settle.gravity), stage);
  if (body) stage.end.body = body->end_of(garment.mesh, gap, 0);
  stage.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return stage;
}

std::optional<Fault> words_of_fall(const io::Scene& scene, const RestStage& stage) {
  if (stage.end.lost() == 0 || !stage.settle.converged) return std::nullopt;
  return Fault{
      "fallen",
      {"fallen",
       fmt::format("the garment came to rest {} below where it lay ({} of {} parts): the body does not "
                   "carry it where it is worn; put it where it is worn, or pin it",
                   geometry::length_text(stage.end.fallen()), stage.end.lost(), stage.end.parts.size()),
       scene.garment.string(), "pins"}};
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
          {"end", jobs::to_json(stage.end)},
          {"seconds", stage.seconds}};
}

}  // namespace furrow::jobs
