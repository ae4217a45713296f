// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check_keep.h"

#include <algorithm>

#include "geometry/errors.h"

namespace furrow::io {

void check_keep(const Scene& scene, const TomlDocument& document) {
  std::string path = scene.keep ? "garment.rest" : "";
  for (std::size_t i = 0; i < scene.lines.size() && path.empty(); ++i)
    if (scene.lines[i].keep) path = "lines." + std::to_string(i) + ".rest";
  if (path.empty()) return;
  const auto fail = [&](const std::string& what) {
    throw geometry::ContentError(document.place(path) + ": " + path + " = \"keep\" " + what);
  };
  if (scene.material.bending_law == bridge::Bending::cross)
    fail(
        "needs hinges, for springs cannot tell a ridge from a valley: name a fabric (--fabric, "
        "material.preset), or bending_law = \"hinge\" and a rigidity");
  const bool body_moves =
      scene.body && (!scene.body->frames.empty() || !physics::at_rest(scene.body->motion));
  const bool pins_move = std::any_of(scene.pins.begin(), scene.pins.end(),
                                     [](const ScenePins& p) { return !physics::at_rest(p.motion); });
  if (body_moves || pins_move)
    fail("needs a body and pins that stand still; move them afterwards, from a saved state");
}

}  // namespace furrow::io
