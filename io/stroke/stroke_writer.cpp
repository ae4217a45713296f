// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <ostream>
#include <stdexcept>

#include "geometry/mesh/mesh.h"
#include "io/base/atomic_file.h"
#include "io/base/camera_file.h"
#include "io/base/own_mark.h"
#include "io/mesh/file_frame.h"
#include "io/stroke/stroke_file.h"

namespace furrow::io {
namespace {

using namespace geometry;
using Json = JsonFields::Json;

Json to_json(const Vector& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json to_json(const DrawnStroke& drawn, const WriteOptions& options) {
  const Stroke& stroke = drawn.stroke;
  Json item = Json::object();
  if (!stroke.name.empty()) item["name"] = stroke.name;
  item["height"] = stroke.height;
  if (!stroke.heights.empty()) item["height"] = stroke.heights;
  if (stroke.width) item["width"] = *stroke.width;
  if (!stroke.widths.empty()) item["width"] = stroke.widths;
  if (stroke.sharpness) item["sharpness"] = *stroke.sharpness;
  if (stroke.press != 1) item["press"] = stroke.press;
  if (stroke.taper) item["taper"] = *stroke.taper;
  if (stroke.flare) item["flare"] = *stroke.flare;
  if (stroke.smooth != 1) item["smooth"] = stroke.smooth;
  if (stroke.set != Stroke{}.set) item["set"] = stroke.set;
  if (stroke.gather) item["gather"] = *stroke.gather;
  if (stroke.closed) item["closed"] = true;
  if (const auto* on = std::get_if<PictureStroke>(&drawn.on)) {
    item["camera"] = to_json(on->picture);
    item["pixels"] = on->pixels;
  } else if (const auto* flat = std::get_if<TextureStroke>(&drawn.on)) {
    if (!flat->group.empty()) item["group"] = flat->group;
    if (flat->near) item["near"] = to_json(to_file(*flat->near, options));
    item["texture"] = flat->points;
  } else if (const auto* path = std::get_if<VertexStroke>(&drawn.on)) {
    item["vertices"] = path->vertices;
  } else {
    if (stroke.direction)
      item["direction"] = to_json(to_file(CGAL::ORIGIN + Vector(*stroke.direction), {1, options.up}));
    if (!stroke.breaks.empty()) item["breaks"] = stroke.breaks;
    for (const Point p : stroke.points) item["points"].push_back(to_json(to_file(p, options)));
  }
  return item;
}

bool finite(const std::vector<std::array<double, 2>>& points) {
  return !points.empty() && std::all_of(points.begin(), points.end(), [](const auto& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]);
  });
}
bool finite(const Vector& p) { return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()); }

bool finite(const DrawnStroke& drawn) {
  const Stroke& s = drawn.stroke;
  if (!std::isfinite(s.height)) return false;
  if (const auto* on = std::get_if<PictureStroke>(&drawn.on)) return finite(on->pixels);
  if (const auto* on = std::get_if<TextureStroke>(&drawn.on))
    return finite(on->points) && (!on->near || finite(Point(*on->near) - CGAL::ORIGIN));
  if (const auto* on = std::get_if<VertexStroke>(&drawn.on)) return !on->vertices.empty();
  return !s.points.empty() && (!s.direction || finite(*s.direction)) &&
         std::all_of(s.points.begin(), s.points.end(),
                     [](const Point& p) { return finite(p - CGAL::ORIGIN); });
}

void check(const std::vector<DrawnStroke>& strokes, const WriteOptions& options) {
  check_unit(options.metres_per_unit);
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    if (!finite(strokes[i]))
      throw std::invalid_argument("strokes: stroke " + std::to_string(i) + " has no points or is not finite");
    if (const std::string fault = shape_fault(strokes[i].stroke); !fault.empty())
      throw std::invalid_argument("strokes: stroke " + std::to_string(i) + ": " + fault);
    if (const auto* on = std::get_if<PictureStroke>(&strokes[i].on)) io::check(on->picture);
  }
}

Json document_of(const std::vector<DrawnStroke>& strokes, const WriteOptions& options) {
  Json root = {{"strokes", Json::array()}};
  for (const DrawnStroke& stroke : strokes) root["strokes"].push_back(to_json(stroke, options));
  return root;
}

std::string text_of(const Json& document) {
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<DrawnStroke> drawn_in_space(const std::vector<Stroke>& strokes) {
  std::vector<DrawnStroke> drawn;
  for (const Stroke& stroke : strokes) drawn.push_back({stroke});
  return drawn;
}

}  // namespace

void write_strokes(std::ostream& out, const std::vector<DrawnStroke>& strokes, const WriteOptions& options) {
  check(strokes, options);
  out << text_of(document_of(strokes, options));
}

void write_strokes(const std::filesystem::path& path, const std::vector<DrawnStroke>& strokes,
                   const WriteOptions& options) {
  check(strokes, options);
  Json root = document_of(strokes, options);
  root["generator"] = own_generator;
  write_atomically(path, [&](std::ostream& out) { out << text_of(root); });
}

void write_strokes(std::ostream& out, const std::vector<Stroke>& strokes, const WriteOptions& options) {
  write_strokes(out, drawn_in_space(strokes), options);
}

void write_strokes(const std::filesystem::path& path, const std::vector<Stroke>& strokes,
                   const WriteOptions& options) {
  write_strokes(path, drawn_in_space(strokes), options);
}

}  // namespace furrow::io
