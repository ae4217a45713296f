// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/lay_warp.h"

#include <catch2/catch.hpp>

#include "geometry/mesh/errors.h"
#include "geometry/rest/warp_directions.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
using geometry::Vector;

namespace {

/// A sheet in the plane z = 0, with or without a texture that is turned by a quarter: v grows with -x.
io::MeshFile sheet(bool textured = false) {
  io::MeshFile file;
  file.mesh = tests::grid(6, 4, 0.6, 0.4);
  if (!textured) return file;
  auto map = geometry::ensure_map(file.mesh, geometry::attribute::texture);
  for (const geometry::Halfedge h : file.mesh->halfedges()) {
    const geometry::Point& p = file.mesh->point(file.mesh->target(h));
    map[h] = {p.y(), -p.x()};
  }
  return file;
}

/// The least |cos| of the warp to an axis, over all faces.
double along(const io::MeshFile& file, const Vector& axis) {
  double least = 1;
  for (const geometry::Face f : file.mesh->faces())
    least = std::min(least, std::abs(geometry::threading_of(file.mesh, f).warp * axis));
  return least;
}

struct Laid {
  io::MeshFile file;
  tests::Recorder recorder;
};
Laid laid(io::MeshFile file, const std::string& source, bool woven = true, const std::string& up = "y") {
  Laid l{std::move(file), tests::Recorder()};
  jobs::Frame frame;
  frame.up = up;
  jobs::lay_warp(l.file, source, woven, "sheet.obj", {frame, l.recorder});
  return l;
}

}  // namespace

TEST_CASE("lay_warp: an axis of the user's file, the texture either way, or nothing") {
  CHECK(along(laid(sheet(), "x").file, {1, 0, 0}) == Approx(1));
  CHECK(along(laid(sheet(), "y").file, {0, 1, 0}) == Approx(1));
  CHECK(along(laid(sheet(), "z", true, "z").file, {0, 1, 0}) == Approx(1));  // z is up in the file: our y
  CHECK(along(laid(sheet(true), "texture").file, {1, 0, 0}) == Approx(1));
  CHECK(along(laid(sheet(true), "texture-u").file, {0, 1, 0}) == Approx(1));
  CHECK(geometry::count_warp(laid(sheet(), "none").file.mesh).known == 0);
  CHECK(geometry::count_warp(laid(sheet(), "auto", false).file.mesh).known == 0);
}

TEST_CASE("lay_warp: by itself it takes the map, else the texture, else what is up, and says so") {
  const Laid upwards = laid(sheet(), "auto");
  CHECK(along(upwards.file, {0, 1, 0}) == Approx(1));
  CHECK(upwards.recorder.warned_of("warp_assumed"));
  const Laid textured = laid(sheet(true), "auto");
  CHECK(along(textured.file, {1, 0, 0}) == Approx(1));
  CHECK(textured.recorder.warned_of("warp_assumed"));
  const Laid mapped = laid(upwards.file, "auto");
  CHECK(along(mapped.file, {0, 1, 0}) == Approx(1));
  CHECK(mapped.recorder.warnings.empty());
  CHECK(laid(sheet(), "x", false).recorder.warned_of("warp_unused"));
}

TEST_CASE("lay_warp: strokes say it where they run, and the cloth around them follows") {
  const auto folder = tests::empty_folder("lay_warp");
  const std::string strokes = folder / "warp.json";
  std::ofstream(strokes) << R"({"strokes": [{"name": "a", "points": [[0.05, 0.05, 0], [0.35, 0.35, 0]]}]})";
  const Laid l = laid(sheet(), strokes);
  CHECK(along(l.file, {std::sqrt(0.5), std::sqrt(0.5), 0}) == Approx(1).margin(1e-6));
  CHECK_FALSE(l.recorder.warned_of("warp_assumed"));
  CHECK_FALSE(l.recorder.warned_of("warp_spread"));
}

TEST_CASE("lay_warp: what has no direction takes its neighbours', and a part without any is refused") {
  io::MeshFile bent = sheet();  // its outer half turned to face the axis
  for (const geometry::Vertex v : bent.mesh->vertices()) {
    geometry::Point& p = bent.mesh->point(v);
    if (p.x() > 0.3) p = {0.3, p.y(), p.x() - 0.3};
  }
  const Laid l = laid(bent, "x");
  CHECK(l.recorder.warned_of("warp_spread"));
  CHECK(geometry::count_warp(l.file.mesh).known == l.file.mesh->number_of_faces());
  CHECK(std::abs(geometry::threading_of(l.file.mesh, *std::prev(l.file.mesh->faces().end())).warp.z()) >
        0.99);
  io::MeshFile parts = sheet();
  geometry::Mesh apart = tests::grid(2, 2);
  for (const geometry::Vertex v : apart.vertices()) {
    const geometry::Point p = apart.point(v);
    apart.point(v) = {2, p.x(), p.y()};
  }
  tests::append(parts.mesh, apart);
  CHECK_THROWS_WITH(laid(parts, "x"), Catch::StartsWith("sheet.obj: 8 of 56 faces have no direction"));
  CHECK_THROWS_WITH(laid(sheet(), "file"), Catch::Contains("warp_x"));
  CHECK_THROWS_WITH(laid(sheet(), "texture"), Catch::Contains("texture"));
}
