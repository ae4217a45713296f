// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/atomic_file.h"

#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "io/base/bytes_file.h"
#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::tests;
namespace fs = std::filesystem;

namespace {

std::size_t files_in(const TemporaryFolder& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("write_atomically: the old file stays until the new one is whole, nothing is left behind") {
  TemporaryFolder folder;
  const fs::path path = folder / "mesh.obj";
  io::write_atomically(path, [](std::ostream& out) { out << "first"; });
  CHECK(slurp(path) == "first");
  io::write_atomically(path, [&](std::ostream& out) {
    out << "second" << std::flush;
    CHECK(slurp(path) == "first");
    CHECK(files_in(folder) == 2);
  });
  CHECK(slurp(path) == "second");
  const auto thrower = [](std::ostream& out) {
    out << "third";
    throw std::logic_error("stop");
  };
  CHECK_THROWS_AS(io::write_atomically(path, thrower), std::logic_error);
  CHECK_THROWS_AS(io::write_atomically(path, [](std::ostream& out) { out.setstate(std::ios::badbit); }),
                  std::runtime_error);
  CHECK(slurp(path) == "second");
  CHECK(files_in(folder) == 1);
}

TEST_CASE("write_atomically: links are followed, permissions are kept") {
  TemporaryFolder folder;
  spit(folder / "target", "old");
  fs::permissions(folder / "target", fs::perms(0640));
  fs::create_symlink("target", folder / "link");
  io::write_atomically(folder / "link", [](std::ostream& out) { out << "new"; });
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(slurp(folder / "target") == "new");
  CHECK(fs::status(folder / "target").permissions() == fs::perms(0640));
}

TEST_CASE("write_atomically: what cannot be written is an error, devices are written directly") {
  TemporaryFolder folder;
  const auto write = [](std::ostream& out) { out << "x"; };
  CHECK_THROWS_AS(io::write_atomically(folder / "absent/file", write), std::runtime_error);
  CHECK_THROWS_AS(io::write_atomically(folder.path(), write), std::runtime_error);
  io::write_atomically("/dev/null", write);
  CHECK(fs::is_character_file("/dev/null"));
  CHECK_THROWS_AS(io::write_atomically("/dev/full", write), std::runtime_error);
}

TEST_CASE("bytes_file: any bytes come back, what cannot be read is a content error") {
  TemporaryFolder folder;
  std::vector<std::byte> bytes;
  for (int i = 0; i < 200000; ++i) bytes.push_back(static_cast<std::byte>(i % 251 * (i % 241) % 256));
  io::write_bytes(folder / "field", bytes);
  CHECK(io::read_bytes(folder / "field") == bytes);
  io::write_bytes(folder / "empty", {});
  CHECK(io::read_bytes(folder / "empty").empty());
  CHECK(content_error([&] { io::read_bytes(folder / "absent"); }).find("No such file") != std::string::npos);
  CHECK(content_error([&] { io::read_text(folder.path()); }).find("is a folder") != std::string::npos);
}

TEST_CASE("write_mesh: by ending, into place, nothing is written for what we do not write") {
  TemporaryFolder folder;
  const io::MeshFile cube = read_from(cube_obj, io::MeshFormat::obj);
  for (const char* name : {"a.obj", "a.PLY", "a.off", "a.Stl"}) {
    io::write_mesh(folder / name, cube);
    CHECK(io::read_mesh(folder / name).mesh.number_of_faces() == 12);
  }
  CHECK(files_in(folder) == 4);
  for (const char* name : {"a.glb", "a.xyz", "a", "-"}) {
    INFO(name);
    CHECK_THROWS_AS(io::write_mesh(name == std::string("-") ? fs::path("-") : folder / name, cube),
                    std::invalid_argument);
  }
  CHECK(files_in(folder) == 4);
  CHECK_THROWS_AS(io::read_mesh(folder / "a.xyz"), geometry::ContentError);
  CHECK_THROWS_AS(io::read_mesh(folder / "absent.obj"), geometry::ContentError);
  CHECK_THROWS_AS(io::read_mesh(folder / "a.obj", {.metres_per_unit = -1}), std::invalid_argument);
}
