// SPDX-License-Identifier: GPL-3.0-or-later
// furrow drape: a garment comes to rest on a body; wrong calls.
#include <catch2/catch.hpp>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "io/animation/animation_file.h"
#include "io/mesh/mesh_file.h"
#include "io/picture/png_file.h"
#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::tests;
using nlohmann::json;

namespace {

std::string mannequin_path() { return (source_dir() / "meshes/mannequin.obj").string(); }

json drape_report(const std::string& arguments) {
  const Run run = run_furrow(arguments + " --json");
  INFO(arguments << "\n" << run.err);
  REQUIRE(run.exit_code == 0);
  return json::parse(run.out);
}

/// The repository's skirt on its mannequin.
std::string skirt() {
  return (source_dir() / "meshes/skirt.obj").string() + " --body " +
         (source_dir() / "meshes/mannequin.obj").string();
}

}  // namespace

TEST_CASE("drape: a shirt over a skirt, none through the other, each in a file", "[release]") {
  ScratchDirectory scratch;
  const std::string meshes = (source_dir() / "meshes").string();
  const Run run = run_furrow("drape " + meshes + "/skirt.obj " + meshes + "/shirt.obj --body " +
                             mannequin_path() + " --subdivide 0 --json --picture " + (scratch / "a.png") +
                             " -o " + (scratch / "worn-{}.ply"));
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const json r = json::parse(run.out);
  const json& pair = r["layers"]["pairs"].at(0);
  CHECK(pair["crossings_at_start"].get<int>() > 50);
  CHECK(pair["crossings"] == 0);
  CHECK(pair["outside"] == pair["compared"]);
  CHECK(r["garments"][1]["written"] == scratch / "worn-shirt.ply");
  CHECK(io::read_mesh(scratch / "worn-skirt.ply").mesh->number_of_vertices() > 100);
  CHECK(io::read_png(scratch / "a.png").width > 0);
}

TEST_CASE("drape: it brings the skirt to rest on the mannequin and tells how it fits", "[release]") {
  ScratchDirectory scratch;
  const std::string call = "drape " + skirt() + " --subdivide 0 --band top=0.95 --json";
  const Run run =
      run_furrow(call + " -o " + (scratch / "a.ply") + " --picture " + (scratch / "a.png") + " --animation " +
                 (scratch / "a.pc2") + " --save-camera " + (scratch / "a.json"));
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const json r = json::parse(run.out);
  CHECK(r["converged"] == true);
  CHECK(r["residual_force"].get<double>() <= 1e-3);
  CHECK(r["touching"].get<int>() > 10);
  CHECK(r["fit"]["strain"]["p99"].get<double>() < 0.08);
  CHECK(r["fit"]["distance"]["deepest_penetration"].get<double>() < 5e-4);
  CHECK(r["levels"].size() == 1);
  const io::MeshFile worn = io::read_mesh(scratch / "a.ply");
  CHECK(worn.mesh->number_of_vertices() == r["levels"][0]["vertices"].get<std::size_t>());
  CHECK(geometry::find_map(worn.mesh, geometry::attribute::rest_length));
  CHECK(io::read_png(scratch / "a.png").width > 0);
  CHECK(json::parse(read_text(scratch / "a.json")).contains("eye"));
  CHECK(std::filesystem::file_size(scratch / "a.pc2") >
        12 * worn.mesh->number_of_vertices() * r["levels"][0]["iterations"].get<std::size_t>());
}

