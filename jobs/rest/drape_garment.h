// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/body/world_body.h"
#include "jobs/rest/drape.h"

namespace furrow::jobs {

/// Reads a scene's garment, fits it on the body (null: it hangs from its pins) and measures how it fits.
/// Shows progress; an interrupt stops it, what was reached is returned. Bands become struts of the garment,
/// in place of those that its loop had. Throws as reading, bridge::drape() and bridge::fit_report() do.
/// `choose`: it is refined as often as the gap needs (refinements_for_gap()), in place of scene.subdivide.
Draped drape_garment(const io::Scene& scene, const BodyCollider* body, const DrapeSettings& settings,
                     bool choose, const Context& context);

/// DrapeOptions::soft_start of a garment: 30 where its file notes lines of the rule `fold` and pins hold it,
/// else 1. What friction alone holds would be held where soft cloth came to lie, stretched and crumpled.
double soft_start_of(const io::MeshFile& garment, bool pinned);

/// The least number of Loop refinements with which a garment's edges let it keep the gap that is wanted, to a
/// tenth, from a body whose field has this tolerance [m]; of 0 to 4, as many as leave it below 60,000
/// vertices (some 20 s). 0 for a garment with a rest state of its own, which refinement would replace by its
/// shape.
int refinements_for_gap(const geometry::Mesh& garment, double wanted, double field_tolerance);

/// With how many refinements all faces are smaller than one with edges of 1.5 times `finest` [m]; at most 6,
/// and as many as leave the mesh below a million vertices.
int refinements_for_edges(const geometry::Mesh& garment, double finest);

}  // namespace furrow::jobs
