// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "run_furrow.h"

using namespace furrow::tests;
using nlohmann::json;

namespace {

/// A wall of n x n squares, 1 m wide, at z = 0, that looks towards +z, with texture coordinates.
struct Wall {
  ScratchDirectory scratch;
  std::string mesh = scratch / "wall.obj", strokes = scratch / "strokes.json", camera = scratch / "cam.json",
              picture = scratch / "wall.png", wrinkled = scratch / "wrinkled.ply";
  explicit Wall(int n = 16) {
    std::string text, faces;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const std::string u = std::to_string(double(j) / n), v = std::to_string(double(i) / n);
        text += "v " + u + " " + v + " 0\nvt " + u + " " + v + "\n";
      }
    const auto corner = [](int v) { return " " + std::to_string(v) + "/" + std::to_string(v); };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int a = i * (n + 1) + j + 1;
        faces += "f" + corner(a) + corner(a + 1) + corner(a + n + 2) + corner(a + n + 1) + "\n";
      }
    write_text(mesh, text + faces);
  }
  Run render(const std::string& more = "") {
    return run_furrow("render --json " + mesh + " -o " + picture +
                      " --view front --size 200,160 --quality draft " + "--save-camera " + camera + " " +
                      more);
  }
  /// "across" along the middle of the picture, "up" in the texture, "path" from vertex to vertex.
  void draw() {
    REQUIRE(render().exit_code == 0);
    write_text(strokes, R"({"camera":"cam.json","strokes":[
      {"name":"across","height":0.02,"pixels":[[60,79.5],[140,79.5]]},
      {"name":"up","height":-0.01,"texture":[[0.31,0.12],[0.31,0.33]]},
      {"name":"path","height":0.01,"vertices":[240,250]}]})");
  }
  json wrinkle(const std::string& what) {
    const Run run = run_furrow("wrinkle --json " + what);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return json::parse(run.out);
  }
};

}  // namespace

TEST_CASE("strokes: with a picture, its camera and pixels they are drawn without a 3D editor") {
  Wall wall;
  const json report = json::parse(wall.render().out);
  json camera = json::parse(read_text(wall.camera));
  CHECK(camera.erase("generator") == 1);
  CHECK(report["camera"] == camera);
  CHECK(report["camera"]["size"] == json{200, 160});
  wall.draw();
  const json lines = wall.wrinkle(wall.mesh + " " + wall.strokes + " -o " + wall.wrinkled)["lines"];
  REQUIRE(lines.size() == 3);
  CHECK(lines[0]["name"] == "across");
  for (const json& line : lines) {
    CHECK(line["parts"] == 1);
    CHECK(line["crest_height"].get<double>() == Approx(line["height"].get<double>()).epsilon(0.05));
  }
  const json listed =
      json::parse(run_furrow("strokes --json " + wall.strokes + " --garment " + wall.mesh).out)["strokes"];
  CHECK(listed[0]["kind"] == "pixels");
  CHECK(listed[0]["length"] == 80);
  // A wall of 1 m fills the picture's height but for its margins of 6 %.
  CHECK(listed[0]["length_on_garment"].get<double>() == Approx(80 / 160. / 0.88).epsilon(0.01));
  CHECK(listed[1]["length_on_garment"].get<double>() == Approx(0.21).epsilon(1e-3));
  CHECK(listed[2]["length_on_garment"].get<double>() == Approx(10 / 16.).epsilon(1e-9));
}

TEST_CASE(
    "strokes: the same camera takes the same picture again, and other options of the camera are refused with "
    "it") {
  Wall wall;
  REQUIRE(wall.render("--fov 40").exit_code == 0);
  const std::string first = read_text(wall.picture), again = wall.scratch / "again.png";
  REQUIRE(run_furrow("render -q " + wall.mesh + " -o " + again + " --quality draft --camera " + wall.camera)
              .exit_code == 0);
  CHECK(read_text(again) == first);
  CHECK(run_furrow("render -q " + wall.mesh + " -o " + again + " --camera " + wall.camera + " --view back")
            .exit_code == 2);
  CHECK(run_furrow("render -q " + wall.mesh + " -o " + again + " --eye 0,0,3").exit_code == 2);
  REQUIRE(wall.render("--orthographic 1.2").exit_code == 0);
  CHECK(json::parse(read_text(wall.camera))["parallel"] == 1.2);
  CHECK(wall.render("--orthographic 0").exit_code == 2);
}

