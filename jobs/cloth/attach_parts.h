// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "geometry/figure/attached_parts.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/scene.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// Lets parts of a garment that lie on other cloth ride on it (geometry/figure/attached_parts.h), and ties
/// ends that lie on cloth (ends_on_cloth.h), as stiff as the material. Where the file notes which parts ride,
/// and `attach` names none, those that were drawn on since do no more. Warns of what is found, with the
/// file's name. Parts with pinned vertices stay cloth, and what is pinned is not tied. pins: vertices, by
/// pin. Throws std::invalid_argument, before anything is changed, for a name that no part has or that is
/// given as both, for the largest part, which nothing carries, and for a pinned one.
void attach_parts(io::MeshFile& file, const io::SceneAttach& attach, const io::SceneMaterial& material,
                  const std::string& name, const std::vector<std::vector<int>>& pins, const Context& context);

/// How parts of a garment go with other cloth, or do not by choice: as the file notes it, if `attach` names
/// none, else as it is found and named. Throws as attach_parts().
std::vector<geometry::AttachedPart> attached_parts(const io::MeshFile& file, const geometry::Parts& parts,
                                                   const io::SceneAttach& attach);

/// Ties them on a garment that was refined, where struts are dropped. Nothing if `as_read` has no struts but
/// those of seams.
void tie_refined_ends(geometry::Mesh& mesh, const geometry::Mesh& as_read, const io::SceneMaterial& material);

/// Struts of a garment that are neither those of seams nor of ends: bands, and what its maker set. O(faces
/// log faces) if it has any.
std::size_t own_struts(const geometry::Mesh& mesh);

}  // namespace furrow::jobs
