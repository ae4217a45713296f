// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/bytes_file.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::tests;

TEST_CASE("bytes_file: a file comes as it is, whatever its size") {
  TemporaryFolder folder;
  for (const std::size_t size : {0u, 1u, 65535u, 65536u, 65537u, 300000u}) {
    std::string text(size, 'a');
    for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>(i * 7);
    spit(folder / "f", text);
    CHECK(io::read_text(folder / "f") == text);
    CHECK(io::read_bytes(folder / "f").size() == size);
    std::ifstream in(folder / "f", std::ios::binary);
    CHECK(io::read_text(in, "stream") == text);
  }
}

TEST_CASE("bytes_file: a file that is too large is refused before it is read, and a device that never ends") {
  TemporaryFolder folder;
  spit(folder / "huge.obj", "v 0 0 0");
  std::filesystem::resize_file(folder / "huge.obj", std::uintmax_t{5} << 30);  // a hole: no disk is used
  CHECK(content_error([&] { io::read_text(folder / "huge.obj"); }) ==
        (folder / "huge.obj").string() + ": larger than 4 GiB; give a smaller file");
  std::filesystem::create_symlink("/dev/zero", folder / "zero.obj");
  CHECK_THAT(content_error([&] { io::read_text(folder / "zero.obj"); }),
             Catch::Contains("larger than 64 MiB, and a device may never end"));
  CHECK(io::read_text("/dev/null").empty());
}