TEST_CASE("drape: what it wrote is touched, and a file that does not rest is refused", "[release]") {
  ScratchDirectory scratch;
  const std::string worn = scratch / "worn.ply", touches = scratch / "touches.json",
                    touched = scratch / "touched.ply", on_body = " --body " + mannequin_path();
  drape_report("drape " + skirt() + " --subdivide 0 -o " + worn);
  const geometry::Point at = io::read_mesh(worn).mesh->point(geometry::Vertex(700));
  std::ofstream(touches) << json{{"touches", {{{"pinch", {at.x(), at.y(), at.z()}}, {"radius", 0.06}}}}};
  const std::string call = on_body + " --touches " + touches + " --replace -o " + touched;
  const json report = drape_report("drape " + worn + call);
  CHECK(report["touches"][0]["kind"] == "pinch");
  CHECK(report["touches"][0]["remains"] > 0.9);
  CHECK(report["crossings"]["pairs"] == 0);
  CHECK(run_furrow("drape " + worn + call).out.find("touch 1 (pinch): moved ") != std::string::npos);
  const Run fresh = run_furrow("drape " + (source_dir() / "meshes/skirt.obj").string() + call);
  CHECK(fresh.exit_code == 3);
  CHECK(fresh.err.find("has no rest state; take the PLY that furrow drape") != std::string::npos);
  const Run refined = run_furrow("drape " + worn + " --subdivide 1" + call);
  CHECK(refined.exit_code == 2);
  CHECK(refined.err.find("--touches change the rest state") != std::string::npos);
}

TEST_CASE("drape: it brings the skirt to rest with the same bits twice", "[release]") {
  ScratchDirectory scratch;
  const std::string call = "drape " + skirt() + " --band top=0.95 -q -o ";
  REQUIRE(run_furrow(call + (scratch / "b.ply")).exit_code == 0);
  REQUIRE(run_furrow(call + (scratch / "c.ply")).exit_code == 0);
  CHECK(read_text(scratch / "b.ply") == read_text(scratch / "c.ply"));
}

TEST_CASE("drape: fit, simulate and drape know the contact, the fabric and the band of what it wrote",
          "[release]") {
  ScratchDirectory scratch;
  const std::string worn = scratch / "worn.ply", on = " --body " + mannequin_path();
  const json draped =
      drape_report("drape " + skirt() + " --fabric silk --gap 0.006 --band top=0.95 -o " + worn);
  CHECK(draped["outcome"] == "at rest");
  CHECK(draped["gap"].get<double>() == Approx(0.006));
  CHECK(draped["fit"]["distance"]["contact"].get<double>() == Approx(1.2 * 0.006));
  json fit = drape_report("fit " + worn + on);
  fit.erase("schema");
  CHECK(fit["crossings"]["pairs"] == draped["crossings"]["pairs"]);
  fit.erase("crossings");
  CHECK(fit == draped["fit"]);
  const io::MeshFile file = io::read_mesh(worn);
  const auto band = geometry::struts(file.mesh);
  REQUIRE(band.size() > 20);
  double rest = 0, top = 0;
  for (const geometry::Strut& s : band) rest += s.rest_length;
  const auto made = io::read_mesh(source_dir() / "meshes/skirt.obj");
  const auto loops = geometry::border_loops(made.mesh);
  top = loops[geometry::find_border_loop(loops, "top")].length;
  CHECK(rest == Approx(0.95 * top));

  const json still = drape_report("simulate " + worn + on + " --seconds 0.02 -o " + (scratch / "s.ply"));
  const std::string flags = still["flags"];
  CHECK(flags.find("--fabric silk") != std::string::npos);
  CHECK(flags.find("--gap 0.006") != std::string::npos);
  const Run other =
      run_furrow("simulate " + worn + on + " --seconds 0.02 --fabric denim --json -o " + (scratch / "d.ply"));
  CHECK(other.err.find("came to rest with --gap 0.006 --fabric silk") != std::string::npos);
  const std::string end = " --seconds 0.02 -o " + (scratch / "e.ply");
  CHECK(drape_report("simulate " + worn + on + " --fabric silk --gap 0.006" + end)["kinetic_energy"] ==
        still["kinetic_energy"]);
  CHECK(drape_report("simulate " + worn + on + " --membrane paper --bending-law cross" +
                     end)["kinetic_energy"] != still["kinetic_energy"]);
  const json again = drape_report("drape " + worn + on + " -o " + (scratch / "again.ply"));
  CHECK(again["outcome"] == "at rest");
  CHECK(geometry::struts(io::read_mesh(scratch / "again.ply").mesh).size() == band.size());
  const json sewn = drape_report("drape " + worn + on + " --band top=1 -o " + (scratch / "sewn.ply"));
  CHECK(geometry::struts(io::read_mesh(scratch / "sewn.ply").mesh).size() == band.size());
}

