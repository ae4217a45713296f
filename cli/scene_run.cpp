// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/scene_run.h"

#include <algorithm>

#include "bridge/scatter.h"
#include "cli/animation_series.h"
#include "cli/keep_at_rest.h"
#include "cli/line_round.h"
#include "cli/pins.h"
#include "cli/prepare_garment.h"
#include "cli/recorded_material.h"
#include "cli/run_warnings.h"
#include "cli/scene_cloth.h"
#include "cli/simulate_report.h"
#include "cli/wrinkle_reports.h"
#include "io/mesh/ply_motion.h"
#include "io/mesh/wrinkle_record.h"
#include "io/scene/equivalent_flags.h"
#include "io/scene/relocated.h"

namespace furrow::cli {
namespace {

class SceneRun {
 public:
  SceneRun(const io::Scene& scene, const io::TomlDocument& document, std::filesystem::path folder,
           std::string state_path, const CommonArguments& common, std::shared_ptr<WorldBody> body,
           const Json& choice)
      : scene_(scene),
        document_(document),
        folder_(std::move(folder)),
        state_path_(std::move(state_path)),
        common_(common),
        choice_(choice),
        body_(std::move(body)),
        animations_(scene.output, common) {}

  int run(std::optional<io::SavedState> saved) {
    catch_interrupts();
    resumed_ = saved.has_value();
    if (saved) {
      settings_before_ = io::relocated(io::document_of(saved->scene, state_path_),
                                       std::filesystem::path(state_path_).parent_path(), "");
      now_ = std::move(*saved);
      steps_before_ = now_.simulation.step;
    } else
      begin();
    load_inputs();
    try {
      while (draw_due_lines() && simulate_to(next_stop()) &&
             now_.simulation.time < scene_.simulation.seconds && !stopped_) {
      }
    } catch (const std::exception&) {  // a round of lines that cannot be drawn
      if (now_.simulation.step > 0 && !scene_.output.state.empty()) {
        write_state();
        warn("the state reached at " + std::to_string(now_.simulation.time) + " s was written to " +
                 scene_.output.state.string(),
             common_);
      }
      throw;
    }
    return finish();
  }

  /// Nothing if it was interrupted.
  std::optional<io::SavedState> run_until_drawn() {
    catch_interrupts();
    begin();
    load_inputs();
    while (draw_due_lines() && now_.lines_drawn < static_cast<int>(scene_.lines.size()) &&
           now_.simulation.time < scene_.simulation.seconds)
      if (!simulate_to(next_stop())) {
        if (report_.outcome == physics::Outcome::stopped_by_observer) return std::nullopt;
        throw std::runtime_error("the simulation diverged at " + std::to_string(report_.time) +
                                 " s, before its last lines; furrow simulate tells more");
      }
    return std::move(now_);
  }

 private:
  void load_inputs() {
    load_body_and_pins();
    heights_ = line_heights_by_id(now_.file);
    strokes_ = read_rounds(scene_, now_.lines_drawn, common_);
  }

  void begin() {
    now_.file = begin_garment(scene_, common_);
    if (!scene_.output.state.empty()) io::check_state_attributes(now_.file.mesh);
  }

  void load_body_and_pins() {
    if (scene_.body && !body_) body_ = std::make_shared<WorldBody>(*scene_.body, common_);
    if (resumed_ && now_.pins.size() != scene_.pins.size())
      throw UsageError("the state has " + std::to_string(now_.pins.size()) + " sets of pins, the scene " +
                       std::to_string(scene_.pins.size()) + "; go on with the same pins");
    if (!resumed_) now_.pins = find_pins(now_.file, scene_.pins);
    const std::string body = body_ ? body_->fingerprint() : "";
    if (now_.body != body) now_.simulation.contact.clear();
    if (now_.body != body) now_.simulation.body_travel = now_.contact_gap = 0;
    now_.body = body;
    if (resumed_)
      change_plan();
    else if (body_)
      warn_if_apart(scene_, *body_, now_.file.mesh, common_);
  }

