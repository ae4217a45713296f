// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/check_keep.h"

#include <algorithm>

#include "geometry/mesh/errors.h"

namespace furrow::io {

namespace {

/// The first setting that asks for it, from round `first` on and, if `garment`, of the garment; or "".
std::string path_of_keep(const Scene& scene, bool garment, std::size_t first) {
  if (garment && scene.keep) return "garment.rest";
  for (std::size_t i = first; i < scene.lines.size(); ++i)
    if (scene.lines[i].keep) return "lines." + std::to_string(i) + ".rest";
  return "";
}

[[noreturn]] void fail(const TomlDocument& document, const std::string& path, const std::string& what) {
  throw geometry::ContentError(document.place(path) + ": " + path + " = \"keep\" " + what);
}

}  // namespace

void check_keep(const Scene& scene, const TomlDocument& document) {
  const std::string path = path_of_keep(scene, true, 0);
  if (!path.empty() && scene.material.bending_law == bridge::Bending::cross)
    fail(document, path,
         "needs hinges, for springs cannot tell a ridge from a valley: name a fabric (--fabric, "
         "material.preset), or bending_law = \"hinge\" and a rigidity");
}

void check_keep_stands_still(const Scene& scene, const TomlDocument& document, int lines_drawn) {
  const std::string path =
      path_of_keep(scene, lines_drawn < 0, static_cast<std::size_t>(std::max(0, lines_drawn)));
  const bool body_moves =
      scene.body && (!scene.body->frames.empty() || !physics::at_rest(scene.body->motion));
  const bool pins_move = std::any_of(scene.pins.begin(), scene.pins.end(),
                                     [](const ScenePins& p) { return !physics::at_rest(p.motion); });
  if (!path.empty() && (body_moves || pins_move))
    fail(document, path, "needs a body and pins that stand still; move them afterwards, from a saved state");
}

}  // namespace furrow::io