TEST_CASE("drape: a density beside a fabric stays with the garment", "[release]") {
  ScratchDirectory scratch;
  const std::string worn = scratch / "worn.ply", on = " --body " + mannequin_path() + " --seconds 0.01 -o ";
  write_text(scratch / "scene.toml", "[garment]\nmesh = '" + (source_dir() / "meshes/skirt.obj").string() +
                                         "'\n[material]\npreset = 'denim'\ndensity = 0.2\n");
  const Run run = run_furrow("drape " + (scratch / "scene.toml") + " --body " + mannequin_path() +
                             " --max-iterations 0 -o " + worn);
  REQUIRE(run.exit_code == 4);
  const std::string flags = drape_report("simulate " + worn + on + (scratch / "s.ply"))["flags"];
  CHECK(flags.find("--fabric denim") != std::string::npos);
  CHECK(flags.find("--density 0.2") != std::string::npos);
  const auto total = [](const std::string& path) {
    const io::MeshFile file = io::read_mesh(path);
    const auto mass = *geometry::find_map(file.mesh, geometry::attribute::mass);
    double sum = 0;
    for (geometry::Vertex v : file.mesh->vertices()) sum += mass[v];
    return sum;
  };
  CHECK(total(worn) == total(scratch / "s.ply"));
  std::string bytes = read_text(worn);
  bytes.replace(bytes.find("\"denim\""), 7, "\"demin\"");
  write_text(worn, bytes);
  const Run unknown = run_furrow("simulate " + worn + on + (scratch / "s.ply"));
  CHECK(unknown.exit_code == 3);
  CHECK(unknown.err.find("did you mean denim") != std::string::npos);
}

TEST_CASE(
    "drape: a body that comes through a face of cloth, but through no vertex, is told and ends with 4") {
  ScratchDirectory scratch;
  write_text(scratch / "sheet.obj",
             "v -0.1 1 -0.1\nv 0.1 1 -0.1\nv 0.1 1 0.1\nv -0.1 1 0.1\nf 1 4 3\nf 1 3 2\n");
  const auto spike = [&](double tip) {
    write_text(scratch / "spike.obj", "v 0.02 " + std::to_string(tip) +
                                          " -0.02\nv 0.06 0 -0.02\nv 0 0 0.02\nv 0 0 -0.06\n"
                                          "f 1 3 2\nf 1 4 3\nf 1 2 4\nf 2 3 4\n");
    return run_furrow("drape " + (scratch / "sheet.obj") + " --body " + (scratch / "spike.obj") +
                      " --subdivide 0 --gap 0.2 --pin-vertices 0,1,2,3 --json -o " + (scratch / "out.ply"));
  };
  const Run deep = spike(1.5);
  INFO(deep.err);
  CHECK(deep.exit_code == 4);
  CHECK(deep.err.find("comes through 1 face, by up to") != std::string::npos);
  const json r = json::parse(deep.out);
  CHECK(r["converged"] == true);
  CHECK(r["outcome"] == "at rest, pierced by the body");
  CHECK(r["fit"]["distance"]["vertices_inside"] == 0);
  CHECK(r["fit"]["distance"]["pierced_faces"] == 1);
  CHECK(r["fit"]["distance"]["deepest_penetration"].get<double>() > 0.005);
  CHECK(r["fit"]["pierced_zones"].size() == 1);
  const Run shallow = spike(1.05);
  INFO(shallow.err);
  CHECK(shallow.exit_code == 0);
  CHECK(shallow.err.find("warning: sheet: the body comes through") != std::string::npos);
  CHECK(json::parse(shallow.out)["outcome"] == "at rest");
  const Run below = spike(0.99);
  CHECK(below.exit_code == 0);
  CHECK(below.err.find("comes through") == std::string::npos);
}

