// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/stroke_file.h"

#include <array>
#include <nlohmann/json.hpp>
#include <ostream>

#include "geometry/errors.h"
#include "io/atomic_file.h"
#include "io/bytes_file.h"
#include "io/file_frame.h"
#include "io/mesh_readers.h"
#include "io/nearest_word.h"
#include "io/text_scanner.h"

namespace furrow::io {
namespace {

using namespace geometry;
using Json = nlohmann::ordered_json;

class StrokeReader {
 public:
  StrokeReader(std::string name, double default_height, const ReadOptions& options)
      : name_(std::move(name)), default_height_(default_height), options_(options) {}

  std::vector<Stroke> read(std::string_view text) {
    const Json root = parse(plain_text(text, name_));
    if (!root.is_object()) fail("the file must hold an object {\"strokes\": […]}");
    check_keys(root, {"strokes"});
    if (!root.contains("strokes") || !root["strokes"].is_array()) fail("'strokes' must be a list of strokes");
    std::vector<Stroke> strokes;
    for (const Json& item : root["strokes"]) {
      place_ = "stroke " + std::to_string(strokes.size()) + ": ";
      strokes.push_back(read_stroke(item));
    }
    return strokes;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw ContentError(name_ + ": " + place_ + what); }

  Json parse(std::string_view text) const {
    try {
      return Json::parse(text.begin(), text.end());
    } catch (const Json::parse_error& error) {
      const std::size_t at = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
      const std::string_view before = text.substr(0, at);
      const auto line = 1 + std::count(before.begin(), before.end(), '\n');
      const auto last = before.rfind('\n');
      const std::size_t column = last == before.npos ? at + 1 : at - last;
      throw ContentError(name_ + ":" + std::to_string(line) + ":" + std::to_string(column) +
                         ": no valid JSON: " + reason(error.what()) + "; correct it");
    } catch (const Json::exception& error) {
      throw ContentError(name_ + ": no valid JSON: " + reason(error.what()) + "; correct it");
    }
  }

  /// The library's text without its own marks "[json.exception.…] parse error at line 1, column 2: ".
  static std::string reason(std::string text) {
    if (const auto end = text.find("] "); text.starts_with('[') && end != text.npos) text.erase(0, end + 2);
    if (const auto colon = text.find(": "); text.starts_with("parse error") && colon != text.npos)
      text.erase(0, colon + 2);
    return text;
  }

  void check_keys(const Json& object, const std::vector<std::string>& valid) const {
    for (const auto& [key, value] : object.items()) {
      if (std::find(valid.begin(), valid.end(), key) != valid.end()) continue;
      fail("unknown key " + in_quotes(key) + "; did you mean '" + nearest_word(key, valid) + "'?");
    }
  }

  double number(const Json& value, const char* key) const {
    if (!value.is_number())
      fail(std::string("'") + key + "' must hold numbers, holds a " + value.type_name());
    const double x = value.get<double>();
    if (!std::isfinite(x)) fail(std::string("'") + key + "' holds a number that is not finite");
    return x;
  }

  std::array<double, 3> triple(const Json& value, const char* key) const {
    if (!value.is_array() || value.size() != 3)
      fail(std::string("'") + key + "': three numbers [x, y, z] are needed");
    return {number(value[0], key), number(value[1], key), number(value[2], key)};
  }

  void read_points(const Json& points, Stroke& stroke) {
    if (!points.is_array() || points.empty()) fail("'points' must be a list of at least one point [x, y, z]");
    const std::string stroke_place = place_;
    for (const Json& p : points) {
      place_ = stroke_place + "point " + std::to_string(stroke.points.size()) + ": ";
      const auto [x, y, z] = triple(p, "points");
      const auto point = from_file(x, y, z, options_);
      if (!point) fail(kBadCoordinate);
      stroke.points.push_back(*point);
    }
    place_ = stroke_place;
  }

