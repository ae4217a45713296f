// SPDX-License-Identifier: GPL-3.0-or-later
// What people read: ten lines a report, numbers as people write them, crossing faces marked in pictures.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/base/run_program.h"
#include "io/picture/png_file.h"
#include "run_furrow.h"

using namespace furrow::tests;

namespace {

std::string told(const std::string& arguments, int exit_code = 0) {
  const Run run = run_furrow(arguments);
  INFO(arguments << "\n" << run.err);
  CHECK(run.exit_code == exit_code);
  return run.out;
}

long lines_of(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

/// Pixels that are as magenta as the mark of faces that cross.
long magenta_pixels(const std::string& png) {
  const furrow::io::Image image = furrow::io::read_png(png);
  long n = 0;
  for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3)
    n += image.rgb[i] > 90 && image.rgb[i + 2] > 70 && image.rgb[i + 1] < image.rgb[i + 2] / 2;
  return n;
}

/// A square sheet, and with `crossing` a second one through its middle.
std::string sheets(bool crossing) {
  std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
  if (crossing) obj += "v 0 0.45 -0.5\nv 1 0.45 -0.5\nv 1 0.55 0.5\nv 0 0.55 0.5\nf 5 6 7\nf 5 7 8\n";
  return obj;
}

}  // namespace

TEST_CASE("report: ten lines at most for people, with the files written, and all of it with -v", "[long]") {
  ScratchDirectory scratch;
  const std::string sheet = source_file("meshes/sheet.obj"), skirt = source_file("meshes/skirt.obj"),
                    body = " --body " + source_file("meshes/mannequin.obj"),
                    strokes = source_file("meshes/strokes/round_bulge.json");
  const auto out = [&](const char* name) { return " -o " + (scratch / name); };
  for (const auto& [call, file] :
       {std::pair<std::string, std::string>("info " + sheet, ""),
        {"subdivide " + sheet + " --linear 1" + out("fine.ply"), "fine.ply"},
        {"smooth " + sheet + out("smooth.ply"), "smooth.ply"},
        {"wrinkle " + sheet + " " + strokes + out("f.ply"), "f.ply"},
        {"wrinkle " + sheet + " " + strokes + " --rule safe" + out("w.ply"), "w.ply"},
        {"quality " + (scratch / "w.ply"), ""},
        {"keep " + (scratch / "w.ply") + " --pin-loop top --fabric denim --run 0.05 --gust 0" + out("k.ply"),
         "k.ply"},
        {"drape " + skirt + body + " --subdivide 0 --band top=0.95" + out("worn.ply"), "worn.ply"},
        {"fit " + (scratch / "worn.ply") + body + out("fit.ply"), "fit.ply"},
        {"simulate " + skirt + body + " --pin-loop top --seconds 0.005" + out("s.ply"), "s.ply"},
        {"strokes " + strokes + out("l.json"), "l.json"},
        {"transfer " + sheet + " " + (scratch / "w.ply") + out("t.obj"), "t.obj"},
        {"sdf " + source_file("meshes/mannequin.obj") + " --tolerance 0.02 --picture " + (scratch / "b.png"),
         "b.png"},
        {"render " + sheet + " --size 100,100 --quality draft" + out("p.png"), "p.png"},
        {"chart " + source_file("scenes/validation/free_fall.toml") + " --set simulation.seconds=0.02",
         ""}}) {
    INFO(call);
    const std::string text = told(call);
    INFO(text);
    CHECK(lines_of(text) >= 1);
    CHECK(lines_of(text) <= 10);
    CHECK(text.find("{") == std::string::npos);
    if (!file.empty()) CHECK(text.find("written: " + (scratch / file)) != std::string::npos);
  }
}

TEST_CASE("report: -v says more, and -q nothing", "[release]") {
  ScratchDirectory scratch;
  const std::string sheet = source_file("meshes/sheet.obj");
  for (const std::string& call :
       {"info " + sheet, "smooth " + sheet + " -o " + (scratch / "o.ply"),
        "wrinkle " + sheet + " " + source_file("meshes/strokes/round_bulge.json") + " -o " +
            (scratch / "w.ply"),
        "simulate " + sheet + " --pin-vertices 0 --seconds 0.002 -o " + (scratch / "s.ply")}) {
    INFO(call);
    CHECK(lines_of(told(call + " -v")) > lines_of(told(call)));
    CHECK(told(call + " -q") == "");
  }
}

TEST_CASE("report: a list that is longer than ten lines says how much more there is") {
  ScratchDirectory scratch;
  std::string strokes = "{\"strokes\": [";
  for (int i = 0; i < 30; ++i)
    strokes += (i ? "," : "") + std::string("{\"points\": [[0,0,0],[1,0,0]], \"name\": \"s") +
               std::to_string(i) + "\"}";
  write_text(scratch / "s.json", strokes + "]}");
  const std::string text = told("strokes " + (scratch / "s.json"));
  CHECK(lines_of(text) == 8);
  CHECK(text.rfind("30 strokes\n", 0) == 0);
  CHECK(text.find("and 24 lines more, with -v\n") != std::string::npos);
}

