// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/baked_maps.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>

#include "geometry/mesh/errors.h"
#include "io/base/atomic_file.h"
#include "io/base/bytes_file.h"
#include "io/picture/png_file.h"

namespace furrow::io {
namespace {

using geometry::ContentError;
using geometry::VectorMap;
using Json = nlohmann::ordered_json;

constexpr int zero_depth = 32768;  // the value of no displacement
constexpr double steps = 32767;    // to either side of it

template <class ToValue>
Image16 image_of(const VectorMap& map, const ToValue& to_value) {
  if (map.size < 1 || map.texels.size() != std::size_t(map.size) * map.size)
    throw std::invalid_argument("baked maps: " + std::to_string(map.texels.size()) +
                                " texels for a size of " + std::to_string(map.size));
  Image16 image{map.size, map.size, {}};
  image.rgb.reserve(3 * map.texels.size());
  for (const auto& texel : map.texels)
    for (double x : texel)
      image.rgb.push_back(std::uint16_t(std::clamp(std::lround(to_value(x)), 0L, 65535L)));
  return image;
}

Json record_of(const geometry::BakedMaps& maps, const BakedFiles& files, double step) {
  return {{"furrow_maps", 1},
          {"size", maps.displacement.size},
          {"texel_origin",
           "row 0 is v = 1; the middle of texel (i, j) is u = (i + 0.5) / size, v = 1 - (j + 0.5) / size"},
          {"displacement",
           {{"file", files.displacement.filename().string()},
            {"space", "tangent"},
            {"channels", {"tangent", "bitangent", "normal"}},
            {"bits", 16},
            {"unit", "m"},
            {"zero", zero_depth},
            {"metres_per_step", step},
            {"formula", "metres = (value - zero) * metres_per_step"},
            {"midlevel", zero_depth / 65535.0},
            {"scale", step * 65535},
            {"largest", maps.largest},
            {"frame",
             "flat faces of the low mesh; normal and tangent interpolated linearly over its faces, then made "
             "orthonormal, normal first; bitangent = sign * normal x tangent"}}},
          {"normal",
           {{"file", files.normal.filename().string()},
            {"space", "tangent"},
            {"channels", {"tangent", "bitangent", "normal"}},
            {"bits", 16},
            {"green", "up, +v (OpenGL)"},
            {"formula", "component = value / 65535 * 2 - 1"},
            {"frame",
             "MikkTSpace on smooth, angle-weighted vertex normals; interpolated linearly, not made unit; "
             "bitangent = sign * normal x tangent"}}}};
}

}  // namespace

BakedFiles baked_files(const std::string& prefix) {
  return {prefix + "_displacement.png", prefix + "_normal.png", prefix + "_maps.json"};
}

BakedFiles write_baked_maps(const std::string& prefix, const geometry::BakedMaps& maps) {
  const BakedFiles files = baked_files(prefix);
  double largest = 0;
  for (const auto& texel : maps.displacement.texels)
    for (float x : texel) largest = std::max(largest, std::abs(double(x)));
  const double step = largest > 0 ? largest / steps : 1e-3 / steps;
  const Image16 displacement = image_of(maps.displacement, [&](double x) { return zero_depth + x / step; });
  const Image16 normal = image_of(maps.normal, [](double x) { return (x + 1) / 2 * 65535; });
  // A prefix that is not UTF-8 cannot stand in JSON; the part of it that can be read does.
  const std::string record =
      record_of(maps, files, step).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  OutputGroup together;  // the record's scale is that of its maps
  write_png16(files.displacement, displacement);
  write_png16(files.normal, normal);
  write_atomically(files.record, [&](std::ostream& out) { out << record; });
  together.commit();
  return files;
}

VectorMap read_displacement(const std::filesystem::path& record) {
  std::filesystem::path file;
  double zero = 0, step = 0;
  try {
    const Json json = Json::parse(read_text(record));
    const Json& d = json.at("displacement");
    file = record.parent_path() / d.at("file").get<std::string>();
    zero = d.at("zero").get<double>();
    step = d.at("metres_per_step").get<double>();
    if (d.at("space") != "tangent" || d.at("unit") != "m")
      throw ContentError(record.string() + ": only displacements in tangent space and metres are read");
  } catch (const Json::exception& error) {
    throw ContentError(record.string() + ": is no record of baked maps: " + error.what());
  }
  if (!(zero >= 0 && zero <= 65535) || !(step > 0 && step < 1))
    throw ContentError(record.string() + ": zero or metres_per_step is out of range");
  const Image16 image = read_png16(file);
  if (image.width != image.height) throw ContentError(file.string() + ": the map is not square");
  VectorMap map{image.width, {}};
  map.texels.resize(image.rgb.size() / 3);
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    map.texels[i / 3][i % 3] = float((image.rgb[i] - zero) * step);
  return map;
}

}  // namespace furrow::io
