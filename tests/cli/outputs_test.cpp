// SPDX-License-Identifier: GPL-3.0-or-later
// What is written where: nothing that is read is replaced, units are kept, folders of scenes are made.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "run_furrow.h"

using namespace furrow::tests;
using nlohmann::json;

namespace {

bool holds(const std::string& text, const std::string& part) {
  INFO("'" << text << "' should hold '" << part << "'");
  CHECK(text.find(part) != std::string::npos);
  return text.find(part) != std::string::npos;
}

/// A hanging wall of n x n quads, `size` of the file's units wide, with texture coordinates.
std::string wall(int n, double size) {
  std::string text, faces;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const double u = double(j) / n, v = double(i) / n;
      text += "v " + std::to_string(size * u) + " " + std::to_string(size * v) + " 0\nvt " +
              std::to_string(u) + " " + std::to_string(v) + "\n";
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      faces += "f";
      for (const int v :
           {i * (n + 1) + j, i * (n + 1) + j + 1, (i + 1) * (n + 1) + j + 1, (i + 1) * (n + 1) + j})
        faces += " " + std::to_string(v + 1) + "/" + std::to_string(v + 1);
      faces += "\n";
    }
  return text + faces;
}

struct Files {
  ScratchDirectory scratch;
  std::string mesh = scratch / "wall.obj", cm = scratch / "cm.obj", lines = scratch / "lines.json",
              wrinkled = scratch / "w.ply";
  Files() {
    write_text(mesh, wall(8, 1));
    write_text(cm, wall(8, 100));
    write_text(lines, R"({"strokes":[{"name":"a","height":0.02,"vertices":[30,34]}]})");
  }
  std::string operator/(const std::string& name) const { return scratch / name; }
  /// In centimetres.
  void wrinkle() {
    REQUIRE(run_furrow("wrinkle -q --unit cm " + cm + " " + lines + " -o " + wrinkled).exit_code == 0);
  }
  std::string unit_of(const std::string& ply) const {
    const std::string text = read_text(ply), key = "\"unit\":\"";
    const auto at = text.find(key);
    return at == std::string::npos
               ? ""
               : text.substr(at + key.size(), text.find('"', at + key.size()) - at - key.size());
  }
};

}  // namespace

TEST_CASE("outputs: no output may replace what is read or another output, and pictures are PNG") {
  Files f;
  f.wrinkle();
  write_text(f / "cam.json", "{}");
  write_text(f / "t.png", "");
  for (const std::string& call : {
           "render " + f.mesh + " -o " + (f / "a.jpg"),
           "render " + f.mesh + " -o " + f.mesh,
           "render " + f.mesh + " --body " + (f / "t.png") + " -o " + (f / "t.png"),
           "render " + f.mesh + " --texture " + (f / "t.png") + " -o " + (f / "./t.png"),
           "render " + f.mesh + " -o " + (f / "a.png") + " --save-camera " + (f / "a.png"),
           "render " + f.mesh + " -o " + (f / "a.png") + " --strokes " + f.lines + " --save-camera " +
               f.lines,
           "render " + f.mesh + " -o " + (f / "a.png") + " --camera " + (f / "cam.json") + " --save-camera " +
               (f / "cam.json"),
           "render " + f.mesh + " -o " + (f / "a.png") + " --captions one",
           "render " + f.mesh + " -o " + (f / "a.png") + " --fov 0",
           "wrinkle " + f.mesh + " " + f.lines + " --picture " + (f / "p.jpg"),
           "wrinkle " + f.mesh + " " + f.lines + " --picture " + (f / "p.png") + " --camera " +
               (f / "cam.json") + " --save-camera " + (f / "cam.json"),
           "wrinkle " + f.wrinkled + " -o " + f.cm,
           "subdivide " + f.mesh + " --strokes " + f.lines + " -o " + f.lines,
           "sdf " + f.mesh + " --picture " + f.mesh,
           "sdf " + f.mesh + " --picture " + (f / "s.field"),
           "transfer " + f.cm + " " + f.wrinkled + " -o " + f.wrinkled,
           "transfer " + f.cm + " " + f.wrinkled + " -o " + f.cm,
           "bake " + f.cm + " " + f.wrinkled + " -o " + (f / "b") + " --check 0 --applied " + f.cm,
           "strokes " + f.wrinkled + " --rename a=b -o " + f.wrinkled,
           "strokes " + f.lines + " --garment " + f.mesh + " -o " + f.mesh,
           "strokes " + f.lines + " --remove a -o " + (f / "none.json"),
       }) {
    INFO("furrow " << call);
    const Run run = run_furrow(call);
    CHECK(run.exit_code == 2);
    CHECK(run.err.rfind("error: ", 0) == 0);
  }
  CHECK_FALSE(std::filesystem::exists(f / "a.png"));
  CHECK(read_text(f.mesh) == wall(8, 1));
  CHECK(run_furrow("render " + f.mesh + " -o " + (f / "no/a.png")).exit_code == 1);
}

