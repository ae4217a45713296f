// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/keeping/keep.h"
#include "io/picture/render.h"

namespace furrow::jobs {

/// The garment with its lines in the colours of their verdicts: green held, yellow pressed, orange struts,
/// blue lowered, violet may hold, red cannot hold, grey not known.
io::RenderScene verdict_scene(const geometry::Mesh& mesh, const bridge::KeepReport& report);

}  // namespace furrow::jobs
