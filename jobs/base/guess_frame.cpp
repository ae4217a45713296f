// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/guess_frame.h"

#include <algorithm>
#include <array>

#include "geometry/mesh/mesh.h"
#include "io/mesh/mesh_file.h"

namespace furrow::jobs {
namespace {

using Edges = std::array<double, 3>;

/// Of the box, in the file's own unit and axes.
Edges edges_of(const std::filesystem::path& path) {
  const io::MeshFile file = io::read_mesh(path);
  Edges low, high;
  low.fill(1e300), high.fill(-1e300);
  for (const geometry::Vertex v : file.mesh->vertices())
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], double(file.mesh->point(v)[int(k)]));
      high[k] = std::max(high[k], double(file.mesh->point(v)[int(k)]));
    }
  return {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
}

struct Unit {
  const char* name;
  double metres;
};
constexpr Unit file_units[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}};

}  // namespace

GuessedFrame guess_frame(const std::filesystem::path& garment, const std::filesystem::path& body) {
  const bool has_body = !body.empty();
  const std::filesystem::path& judged = has_body ? body : garment;
  const Edges edges = edges_of(judged);
  const double longest = *std::max_element(edges.begin(), edges.end());
  GuessedFrame guess;
  if (const auto record = io::read_wrinkle_record(garment)) {
    guess.unit = record->unit, guess.up = record->up;
  } else if (io::mesh_format(garment) != io::MeshFormat::gltf) {  // which is in metres, y up, always
    const double least = has_body ? 0.8 : 0.25, most = 2.3;
    int fitting = 0;
    for (const Unit& unit : file_units) {
      const double size = longest * unit.metres;
      if (size < least || size > most) continue;
      if (++fitting == 1) guess.unit = unit.name;
    }
    guess.sure = fitting == 1;
    if (edges[2] > 1.25 * edges[1]) guess.up = "z";
    if (edges[2] < 1.25 * edges[1] && edges[1] < 1.25 * edges[2]) guess.sure = false;
  }
  const Unit* unit = std::find_if(std::begin(file_units), std::end(file_units),
                                  [&](const Unit& u) { return u.name == guess.unit; });
  guess.height = edges[guess.up == "z" ? 2 : 1] * (unit == std::end(file_units) ? 0.0254 : unit->metres);
  return guess;
}

}  // namespace furrow::jobs
