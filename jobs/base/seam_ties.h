// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "io/mesh/mesh_file.h"
#include "io/scene/scene.h"
#include "jobs/base/inputs.h"

/// Where three or more faces meet at an edge, reading parts the mesh (its vertices are doubled), and cloth
/// would fall apart there. Ties hold it together: struts without length to speak of, which files and states
/// keep as they keep every strut.
namespace furrow::jobs {

/// Pairs of vertices that are tied, the lower one first.
using SeamTies = std::vector<std::array<geometry::Vertex, 2>>;

/// Vertices that reading doubled, each with the one that it is a copy of. O(V log V).
SeamTies doubled_vertices(const io::MeshFile& file);

/// The ties that a mesh has. O(struts).
SeamTies seam_ties(const geometry::Mesh& mesh);

/// Both of these; warns, with the file's name, of what reading doubled.
SeamTies all_ties(const io::MeshFile& file, const std::string& name, const Context& context);

/// Warns where a mesh with ties is written to a file that does not keep them; an empty name: none is.
void warn_of_lost_ties(const geometry::Mesh& mesh, const std::filesystem::path& output, Listener& listener);

/// The ties after one step of loop_subdivide() or midpoint_subdivide() of the mesh: those there are, and of
/// the mid-points of edges whose ends are tied. O(V + E log E).
SeamTies refined_ties(const geometry::Mesh& before, const SeamTies& ties);

/// How stiff ties are: as the material's springs [N/m].
double tie_stiffness(const io::SceneMaterial& material);

/// Adds them as struts of that stiffness; other struts stay, ties that were there are replaced.
void set_seam_ties(geometry::Mesh& mesh, const SeamTies& ties, const io::SceneMaterial& material);

/// Draws tied vertices that lie at one place apart, each towards its own faces by a hundredth of a
/// micrometre: a spring without any length has no direction, and no step limit would see it.
void part_seam_ties(geometry::Mesh& mesh);

/// Puts tied vertices, which a load holds apart by less than a micrometre, at one place, their mean: so that
/// a seam does not count as cloth that crosses itself.
void close_seam_ties(geometry::Mesh& mesh);

}  // namespace furrow::jobs
