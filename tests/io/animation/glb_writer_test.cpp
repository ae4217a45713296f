// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "bridge/arrays/convert.h"
#include "io/animation/animation_file.h"
#include "tests/io/base/io_test_helpers.h"
#include "tests/io/mesh/glb_parts.h"

using namespace furrow;
using namespace furrow::tests;
using nlohmann::json;
using physics::Vec3;

namespace {

std::vector<Vec3> waved(const geometry::Mesh& mesh, int i) {
  std::vector<Vec3> x = bridge::positions_of(mesh);
  for (Vec3& p : x) p += Vec3(0, std::sin(3 * p.x() + i) - std::sin(3 * p.x()), 0);
  return x;
}

Glb animated_glb(const geometry::Mesh& mesh, int frames, const io::AnimationOptions& options = {}) {
  TemporaryFolder folder;
  io::AnimationWriter writer(folder / "a.glb", mesh, options);
  for (int i = 0; i < frames; ++i) writer.add(waved(mesh, i));
  writer.close();
  return Glb(slurp(folder / "a.glb"));
}

geometry::Mesh plain_grid(int n) {
  geometry::Mesh mesh = decorated_grid(n).mesh;
  auto texture = *geometry::find_map(mesh, geometry::attribute::texture);
  mesh.remove_property_map(texture);
  return mesh;
}

/// Frame i as a viewer that sums base and weighted targets shows it, against the positions given.
double farthest(const Glb& glb, const geometry::Mesh& mesh, int i) {
  const auto base = glb.numbers<float>(glb.primitive()["attributes"]["POSITION"]);
  std::vector<float> added(base.size(), 0);
  if (i > 0) added = glb.numbers<float>(glb.primitive()["targets"][i - 1]["POSITION"]);
  const std::vector<Vec3> wanted = waved(mesh, i);
  double largest = 0;
  for (std::size_t v = 0; v < wanted.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k)
      largest =
          std::max(largest, std::abs(base[3 * v + k] + added[3 * v + k] - wanted[v][static_cast<int>(k)]));
  return largest;
}

}  // namespace

TEST_CASE("GLB: base and targets add up to the frames, normals are those of the frames") {
  const geometry::Mesh mesh = plain_grid(5);
  const Glb glb = animated_glb(mesh, 4);
  CHECK(glb.primitive()["targets"].size() == 3);
  CHECK_FALSE(glb.primitive()["attributes"].contains("TEXCOORD_0"));
  for (int i = 0; i < 4; ++i) CHECK(farthest(glb, mesh, i) < 3e-7);
  const auto indices = glb.numbers<std::uint32_t>(glb.primitive()["indices"]);
  CHECK(indices.size() == 3 * mesh.number_of_faces());
  const auto triangles = bridge::triangles_of(mesh);
  for (std::size_t i = 0; i < indices.size(); ++i)
    CHECK(indices[i] == static_cast<std::uint32_t>(triangles[i / 3][i % 3]));
  const auto normals = glb.numbers<float>(glb.primitive()["attributes"]["NORMAL"]);
  for (std::size_t v = 0; v < normals.size(); v += 3)
    CHECK(std::hypot(normals[v], normals[v + 1], normals[v + 2]) == Approx(1).epsilon(1e-6));
  const auto turned = glb.numbers<float>(glb.primitive()["targets"][2]["NORMAL"]);
  for (std::size_t v = 0; v < normals.size(); v += 3)
    CHECK(std::hypot(normals[v] + turned[v], normals[v + 1] + turned[v + 1],
                     normals[v + 2] + turned[v + 2]) == Approx(1).epsilon(1e-5));
}

TEST_CASE("GLB: one target is on at each frame's time, none at the first") {
  for (const auto rule : {io::Interpolation::linear, io::Interpolation::step}) {
    const Glb glb = animated_glb(plain_grid(2), 3, {.fps = 8, .start = 0.25, .interpolation = rule});
    const json& animation = glb.scene["animations"][0];
    CHECK(animation["channels"][0]["target"]["path"] == "weights");
    CHECK(animation["samplers"][0]["interpolation"] == (rule == io::Interpolation::step ? "STEP" : "LINEAR"));
    CHECK(glb.numbers<float>(animation["samplers"][0]["input"]) == std::vector<float>{0.25F, 0.375F, 0.5F});
    CHECK(glb.numbers<float>(animation["samplers"][0]["output"]) == std::vector<float>{0, 0, 1, 0, 0, 1});
    CHECK(glb.scene["meshes"][0]["weights"] == json::array({0, 0}));
  }
}

TEST_CASE("GLB: one frame is a plain mesh") {
  const geometry::Mesh mesh = plain_grid(2);
  const Glb glb = animated_glb(mesh, 1);
  CHECK_FALSE(glb.scene.contains("animations"));
  CHECK_FALSE(glb.primitive().contains("targets"));
  CHECK(farthest(glb, mesh, 0) < 3e-7);
}

TEST_CASE("GLB: a vertex of several texture coordinates is there once for each, at the end") {
  const geometry::Mesh mesh = decorated_grid(3).mesh;
  const auto texture = *geometry::find_map(mesh, geometry::attribute::texture);
  const Glb glb = animated_glb(mesh, 3);
  const auto indices = glb.numbers<std::uint32_t>(glb.primitive()["indices"]);
  const auto t = glb.numbers<float>(glb.primitive()["attributes"]["TEXCOORD_0"]);
  const auto base = glb.numbers<float>(glb.primitive()["attributes"]["POSITION"]);
  CHECK(t.size() / 2 > mesh.number_of_vertices());
  CHECK(base.size() / 3 == t.size() / 2);
  std::size_t corner = 0;
  for (const geometry::Face f : mesh.faces()) {
    geometry::Halfedge h = mesh.prev(mesh.halfedge(f));
    for (int k = 0; k < 3; ++k, h = mesh.next(h), ++corner) {
      const std::uint32_t v = indices[corner];
      const bool none = std::isnan(texture[h][0]) || std::isnan(texture[h][1]);
      CHECK(t[2 * v] == static_cast<float>(none ? 0 : texture[h][0]));
      CHECK(t[2 * v + 1] == static_cast<float>(none ? 1 : 1 - texture[h][1]));
      CHECK(base[3 * v] == static_cast<float>(mesh.point(mesh.target(h)).x()));
      if (v < mesh.number_of_vertices()) CHECK(v == std::size_t(mesh.target(h)));
    }
  }
  CHECK(corner * 1 == indices.size());
}

TEST_CASE("GLB: our own reader takes the mesh of the first frame back") {
  TemporaryFolder folder;
  const geometry::Mesh mesh = plain_grid(4);
  io::AnimationWriter writer(folder / "a.glb", mesh);
  for (int i = 0; i < 3; ++i) writer.add(waved(mesh, i));
  writer.close();
  const geometry::Mesh back = io::read_mesh(folder / "a.glb").mesh;
  CHECK(back.number_of_vertices() == mesh.number_of_vertices());
  CHECK(back.number_of_faces() == mesh.number_of_faces());
  CHECK(back.number_of_edges() == mesh.number_of_edges());
}