TEST_CASE("drape: it names the settings that it has no use for, and cloth that is nearer than a chosen gap",
          "[release]") {
  ScratchDirectory scratch;
  write_text(scratch / "scene.toml",
             "[garment]\nmesh = '" + (source_dir() / "meshes/skirt.obj").string() + "'\n[body]\nmesh = '" +
                 mannequin_path() +
                 "'\n[material]\ngap = 0.05\n[forces]\nwind = [1, 0, 0]\n[[pins]]\n"
                 "loop = 'top'\nmotion.spin = {rate = 1}\n[simulation]\nthreads = 1\n");
  const std::string call = "drape " + (scratch / "scene.toml") + " -o " + (scratch / "out.ply");
  const Run run = run_furrow(call);
  CHECK(run.err.find("no use for forces.wind, pins.0.motion;") != std::string::npos);
  CHECK(run.err.find("nearer to the body than the gap of 50 mm") != std::string::npos);  // the pinned waist
  CHECK(run.err.find("brought out") == std::string::npos);
  const Run quiet = run_furrow(call + " -q --json");  // the report alone, as of every subcommand
  CHECK(quiet.err.find("warning") == std::string::npos);
  CHECK(json::parse(quiet.out).contains("outcome"));
  CHECK(run_furrow(call + " -q").out.empty());
  const std::string help = run_furrow("drape --help-all").out;
  CHECK(help.find("else cotton") != std::string::npos);
  CHECK(help.find("paper's law, default") == std::string::npos);
}

TEST_CASE("drape: cloth lies no deeper in the gap than it may", "[release]") {
  ScratchDirectory scratch;
  const auto drape = [&](const std::string& more) {
    const Run run =
        run_furrow("drape " + skirt() + " --band top=0.95 --json -o " + (scratch / "a.ply") + more);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return json::parse(run.out);
  };
  const json as_it_comes = drape(""), exact = drape(" --contact-depth 1e-6");
  CHECK(as_it_comes["contact_depth"].get<double>() > 1e-5);
  CHECK(exact["contact_depth"].get<double>() <= 1e-6);
}

TEST_CASE("drape: where no cloth is near, self-contact changes nothing but the report", "[release]") {
  ScratchDirectory scratch;
  const std::string call = "drape " + skirt() + " --subdivide 0 --band top=0.95 --json -o ";
  const Run off = run_furrow(call + (scratch / "off.obj") + " --self-contact off");
  const Run on = run_furrow(call + (scratch / "on.obj") + " --self-contact on --cloth-thickness 0.0004");
  INFO(on.err);
  REQUIRE(off.exit_code == 0);
  REQUIRE(on.exit_code == 0);
  CHECK(read_text(scratch / "off.obj") == read_text(scratch / "on.obj"));
  const json r = json::parse(on.out);
  CHECK(r["levels"] == json::parse(off.out)["levels"]);
  CHECK_FALSE(json::parse(off.out).contains("self_contact"));
  CHECK(r["self_contact"]["thickness"] == 0.0004);
  CHECK(r["self_contact"]["pairs"] == 0);
  CHECK(r["self_contact"]["crossed_at_start"] == 0);
  CHECK(r["self_contact"]["list_builds"].get<int>() > 0);
}