TEST_CASE("outputs: no subcommand replaces what it reads, by whatever name") {
  Files f;
  f.wrinkle();
  const std::string before = read_text(f.wrinkled), state = f / "s.ply";
  std::filesystem::create_symlink(f.wrinkled, f / "link.ply");
  std::filesystem::create_hard_link(f.wrinkled, f / "hard.ply");
  const std::string pinned = "simulate --seconds 0.01 --pin-loop 0 ";
  REQUIRE(run_furrow(pinned + f.wrinkled + " --save-state " + state).exit_code == 0);
  const std::string state_before = read_text(state);
  for (const std::string& call :
       {"subdivide --linear 1 " + f.wrinkled, "smooth " + f.wrinkled, "wrinkle " + f.wrinkled,
        "wrinkle " + f.wrinkled + " " + f.lines, pinned + f.wrinkled, "transfer " + f.cm + " " + f.wrinkled})
    for (const std::string& output : {f.wrinkled, f / "link.ply", f / "hard.ply", f / "./w.ply"}) {
      INFO("furrow " << call << " -o " << output);
      const Run run = run_furrow(call + " -o " + output);
      CHECK(run.exit_code == 2);
      CHECK(holds(run.err, "would replace"));
    }
  CHECK(run_furrow("simulate --seconds 0.02 --state " + state + " --save-state " + state).exit_code == 2);
  CHECK(read_text(f.wrinkled) == before);
  CHECK(read_text(state) == state_before);
}

TEST_CASE("outputs: a file that furrow did not write is replaced with --replace only, its own without",
          "[long]") {
  Files f;
  f.wrinkle();
  const std::string foreign = "# another program\no shirt\nv 0.000000 0.000000 0.000000\n";
  const std::string small = " --size 60,60 --quality draft ", ball = source_file("meshes/mannequin.obj");
  const std::vector<std::pair<std::string, std::string>> calls{
      {"subdivide --linear 1 " + f.mesh + " -o ", "o.obj"},
      {"smooth " + f.mesh + " -o ", "o.ply"},
      {"wrinkle " + f.mesh + " " + f.lines + " -o ", "o.ply"},
      {"wrinkle " + f.mesh + " " + f.lines + small + " --picture ", "p.png"},
      {"wrinkle " + f.mesh + " " + f.lines + " -o " + (f / "w2.ply") + " --inserted ", "i.off"},
      {"simulate --settle --seconds 0 --pin-loop 0 " + f.mesh + " -o " + (f / "o2.ply") + " --settled ",
       "set.ply"},
      {"simulate --seconds 0.01 --pin-loop 0 " + f.mesh + " -o ", "o.stl"},
      {"simulate --seconds 0.01 --pin-loop 0 " + f.mesh + " --save-state ", "s.ply"},
      {"simulate --seconds 0.1 --pin-loop 0 " + f.mesh + " --animation ", "a.mdd"},
      {"simulate --seconds 0.1 --pin-loop 0 " + f.mesh + " --animation ", "a.pc2"},
      {"simulate --seconds 0.1 --pin-loop 0 " + f.mesh + " --animation ", "a.glb"},
      {"transfer " + f.cm + " " + f.wrinkled + " -o ", "back.obj"},
      {"render " + f.mesh + small + " -o ", "r.png"},
      {"render " + f.mesh + small + " -o " + (f / "r2.png") + " --save-camera ", "cam.json"},
      {"doctor " + f.mesh + " --repair -o ", "d.obj"},
      {"strokes " + f.wrinkled + " --rename a=b -o ", "s.json"},
      {"sdf " + ball + " --tolerance 0.01 --picture ", "b.png"},
  };
  for (const auto& [call, name] : calls) {
    write_text(f / name, foreign);
    INFO("furrow " << call << name);
    const Run refused = run_furrow(call + (f / name));
    CHECK(refused.exit_code == 2);
    CHECK(holds(refused.err, name + ": exists, and furrow did not write it"));
    CHECK(holds(refused.err, "--replace"));
    CHECK(read_text(f / name) == foreign);
    CHECK(run_furrow(call + (f / name) + " --replace").exit_code != 2);
    CHECK(read_text(f / name) != foreign);
    const Run again = run_furrow(call + (f / name));
    INFO(again.err);
    CHECK(again.exit_code != 2);
  }
}

