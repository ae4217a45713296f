// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "jobs/base/seam_ties.h"
#include "jobs/body/world_body.h"
#include "jobs/rest/drape.h"

namespace furrow::jobs {

/// Makes cloth of a garment on each level of a drape; pins and bands are found again there. What it is made
/// with must outlive it.
class GarmentMaker {
 public:
  /// body: null, or what pins are moved out of. places: where the garment begins, by vertex [m], refined as
  /// it is; its rest shape is as it was read. Empty: where it lies. Throws std::invalid_argument for a pin's
  /// or a band's loop that the garment does not have.
  GarmentMaker(const io::Scene& scene, const BodyCollider* body, const DrapeSettings& settings,
               const io::MeshFile& as_read, const Context& context,
               std::span<const physics::Vec3> places = {});

  /// The mesh gets the maps that the cloth is made of.
  physics::Cloth operator()(geometry::Mesh& mesh);

  /// Whether a pin holds one of the last level's particles.
  bool any_held() const;
  /// By particle of the last level: a pin holds it, or it rides on other cloth.
  const std::vector<char>& held() const { return held_; }
  /// On the cloth of the last level, as it lies.
  DrapeForces forces_on(const physics::Cloth& cloth) const;

  io::MeshFile made;       ///< of the last level
  std::vector<int> loose;  ///< a vertex of each part that nothing holds: those parts are held as they lie

 private:
  void tie_seams(const geometry::Mesh& mesh);
  void hold_loose(const geometry::Mesh& mesh, physics::Cloth& cloth) const;
  void leave_out_loose(const geometry::Mesh& mesh, physics::Cloth& cloth) const;
  std::vector<io::ScenePins> pins_on(const geometry::Mesh& mesh) const;
  void bring_to_places(const geometry::Mesh& mesh, physics::Cloth& cloth);

  const io::Scene& scene_;
  const BodyCollider* body_;
  const DrapeSettings& settings_;
  const io::MeshFile& as_read_;
  const Context& context_;
  std::span<const physics::Vec3> places_;
  geometry::Mesh at_places_;  ///< of the level
  std::vector<int> pin_vertices_, band_vertices_;
  std::vector<std::vector<int>> pins_;               ///< of the level
  std::vector<std::vector<physics::Spring>> bands_;  ///< of the level
  SeamTies ties_;
  geometry::Mesh tied_;  ///< of the level that has them
  std::vector<char> held_;
  bool told_thin_ = false;
};

/// Makes the cloth of each level with `maker`, and keeps in `below` what it was before: the maker of the
/// level below, for a drape that turns back on its way up.
bridge::MakeCloth keeping_below(std::unique_ptr<GarmentMaker>& maker, std::unique_ptr<GarmentMaker>& below);
/// What was below becomes the maker, if the drape ended with that level's mesh.
void go_back_to(const geometry::Mesh& end, std::unique_ptr<GarmentMaker>& maker,
                std::unique_ptr<GarmentMaker>& below);

}  // namespace furrow::jobs
