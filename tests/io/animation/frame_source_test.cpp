// SPDX-License-Identifier: GPL-3.0-or-later
#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>

#include "bridge/arrays/convert.h"
#include "io/animation/animation_file.h"
#include "io/base/byte_order.h"
#include "io/base/own_mark.h"
#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::tests;

namespace {

using physics::Vec3;

/// Frame i of a moving mesh, with numbers that single precision rounds.
std::vector<Vec3> moved(const geometry::Mesh& mesh, int i) {
  std::vector<Vec3> x = bridge::positions_of(mesh);
  for (Vec3& p : x) p += Vec3(std::sin(p.y() + i), 0.1 * i, p.x() * i / 7);
  return x;
}

void write(const std::filesystem::path& path, const geometry::Mesh& mesh, int frames,
           const io::AnimationOptions& options) {
  io::AnimationWriter writer(path, mesh, options);
  for (int i = 0; i < frames; ++i) writer.add(moved(mesh, i));
  writer.close();
}

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

std::string error_of(const std::filesystem::path& path, std::size_t vertices, std::size_t frame = 0) {
  return content_error([&] { io::open_frames(path, vertices)->positions(frame); });
}

bool contains(const std::string& text, const std::string& part) {
  INFO(text);
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE(
    "frame_source: PC2 and MDD give back times, and positions to single precision, in any unit and axes") {
  TemporaryFolder folder;
  const geometry::Mesh mesh = decorated_grid(4).mesh;
  for (const char* name : {"a.pc2", "a.mdd"})
    for (const io::Axis up : {io::Axis::y, io::Axis::z})
      for (const double unit : {1.0, 0.001}) {
        write(folder / name, mesh, 5, {.fps = 24, .start = 2, .frame = {unit, up}});
        const auto source = io::open_frames(folder / name, mesh.number_of_vertices(), {24, {unit, up}});
        REQUIRE(source->frames() == 5);
        CHECK(source->vertices() == mesh.number_of_vertices());
        for (const int i : {4, 0, 2}) {
          CHECK(source->times()[i] == Approx(2 + i / 24.0).epsilon(1e-7));
          CHECK(farthest(source->positions(i), moved(mesh, i)) < 3e-7);
        }
        CHECK_THROWS_AS(source->positions(5), std::invalid_argument);
      }
}

TEST_CASE("frame_source: numbers give a sequence its order and times, gaps are time without a frame") {
  TemporaryFolder folder;
  io::MeshFile file = decorated_grid(3);
  const geometry::Mesh rest = file.mesh;
  for (const int number : {998, 999, 1000, 1003, 12000}) {
    const std::vector<Vec3> x = moved(rest, number);
    for (const geometry::Vertex v : rest.vertices()) file.mesh->point(v) = bridge::to_cgal(x[v]);
    const std::string digits = number < 1000 ? "0" + std::to_string(number) : std::to_string(number);
    io::write_mesh(folder / ("body_" + digits + ".obj"), file);
  }
  for (const char* other : {"body_1.obj", "body_00999.obj", "body_12a4.obj", "body_1001.ply",
                            "abody_1001.obj", "body_.obj", "body_-001.obj", "body_99999999999999999999.obj"})
    spit(folder / other, "rubbish");
  const auto source = io::open_frames(folder / "body_####.obj", rest.number_of_vertices(), {.fps = 10});
  CHECK(source->times() == std::vector<double>{0, 0.1, 0.2, 0.5, 1100.2});
  CHECK(farthest(source->positions(3), moved(rest, 1003)) == 0);
  CHECK(farthest(source->positions(0), moved(rest, 998)) == 0);
}

TEST_CASE("frame_source: a sequence that cannot be used says why") {
  TemporaryFolder folder;
  CHECK(contains(error_of(folder / "a_##.obj", 3), "no file fits"));
  CHECK(contains(error_of(folder / "absent" / "a_##.obj", 3), "cannot be listed"));
  CHECK(contains(error_of(folder / "a_#_#.obj", 3), "more than one run"));
  CHECK(contains(error_of(folder / "a_##.stl", 3), "keep their vertices' order"));
  CHECK(contains(error_of(folder / "a_##.pc2", 3), "unknown format"));
  spit(folder / "a_01.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  spit(folder / "a_02.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\n");
  spit(folder / "a_03.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n");
  CHECK(contains(error_of(folder / "a_##.obj", 4), "3 vertices, not the mesh's 4"));
  CHECK(contains(error_of(folder / "a_##.obj", 3, 1), "a_02.obj: 4 vertices, not the mesh's 3"));
  CHECK(contains(error_of(folder / "a_##.obj", 3, 2), "a_03.obj:2"));
  CHECK(error_of(folder / "a_##.obj", 3, 0) == "(none)");
}

TEST_CASE("frame_source: PC2 and MDD files that are cut, damaged or of another mesh are refused") {
  TemporaryFolder folder;
  const geometry::Mesh mesh = decorated_grid(1).mesh;
  const std::size_t n = mesh.number_of_vertices();
  for (const std::string name : {"a.pc2", "a.mdd"}) {
    write(folder / name, mesh, 3, {});
    const std::string whole = slurp(folder / name);
    CHECK(contains(error_of(folder / name, n + 1), "4 vertices, but the mesh has 5"));
    for (std::size_t size = 0; size < whole.size(); ++size) {
      spit(folder / name, whole.substr(0, size));
      const bool mark_alone = size + io::own_tail.size() == whole.size();  // as other programs write it
      CHECK((error_of(folder / name, n) == "(none)") == mark_alone);
    }
    spit(folder / name, whole + "x");
    CHECK(contains(error_of(folder / name, n), "cut, damaged"));
  }
  CHECK(contains(error_of(folder / "absent.pc2", n), "No such file"));
  CHECK(contains(error_of(folder.path() / "folder.mdd", n), "No such file"));
  std::filesystem::create_directory(folder / "folder.mdd");
  CHECK(contains(error_of(folder / "folder.mdd", n), "no regular file"));
  CHECK(contains(error_of(folder / "a.abc", n), "frames are read from"));
  CHECK_THROWS_AS(io::open_frames(folder / "a.pc2", n, {.fps = 0}), std::invalid_argument);
  CHECK_THROWS_AS(io::open_frames(folder / "a.pc2", n, {.frame = {.metres_per_unit = -1}}),
                  std::invalid_argument);
}

TEST_CASE("frame_source: heads with huge or senseless numbers are refused without a try to hold them") {
  TemporaryFolder folder;
  const auto with = [&](const std::string& name, std::size_t at, std::uint32_t value) {
    write(folder / name, decorated_grid(1).mesh, 3, {});
    std::string bytes = slurp(folder / name), number;
    io::append_in_order(number, value, name == "a.pc2" ? std::endian::little : std::endian::big);
    spit(folder / name, bytes.replace(at, 4, number));
    return error_of(folder / name, 4);
  };
  for (const std::uint32_t count : {0u, 0x7fffffffu, 0x80000000u, 0xffffffffu, 2u, 4000000u}) {
    CHECK(with("a.pc2", 16, count) != "(none)");
    CHECK(with("a.pc2", 28, count) != "(none)");
    CHECK(with("a.mdd", 0, count) != "(none)");
    CHECK(with("a.mdd", 4, count) != "(none)");
  }
  CHECK(contains(with("a.pc2", 12, 2), "version 2"));
  CHECK(contains(with("a.pc2", 0, 0x504f494f), "does not begin with"));
  CHECK(contains(with("a.pc2", 24, 0), "the time of frame 1"));           // no frames a sample
  CHECK(contains(with("a.pc2", 20, 0x7fc00000), "the time of frame 0"));  // NaN
  CHECK(contains(with("a.mdd", 12, 0), "the time of frame 1"));
  CHECK(contains(with("a.mdd", 8, 0x7f800000), "the time of frame 0"));  // infinity
  for (const std::uint32_t bad : {0x7fc00000u, 0xff800000u, 0x7f000000u}) {
    CHECK(contains(with("a.pc2", 32 + 12 + 4, bad), "frame 0, vertex 1: a coordinate is not finite"));
    CHECK(contains(with("a.mdd", 20 + 12 + 4, bad), "frame 0, vertex 1: a coordinate is not finite"));
  }
}

TEST_CASE("frame_source: a damaged byte gives an error or finite numbers, nothing else") {
  TemporaryFolder folder;
  const geometry::Mesh mesh = decorated_grid(1).mesh;
  const bool good = rc::check([&](bool pc2, std::uint32_t place, std::uint8_t value) {
    const auto path = folder / (pc2 ? "a.pc2" : "a.mdd");
    write(path, mesh, 2, {});
    std::string bytes = slurp(path);
    bytes[place % bytes.size()] = static_cast<char>(value);
    spit(path, bytes);
    try {
      const auto source = io::open_frames(path, mesh.number_of_vertices());
      for (std::size_t i = 0; i < source->frames(); ++i)
        for (const Vec3& p : source->positions(i)) RC_ASSERT(p.allFinite());
    } catch (const geometry::ContentError&) {
    }
  });
  CHECK(good);
}
