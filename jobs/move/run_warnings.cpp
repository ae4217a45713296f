// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/run_warnings.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/base/figure_path.h"
#include "jobs/base/read_inputs.h"
#include "jobs/body/world_body.h"

namespace furrow::jobs {
namespace {

/// "(0.11, 1.32, -0.02) m".
std::string place(const physics::Vec3& x) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f}) m", x.x(), x.y(), x.z());
}

constexpr double most_strain = 0.5;  // that is not told
constexpr double for_a_moment = 2;   // times what is left at the end
constexpr double most_open = 0.1;    // of all steps, with which a motion is still one

Warning pierced_between_vertices(const io::Scene& scene, const BodyEnd& body) {
  return {"body_comes_through",
          io::stem_of(scene.garment) + ": " + words_of_piercing(body) +
              "; refine the garment where it is made (`furrow subdivide`), or keep it farther off (`gap`)",
          scene.garment.string(), "material.gap"};
}

/// Too many steps were not solved.
bool is_unsolved(const physics::SimulateReport& report) {
  return double(report.open_steps) > most_open * double(report.steps);
}

Warning told_open_steps(const physics::SimulateReport& report) {
  return {"steps_open",
          fmt::format("{} of {} steps {} not solved, even in 32 parts: look at the result where cloth lies "
                      "between parts of the body; take a shorter `dt`, or `integrator=leapfrog`",
                      report.open_steps, report.steps, report.open_steps == 1 ? "was" : "were"),
          "", "simulation.dt"};
}

/// That an edge was much longer on the way than it is at the end.
std::optional<Warning> stretched_on_the_way(const io::Scene& scene, const physics::SimulateReport& report) {
  const physics::LongestEdge& longest = report.longest_edge;
  if (longest.strain <= std::max(most_strain, for_a_moment * report.strain.max)) return std::nullopt;
  const bool implicit = physics::solves_contact(scene.simulation.integrator);
  return Warning{
      "stretched_on_the_way",
      fmt::format("an edge was strained by {:.0f} % at {:.2f} s, near {}, and is not any more; look at "
                  "an animation there, and {}",
                  100 * longest.strain, longest.time, place(longest.at),
                  implicit ? "take a shorter `dt`" : "let pins and body start slower"),
      "", implicit ? "simulation.dt" : ""};
}

std::string help_of_divergence(const io::Scene& scene, const physics::SimulateReport& report) {
  if (scene.simulation.dt) return "leave out `dt`";
  const std::string shorter = fmt::format("take shorter steps: `dt={:.1g}`", report.dt / 3);
  return scene.body ? "look for pins or cloth that start deep inside the body, or " + shorter : shorter;
}

}  // namespace

std::optional<Fault> unsolved_steps(const physics::SimulateReport& report) {
  if (!is_unsolved(report)) return std::nullopt;
  return Fault{"steps not solved", told_open_steps(report)};
}

std::vector<Warning> oddities_of(const io::Scene& scene, const physics::SimulateReport& report) {
  std::vector<Warning> found;
  if (report.strain.max > most_strain && report.strain.p99 <= 1)
    found.push_back(
        {"strained",
         "the cloth is strained by " + std::to_string(int(100 * report.strain.max)) +
             " % somewhere; look for lines that are far too high, or pins that do not go with the body",
         "", ""});
  if (auto stretched = stretched_on_the_way(scene, report)) found.push_back(*std::move(stretched));
  // RK4 blows up so slowly there that it may come to its end.
  if (scene.simulation.step_rule == physics::StepRule::forced && report.steps > 0 &&
      report.outcome != physics::Outcome::diverged && report.dt > report.dt_limit_smallest)
    found.push_back({"step_above_limit",
                     fmt::format("steps of {:.3g} s are above the limit of {:.3g} s, beyond which numbers "
                                 "grow and no motion is to be trusted; leave out `force_dt`",
                                 report.dt, report.dt_limit_smallest),
                     "", "simulation.force_dt"});
  if (report.open_steps > 0 && !is_unsolved(report)) found.push_back(told_open_steps(report));
  const bool body_moves = scene.body && !physics::at_rest(scene.body->motion);
  for (const io::ScenePins& pins : scene.pins)
    if (body_moves && physics::at_rest(pins.motion)) {
      found.push_back({"pins_stay_behind",
                       "the body moves and pins do not; give them the same motion if they belong to it",
                       "pins", "pins.motion"});
      break;
    }
  const physics::SimulateOptions& o = scene.simulation;
  if (physics::solves_contact(o.integrator) && o.spring_damping != physics::SimulateOptions().spring_damping)
    found.push_back({"damping_unused",
                     "implicit and tr-bdf2 have no damping of springs; drag damps (`drag`), or take leapfrog",
                     "", "material.damping"});
  if (!scene.wind.gusts.empty() && scene.wind.velocity.isZero())
    found.push_back({"gusts_without_wind", "gusts do nothing without wind", "forces.gusts", "forces.wind"});
  return found;
}

