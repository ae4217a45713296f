// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/picture/render.h"
#include "jobs/chain/wrinkle.h"

namespace furrow::jobs {

/// The mesh with its vertices inserted as a picture, before anything is displaced. The report has stages.
io::RenderScene preview_scene(const WrinkleReport& report);
/// The garment as it was after insertion and before smoothing. The report has stages.
io::MeshFile inserted_garment(const WrinkleReport& report);

}  // namespace furrow::jobs
