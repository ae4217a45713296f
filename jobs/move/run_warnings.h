// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "io/mesh/mesh_file.h"
#include "io/scene/scene.h"
#include "jobs/move/simulate.h"

namespace furrow::jobs {

/// What is no error of a scene's run, and hardly what was meant.
std::vector<Warning> oddities_of(const io::Scene& scene, const physics::SimulateReport& report);

/// What makes a run that came to its end no success.
std::vector<Fault> faults_of(const io::Scene& scene, const ReachedShape& shape,
                             const physics::StrainStatistics& strain);

/// That the cloth kept more than the gap that was asked for [m], and what lowers it.
Warning raised_gap(const io::Scene& scene, const geometry::Mesh& garment, double gap, double field_tolerance);

/// Lines with a press where nothing has hinges to be pressed.
std::vector<Warning> idle_presses(const io::SceneMaterial& material, const io::WrinkleRecord& record);

/// That the body comes through the cloth of a shape that was reached, less deeply than is a fault.
std::optional<Warning> body_comes_through(const io::Scene& scene, const EndFacts& end);

/// That neither a body nor one of the run's pins holds the garment, which has weight.
std::optional<Warning> falls_freely(const io::Scene& scene, const std::vector<std::vector<int>>& pins);

/// That the run was broken off, and what was kept.
Warning interruption_of(const io::Scene& scene, const physics::SimulateReport& report);

/// Of a run with more than a tenth of its steps unsolved: such a motion is not to be trusted.
std::optional<Fault> unsolved_steps(const physics::SimulateReport& report);

/// Of a run that is blocked.
Fault words_of_block(const io::Scene& scene, const physics::SimulateReport& report);
/// That the run diverged, and what helps: a sentence.
std::string words_of_divergence(const io::Scene& scene, const physics::SimulateReport& report);

}  // namespace furrow::jobs