TEST_CASE("strokes: a preview writes a picture and no mesh") {
  Wall wall;
  wall.draw();
  const std::string preview = wall.scratch / "preview.png";
  wall.wrinkle(wall.mesh + " " + wall.strokes + " --picture " + preview + " --camera " + wall.camera +
               " --quality draft");
  CHECK(read_text(preview).rfind("\x89PNG", 0) == 0);
  CHECK_FALSE(std::filesystem::exists(wall.wrinkled));
  CHECK(run_furrow("wrinkle " + wall.mesh + " " + wall.strokes).exit_code == 2);
  CHECK(run_furrow("wrinkle " + wall.mesh + " " + wall.strokes + " --picture " + wall.mesh).exit_code == 2);
}

TEST_CASE(
    "strokes: a wrinkled PLY drawn again without one has the same bytes as if it had never been drawn") {
  Wall wall;
  wall.draw();
  const std::string fewer = wall.scratch / "fewer.json", direct = wall.scratch / "direct.ply",
                    again = wall.scratch / "again.ply";
  wall.wrinkle(wall.mesh + " " + wall.strokes + " -o " + wall.wrinkled +
               " --fold-iterations 2 --density 0.2");
  REQUIRE(run_furrow("strokes -q " + wall.wrinkled + " --remove up -o " + fewer).exit_code == 0);
  wall.wrinkle(wall.mesh + " " + fewer + " -o " + direct + " --fold-iterations 2 --density 0.2");
  wall.wrinkle(wall.wrinkled + " --without up -o " + again);
  CHECK(read_text(again) == read_text(direct));
  CHECK(wall.wrinkle(wall.wrinkled + " -o " + again)["lines"].size() == 3);
  CHECK(read_text(again) == read_text(wall.wrinkled));

  const Run unknown = run_furrow("wrinkle " + wall.wrinkled + " --without upp -o " + again);
  CHECK(unknown.exit_code == 3);
  CHECK(unknown.err.find("did you mean 'up'") != std::string::npos);
  CHECK(run_furrow("wrinkle " + wall.mesh + " -o " + again).exit_code == 2);
  write_text(wall.mesh, read_text(wall.mesh) + "v 0 0 5\n");
  const Run changed = run_furrow("wrinkle " + wall.wrinkled + " -o " + again);
  CHECK(changed.exit_code == 3);
  CHECK(changed.err.find("has changed") != std::string::npos);
}

TEST_CASE("strokes: they are listed, moved, renamed, raised, laid into space") {
  Wall wall;
  wall.draw();
  const std::string out = wall.scratch / "out.json";
  REQUIRE(run_furrow("strokes -q " + wall.strokes +
                     " --move across=0,-20 --move up=0.1,0 --change path.height=-0.03 " +
                     "--rename up=side -o " + out)
              .exit_code == 0);
  const json moved = json::parse(read_text(out))["strokes"];
  CHECK(moved[0]["pixels"] == json{{60.0, 59.5}, {140.0, 59.5}});
  CHECK(moved[1]["texture"][0][0].get<double>() == Approx(0.41));
  CHECK(moved[1]["name"] == "side");
  CHECK(moved[2]["height"] == -0.03);
  REQUIRE(run_furrow("strokes -q " + wall.strokes + " --garment " + wall.mesh + " --in-space -o " + out)
              .exit_code == 0);
  const json laid = json::parse(read_text(out))["strokes"];
  CHECK(laid[0]["points"].size() > 10);
  CHECK(laid[0]["points"][0][1].get<double>() == Approx(0.5).margin(1e-3));
  CHECK(run_furrow("strokes " + wall.strokes + " --remove up").exit_code == 2);
  CHECK(run_furrow("strokes " + wall.strokes + " --move up -o " + out).exit_code == 2);
  CHECK(run_furrow("strokes " + wall.strokes + " --move path=1,2 -o " + out).exit_code == 2);
  CHECK(run_furrow("strokes " + wall.strokes + " --remove none -o " + out).exit_code == 3);
  CHECK(run_furrow("strokes " + wall.mesh).exit_code == 3);
}

TEST_CASE(
    "strokes: pixels beside the garment cut a stroke with a warning, or are refused if nothing is left") {
  Wall wall;
  wall.draw();
  write_text(wall.strokes,
             R"({"camera":"cam.json","strokes":[{"name":"hem","pixels":[[100,100],[100,159]]}]})");
  const Run cut = run_furrow("wrinkle " + wall.mesh + " " + wall.strokes + " -o " + wall.wrinkled);
  CHECK(cut.exit_code == 0);
  CHECK(cut.err.find("warning: stroke \"hem\": point 1 misses the garment") != std::string::npos);
  write_text(wall.strokes, R"({"camera":"cam.json","strokes":[{"name":"hem","pixels":[[1,1],[1,159]]}]})");
  const Run none = run_furrow("wrinkle " + wall.mesh + " " + wall.strokes + " -o " + wall.wrinkled);
  CHECK(none.exit_code == 3);
  CHECK(none.err.find("stroke \"hem\", point 0") != std::string::npos);
  write_text(wall.strokes, R"({"strokes":[{"name":"out","texture":[[0.5,0.5],[1.5,0.5]]}]})");
  CHECK(run_furrow("wrinkle " + wall.mesh + " " + wall.strokes + " -o " + wall.wrinkled)
            .err.find("stroke \"out\", point 1: (1.500000, 0.500000) lies outside") != std::string::npos);
}