  /// What is not the state's any more.
  void change_plan() {
    const auto value = [](const Json& settings, const char* key) {
      return settings.contains(key) ? settings[key] : Json();
    };
    if (value(now_.scene, "pins") != value(document_.root, "pins")) now_.simulation.homes.clear();
    if (value(value(now_.scene, "material"), "gap") != value(value(document_.root, "material"), "gap"))
      now_.contact_gap = 0;
    const auto density = scene_.material.density;
    if (density && *density != io::find_wrinkle_record(now_.file)->density)
      complete_garment(now_.file, scene_.material);
  }

  /// Draws the rounds of lines whose time has come.
  bool draw_due_lines() {
    const auto& rounds = scene_.lines;
    while (now_.lines_drawn < static_cast<int>(rounds.size()) &&
           rounds[now_.lines_drawn].time <= now_.simulation.time)
      draw(rounds[now_.lines_drawn], strokes_[now_.lines_drawn]);
    if (now_.simulation.step == 0 && !resumed_) start_simulation();
    return true;
  }

  void draw(const io::SceneLines& lines, const std::vector<io::DrawnStroke>& strokes) {
    const bool moving = now_.simulation.step > 0;
    animations_.finish();
    if (moving) now_ = io::parse_state(io::state_bytes(std::move(now_)), "state");  // as if it had been saved
    const std::size_t old_count = now_.file.mesh.number_of_vertices();
    LineTarget target{
        now_.file, scene_.subdivide ? "" : scene_.garment.string(), scene_.material.density, nullptr, {}};
    if (moving) {
      target.moving = &now_.simulation;
      target.springs = spring_options(now_.file, scene_.material);
      target.pins = now_.pins;
    }
    const LineRound round = draw_lines(
        target, strokes, lines,
        lines.time == 0 ? stage_writer(scene_.output, now_.file, common_) : geometry::StageObserver{});
    pin_new_vertices(now_.file.mesh, old_count, now_.pins);
    ++now_.lines_drawn;
    for (const std::string& w : round.warnings) warn(w, common_);
    Json json = to_json(round.report, now_.file.mesh, round.first_line);
    if (round.moving) json["moving"] = to_json(*round.moving, now_.simulation.time);
    if (lines.keep && (moving || resumed_)) json["kept"] = keep_shape(&now_.simulation);
    rounds_.push_back(std::move(json));
    if (moving) heights_ = line_heights_by_id(now_.file);
  }

  Json keep_shape(physics::SimulateState* moving) {
    return keep_at_rest(now_.file, scene_, now_.pins, body_.get(), now_.simulation.time, now_.contact_gap,
                        moving, common_);
  }

  /// The garment is complete now: masses and springs, pins out of the body.
  void start_simulation() {
    complete_garment(now_.file, scene_.material);
    if (keeps_first_shape(scene_)) kept_ = keep_shape(nullptr);
    heights_ = line_heights_by_id(now_.file);
    started_ = true;
  }

  double next_stop() const {
    double stop = scene_.simulation.seconds;
    const auto& rounds = scene_.lines;
    if (now_.lines_drawn < static_cast<int>(rounds.size()))
      stop = std::min(stop, rounds[now_.lines_drawn].time);
    if (scene_.stop_at) stop = std::min(stop, *scene_.stop_at);
    return stop;
  }

  /// Whether the simulation is to go on after it.
  bool simulate_to(double stop) {
    physics::Cloth cloth = bridge::gather(now_.file.mesh, spring_options(now_.file, scene_.material));
    pin_cloth(cloth, now_.pins, started_ ? body_.get() : nullptr, now_.simulation.time, common_);
    started_ = false;
    physics::SimulateOptions options = scene_.simulation;
    if (body_)
      options.contact_gap = now_.contact_gap =
          std::max(now_.contact_gap, contact_gap(options.contact_gap, body_->tolerance(), now_.file));
    if (stop < options.seconds) options.stop_at = stop;
    options.threads = threads_of(scene_, cloth.particles.size());
    if (animations_.is_on()) options.observe_steps = 20;  // frames are interpolated between observed times
    animations_.start(now_.file.mesh, now_.simulation.time, cloth.particles.x);
    const physics::World world = world_of(scene_, body_.get(), now_.pins);
    Progress progress("simulating", common_);
    report_ =
        physics::simulate(cloth, world, options, &now_.simulation, [&](const physics::SimulateProgress& p) {
          progress.show(p.time / scene_.simulation.seconds);
          animations_.observe(p.time, cloth.particles.x);
          return !interrupted();
        });
    bridge::scatter(cloth.particles, now_.file.mesh);
    bridge::scatter_velocities(cloth.particles, now_.file.mesh);
    stopped_ = report_.outcome == physics::Outcome::stopped_at && scene_.stop_at &&
               now_.simulation.time >= *scene_.stop_at;
    return report_.outcome == physics::Outcome::finished || report_.outcome == physics::Outcome::stopped_at;
  }

