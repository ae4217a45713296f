// SPDX-License-Identifier: GPL-3.0-or-later
// The panelled skirt through wrinkle, transfer, bake and render.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/mesh/property_names.h"
#include "geometry/mesh/vertex_attributes.h"
#include "io/mesh/mesh_file.h"
#include "io/picture/png_file.h"
#include "run_json.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::tests;
using nlohmann::json;

namespace {

struct Skirt {
  ScratchDirectory scratch;
  std::string mesh = (source_dir() / "meshes" / "panelled.obj").string();
  std::string strokes = (source_dir() / "meshes" / "strokes" / "panelled.json").string();
  std::string wrinkled = scratch / "wrinkled.ply";
  int snapped = 0;
  Skirt() {
    snapped =
        succeed("wrinkle --json " + mesh + " " + strokes + " -o " + wrinkled)["fold"]["snapped_vertices"];
  }
};

}  // namespace

TEST_CASE("transfer: it brings the wrinkles back to the skirt's own faces, charts and panels") {
  Skirt skirt;
  const std::string out = skirt.scratch / "back.obj";
  const json report = succeed("transfer --json " + skirt.mesh + " " + skirt.wrinkled + " -o " + out);
  CHECK(report["copied"].get<int>() + report["interpolated"].get<int>() == report["vertices"]);
  CHECK(report["interpolated"] == skirt.snapped);  // those that slid onto a line
  CHECK(report["unchanged"].get<int>() > 1000);
  CHECK(report["unchanged"] < report["vertices"]);
  // Everything but the positions is the original file's, line by line.
  const auto rest_of = [](const std::string& path) {
    const io::MeshFile file = io::read_mesh(path);
    std::vector<double> all;
    const auto texture = *geometry::find_map(file.mesh, geometry::attribute::texture);
    for (auto f : file.mesh->faces()) {
      all.push_back((*geometry::find_map(file.mesh, geometry::attribute::group))[f]);
      all.push_back((*geometry::find_map(file.mesh, geometry::attribute::material))[f]);
      for (auto h : file.mesh->halfedges_around_face(file.mesh->halfedge(f)))
        all.insert(all.end(), {double(file.mesh->target(h)), texture[h][0], texture[h][1]});
    }
    return std::pair(all, file.group_names);
  };
  CHECK(rest_of(out) == rest_of(skirt.mesh));
}

TEST_CASE(
    "transfer: it works after subdivision and through another format with --rest-shape, and says what it "
    "refuses",
    "[release]") {
  Skirt skirt;
  const auto at = [&](const char* name) { return skirt.scratch / name; };
  succeed("subdivide --json " + skirt.mesh + " --subdivide 1 -o " + at("fine.obj"));
  succeed("wrinkle --json " + at("fine.obj") + " " + skirt.strokes + " -o " + at("fine.ply"));
  const json report = succeed("transfer --json " + skirt.mesh + " " + at("fine.ply") + " -o " + at("b.obj"));
  CHECK(report["by_index"].get<int>() > 1000);
  CHECK(report["unchanged"].get<int>() > 500);
  CHECK(report["max_distance"].get<double>() < 1e-3);

  succeed("wrinkle --json --inserted " + at("rest.obj") + " --height 0 " + skirt.mesh + " " + skirt.strokes +
          " -o " + at("w.obj"));
  const std::string call = "transfer --json " + skirt.mesh + " " + at("w.obj") + " -o " + at("c.obj");
  const Run without = run_furrow(call);
  CHECK(without.exit_code == 3);
  CHECK(without.err.find("--rest-shape") != std::string::npos);
  CHECK(run_furrow(call + " --rest-shape " + skirt.mesh).exit_code == 3);  // other vertices
  CHECK(succeed(call + " --rest-shape " + at("w.obj"))["unchanged"].get<int>() > 0);
  CHECK(run_furrow("transfer " + skirt.mesh + " " + skirt.wrinkled + " -o " + at("c.gltf")).exit_code == 2);
}

