// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/stroke/touch_file.h"

#include <algorithm>
#include <array>

#include "io/base/bytes_file.h"
#include "io/base/json_fields.h"
#include "io/base/text_scanner.h"
#include "io/mesh/file_frame.h"

namespace furrow::io {
namespace {

using geometry::Touch;
using geometry::TouchKind;
using TouchJson = JsonFields::Json;

constexpr std::array touch_kinds{TouchKind::iron, TouchKind::steam, TouchKind::pinch, TouchKind::pull};
constexpr const char* touch_triple = "three numbers [x, y, z]";

Touch touch_of(const TouchJson& item, const JsonFields& fields, const ReadOptions& options) {
  if (!item.is_object()) fields.fail("a touch must be an object");
  const auto has = [&item](TouchKind kind) { return item.contains(geometry::word_of(kind)); };
  if (std::count_if(touch_kinds.begin(), touch_kinds.end(), has) != 1)
    fields.fail("a touch has one of iron, steam, pinch and pull, which says where");
  Touch touch;
  touch.kind = *std::find_if(touch_kinds.begin(), touch_kinds.end(), has);
  const char* const word = geometry::word_of(touch.kind);
  const bool pulls = touch.kind == TouchKind::pull;
  fields.check_keys(item, pulls ? std::vector<std::string>{word, "radius", "strength", "by"}
                                : std::vector<std::string>{word, "radius", "strength"});
  const auto at = fields.numbers(item.at(word), word, 3, touch_triple);
  const auto place = from_file(at[0], at[1], at[2], options);
  if (!place) fields.fail(bad_coordinate);
  touch.at = *place;
  if (touch.kind == TouchKind::pinch) touch.strength = 0.3;
  if (item.contains("radius")) touch.radius = fields.number(item["radius"], "radius");
  if (!(touch.radius > 0)) fields.fail("'radius' must be > 0");
  if (item.contains("strength")) touch.strength = fields.number(item["strength"], "strength");
  if (!(touch.strength > 0 && touch.strength <= 1)) fields.fail("'strength' must be above 0 and at most 1");
  if (!pulls) return touch;
  if (!item.contains("by")) fields.fail("a pull needs its way, 'by': [x, y, z] in metres");
  const auto by = fields.numbers(item["by"], "by", 3, touch_triple);
  touch.by = turned_from_file({by[0], by[1], by[2]}, options.up);
  return touch;
}

}  // namespace

std::vector<Touch> touches_from(std::string_view json, const std::string& name, const ReadOptions& options) {
  JsonFields fields(name);
  const TouchJson root = fields.parse(plain_text(json, name));
  if (!root.is_object() || !root.contains("touches") || !root["touches"].is_array() ||
      root["touches"].empty())
    fields.fail("the file must hold an object {\"touches\": […]} with one touch at least");
  fields.check_keys(root, {"touches", "generator"});
  std::vector<Touch> touches;
  for (const TouchJson& item : root["touches"]) {
    fields.place = "touch " + std::to_string(touches.size() + 1) + ": ";
    touches.push_back(touch_of(item, fields, options));
  }
  return touches;
}

std::vector<Touch> read_touches(const std::filesystem::path& path, const ReadOptions& options) {
  check_unit(options.metres_per_unit);
  return touches_from(read_text(path), path.string(), options);
}

}  // namespace furrow::io
