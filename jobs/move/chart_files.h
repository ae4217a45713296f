// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/move/judge.h"

namespace furrow::jobs {

/// One row a candidate, the reference last: name, integrator, dt [s], cost, error and which it is, all
/// distances [-], verdict. Throws std::runtime_error if it cannot be written.
void write_chart_csv(const std::string& path, const Judgement& j);

/// Throws std::invalid_argument for a picture that is not named .svg or .png, std::runtime_error without its
/// folder or without gnuplot, which draws it.
void check_chart_picture(const std::string& path);

/// Draws cost against error, both logarithmic: what diverged on the upper edge, the tolerance as a line, the
/// chosen setting in a ring. Throws std::runtime_error if gnuplot fails.
void draw_chart(const std::string& path, const Judgement& j, const std::string& title);

}  // namespace furrow::jobs
