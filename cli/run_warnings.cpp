// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/run_warnings.h"

#include <iostream>

namespace furrow::cli {

void warn_of_oddities(const io::Scene& scene, const physics::SimulateReport& report,
                      const CommonArguments& common) {
  if (report.strain.max > 0.5)
    warn("the cloth is strained by " + std::to_string(int(100 * report.strain.max)) +
             " % somewhere; look for lines that are far too high, or pins that do not go with the body",
         common);
  const bool body_moves = scene.body && !physics::at_rest(scene.body->motion);
  for (const io::ScenePins& pins : scene.pins)
    if (body_moves && physics::at_rest(pins.motion)) {
      warn("the body moves and pins do not; give them the same motion if they belong to it", common);
      break;
    }
  if (!scene.wind.gusts.empty() && scene.wind.velocity.isZero())
    warn("gusts do nothing without wind", common);
}

void warn_of_idle_press(const io::SceneMaterial& material, const io::WrinkleRecord& record,
                        const CommonArguments& common) {
  if (material.bending_law != bridge::Bending::cross) return;
  for (const io::WrinkleRecord::Line& line : record.lines)
    if (line.press > 1)
      warn(
          "line '" + line.name +
              "': its press has no effect, for cross springs have no hinges; choose a fabric, or bending_law "
              "hinge",
          common);
}

void warn_of_interruption(const io::Scene& scene, const physics::SimulateReport& report,
                          const CommonArguments& common) {
  warn("interrupted at " + std::to_string(report.time) + " s; " +
           (scene.output.state.empty() ? "the shape reached was written; with --save-state it could go on"
                                       : "the state reached was written"),
       common);
}

void tell_divergence(const io::Scene& scene, const physics::SimulateReport& report) {
  std::cerr << "error: the simulation diverged at " << report.time << " s with steps of " << report.dt
            << " s (stable below " << report.dt_limit << " s); the garment was not written; "
            << (scene.simulation.integrator == physics::Integrator::explicit_euler
                    ? "explicit Euler always does in the end: use leapfrog"
                : scene.simulation.dt ? "leave --dt away"
                                      : "look for pins or cloth that start deep inside the body")
            << "\n";
}

}  // namespace furrow::cli
