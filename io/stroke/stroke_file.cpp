// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/stroke/stroke_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <ostream>
#include <utility>

#include "geometry/mesh/errors.h"
#include "geometry/stroke/placed_stroke.h"
#include "io/base/atomic_file.h"
#include "io/base/bytes_file.h"
#include "io/base/camera_file.h"
#include "io/base/figure_path.h"
#include "io/base/text_scanner.h"
#include "io/mesh/file_frame.h"
#include "io/mesh/mesh_readers.h"

namespace furrow::io {
namespace {

using namespace geometry;
using Json = JsonFields::Json;

/// The one farthest from 0.
double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end(),
                           [](double a, double b) { return std::abs(a) < std::abs(b); });
}

constexpr const char* triple = "three numbers [x, y, z]";

class StrokeReader {
 public:
  StrokeReader(const std::string& name, std::filesystem::path folder, double default_height,
               const ReadOptions& options)
      : fields_(name), folder_(std::move(folder)), default_height_(default_height), options_(options) {}

  std::vector<DrawnStroke> read(std::string_view text) {
    const Json root = fields_.parse(plain_text(text, fields_.name()));
    if (!root.is_object()) fields_.fail("the file must hold an object {\"strokes\": […]}");
    fields_.check_keys(root, {"strokes", "camera", "generator"});
    if (!root.contains("strokes") || !root["strokes"].is_array())
      fields_.fail("'strokes' must be a list of strokes");
    if (root.contains("camera")) camera_ = read_picture(root["camera"]);
    std::vector<DrawnStroke> strokes;
    for (const Json& item : root["strokes"]) {
      place_ = fields_.place = "stroke " + std::to_string(strokes.size()) + ": ";
      strokes.emplace_back();
      attempt([&] { read_stroke(item, strokes.back()); });
    }
    faults_.raise();
    return strokes;
  }

 private:
  /// Does it, and notes what is wrong, so that all faults of a file are told at once: the first with the
  /// file's name, each of the others on a line of its own.
  template <class Work>
  bool attempt(const Work& work) {
    bool good = false;
    try {
      work();
      good = true;
    } catch (const ContentError& e) {
      const std::string text = e.what(), name = fields_.name() + ": ";
      faults_.add(fault_before_ && text.starts_with(name) ? text.substr(name.size()) : text);
      fault_before_ = true;
    }
    fields_.place = place_;
    return good;
  }

  /// A camera that stands in the file, or the name of its own file, which lies beside this one.
  CameraPicture read_picture(const Json& value) const {
    return value.is_string() ? read_camera(folder_ / value.get<std::string>()) : camera_from(value, fields_);
  }

  /// Calls read(item) for each item of a list that must not be empty; errors name the item.
  template <class Read>
  void read_list(const Json& list, const char* key, const char* shape, const Read& read) {
    if (!list.is_array() || list.empty())
      fields_.fail(std::string("'") + key + "' must be a list of at least one " + shape);
    const std::string stroke_place = fields_.place;
    for (std::size_t i = 0; i < list.size(); ++i) {
      fields_.place = stroke_place + "point " + std::to_string(i) + ": ";
      read(list[i]);
    }
    fields_.place = stroke_place;
  }

  Point read_point(const Json& value, const char* key) const {
    const auto x = fields_.numbers(value, key, 3, triple);
    const auto point = from_file(x[0], x[1], x[2], options_);
    if (!point) fields_.fail(bad_coordinate);
    return *point;
  }

  std::array<double, 2> read_pair(const Json& value, const char* key, const char* shape) const {
    const auto x = fields_.numbers(value, key, 2, shape);
    return {x[0], x[1]};
  }

