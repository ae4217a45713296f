// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/baked_maps.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/mesh/vertex_attributes.h"
#include "io/picture/png_file.h"
#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::tests;
using nlohmann::json;

namespace {

geometry::BakedMaps maps() {
  geometry::BakedMaps result;
  result.displacement.size = result.normal.size = 5;
  for (int i = 0; i < 25; ++i) {
    result.displacement.texels.push_back({0.001f * i, i == 7 ? -0.04f : 0.f, -0.0003f * i});
    result.normal.texels.push_back({0, i % 2 ? 0.6f : 0.f, i % 2 ? 0.8f : 1.f});
  }
  return result;
}

}  // namespace

TEST_CASE("baked_maps: baked maps read back to half a step, zero is exact, the largest fills the range") {
  const TemporaryFolder folder;
  const geometry::BakedMaps baked = maps();
  const io::BakedFiles files = io::write_baked_maps((folder / "shirt").string(), baked);
  const json record = json::parse(slurp(files.record));
  CHECK(record["displacement"]["unit"] == "m");
  CHECK(record["displacement"]["file"] == "shirt_displacement.png");
  const double step = record["displacement"]["metres_per_step"];
  CHECK(step == Approx(0.04 / 32767));
  const geometry::VectorMap back = io::read_displacement(files.record);
  REQUIRE(back.size == 5);
  for (int i = 0; i < 25; ++i)
    for (int k = 0; k < 3; ++k) {
      const float was = baked.displacement.texels[i][k];
      CHECK(std::abs(back.texels[i][k] - was) <= 0.501 * step);
      if (was == 0) CHECK(back.texels[i][k] == 0);
    }
  CHECK(io::read_png16(files.displacement).rgb[3 * 7 + 1] == 1);
  const io::Image16 normal = io::read_png16(files.normal);
  CHECK(normal.rgb[3 + 1] == std::lround(1.6 / 2 * 65535));
  CHECK(normal.rgb[2] == 65535);
  // What Blender's node computes from midlevel and scale is the same.
  const double midlevel = record["displacement"]["midlevel"], scale = record["displacement"]["scale"];
  CHECK((1 / 65535.0 - midlevel) * scale == Approx(-0.04));
}

TEST_CASE("baked_maps: no displacement at all is written and read") {
  const TemporaryFolder folder;
  geometry::BakedMaps baked = maps();
  for (auto& texel : baked.displacement.texels) texel = {0, 0, 0};
  const io::BakedFiles files = io::write_baked_maps((folder / "still").string(), baked);
  for (const auto& texel : io::read_displacement(files.record).texels)
    CHECK(texel == std::array<float, 3>{0, 0, 0});
}

TEST_CASE("baked_maps: a prefix that is no UTF-8 does not stop the record") {
  const TemporaryFolder folder;
  const io::BakedFiles files = io::write_baked_maps((folder / "a\xFF").string(), maps());
  CHECK(json::parse(slurp(files.record))["displacement"]["bits"] == 16);
}

TEST_CASE("baked_maps: records and maps that cannot be used are refused") {
  const TemporaryFolder folder;
  const io::BakedFiles files = io::write_baked_maps((folder / "a").string(), maps());
  const auto refused = [&](const std::string& text) {
    spit(folder / "bad.json", text);
    return content_error([&] { io::read_displacement(folder / "bad.json"); });
  };
  CHECK(refused("{").find("bad.json: is no record") != std::string::npos);
  CHECK(refused("{}").find("is no record") != std::string::npos);
  json record = json::parse(slurp(files.record));
  record["displacement"]["metres_per_step"] = -1;
  CHECK(refused(record.dump()).find("out of range") != std::string::npos);
  record["displacement"]["metres_per_step"] = 1e-6;
  record["displacement"]["space"] = "object";
  CHECK(refused(record.dump()).find("tangent space") != std::string::npos);
  record["displacement"]["space"] = "tangent";
  record["displacement"]["file"] = "absent.png";
  CHECK(refused(record.dump()).find("absent.png") != std::string::npos);
  geometry::BakedMaps broken = maps();
  broken.normal.texels.pop_back();
  CHECK_THROWS_AS(io::write_baked_maps((folder / "b").string(), broken), std::invalid_argument);
  CHECK_FALSE(std::filesystem::exists(folder / "b_displacement.png"));
}

TEST_CASE("baked_maps: PLY carries rest positions and attributes of vertices, in any unit and axes") {
  io::MeshFile file = decorated_grid(3);
  auto rest = geometry::ensure_map(file.mesh, geometry::attribute::rest_position);
  auto mask = geometry::ensure_vertex_attribute(file.mesh, "mask");
  auto weight = geometry::ensure_vertex_attribute(file.mesh, "weight_arm.L");
  for (const auto v : file.mesh->vertices()) {
    const double x = 1 / (1.0 + double(std::size_t(v)));
    if (std::size_t(v) != 2) rest[v] = {x, 2 * x, -x};
    mask[v] = x * x;
    weight[v] = std::size_t(v) == 3 ? geometry::unset_value : 1 - x;
  }
  const auto check = [&](const io::MeshFile& back, double tolerance) {
    const auto list = geometry::vertex_attributes(back.mesh);
    REQUIRE(list.size() == 2);
    CHECK(list[0].name == "mask");
    CHECK(list[1].name == "weight_arm.L");
    const auto found = geometry::find_map(back.mesh, geometry::attribute::rest_position);
    REQUIRE(found);
    for (const auto v : back.mesh->vertices()) {
      CHECK(list[0].values[v] == mask[v]);
      CHECK(same_bits(list[1].values[v], weight[v]));
      for (int k = 0; k < 3; ++k)
        CHECK((same_bits((*found)[v][k], rest[v][k]) || std::abs((*found)[v][k] - rest[v][k]) <= tolerance));
    }
  };
  check(read_from(written(file, io::MeshFormat::ply), io::MeshFormat::ply), 0);
  const std::string turned = written(file, io::MeshFormat::ply, {0.0254, io::Axis::z});
  check(read_from(turned, io::MeshFormat::ply, {0.0254, io::Axis::z}), 1e-15);
}