TEST_CASE("transfer: skin weights and other columns of a PLY survive wrinkle, --max-weights limits them") {
  const ScratchDirectory scratch;
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 121\nproperty float x\nproperty float y\n"
      "property float z\nproperty float weight_a\nproperty float weight_b\nproperty float weight_c\n"
      "property float wear\nelement face 200\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < 121; ++i)
    ply += std::to_string(i % 11 / 10.0) + " " + std::to_string(i / 11 / 10.0) + " 0 0.5 0.375 0.125 " +
           std::to_string(i % 11) + "\n";
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i) {
      const int a = 11 * j + i;
      ply += "3 " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(a + 12) + "\n3 " +
             std::to_string(a) + " " + std::to_string(a + 12) + " " + std::to_string(a + 11) + "\n";
    }
  write_text(scratch / "a.ply", ply);
  write_text(scratch / "s.json", R"({"strokes":[{"points":[[0.2,0.45,0],[0.8,0.5,0]]}]})");
  const std::string call = "wrinkle --json " + (scratch / "a.ply") + " " + (scratch / "s.json") + " -o ";
  for (const bool limited : {false, true}) {
    const json report = succeed(call + (scratch / "w.ply") + (limited ? " --max-weights 2" : ""));
    int changed = 0;
    const io::MeshFile file = io::read_mesh(scratch / "w.ply");
    const auto list = geometry::vertex_attributes(file.mesh);
    REQUIRE(list.size() == 4);
    CHECK(list[3].name == "wear");
    CHECK(file.mesh->number_of_vertices() > 121);
    for (auto v : file.mesh->vertices()) {
      CHECK(list[0].values[v] == Approx(limited ? 0.5 / 0.875 : 0.5).epsilon(1e-12));
      CHECK(list[2].values[v] == Approx(limited ? 0 : 0.125).epsilon(1e-12));
      if (v.idx() < 121 && list[3].values[v] != v.idx() % 11) ++changed;
    }
    CHECK(changed <=
          report["fold"]["snapped_vertices"].get<int>());  // those that slid onto the line take its values
  }
}

TEST_CASE("transfer: bake tells the wrinkled skirt to a fraction of a millimetre, already with small maps",
          "[release]") {
  Skirt skirt;
  const std::string prefix = skirt.scratch / "skirt", applied = skirt.scratch / "applied.obj";
  const json report = succeed("bake --json " + skirt.mesh + " " + skirt.wrinkled + " -o " + prefix +
                              " --texels 256 --check 1 --applied " + applied);
  CHECK(report["size"] == 256);
  CHECK(report["overlapping_texels"] == 0);
  CHECK(report["unmatched_texels"] == 0);
  for (const char* way : {"to_high", "from_high", "wrinkled_to_high", "wrinkled_from_high"}) {
    INFO(way);
    CHECK(report["check"][way]["median"].get<double>() < 1e-4);
    CHECK(report["check"][way]["p95"].get<double>() < 1e-3);
    CHECK(report["check"][way]["area"].get<double>() > 0.3);
  }
  CHECK(io::read_mesh(applied).mesh->number_of_vertices() == report["check"]["vertices"]);
  CHECK(io::read_png16(prefix + "_normal.png").width == 256);
  CHECK(run_furrow("bake " + skirt.mesh + " " + skirt.wrinkled + " -o " + prefix + " --texels 0").exit_code ==
        2);
  CHECK(run_furrow("bake " + skirt.mesh + " " + skirt.wrinkled + " -o - ").exit_code == 2);
  CHECK(run_furrow("bake " + (source_dir() / "meshes" / "sheet.obj").string() + " " + skirt.wrinkled +
                   " -o " + prefix)
            .exit_code == 3);
}

TEST_CASE("transfer: render lays a checker or a PNG on, and says when there is nothing to lay it on with",
          "[release]") {
  Skirt skirt;
  const auto at = [&](const char* name) { return skirt.scratch / name; };
  const std::string size = " --size 60,60 --quality draft --no-lines -o " + at("a.png");
  succeed("render --json " + skirt.wrinkled + " --texture checker" + size);
  const io::Image checker = io::read_png(at("a.png"));
  io::write_png(at("red.png"), io::Image{1, 1, {255, 0, 0}});
  succeed("render --json " + skirt.wrinkled + " --texture " + at("red.png") + size);
  const io::Image red = io::read_png(at("a.png"));
  CHECK(checker.rgb != red.rgb);
  const std::size_t middle = 3 * (30 * 60 + 30);
  CHECK(red.rgb[middle] > 100);
  CHECK(red.rgb[middle + 1] == 0);
  CHECK(run_furrow("render " + (source_dir() / "meshes" / "sheet.obj").string() + " --texture checker" + size)
            .exit_code == 3);
  CHECK(run_furrow("render " + skirt.wrinkled + " --texture " + at("none.png") + size).exit_code == 3);
}
