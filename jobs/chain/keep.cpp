// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/chain/keep.h"

#include <algorithm>
#include <cmath>

#include "bridge/arrays/store_rest_state.h"
#include "bridge/draping/standing_body.h"
#include "geometry/fold/gather_lines.h"
#include "io/base/figure_path.h"
#include "io/mesh/ply_motion.h"
#include "io/scene/relocated.h"
#include "jobs/base/budget.h"
#include "jobs/base/card.h"
#include "jobs/base/measure_crossings.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "jobs/chain/settle_first.h"
#include "jobs/cloth/chain.h"
#include "jobs/cloth/fabric_file.h"
#include "jobs/cloth/keep_at_rest.h"
#include "jobs/cloth/lost_lines.h"
#include "jobs/cloth/measure_shape.h"
#include "jobs/cloth/observation.h"
#include "jobs/cloth/prepare_garment.h"
#include "jobs/cloth/recorded_material.h"
#include "jobs/cloth/scene_cloth.h"
#include "jobs/draw/recorded_drawing.h"
#include "jobs/move/run_until_drawn.h"
#include "jobs/move/run_warnings.h"
#include "jobs/move/simulate.h"
#include "jobs/rest/drape_garment.h"
#include "physics/base/cancel_scope.h"
#include "physics/cloth/pins.h"
#include "physics/contact/residual_force.h"