  void read_points(const Json& item, DrawnStroke& drawn) {
    Stroke& stroke = drawn.stroke;
    read_list(item["points"], "points", "point [x, y, z]",
              [&](const Json& p) { stroke.points.push_back(read_point(p, "points")); });
    if (item.contains("direction")) {
      const auto x = fields_.numbers(item["direction"], "direction", 3, triple);
      if (x[0] == 0 && x[1] == 0 && x[2] == 0) fields_.fail("'direction' must not be zero");
      stroke.direction = turned_from_file({x[0], x[1], x[2]}, options_.up);
    }
    if (!item.contains("breaks")) return;
    if (!item["breaks"].is_array()) fields_.fail("'breaks' must be a list of points' numbers");
    for (const Json& value : item["breaks"]) {
      const std::size_t at = fields_.index(value, "breaks"),
                        least = stroke.breaks.empty() ? 1 : stroke.breaks.back() + 1;
      if (at < least || at >= stroke.points.size())
        fields_.fail("'breaks' must ascend from 1 and name points");
      stroke.breaks.push_back(at);
    }
  }

  void read_pixels(const Json& item, DrawnStroke& drawn) {
    if (!item.contains("camera") && !camera_)
      fields_.fail(
          "'pixels' need a 'camera', here or for the whole file; `furrow render save_camera` writes it");
    PictureStroke on{item.contains("camera") ? read_picture(item["camera"]) : *camera_, {}};
    read_list(item["pixels"], "pixels", "pixel [column, row]", [&](const Json& p) {
      on.pixels.push_back(read_pair(p, "pixels", "two numbers [column, row]"));
    });
    drawn.on = std::move(on);
  }

  void read_texture(const Json& item, DrawnStroke& drawn) {
    TextureStroke on;
    read_list(item["texture"], "texture", "point [u, v]",
              [&](const Json& p) { on.points.push_back(read_pair(p, "texture", "two numbers [u, v]")); });
    if (item.contains("group")) on.group = fields_.text(item["group"], "group");
    if (item.contains("near")) on.near = read_point(item["near"], "near");
    drawn.on = std::move(on);
  }

  void read_vertices(const Json& item, DrawnStroke& drawn) {
    VertexStroke on;
    read_list(item["vertices"], "vertices", "vertex",
              [&](const Json& v) { on.vertices.push_back(fields_.index(v, "vertices")); });
    drawn.on = std::move(on);
  }

  /// The key that says how a stroke is drawn, with the keys that go with it.
  struct Kind {
    const char* key;
    std::vector<const char*> with;
    void (StrokeReader::*read)(const Json&, DrawnStroke&);
  };
  static const std::vector<Kind>& kinds() {
    static const std::vector<Kind> list{{"points", {"direction", "breaks"}, &StrokeReader::read_points},
                                        {"pixels", {"camera"}, &StrokeReader::read_pixels},
                                        {"texture", {"group", "near"}, &StrokeReader::read_texture},
                                        {"vertices", {}, &StrokeReader::read_vertices}};
    return list;
  }

  const Kind& kind_of(const Json& item) const {
    const Kind* found = nullptr;
    for (const Kind& kind : kinds()) {
      if (!item.contains(kind.key)) continue;
      if (found) fields_.fail(std::string("has both '") + found->key + "' and '" + kind.key + "'; keep one");
      found = &kind;
    }
    if (!found) fields_.fail("'points' is missing, or one of 'pixels', 'texture' and 'vertices'");
    for (const Kind& kind : kinds())
      for (const char* key : kind.with)
        if (&kind != found && item.contains(key))
          fields_.fail(std::string("'") + key + "' goes with '" + kind.key + "', not with '" + found->key +
                       "'");
    return *found;
  }

  /// A number, or numbers at the stroke's points, whose largest is then the number.
  template <class Value>
  void read_along(const Json& item, const char* key, Value& value, std::vector<double>& at_points) const {
    if (!item.is_array()) {
      value = fields_.number(item, key);
      return;
    }
    if (item.empty()) fields_.fail("'" + std::string(key) + "' must be a number, or numbers at the points");
    for (const Json& one : item) at_points.push_back(fields_.number(one, key));
    value = largest(at_points);
  }

  std::array<double, 2> read_taper(const Json& item) const {
    if (item.is_array()) return read_pair(item, "taper", "a length, or two [at the beginning, at the end]");
    const double both = fields_.number(item, "taper");
    return {both, both};
  }

