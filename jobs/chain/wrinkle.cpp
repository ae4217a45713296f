// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/chain/wrinkle.h"

#include <limits>

#include "bridge/arrays/gather_riders.h"
#include "geometry/figure/border_seams.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/refine/subdivide.h"
#include "io/base/figure_path.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/relocated.h"
#include "io/scene/scene_file.h"
#include "io/stroke/stroke_file.h"
#include "jobs/base/budget.h"
#include "jobs/base/card.h"
#include "jobs/base/gate.h"
#include "jobs/base/max_weights.h"
#include "jobs/base/measure_crossings.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "jobs/base/seam_ties.h"
#include "jobs/chain/hold_drawn.h"
#include "jobs/chain/settle_first.h"
#include "jobs/chain/wrinkle_stages.h"
#include "jobs/cloth/attach_parts.h"
#include "jobs/cloth/chain.h"
#include "jobs/cloth/keep_at_rest.h"
#include "jobs/cloth/pins.h"
#include "jobs/cloth/prepare_garment.h"
#include "jobs/cloth/recorded_material.h"
#include "jobs/draw/line_faults.h"
#include "jobs/draw/line_round.h"
#include "jobs/draw/measure_drawn.h"
#include "jobs/draw/wrinkle_reports.h"
#include "jobs/rest/drape.h"
#include "jobs/rest/drape_garment.h"
#include "jobs/rest/drape_remarks.h"
#include "jobs/rest/made_for.h"
#include "physics/base/cancel_scope.h"

