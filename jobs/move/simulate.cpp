// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/simulate.h"

#include <algorithm>
#include <chrono>

#include "bridge/arrays/gather.h"
#include "bridge/draping/energy_parts.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "io/base/atomic_file.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/ply_motion.h"
#include "io/scene/relocated.h"
#include "jobs/base/card.h"
#include "jobs/base/gate.h"
#include "jobs/base/measure_crossings.h"
#include "jobs/base/read_inputs.h"
#include "jobs/base/seam_ties.h"
#include "jobs/cloth/chain.h"
#include "jobs/cloth/choose_steps.h"
#include "jobs/cloth/keep_at_rest.h"
#include "jobs/cloth/lost_lines.h"
#include "jobs/cloth/measure_shape.h"
#include "jobs/cloth/observation.h"
#include "jobs/cloth/pins.h"
#include "jobs/cloth/prepare_garment.h"
#include "jobs/cloth/recorded_material.h"
#include "jobs/cloth/scene_cloth.h"
#include "jobs/draw/line_round.h"
#include "jobs/move/animation_series.h"
#include "jobs/move/hand_on_cloth.h"
#include "jobs/move/judge.h"
#include "jobs/move/judge_report.h"
#include "jobs/move/rest_stage.h"
#include "jobs/move/run_until_drawn.h"
#include "jobs/move/run_warnings.h"
#include "jobs/move/simulate_checks.h"
#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"
#include "physics/motion/work_clock.h"

