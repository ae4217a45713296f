// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sketch/sketch_mass.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/mesh/property_names.h"
#include "geometry/rest/masses.h"
#include "jobs/base/read_inputs.h"

namespace furrow::jobs {
namespace {

/// From pale yellow to dark blue.
void add_colour(double share, std::vector<std::uint8_t>& colours) {
  constexpr double light[3]{250, 240, 190}, dark[3]{30, 60, 130};
  for (int k = 0; k < 3; ++k)
    colours.push_back(static_cast<std::uint8_t>(std::lround(light[k] + share * (dark[k] - light[k]))));
}

/// "1.3 mg", "430 mg".
std::string milligrams(double mass) { return fmt::format("{:.{}f} mg", 1e6 * mass, mass < 1e-5 ? 1 : 0); }

}  // namespace

SketchMass mass_of_sketch(const Sketch& sketch, const Json& strokes, Listener& listener) {
  geometry::Mesh mesh = draw_sketch(sketch, strokes, listener).file.mesh;
  const io::SceneMaterial material = scene_of(sketch.scene.settings, sketch.scene.folder).material;
  const double density = material.density.value_or(geometry::WrinkleOptions{}.density);
  const double whole = geometry::lump_masses(mesh, density);
  const auto mass = geometry::find_map(mesh, geometry::attribute::mass).value();
  double least = INFINITY, most = 0;
  for (const geometry::Vertex v : mesh.vertices()) {
    least = std::min(least, mass[v]);
    most = std::max(most, mass[v]);
  }
  SketchMass shown;
  for (const geometry::Vertex v : mesh.vertices()) add_colour(most > 0 ? mass[v] / most : 0, shown.colours);
  shown.words = fmt::format("It weighs {:.1f} g, {:.0f} g/m² of {:.2f} m²; its {} vertices {} to {}.",
                            1e3 * whole, 1e3 * density, whole / density, mesh.number_of_vertices(),
                            milligrams(least), milligrams(most));
  shown.legend =
      "Pale: light, where the mesh is fine, as at lines. Dark blue: heavy, up to " + milligrams(most) + ".";
  return shown;
}

}  // namespace furrow::jobs
