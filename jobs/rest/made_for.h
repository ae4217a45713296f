// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/figure/skeleton.h"
#include "jobs/body/world_body.h"
#include "jobs/rest/drape.h"

namespace furrow::jobs {

/// The body that garments were made for, beside the one that they are brought to.
struct MadeFor {
  std::string path;
  geometry::Skeleton from, to;
  BodyOutline outline;  ///< of the file of the former
};

/// Throws std::invalid_argument where one is named, and the scene has no body to bring a garment to.
void check_made_for(const std::filesystem::path& made_for, const io::Scene& scene);

/// Reads the former, in the garment's unit, and finds both skeletons. `file`: of the other body. Throws
/// geometry::ContentError, naming the file, for a body without what places a garment.
MadeFor read_made_for(const std::filesystem::path& path, const physics::TriangleMesh& body,
                      const io::SceneBody& file, const Context& context);

/// Where a garment begins.
struct PlacedStart {
  std::vector<physics::Vec3> places;  ///< by vertex [m]
  Placed report;
};

/// Brings a garment from the body that it was made for to the other one (geometry::place_garment()); warns of
/// limbs that cloth goes around and that are held otherwise. `name`: the garment's file.
PlacedStart place(const geometry::Mesh& garment, const MadeFor& made_for, const BodyCollider& body,
                  const std::string& name, const Context& context);

/// The mesh at other places, one a vertex; as it is without.
geometry::Mesh at_places(geometry::Mesh mesh, std::span<const physics::Vec3> places);

Json to_json(const Placed& placed);

}  // namespace furrow::jobs