  void check_counts(const Stroke& stroke, std::size_t points) const {
    for (const auto& [key, list] : {std::pair("height", &stroke.heights), std::pair("width", &stroke.widths)})
      if (!list->empty() && list->size() != points)
        fields_.fail("'" + std::string(key) + "' has " + std::to_string(list->size()) + " numbers for " +
                     std::to_string(points) + " points");
  }

  void read_shape(const Json& item, Stroke& stroke) const {
    const auto read = [&](const char* key, auto& value) {
      if (item.contains(key)) value = fields_.number(item[key], key);
    };
    if (item.contains("width")) read_along(item["width"], "width", stroke.width, stroke.widths);
    read("sharpness", stroke.sharpness);
    read("press", stroke.press);
    read("smooth", stroke.smooth);
    read("set", stroke.set);
    read("gather", stroke.gather);
    if (stroke.gather && !item.contains("height")) stroke.height = 0;
    if (item.contains("taper")) stroke.taper = read_taper(item["taper"]);
    if (item.contains("flare")) stroke.flare = fields_.truth(item["flare"], "flare");
    if (const std::string fault = shape_fault(stroke); !fault.empty()) fields_.fail(fault);
  }

  void read_stroke(const Json& item, DrawnStroke& drawn) {
    if (!item.is_object()) fields_.fail("must be an object {\"points\": […], …}");
    const bool known = attempt([&] {
      fields_.check_keys(item, {"height", "width",  "sharpness", "press", "taper",  "flare",     "smooth",
                                "set",    "gather", "points",    "name",  "closed", "direction", "breaks",
                                "pixels", "camera", "texture",   "group", "near",   "vertices"});
    });
    Stroke& stroke = drawn.stroke;
    stroke.height = default_height_;
    attempt([&] {
      if (item.contains("height")) read_along(item["height"], "height", stroke.height, stroke.heights);
    });
    attempt([&] { read_shape(item, stroke); });
    attempt([&] {
      if (item.contains("name")) stroke.name = fields_.text(item["name"], "name");
      if (item.contains("closed")) stroke.closed = fields_.truth(item["closed"], "closed");
    });
    const auto is_there = [&](const Kind& kind) { return item.contains(kind.key); };
    if (!known && std::none_of(kinds().begin(), kinds().end(), is_there)) return;  // the misspelt one is it
    const Kind& kind = kind_of(item);
    (this->*kind.read)(item, drawn);
    check_counts(stroke, item[kind.key].size());
    if (stroke.closed && item[kind.key].size() < 3)
      fields_.fail("'closed': a closed stroke needs at least three points");
    if (stroke.closed && !stroke.breaks.empty()) fields_.fail("'breaks': a closed stroke has none");
  }

  JsonFields fields_;
  std::string place_;  ///< of the stroke that is read
  StrokeFaults faults_;
  bool fault_before_ = false;
  std::filesystem::path folder_;
  double default_height_;
  ReadOptions options_;
  std::optional<CameraPicture> camera_;
};

/// A length with its unit, or in metres: "15mm", "-1.2cm", "0.06".
std::optional<double> length_from(std::string_view text) {
  double scale = 1;
  for (const auto& [unit, metres] : {std::pair("mm", 1e-3), std::pair("cm", 1e-2), std::pair("m", 1.0)})
    if (text.ends_with(unit)) {
      scale = metres;
      text.remove_suffix(std::string_view(unit).size());
      break;
    }
  double value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return scale * value;
}

/// Blender tells copies apart by ".001"; a number's own digits are none of it ("h=0.015").
std::string_view without_copy_number(std::string_view name) {
  const auto digit = [&](std::size_t i) { return name[i] >= '0' && name[i] <= '9'; };
  const std::size_t n = name.size();
  if (n < 5 || name[n - 4] != '.' || !digit(n - 3) || !digit(n - 2) || !digit(n - 1)) return name;
  const std::size_t word = name.find_last_of(" _", n - 4);
  const std::string_view before = name.substr(word == name.npos ? 0 : word + 1);
  const bool number =
      before.find('=') != before.npos && digit(n - 5) && before.find('.') == before.size() - 4;
  return number ? name : name.substr(0, n - 4);
}

