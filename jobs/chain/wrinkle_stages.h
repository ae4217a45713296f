// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/picture/render.h"
#include "jobs/chain/wrinkle.h"

namespace furrow::jobs {

/// What came to rest, without its body; else the mesh with its vertices inserted, before anything is
/// displaced, for which the report has stages. Faces that cross are marked.
io::RenderScene preview_scene(const WrinkleReport& report);
/// The garment as it was after insertion and before smoothing. The report has stages.
io::MeshFile inserted_garment(const WrinkleReport& report);

}  // namespace furrow::jobs