namespace furrow::jobs {
namespace {

void check_outputs(const KeepJob& job, const OpenScene& open, Listener& listener) {
  check_card(job);
  if (job.whole && !job.help)
    throw std::invalid_argument("`whole` is help for what lies between the lines; leave out `no_help`");
  const io::Scene& scene = open.scene;
  const io::SceneOutput& out = scene.output;
  const bool of_file = is_scene(open.document.name);
  for (const auto& path : {out.mesh, out.state})
    if (!path.empty()) check_output(path.string());
  if (!out.state.empty() && io::ending_of(out.state) != ".ply")
    throw std::invalid_argument(out.state.string() + ": a state is a .ply file");
  if (!out.animation.empty() || !out.inserted.empty() || !out.smoothed.empty() || !out.body.empty())
    if (!of_file) throw std::invalid_argument("keep writes `output`, `save_state` and `picture` alone");
  for (const std::string& path : job.more_outputs)
    if (!path.empty()) check_folder(path);
  std::vector<std::string> inputs{job.state_path.string(), scene.garment.string()};
  if (of_file) inputs.push_back(open.document.name);
  if (scene.body)
    for (const auto& path : {scene.body->mesh, scene.body->frames}) inputs.push_back(path.string());
  for (const io::SceneLines& lines : scene.lines) inputs.push_back(lines.strokes.string());
  std::vector<std::string> outputs{out.mesh.string(), out.state.string()};
  outputs.insert(outputs.end(), job.more_outputs.begin(), job.more_outputs.end());
  check_replaced(outputs, inputs, listener);
}

OpenScene open_scene(const KeepJob& job, Listener& listener) {
  OpenScene open{{}, job.scene.settings, job.scene.folder, {}};
  take_fabric_file(open.document, open.folder);
  bool by_default = false;
  if (!job.state) {
    take_recorded_material(open.document, garment_of(open.document, open.folder), job.scene.memory);
    by_default = take_default_cloth(open.document, "furrow keep");
  }
  open.scene = scene_of(open.document, open.folder);
  open.scene.material.by_default = by_default;
  if (open.scene.garment.empty() && !job.state)
    throw std::invalid_argument(open.document.name + ": garment.mesh is missing");
  check_inputs(open.scene, open.document, job.state ? job.state->lines_drawn : -1, job.scene.memory);
  if (!job.state) take_noted_frame(open.scene, open.document, job.scene.memory);
  check_outputs(job, open, listener);
  open.frame.unit = open.scene.unit;
  open.frame.up = open.scene.up;
  return open;
}

/// The gap that a state's cloth has settled at [m]; 0: on another body, or under another gap.
double settled_gap(const io::SavedState& state, const WorldBody* body, double gap) {
  const Json material = state.scene->value("material", Json::object());
  const bool settled = body && body->fingerprint() == state.body &&
                       material.value("gap", physics::SimulateOptions{}.contact_gap) == gap;
  return settled ? state.contact_gap : 0;
}

/// The garment in its drawn shape, of a scene that draws at time 0 alone. body: the scene's, if it is built.
SceneCloth drawn_by(const io::Scene& scene, const Context& context,
                    std::shared_ptr<WorldBody> body = nullptr) {
  io::Scene drawn = scene;  // what is kept, keep_lines() finds out
  drawn.keep = false;
  for (io::SceneLines& lines : drawn.lines) lines.keep = false;
  return prepare_scene(drawn, context, std::move(body));
}

/// Whether it is in balance with the rest state that it has, as a drape leaves it.
bool rests_by_itself(const SceneCloth& garment, const io::Scene& scene, const physics::World& world) {
  const std::optional<physics::PosedCollider> standing = bridge::standing_body(world);
  const double residual =
      physics::residual_force(garment.cloth, scene.simulation.gravity, standing ? &*standing : nullptr,
                              scene.simulation.friction, garment.options.contact_gap);
  return residual <= EndLimits{}.residual;
}

/// What is wrong with keeping a garment as it lies on its body; empty: nothing. Friction may balance cloth
/// that has not come to rest on a few vertices, between which it would sag.
std::string why_unsettled(const SceneCloth& garment, const io::Scene& scene) {
  constexpr double out_of_balance = 1e-6, far_out = 1;  // of a vertex's weight
  constexpr double large_share = 0.05;                  // of the garment's weight, on one vertex
  const physics::World world = garment.world(scene);
  if (rests_by_itself(garment, scene, world)) return "";
  physics::Cloth cloth = garment.cloth;
  physics::PrestressOptions options;
  options.gravity = scene.simulation.gravity;
  options.friction = scene.simulation.friction;
  options.gap = garment.options.contact_gap;
  options.max_iterations = 60;  // twice those of garments that can be held
  const bridge::KeptShape shape = bridge::keep_shape(cloth, world, options);
  const double residual = shape.rest.residual;
  if (residual > far_out || (residual > out_of_balance && !shape.rest.imbalance.empty()))
    return "nothing held it in balance as it lay";
  double push = 0, weight = 0;
  for (const physics::Vec3& force : shape.rest.contact_force) push = std::max(push, force.norm());
  for (const double inverse : cloth.particles.inv_mass)
    if (inverse > 0) weight += options.gravity.norm() / inverse;
  const bool on_few = push > large_share * weight && !shape.certificate.stable();
  return on_few ? "a few of its vertices would have held it as it lay, and not stably" : "";
}

/// The scene that comes to rest: with a garment that is too coarse for its gap refined before its lines are
/// drawn, also those that its file has; where `refines` is false, or nothing is gained, as it is.
UndrawnScene rest_scene(const io::Scene& scene, bool refines, const WorldBody& body, const Context& context) {
  const UndrawnScene as_it_is{scene, context.memory ? *context.memory : MemoryFiles{}};
  UndrawnScene begun = undrawn(scene, context).value_or(as_it_is);
  if (!refines || begun.scene.lines.empty()) return as_it_is;
  SilentListener silent(context.listener);
  const io::MeshFile garment = read_garment(begun.scene.garment, {context.frame, silent, &begun.memory},
                                            "garment", Chains::refused, begun.scene.join);
  begun.scene.subdivide = refinements_for_gap(garment.mesh, scene.simulation.contact_gap, body.tolerance());
  return begun.scene.subdivide > 0 ? begun : as_it_is;
}

/// What drawn_by() gives; on a body that does not hold the garment well as it lies, once it has come to rest
/// there, at the same gap.
SceneCloth drawn_at_rest(const KeepJob& job, const OpenScene& open, const Budget& budget,
                         const Context& context, KeepReport& report) {
  const io::Scene& scene = open.scene;
  SceneCloth garment = drawn_by(scene, context);
  std::string why;
  if (job.settle && scene.body) {
    context.listener.progress("looking whether the body holds it", 0);
    why = why_unsettled(garment, scene);
    context.listener.progress("looking whether the body holds it", 1);
  }
  if (why.empty()) return garment;
  const bool refines = !open.document.root->value("garment", Json::object()).contains("subdivide");
  const UndrawnScene begun = rest_scene(scene, refines, *garment.body, context);
  SilentListener silent(context.listener);  // what there is to warn of is said already
  const bool finer = begun.scene.subdivide > scene.subdivide;
  if (finer) garment = drawn_by(begun.scene, {context.frame, silent, &begun.memory}, garment.body);
  const std::optional<MemoryFiles> settled = settle_first(begun.scene, garment.options.contact_gap, budget,
                                                          {context.frame, context.listener, &begun.memory});
  stop_if_cancelled(context);
  if (!settled) return garment;
  report.settled = true;
  const bool drawn_there = !begun.scene.lines.empty();
  context.warn("settled_first",
               scene.garment.string() + ": " + why + ", so it came to rest on the body " +
                   (drawn_there ? "before its lines were drawn; `no_settle` draws them where it lies"
                                : "with the lines that it has; `no_settle` keeps it where it lies"),
               scene.garment.string(), "`no_settle`");
  if (finer) warn_of_refining(begun.scene, begun.scene.subdivide, "`garment.subdivide=0`", context);
  io::Scene there = begun.scene;
  there.subdivide = 0;
  SceneCloth rests = drawn_by(there, {context.frame, silent, &*settled}, garment.body);
  if (!drawn_there)
    for (const Warning& lost : lost_lines(scene, measure_lines(rests.file, line_heights_by_id(garment.file))))
      context.listener.warn(lost);
  return rests;
}

/// The same of a state; notes there at what gap it rests.
SceneCloth drawn_in(io::SavedState& state, const io::Scene& scene, const Context& context) {
  SceneCloth result;
  result.file = state.file;
  result.pins = state.pins;
  if (scene.body) result.body = std::make_shared<WorldBody>(*scene.body, context, tolerance_for(state));
  complete_garment(result.file, scene.material);
  result.cloth = cloth_of(result.file, scene, result.pins, result.body.get(), state.simulation.time, context);
  result.options = scene.simulation;
  double& gap = result.options.contact_gap;
  state.contact_gap = settled_gap(state, result.body.get(), gap);
  if (result.body)
    gap = state.contact_gap =
        std::max(state.contact_gap, contact_gap(gap, result.body->tolerance(), result.file));
  result.options.threads = threads_of(scene, result.cloth.particles.size());
  return result;
}

/// Heights that lines would have without displacement.
std::vector<double> base_heights(const io::WrinkleRecord& record) {
  std::vector<double> base;
  for (const auto& line : record.lines) base.push_back(line.base_height);
  return base;
}

/// Heights that were asked for, as lines are measured: of a fold that of its crest, which its record compares
/// with the mean along the line; of other rules, whose smoothing is part of what was asked, as smoothed.
std::vector<double> asked_heights(const io::WrinkleRecord& record) {
  std::vector<double> asked;
  for (const auto& line : record.lines) {
    const double mean_share = line.crest_height ? line.drawn_height / *line.crest_height : NAN;
    asked.push_back(mean_share > 0 ? mean_share * line.height : line.smoothed_height);
  }
  return asked;
}

/// Each line's press from now on, so that keeping it again goes on from there.
void note_presses(const bridge::KeepReport& report, io::WrinkleRecord record, io::MeshFile& file) {
  for (const bridge::KeptLine& line : report.lines)
    if (std::size_t(line.line) < record.lines.size()) record.lines[line.line].press = line.press;
  io::set_wrinkle_record(file, record);
}

/// What threads have yet to gather is no shape to keep.
void require_drawn_in(const geometry::Mesh& mesh, const io::WrinkleRecord& record) {
  for (const geometry::GatherThread& thread : geometry::gather_threads(mesh, io::gathered_lines(record)))
    if (thread.draws())
      throw std::invalid_argument("the thread along '" + record.lines[std::size_t(thread.line)].name +
                                  "' has yet to draw it in; let the garment come to rest with it first "
                                  "(`furrow drape`), and keep that");
}

/// From rest, with nothing that fades in any more.
void write_kept_state(const OpenScene& open, const SceneCloth& cloth, std::optional<io::SavedState> state) {
  const std::filesystem::path& path = open.scene.output.state;
  io::SavedState kept;
  if (state)
    kept = std::move(*state);
  else
    kept.lines_drawn = int(std::count_if(open.scene.lines.begin(), open.scene.lines.end(),
                                         [](const io::SceneLines& lines) { return lines.time == 0; }));
  const double time = kept.simulation.time;
  kept.simulation = {};
  kept.simulation.time = time;
  kept.file = cloth.file;
  io::drop_motion(kept.file);
  kept.pins = cloth.pins;
  kept.body = cloth.body ? cloth.body->fingerprint() : "";
  kept.scene = io::relocated(open.document, open.folder, path.parent_path());
  kept.scene->erase("output");
  io::write_state(path, std::move(kept));
}

constexpr double least_implicit_dt = 1e-3;  // [s]

/// A proof is by implicit steps, unless the settings name others or a step that those would not need.
bridge::KeepOptions options_of(const KeepJob& job, const io::Scene& scene, const SceneCloth& cloth,
                               const io::WrinkleRecord& record) {
  bridge::KeepOptions options;
  options.run = cloth.options;
  const bool short_steps = options.run.dt && *options.run.dt < least_implicit_dt;
  if (!scene.integrator)
    options.run.integrator = short_steps ? physics::Integrator::leapfrog : physics::Integrator::implicit;
  options.run.stop_at.reset();
  options.run.observe_steps = observation_of(options.run, cloth.cloth, cloth.body != nullptr, false).steps;
  options.seconds = job.seconds;
  options.kept = job.kept;
  options.gust = job.gust;
  options.line_widths = io::line_widths(record);
  options.line_presses = io::line_presses(record);
  options.flat_lines = io::flat_lines(record);
  options.line_heights = asked_heights(record);
  options.whole = job.whole;
  if (!job.balance) options.largest_turn = 0;
  if (!job.help) options.presses.clear(), options.struts.clear(), options.height_trials = 0;
  return options;
}

/// A trial runs from 0 to 1, and there are several: each is told by its number, and how many lines failed
/// before.
class Trials {
 public:
  explicit Trials(Listener& listener) : listener_(listener) {}
  ~Trials() {
    if (!name_.empty()) listener_.progress(name_, 1);
  }
  Trials(const Trials&) = delete;
  Trials& operator=(const Trials&) = delete;
  bool operator()(const bridge::KeepProgress& now) {
    std::string name = "keeping, trial " + std::to_string(now.trial);
    if (now.helped > 0)
      name += ", more help for " + std::to_string(now.helped) + (now.helped == 1 ? " line" : " lines");
    if (name != name_ && !name_.empty()) listener_.progress(name_, 1);
    name_ = name;
    if (now.share < 1) listener_.progress(name_, now.share);
    return !listener_.cancelled();
  }