TEST_CASE("outputs: strokes may take the place of their own file, not that of another one") {
  Files f;
  CHECK(run_furrow("strokes " + f.lines + " --rename a=b -o " + f.lines).exit_code == 0);
  write_text(f / "other.json", R"({"strokes":[{"name":"c","height":0.02,"vertices":[30,34]}]})");
  const std::string call = "strokes " + f.lines + " --rename b=d -o " + (f / "other.json");
  CHECK(run_furrow(call).exit_code == 2);
  CHECK(holds(read_text(f / "other.json"), "\"c\""));
  CHECK(run_furrow(call + " --replace").exit_code == 0);
}

TEST_CASE("outputs: those of a scene do not replace what furrow did not write") {
  Files f;
  const std::string scene = f / "s.toml";
  write_text(scene,
             "[garment]\nmesh = \"wall.obj\"\n[[pins]]\nloop = 0\n[simulation]\nseconds = 0\n"
             "[output]\nmesh = \"o.ply\"\n");
  write_text(f / "o.ply", "mine");
  CHECK(run_furrow("simulate -q " + scene).exit_code == 2);
  CHECK(read_text(f / "o.ply") == "mine");
  CHECK(run_furrow("simulate -q --replace " + scene).exit_code == 0);
  CHECK(run_furrow("simulate -q " + scene).exit_code == 0);
}

TEST_CASE("outputs: those of a scene stay below its folder unless the command line says so") {
  Files f;
  std::filesystem::create_directory(f / "scene");
  std::filesystem::create_directory(f / "elsewhere");
  std::filesystem::create_directory_symlink(f / "elsewhere", f / "scene/link");
  const std::string scene = f / "scene/s.toml";
  const auto write_scene = [&](const std::string& output) {
    write_text(scene,
               "[garment]\nmesh = \"../wall.obj\"\n[[pins]]\nloop = 0\n[simulation]\nseconds = 0\n"
               "[output]\nmesh = \"" +
                   output + "\"\n");
  };
  for (const std::string& output :
       {std::string("../victim/o.ply"), f / "victim/o.ply", std::string("link/o.ply")}) {
    INFO(output);
    write_scene(output);
    const Run run = run_furrow("simulate -q " + scene);
    CHECK(run.exit_code == 2);
    CHECK(holds(run.err, "s.toml:8:"));
    CHECK(holds(run.err, "--outputs-below"));
    CHECK_FALSE(std::filesystem::exists(f / "victim"));
    CHECK(std::filesystem::is_empty(f / "elsewhere"));
    CHECK(run_furrow("simulate -q " + scene + " -o " + (f / "o.ply")).exit_code == 0);
  }
  write_scene("../victim/o.ply");
  CHECK(run_furrow("simulate -q " + scene + " --outputs-below " + (f / ".")).exit_code == 0);
  CHECK(std::filesystem::exists(f / "victim/o.ply"));
}

