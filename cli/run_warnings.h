// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cli/common.h"
#include "io/mesh/wrinkle_record.h"
#include "io/scene/scene.h"

namespace furrow::cli {

/// Warns of what is no error of a scene's run, and hardly what was meant.
void warn_of_oddities(const io::Scene& scene, const physics::SimulateReport& report,
                      const CommonArguments& common);

/// Warns of lines with a press where nothing has hinges to be pressed.
void warn_of_idle_press(const io::SceneMaterial& material, const io::WrinkleRecord& record,
                        const CommonArguments& common);

/// Warns that the run was broken off by the user, and says what was kept.
void warn_of_interruption(const io::Scene& scene, const physics::SimulateReport& report,
                          const CommonArguments& common);

/// Says on stderr that the run diverged, and what helps.
void tell_divergence(const io::Scene& scene, const physics::SimulateReport& report);

}  // namespace furrow::cli
