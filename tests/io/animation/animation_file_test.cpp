// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/animation/animation_file.h"

#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <limits>

#include "bridge/arrays/convert.h"
#include "io/base/own_mark.h"
#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::tests;

namespace {

using physics::Vec3;

geometry::Mesh triangle() {
  return read_from("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", io::MeshFormat::obj).mesh;
}

/// A frame of three positions.
std::vector<Vec3> frame(double x) { return {{x, 0, 0}, {1, 2, 3}, {0, 1, -x}}; }

std::size_t files_in(const TemporaryFolder& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder.path()),
                                                std::filesystem::directory_iterator()));
}

std::string bytes_of(const std::string& hex) {
  std::string bytes;
  std::istringstream words(hex);
  for (std::string word; words >> word;)
    for (std::size_t i = 0; i < word.size(); i += 2)
      bytes += static_cast<char>(std::stoi(word.substr(i, 2), nullptr, 16));
  return bytes;
}

std::string two_frames(const TemporaryFolder& folder, const std::string& name,
                       const io::AnimationOptions& options) {
  io::AnimationWriter writer(folder / name, triangle(), options);
  writer.add(frame(0));
  writer.add(frame(0.5));
  CHECK(writer.frames() == 2);
  writer.close();
  return slurp(folder / name);
}

}  // namespace

TEST_CASE("PC2: every byte of two frames") {
  TemporaryFolder folder;
  const std::string expected = bytes_of(
      "504F494E544341434845 3200 01000000 03000000 0000A040 0000803F 02000000"
      "000000000000000000000000 0000803F 00000040 00004040 00000000 0000803F 00000080"
      "0000003F0000000000000000 0000803F 00000040 00004040 00000000 0000803F 000000BF");
  CHECK(two_frames(folder, "a.pc2", {.fps = 10, .start = 0.5}) == expected + std::string(io::own_tail));
}

TEST_CASE("MDD: every byte of two frames, the greater end first, times in seconds") {
  TemporaryFolder folder;
  const std::string expected = bytes_of(
      "00000002 00000003 3F000000 3F400000"
      "000000000000000000000000 3F800000 40000000 40400000 00000000 3F800000 80000000"
      "3F0000000000000000000000 3F800000 40000000 40400000 00000000 3F800000 BF000000");
  CHECK(two_frames(folder, "a.MDD", {.fps = 4, .start = 0.5}) == expected + std::string(io::own_tail));
}

TEST_CASE("animation_file: an animation in the unit and axes of the mesh file it goes with") {
  TemporaryFolder folder;
  const io::AnimationOptions millimetres{.frame = {.metres_per_unit = 0.001, .up = io::Axis::z}};
  const std::string bytes = two_frames(folder, "a.pc2", millimetres);
  // (1, 2, 3) m becomes (1000, -3000, 2000) mm
  CHECK(bytes.substr(32 + 12, 12) == bytes_of("00007A44 00803BC5 0000FA44"));
}

TEST_CASE("animation_file: an animation is in place after close() only, and nothing else is ever seen") {
  TemporaryFolder folder;
  for (const char* name : {"a.pc2", "a.mdd", "a.glb"}) {
    INFO(name);
    spit(folder / name, "old");
    const std::size_t before = files_in(folder);
    {
      io::AnimationWriter abandoned(folder / name, triangle());
      for (int i = 0; i < 10; ++i) abandoned.add(frame(i));
      CHECK(files_in(folder) == before);
    }
    CHECK(slurp(folder / name) == "old");
    io::AnimationWriter first(folder / name, triangle());
    io::AnimationWriter writer = std::move(first);
    writer.add(frame(1));
    writer.close();
    CHECK(slurp(folder / name) != "old");
    CHECK(files_in(folder) == before);
    CHECK_THROWS_AS(writer.close(), std::invalid_argument);
    CHECK_THROWS_AS(writer.add(frame(1)), std::invalid_argument);
  }
}

TEST_CASE("animation_file: on a full disk the frames so far stay whole and can be written") {
  TemporaryFolder folder;
  io::AnimationWriter writer(folder / "a.pc2", triangle());
  writer.add(frame(0));
  rlimit old{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &old) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{200, old.rlim_max};
  REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
  std::size_t added = 1;
  std::string message;
  try {
    for (; added < 100; ++added) writer.add(frame(double(added)));
  } catch (const std::runtime_error& e) {
    message = e.what();
  }
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  CHECK(message.find("a.pc2: cannot be written: File too large") != std::string::npos);
  CHECK(added == 5);  // 5 * 36 bytes
  CHECK(writer.frames() == added);
  writer.add(frame(7));
  writer.close();
  CHECK(slurp(folder / "a.pc2").size() == 32 + 6 * 36 + io::own_tail.size());
}

TEST_CASE(
    "animation_file: an animation refuses bad options, meshes and positions before anything is written") {
  TemporaryFolder folder;
  const geometry::Mesh mesh = triangle();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](const std::string& name, const io::AnimationOptions& options) {
    CHECK_THROWS_AS(io::AnimationWriter(folder / name, mesh, options), std::invalid_argument);
  };
  for (const double fps : {0.0, -1.0, nan, 1 / 0.0}) refused("a.pc2", {.fps = fps});
  for (const double start : {-0.1, nan, 1 / 0.0}) refused("a.pc2", {.start = start});
  refused("a.pc2", {.frame = {.metres_per_unit = 0}});
  for (const char* name : {"a.obj", "a", "a.pc", "pc2", "-"}) refused(name, {});
  CHECK_THROWS_AS(io::AnimationWriter(folder / "a.pc2", geometry::Mesh()), std::invalid_argument);
  CHECK_THROWS_AS(io::AnimationWriter(folder / "absent" / "a.pc2", mesh), std::runtime_error);
  std::filesystem::create_directory(folder / "b.pc2");
  CHECK_THROWS_AS(io::AnimationWriter(folder / "b.pc2", mesh), std::runtime_error);
  geometry::Mesh points;
  points.add_vertex({0, 0, 0});
  CHECK_THROWS_AS(io::AnimationWriter(folder / "a.glb", points), std::invalid_argument);
  io::AnimationWriter writer(folder / "a.glb", mesh);
  CHECK_THROWS_AS(writer.close(), std::invalid_argument);  // no frame
  std::vector<Vec3> positions = frame(0);
  positions.pop_back();
  CHECK_THROWS_AS(writer.add(positions), std::invalid_argument);
  for (const double bad : {nan, 1 / 0.0, 1e39})
    CHECK_THROWS_AS(writer.add(frame(bad)), std::invalid_argument);
  CHECK(writer.frames() == 0);
  CHECK(files_in(folder) == 1);
}

TEST_CASE("animation_file: frames too close for the times of a file are refused") {
  TemporaryFolder folder;
  io::AnimationWriter writer(folder / "a.mdd", triangle(), {.fps = 1000, .start = 100000});
  writer.add(frame(0));
  CHECK_THROWS_AS(writer.add(frame(1)), std::runtime_error);
  CHECK(writer.frames() == 1);
}