TEST_CASE("drape: a file that crosses itself is taken apart, and its report says so") {
  ScratchDirectory scratch;
  std::string obj;  // two strips that are held at z = 0, of which one goes down through the other
  const auto strip = [&](const std::function<std::string(int, int)>& at, int first) {
    for (int i = 0; i <= 10; ++i)
      for (int j = 0; j <= 4; ++j) obj += "v " + at(i, j) + "\n";
    for (int i = 0; i < 10; ++i)
      for (int j = 0; j < 4; ++j) {
        const int a = first + 5 * i + j;
        obj += "f " + std::to_string(a) + " " + std::to_string(a + 5) + " " + std::to_string(a + 6) + " " +
               std::to_string(a + 1) + "\n";
      }
  };
  const auto point = [](double x, double y, double z) {
    return std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z);
  };
  strip([&](int i, int j) { return point(0.02 * i, 0, 0.02 * j); }, 1);
  strip([&](int i, int j) { return point(0.02 * i + 0.003, 0.011 - 0.004 * j, 0.02 * j + 0.002); }, 56);
  write_text(scratch / "two.obj", obj);
  const json r = drape_report("drape " + (scratch / "two.obj") +
                              " --pin-box=-1,-1,-1,1,1,0.01 --self-contact on --residual 1e9 -o " +
                              (scratch / "apart.ply"));
  INFO(r.dump(1));
  CHECK(r["crossings"]["at_start"].get<int>() > 5);
  CHECK(r["crossings"]["pairs"] == 0);
  CHECK(r["untangled"]["at_start"].get<int>() > 5);
  CHECK(r["untangled"]["left"] == 0);
}

TEST_CASE("drape: --plain keeps cloth off cloth where it is asked to, and else lets it through") {
  ScratchDirectory scratch;
  std::string obj;  // a patch that is held, and one over it that is held by an edge
  for (const double y : {0.0, 0.002})
    for (int i = 0; i < 45; ++i)
      obj += "v " + std::to_string(0.01 * (i / 5) + 1.5 * y) + " " + std::to_string(y) + " " +
             std::to_string(0.01 * (i % 5) + 2 * y) + "\n";
  for (const int first : {1, 46})
    for (int i = 0; i < 32; ++i) {
      const int a = first + 5 * (i / 4) + i % 4;
      obj += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(a + 6) + " " +
             std::to_string(a + 5) + "\n";
    }
  write_text(scratch / "two.obj", obj);
  const auto drape = [&](const std::string& more, const std::string& out) {
    return run_furrow("drape " + (scratch / "two.obj") +
                      " --pin-box=-1,-1,-1,1,0.001,1 --pin-vertices 45,46,47,48,49 --plain --stretch 2 "
                      "--rigidity 1e-7 --bending-law hinge --max-iterations 2000 --residual 0.05 --json" +
                      more + " -o " + (scratch / out));
  };
  const Run with = drape(" --self-contact on --cloth-thickness 0.0008 --cloth-friction 0.3", "with.obj");
  INFO(with.err);
  CHECK(with.exit_code == 0);
  const json r = json::parse(with.out), contact = r["self_contact"];
  CHECK(r["outcome"] == "at rest");
  CHECK(r["crossings"]["pairs"] == 0);
  CHECK(contact["pairs"].get<int>() > 100);
  CHECK(contact["nearest"].get<double>() == Approx(0.0008).epsilon(0.05));
  CHECK(contact["friction"] == 0.3);
  CHECK(contact["cut_moves"] == 0);
  const Run off = drape(" --self-contact off", "off.obj"), as_ever = drape("", "auto.obj");
  CHECK(off.exit_code == 4);
  CHECK(json::parse(off.out)["crossings"]["pairs"].get<int>() > 5);
  CHECK(as_ever.exit_code == 4);
  CHECK_FALSE(json::parse(as_ever.out).contains("self_contact"));
  CHECK(read_text(scratch / "off.obj") == read_text(scratch / "auto.obj"));
}

