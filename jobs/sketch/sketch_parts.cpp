// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/sketch/sketch_parts.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "jobs/base/part_names.h"
#include "jobs/cloth/attach_parts.h"

namespace furrow::jobs {
namespace {

constexpr std::size_t most_parts = 12;

/// The list under that key, which may be one text.
std::vector<std::string> names_in(const Json& garment, const char* key) {
  const Json value = garment.value(key, Json::array());
  if (value.is_string()) return {value.get<std::string>()};
  return value.get<std::vector<std::string>>();
}

}  // namespace

std::vector<SketchPart> loose_parts_of(const Sketch& sketch) {
  const geometry::Parts parts = geometry::find_parts(sketch.garment.mesh);
  std::vector<SketchPart> list;
  for (std::size_t part = 1; part < std::min(parts.list.size(), 1 + most_parts); ++part)
    list.push_back({setting_name_of_part(sketch.garment, parts, int(part))});
  for (const geometry::AttachedPart& a : attached_parts(sketch.garment, parts, {}))
    if (a.part > 0 && std::size_t(a.part) <= list.size())
      list[std::size_t(a.part) - 1].goes = a.ride != geometry::Ride::by_itself;
  return list;
}

Json with_part(Json garment, const std::string& name, bool goes) {
  for (const auto& [key, takes] : {std::pair("attach_parts", goes), {"free_parts", !goes}}) {
    std::vector<std::string> names = names_in(garment, key);
    std::erase(names, name);
    if (takes) names.push_back(name);
    if (names.empty())
      garment.erase(key);
    else
      garment[key] = names;
  }
  return garment;
}

}  // namespace furrow::jobs
