// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/garment_maker.h"

#include <algorithm>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather.h"
#include "bridge/arrays/reactions.h"
#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/parts.h"
#include "geometry/mesh/struts.h"
#include "geometry/refine/local_refinement.h"
#include "geometry/refine/subdivide.h"
#include "jobs/base/read_inputs.h"
#include "jobs/cloth/attach_parts.h"
#include "jobs/cloth/pins.h"
#include "jobs/cloth/prepare_garment.h"
#include "jobs/cloth/scene_cloth.h"
#include "jobs/rest/made_for.h"
#include "physics/body/collider.h"
#include "physics/cloth/elastic_band.h"
#include "physics/cloth/patch_membrane.h"
#include "physics/cloth/pins.h"

namespace furrow::jobs {
namespace {

/// A vertex of the loop that a name means on the mesh as it was read: refinement keeps its index, but may
/// change which loop is the longest.
int vertex_of_loop(const geometry::Mesh& mesh, const std::string& name) {
  const auto loops = geometry::border_loops(mesh);
  return int(loops[geometry::find_border_loop(loops, name)].vertices.at(0));
}

std::vector<int> loop_through(const geometry::Mesh& mesh, int vertex) {
  for (const geometry::BorderLoop& loop : geometry::border_loops(mesh)) {
    std::vector<int> vertices;
    for (const geometry::Vertex v : loop.vertices) vertices.push_back(int(v));
    if (std::find(vertices.begin(), vertices.end(), vertex) != vertices.end()) return vertices;
  }
  return {};
}

/// As struts, so that the garment's file has them; a band that was there is taken off. Returns its springs.
std::vector<physics::Spring> sew_band(geometry::Mesh& mesh, const std::vector<int>& loop,
                                      const physics::ElasticBandOptions& options) {
  physics::Cloth band;
  band.particles.x = bridge::positions_of(mesh);
  physics::add_elastic_band(band, loop, options);
  std::vector<geometry::Strut> all = geometry::struts(mesh);
  std::erase_if(all, [&](const geometry::Strut& s) {
    return std::any_of(band.bending.begin(), band.bending.end(),
                       [&](const physics::Spring& b) { return int(s.a) == b.a && int(s.b) == b.b; });
  });
  using Index = geometry::Vertex::size_type;
  for (const physics::Spring& s : band.bending)
    all.push_back({geometry::Vertex(Index(s.a)), geometry::Vertex(Index(s.b)), s.rest_length, s.stiffness});
  geometry::set_struts(mesh, all);
  return band.bending;
}

std::string name_of(const io::ScenePins& pins) {
  if (!pins.loop.empty()) return pins.loop;
  if (!pins.group.empty()) return pins.group;
  return pins.box.empty() ? "vertices" : "box";
}

}  // namespace

GarmentMaker::GarmentMaker(const io::Scene& scene, const BodyCollider* body, const DrapeSettings& settings,
                           const io::MeshFile& as_read, const Context& context,
                           std::span<const physics::Vec3> places)
    : scene_(scene), body_(body), settings_(settings), as_read_(as_read), context_(context), places_(places) {
  for (const io::ScenePins& pins : scene.pins)
    pin_vertices_.push_back(pins.loop.empty() ? -1 : vertex_of_loop(as_read.mesh, pins.loop));
  for (const Band& band : settings.bands) try {
      band_vertices_.push_back(vertex_of_loop(as_read.mesh, band.loop));
    } catch (const std::invalid_argument& e) {
      throw std::invalid_argument("`band`: " + std::string(e.what()));
    }
}

physics::Cloth GarmentMaker::operator()(geometry::Mesh& mesh) {
  made = as_read_;
  made.mesh = mesh;
  pins_ = find_pins(made, pins_on(mesh));
  complete_garment(made, scene_.material);
  tie_seams(mesh);
  if (scene_.attach.on) tie_refined_ends(made.mesh, as_read_.mesh, scene_.material);
  bands_.clear();
  for (std::size_t i = 0; i < band_vertices_.size(); ++i)
    bands_.push_back(sew_band(made.mesh, loop_through(mesh, band_vertices_[i]),
                              {settings_.bands[i].length, settings_.band_stiffness}));
  physics::Cloth cloth = naming(scene_.garment.string(), [&] {
    return bridge::gather(made.mesh, spring_options(made, scene_.material));
  });
  if (!places_.empty()) bring_to_places(mesh, cloth);
  pin_cloth(cloth, pins_, nullptr, 0, context_);
  held_.assign(cloth.particles.size(), 0);
  for (const std::vector<int>& held : pins_)
    for (const int i : held) held_[std::size_t(i)] = 1;
  for (const physics::Rider& rider : cloth.riders) held_[std::size_t(rider.particle)] = 1;
  if (!loose.empty()) hold_loose(mesh, cloth);
  if (scene_.material.membrane == bridge::Membrane::patches) physics::join_patches(cloth);
  told_thin_ |= couple_cloth(made, scene_, cloth, context_, !told_thin_);  // once, not at each level
  if (!loose.empty() && settings_.animation.empty()) leave_out_loose(mesh, cloth);
  int moved = 0;
  if (body_)
    for (const std::vector<int>& held : pins_)
      moved += physics::push_out(cloth.particles.x, held, body_->exact).moved;
  if (moved)
    context_.warn("pins_inside_body",
                  std::to_string(moved) + " of " + std::to_string(mesh.number_of_vertices()) +
                      " vertices are pinned inside the body; moved onto it",
                  "pins");
  mesh = made.mesh;
  return cloth;
}

DrapeForces GarmentMaker::forces_on(const physics::Cloth& cloth) const {
  const bridge::Reactions found = bridge::reactions(cloth, scene_.simulation.gravity, pins_);
  DrapeForces forces{found.weight, found.contact};
  for (std::size_t i = 0; i < pins_.size(); ++i)
    forces.pins.push_back({name_of(scene_.pins[i]), found.held[i]});
  for (std::size_t i = 0; i < bands_.size(); ++i)
    forces.bands.push_back({settings_.bands[i].loop, bridge::mean_tension(bands_[i], cloth.particles.x)});
  return forces;
}

bool GarmentMaker::any_held() const {
  return std::any_of(pins_.begin(), pins_.end(), [](const auto& held) { return !held.empty(); });
}

/// Those of the level; the finer one's are found by what this one is.
void GarmentMaker::tie_seams(const geometry::Mesh& mesh) {
  if (mesh.num_vertices() == as_read_.mesh->num_vertices())
    ties_ = seam_ties(as_read_.mesh);
  else
    ties_ = refined_ties(tied_, ties_);
  if (ties_.empty()) return;
  tied_ = mesh;
  set_seam_ties(made.mesh, ties_, scene_.material);
}

/// Refined as the garment is, level by level.
void GarmentMaker::bring_to_places(const geometry::Mesh& mesh, physics::Cloth& cloth) {
  if (at_places_.num_vertices() == 0 || mesh.num_vertices() == as_read_.mesh->num_vertices())
    at_places_ = at_places(as_read_.mesh, places_);
  const auto index = geometry::uniform_indices(mesh);
  const auto is_coarse = [&](geometry::Vertex v) {
    return std::size_t((*index)[v]) >= at_places_.num_vertices();
  };
  while (index ? std::any_of(mesh.vertices_begin(), mesh.vertices_end(), is_coarse)
               : at_places_.num_vertices() < mesh.num_vertices())
    geometry::loop_subdivide(at_places_, 1);
  cloth.particles.x = geometry::take_of_uniform(mesh, bridge::positions_of(at_places_));
}

void GarmentMaker::hold_loose(const geometry::Mesh& mesh, physics::Cloth& cloth) const {
  const geometry::Parts parts = geometry::find_parts(mesh);
  for (const int seed : loose)
    for (std::size_t i = 0; i < parts.of_vertex.size(); ++i)
      if (parts.of_vertex[i] == parts.of_vertex[std::size_t(seed)])
        physics::pin(cloth.particles, std::vector<int>{int(i)});
}

/// No cloth touches them: where they lie aside is no place of theirs.
void GarmentMaker::leave_out_loose(const geometry::Mesh& mesh, physics::Cloth& cloth) const {
  const geometry::Parts parts = geometry::find_parts(mesh);
  std::vector<char> aside(parts.list.size(), 0);
  for (const int seed : loose) aside[std::size_t(parts.of_vertex[std::size_t(seed)])] = 1;
  std::erase_if(cloth.triangles,
                [&](const auto& t) { return aside[std::size_t(parts.of_vertex[std::size_t(t[0])])] != 0; });
}

std::vector<io::ScenePins> GarmentMaker::pins_on(const geometry::Mesh& mesh) const {
  std::vector<io::ScenePins> result = scene_.pins;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (pin_vertices_[i] < 0) continue;
    const std::vector<int> loop = loop_through(mesh, pin_vertices_[i]);
    result[i].loop.clear();
    result[i].vertices.insert(result[i].vertices.end(), loop.begin(), loop.end());
  }
  return result;
}

bridge::MakeCloth keeping_below(std::unique_ptr<GarmentMaker>& maker, std::unique_ptr<GarmentMaker>& below) {
  return [&](geometry::Mesh& mesh) {
    below = std::make_unique<GarmentMaker>(*maker);
    return (*maker)(mesh);
  };
}

void go_back_to(const geometry::Mesh& end, std::unique_ptr<GarmentMaker>& maker,
                std::unique_ptr<GarmentMaker>& below) {
  if (maker->made.mesh->number_of_vertices() != end.number_of_vertices()) maker = std::move(below);
}

}  // namespace furrow::jobs
