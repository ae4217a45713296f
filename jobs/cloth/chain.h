// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/struts.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/scene.h"
#include "jobs/base/inputs.h"

/// Garments without faces (geometry::is_chain): threads, whose struts are their links.
namespace furrow::jobs {

/// A chain's struts or, where it has none, a link of stiffness 0 for each part of its file's lines, of the
/// length that it has there; each pair of vertices once. Throws geometry::ContentError for a part without
/// length.
std::vector<geometry::Strut> chain_links(const io::MeshFile& file);

/// Gives a chain without struts those of chain_links(), of stiffness EA / length, and masses, half of a
/// link's to either end, where it has none. `line_stretch` and `line_density` of the material, where they are
/// said, change a chain that has these already. Throws as chain_links(), and if there are no links.
void complete_chain(io::MeshFile& file, const io::SceneMaterial& material);

/// Sum of the rest lengths [m].
double length_of(const std::vector<geometry::Strut>& links);

/// Throws std::invalid_argument if the scene asks for what a chain has no faces for; warns of settings that
/// do nothing on a chain or, of those of chains, on cloth.
void check_chain(const io::Scene& scene, const geometry::Mesh& mesh, const Context& context);

/// Throws geometry::ContentError, naming the file, for a chain.
void refuse_chain(const geometry::Mesh& mesh, const std::string& name);

}  // namespace furrow::jobs