namespace furrow::jobs {
namespace {

/// What a run is made of; it does not change on the way.
struct Run {
  const OpenScene& of;
  io::Scene& scene;  ///< its integrator becomes the one that is chosen
  const Context& context;
  std::shared_ptr<WorldBody> body;  ///< null: none
  bool resumed;
  Watch watch = {};
  Hand hand = {};  ///< empty: there is none, or the integrator knows no energies
  bool times = false;
  std::optional<ChosenSteps> chosen = {};                  ///< last; none: settings or state say
  std::vector<std::vector<io::DrawnStroke>> strokes = {};  ///< of each round
};

/// How far it has come.
struct Reached {
  io::SavedState now;
  CrossedStart crossed = {};         ///< of the garment as it was given
  std::vector<double> heights = {};  ///< of lines at the start, or when the last ones were drawn [m]
  bool starts = false;               ///< the next stretch is the first: pins are put onto the body
};

/// A stretch between two rounds of lines.
struct Stretch {
  physics::SimulateReport report;
  bridge::EnergyParts energy = {};  ///< at its end
  bool goes_on = false;             ///< the cloth came to its end, and the run is not to stop there
};

io::SavedState begin(const io::Scene& scene, const Context& context) {
  io::SavedState state;
  state.file = begin_garment(scene, context, Chains::taken);
  if (!scene.output.state.empty()) io::check_state_attributes(state.file.mesh);
  return state;
}

/// A chain is no cloth: the usual one was taken before its file was read.
void forget_default_cloth(OpenScene& open) {
  open.document.root["material"].erase("preset");
  const io::Scene without = scene_of(open.document, open.folder);
  open.scene.material = without.material;
  open.scene.simulation.spring_damping = without.simulation.spring_damping;
  open.scene.simulation.friction = without.simulation.friction;
}

/// What is not the state's any more.
void change_plan(const Run& run, io::SavedState& now) {
  const Json& said = run.of.document.root;
  const auto value = [](const Json& settings, const char* key) {
    return settings.contains(key) ? settings[key] : Json();
  };
  if (value(now.scene, "pins") != value(said, "pins")) now.simulation.homes.clear();
  if (value(value(now.scene, "material"), "gap") != value(value(said, "material"), "gap"))
    now.contact_gap = 0;
  const auto density = run.scene.material.density;
  if (geometry::is_chain(now.file.mesh) ||
      (density && *density != io::find_wrinkle_record(now.file)->density))
    complete_garment(now.file, run.scene.material);
}

/// The state with pins, on the run's body; strokes are read.
Reached take_up(Run& run, io::SavedState now) {
  const double at_most = tolerance_for(now);
  if (run.scene.body && !run.body)
    run.body = std::make_shared<WorldBody>(*run.scene.body, run.context, at_most);
  now.field_tolerance = run.body && std::isfinite(at_most) ? run.body->tolerance() : 0;
  if (run.resumed) check_chain(run.scene, now.file.mesh, run.context);
  if (run.resumed && now.pins.size() != run.scene.pins.size())
    throw std::invalid_argument("the state has " + std::to_string(now.pins.size()) +
                                " sets of pins, the scene " + std::to_string(run.scene.pins.size()) +
                                "; go on with the same pins");
  if (!run.resumed) now.pins = find_pins(now.file, run.scene.pins);
  const std::string body = run.body ? run.body->fingerprint() : "";
  if (now.body != body) {
    now.simulation.contact.clear();
    now.simulation.steps.anchors.clear();
    now.simulation.body_travel = now.contact_gap = 0;
  }
  now.body = body;
  if (run.resumed)
    change_plan(run, now);
  else if (run.body)
    warn_of_start(run.scene, *run.body, now.file.mesh, run.context);
  Reached reached{std::move(now)};
  reached.crossed = crossed_start(reached.now.file.mesh);
  reached.heights = line_heights_by_id(reached.now.file);
  run.strokes = read_rounds(run.scene, reached.now.lines_drawn, run.context);
  for (const auto& round : run.strokes) require_heights(round, reached.now.file.mesh, run.context);
  if (!run.scene.output.animation.empty())
    require_animation(run.scene.simulation.seconds - reached.now.simulation.time, run.scene.output.fps,
                      reached.now.file.mesh->number_of_vertices(), run.context);
  stop_if_cancelled(run.context);
  return reached;
}

bridge::KeptShape keep_shape(const Run& run, io::SavedState& now, physics::SimulateState* moving) {
  return keep_at_rest(now.file, run.scene, now.pins, run.body.get(), now.simulation.time, now.contact_gap,
                      moving, run.context);
}

LineTarget target_of(const Run& run, io::SavedState& now, bool moving) {
  LineTarget target{now.file, garment_file(run.scene, run.context), run.scene.material.density, nullptr, {}};
  if (moving) {
    target.moving = &now.simulation;
    target.springs = spring_options(now.file, run.scene.material);
    target.pins = now.pins;
  }
  return target;
}

/// Draws the next round.
DrawnRound draw_round(const Run& run, Reached& reached) {
  io::SavedState& now = reached.now;
  const std::size_t round = std::size_t(now.lines_drawn);
  const io::SceneLines& lines = run.scene.lines[round];
  const bool moving = now.simulation.step > 0;
  const bool keeps = lines.keep && (moving || run.resumed);
  const std::optional<Reached> before = keeps ? std::optional(reached) : std::nullopt;
  if (moving) now = io::parse_state(io::state_bytes(std::move(now)), "state");  // as if it had been saved
  const std::size_t old_count = now.file.mesh->number_of_vertices();
  DrawnRound drawn{draw_lines(target_of(run, now, moving), run.strokes[round], lines,
                              lines.time == 0 ? stage_writer(run.scene.output, now.file, run.context)
                                              : geometry::StageObserver{}),
                   {},
                   now.simulation.time,
                   {}};
  pin_new_vertices(now.file.mesh, old_count, now.pins);
  ++now.lines_drawn;
  for (const std::string& w : drawn.round.warnings) run.context.warn("drawing", w, lines.strokes.string());
  drawn.rest = geometry::audit_rest_metric(now.file.mesh);
  if (keeps) try {
      drawn.kept = keep_shape(run, now, &now.simulation);
    } catch (const physics::Cancelled&) {
      reached = *before;
      throw;
    }
  if (moving) reached.heights = line_heights_by_id(now.file);
  return drawn;
}

/// Brings what is drawn to rest, and writes it if the scene says where.
RestStage settle_garment(const Run& run, io::SavedState& now) {
  double gap = run.scene.simulation.contact_gap;
  if (run.body) gap = std::max(now.contact_gap, contact_gap(gap, run.body->tolerance(), now.file));
  RestStage stage = rest_stage(now.file, run.scene, now.pins, run.body.get(), gap, run.context);
  if (run.scene.output.settled.empty()) return stage;
  io::MeshFile written = now.file;
  io::drop_motion(written);
  close_seam_ties(written.mesh);
  note_material(written, run.of.document, run.body ? gap : 0);
  write_mesh(run.scene.output.settled, written, run.context);
  return stage;
}

void set_velocity(geometry::Mesh& mesh, const Eigen::Vector3d& velocity) {
  if (velocity.isZero(0)) return;
  auto of = geometry::ensure_map(mesh, geometry::attribute::velocity);
  for (const geometry::Vertex v : mesh.vertices()) of[v] = {velocity.x(), velocity.y(), velocity.z()};
}

/// Draws the rounds whose time has come. After those of time 0 the garment is complete: masses and springs.
void draw_due_rounds(const Run& run, Reached& reached, AnimationSeries& animations, SimulateReport& report) {
  io::SavedState& now = reached.now;
  const auto& rounds = run.scene.lines;
  while (now.lines_drawn < int(rounds.size()) && rounds[now.lines_drawn].time <= now.simulation.time) {
    animations.finish();
    report.rounds.push_back(draw_round(run, reached));
  }
  if (now.simulation.step > 0 || run.resumed) return;
  naming(run.scene.garment.string(), [&] { complete_garment(now.file, run.scene.material); });
  if (keeps_first_shape(run.scene)) report.kept = keep_shape(run, now, nullptr);
  reached.heights = line_heights_by_id(now.file);
  reached.starts = true;
  if (run.scene.settle) report.rest = settle_garment(run, now);
  set_velocity(now.file.mesh, run.scene.velocity);
}

double next_stop(const io::Scene& scene, int lines_drawn) {
  double stop = scene.simulation.seconds;
  if (lines_drawn < int(scene.lines.size())) stop = std::min(stop, scene.lines[lines_drawn].time);
  if (scene.stop_at) stop = std::min(stop, *scene.stop_at);
  return stop;
}

/// Options of the stretch to `stop`; the state keeps its first gap: lines only make edges shorter.
physics::SimulateOptions options_of(const Run& run, io::SavedState& now, double stop, std::size_t vertices) {
  physics::SimulateOptions options = run.scene.simulation;
  if (run.body && now.contact_gap == 0)
    now.contact_gap = contact_gap(options.contact_gap, run.body->tolerance(), now.file);
  if (run.body) options.contact_gap = now.contact_gap;
  if (stop < options.seconds) options.stop_at = stop;
  options.threads = threads_of(run.scene, vertices);
  options.times = run.times;
  options.self.on = options.self.on && !geometry::is_chain(now.file.mesh);
  return options;
}

void write_state(const Run& run, const io::SavedState& now) {
  const std::filesystem::path& path = run.scene.output.state;
  io::SavedState state = now;
  state.scene = io::relocated(run.of.document, run.of.folder, path.parent_path());
  state.scene->erase("output");  // it and stop_at belong to one call
  if (state.scene->contains("simulation")) state.scene["simulation"].erase("stop_at");
  io::write_state(path, std::move(state));
}

/// Simulates until the observer stops it or the end is reached. Whenever a checkpoint is due, the state is
/// written, and the run goes on from it: by the same bits, though it evaluates the forces once more. So it
/// does where a hand takes hold of the cloth or lets it go, with another cloth then.
physics::SimulateReport simulate_with_checkpoints(const Run& run, Reached& reached, physics::Cloth& cloth,
                                                  const physics::SimulateOptions& options,
                                                  const physics::Observer& observe) {
  using Clock = std::chrono::steady_clock;
  io::SavedState& now = reached.now;
  const physics::World world = world_of(run.scene, run.body.get(), now.pins);
  const std::optional<double> every = run.scene.output.checkpoint;
  HandOnCloth hand(run.hand, cloth);
  hand.asks_for_renewal(now.simulation.time);
  for (auto written = Clock::now();;) {
    bool due = false, grips = false;
    if (hand.renew()) now.simulation.planned = false;
    const physics::SimulateReport report =
        physics::simulate(cloth, world, options, &now.simulation, [&](const physics::SimulateProgress& p) {
          if (!observe(p)) return false;
          due = every && std::chrono::duration<double>(Clock::now() - written).count() >= *every;
          grips = hand.asks_for_renewal(p.time);
          return !due && !grips;
        });
    bridge::scatter(cloth.particles, now.file.mesh);
    bridge::scatter_velocities(cloth.particles, now.file.mesh);
    if (!(due || grips) || report.outcome != physics::Outcome::stopped_by_observer) return report;
    if (!due) continue;
    write_state(run, now);
    written = Clock::now();
  }
}

/// Where the settings leave it open: once for each plan of steps, so a run that is stopped and resumed goes
/// on as one that was not.
void choose_integrator(Run& run, io::SavedState& now, const physics::Cloth& cloth) {
  if (run.scene.integrator) return;
  const bool planned = now.simulation.planned && now.simulation.cloth == physics::fingerprint(cloth);
  if (!planned || !now.integrator) {
    run.chosen = choose_steps(run.scene.simulation, cloth, run.body != nullptr);
    now.integrator = run.chosen->integrator;
  }
  run.scene.simulation.integrator = *now.integrator;
}

Stretch simulate_to(double stop, Run& run, Reached& reached, AnimationSeries& animations) {
  io::SavedState& now = reached.now;
  const io::Scene& scene = run.scene;
  const WorldBody* put_on = reached.starts ? run.body.get() : nullptr;
  physics::Cloth cloth = cloth_of(now.file, scene, now.pins, put_on, now.simulation.time, run.context);
  reached.starts = false;
  choose_integrator(run, now, cloth);
  physics::SimulateOptions options = options_of(run, now, stop, cloth.particles.size());
  const bool is_seen = animations.is_on() || run.watch;
  const Observation observation = observation_of(options, cloth, run.body != nullptr, is_seen);
  options.observe_steps = observation.steps;
  animations.start(now.file.mesh, now.simulation.time, cloth.particles.x);
  SimulationGate gate(scene.simulation.seconds, scene.simulation.dt.has_value(),
                      cost_of_step(options, cloth, run.body != nullptr), run.context);
  const ProgressScope progress(run.context.listener, "simulating");
  Stretch stretch;
  stretch.report =
      simulate_with_checkpoints(run, reached, cloth, options, [&](const physics::SimulateProgress& p) {
        gate.check(p);
        if (observation.shows(p, stop)) animations.observe(p.time, cloth.particles.x);
        if (run.watch) run.watch(p.time, cloth.particles.x);
        return progress(p.time / scene.simulation.seconds);
      });
  const physics::Outcome outcome = stretch.report.outcome;
  if (outcome != physics::Outcome::diverged)
    stretch.energy = bridge::energy_parts(
        cloth, options.gravity, std::vector<physics::Vec3>(cloth.particles.size(), physics::Vec3::Zero()));
  const bool stopped =
      outcome == physics::Outcome::stopped_at && scene.stop_at && now.simulation.time >= *scene.stop_at;
  stretch.goes_on = (outcome == physics::Outcome::finished || outcome == physics::Outcome::stopped_at) &&
                    now.simulation.time < scene.simulation.seconds && !stopped;
  return stretch;
}

/// Draws and simulates by turns. Where a round of lines cannot be drawn, the state reached is written before
/// that comes out.
physics::SimulateReport run_to_end(Run& run, Reached& reached, AnimationSeries& animations,
                                   SimulateReport& report) {
  Stretch stretch;
  try {
    do {
      draw_due_rounds(run, reached, animations, report);
      stretch = simulate_to(next_stop(run.scene, reached.now.lines_drawn), run, reached, animations);
    } while (stretch.goes_on);
  } catch (const std::exception&) {
    if (reached.now.simulation.step > 0 && !run.scene.output.state.empty()) {
      write_state(run, reached.now);
      run.context.warn("state_rescued",
                       "the state reached at " + std::to_string(reached.now.simulation.time) +
                           " s was written to " + run.scene.output.state.string(),
                       run.scene.output.state.string());
    }
    throw;
  }
  if (stretch.report.outcome != physics::Outcome::diverged) report.energy = stretch.energy;
  return stretch.report;
}

/// Drops what belongs to motion from the garment and writes what the scene names.
void write_outputs(const Run& run, io::SavedState& now, AnimationSeries& animations) {
  const io::SceneOutput& out = run.scene.output;
  io::OutputGroup together;
  if (!out.state.empty()) write_state(run, now);
  animations.finish();
  io::drop_motion(now.file);
  close_seam_ties(now.file.mesh);
  if (run.body && !out.body.empty())
    write_mesh(out.body, run.body->at(now.simulation.time, run.context), run.context);
  note_material(now.file, run.of.document, run.body ? now.contact_gap : 0);
  if (!out.mesh.empty() && out.mesh != "-") write_mesh(out.mesh, now.file, run.context);
  together.commit();
}

std::vector<Warning> remarks_on_run(const Run& run, const physics::SimulateReport& r,
                                    const io::MeshFile& file, double contact_gap, std::int64_t steps_before) {
  std::vector<Warning> all = oddities_of(run.scene, r);
  if (run.body && contact_gap > 1.5 * run.scene.simulation.contact_gap)
    all.push_back(raised_gap(run.scene, file.mesh, contact_gap, run.body->tolerance()));
  const std::vector<Warning> presses = idle_presses(run.scene.material, *io::find_wrinkle_record(file));
  all.insert(all.end(), presses.begin(), presses.end());
  if (run.resumed && r.time >= run.scene.simulation.seconds && r.steps == steps_before)
    all.push_back({"at_end_already", "the state is at the end already; `seconds` puts that off", "",
                   "simulation.seconds"});
  if (r.outcome == physics::Outcome::stopped_by_observer) all.push_back(interruption_of(run.scene, r));
  return all;
}

/// What the judge of ends knows of the shape that was measured.
void take_facts(SimulateReport& report) {
  EndFacts& end = report.shape->end;
  end.strain = report.run.strain.p99;
  end.crossings = report.shape->crossings.pairs;
  end.blocked = report.run.outcome == physics::Outcome::blocked;
  if (!report.rest || report.run.steps > 0) return;
  end.residual = report.rest->settle.residual;
  end.settled = report.rest->settle.converged;
}

/// Writes, measures and remarks on what was reached.
void conclude(const Run& run, Reached& reached, AnimationSeries& animations, std::int64_t steps_before,
              SimulateReport& report) {
  const physics::CancelScope whole([] { return false; });  // one that was stopped is told of, too
  io::SavedState& now = reached.now;
  if (report.run.outcome == physics::Outcome::diverged) {
    report.failure = words_of_divergence(run.scene, report.run);
  } else {
    write_outputs(run, now, animations);
    report.shape = measure_shape(now.file, reached.heights, run.body.get(), now.contact_gap, report.run.time);
    report.shape->crossings = measure_crossings(now.file, &reached.crossed);
    take_facts(report);
    report.faults = faults_of(run.scene, *report.shape, report.run.strain);
    if (report.run.outcome == physics::Outcome::blocked)
      report.faults.push_back(words_of_block(run.scene, report.run));
    if (const auto unsolved = unsolved_steps(report.run)) report.faults.push_back(*unsolved);
    if (report.rest && !report.rest->settle.converged)
      report.faults.push_back(words_of_unrest(run.scene, *report.rest, report.run.steps > 0));
    if (report.rest)
      if (const auto fallen = words_of_fall(run.scene, *report.rest)) report.faults.push_back(*fallen);
    report.warnings = remarks_on_run(run, report.run, now.file, now.contact_gap, steps_before);
    if (const auto through = body_comes_through(run.scene, report.shape->end))
      report.warnings.push_back(*through);
    const std::vector<Warning> lost = lost_lines(run.scene, report.shape->lines);
    report.warnings.insert(report.warnings.end(), lost.begin(), lost.end());
    if (const auto falls = falls_freely(run.scene, now.pins)) report.warnings.push_back(*falls);
    report.garment = std::move(now.file);
  }
  report.animations = animations.reports();
}

/// Integrator and step for the tolerance: sets them in the scene. Builds the scene's body, if it has one, for
/// the run, too.
Judgement choose_setting(const SimulateJob& job, OpenScene& scene, const Context& context,
                         std::shared_ptr<WorldBody>& body) {
  const JudgeOptions options{*job.tolerance, job.budget};
  check(options);
  SilentListener silent(context.listener);  // the run itself warns
  if (scene.scene.body) {
    const io::MeshFile garment = read_garment(scene.scene.garment, {context.frame, silent, context.memory},
                                              "garment", Chains::taken, scene.scene.join);
    body = std::make_shared<WorldBody>(*scene.scene.body, context, tolerance_for(garment));
  }
  const SceneCloth cloth =
      prepare_scene(scene.scene, {context.frame, silent, context.memory}, body, Chains::taken);
  if (geometry::is_chain(cloth.file.mesh))
    throw std::invalid_argument(
        "`accuracy`: surfaces are compared, and the garment is a chain, without faces; choose "
        "`integrator` and `dt`");
  Judgement judgement = judge(cloth, cloth.world(scene.scene), options, context);
  if (!judgement.has_answer()) return judgement;
  set_candidate(scene.document, judgement.candidates[std::size_t(judgement.chosen)].candidate);
  scene.scene = scene_of(scene.document, scene.folder);
  return judgement;
}

/// With what no part took, and `written` seconds more of output.
physics::WorkTimes times_of(const physics::SimulateReport& run, double written) {
  physics::WorkTimes times = run.times;
  times[std::size_t(physics::WorkPart::output)] += written;
  return times;
}

}  // namespace

SimulateJob resume_from(const std::filesystem::path& path) {
  SimulateJob job;
  job.state = io::read_state(path);
  job.state_path = path;
  job.scene = {io::document_of(job.state->scene, path.string()), path.parent_path(), {}};
  return job;
}

SimulateReport simulate(const SimulateJob& job, Listener& listener) {
  check_card(job);
  const physics::CancelScope cancelling([&listener] { return listener.cancelled(); });
  OpenScene scene = open_scene(job, listener);
  const Context context{scene.frame, listener, &job.scene.memory};
  SimulateReport report;
  report.title = scene.scene.title;
  std::shared_ptr<WorldBody> body;
  if (job.tolerance) {
    report.scene_dt = scene.scene.simulation.dt.has_value();
    report.choice = choose_setting(job, scene, context, body);
    if (!report.choice->has_answer()) return report;
  }
  report.ran = true;
  report.state = job.state_path.string();
  if (job.state)
    report.settings_before =
        io::relocated(io::document_of(job.state->scene, report.state), job.state_path.parent_path(), "");
  report.frame = scene.frame;
  Run run{scene, scene.scene, context, std::move(body), job.state.has_value(), job.watch, {}, job.times};
  if (scene.scene.simulation.integrator != physics::Integrator::xpbd) run.hand = job.hand;
  AnimationSeries animations(scene.scene.output, context.frame);
  const std::int64_t steps_before = job.state ? job.state->simulation.step : 0;
  io::SavedState start = job.state ? *job.state : begin(scene.scene, context);
  if (scene.scene.material.by_default && geometry::is_chain(start.file.mesh)) {
    forget_default_cloth(scene);
    check_chain(scene.scene, start.file.mesh, context);
  }
  Reached reached = take_up(run, std::move(start));
  report.run = run_to_end(run, reached, animations, report);
  report.integrator = scene.scene.simulation.integrator;
  report.steps = run.chosen;
  const double written_from = physics::processor_seconds();
  conclude(run, reached, animations, steps_before, report);
  if (job.times) report.times = times_of(report.run, physics::processor_seconds() - written_from);
  report.settings = io::relocated(scene.document, scene.folder, "");
  return report;
}

std::optional<io::SavedState> run_until_drawn(const OpenScene& scene, const Context& context) {
  io::Scene silent = scene.scene;
  silent.output = {};
  silent.stop_at.reset();
  Run run{scene, silent, context, nullptr, false};
  AnimationSeries animations(silent.output, context.frame);
  SimulateReport report;
  Reached reached = take_up(run, begin(silent, context));
  for (;;) {
    draw_due_rounds(run, reached, animations, report);
    const io::SavedState& now = reached.now;
    if (now.lines_drawn == int(silent.lines.size()) || now.simulation.time >= silent.simulation.seconds)
      return std::move(reached.now);
    const Stretch stretch = simulate_to(next_stop(silent, now.lines_drawn), run, reached, animations);
    if (stretch.report.outcome == physics::Outcome::stopped_by_observer) return std::nullopt;
    if (stretch.report.outcome == physics::Outcome::diverged)
      throw std::runtime_error("the simulation diverged at " + std::to_string(stretch.report.time) +
                               " s, before its last lines; `furrow simulate` tells more");
  }
}

std::vector<CardRow> card(SimulateJob& job) {
  using enum Group;
  using enum Audience;
  return {
      {"state", motion, everyone, &job.state_path, "a saved state to go on from; then without a garment"},
      {"accuracy", motion, everyone, Share{[&job](double share) { job.tolerance = share; }},
       "error of the result that is accepted, as a share of the garment's diagonal, 1%: integrator and step "
       "are chosen for it"},
      {"budget", motion, few, &job.budget, positive,
       "predicted seconds of one thread that choosing for `accuracy=1%` may take [s]"},
      {"outputs_below", motion, few, &job.outputs_below,
       "folder that the outputs named by a scene file must lie in (default: the scene's own folder)"},
      {"times", motion, few, &job.times,
       "report what processor time went to: assembly, factorisation, solve, elements, contact, output"},
  };
}

}  // namespace furrow::jobs
