// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_file.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/mesh/errors.h"
#include "io/scene/fabrics.h"
#include "io/scene/relocated.h"
#include "io/scene/scene_rules.h"

using namespace furrow;
using io::parse_toml;

namespace {

io::Scene scene(const std::string& text) { return io::read_scene(parse_toml(text, "a/s.toml"), "a"); }

std::string fault(const std::string& text) {
  try {
    scene(text);
  } catch (const geometry::ContentError& e) {
    return e.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part) {
  INFO("'" << text << "' should hold '" << part << "'");
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("scene_file: lines are drawn by the rule fold, and what a rule does not use is refused") {
  const std::string lines = "[garment]\nmesh = \"g.obj\"\n[[lines]]\nstrokes = \"l.json\"\n";
  const auto rule_of = [&](const std::string& more) {
    return scene(lines + more).lines[0].options.insertion.rule;
  };
  CHECK(rule_of("") == geometry::InsertionRule::fold);
  CHECK(rule_of("rule = \"safe\"\niterations = 3\n") == geometry::InsertionRule::safe);
  CHECK(has(fault(lines + "iterations = 3\n"), "lines.0.iterations = 3 goes with rule = \"safe\""));
  CHECK(has(fault(lines + "region = \"whole-mesh\"\n"), "goes with rule = \"safe\""));
  CHECK(has(fault(lines + "rule = \"paper\"\ndetail = \"fine\"\n"), "goes with rule = \"fold\""));
}

TEST_CASE("scene_file: a scene file says everything that a simulation is made of") {
  const io::Scene s = scene(R"(
title = "all"
unit = "cm"
up = "z"
[garment]
mesh = "g.obj"
subdivide = 1
[[lines]]
strokes = "../l.json"
height = 0.02
rest = "flat"
rule = "safe"
iterations = 4
keep_lines = true
without = ["b"]
[[lines]]
strokes = "m.json"
time = 1.5
fade = 0.1
[body]
mesh = "b.obj"
cache = "kept"
tolerance = 0.001
gradient = "interpolated"
[body.motion]
pivot = [0, 1, 0]
keyframes = [{time = 0}, {time = 2, translation = [0, 0, 1], rotation = [0, 3.1, 0]}]
spin = {axis = [0, 1, 0], rate = 3, start = 1, ramp = 0.5}
[material]
density = 0.2
stiffness = 500
bending = 2
friction = 0.4
[[pins]]
loop = "top"
motion.spin = {rate = 2}
[[pins]]
vertices = [1, 2]
[forces]
gravity = 1.6
wind = [1, 2, 3]
swirl = {rate = 4}
gusts = [{time = 0, factor = 0}, {time = 1, factor = 2}]
[simulation]
seconds = 3
stop_at = 1
integrator = "rk4"
sweeps = 4
threads = 2
[output]
mesh = "o.ply"
animation = "o.pc2"
fps = 30
)");
  CHECK(s.garment == "a/g.obj");
  CHECK(s.unit == "cm");
  CHECK(s.up == "z");
  CHECK(s.subdivide == 1);
  REQUIRE(s.lines.size() == 2);
  CHECK(s.lines[0].strokes == "l.json");
  CHECK(s.lines[0].options.rest == geometry::RestRule::flat);
  CHECK(s.lines[0].options.smoothing.iterations == 4);
  CHECK(s.lines[0].options.smoothing.lines == geometry::LineRule::keep);
  CHECK(s.lines[0].without == std::vector<std::string>{"b"});
  CHECK(s.lines[1].time == 1.5);
  CHECK(s.lines[1].fade == 0.1);
  REQUIRE(s.body);
  CHECK(s.body->cache.filename() == "kept");
  CHECK(s.body->options.tolerance == 0.001);
  CHECK(s.body->options.gradient == physics::GradientRule::interpolated_corners);
  REQUIRE(s.body->motion.keyframes.size() == 2);
  CHECK(s.body->motion.keyframes[1].rotation.y() == 3.1);
  CHECK(s.body->motion.spin->ramp == 0.5);
  CHECK(s.material.density == 0.2);
  CHECK(s.material.bending == 2);
  CHECK(s.simulation.friction == 0.4);
  REQUIRE(s.pins.size() == 2);
  CHECK(s.pins[0].loop == "top");
  CHECK(s.pins[0].motion.spin->rate == 2);
  CHECK(s.pins[1].vertices == std::vector<int>{1, 2});
  CHECK(s.simulation.gravity.y() == -1.6);
  CHECK(s.wind.velocity.z() == 3);
  CHECK(s.wind.swirl->rate == 4);
  CHECK(s.wind.gusts[1].factor == 2);
  CHECK(s.stop_at == 1.0);
  CHECK(s.simulation.integrator == physics::Integrator::rk4);
  CHECK(s.simulation.xpbd.iterations == 4);
  CHECK(s.output.animation == "a/o.pc2");
  CHECK(s.output.fps == 30);
}

TEST_CASE("scene_file: the rules of the rest state have their names") {
  using geometry::RestRule;
  for (const auto& [name, rule] :
       {std::pair("drawn", RestRule::drawn), {"flat", RestRule::flat}, {"copied", RestRule::copied}})
    CHECK(scene(std::string("[garment]\nmesh = \"g.obj\"\n[[lines]]\nstrokes = \"l.json\"\nrest = \"") +
                name + "\"\n")
              .lines[0]
              .options.rest == rule);
}

TEST_CASE("scene_file: a chain's stiffness and mass are of its length") {
  const io::SceneMaterial m =
      scene("[garment]\nmesh = \"c.obj\"\n[material]\nline_stretch = 150\nline_density = 0.07\n").material;
  CHECK(m.line_stretch == 150);
  CHECK(m.line_density == 0.07);
  CHECK(has(fault("[material]\nline_stretch = 0\n"), "must be a number > 0 [N]"));
  CHECK(has(fault("[material]\nline_density = -1\n"), "must be a number > 0 [kg/m]"));
}

TEST_CASE("scene_file: the cloth of fast fitting has quadratic tension, and the same mass for each vertex") {
  const io::SceneMaterial m = scene(
                                  "[garment]\nmesh = \"g.obj\"\n[material]\nmembrane = \"tension\"\n"
                                  "tension = 3e4\ncompression = 0\nshear = 1\nmass_rule = \"equal\"\n")
                                  .material;
  CHECK(m.membrane == bridge::Membrane::tension);
  CHECK(m.tension == 3e4);
  CHECK(m.compression == 0);
  CHECK(m.shear == 1);
  CHECK(m.mass_rule == bridge::MassRule::equal);
  CHECK(has(fault("[material]\ntension = 0\n"), "must be a number > 0 [N/m]"));
  CHECK(has(fault("[material]\ncompression = 1.5\n"), "material.compression = 1.5"));
  CHECK(has(fault("[material]\nshear = -1\n"), "material.shear = -1"));
  CHECK(has(fault("[material]\nmass_rule = \"none\"\n"), "equal"));
  const io::SceneMaterial denim =
      scene("[garment]\nmesh = \"g.obj\"\n[material]\npreset = \"denim\"\nmembrane = \"tension\"\n").material;
  CHECK(denim.membrane == bridge::Membrane::tension);
  CHECK_FALSE(denim.tension);
  CHECK(denim.shear == Approx(4 * 106.8 / 1219.2));
  // At 2 % as much as the linear law: c e^2 = Y e.
  CHECK(io::tension_constant(1219.2) * 0.02 * 0.02 == Approx(1219.2 * 0.02));
  for (const io::Fabric& fabric : io::fabrics()) {
    CHECK(io::shear_ratio(fabric) > 0);
    CHECK(io::shear_ratio(fabric) <= 1);
  }
  CHECK(io::shear_ratio(io::fabric_named("jersey")) == 1);
}

TEST_CASE("scene_file: cloth with threads has all six figures, and none of cloth without") {
  const std::string begin = "[garment]\nmesh = \"g.obj\"\n[material]\n",
                    denim = begin + "preset = \"black-denim\"\n",
                    six =
                        "warp_stretch = 400\nweft_stretch = 300\nthread_shear = 50\nwarp_rigidity = 2e-5\n"
                        "weft_rigidity = 1e-5\nbias_rigidity = 1.2e-5\n";
  const io::SceneMaterial m = scene(denim).material;
  CHECK(m.is_woven());
  CHECK(m.bending_law == bridge::Bending::plate);
  CHECK(m.warp == "auto");
  CHECK(scene(begin + six).material.is_woven());
  CHECK(scene(denim + "warp_stretch = 500\n").material.warp_stretch == 500.);
  const io::SceneMaterial plain = scene(denim + "warp = \"none\"\nstretch = 300\n").material;
  CHECK_FALSE(plain.is_woven());
  CHECK(plain.bending_law == bridge::Bending::plate);
  CHECK(scene(denim + "warp = \"none\"\nbending_law = \"hinge\"\n").material.bending_law ==
        bridge::Bending::hinge);
  CHECK(scene(denim + "warp = \"lines.json\"\n").material.warp == "a/lines.json");
  CHECK(has(fault(begin + six.substr(0, six.find("bias"))), "material.bias_rigidity is missing"));
  CHECK(has(fault(denim + "rigidity = 1e-5\n"), "say warp = \"none\""));
  CHECK(has(fault(denim + "warp = \"sideways\"\n"), "is none of auto, none, file"));
  CHECK(has(fault(begin + six + "weft_rigidity = 0\n"), "weft_rigidity"));
}

TEST_CASE("scene_file: what comes to rest first needs a body or pins, and the stage at rest needs settle") {
  const std::string settle = "[simulation]\nsettle = true\n[output]\nsettled = \"r.ply\"\n",
                    pins = "[[pins]]\nloop = \"top\"\n";
  const io::Scene s = scene("[garment]\nmesh = \"g.obj\"\n" + settle + pins);
  CHECK(s.settle);
  CHECK(s.output.settled == "a/r.ply");
  CHECK_FALSE(scene("[garment]\nmesh = \"g.obj\"\n" + pins).settle);
  CHECK(has(fault(settle), "a/s.toml:2:1: simulation.settle needs what the garment rests on"));
  CHECK(has(fault("[output]\nsettled = \"r.ply\"\n" + pins), "a/s.toml:2:1: output.settled needs settle"));
  CHECK(scene("[garment]\nmesh = \"g.obj\"\n" + settle + "[body]\nmesh = \"b.obj\"\n").settle);
}

TEST_CASE("scene_file: a kept shape needs hinges, and a body and pins that stand still") {
  const std::string keep = "[[lines]]\nstrokes = \"l.json\"\nrest = \"keep\"\n",
                    hinges = "[material]\npreset = \"denim\"\n";
  const io::Scene s = scene("[garment]\nmesh = \"g.obj\"\nrest = \"keep\"\n" + keep + hinges);
  CHECK(s.keep);
  CHECK(s.lines.at(0).keep);
  CHECK(s.lines.at(0).options.rest == geometry::RestRule::drawn);
  CHECK(has(fault(keep), "a/s.toml:3:1: lines.0.rest = \"keep\" needs hinges"));
  const std::string plate = "[material]\npreset = \"denim\"\nbending_law = \"plate\"\n";
  CHECK(scene("[garment]\nmesh = \"g.obj\"\n" + keep + plate).lines.at(0).keep);
  CHECK(
      has(fault("[garment]\nmesh = \"g.obj\"\nrest = \"keep\"\n"), "a/s.toml:3:1: garment.rest = \"keep\""));
  const auto moved = [&](const std::string& what, int lines_drawn) -> std::string {
    const io::TomlDocument document =
        io::parse_toml("[garment]\nmesh = \"g.obj\"\nrest = \"keep\"\n" + keep + hinges + what, "a/s.toml");
    try {
      io::check_keep_stands_still(io::read_scene(document, "a"), document, lines_drawn);
    } catch (const geometry::ContentError& e) {
      return e.what();
    }
    return "";
  };
  const std::string pins = "[[pins]]\nloop = \"top\"\nmotion.spin = {rate = 2}\n",
                    body = "[body]\nmesh = \"b\"\nmotion.spin = {rate = 2}\n";
  for (const std::string& what : {pins, body}) {
    CHECK(has(moved(what, -1), "garment.rest = \"keep\" needs a body and pins that stand still"));
    CHECK(has(moved(what, 0), "lines.0.rest = \"keep\""));  // resumed, a round is still to come
    CHECK(moved(what, 1) == "");                            // resumed, all was kept before
  }
  CHECK(moved("", -1) == "");
}

TEST_CASE("scene_file: a scene's faults are told with file, line, column and the nearest setting") {
  CHECK(fault("[simulation]\nsecnds = 3\n") ==
        "a/s.toml:2:1: there is no setting 'simulation.secnds'; did you mean 'seconds'?");
  CHECK(fault("[material]\nfabric = \"cotton\"\n") ==
        "a/s.toml:2:1: there is no setting 'material.fabric'; did you mean 'preset'?");
  CHECK(fault("[simulaton]\n") ==
        "a/s.toml:1:2: there is no setting 'simulaton'; did you mean 'simulation'?");
  CHECK(fault("\n[material]\n  bending = \"soft\"\n") ==
        "a/s.toml:3:3: material.bending = \"soft\" must be a number >= 0 [N/m]");
  CHECK(has(fault("[material]\nbending = -1\n"), "a/s.toml:2:1: material.bending = -1"));
  CHECK(has(fault("[material]\nbending = inf\n"), "must be a number"));
  CHECK(has(fault("[material]\npoisson = 1\n"), "must be below 1"));
  CHECK(has(
      fault("[[lines]]\nstrokes = \"l.json\"\nrest = \"drown\"\n"),
      "a/s.toml:3:1: lines.0.rest = \"drown\" is none of drawn, flat, copied, keep; did you mean drawn?"));
  CHECK(has(fault("[[lines]]\nstrokes = \"a\"\ntime = 2\n[[lines]]\nstrokes = \"b\"\ntime = 1\n"),
            "a/s.toml:6:1"));
  CHECK(has(fault("[[lines]]\ntime = 2\n"), "lines.0.strokes is missing"));
  CHECK(has(fault("[[pins]]\nbox = [1, 2]\n"), "must be a list of 6 numbers"));
  CHECK(has(fault("[[pins]]\n"), "pins.0.loop is missing"));
  CHECK(has(fault("garment = 3\n"), "garment = 3 must be a table"));
  CHECK(has(fault("[garment]\nsubdivide = 1.5\n"), "whole number from 0 to 4"));
  CHECK(has(fault("[body]\nmesh = \"b\"\nmotion.spin = {axis = [0, 0, 0]}\n"), "must have a length above 0"));
  CHECK(has(fault("[body]\nmesh = \"b\"\nmotion.keyframes = [{time = 1}, {time = 1}]\n"), "must be later"));
  const std::string maps = "[body]\nmesh = \"b\"\ncollider = \"depth-maps\"\n";
  CHECK(has(fault(maps), "a/s.toml:3:1: body.collider"));
  CHECK(has(fault(maps), "is for frames"));
  CHECK(has(fault(maps + "frames = \"f.pc2\"\ntolerance = 0.01\n"), "no tolerance"));
  CHECK(has(fault("[body]\nmesh = \"b\"\nframes = \"f.pc2\"\ngradient = \"exact\"\n"), "no gradient"));
  CHECK(has(fault("[simulation]\nforce_dt = true\n"), "needs dt"));
  CHECK(has(fault("[simulation]\nseconds = 1979-05-27\n"),
            "a/s.toml:2:11: simulation.seconds is a date or a time"));
  CHECK(has(fault("[simulation\n"), "a/s.toml:1:"));
  CHECK(has(fault("[lines]\nstrokes = \"a\"\n[lines]\n"), "written [[lines]] each"));
  CHECK(fault("[[body]]\nmesh = \"b\"\n") ==
        "a/s.toml:1:3: body may be there once; write [body], not [[body]]");
  CHECK(has(fault("[garment]\nmesh = skirt.obj\n"), "a text needs quotes: mesh = "));
  CHECK(has(fault("[output]\nseconds = 4\n"), "'seconds' belongs in [simulation]"));
  CHECK(has(fault("[[pins]]\nloop = -1\n"), "whole number from 0"));
  CHECK(has(fault("[simulation]\nseconds = 1\nseconds = 2\n"), "a/s.toml:3:"));
}

TEST_CASE("scene_file: cloth keeps off cloth where the body changes its shape, unless told not to") {
  const std::string body = "[body]\nmesh = \"b\"\n", moves = body + "frames = \"f.pc2\"\n";
  CHECK(scene(moves).simulation.self.on);
  CHECK(scene(moves + "[simulation]\nseconds = 1\n").simulation.self.on);
  CHECK_FALSE(scene(moves + "[simulation]\nself_contact = \"off\"\n").simulation.self.on);
  CHECK_FALSE(scene(body).simulation.self.on);
  CHECK(scene(body + "[simulation]\nself_contact = \"on\"\n").simulation.self.on);
}

TEST_CASE("scene_file: a pinned loop is named, or numbered without quotes") {
  CHECK(scene("[[pins]]\nloop = 5\n").pins.at(0).loop == "5");
  CHECK(scene("[[pins]]\nloop = \"top\"\n").pins.at(0).loop == "top");
}

TEST_CASE("scene_file: settings of the command line go over those of the file and say so in faults") {
  io::TomlDocument document =
      parse_toml("[material]\nbending = 1\n[garment]\nmesh = \"g.obj\"\n", "a/s.toml");
  io::set_value(document, "material.bending", io::parse_value("2.5"), "`bending`");
  io::set_value(document, "body.mesh", "b.obj", "`body`");
  io::set_value(document, "pins.0.loop", "top", "`set`");
  const io::Scene s = io::read_scene(document, "a");
  CHECK(s.material.bending == 2.5);
  CHECK(s.garment == "a/g.obj");
  CHECK(s.body->mesh == "b.obj");
  CHECK(s.pins.at(0).loop == "top");
  io::set_value(document, "material.bending", "soft", "`bending`");
  CHECK_THROWS_WITH(io::read_scene(document, "a"), Catch::StartsWith("`bending`: material.bending"));
  CHECK_THROWS_AS(io::set_value(document, "pins.5.loop", "top", "`set`"), std::invalid_argument);
  CHECK_THROWS_AS(io::set_value(document, "material.bending.x", 1, "`set`"), std::invalid_argument);
  CHECK_THROWS_AS(io::set_value(document, "material..x", 1, "`set`"), std::invalid_argument);
}

TEST_CASE("scene_file: values of the command line are TOML where they can be") {
  CHECK(io::parse_value("3") == 3);
  CHECK(io::parse_value("[1, 2.5]") == io::Json{1, 2.5});
  CHECK(io::parse_value("{rate = 2}") == io::Json{{"rate", 2}});
  CHECK(io::parse_value("true") == true);
  CHECK(io::parse_value("drawn") == "drawn");
  CHECK(io::parse_value("1 m") == "1 m");
  for (const char* text : {"[1, 2, [3]]", "{a = {b = \"c d\"}}", "\"x\\ty\"", "-1.5e-05", "true"})
    CHECK(io::parse_value(io::value_text(io::parse_value(text))) == io::parse_value(text));
}

TEST_CASE("scene_file: a scene's paths can be made relative to another folder") {
  io::TomlDocument document =
      parse_toml("[garment]\nmesh = \"../g.obj\"\n[[lines]]\nstrokes = \"l.json\"\n[output]\nmesh = \"-\"\n",
                 "a/b/s.toml");
  io::set_value(document, "body.mesh", "b.obj", "`body`");
  const io::Json moved = io::relocated(document, "a/b", "a/c");
  CHECK(moved["garment"]["mesh"] == "../g.obj");
  CHECK(moved["lines"][0]["strokes"] == "../b/l.json");
  CHECK(moved["body"]["mesh"] == "../../b.obj");
  CHECK(moved["output"]["mesh"] == "-");
}
