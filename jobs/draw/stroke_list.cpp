// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/stroke_list.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/mesh/errors.h"
#include "io/base/figure_path.h"
#include "io/mesh/mesh_file.h"
#include "io/stroke/resolve_strokes.h"
#include "io/stroke/stroke_file.h"
#include "jobs/base/read_inputs.h"

namespace furrow::jobs {
namespace {

Json to_json(const io::DrawnStroke& drawn) {
  Json item{{"name", drawn.stroke.name}, {"kind", io::kind_of(drawn)}, {"height", drawn.stroke.height}};
  if (const double length = io::drawn_length(drawn); std::isfinite(length))
    item["length"] = length, item["unit"] = io::unit_of(drawn);
  if (drawn.stroke.width) item["width"] = *drawn.stroke.width;
  if (drawn.stroke.sharpness) item["sharpness"] = *drawn.stroke.sharpness;
  if (!drawn.stroke.heights.empty()) item["heights"] = drawn.stroke.heights;
  if (!drawn.stroke.widths.empty()) item["widths"] = drawn.stroke.widths;
  if (drawn.stroke.press != 1) item["press"] = drawn.stroke.press;
  if (drawn.stroke.taper) item["taper"] = *drawn.stroke.taper;
  if (drawn.stroke.flare) item["flare"] = *drawn.stroke.flare;
  if (drawn.stroke.smooth != 1) item["smooth"] = drawn.stroke.smooth;
  if (drawn.stroke.set != geometry::Stroke{}.set) item["set"] = drawn.stroke.set;
  if (drawn.stroke.gather) item["gather"] = *drawn.stroke.gather;
  if (drawn.stroke.closed) item["closed"] = true;
  return item;
}

}  // namespace

std::vector<io::DrawnStroke> read_stroke_list(const std::filesystem::path& path, const Context& context) {
  if (io::ending_of(path) != ".ply")
    return io::read_drawn_strokes(path, geometry::Stroke{}.height, read_options(context.frame));
  const auto record = io::find_wrinkle_record(read_mesh(path, context));
  if (!record || record->strokes.empty())
    throw geometry::ContentError(path.string() +
                                 ": holds no strokes; `furrow wrinkle` writes them into a PLY");
  return io::drawn_strokes_from(record->strokes, path.string());
}

void check_shapes(const std::vector<io::DrawnStroke>& strokes) {
  for (const io::DrawnStroke& drawn : strokes)
    if (const std::string fault = geometry::shape_fault(drawn.stroke); !fault.empty())
      throw std::invalid_argument("stroke '" + drawn.stroke.name + "': " + fault);
}

std::vector<io::DrawnStroke> lay_on(const std::vector<io::DrawnStroke>& strokes, const io::MeshFile& garment,
                                    const Context& context) {
  const io::ResolvedStrokes resolved = io::resolve_strokes(strokes, garment);
  for (const std::string& w : resolved.warnings) context.warn("drawing", w, "strokes");
  std::vector<io::DrawnStroke> in_space;
  for (const geometry::Stroke& stroke : resolved.strokes) in_space.push_back({stroke});
  return in_space;
}

Json to_json(const std::vector<io::DrawnStroke>& strokes, const std::vector<io::DrawnStroke>& on_garment) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    rows.push_back(to_json(strokes[i]));
    if (i >= on_garment.size()) continue;
    rows.back()["length_on_garment"] = io::drawn_length(on_garment[i]);
    rows.back()["parts"] = 1 + on_garment[i].stroke.breaks.size();
  }
  return rows;
}

}  // namespace furrow::jobs
