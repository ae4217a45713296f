// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/scene_cloth.h"

#include <algorithm>
#include <thread>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/couple_bending.h"
#include "geometry/mesh/struts.h"
#include "geometry/refine/subdivide.h"
#include "io/stroke/stroke_file.h"
#include "jobs/base/gate.h"
#include "jobs/base/read_inputs.h"
#include "jobs/base/seam_ties.h"
#include "jobs/cloth/attach_parts.h"
#include "jobs/cloth/chain.h"
#include "jobs/cloth/choose_steps.h"
#include "jobs/cloth/keep_at_rest.h"
#include "jobs/cloth/lay_warp.h"
#include "jobs/cloth/pins.h"
#include "jobs/cloth/prepare_garment.h"
#include "jobs/draw/line_round.h"
#include "physics/cloth/pins.h"

namespace furrow::jobs {
namespace {

constexpr double near = 0.02;  // [m]

/// Threads wait for each other some five times a step; below some 10,000 vertices each, that costs more than
/// it saves.
int worthwhile_threads(std::size_t vertices) {
  return static_cast<int>(
      std::clamp<std::size_t>(vertices / 10000, 1, std::max(1u, std::thread::hardware_concurrency())));
}

/// Those of time 0.
void draw_first_lines(const io::Scene& scene, SceneCloth& result, const Context& context) {
  for (const io::SceneLines& lines : scene.lines) {
    if (lines.time > 0) {
      result.ends_at_lines = lines.time < result.seconds;
      result.seconds = std::min(result.seconds, lines.time);
      return;
    }
    const auto strokes = read_strokes(lines, context);
    require_heights(strokes, result.file.mesh, context);
    const std::size_t old_count = result.file.mesh->number_of_vertices();
    const LineTarget target{result.file, garment_file(scene, context), scene.material.density, nullptr, {}};
    for (const std::string& w : draw_lines(target, strokes, lines).warnings)
      context.warn("drawing", w, lines.strokes.string());
    pin_new_vertices(result.file.mesh, old_count, result.pins);
  }
}

/// Refines the garment; seams that reading cut open are tied.
void subdivide_tied(io::MeshFile& file, const io::Scene& scene, const Context& context) {
  SeamTies ties = all_ties(file, scene.garment.string(), context);
  if (ties.empty()) {
    if (scene.subdivide > 0) geometry::loop_subdivide(file.mesh, scene.subdivide);
    return;
  }
  for (int step = 0; step < scene.subdivide; ++step) {
    ties = refined_ties(file.mesh, ties);
    geometry::loop_subdivide(file.mesh, 1);
  }
  set_seam_ties(file.mesh, ties, scene.material);
  part_seam_ties(file.mesh);
}

}  // namespace

io::MeshFile begin_garment(const io::Scene& scene, const Context& context, Chains chains) {
  stop_if_cancelled(context);
  io::MeshFile file = read_garment(scene.garment, context, "garment", chains, scene.join);
  stop_if_cancelled(context);
  check_chain(scene, file.mesh, context);
  if (geometry::is_chain(file.mesh)) return file;
  heed(faults_of_mesh(file), scene.garment.string(), context);
  heed(faults_of_garment(file.mesh), scene.garment.string(), context);
  require_refinement(file.mesh->number_of_faces(), 4, scene.subdivide, "subdivide", context);
  if (scene.material.warp != "auto" || scene.material.is_woven())
    lay_warp(file, scene.material.warp, scene.material.is_woven(), scene.garment.string(), context);
  subdivide_tied(file, scene, context);
  attach_parts(file, scene.attach, scene.material, scene.garment.string(), find_pins(file, scene.pins),
               context);
  return file;
}

void warn_if_apart(const io::Scene& scene, const WorldBody& body, const geometry::Mesh& garment,
                   const Context& context) {
  heed(faults_of_pair(garment, body.outline(0), scene.body->unit.has_value()), scene.garment.string(),
       context);
}

void warn_of_start(const io::Scene& scene, const WorldBody& body, const geometry::Mesh& garment,
                   const Context& context) {
  constexpr double deep = 0.01;  // [m]
  warn_if_apart(scene, body, garment, context);
  const physics::Penetration inside = body.penetration(bridge::positions_of(garment), 0);
  if (inside.deepest > deep)
    context.warn(
        "starts_inside",
        scene.garment.string() + ": " + std::to_string(inside.inside) + " of " +
            std::to_string(garment.number_of_vertices()) + " vertices start inside the body, up to " +
            geometry::length_text(inside.deepest) +
            " deep, and are driven out; what comes of it is no motion of cloth: move the garment out "
            "of the body first, or look at `unit`",
        scene.garment.string(), "unit");
}

void pin_cloth(physics::Cloth& cloth, const std::vector<std::vector<int>>& all, const WorldBody* body,
               double time, const Context& context) {
  for (const std::vector<int>& pins : all) {
    physics::pin(cloth.particles, pins);
    if (!body) continue;
    const physics::PushOutReport r = body->push_out(cloth.particles.x, pins, time);
    if (r.moved)
      context.warn("pins_inside_body",
                   std::to_string(r.moved) + " pinned vertices were inside the body; moved onto it, by " +
                       geometry::length_text(r.farthest) + " at most",
                   "pins");
    if (r.still_inside)
      context.warn("pins_stay_inside", std::to_string(r.still_inside) + " of them could not be brought out",
                   "pins");
  }
  physics::stiffen_clamps(cloth);
}

bool couple_cloth(const io::MeshFile& file, const io::Scene& scene, physics::Cloth& cloth,
                  const Context& context, bool tell) {
  if (scene.material.bending_law != bridge::Bending::plate) return false;
  const int thin = bridge::couple_bending(file.mesh, spring_options(file, scene.material), cloth).slivers;
  if (thin > 0 && tell)
    context.warn(
        "thin_faces",
        scene.garment.string() + ": " + std::to_string(thin) +
            " faces are lower than a ten-thousandth of their longest edge: their angles are shared by "
            "area, and may bend too stiffly",
        scene.garment.string(), "material.bending_law");
  return thin > 0;
}

physics::Cloth cloth_of(const io::MeshFile& file, const io::Scene& scene,
                        const std::vector<std::vector<int>>& pins, const WorldBody* body, double time,
                        const Context& context) {
  physics::Cloth cloth = naming(scene.garment.string(), [&] {
    return bridge::gather(file.mesh, spring_options(file, scene.material));
  });
  pin_cloth(cloth, pins, body, time, context);
  couple_cloth(file, scene, cloth, context);
  if (scene.material.membrane == bridge::Membrane::patches)
    context.warn("patches_are_triangles",
                 "its membrane of patches is for `furrow drape`: here its triangles stay as they are",
                 scene.garment.string(), "material.membrane");
  return cloth;
}

physics::World world_of(const io::Scene& scene, const WorldBody* body,
                        const std::vector<std::vector<int>>& pins) {
  physics::World world;
  world.wind = scene.wind;
  if (body) body->add_to(world);
  for (std::size_t i = 0; i < pins.size(); ++i)
    if (!physics::at_rest(scene.pins[i].motion)) world.pins.push_back({pins[i], scene.pins[i].motion});
  return world;
}

int threads_of(const io::Scene& scene, std::size_t vertices) {
  return scene.threads ? scene.threads : worthwhile_threads(vertices);
}

SceneCloth prepare_scene(const io::Scene& scene, const Context& context, std::shared_ptr<WorldBody> body,
                         Chains chains) {
  SceneCloth result;
  result.file = begin_garment(scene, context, chains);
  if (scene.body && !body)
    body = std::make_shared<WorldBody>(*scene.body, context, tolerance_for(result.file));
  result.body = std::move(body);
  result.pins = find_pins(result.file, scene.pins);
  if (result.body) warn_if_apart(scene, *result.body, result.file.mesh, context);
  result.seconds = scene.simulation.seconds;
  draw_first_lines(scene, result, context);
  complete_garment(result.file, scene.material);
  if (keeps_first_shape(scene))
    keep_at_rest(result.file, scene, result.pins, result.body.get(), 0, 0, nullptr, context);
  result.cloth = cloth_of(result.file, scene, result.pins, result.body.get(), 0, context);
  result.options = scene.simulation;
  if (result.body) {
    result.options.contact_gap =
        contact_gap(result.options.contact_gap, result.body->tolerance(), result.file);
    result.near_body = result.body->count_near(result.cloth.particles.x, near);
  }
  result.options.threads = threads_of(scene, result.cloth.particles.size());
  if (!scene.integrator)
    result.options.integrator = choose_steps(result.options, result.cloth, result.body != nullptr).integrator;
  return result;
}

}  // namespace furrow::jobs
