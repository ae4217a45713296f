// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/stroke/stroke.h"
#include "io/base/figure_path.h"
#include "io/base/nesting.h"
#include "io/mesh/mesh_file.h"

namespace furrow::io {
namespace {

/// JSON has no NaN: a height that could not be measured is null.
double height_of(const nlohmann::ordered_json& value) {
  return value.is_null() ? geometry::unset_value : value.get<double>();
}

nlohmann::ordered_json to_json(const WrinkleRecord::Line& line) {
  nlohmann::ordered_json json{{"name", line.name},
                              {"height", line.height},
                              {"drawn_height", line.drawn_height},
                              {"smoothed_height", line.smoothed_height},
                              {"base_height", line.base_height}};
  if (line.width) {
    json["width"] = *line.width;
    json["sharpness"] = line.sharpness;
  }
  if (line.press != 1) json["press"] = line.press;
  if (line.crest_height) json["crest_height"] = *line.crest_height;
  if (line.gather) json["gather"] = *line.gather;
  return json;
}

WrinkleRecord::Line line_from(const nlohmann::ordered_json& json) {
  WrinkleRecord::Line line{json.at("name"), json.at("height"), height_of(json.at("drawn_height")),
                           height_of(json.at("smoothed_height"))};
  if (json.contains("base_height")) line.base_height = height_of(json["base_height"]);
  if (json.contains("width")) line.width = json["width"].get<double>();
  line.sharpness = json.value("sharpness", line.sharpness);
  line.press = json.value("press", line.press);
  if (json.contains("crest_height")) line.crest_height = height_of(json["crest_height"]);
  if (json.contains("gather")) line.gather = json["gather"].get<double>();
  geometry::Stroke shape;
  shape.gather = line.gather;
  shape.width = line.width;
  shape.sharpness = line.sharpness;
  shape.press = line.press;
  if (const std::string fault = shape_fault(shape); !fault.empty())
    throw geometry::ContentError("the comment 'furrow wrinkle' is damaged: " + fault);
  return line;
}

constexpr const char* prefix = "furrow wrinkle ";
bool is_record(const std::string& comment) { return comment.rfind(prefix, 0) == 0; }

}  // namespace

std::vector<double> line_widths(const WrinkleRecord& record) {
  std::vector<double> widths;
  for (const WrinkleRecord::Line& line : record.lines)
    widths.push_back(line.width.value_or(geometry::unset_value));
  return widths;
}

std::vector<double> line_presses(const WrinkleRecord& record) {
  std::vector<double> presses;
  for (const WrinkleRecord::Line& line : record.lines) presses.push_back(line.press);
  return presses;
}

std::vector<char> flat_lines(const WrinkleRecord& record) {
  std::vector<char> flat;
  for (const WrinkleRecord::Line& line : record.lines) flat.push_back(line.height == 0);
  return flat;
}

std::vector<int> gathered_lines(const WrinkleRecord& record) {
  std::vector<int> ids;
  for (std::size_t i = 0; i < record.lines.size(); ++i)
    if (record.lines[i].gather) ids.push_back(int(i));
  return ids;
}

void set_wrinkle_record(MeshFile& file, const WrinkleRecord& record) {
  nlohmann::ordered_json json{{"r_avg_structural", record.mean_structural_length},
                              {"r_avg_bending", record.mean_bending_length},
                              {"density", record.density},
                              {"unit", record.unit},
                              {"up", record.up},
                              {"options", record.options},
                              {"lines", nlohmann::ordered_json::array()},
                              {"garment", record.garment},
                              {"garment_hash", record.garment_hash}};
  if (!record.strokes.empty()) json["strokes"] = nlohmann::ordered_json::parse(record.strokes);
  if (!record.material.empty()) json["material"] = nlohmann::ordered_json::parse(record.material);
  if (record.contact_gap > 0) json["contact_gap"] = record.contact_gap;
  for (const WrinkleRecord::Line& line : record.lines) json["lines"].push_back(to_json(line));
  std::erase_if(file.comments, is_record);
  using Handler = nlohmann::ordered_json::error_handler_t;
  file.comments.push_back(prefix + json.dump(-1, ' ', true, Handler::replace));
}

std::optional<WrinkleRecord> find_wrinkle_record(const MeshFile& file, const std::string& name) {
  try {
    return find_wrinkle_record(file);
  } catch (const geometry::ContentError& e) {
    throw geometry::ContentError(name + ": " + e.what());
  }
}

std::optional<WrinkleRecord> find_wrinkle_record(const MeshFile& file) {
  const auto comment = std::find_if(file.comments.begin(), file.comments.end(), is_record);
  if (comment == file.comments.end()) return std::nullopt;
  const std::string text = comment->substr(std::string(prefix).size());
  if (is_nested_too_deep(text))
    throw geometry::ContentError("the comment 'furrow wrinkle' is damaged: it is " + too_deep_text());
  try {
    const auto json = nlohmann::ordered_json::parse(text);
    WrinkleRecord record{json.at("r_avg_structural"),
                         json.at("r_avg_bending"),
                         json.at("density"),
                         json.at("options"),
                         json.at("unit"),
                         json.at("up"),
                         {},
                         json.value("garment", ""),
                         json.value("garment_hash", ""),
                         json.contains("strokes") ? json["strokes"].dump() : "",
                         json.contains("material") ? json["material"].dump() : "",
                         json.value("contact_gap", 0.0)};
    if (!record.material.empty() && !json["material"].is_object())
      throw geometry::ContentError("the comment 'furrow wrinkle' is damaged: material is no table");
    if (!(record.contact_gap >= 0))
      throw geometry::ContentError("the comment 'furrow wrinkle' is damaged: contact_gap is below 0");
    for (const auto& line : json.at("lines")) record.lines.push_back(line_from(line));
    return record;
  } catch (const nlohmann::json::exception& e) {
    throw geometry::ContentError(std::string("the comment 'furrow wrinkle' is damaged (") + e.what() +
                                 "); write the mesh again with furrow wrinkle");
  }
}

std::optional<WrinkleRecord> read_wrinkle_record(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  std::error_code none;
  if ((ending != ".ply" && ending != ".obj") || !std::filesystem::is_regular_file(path, none))
    return std::nullopt;
  const std::string mark = std::string(ending == ".ply" ? "comment " : "# ") + prefix;
  std::ifstream in(path, std::ios::binary);
  for (std::string line; std::getline(in, line);) {
    const bool is_header = ending == ".ply" ? line.rfind("end_header", 0) != 0 : line[0] == '#';
    if (!is_header) break;
    if (line.rfind(mark, 0) != 0) continue;
    if (line.back() == '\r') line.pop_back();
    MeshFile header;
    header.comments.push_back(line.substr(mark.size() - std::string(prefix).size()));
    return find_wrinkle_record(header, path.string());
  }
  return std::nullopt;
}

}  // namespace furrow::io