TEST_CASE("report: lengths in messages are written as people write them") {
  ScratchDirectory scratch;
  write_text(scratch / "tall.obj", "v 0 0 0\nv 1 0 0\nv 1 80 0\nf 1 2 3\n");
  const Run tall = run_furrow("simulate " + (scratch / "tall.obj") + " -o " + (scratch / "o.ply"));
  CHECK(tall.err.find("is 80 m tall") != std::string::npos);
  write_text(scratch / "sheet.obj", sheets(false));
  write_text(scratch / "far.json",
             R"({"strokes": [{"name": "a", "points": [[0.2,0.2,1.5],[0.8,0.2,1.5]]},
                             {"name": "b", "points": [[0.2,0.5,0],[0.8,0.5,0]]},
                             {"name": "c", "points": [[0.2,0.8,0.13],[0.8,0.8,0.13]]}]})");
  const Run far = run_furrow("wrinkle " + (scratch / "sheet.obj") + " " + (scratch / "far.json") + " -o " +
                             (scratch / "o.ply"));
  INFO(far.err);
  CHECK(far.exit_code == 3);
  CHECK(far.err.find("stroke \"a\", point 0: it is 1.5 m from the surface") != std::string::npos);
  CHECK(far.err.find("\n  stroke \"c\", point 0: it is 130 mm from the surface") != std::string::npos);
  const Run lined = run_furrow("subdivide " + (scratch / "sheet.obj") + " --strokes " +
                               (scratch / "far.json") + " -o " + (scratch / "o.ply"));
  CHECK(lined.err.find("\n  stroke \"c\", point 0: it is 130 mm from the surface") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(scratch / "o.ply"));
}

TEST_CASE("render: faces that cross are magenta, on a texture, too, and counted", "[release]") {
  ScratchDirectory scratch;
  write_text(scratch / "plain.obj", sheets(false));
  write_text(scratch / "crossing.obj", sheets(true));
  const std::string how = " --json --size 120,120 --view front --quality draft -o " + (scratch / "p.png");
  CHECK(nlohmann::json::parse(told("render " + (scratch / "plain.obj") + how))["crossing_pairs"] == 0);
  CHECK(magenta_pixels(scratch / "p.png") == 0);
  CHECK(nlohmann::json::parse(told("render " + (scratch / "crossing.obj") + how))["crossing_pairs"] == 3);
  CHECK(magenta_pixels(scratch / "p.png") > 1000);
  write_text(scratch / "textured.obj",
             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0.45 -0.5\nv 1 0.45 -0.5\nv 1 0.55 0.5\nv 0 0.55 0.5\n"
             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
             "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\nf 5/1 6/2 7/3\nf 5/1 7/3 8/4\n");
  told("render " + (scratch / "textured.obj") + " --texture checker" + how);
  CHECK(magenta_pixels(scratch / "p.png") > 1000);
}

TEST_CASE("wrinkle: the picture of what is inserted marks faces that cross") {
  ScratchDirectory scratch;
  write_text(scratch / "crossing.obj", sheets(true));
  write_text(scratch / "line.json", R"({"strokes": [{"points": [[0.2,0.2,0],[0.8,0.2,0]]}]})");
  told("wrinkle " + (scratch / "crossing.obj") + " " + (scratch / "line.json") + " --picture " +
       (scratch / "p.png") + " --size 120,120 --view front --quality draft");
  CHECK(magenta_pixels(scratch / "p.png") > 400);
}

TEST_CASE("report: a smooth fold tells the height of its crest, and its width", "[release]") {
  ScratchDirectory scratch;
  const std::string call = "wrinkle " + source_file("meshes/skirt.obj") + " " +
                           source_file("meshes/strokes/figure_skirt.json") + " --rule fold -o " +
                           (scratch / "w.ply");
  const std::string text = told(call);
  INFO(text);
  CHECK(text.find("ridge 1: asked 80 mm, ") != std::string::npos);
  CHECK(text.find(" at the crest, 127 mm wide\n") != std::string::npos);
  CHECK(text.find("smoothed to") == std::string::npos);
}

TEST_CASE("info: a mesh of an odd size is not called faultless, nor refined, and a camera of it is doubted") {
  ScratchDirectory scratch;
  const std::string large = scratch / "large.obj";
  write_text(large, "v 0 0 0\nv 60 0 0\nv 60 83 0\nv 0 83 0\nf 1 2 3\nf 1 3 4\n");
  const std::string said = told("info " + large);
  CHECK(said.find("no faults found") == std::string::npos);
  CHECK(said.find("look at: its size") != std::string::npos);
  CHECK(said.find("subdivide") == std::string::npos);
  CHECK(said.find("--unit UNIT") != std::string::npos);
  const std::string picture = "render " + large + " --size 40,40 -o " + (scratch / "p.png");
  CHECK(run_furrow(picture).err.find("camera") == std::string::npos);
  CHECK(
      run_furrow(picture + " --save-camera " + (scratch / "c.json")).err.find("the camera is of that unit") !=
      std::string::npos);
}