/// Takes what an object's name says of the line: "belly h=15mm w=60mm" (or height=, width=), or with '_' for
/// ' ' as exporters have it. The other words are its name.
void take_name(std::string_view object, const std::string& file, Stroke& stroke) {
  object = without_copy_number(object);
  while (!object.empty()) {
    const std::size_t end = std::min(object.find_first_of(" _"), object.size());
    const std::string_view word = object.substr(0, end);
    object.remove_prefix(std::min(end + 1, object.size()));
    if (const std::size_t sign = word.find('='); sign != word.npos) {
      const std::string_view key = word.substr(0, sign);
      if (key != "h" && key != "w" && key != "height" && key != "width")
        throw ContentError(file + ": object '" + std::string(word) +
                           "': only h= (height) and w= (width) may stand in a line's name");
      const auto value = length_from(word.substr(sign + 1));
      if (!value || (word[0] == 'w' && !(*value > 0)))
        throw ContentError(file + ": object '" + std::string(word) +
                           (word[0] == 'h' ? "': h= takes a height as 15mm, -12mm or 0.015"
                                           : "': w= takes a width > 0 as 60mm or 0.06"));
      if (word[0] == 'h')
        stroke.height = *value;
      else
        stroke.width = *value;
    } else if (!word.empty()) {
      stroke.name += (stroke.name.empty() ? "" : "_") + std::string(word);
    }
  }
}

std::vector<DrawnStroke> strokes_of_obj(const std::string& text, const std::string& name, double height,
                                        const ReadOptions& options) {
  std::vector<DrawnStroke> strokes;
  for (NamedPolyline& line : read_obj_polylines(text, name, options)) {
    Stroke stroke;
    stroke.height = height;
    take_name(line.name, name, stroke);
    stroke.points = std::move(line.points);
    stroke.closed = line.closed;
    strokes.push_back({std::move(stroke)});
  }
  return strokes;
}

void check_options(double default_height, const ReadOptions& options) {
  check_unit(options.metres_per_unit);
  if (!std::isfinite(default_height)) throw std::invalid_argument("default_height must be finite");
}

}  // namespace

std::vector<DrawnStroke> read_drawn_strokes(const std::filesystem::path& path, double default_height,
                                            const ReadOptions& options) {
  check_options(default_height, options);
  const std::string ending = ending_of(path), name = path.string();
  if (ending != ".json" && ending != ".obj")
    throw ContentError(name + ": unknown format '" + ending + "' of strokes; json and obj are read");
  const std::string text = read_text(path);
  std::vector<DrawnStroke> strokes =
      ending == ".json" ? StrokeReader(name, path.parent_path(), default_height, options).read(text)
                        : strokes_of_obj(text, name, default_height, options);
  if (strokes.empty())
    throw ContentError(name + (ending == ".json" ? ": no strokes; add one to the list"
                                                 : ": no polylines (l elements); export the lines too"));
  return strokes;
}

std::vector<DrawnStroke> drawn_strokes_from(std::string_view json, const std::string& name,
                                            const ReadOptions& options) {
  check_options(0, options);
  return StrokeReader(name, {}, Stroke{}.height, options).read(json);
}

std::vector<Stroke> read_strokes(const std::filesystem::path& path, double default_height,
                                 const ReadOptions& options) {
  std::vector<Stroke> strokes;
  for (DrawnStroke& drawn : read_drawn_strokes(path, default_height, options)) {
    if (!std::holds_alternative<std::monostate>(drawn.on))
      throw ContentError(path.string() + ": stroke " + std::to_string(strokes.size()) + ": is drawn in " +
                         kind_of(drawn) + "; only strokes in space can be read here");
    strokes.push_back(std::move(drawn.stroke));
  }
  return strokes;
}

}  // namespace furrow::io
