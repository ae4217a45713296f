// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/wrinkle_record.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "geometry/errors.h"
#include "geometry/property_names.h"
#include "io/lower_case.h"

namespace furrow::io {
namespace {

/// JSON has no NaN: a height that could not be measured is null.
double height_of(const nlohmann::ordered_json& value) {
  return value.is_null() ? geometry::kUnset : value.get<double>();
}

constexpr const char* kPrefix = "furrow wrinkle ";
bool is_record(const std::string& comment) { return comment.rfind(kPrefix, 0) == 0; }

}  // namespace

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
  for (const WrinkleRecord::Line& line : record.lines)
    json["lines"].push_back({{"name", line.name},
                             {"height", line.height},
                             {"drawn_height", line.drawn_height},
                             {"smoothed_height", line.smoothed_height},
                             {"base_height", line.base_height}});
  std::erase_if(file.comments, is_record);
  using Handler = nlohmann::ordered_json::error_handler_t;
  file.comments.push_back(kPrefix + json.dump(-1, ' ', true, Handler::replace));
}

std::optional<WrinkleRecord> find_wrinkle_record(const MeshFile& file) {
  const auto comment = std::find_if(file.comments.begin(), file.comments.end(), is_record);
  if (comment == file.comments.end()) return std::nullopt;
  try {
    const auto json = nlohmann::ordered_json::parse(comment->substr(std::string(kPrefix).size()));
    WrinkleRecord record{json.at("r_avg_structural"),
                         json.at("r_avg_bending"),
                         json.at("density"),
                         json.at("options"),
                         json.at("unit"),
                         json.at("up"),
                         {},
                         json.value("garment", ""),
                         json.value("garment_hash", ""),
                         json.contains("strokes") ? json["strokes"].dump() : ""};
    for (const auto& line : json.at("lines"))
      record.lines.push_back({line.at("name"), line.at("height"), height_of(line.at("drawn_height")),
                              height_of(line.at("smoothed_height")),
                              line.contains("base_height") ? height_of(line["base_height"]) : 0});
    return record;
  } catch (const nlohmann::json::exception& e) {
    throw geometry::ContentError(std::string("the comment 'furrow wrinkle' is damaged (") + e.what() +
                                 "); write the mesh again with furrow wrinkle");
  }
}

std::optional<WrinkleRecord> read_wrinkle_record(const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  std::error_code none;
  if ((ending != ".ply" && ending != ".obj") || !std::filesystem::is_regular_file(path, none))
    return std::nullopt;
  const std::string mark = std::string(ending == ".ply" ? "comment " : "# ") + kPrefix;
  std::ifstream in(path, std::ios::binary);
  for (std::string line; std::getline(in, line);) {
    const bool is_header = ending == ".ply" ? line.rfind("end_header", 0) != 0 : line[0] == '#';
    if (!is_header) break;
    if (line.rfind(mark, 0) != 0) continue;
    if (line.back() == '\r') line.pop_back();
    MeshFile header;
    header.comments.push_back(line.substr(mark.size() - std::string(kPrefix).size()));
    return find_wrinkle_record(header);
  }
  return std::nullopt;
}

}  // namespace furrow::io