 private:
  Listener& listener_;
  std::string name_;
};

bridge::KeepReport find_rest(const KeepJob& job, const io::Scene& scene, SceneCloth& garment,
                             const io::WrinkleRecord& record, const Context& context) {
  context.listener.progress("keeping, trial 1", 0);  // its rest state takes a while
  Trials trials(context.listener);
  return bridge::keep_lines(garment.file.mesh, garment.cloth, garment.world(scene), base_heights(record),
                            options_of(job, scene, garment, record), std::ref(trials));
}

void write_outputs(const OpenScene& open, SceneCloth& garment, std::optional<io::SavedState> state,
                   const Context& context) {
  const io::SceneOutput& out = open.scene.output;
  if (!out.state.empty()) write_kept_state(open, garment, std::move(state));
  warn_if_shape_only(out.mesh, context);
  note_material(garment.file, open.document, garment.body ? garment.options.contact_gap : 0);
  if (!out.mesh.empty() && out.mesh != "-") write_mesh(out.mesh, garment.file, context);
}

/// What a whole report is to warn of.
std::vector<Warning> warnings_of(const KeepReport& report, const io::Scene& scene) {
  std::vector<Warning> warnings = idle_presses(scene.material, report.record);
  for (const physics::RigidImbalance& i : report.lines.rest.imbalance)
    warnings.push_back(
        {"shape_unbalanced",
         words(i) + (scene.body ? "; " : "; name the body that it lies on (`body`), or ") +
             "let the garment come to rest where it lies (`furrow drape`) before lines are drawn "
             "on it, or pin it",
         scene.garment.string(), "pins"});
  if (report.crossings.pairs)
    warnings.push_back({"cloth_crosses", words(report.crossings), report.mesh.string(), ""});
  return warnings;
}

KeepReport keep_within(const KeepJob& job, Budget& budget) {
  Listener& listener = budget;
  const OpenScene open = open_scene(job, listener);
  const io::Scene& scene = open.scene;
  const Context context{open.frame, listener, &job.scene.memory};
  KeepReport report;
  std::optional<io::SavedState> state = job.state;
  const bool later =
      std::any_of(scene.lines.begin(), scene.lines.end(), [](const auto& l) { return l.time > 0; });
  if (!state && later && !(state = run_until_drawn(open, context))) return report;
  if (state) refuse_chain(state->file.mesh, job.state_path.string());
  SceneCloth garment =
      state ? drawn_in(*state, scene, context) : drawn_at_rest(job, open, budget, context, report);
  const double time = state ? state->simulation.time : 0;
  stop_if_cancelled(context);
  report.ran = true;
  report.frame = open.frame;
  report.mesh = scene.output.mesh;
  report.saved_state = scene.output.state;
  report.record = *io::find_wrinkle_record(garment.file);
  if (report.record.lines.empty())
    throw std::invalid_argument(
        "there is no line to keep: draw one with `furrow wrinkle`, or name strokes in the "
        "scene's [[lines]]");
  require_drawn_in(garment.file.mesh, report.record);
  const CrossedStart crossed = crossed_start(garment.file.mesh);
  report.lines = find_rest(job, scene, garment, report.record, context);
  const physics::CancelScope whole([] { return false; });  // one that was stopped is told of, too
  note_presses(report.lines, report.record, garment.file);
  physics::soften_clamps(garment.cloth);
  bridge::store_rest_state(garment.cloth, spring_options(garment.file, scene.material), garment.file.mesh);
  write_outputs(open, garment, std::move(state), context);
  report.crossings = measure_crossings(garment.file, &crossed);
  report.end.crossings = report.crossings.pairs;
  if (garment.body)
    report.end.body = garment.body->end_of(garment.file.mesh, garment.options.contact_gap, time);
  report.warnings = warnings_of(report, scene);
  report.garment = std::move(garment.file);
  return report;
}

}  // namespace

KeepReport keep(const KeepJob& job, Listener& listener) {
  Budget budget("keep", job.budget, listener);
  const physics::CancelScope cancelling([&budget] { return budget.cancelled(); });
  KeepReport report = budget.run([&] { return keep_within(job, budget); });
  report.budget_spent = budget.is_spent() && (!report.ran || report.lines.interrupted);
  return report;
}

}  // namespace furrow::jobs