TEST_CASE("outputs: a state has none, whatever a stranger wrote into it") {
  Files f;
  f.wrinkle();
  REQUIRE(run_furrow("simulate --seconds 0.01 --pin-loop 0 " + f.wrinkled + " --save-state " + (f / "s.ply"))
              .exit_code == 0);
  std::string text = read_text(f / "s.ply");
  const std::string key = "\"scene\":{";
  REQUIRE(text.find(key) != std::string::npos);
  text.insert(text.find(key) + key.size(), R"("output":{"mesh":"evil.obj"},)");
  write_text(f / "evil.ply", text);
  const std::string call = "simulate --seconds 0.02 --state " + (f / "evil.ply");
  CHECK(run_furrow(call).exit_code == 2);
  CHECK(run_furrow(call + " -o " + (f / "o.ply")).exit_code == 0);
  CHECK_FALSE(std::filesystem::exists(f / "evil.obj"));
}

TEST_CASE("outputs: a garment that came in centimetres goes on and out in centimetres", "[long]") {
  Files f;
  f.wrinkle();
  const auto height = [&](const std::string& path, const std::string& flags = "") {
    return json::parse(run_furrow("info --json " + flags + " " + path).out)["bounding_box"]["max"][1]
        .get<double>();
  };
  for (const std::string& call :
       {"wrinkle " + f.wrinkled + " " + f.lines, "smooth " + f.wrinkled, "subdivide --linear 1 " + f.wrinkled,
        "simulate --seconds 0 --pin-loop 0 " + f.wrinkled, "wrinkle " + f.wrinkled}) {
    INFO(call);
    REQUIRE(run_furrow(call + " -q -o " + (f / "o.obj")).exit_code == 0);
    CHECK(height(f / "o.obj", "--unit m") == Approx(100).margin(3));
    REQUIRE(run_furrow(call + " -q -o " + (f / "o.ply")).exit_code == 0);
    CHECK(height(f / "o.ply") == Approx(1).margin(0.03));
    CHECK(f.unit_of(f / "o.ply") == "cm");
  }
  // A state is in metres, and knows in what its garment came.
  REQUIRE(
      run_furrow("simulate -q --seconds 0.01 --pin-loop 0 " + f.wrinkled + " --save-state " + (f / "s.ply"))
          .exit_code == 0);
  CHECK(height(f / "s.ply") == Approx(1).margin(0.02));
  REQUIRE(
      run_furrow("simulate -q --seconds 0.02 --state " + (f / "s.ply") + " -o " + (f / "o.obj")).exit_code ==
      0);
  CHECK(height(f / "o.obj", "--unit m") == Approx(100).margin(2));
  REQUIRE(run_furrow("smooth -q --unit m " + f.wrinkled + " -o " + (f / "o.obj")).exit_code == 0);
}

TEST_CASE("outputs: transfer, bake and strokes take the unit that one of their meshes notes") {
  Files f;
  f.wrinkle();
  REQUIRE(run_furrow("transfer " + f.cm + " " + f.wrinkled + " -o " + (f / "back.obj")).exit_code == 0);
  const std::string back = read_text(f / "back.obj");
  CHECK(back.substr(back.find("vt ")).find("f 1/1 2/2 11/11 10/10\n") != std::string::npos);  // quads
  CHECK(run_furrow("bake --texels 64 " + f.cm + " " + f.wrinkled + " -o " + (f / "b")).exit_code == 0);
  const Run other = run_furrow("bake --texels 64 --unit m " + f.mesh + " " + f.wrinkled + " -o " + (f / "c"));
  CHECK(other.exit_code == 3);
  CHECK(holds(other.err, "--unit"));
  CHECK_FALSE(std::filesystem::exists(f / "c_maps.json"));
  REQUIRE(run_furrow("wrinkle -q " + f.mesh + " " + f.lines + " -o " + (f / "m.ply")).exit_code == 0);
  const Run far = run_furrow("transfer " + f.cm + " " + (f / "m.ply") + " -o " + (f / "d.obj"));
  CHECK(far.exit_code == 3);
  CHECK(holds(far.err, "--unit"));
  REQUIRE(run_furrow("strokes -q --garment " + f.cm + " --in-space " + f.wrinkled + " -o " + (f / "s.json"))
              .exit_code == 0);
  const auto points = json::parse(read_text(f / "s.json"))["strokes"][0]["points"];
  CHECK(points.back()[0].get<double>() > 50);
}