  Stroke read_stroke(const Json& item) {
    if (!item.is_object()) fail("must be an object {\"points\": […], …}");
    check_keys(item, {"height", "points", "name", "closed", "direction"});
    Stroke stroke;
    stroke.height = item.contains("height") ? number(item["height"], "height") : default_height_;
    if (!item.contains("points")) fail("'points' is missing");
    read_points(item["points"], stroke);
    if (item.contains("name")) {
      if (!item["name"].is_string()) fail("'name' must be a text");
      stroke.name = item["name"].get<std::string>();
    }
    if (item.contains("closed")) {
      if (!item["closed"].is_boolean()) fail("'closed' must be true or false");
      stroke.closed = item["closed"].get<bool>();
    }
    if (stroke.closed && stroke.points.size() < 3)
      fail("'closed': a closed stroke needs at least three points");
    if (item.contains("direction")) {
      const auto [x, y, z] = triple(item["direction"], "direction");
      if (x == 0 && y == 0 && z == 0) fail("'direction' must not be zero");
      stroke.direction = turned_from_file({x, y, z}, options_.up);
    }
    return stroke;
  }

  std::string name_, place_;
  double default_height_;
  ReadOptions options_;
};

std::vector<Stroke> strokes_of_obj(const std::string& text, const std::string& name, double height,
                                   const ReadOptions& options) {
  std::vector<Stroke> strokes;
  for (Polyline& line : read_obj_polylines(text, name, options)) {
    Stroke stroke;
    stroke.height = height;
    stroke.points = std::move(line.points);
    stroke.closed = line.closed;
    strokes.push_back(std::move(stroke));
  }
  return strokes;
}

Json to_json(const Vector& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json to_json(const Stroke& stroke, const WriteOptions& options) {
  Json item = Json::object();
  if (!stroke.name.empty()) item["name"] = stroke.name;
  item["height"] = stroke.height;
  if (stroke.closed) item["closed"] = true;
  if (stroke.direction)
    item["direction"] = to_json(to_file(CGAL::ORIGIN + *stroke.direction, {1, options.up}));
  for (const Point& p : stroke.points) item["points"].push_back(to_json(to_file(p, options)));
  return item;
}

void check(const std::vector<Stroke>& strokes) {
  const auto finite = [](const auto& p) {
    return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
  };
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const Stroke& s = strokes[i];
    bool good = std::isfinite(s.height) && !s.points.empty() && (!s.direction || finite(*s.direction));
    for (const Point& p : s.points) good = good && finite(p);
    if (!good)
      throw std::invalid_argument("strokes: stroke " + std::to_string(i) + " has no points or is not finite");
  }
}

}  // namespace

std::vector<Stroke> read_strokes(const std::filesystem::path& path, double default_height,
                                 const ReadOptions& options) {
  check_unit(options.metres_per_unit);
  if (!std::isfinite(default_height)) throw std::invalid_argument("default_height must be finite");
  const std::string ending = path.extension().string(), name = path.string();
  if (ending != ".json" && ending != ".obj")
    throw ContentError(name + ": unknown format '" + ending + "' of strokes; json and obj are read");
  const std::string text = read_text(path);
  std::vector<Stroke> strokes = ending == ".json" ? StrokeReader(name, default_height, options).read(text)
                                                  : strokes_of_obj(text, name, default_height, options);
  if (strokes.empty())
    throw ContentError(name + (ending == ".json" ? ": no strokes; add one to the list"
                                                 : ": no polylines (l elements); export the lines too"));
  return strokes;
}

void write_strokes(std::ostream& out, const std::vector<Stroke>& strokes, const WriteOptions& options) {
  check_unit(options.metres_per_unit);
  check(strokes);
  Json root = {{"strokes", Json::array()}};
  for (const Stroke& stroke : strokes) root["strokes"].push_back(to_json(stroke, options));
  out << root.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
}

void write_strokes(const std::filesystem::path& path, const std::vector<Stroke>& strokes,
                   const WriteOptions& options) {
  check_unit(options.metres_per_unit);
  check(strokes);
  write_atomically(path, [&](std::ostream& out) { write_strokes(out, strokes, options); });
}

}  // namespace furrow::io
