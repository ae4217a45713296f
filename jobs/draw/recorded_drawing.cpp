// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/recorded_drawing.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "io/base/bytes_file.h"
#include "io/base/figure_path.h"

namespace furrow::jobs {
namespace {

namespace fs = std::filesystem;

/// The garment that a wrinkled mesh was made of: where it was, or beside the mesh; unchanged.
fs::path find_garment(const io::WrinkleRecord& record, const fs::path& wrinkled) {
  const fs::path named = record.garment, folder = wrinkled.parent_path();
  for (const fs::path& path : {named, folder / named, folder / named.filename()})
    if (fs::is_regular_file(io::file_of_figure(path)) && io::content_hash(path) == record.garment_hash)
      return path;
  throw geometry::ContentError(
      wrinkled.string() + ": the garment '" + record.garment +
      "' that its lines were drawn on is not there, or has changed; lay it beside this "
      "file, or write the strokes with `furrow strokes` and draw them on another");
}

/// What flags of `furrow wrinkle` say, as the table of a round of lines: "--rule fold --flat-base".
Json lines_table(const std::string& flags) {
  Json table = Json::object();
  std::istringstream words(flags);
  for (std::string word, key; words >> word;) {
    if (word.rfind("--", 0) == 0) {
      key = word.substr(2);
      std::ranges::replace(key, '-', '_');
      table[key] = true;
    } else if (!key.empty()) {
      table[key] = io::parse_value(word);
    }
  }
  return table;
}

/// A round of lines with the strokes of this path, drawn as these flags say.
io::SceneLines lines_drawn_by(const std::string& flags, const fs::path& strokes) {
  Json table = lines_table(flags);
  table.erase("density");  // that of the garment, which the scene's material may say
  table["strokes"] = strokes.string();
  return scene_of(io::document_of(Json{{"lines", {table}}}, strokes.string()), "").lines.at(0);
}

/// Whether more than half of the garment's vertices lie where they lay.
bool lies_as(const geometry::Mesh& garment, const geometry::Mesh& drawn) {
  constexpr double same = 1e-6;  // [m]
  if (drawn.number_of_vertices() < garment.number_of_vertices()) return false;
  std::size_t there = 0;
  for (const geometry::Vertex v : garment.vertices())
    there += CGAL::squared_distance(garment.point(v), drawn.point(v)) < same * same;
  return 2 * there > garment.number_of_vertices();
}

}  // namespace

RecordedDrawing recorded_drawing(const fs::path& wrinkled, const Context& context) {
  const io::MeshFile file = read_mesh(wrinkled, context);
  const auto record = io::find_wrinkle_record(file);
  const std::string name = wrinkled.string();
  if (!record || record->strokes.empty())
    throw std::invalid_argument(name + " holds no strokes to draw again: name a file of strokes");
  if (record->garment.empty())
    throw std::invalid_argument(
        name +
        " was drawn on a garment that was refined first, which no file holds: name the "
        "garment and a file of strokes");
  const bool was_kept = geometry::find_map(file.mesh, geometry::attribute::hinge_stiffness).has_value();
  return {find_garment(*record, wrinkled), io::drawn_strokes_from(record->strokes, name), record->options,
          was_kept};
}

std::optional<UndrawnScene> undrawn(const io::Scene& scene, const Context& context) {
  if (!scene.lines.empty() || (context.memory && context.memory->holds(scene.garment))) return std::nullopt;
  UndrawnScene result{scene, context.memory ? *context.memory : MemoryFiles{}};
  SilentListener silent(context.listener);
  const Context quiet{context.frame, silent};
  try {
    RecordedDrawing drawing = recorded_drawing(scene.garment, quiet);
    if (drawing.was_kept) return std::nullopt;
    const io::MeshFile drawn = read_mesh(scene.garment, quiet);
    if (!lies_as(read_mesh(drawing.garment, quiet).mesh, drawn.mesh)) return std::nullopt;
    result.scene.garment = drawing.garment;
    result.scene.lines = {lines_drawn_by(drawing.options, scene.garment)};
    if (!scene.material.density) result.scene.material.density = io::find_wrinkle_record(drawn)->density;
    result.memory.strokes[scene.garment] = std::move(drawing.strokes);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  } catch (const geometry::ContentError&) {
    return std::nullopt;
  }
  return result;
}

}  // namespace furrow::jobs