TEST_CASE("drape: --loose says what becomes of a scrap that nothing holds") {
  ScratchDirectory scratch;
  write_text(scratch / "a.obj",
             "v 0 0 0\nv 0.1 0 0\nv 0.1 0.1 0\nv 0 0.1 0\nf 1 2 3 4\n"
             "v 0.05 0.05 0.2\nv 0.07 0.05 0.2\nv 0.05 0.06 0.2\nf 5 6 7\n");
  const std::string call = "drape " + (scratch / "a.obj") + " --pin-vertices 2,3 -o " + (scratch / "b.obj");
  for (const auto& [use, done, vertices] :
       {std::tuple("", "held", 7), {" --loose hold", "held", 7}, {" --loose drop", "dropped", 4}}) {
    const json r = drape_report(call + use);
    INFO(r.dump(1));
    CHECK(r["loose"]["done"] == done);
    CHECK(r["loose"]["pieces"] == 1);
    CHECK(r["loose"]["vertices"] == 3);
    CHECK(r["loose_parts"].size() == 1);
    CHECK(int(io::read_mesh(scratch / "b.obj").mesh->number_of_vertices()) == vertices);
  }
  CHECK(run_furrow(call + " --loose lost").exit_code != 0);
}

TEST_CASE("drape: what cannot be done is told before the work", "[long]") {
  ScratchDirectory scratch;
  const auto refused = [&](const std::string& arguments, const std::string& word) {
    const Run run = run_furrow("drape " + arguments);
    CAPTURE(arguments, run.err);
    CHECK(run.exit_code == 2);
    CHECK(run.err.find(word) != std::string::npos);
  };
  const std::string out = " -o " + (scratch / "x.ply");
  refused((source_dir() / "meshes/skirt.obj").string() + out, "--body");
  refused(skirt(), "nothing to write");
  refused(skirt() + out + " --band top", "--band");
  refused(skirt() + out + " --fabrics silk,cotton", "--picture");
  refused(skirt() + " -o " + (source_dir() / "meshes/skirt.obj").string(), "skirt.obj");
  refused(skirt() + out + " --residual 0", "--residual");
  refused(skirt() + out + " --band left=0.9", "--band: border loop 'left'");
  refused(skirt() + out + " --band top=wide", "no number");
  refused(skirt() + out + " --band top=3", "at most 2");
  refused(skirt() + out + " --band top=0.9 --band top=0.8", "already");
  refused(skirt() + out + " --penetration -1", "--penetration");
  refused(skirt() + out + " --contact-depth 1e-9", "--contact-depth");
  refused(skirt() + out + " --contact-depth 1e-5 --plain", "--contact-depth");
  refused(skirt() + out + " --self-contact maybe", "--self-contact");
  refused(skirt() + out + " --cloth-thickness 0", "--cloth-thickness");
  refused(skirt() + out + " --set body.motion.spin={axis=[0,1,0],rate=1}", "body.motion");
  refused(skirt() + " --picture " + (scratch / "p.png") + " --fabrics cotton,slik", "slik");
  refused(skirt() + " --picture " + (scratch / "p.png") + " --fabrics cotton,,silk", "missing");
  refused(skirt() + " --picture " + (scratch / "p.png") + " --fabrics cotton,", "missing");
  refused(skirt() + " --fabric silk --picture " + (scratch / "p.png") + " --fabrics cotton,wool", "--fabric");
  refused(skirt() + " --picture " + (scratch / "p.png") + " --fabrics ''", "missing");
  CHECK_FALSE(std::filesystem::exists(scratch / "x.ply"));
  const Run few = run_furrow("drape " + skirt() + out + " --max-iterations 2 --fabric silk");
  CHECK(few.exit_code == 4);
  CHECK(few.err.find("not at rest") != std::string::npos);
  CHECK(std::filesystem::exists(scratch / "x.ply"));
}