TEST_CASE("outputs: a body is read in the garment's unit, one too tall is refused, one elsewhere is told") {
  Files f;
  f.wrinkle();
  std::string box;
  for (int i = 0; i < 8; ++i)
    box += "v " + std::to_string(i & 1 ? 90 : 10) + " " + std::to_string(i & 2 ? 90 : 10) + " " +
           std::to_string(i & 4 ? -1 : -30) + "\n";
  box += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  write_text(f / "box.obj", box);
  const std::string call = "simulate --seconds 0 --tolerance 0.01 -o " + (f / "o.ply") + " " + f.wrinkled;
  const Run apart = run_furrow(call + " --body " + (f / "box.obj"));
  CHECK(apart.exit_code == 0);
  CHECK(holds(apart.err, "body and garment lie apart"));  // by the centimetre between them
  const Run tall =
      run_furrow("simulate --seconds 0 -o " + (f / "o.ply") + " " + f.mesh + " --body " + (f / "box.obj"));
  CHECK(tall.exit_code == 3);
  CHECK(holds(tall.err, "the body is 80"));
  CHECK(holds(run_furrow("info " + (f / "box.obj")).err, "--unit cm"));
}

TEST_CASE("outputs: drawn again, typed options go over those of the record, which keeps --max-weights") {
  Files f;
  const auto options = [&](const std::string& path) {
    const std::string text = read_text(path), key = "\"options\":\"";
    const auto at = text.find(key) + key.size();
    return text.substr(at, text.find('"', at) - at);
  };
  REQUIRE(run_furrow("wrinkle -q " + f.mesh + " " + f.lines +
                     " --rule safe --iterations 3 --max-weights 2 -o " + f.wrinkled)
              .exit_code == 0);
  REQUIRE(run_furrow("wrinkle -q " + f.wrinkled + " -o " + (f / "same.ply")).exit_code == 0);
  CHECK(read_text(f / "same.ply") == read_text(f.wrinkled));
  REQUIRE(
      run_furrow("wrinkle -q " + f.wrinkled + " --iterations 7 --keep-lines --mu -0.35 -o " + (f / "o.ply"))
          .exit_code == 0);
  const std::string changed = options(f / "o.ply");
  CHECK(holds(changed, "--iterations 7"));
  CHECK(holds(changed, "--mu -0.35"));
  CHECK(holds(changed, "--keep-lines"));
  CHECK(holds(changed, "--max-weights 2"));
  CHECK(run_furrow("wrinkle " + f.wrinkled + " --height 0.1 -o " + (f / "o.ply")).exit_code == 2);
}

TEST_CASE("outputs: folders that a scene file names are made, those of flags must be there") {
  Files f;
  const std::string scene = f / "s.toml";
  write_text(scene,
             "[garment]\nmesh = \"wall.obj\"\n[[pins]]\nloop = 0\n[simulation]\nseconds = 0\n"
             "[output]\nmesh = \"new/deep/o.ply\"\n");
  CHECK(run_furrow("simulate -q " + scene + " -o " + (f / "none/o.ply")).exit_code == 1);
  CHECK(run_furrow("simulate -q " + scene).exit_code == 0);
  CHECK(std::filesystem::exists(f / "new/deep/o.ply"));
  write_text(scene, "[garment]\nmesh = \"walll.obj\"\n[output]\nmesh = \"o.ply\"\n");
  CHECK(holds(run_furrow("simulate " + scene).err, "s.toml:2:1: garment.mesh: there is no file"));
}

