// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <vector>

#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// Writes how cloth moves as an animation, whole or not at all: runs a scene (motion.toml of save_motion())
/// once more, as furrow simulate does with --animation. `to`: a file in a format of animations, by its
/// ending; replaced if it is there. Returns the files: one more each time that lines were drawn on the way.
/// Throws physics::Cancelled, nothing written, if the listener cancels; std::runtime_error for a motion that
/// diverges, and as simulate(). Cost: that of the motion.
std::vector<std::filesystem::path> give_motion(const std::filesystem::path& scene,
                                               const std::filesystem::path& to, Listener& listener);

}  // namespace furrow::jobs
