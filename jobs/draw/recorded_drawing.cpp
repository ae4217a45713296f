// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/recorded_drawing.h"

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "io/base/bytes_file.h"

namespace furrow::jobs {
namespace {

namespace fs = std::filesystem;

/// The garment that a wrinkled mesh was made of: where it was, or beside the mesh; unchanged.
fs::path find_garment(const io::WrinkleRecord& record, const fs::path& wrinkled) {
  const fs::path named = record.garment, folder = wrinkled.parent_path();
  for (const fs::path& path : {named, folder / named, folder / named.filename()})
    if (fs::is_regular_file(path) && io::content_hash(path) == record.garment_hash) return path;
  throw geometry::ContentError(
      wrinkled.string() + ": the garment '" + record.garment +
      "' that its lines were drawn on is not there, or has changed; lay it beside this "
      "file, or write the strokes with `furrow strokes` and draw them on another");
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

}  // namespace furrow::jobs