TEST_CASE("drape: what nothing carries falls, whatever residual is accepted", "[release]") {
  ScratchDirectory scratch;
  write_text(scratch / "sheet.obj", "v 5 1 0\nv 5.1 1 0\nv 5.1 1 0.1\nv 5 1 0.1\nf 1 4 3\nf 1 3 2\n");
  const std::string call = "drape " + (scratch / "sheet.obj") + " --body " + mannequin_path() +
                           " --residual 1.1 --json -o " + (scratch / "out.ply");
  const Run run = run_furrow(call);
  CHECK(run.exit_code == 4);
  CHECK(json::parse(run.out)["outcome"] == "falls");
  CHECK(json::parse(run.out)["converged"] == false);
  CHECK(run.err.find("never came to lie on the body, which is 1.7 m tall") != std::string::npos);
  CHECK(run.err.find("error: sheet: falls") != std::string::npos);
  const Run held = run_furrow(call + " --pin-vertices 0,1");
  CHECK(held.exit_code == 0);
  CHECK(json::parse(held.out)["outcome"] == "at rest");
}

TEST_CASE(
    "drape: a gap that is raised for long edges is told, and simulate goes on with the gap that was kept",
    "[release]") {
  ScratchDirectory scratch;
  const Run coarse =
      run_furrow("drape " + skirt() + " --gap 0.001 --subdivide 0 --json -o " + (scratch / "a.ply"));
  REQUIRE(coarse.exit_code == 0);
  const double gap = json::parse(coarse.out)["gap"];
  CHECK(gap > 0.0015);
  CHECK(coarse.err.find("mm from the body, not 1 mm") != std::string::npos);
  const std::string on = "simulate " + (scratch / "a.ply") + " --body " + mannequin_path() +
                         " --seconds 0.01 -o " + (scratch / "b.ply");
  CHECK(drape_report(on)["contact_gap"].get<double>() == Approx(gap).epsilon(0.02));
  CHECK(drape_report(on + " --gap 0.006")["contact_gap"] == 0.006);
}

TEST_CASE("drape: interrupted, it tells which files there are, and draws no picture") {
  ScratchDirectory scratch;
  write_text(scratch / "sheet.obj",
             "v -0.1 1 -0.1\nv 0.1 1 -0.1\nv 0.1 1 0.1\nv -0.1 1 0.1\nf 1 4 3\nf 1 3 2\n");
  write_text(
      scratch / "body.obj",
      "v 0.02 0.9 -0.02\nv 0.06 0 -0.02\nv 0 0 0.02\nv 0 0 -0.06\nf 1 3 2\nf 1 4 3\nf 1 2 4\nf 2 3 4\n");
  const std::string code = scratch / "code", err = scratch / "err", out = scratch / "a.ply",
                    picture = scratch / "a.png";
  run_furrow("drape " + (scratch / "sheet.obj") + " --body " + (scratch / "body.obj") +
             " --pin-vertices 0,1 --subdivide 6 --residual 1e-300 --progress 0.05 -o " + out + " --picture " +
             picture + " 2>" + err + " & p=$!; while kill -0 $p && ! grep -q draping " + err +
             " 2>/dev/null; do sleep 0.05; done; sleep 0.2; kill -INT $p; wait $p; echo $? >" + code +
             "; true");
  CHECK(read_text(code) == "130\n");
  CHECK(read_text(err).find("written: " + out + "; not written: " + picture) != std::string::npos);
  CHECK(std::filesystem::exists(out));
  CHECK_FALSE(std::filesystem::exists(picture));
}

TEST_CASE("drape: a body that encloses nothing is refused, by fit, too") {
  ScratchDirectory scratch;
  const std::string sheet = (source_dir() / "meshes/sheet.obj").string();
  const Run drape = run_furrow("drape " + (source_dir() / "meshes/skirt.obj").string() + " --body " + sheet +
                               " -o " + (scratch / "a.ply"));
  CHECK(drape.exit_code == 3);
  CHECK(drape.err.find("encloses no volume") != std::string::npos);
  CHECK(run_furrow("fit " + (source_dir() / "meshes/skirt.obj").string() + " --body " + sheet).exit_code ==
        3);
}