TEST_CASE("outputs: what a format does not keep, and what is of no use, is told") {
  Files f;
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty float vx\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0 1\n1 0 0 2\n0 1 0 3\n3 0 1 2\n";
  write_text(f / "a.ply", head);
  CHECK(holds(run_furrow("smooth --iterations 0 " + (f / "a.ply") + " -o " + (f / "a.obj")).err,
              "not written: vx"));
  CHECK(run_furrow("smooth --iterations 0 " + (f / "a.ply") + " -o " + (f / "b.ply")).err.empty());
  const Run state = run_furrow("simulate --seconds 1000000 --pin-vertices 0 " + (f / "a.ply") +
                               " --save-state " + (f / "s.ply"));
  CHECK(state.exit_code == 3);
  CHECK(holds(state.err, "'vx'"));
  write_text(f / "flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.5\nf 1/1 2/1 3/1\n");
  const Run flat = run_furrow("bake " + (f / "flat.obj") + " " + (f / "flat.obj") + " -o " + (f / "m"));
  CHECK(flat.exit_code == 3);
  CHECK(holds(flat.err, "flat.obj"));
}

TEST_CASE("outputs: lines over the hem need no larger --max-distance than their own points do") {
  Files f;
  REQUIRE(run_furrow("render -q " + f.mesh + " -o " + (f / "a.png") +
                     " --view front --size 100,100 --quality draft "
                     "--save-camera " +
                     (f / "cam.json"))
              .exit_code == 0);
  write_text(f.lines, R"({"camera":"cam.json","strokes":[{"name":"hem","pixels":[[50,60],[50,150]]}]})");
  const Run run = run_furrow("wrinkle --max-distance 0.001 " + f.mesh + " " + f.lines + " -o " + f.wrinkled);
  INFO(run.err);
  CHECK(run.exit_code == 0);
  CHECK(holds(run.err, "point 1 lies outside of the camera's picture of 100 by 100 pixels"));
}

TEST_CASE("outputs: endings mean the same in capitals, for each kind of output and input") {
  Files f;
  f.wrinkle();
  std::filesystem::copy_file(f.mesh, f / "WALL.OBJ");
  std::filesystem::copy_file(f.lines, f / "LINES.JSON");
  const std::string run = "simulate -q --seconds 0.02 --pin-loop 0 ";
  for (const std::string& call :
       {"wrinkle -q " + (f / "WALL.OBJ") + " " + (f / "LINES.JSON") + " -o " + (f / "W.PLY"),
        run + (f / "W.PLY") + " -o " + (f / "O.PLY") + " --save-state " + (f / "S.PLY"),
        "simulate -q --seconds 0.02 --state " + (f / "S.PLY") + " -o " + (f / "O2.Ply"),
        "wrinkle -q --state " + (f / "S.PLY") + " " + (f / "LINES.JSON") + " -o " + (f / "S2.PLY"),
        run + (f / "W.PLY") + " --animation " + (f / "A.PC2"),
        "strokes -q " + (f / "W.PLY") + " -o " + (f / "L.JSON"),
        "render -q --size 60,60 --quality draft " + (f / "W.PLY") + " -o " + (f / "P.PNG")}) {
    const Run done = run_furrow(call);
    INFO(call << "\n" << done.err);
    CHECK(done.exit_code == 0);
  }
  write_text(f / "S.TOML",
             "[garment]\nmesh = \"wall.obj\"\n[[pins]]\nloop = 0\n[simulation]\nseconds = 0\n"
             "[output]\nmesh = \"T.PLY\"\n");
  CHECK(run_furrow("simulate -q " + (f / "S.TOML")).exit_code == 0);
}
