// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sketch/fit_sketch.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "geometry/mesh/property_names.h"
#include "jobs/rest/fit_picture.h"
#include "jobs/sketch/sketch_tangles.h"

namespace furrow::jobs {
namespace {

std::vector<std::uint8_t> colours_of(const FittedGarment& fitted) {
  const geometry::Mesh& mesh = fitted.garment.mesh;
  const auto colour = geometry::find_map(mesh, geometry::attribute::color).value();
  std::vector<std::uint8_t> bytes;
  for (const geometry::Vertex v : mesh.vertices())
    for (std::size_t k = 0; k < 3; ++k)
      bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * colour[v][k])));
  return marked_crossings(mesh, fitted.crossings.faces, std::move(bytes));
}

std::string legend_of(const io::FitScale& scale) {
  if (scale.quantity == io::FitQuantity::strain)
    return fmt::format(
        "Pale: as it was made. Yellow to dark red: stretched by up to {:.0f} % and more. Blue: pressed "
        "together.",
        100 * scale.limit);
  return fmt::format("Dark violet: on the body. Blue, green, pale yellow: up to {:.0f} cm away and more.",
                     100 * scale.limit);
}

}  // namespace

SketchFit fit_sketch(const Sketch& sketch, const Json& strokes, FitColour colour, Listener& listener) {
  if (!sketch.body) throw std::invalid_argument("there is no body to fit; open the garment with `body`");
  FitJob job;
  io::MeshFile drawn = draw_sketch(sketch, strokes, listener).file;
  if (!geometry::find_map(drawn.mesh, geometry::attribute::rest_length))
    job.rest = drawn;  // it is as it was made
  job.worn = {std::move(drawn)};
  job.bodies = {*sketch.body};
  job.colour = colour;
  const FitJobReport report = fit(job, listener);
  const FittedGarment& fitted = report.garments.at(0);
  return {colours_of(fitted),
          fit_words(fitted.report, fitted.options, report.shown) + crossing_words(fitted.crossings),
          legend_of(fit_scale(report.shown, job.options))};
}

}  // namespace furrow::jobs
