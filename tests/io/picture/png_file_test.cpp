// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/png_file.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "geometry/mesh/errors.h"
#include "tests/test_paths.h"

namespace furrow::tests {
namespace {

namespace fs = std::filesystem;

/// An empty folder of a test's own, removed at its end.
struct Folder {
  fs::path path;
  explicit Folder(const char* name) : path(fs::path(FURROW_BINARY_DIR) / "render_test_files" / name) {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  std::size_t files() const { return std::size_t(std::distance(fs::directory_iterator(path), {})); }
};

TEST_CASE("png_file: a written PNG reads back pixel by pixel") {
  const Folder folder("round_trip");
  CHECK(rc::check([&] {
    io::Image image{*rc::gen::inRange(1, 20), *rc::gen::inRange(1, 20), {}};
    image.rgb = *rc::gen::container<std::vector<std::uint8_t>>(std::size_t(3 * image.width * image.height),
                                                               rc::gen::arbitrary<std::uint8_t>());
    io::write_png(folder.path / "a.png", image);
    const io::Image back = io::read_png(folder.path / "a.png");
    RC_ASSERT(back.width == image.width);
    RC_ASSERT(back.height == image.height);
    RC_ASSERT(back.rgb == image.rgb);
  }));
  CHECK(folder.files() == 1);  // no temporary is left
}

TEST_CASE("png_file: a PNG of 16 bits reads back number by number, one of 8 bits is no such") {
  const Folder folder("sixteen");
  CHECK(rc::check([&] {
    io::Image16 image{*rc::gen::inRange(1, 20), *rc::gen::inRange(1, 20), {}};
    image.rgb = *rc::gen::container<std::vector<std::uint16_t>>(std::size_t(3 * image.width * image.height),
                                                                rc::gen::arbitrary<std::uint16_t>());
    io::write_png16(folder.path / "a.png", image);
    const io::Image16 back = io::read_png16(folder.path / "a.png");
    RC_ASSERT(back.width == image.width);
    RC_ASSERT(back.height == image.height);
    RC_ASSERT(back.rgb == image.rgb);
  }));
  CHECK(folder.files() == 1);
  io::write_png(folder.path / "b.png", io::Image{1, 1, {1, 2, 3}});
  CHECK_THROWS_WITH(io::read_png16(folder.path / "b.png"), Catch::Contains("16 bits"));
  const auto whole = fs::file_size(folder.path / "a.png");
  for (std::uintmax_t size = 0; size < whole; size += 7) {
    fs::copy_file(folder.path / "a.png", folder.path / "cut.png", fs::copy_options::overwrite_existing);
    fs::resize_file(folder.path / "cut.png", size);
    CHECK_THROWS_AS(io::read_png16(folder.path / "cut.png"), geometry::ContentError);
  }
  CHECK_THROWS_AS(io::write_png16(folder.path / "c.png", io::Image16{2, 2, {1, 2}}), std::invalid_argument);
  CHECK_THROWS_AS(io::write_png16(folder.path / "no" / "c.png", io::Image16{1, 1, {1, 2, 3}}),
                  std::runtime_error);
}

TEST_CASE("png_file: a PNG that cannot be written leaves nothing behind") {
  const Folder folder("unwritable");
  const io::Image image{1, 1, {1, 2, 3}};
  CHECK_THROWS_AS(io::write_png(folder.path / "none" / "a.png", image), std::runtime_error);
  fs::create_directories(folder.path / "folder.png" / "inside");
  CHECK_THROWS_AS(io::write_png(folder.path / "folder.png", image), std::runtime_error);
  CHECK(folder.files() == 1);
}

TEST_CASE("png_file: an image whose pixels do not match its sides is refused before the file is touched") {
  const Folder folder("mismatch");
  const fs::path path = folder.path / "a.png";
  CHECK_THROWS_AS(io::write_png(path, {0, 0, {}}), std::invalid_argument);
  CHECK_THROWS_AS(io::write_png(path, {-1, -1, {1, 2, 3}}), std::invalid_argument);
  CHECK_THROWS_AS(io::write_png(path, {2, 2, {1, 2, 3}}), std::invalid_argument);
  CHECK(folder.files() == 0);
}

TEST_CASE("png_file: a file that is no PNG is a content error that names it") {
  const Folder folder("no_png");
  const fs::path path = folder.path / "text.png";
  std::ofstream(path) << "not a picture";
  CHECK_THROWS_AS(io::read_png(path), geometry::ContentError);
  CHECK_THROWS_WITH(io::read_png(path), Catch::Contains("text.png"));
  CHECK_THROWS_AS(io::read_png(folder.path / "absent.png"), geometry::ContentError);

  io::write_png(path, {8, 8, std::vector<std::uint8_t>(192, 77)});
  fs::resize_file(path, 45);  // within its pixels, before the mark
  CHECK_THROWS_AS(io::read_png(path), geometry::ContentError);
}

}  // namespace
}  // namespace furrow::tests