TEST_CASE("strokes: width, sharpness, press and order are set, and the mesh carries them", "[long]") {
  Wall wall;
  wall.draw();
  const std::string edited = wall.scratch / "edited.json";
  const Run run = run_furrow(
      "strokes --json " + wall.strokes +
      " --change up.width=0.2 --change up.sharpness=0 --change up.press=10 --order path,up -o " + edited);
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const json list = json::parse(run.out)["strokes"];
  CHECK(list[0]["name"] == "path");
  CHECK(list[1]["name"] == "up");
  CHECK(list[2]["name"] == "across");
  CHECK(list[1]["width"] == 0.2);
  CHECK(list[1]["sharpness"] == 0);
  CHECK(list[1]["press"] == 10);
  CHECK_FALSE(list[0].contains("width"));
  const json wrinkled = wall.wrinkle(wall.mesh + " " + edited + " -o " + wall.wrinkled);
  CHECK(wrinkled["lines"][1]["width"] == 0.2);
  CHECK(wrinkled["lines"][1]["crest_height"].get<double>() ==
        Approx(-0.01).epsilon(0.25));  // another line is near
  const Run again = run_furrow("strokes --json " + wall.wrinkled + " --change up.width=none -o " + edited);
  CHECK_FALSE(json::parse(again.out)["strokes"][1].contains("width"));
  CHECK(json::parse(again.out)["strokes"][1]["press"] == 10);
  const Run thread = run_furrow("strokes --json " + wall.wrinkled + " --change up.gather=0.7 -o " + edited);
  CHECK(json::parse(thread.out)["strokes"][1]["gather"] == 0.7);
  CHECK(run_furrow("strokes " + edited).out.find("gather to 70 %") != std::string::npos);
  const Run none = run_furrow("strokes --json " + edited + " --change up.gather=none -o " + edited);
  CHECK_FALSE(json::parse(none.out)["strokes"][1].contains("gather"));
  // The press has no effect on cross springs.
  const Run idle = run_furrow("simulate " + wall.wrinkled + " --membrane paper --seconds 0.001 -o " +
                              (wall.scratch / "s.ply"));
  CHECK(idle.err.find("'up': its press has no effect") != std::string::npos);
  const Run hinges = run_furrow("simulate " + wall.wrinkled + " --fabric cotton --seconds 0.001 -o " +
                                (wall.scratch / "s.ply"));
  CHECK(hinges.err.find("press") == std::string::npos);
  for (const std::string flags :
       {"--change up.width=0", "--change up.sharpness=1.5", "--change up.press=0.1",
        "--change up.flare=maybe", "--change up.taper=-1", "--change up.set=2", "--change up.smooth=-1",
        "--change up.gather=2", "--order up,up", "--order nobody",
        "--change up.width=0.1 --change up.sharpness=2", "--change up=0.1", "--change up.heigth=0.1"})
    CHECK(run_furrow("strokes " + wall.strokes + " " + flags + " -o " + edited).exit_code != 0);
}

TEST_CASE("wrinkle: --width is that of strokes that name none, and --strokes names their file", "[long]") {
  const ScratchDirectory scratch;
  const std::string sheet = source_file("meshes/sheet.obj");
  write_text(scratch / "l.json", R"({"strokes": [{"name": "a", "points": [[-0.2,0.3,0],[0.2,0.3,0]]},
                                                 {"name": "b", "width": 0.1, "points": [[-0.2,0.7,0],[0.2,0.7,0]]}]})");
  const Run run = run_furrow("wrinkle --json " + sheet + " --strokes " + (scratch / "l.json") +
                             " --width 0.08 -o " + (scratch / "w.ply"));
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const json lines = json::parse(run.out)["lines"];
  CHECK(lines[0]["width"] == 0.08);
  CHECK(lines[1]["width"] == 0.1);
  // Drawn again, its lines are as wide.
  const Run again = run_furrow("wrinkle --json " + (scratch / "w.ply") + " -o " + (scratch / "again.ply"));
  INFO(again.err);
  REQUIRE(again.exit_code == 0);
  CHECK(json::parse(again.out)["lines"] == lines);
  CHECK(run_furrow("wrinkle " + (scratch / "w.ply") + " --width 0.1 -o " + (scratch / "b.ply")).exit_code ==
        2);
  CHECK(run_furrow("wrinkle " + sheet + " " + (scratch / "l.json") + " --width 0 -o " + (scratch / "b.ply"))
            .exit_code == 2);
}