TEST_CASE("report: what to call next names files that are there, or words in capitals to fill in, quoted") {
  const ScratchDirectory scratch;
  const std::string sheet = scratch / "my 'first' sheet.obj", quoted = "\"" + sheet + "\"",
                    lines = scratch / "lines.json", small = scratch / "small.obj";
  std::filesystem::copy_file(source_file("meshes/hung_sheet.obj"), sheet);
  write_text(lines, R"({"strokes":[{"height":0.01,"points":[[-0.1,0.3,0],[0.1,0.3,0]]}]})");
  write_text(small, "v 0 0 0\nv 900 0 0\nv 0 900 0\nv 900 900 0\nf 1 2 4\nf 1 4 3\n");
  const std::string body = source_file("meshes/mannequin.obj");
  const std::vector<std::pair<std::string, int>> calls{
      {"wrinkle " + quoted + " " + lines + " -o " + (scratch / "wrinkled.ply"), 0},
      {"subdivide " + quoted + " --linear 1 -o " + (scratch / "finer.obj"), 0},
      {"doctor " + quoted, 0},
      {"doctor " + quoted + " --body " + body, 0},
      {"info " + small, 0},
      {"fit " + quoted + " --body " + body, 0},
      {"drape " + quoted + " --pin-loop 0 --subdivide 0 --max-iterations 2 -o " + (scratch / "d.ply"), 4},
      {"fabric list", 0}};
  std::size_t told_next = 0;
  for (const auto& [call, exit_code] : calls) {
    const std::string out = told(call, exit_code);
    const std::size_t at = out.find("next: ");
    if (at == std::string::npos) continue;
    ++told_next;
    const std::string next = out.substr(at + 6, out.find('\n', at) - at - 6);
    INFO(call << "\n" << next);
    // a shell reads the words; none but an output's, which stands behind its option, may name what is not
    // there
    std::istringstream words(furrow::io::run_program("sh", {"-c", "printf '%s\\n' " + next}).out);
    std::string before;
    for (std::string word; std::getline(words, word); before = word) {
      const bool is_output = before == "-o" || before == "--picture";
      if (is_output || std::filesystem::path(word).extension().empty()) continue;
      INFO(word);
      CHECK(std::filesystem::exists(word));
    }
  }
  CHECK(told_next >= 6);
}

TEST_CASE("report: who has a picture is not told to make one") {
  const ScratchDirectory scratch;
  const std::string sheet = source_file("meshes/hung_sheet.obj"), picture = " --size 220,220 --picture ";
  const std::string drape =
      "drape " + sheet + " --pin-loop 0 --subdivide 0 --max-iterations 2 -o " + (scratch / "d.ply");
  CHECK(told(drape, 4).find("next: furrow render") != std::string::npos);
  CHECK(told(drape + picture + (scratch / "d.png"), 4).find("next:") == std::string::npos);
  write_text(scratch / "lines.json", R"({"strokes":[{"height":0.01,"points":[[-0.1,0.3,0],[0.1,0.3,0]]}]})");
  const std::string settle = "wrinkle " + sheet + " " + (scratch / "lines.json") +
                             " --settle --rest drawn --pin-loop 0 -o " + (scratch / "s.ply");
  CHECK(told(settle + picture + (scratch / "s.png"), 0).find("next:") == std::string::npos);
}

TEST_CASE("report: after keep the call that moves its garment can be made as it is printed", "[release]") {
  const ScratchDirectory scratch;
  const std::string drawn = scratch / "drawn.ply", kept = scratch / "kept.ply", state = scratch / "state.ply";
  std::string sheet;
  for (int i = 0; i < 81; ++i)
    sheet += "v " + std::to_string(0.05 * (i % 9)) + " " + std::to_string(0.05 * (i / 9)) + " 0\n";
  for (int a = 1; a < 72; ++a)
    if (a % 9 != 0)
      for (const auto& [b, c] : {std::pair(a + 1, a + 10), {a + 10, a + 9}})
        sheet += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  write_text(scratch / "sheet.obj", sheet);
  write_text(scratch / "lines.json", R"({"strokes":[{"height":0.01,"points":[[0.05,0.2,0],[0.35,0.2,0]]}]})");
  REQUIRE(run_furrow("wrinkle " + (scratch / "sheet.obj") + " " + (scratch / "lines.json") + " -o " + drawn)
              .exit_code == 0);
  const auto next_of = [&](const std::string& outputs) {
    const std::string out =
        told("keep " + drawn + " --run 0.05 --gust 0 --pin-loop 0 --fabric cotton -o " + kept + outputs, 0);
    const std::size_t at = out.find("next: furrow ");
    return at == std::string::npos ? out : out.substr(at + 13, out.find('\n', at) - at - 13);
  };
  const std::string again = next_of(""), from_state = next_of(" --save-state " + state);
  CHECK(again == "simulate " + kept + " --fabric cotton --pin-loop 0 -o after.ply");
  CHECK(from_state == "simulate --state " + state + " -o after.ply");
  const std::size_t end = again.rfind(" -o ");
  CHECK(run_furrow(again.substr(0, end) + " --seconds 0.02 -o " + (scratch / "after.ply")).exit_code == 0);
}
