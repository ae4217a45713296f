// SPDX-License-Identifier: GPL-3.0-or-later
// What a picture shows beside its meshes: colour, thickness, wire, the whole figure.
#include <catch2/catch.hpp>
#include <cstdlib>

#include "io/picture/png_file.h"
#include "run_furrow.h"

using namespace furrow;
using namespace furrow::tests;

namespace {

/// A sheet of 8 × 8 squares before a tall, narrow body, as OBJ files.
struct SheetAndPole {
  ScratchDirectory scratch;
  std::string sheet = scratch / "sheet.obj", pole = scratch / "pole.obj";
  SheetAndPole() {
    std::string text;
    for (int j = 0; j <= 8; ++j)
      for (int i = 0; i <= 8; ++i)
        text += "v " + std::to_string(i / 8.0 - 0.5) + " " + std::to_string(j / 8.0) + " 0\n";
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i) {
        const int a = 9 * j + i + 1;
        const auto n = [](int k) { return " " + std::to_string(k); };
        text += "f" + n(a) + n(a + 1) + n(a + 10) + "\nf" + n(a) + n(a + 10) + n(a + 9) + "\n";
      }
    write_text(sheet, text);
    write_text(pole,
               "v 0 3 -1\nv 0.1 -3 -1\nv -0.1 -3 -1\nv 0 -3 -1.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  }
  io::Image picture(const std::string& options) const {
    const std::string out = scratch / "picture.png";
    const Run run = run_furrow("render -q " + sheet + " --view front --size 60,60 --quality draft " +
                               options + " -o " + out);
    INFO(options << "\n" << run.err);
    REQUIRE(run.exit_code == 0);
    return io::read_png(out);
  }
};

/// Pixels that are much redder than blue.
int reds(const io::Image& image) {
  int count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) count += image.rgb[i] > 2 * image.rgb[i + 2];
  return count;
}

TEST_CASE("wrinkle: with --settle the picture shows the garment at rest on its body, else what is inserted",
          "[release]") {
  const ScratchDirectory scratch;
  const std::string body = source_file("meshes/mannequin.obj"), rests = scratch / "rests.ply";
  const auto picture = [&](const std::string& arguments, const std::string& name) {
    const Run run =
        run_furrow(arguments + (scratch / name) + " -q --view front --size 80,80 --quality draft");
    INFO(run.err);
    CHECK(run.exit_code == 0);
    return io::read_png(scratch / name).rgb;
  };
  write_text(scratch / "lines.json",
             R"({"strokes": [{"height": 0.015, "points": [[0, 0.9, 0.2], [0, 0.7, 0.2]]}]})");
  const std::string draws =
      "wrinkle " + source_file("meshes/skirt.obj") + " " + (scratch / "lines.json") + " --max-distance 0.2 ";
  const auto settled = picture(
      draws + "--settle --subdivide 0 --body " + body + " -o " + rests + " --picture ", "settled.png");
  CHECK(settled == picture("render " + rests + " --no-lines --body " + body + " -o ", "rests.png"));
  CHECK(settled != picture(draws + "--picture ", "inserted.png"));
}

TEST_CASE("render: --colour dyes the garment, --figure brings the whole body into the picture") {
  const SheetAndPole f;
  const int whole = reds(f.picture("--colour '#c02010'"));
  CHECK(whole > 60 * 60 / 2);
  CHECK(reds(f.picture("")) == 0);
  CHECK(std::abs(reds(f.picture("--colour c02010 --body " + f.pole)) - whole) < whole / 50);
  const int with_figure = reds(f.picture("--colour c02010 --figure --body " + f.pole));
  CHECK(with_figure > 0);
  CHECK(with_figure < whole / 10);
}

TEST_CASE("render: wire, thickness and a finer picture each change the picture and not its size") {
  const SheetAndPole f;
  const io::Image plain = f.picture("");
  for (const char* option : {"--wire", "--oversample 2"}) {
    INFO(option);
    const io::Image image = f.picture(option);
    CHECK(image.width == 60);
    CHECK(image.height == 60);
    CHECK(image.rgb != plain.rgb);
  }
  CHECK(f.picture("--thickness 0.0016").rgb == plain.rgb);
  const std::string edge_on = "--eye 2,0.5,0 --target 0,0.5,0 --orthographic 0.1 --thickness ";
  CHECK(f.picture(edge_on + "0").rgb != f.picture(edge_on + "0.005").rgb);
}

TEST_CASE("render: wrong options of a picture are told before the work") {
  const SheetAndPole f;
  for (const char* options :
       {"--colour red", "--colour '#12345'", "--figure", "--oversample 9", "--thickness -1"}) {
    INFO(options);
    const Run run = run_furrow("render " + f.sheet + " " + options + " -o " + (f.scratch / "p.png"));
    CHECK(run.exit_code == 2);
  }
  CHECK(run_furrow("render " + f.sheet + " --colour red -o " + (f.scratch / "p.png")).err.find("#rrggbb") !=
        std::string::npos);
}

}  // namespace
