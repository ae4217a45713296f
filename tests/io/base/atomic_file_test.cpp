// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "io/base/bytes_file.h"
#include "io/base/outputs_below.h"
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

TEST_CASE("write_atomically: below a folder nothing is written over a link, a pipe, or elsewhere") {
  TemporaryFolder folder, outside;
  const fs::path inside = folder / "project";
  fs::create_directories(inside / "sub");
  spit(outside / "target", "old");
  fs::create_directory_symlink(outside.path(), inside / "way");
  fs::create_symlink(outside / "target", inside / "link");
  fs::create_symlink(outside / "nothing", inside / "sub/dangling");
  REQUIRE(mkfifo((inside / "pipe").c_str(), 0600) == 0);
  fs::create_directory_symlink(inside, folder / "home");
  const auto write = [](const fs::path& path) {
    io::write_atomically(path, [](std::ostream& out) { out << "new"; });
  };
  {
    const io::OutputsBelow below(folder / "home");  // the way to it may be a link
    write(folder / "home/plain");
    write(folder / "home/./sub/../plain");
    for (const char* name :
         {"home/link", "home/sub/dangling", "home/way/new", "home/pipe", "home/../other", "home"}) {
      INFO(name);
      CHECK_THROWS_AS(write(folder / name), std::runtime_error);
    }
    CHECK_THROWS_WITH(write(folder / "home/way/new"), Catch::Contains("way is a link"));
    {
      const io::OutputsBelow other(outside.path());
      write(outside / "allowed");
    }
    CHECK_THROWS_AS(write(outside / "allowed"), std::runtime_error);
  }
  CHECK(slurp(inside / "plain") == "new");
  CHECK(slurp(outside / "target") == "old");
  CHECK(files_in(outside) == 2);
  CHECK_FALSE(fs::exists(folder / "other"));
  write(folder / "home/link");  // elsewhere links are followed
  CHECK(slurp(outside / "target") == "new");
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

TEST_CASE(
    "write_atomically: a link to a file that is not there yet is followed, links in a circle are refused") {
  TemporaryFolder folder;
  const auto write = [](std::ostream& out) { out << "new"; };
  fs::create_directory(folder / "there");
  fs::create_symlink("there/target", folder / "link");
  io::write_atomically(folder / "link", write);
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(slurp(folder / "there/target") == "new");
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  CHECK_THROWS_AS(io::write_atomically(folder / "a", write), std::runtime_error);
  CHECK(fs::is_symlink(folder / "a"));
}

TEST_CASE("write_atomically: a name may be as long as the file system takes it") {
  TemporaryFolder folder;
  const fs::path path = folder / (std::string(251, 'n') + ".ply");
  io::write_atomically(path, [](std::ostream& out) { out << "long"; });
  CHECK(slurp(path) == "long");
  CHECK(files_in(folder) == 1);
}

TEST_CASE("write_atomically: what a killed run left is removed, what another one writes is not") {
  TemporaryFolder folder;
  const fs::path abandoned = folder / ".mesh.ply.furrow-99-3.tmp",
                 used = folder / ".mesh.ply.furrow-98-3.tmp";
  const fs::path others = folder / ".mesh.ply.99-3.tmp";
  for (const fs::path& path : {abandoned, used, others}) spit(path, "half");
  const int file = ::open(used.c_str(), O_RDONLY);
  REQUIRE(::flock(file, LOCK_EX | LOCK_NB) == 0);
  io::write_atomically(folder / "mesh.ply", [](std::ostream& out) { out << "whole"; });
  ::close(file);
  CHECK_FALSE(fs::exists(abandoned));
  CHECK(fs::exists(used));
  CHECK(fs::exists(others));
}

TEST_CASE("OutputGroup: files appear together, or none of them") {
  TemporaryFolder folder;
  const auto write = [](const char* text) { return [text](std::ostream& out) { out << text; }; };
  spit(folder / "a", "old");
  {
    io::OutputGroup group;
    io::write_atomically(folder / "a", write("new"));
    io::write_atomically(folder / "b", write("new"));
  }
  CHECK(slurp(folder / "a") == "old");
  CHECK(files_in(folder) == 1);
  io::OutputGroup group;
  io::write_atomically(folder / "a", write("first"));
  io::write_atomically(folder / "a", write("second"));
  {
    io::OutputGroup part;
    io::write_atomically(folder / "b", write("new"));
    part.commit();
  }
  CHECK(slurp(folder / "a") == "old");
  CHECK_FALSE(fs::exists(folder / "b"));
  group.commit();
  CHECK(slurp(folder / "a") == "second");
  CHECK(slurp(folder / "b") == "new");
  CHECK(files_in(folder) == 2);
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
  for (const char* name : {"a.obj", "a.PLY", "a.off", "a.Stl", "a.GLB"}) {
    io::write_mesh(folder / name, cube);
    CHECK(io::read_mesh(folder / name).mesh->number_of_faces() == 12);
  }
  CHECK(files_in(folder) == 5);
  for (const char* name : {"a.gltf", "a.xyz", "a", "-"}) {
    INFO(name);
    CHECK_THROWS_AS(io::write_mesh(name == std::string("-") ? fs::path("-") : folder / name, cube),
                    std::invalid_argument);
  }
  CHECK(files_in(folder) == 5);
  CHECK_THROWS_AS(io::read_mesh(folder / "a.xyz"), geometry::ContentError);
  CHECK_THROWS_AS(io::read_mesh(folder / "absent.obj"), geometry::ContentError);
  CHECK_THROWS_AS(io::read_mesh(folder / "a.obj", {.metres_per_unit = -1}), std::invalid_argument);
}