  int finish() {
    const bool diverged = report_.outcome == physics::Outcome::diverged;
    if (!diverged) write_outputs();
    Json json = Json::object();
    if (!scene_.title.empty()) json["title"] = scene_.title;
    json.update(to_json(report_, now_.file, *io::find_wrinkle_record(now_.file), heights_, body_.get(),
                        now_.contact_gap));
    if (!kept_.is_null()) json["kept"] = kept_;
    if (!rounds_.empty()) json["rounds"] = rounds_;
    if (!animations_.reports().empty()) json["animations"] = animations_.reports();
    if (!choice_.is_null()) json["choice"] = choice_;
    json["flags"] =
        io::equivalent_flags(io::relocated(document_, folder_, ""), state_path_, settings_before_);
    print_report(json, common_);
    if (diverged) {
      tell_divergence(scene_, report_);
      return exit_not_converged;
    }
    warn_of_oddities(scene_, report_, common_);
    warn_of_idle_press(scene_.material, *io::find_wrinkle_record(now_.file), common_);
    if (resumed_ && report_.time >= scene_.simulation.seconds && report_.steps == steps_before_)
      warn("the state is at the end already; --seconds puts that off", common_);
    if (report_.outcome == physics::Outcome::stopped_by_observer) {
      warn_of_interruption(scene_, report_, common_);
      return exit_interrupted;
    }
    return exit_ok;
  }

  void write_outputs() {
    const io::SceneOutput& out = scene_.output;
    if (!out.state.empty()) write_state();
    animations_.finish();
    io::drop_motion(now_.file);
    if (body_ && !out.body.empty())
      write_mesh(out.body.string(), body_->at(now_.simulation.time, common_), common_);
    note_material(now_.file, document_, body_ ? now_.contact_gap : 0);
    if (!out.mesh.empty()) write_mesh(out.mesh.string(), now_.file, common_);
  }

  void write_state() const {
    const std::filesystem::path& path = scene_.output.state;
    io::SavedState state = now_;
    state.scene = io::relocated(document_, folder_, path.parent_path());
    state.scene.erase("output");  // it and stop_at belong to one call
    if (state.scene.contains("simulation")) state.scene["simulation"].erase("stop_at");
    io::write_state(path, std::move(state));
  }

  const io::Scene& scene_;
  const io::TomlDocument& document_;
  std::filesystem::path folder_;
  std::string state_path_;
  Json settings_before_;  ///< of the state that is gone on from
  const CommonArguments& common_;
  const Json choice_;
  io::SavedState now_;
  bool resumed_ = false, started_ = false, stopped_ = false;
  std::shared_ptr<WorldBody> body_;
  std::int64_t steps_before_ = 0;
  std::vector<double> heights_;
  std::vector<std::vector<io::DrawnStroke>> strokes_;  ///< of each round
  physics::SimulateReport report_;
  Json rounds_ = Json::array(), kept_;
  AnimationSeries animations_;
};

}  // namespace

int run_scene(const io::Scene& scene, const io::TomlDocument& document, const std::filesystem::path& folder,
              std::optional<io::SavedState> state, const std::string& state_path,
              const CommonArguments& common, std::shared_ptr<WorldBody> body, const Json& choice) {
  return SceneRun(scene, document, folder, state_path, common, std::move(body), choice).run(std::move(state));
}

std::optional<io::SavedState> run_until_drawn(const io::Scene& scene, const io::TomlDocument& document,
                                              const std::filesystem::path& folder,
                                              const CommonArguments& common) {
  io::Scene silent = scene;
  silent.output = {};
  silent.stop_at.reset();
  return SceneRun(silent, document, folder, "", common, nullptr, {}).run_until_drawn();
}

}  // namespace furrow::cli