namespace furrow::jobs {
namespace {

namespace fs = std::filesystem;

std::string path_of(const StrokeInput& strokes) {
  const auto* path = std::get_if<fs::path>(&strokes);
  return path ? path->string() : "";
}

void check(const WrinkleJob& job, Listener& listener) {
  const std::string output = job.output.string(), inserted = job.inserted.string();
  if (!output.empty()) check_output(output);
  if (job.state && !output.empty() && io::ending_of(job.output) != ".ply")
    throw std::invalid_argument(output + ": lines drawn into a state make a state, a .ply file");
  if (!inserted.empty()) check_output(inserted);
  const std::string smoothed = job.smoothed.string();
  if (!smoothed.empty()) check_output(smoothed);
  if (job.settle && job.state)
    throw std::invalid_argument("`settle`: the garment of a state is in motion; leave out one of the two");
  check_card(job);
  if (job.subdivide && !job.settle)
    throw std::invalid_argument(
        "`subdivide` goes with `settle`; `furrow subdivide` refines a garment by itself");
  if (!smoothed.empty() && !job.settle)
    throw std::invalid_argument("`smoothed` writes what is drawn before it comes to rest; add `settle`");
  if (!job.made_for.empty() && !job.settle)
    throw std::invalid_argument(
        "`made_for`: brings what is drawn to another body before it comes to rest there; add `settle` and "
        "`body`");
  std::vector<std::string> outputs{output, inserted, smoothed};
  std::vector<std::string> inputs{path_of(job.strokes), job.state ? "" : name_of(job.garment, ""),
                                  job.state_path.string(), job.made_for.string()};
  outputs.insert(outputs.end(), job.more_outputs.begin(), job.more_outputs.end());
  inputs.insert(inputs.end(), job.more_inputs.begin(), job.more_inputs.end());
  check_replaced(outputs, inputs, listener);
}

/// The frame that the garment's file or the state notes, where the job names none.
Frame frame_of(const WrinkleJob& job) {
  Frame frame = job.frame;
  if (!job.state) {
    take_noted_frame(frame, {name_of(job.garment, "")});
    return frame;
  }
  const Json& scene = job.state->scene;
  if (!frame.unit && scene.contains("unit")) frame.unit = scene["unit"].get<std::string>();
  if (!frame.up && scene.contains("up")) frame.up = scene["up"].get<std::string>();
  return frame;
}

std::vector<io::DrawnStroke> strokes_of(const WrinkleJob& job, const Context& context) {
  const auto* path = std::get_if<fs::path>(&job.strokes);
  std::vector<io::DrawnStroke> strokes =
      path ? io::read_drawn_strokes(*path, job.height, read_options(context.frame))
           : std::get<std::vector<io::DrawnStroke>>(job.strokes);
  if (!job.without.empty()) leave_out(strokes, job.without);
  if (job.width)
    for (io::DrawnStroke& drawn : strokes)
      if (!drawn.stroke.width) drawn.stroke.width = job.width;
  return strokes;
}

/// What the job's settings bring to rest, in the frame of the drawing. Throws std::invalid_argument where
/// nothing would hold it.
io::Scene rest_scene(const WrinkleJob& job, const Frame& frame) {
  io::TomlDocument document = job.settle->settings;
  io::set_value(document, "garment.mesh", name_of(job.garment, "garment"), "furrow wrinkle");
  take_default_cloth(document, "furrow wrinkle");
  io::Scene scene = scene_of(document, job.settle->folder);
  scene.unit = frame.unit;
  scene.up = frame.up;
  if (!scene.body && scene.pins.empty())
    throw std::invalid_argument(
        "`settle`: the garment rests on a body or hangs from what holds it: name a body with `body`, or what "
        "is held with `pin_loop`, `pin_group`, `pin_box` or `pin_vertices`");
  check_made_for(job.made_for, scene);
  return scene;
}

/// The garment, perhaps in motion.
struct Canvas {
  io::MeshFile file;
  std::optional<io::SavedState> state;  ///< its mesh is in `file`
  std::vector<std::vector<int>> pins;
};

Canvas canvas_of(const WrinkleJob& job, const io::Scene* keep, const io::Scene* rest,
                 const Context& context) {
  Canvas canvas;
  if (job.state) {
    canvas.state = job.state;
    canvas.file = std::move(canvas.state->file);
    refuse_chain(canvas.file.mesh, job.state_path.string());
    canvas.pins = canvas.state->pins;
  } else {
    const bool joins = rest ? rest->join : keep ? keep->join : job.join;
    canvas.file = read_garment(job.garment, context, "garment", Chains::refused, joins);
    const SeamTies ties = all_ties(canvas.file, name_of(job.garment, "the garment"), context);
    if (!ties.empty()) set_seam_ties(canvas.file.mesh, ties, keep ? keep->material : io::SceneMaterial{});
    if (keep) canvas.pins = find_pins(canvas.file, keep->pins);
  }
  return canvas;
}

/// The springs of the simulation that a state belongs to.
bridge::GatherOptions springs_of(const io::SavedState& state, const io::MeshFile& file,
                                 const fs::path& path) {
  const io::TomlDocument document = io::document_of(state.scene, path.string());
  return spring_options(file, io::read_scene(document, path.parent_path()).material);
}

LineTarget target_of(const WrinkleJob& job, Canvas& canvas, const io::Scene* keep) {
  const auto density = keep && !job.state ? keep->material.density : job.density;
  LineTarget target{canvas.file, job.state ? "" : name_of(job.garment, ""), density, nullptr, {}};
  if (!canvas.state) return target;
  target.moving = &canvas.state->simulation;
  target.springs = springs_of(*canvas.state, canvas.file, job.state_path);
  target.pins = canvas.pins;
  return target;
}

/// The round drawn into the canvas. `stages` and `quality` (null: not wanted) are filled on the way.
DrawnRound draw(const WrinkleJob& job, Canvas& canvas, const io::Scene* keep, bool refined,
                WrinkleStages* stages, DrawnQuality* quality, const Context& context) {
  const std::vector<io::DrawnStroke> strokes = strokes_of(job, context);
  require_heights(strokes, canvas.file.mesh, context);
  io::SceneLines lines;
  lines.options = job.options;
  lines.fade = job.fade;
  if (stages) stages->before = canvas.file.mesh;
  if (quality) quality->before = quality_before(canvas.file.mesh);
  std::vector<geometry::Point> displaced;
  geometry::StageObserver keep_stage = [&](geometry::Stage stage, const geometry::Mesh& mesh) {
    if (quality && stage == geometry::Stage::displaced)
      displaced.assign(mesh.points().begin(), mesh.points().end());
    if (stages && stage == geometry::Stage::inserted) stages->inserted = mesh;
    if (stages && stage == geometry::Stage::displaced) stages->displaced = mesh;
  };
  if (!stages && !quality) keep_stage = nullptr;
  const std::size_t old_count = canvas.file.mesh->number_of_vertices();
  DrawnRound drawn;
  LineTarget target = target_of(job, canvas, keep);
  if (refined) target.garment.clear();  // its file alone does not draw the same lines again
  drawn.round = draw_lines(target, strokes, lines, keep_stage);
  for (const std::string& w : drawn.round.warnings) context.warn("drawing", w, path_of(job.strokes));
  if (quality) {
    quality->drawn = quality_of_lines(canvas.file.mesh, displaced, drawn.round.report);
    quality->after = quality_of_lines(canvas.file.mesh, drawn.round.report);
  }
  pin_new_vertices(canvas.file.mesh, old_count, canvas.pins);
  if (canvas.state) {
    canvas.state->pins = canvas.pins;
    drawn.time = canvas.state->simulation.time;
  }
  return drawn;
}

bridge::KeptShape keep_drawn(Canvas& canvas, const io::Scene& scene, const Context& context) {
  std::optional<WorldBody> body;
  if (scene.body) body.emplace(*scene.body, context);
  physics::SimulateState* moving = canvas.state ? &canvas.state->simulation : nullptr;
  return keep_at_rest(canvas.file, scene, canvas.pins, body ? &*body : nullptr, moving ? moving->time : 0,
                      canvas.state ? canvas.state->contact_gap : 0, moving, context);
}

void write(const WrinkleJob& job, const WrinkleReport& report, const Context& context) {
  if (!job.output.empty() && job.output != "-") {
    if (!report.state) {
      write_mesh(job.output, report.garment, context);
    } else {
      io::SavedState state = *report.state;
      const io::TomlDocument document = io::document_of(state.scene, job.state_path.string());
      state.scene = io::relocated(document, job.state_path.parent_path(), job.output.parent_path());
      io::write_state(job.output, std::move(state));
    }
  }
  if (job.inserted.empty() || job.inserted == "-") return;
  write_mesh(job.inserted, inserted_garment(report), context);
}

/// How the drawn cloth crosses itself, and what of that makes it no success; what comes to rest is judged
/// there.
void look_at_lines(const WrinkleJob& job, const io::MeshFile& file, const CrossedStart& crossed,
                   WrinkleReport& report, const Context& context) {
  const std::string where = path_of(job.strokes);
  report.crossings = measure_crossings(file, &crossed, job.crossings.get());
  const geometry::WrinkleReport& lines = report.drawn.round.report;
  auto layers = layers_crossed(file.mesh, lines, report.crossings);
  if (layers) layers->where = where;
  if (layers && !job.settle)
    report.failures.push_back(*layers);
  else if (layers)
    context.listener.warn(*layers);
  else if (report.crossings.pairs)
    context.warn("cloth_crosses", words(report.crossings), where, "lines.height");
  if (const auto turned = lines_inside_out(file.mesh, lines))
    context.warn(turned->code, turned->text, where, turned->help);
}

/// Where what is drawn comes to rest.
struct RestPlan {
  io::Scene scene;
  std::optional<BodyCollider> body;
  int refinements = 0;  ///< of the garment, before its lines were drawn
};

/// Refines a garment whose edges are too long to keep the gap: once its folds are drawn, that would round
/// them.
RestPlan plan_rest(const WrinkleJob& job, const io::Scene& scene, geometry::Mesh& garment,
                   const Context& context) {
  RestPlan plan{scene, {}, job.subdivide.value_or(0)};
  if (plan.scene.body) {
    plan.body.emplace(load_body(*plan.scene.body, {context.frame, context.listener, &job.settle->memory},
                                tolerance_for(plan.scene.simulation.contact_gap)));
    if (!job.made_for.empty())
      plan.body->made_for = std::make_shared<const MadeFor>(
          read_made_for(job.made_for, plan.body->triangles, *plan.scene.body, context));
    if (!job.subdivide)
      plan.refinements = refinements_for_gap(garment, plan.scene.simulation.contact_gap,
                                             plan.body->field.report().tolerance);
  }
  require_refinement(garment.number_of_faces(), 4, plan.refinements, "subdivide", context);
  if (plan.refinements == 0) return plan;
  geometry::loop_subdivide(garment, plan.refinements);
  if (!job.subdivide) warn_of_refining(plan.scene, plan.refinements, "`subdivide=0`", context);
  return plan;
}

/// Lets the drawn garment come to rest as furrow drape would, and writes it before and after.
void settle_drawn(const WrinkleJob& job, const RestPlan& plan, const Budget& budget, WrinkleReport& report,
                  const Context& context) {
  const io::Scene& scene = plan.scene;
  if (!job.smoothed.empty() && job.smoothed != "-") write_mesh(job.smoothed, report.garment, context);
  MemoryFiles memory = job.settle->memory;
  memory.meshes[scene.garment] = report.garment;
  const Context there{context.frame, context.listener, &memory};
  const BodyCollider* body = plan.body ? &*plan.body : nullptr;
  const bool holds = job.hold && can_hold_lines(scene.material);
  Draped draped = holds ? hold_drawn(report.garment, scene, body, budget, there)
                        : drape_garment(scene, body, {}, false, there);
  report.budget_spent = draped.budget_spent = draped.report.stopped && draped.measured && budget.is_spent();
  draped.refinements = plan.refinements;
  draped.name = io::stem_of(scene.garment);
  for (const DrapeRemark& r : remarks_on({&draped, 1}))
    if (r.fails)
      report.failures.push_back(r.remark);
    else
      context.listener.warn(r.remark);
  if (const auto low = low_lines(draped.lines); holds && low) context.listener.warn(*low);
  io::TomlDocument document = job.settle->settings;
  take_default_cloth(document, "furrow wrinkle");
  note_material(draped.file, document, draped.gap);
  report.garment = draped.file;
  report.rest = std::make_shared<const Draped>(std::move(draped));
}

WrinkleReport draw_and_settle(const WrinkleJob& job, Budget& budget) {
  check(job, budget);
  WrinkleReport report;
  report.frame = frame_of(job);
  const Context context{report.frame, budget, job.keep ? &job.keep->memory : nullptr};
  std::optional<io::Scene> keep;
  if (job.keep) keep = scene_of(job.keep->settings, job.keep->folder);
  const io::Scene* scene = keep ? &*keep : nullptr;
  std::optional<io::Scene> rest;
  if (job.settle) rest = rest_scene(job, context.frame);
  Canvas canvas = canvas_of(job, scene, rest ? &*rest : nullptr, context);
  std::optional<RestPlan> settle;
  if (rest) settle = plan_rest(job, *rest, canvas.file.mesh, context);
  stop_if_cancelled(context);
  const bool refined = settle && settle->refinements > 0;
  const auto crossed = job.crossed && !refined
                           ? job.crossed
                           : std::make_shared<const CrossedStart>(crossed_start(canvas.file.mesh));
  if (job.wants_stages || !job.inserted.empty()) report.stages.emplace();
  if (job.wants_quality) report.quality.emplace();
  report.drawn = draw(job, canvas, scene, refined, report.stages ? &*report.stages : nullptr,
                      report.quality ? &*report.quality : nullptr, context);
  stop_if_cancelled(context);
  const io::SceneAttach& attach = settle ? settle->scene.attach : scene ? scene->attach : job.attach;
  if (!job.state) {
    attach_parts(canvas.file, attach, scene ? scene->material : io::SceneMaterial{},
                 name_of(job.garment, "the garment"), canvas.pins, context);
    bridge::bring_riders_along(canvas.file.mesh);
  }
  geometry::close_joined(canvas.file.mesh);
  if (scene) report.drawn.kept = keep_drawn(canvas, *scene, context);
  if (job.max_weights) limit_noted_weights(canvas.file, *job.max_weights);
  if (scene) warn_if_shape_only(job.output, context);
  if (scene && !job.state) note_material(canvas.file, job.keep->settings, 0);
  if (job.wants_quality) report.drawn.rest = geometry::audit_rest_metric(canvas.file.mesh);
  look_at_lines(job, canvas.file, *crossed, report, context);
  report.garment = std::move(canvas.file);
  if (canvas.state) {
    report.state = std::move(canvas.state);
    report.state->file = report.garment;
  }
  stop_if_cancelled(context);
  if (settle) settle_drawn(job, *settle, budget, report, context);
  warn_of_lost_ties(report.garment.mesh, job.output, budget);
  write(job, report, context);
  return report;
}

}  // namespace

WrinkleReport wrinkle(const WrinkleJob& job, Listener& listener) {
  if (job.settle && job.keep) {  // what comes to rest is held anyway
    WrinkleJob held = job;
    held.keep.reset();
    held.hold = true;
    return wrinkle(held, listener);
  }
  // What rests has a budget, and drawing is a part of that.
  Budget budget("wrinkle", job.settle ? job.budget : std::numeric_limits<double>::infinity(), listener);
  const physics::CancelScope cancelling([&budget] { return budget.cancelled(); });
  return budget.run([&] { return draw_and_settle(job, budget); });
}

Json to_json(const WrinkleReport& report) {
  Json json = to_json(report.drawn);
  json["crossings"] = to_json(report.crossings);
  if (report.rest) json["at_rest"] = to_json(*report.rest);
  if (report.budget_spent) json["budget_spent"] = true;
  if (report.quality) json["quality"] = to_json(*report.quality);
  return json;
}

}  // namespace furrow::jobs
