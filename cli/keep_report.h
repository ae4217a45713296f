// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/keep_lines.h"
#include "cli/common.h"
#include "io/mesh/wrinkle_record.h"
#include "io/picture/render.h"

namespace furrow::cli {

/// "held", "held with press x10", "held with struts of 3 N/m", "held at h = 4.2 mm", or "cannot hold, because
/// ...".
std::string words(const bridge::KeptLine& line);

/// A rest state's balance and stability.
Json to_json(const physics::PrestressReport& rest, const physics::Certificate& certificate);
Json to_json(const bridge::KeepReport& report, const io::WrinkleRecord& record);

/// The garment with its lines in the colours of their verdicts: green held, yellow pressed, orange struts,
/// blue lowered, red cannot hold.
io::RenderScene verdict_scene(const geometry::Mesh& mesh, const bridge::KeepReport& report);

/// exit_ok; exit_not_converged where a line cannot hold; exit_interrupted.
int exit_code_of(const bridge::KeepReport& report);

}  // namespace furrow::cli