std::vector<Fault> faults_of(const io::Scene& scene, const ReachedShape& shape,
                             const physics::StrainStatistics& strain) {
  std::vector<Fault> faults;
  const std::string garment = scene.garment.string();
  if (!(strain.p99 <= 1))
    faults.push_back(
        {"torn",
         {"torn",
          fmt::format("the cloth is torn: a hundredth of its edges is strained by {:.0f} % and more, most at "
                      "{}; look for a body that is too large or moves too fast, pins that do not go with it, "
                      "lines that are far too high, and with xpbd at `sweeps` and `dt`",
                      100 * strain.p99, place(shape.strained_most)),
          garment, "body.mesh"}});
  if (shape.contact && shape.contact->inside.deepest > shape.contact->tolerance)
    faults.push_back(
        {"inside the body",
         {"inside_body",
          fmt::format(
              "{} vertices end inside the body, up to {} deep at {}; the garment is too small for the "
              "body, started inside it, or the body moves too fast: `furrow drape` finds out whether it "
              "can be worn, and `unit` and `up` say how the files are meant",
              shape.contact->inside.inside, geometry::length_text(shape.contact->inside.deepest),
              place(shape.contact->deepest_at)),
          garment, "unit"}});
  else if (shape.end.is_pierced(EndLimits{}))
    faults.push_back({"pierced by the body", pierced_between_vertices(scene, *shape.end.body)});
  if (shape.crossings.pairs > std::size_t(scene.allow_crossings))
    faults.push_back(
        {"cloth crosses itself",
         {"cloth_crosses",
          words(shape.crossings) +
              (scene.simulation.self.on
                   ? "; they were there at the start: draw or drape it without, or accept them with "
                   : "; cloth has no contact with cloth here: `self_contact=on` keeps it apart, or accept "
                     "them with ") +
              "`allow_crossings=" + std::to_string(shape.crossings.pairs) + "`",
          garment, "garment.allow_crossings"}});
  return faults;
}

Warning raised_gap(const io::Scene& scene, const geometry::Mesh& garment, double gap, double tolerance) {
  const double wanted = scene.simulation.contact_gap, sag = edge_sag(garment);
  const double finer = std::max(wanted, sag / 4 + 1.5 * tolerance);
  const bool long_edges = sag > tolerance;
  return {"gap_raised",
          "the cloth keeps " + geometry::length_text(gap) + " from the body, not " +
              geometry::length_text(wanted) + ", so strain and ease come out too large; " +
              (long_edges ? "its edges are long: with `subdivide=" + std::to_string(scene.subdivide + 1) +
                                "` it is " + geometry::length_text(finer)
                          : "`tolerance` asks for a finer field of the body"),
          scene.garment.string(), long_edges ? "garment.subdivide" : "body.tolerance"};
}

std::vector<Warning> idle_presses(const io::SceneMaterial& material, const io::WrinkleRecord& record) {
  std::vector<Warning> found;
  if (material.bending_law != bridge::Bending::cross) return found;
  for (const io::WrinkleRecord::Line& line : record.lines)
    if (line.press > 1)
      found.push_back({"idle_press",
                       "line '" + line.name +
                           "': its press has no effect, for cross springs have no hinges; choose a fabric, "
                           "or bending_law "
                           "hinge",
                       line.name, "material.bending_law"});
  return found;
}

std::optional<Warning> body_comes_through(const io::Scene& scene, const EndFacts& end) {
  if (!end.body || end.body->pierced_faces == 0 || end.is_pierced(EndLimits{})) return std::nullopt;
  return pierced_between_vertices(scene, *end.body);
}

std::optional<Warning> falls_freely(const io::Scene& scene, const std::vector<std::vector<int>>& pins) {
  if (scene.body || !pins.empty() || scene.simulation.gravity.isZero()) return std::nullopt;
  return Warning{
      "nothing_holds",
      io::stem_of(scene.garment) +
          ": falls, as there is neither a body nor a pin: name a body with `body`, or what is held "
          "with `pin_loop`, `pin_group`, `pin_box` or `pin_vertices`",
      scene.garment.string(), "body"};
}

Warning interruption_of(const io::Scene& scene, const physics::SimulateReport& report) {
  return {"interrupted",
          "interrupted at " + std::to_string(report.time) + " s; " +
              (scene.output.state.empty() ? "the shape reached was written; with `save_state` it could go on"
                                          : "the state reached was written"),
          "", "output.state"};
}

Fault words_of_block(const io::Scene& scene, const physics::SimulateReport& report) {
  return {
      "blocked",
      {"blocked",
       fmt::format("blocked at {:.4g} s, at {}: pins pull the cloth into itself there, and no step is left "
                   "that passes through nothing; lead them otherwise, or let cloth pass through cloth "
                   "(`self_contact=off`)",
                   report.time, place(report.blocked_at)),
       scene.garment.string(), "simulation.self_contact"}};
}

std::string words_of_divergence(const io::Scene& scene, const physics::SimulateReport& report) {
  if (report.held_by_cuts)
    return fmt::format(
        "the simulation is told as diverged at {:.4g} s: {} moves of vertices were cut so that cloth does "
        "not "
        "pass through cloth, more than a twentieth of all, so layers are pressed harder than steps of {:.3g} "
        "s "
        "can bear; the garment was not written; take shorter steps: `dt={:.1g}`",
        report.time, report.cut_moves, report.dt, report.dt / 3);
  return fmt::format(
      "the simulation diverged at {:g} s with steps of {:g} s (stable below {:g} s); the garment was not "
      "written; {}",
      report.time, report.dt, report.dt_limit, help_of_divergence(scene, report));
}

}  // namespace furrow::jobs
