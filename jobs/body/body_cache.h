// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include "geometry/figure/skeleton.h"
#include "jobs/body/world_body.h"

/// What is made of a body's file, kept in a folder for other runs (the setting body.cache). A file is named
/// by a hash of the version and of all that its content depends on. One run makes it while others wait; one
/// that is damaged is told of, and made again. Results are the same without, bit by bit, and so are warnings.
/// An empty folder, and a mesh in memory: nothing is kept.
namespace furrow::jobs {

/// As read_body().
physics::TriangleMesh kept_body(const std::filesystem::path& folder, const MeshInput& input,
                                const Context& context, BodyOutline* outline = nullptr);

/// The field that `make` makes of a body with these options.
physics::DistanceField kept_field(const std::filesystem::path& folder, const physics::TriangleMesh& body,
                                  const physics::DistanceFieldOptions& options, const Context& context,
                                  const std::function<physics::DistanceField()>& make);

/// The skeleton that `make` finds of a body.
geometry::Skeleton kept_skeleton(const std::filesystem::path& folder, const physics::TriangleMesh& body,
                                 const Context& context, const std::function<geometry::Skeleton()>& make);

}  // namespace furrow::jobs
