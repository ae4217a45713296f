// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/base/number_text.h"
#include "jobs/base/read_inputs.h"
#include "jobs/cloth/cost_table.h"
#include "physics/plate/plate_bending.h"

namespace furrow::jobs {
namespace {

using physics::Integrator;

constexpr double cheapest = 0.9;  // of leapfrog's limit

std::string text_of(double value) {
  std::string text;
  io::append_number(text, value);
  return text;
}

/// Three digits, never above: readable as a flag, and still stable.
double rounded_down_step(double dt) {
  const double unit = std::pow(10, std::floor(std::log10(dt)) - 2);
  return std::stod(fmt::format("{:.3g}", std::floor(dt / unit * (1 + 1e-12)) * unit));
}

/// The limit, or less: a step that is chosen without `dt` is at most dt_max, and halves and quarters are of
/// that one.
double usable(double dt_limit, const SceneCloth& scene) {
  return std::min(dt_limit, scene.options.dt_max / cheapest);
}

Candidate explicit_at(Integrator integrator, double factor, double dt_limit) {
  Candidate c;
  c.name = std::string(name_of(integrator)) + ", " + text_of(factor) + " of the limit";
  c.integrator = integrator;
  c.expected_dt = factor * dt_limit;
  if (integrator == Integrator::rk4) c.expected_dt *= physics::rk4_limit / 2;
  if (factor != cheapest) c.expected_dt = *(c.dt = rounded_down_step(c.expected_dt));
  return c;
}

int iterations_of(const physics::SimulateOptions& o, Integrator integrator) {
  if (integrator == Integrator::xpbd) return o.xpbd.iterations;
  return physics::solves_contact(integrator) ? physics::usual_iterations(integrator) : 0;
}

Candidate implicit_at(Integrator integrator, int steps_a_second, const SceneCloth& scene) {
  Candidate c;
  c.name = std::string(name_of(integrator)) + ", 1/" + std::to_string(steps_a_second) + " s";
  c.integrator = integrator;
  c.dt = c.expected_dt = 1.0 / steps_a_second;
  c.iterations = iterations_of(scene.options, integrator);
  return c;
}

/// The scene's own integrator and step, if it names what is not tried anyway.
std::optional<Candidate> scenes_own(const SceneCloth& scene, double dt_limit) {
  const physics::SimulateOptions& o = scene.options;
  if (!o.dt) return {};
  Candidate c;
  c.name = std::string(name_of(o.integrator)) + ", as the scene says";
  c.integrator = o.integrator;
  c.iterations = iterations_of(o, o.integrator);
  c.dt = o.dt;
  c.forced = o.step_rule == physics::StepRule::forced;
  c.expected_dt = o.dt.value_or(cheapest * dt_limit);
  return c;
}

double cost_with(const Work& work, Integrator integrator) {
  return cost_of(work, integrator == Integrator::rk4 ? costs.rk4_vertex_step : costs.vertex_step);
}

/// So many distances asked for, and the frames on the way.
void add_body(Work& w, const SceneCloth& scene, double queries, double seconds) {
  if (!scene.body) return;
  w.refitted = scene.body->triangles_until(seconds);
  (w.refitted > 0 ? w.frame_queries : w.queries) = queries;
}

double springs_of(const physics::Cloth& cloth) {
  return static_cast<double>(cloth.structural.size() + cloth.bending.size() + cloth.tension.size());
}

}  // namespace

const char* name_of(Integrator integrator) {
  switch (integrator) {
    case Integrator::leapfrog:
      return "leapfrog";
    case Integrator::rk4:
      return "rk4";
    case Integrator::xpbd:
      return "xpbd";
    case Integrator::implicit:
      return "implicit";
    case Integrator::tr_bdf2:
      return "tr-bdf2";
  }
  return "";
}

Candidate reference_candidate(const SceneCloth& scene, double dt_limit) {
  return explicit_at(Integrator::leapfrog, cheapest / 4, usable(dt_limit, scene));
}

std::vector<Candidate> candidates_for(const SceneCloth& scene, double dt_limit) {
  std::vector<Candidate> all;
  if (std::isfinite(dt_limit)) {
    all.push_back(explicit_at(Integrator::leapfrog, cheapest, usable(dt_limit, scene)));
    all.push_back(explicit_at(Integrator::leapfrog, cheapest / 2, usable(dt_limit, scene)));
    all.push_back(explicit_at(Integrator::rk4, cheapest, dt_limit));
  }
  if (scene.cloth.membrane.empty() && scene.cloth.tension.empty() && scene.cloth.hinges.empty() &&
      scene.cloth.energies.empty())
    for (int rate : {240, 1200}) all.push_back(implicit_at(Integrator::xpbd, rate, scene));
  for (int rate : {60, 240}) all.push_back(implicit_at(Integrator::implicit, rate, scene));
  for (int rate : {60, 120}) all.push_back(implicit_at(Integrator::tr_bdf2, rate, scene));
  if (auto own = scenes_own(scene, dt_limit)) all.push_back(*own);
  return all;
}

physics::SimulateOptions options_of(const Candidate& c, const SceneCloth& scene, double seconds) {
  physics::SimulateOptions o = scene.options;
  o.integrator = c.integrator;
  o.dt = c.dt;
  o.step_rule = c.forced ? physics::StepRule::forced : physics::StepRule::limited;
  o.seconds = seconds;
  o.stop_at.reset();
  return o;
}

std::string flags_of(const Candidate& c, bool scene_dt) {
  std::string flags = std::string("`integrator=") + name_of(c.integrator) + "`";
  const bool needs_dt = c.dt || scene_dt;
  if (needs_dt) flags += " `dt=" + text_of(c.dt.value_or(rounded_down_step(c.expected_dt))) + "`";
  if (c.integrator == Integrator::xpbd) flags += " `sweeps=" + std::to_string(c.iterations) + "`";
  return flags + (c.forced ? " `force_dt`" : "");
}

void set_candidate(io::TomlDocument& document, const Candidate& c) {
  io::set_value(document, "simulation.integrator", name_of(c.integrator), "`accuracy`");
  document.root["simulation"].erase("dt");
  document.root["simulation"].erase("force_dt");
  if (c.dt) io::set_value(document, "simulation.dt", *c.dt, "`accuracy`");
  if (c.forced) io::set_value(document, "simulation.force_dt", true, "`accuracy`");
  if (c.integrator == Integrator::xpbd)
    io::set_value(document, "simulation.sweeps", c.iterations, "`accuracy`");
}

double predicted_cost(const Candidate& c, const SceneCloth& scene, double seconds) {
  const physics::Cloth& cloth = scene.cloth;
  // Without dt no step is longer than dt_max; steps of equal length, as many as reach the end.
  const double usual = physics::solves_contact(c.integrator) ? physics::default_dt(c.integrator)
                                                             : std::min(c.expected_dt, scene.options.dt_max);
  const double dt = c.dt.value_or(usual);
  Work w;
  w.vertices = static_cast<double>(cloth.particles.size());
  w.steps = seconds / dt;
  const int solves = physics::solves_contact(c.integrator) ? c.iterations : 0;
  const double forces = w.steps * (c.integrator == Integrator::rk4 ? 4 : std::max(solves, 1));
  if (c.integrator == Integrator::xpbd) {
    w.sweeps = w.steps * c.iterations * springs_of(cloth);
  } else {
    w.springs = forces * springs_of(cloth);
    w.triangles = forces * static_cast<double>(cloth.membrane.size());
    w.hinges = forces * (static_cast<double>(cloth.hinges.size()) + physics::count_coupled(cloth));
  }
  add_body(w, scene, w.steps * std::max(scene.near_body / 2.0, w.vertices / 10), seconds);
  w.iterations = w.steps * solves;
  return cost_with(w, c.integrator);
}

double counted_cost(const physics::SimulateReport& r, const Candidate& c, const SceneCloth& scene) {
  Work w;
  w.vertices = static_cast<double>(scene.cloth.particles.size());
  w.steps = static_cast<double>(r.steps);
  w.springs = static_cast<double>(r.spring_evaluations);
  w.triangles = static_cast<double>(r.triangle_evaluations);
  w.hinges = static_cast<double>(r.hinge_evaluations);
  add_body(w, scene, static_cast<double>(r.collider_queries), r.time);
  w.iterations = static_cast<double>(r.factorisations);
  if (c.integrator == Integrator::xpbd)
    w.sweeps = static_cast<double>(r.iterations) * springs_of(scene.cloth);
  return cost_with(w, c.integrator);
}

}  // namespace furrow::jobs
