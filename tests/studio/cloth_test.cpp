// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/studio/visitor.h"
#include "tests/test_meshes.h"

namespace furrow {
namespace {

using jobs::Json;
using tests::Desk;
using tests::line_at;
using tests::Visitor;

std::uint32_t head_of(const std::string& frame, std::size_t which) {
  std::uint32_t number = 0;
  std::memcpy(&number, frame.data() + 4 * which, 4);
  return number;
}

/// Whether a line of the cloth ends there [m].
bool is_end_of_line(const std::string& frame, const Json& place) {
  const std::uint32_t vertices = head_of(frame, 2), faces = head_of(frame, 3), edges = head_of(frame, 4);
  std::map<std::uint32_t, int> count;
  for (std::size_t e = 0; e < edges; ++e)
    for (const std::size_t end : {0, 1}) ++count[head_of(frame, 6 + 6 * vertices + 3 * faces + 3 * e + end)];
  for (const auto& [v, lines] : count) {
    float p[3];
    std::memcpy(p, frame.data() + 24 + 12 * std::size_t(v), sizeof p);
    const auto is_at = [&](int k) { return std::abs(p[k] - place.at(k).get<double>()) < 1e-6; };
    if (lines == 1 && is_at(0) && is_at(1) && is_at(2)) return true;
  }
  return false;
}

std::uint32_t pinned_in(Visitor& page) {
  page.ask("show");
  return head_of(page.cloth, 5);
}

std::vector<geometry::Point> played(const Desk& desk, const std::string& file) {
  return tests::positions(io::read_mesh(desk.project() / file));
}

}  // namespace

TEST_CASE("studio cloth: a click pins a vertex, another lets it go, and borders are held whole") {
  const Desk desk("pin");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  const std::uint32_t before = pinned_in(page);
  REQUIRE(page.ask("pin", {{"at", {0.0, 0.1, 0.0}}}).contains("done"));
  CHECK(pinned_in(page) == before + 1);
  REQUIRE(page.ask("pin", {{"at", {0.0, 0.2, 0.0}}}).contains("done"));
  CHECK(pinned_in(page) == before + 2);
  REQUIRE(page.ask("pin", {{"at", {0.0, 0.1, 0.0}}}).contains("done"));
  CHECK(pinned_in(page) == before + 1);
  CHECK(page.ask("pin", {{"at", {5.0, 0.1, 0.0}}}).at("refused").get<std::string>().find("near enough") !=
        std::string::npos);
  CHECK(page.ask("pin", {{"at", {0.0, 0.4, 0.0}}}).contains("refused"));  // the scene's own pins hold it
  REQUIRE(page.status.at("borders").size() == 1);
  CHECK(page.status["borders"][0].at("held") == false);
  REQUIRE(page.ask("hold", {{"at", {0.2, 0.1, 0.0}}}).contains("done"));
  CHECK(page.status["borders"][0].at("held") == true);
  const std::uint32_t held = pinned_in(page);
  CHECK(held > before + 10);
  CHECK(page.ask("hold", {{"border", 0}, {"on", true}}).contains("refused"));
  CHECK(page.ask("hold", {{"border", 1}, {"on", true}}).contains("refused"));
  REQUIRE(page.ask("hold", {{"border", 0}, {"on", false}}).contains("done"));
  CHECK(pinned_in(page) == before + 1);
  while (page.status.at("step") > 0) REQUIRE(page.ask("undo").contains("done"));
  CHECK(pinned_in(page) == before);
}

TEST_CASE("studio cloth: fabrics are told by what they are like") {
  const Desk desk("fabrics");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  page.ask("show");
  std::map<std::string, std::string> words;
  for (const Json& fabric : page.status.at("fabrics")) words[fabric.at("name")] = fabric.at("words");
  CHECK(words.at("cotton") == "120 g/m², soft");
  CHECK(words.at("silk").find("flowing") != std::string::npos);
  CHECK(words.at("jet-set").find("firm") != std::string::npos);
  CHECK(words.at("target").find("stiff") != std::string::npos);
}

TEST_CASE("studio cloth: its mass is told and shown, without a body, too") {
  const Desk desk("mass");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("fabric", {{"name", "denim"}}).contains("done"));
  const Json plain = page.ask("weigh").at("done");
  INFO(plain.dump());
  const std::string words = plain.at("words");
  CHECK(words.find("324 g/m²") != std::string::npos);
  double grams = 0, area = 0;
  REQUIRE(std::sscanf(words.c_str(), "It weighs %lf g, 324 g/m² of %lf m²", &grams, &area) == 2);
  CHECK(grams == Approx(324 * area).epsilon(0.06));
  page.ask("show");
  std::uint32_t vertices = 0;
  std::memcpy(&vertices, page.cloth.data() + 8, 4);
  CHECK(page.colours.size() == 16 + 3 * std::size_t(vertices));
  REQUIRE(page.ask("draw", line_at(0.1)).contains("done"));
  const std::string drawn = page.ask("weigh").at("done").at("words");
  double more = 0;
  REQUIRE(std::sscanf(drawn.c_str(), "It weighs %lf g", &more) == 1);
  INFO(drawn);
  CHECK(more > grams);  // a fold has cloth in it
}

TEST_CASE("studio cloth: a part that lies on the cloth goes along or by itself, as a box is ticked") {
  const Desk desk("parts");
  io::MeshFile dressed;
  dressed.mesh = geometry::equilateral_sheet(0.4, 0.4, 0.04);
  const geometry::Mesh pocket = geometry::equilateral_sheet(0.1, 0.1, 0.04);
  std::map<geometry::Vertex, geometry::Vertex> now;
  for (const geometry::Vertex v : pocket.vertices())
    now[v] = dressed.mesh->add_vertex(pocket.point(v) + geometry::Vector(0.1, 0.1, 0.003));
  for (const geometry::Face f : pocket.faces()) {
    std::vector<geometry::Vertex> corners;
    for (const geometry::Vertex v : pocket.vertices_around_face(pocket.halfedge(f)))
      corners.push_back(now[v]);
    dressed.mesh->add_face(corners);
  }
  io::write_mesh(desk.folder / "sheet.ply", dressed);
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  page.ask("show");
  REQUIRE(page.status.at("parts") == Json::parse(R"([{"name": "part 2", "goes": true}])"));
  REQUIRE(page.ask("attach", {{"part", 0}, {"on", false}}).contains("done"));
  CHECK(page.status.at("parts")[0].at("goes") == false);
  CHECK(page.status.at("undo") == "free part 2");
  REQUIRE(page.ask("save").contains("done"));
  const io::TomlDocument saved = io::read_toml(desk.project() / "scene.toml");
  CHECK(saved.root->at("garment").at("free_parts") == Json::parse(R"(["part 2"])"));
  REQUIRE(page.ask("attach", {{"part", 0}, {"on", true}}).contains("done"));
  CHECK(page.status.at("parts")[0].at("goes") == true);
  REQUIRE(page.ask("undo").contains("done"));
  CHECK(page.status.at("parts")[0].at("goes") == false);
  CHECK(page.ask("attach", {{"part", 1}, {"on", true}}).contains("refused"));
}

TEST_CASE("studio cloth: what is encircled is held, and let go") {
  const Desk desk("lasso");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  const std::uint32_t before = pinned_in(page);
  REQUIRE(page.ask("pin", {{"vertices", {0, 1, 2, 100000}}, {"on", true}}).contains("done"));
  CHECK(pinned_in(page) == before + 3);
  CHECK(page.ask("pin", {{"vertices", {0, 1}}, {"on", true}}).contains("refused"));  // held already
  REQUIRE(page.ask("pin", {{"vertices", {1, 2, 3}}, {"on", false}}).contains("done"));
  CHECK(pinned_in(page) == before + 1);
  CHECK(page.ask("pin", {{"vertices", {2, 3}}, {"on", false}}).contains("refused"));
  CHECK(page.status.at("undo") == "let go of what was encircled");
}

TEST_CASE("studio cloth: pins stay where they are after the cloth has moved, with lines in it", "[release]") {
  Desk desk("pins_after");
  io::set_value(desk.scene.settings, "pins", Json::array(), "test");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("hold", {{"border", 0}, {"on", true}}).contains("done"));
  REQUIRE(page.ask("draw", line_at(0.0)).contains("done"));
  const std::uint32_t pinned = pinned_in(page);
  REQUIRE(page.ask("play", {{"seconds", 2 / 60.0}}).contains("done"));
  CHECK(pinned_in(page) == pinned);
  CHECK(page.status.at("borders").at(0).at("held") == true);
  REQUIRE(page.ask("play", {{"seconds", 2 / 60.0}}).contains("done"));
}

TEST_CASE("studio cloth: keep tells of each line, and where its end is, and is taken back by undo",
          "[release]") {
  Desk desk("keep");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  CHECK(page.ask("keep").at("refused").get<std::string>().find("no line") != std::string::npos);
  REQUIRE(page.ask("draw", line_at(0.0, 0.01)).contains("done"));
  page.ask("show");
  const std::string before = page.cloth;
  const Json answer = page.ask("keep");
  INFO(answer.dump());
  REQUIRE(answer.contains("done"));
  const Json& verdicts = answer["done"].at("verdicts");
  REQUIRE(verdicts.size() == 1);
  CHECK(verdicts[0].at("name") == "ridge 1");
  const std::string words = verdicts[0].at("words");
  const std::string verdict = verdicts[0].at("verdict");
  CHECK(words.find(verdict == "may_hold"      ? "may hold"
                   : verdict == "cannot_hold" ? "cannot hold"
                                              : "held") == 0);
  CHECK(answer["done"].at("all_hold") == (words.find("held") == 0));
  CHECK(page.status.at("undo") == "keep");
  CHECK(page.status.at("earlier") == Json::array({"ridge 1"}));
  CHECK(page.colours.empty());  // the cloth keeps its own: a mark at the line's end says what became of it
  CHECK(is_end_of_line(page.cloth, verdicts[0].at("at")));
  CHECK(answer.dump().find("goes into a .ply") == std::string::npos);  // it did
  REQUIRE(page.ask("undo").contains("done"));
  page.ask("show");
  CHECK(page.cloth == before);
  CHECK(page.status.at("lines").size() == 1);
}

TEST_CASE("studio cloth: a keep that is cancelled leaves all as it was", "[release]") {
  const Desk desk("keep_cancel");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("draw", line_at(0.0, 0.01)).contains("done"));
  const Json status = page.status;
  page.send(R"({"id":"keep","do":"keep"})");
  page.send(R"({"id":"stop","do":"cancel"})");
  page.send(R"({"id":"stop again","do":"cancel"})");
  Json answer = page.answer();
  while (answer.at("id") != "keep") {
    page.send(R"({"id":"stop","do":"cancel"})");
    answer = page.answer();
  }
  CHECK(answer.contains("refused"));
  page.ask("show");
  CHECK(page.status == status);
}

TEST_CASE("studio cloth: tangles are told, and shown where they are") {
  Desk desk("tangles");
  const studio::Studio sound(desk.scene, desk.project());
  {
    Visitor page(sound);
    CHECK(page.ask("tangles").at("done").at("pairs") == 0);
  }
  io::MeshFile crossed;
  crossed.mesh = tests::icosphere(2, 0.1, {0, 0, 0});
  crossed.mesh->join(tests::icosphere(2, 0.1, {0.1, 0, 0}));
  io::write_mesh(desk.folder / "crossed.ply", crossed);
  io::set_value(desk.scene.settings, "garment.mesh", "crossed.ply", "test");
  io::set_value(desk.scene.settings, "pins", Json::array(), "test");
  const studio::Studio studio(desk.scene, desk.folder / "crossed");
  Visitor page(studio);
  const Json found = page.ask("tangles").at("done");
  INFO(found.dump());
  CHECK(found.at("pairs") > 10);
  CHECK(found.at("words").get<std::string>().find("cross") != std::string::npos);
  CHECK(found.at("at").at(0).get<double>() == Approx(0.05).margin(0.02));
  CHECK(page.colours.find(std::string("\xd6\x00\x93", 3)) != std::string::npos);
}

TEST_CASE("studio cloth: a hand that pulls draws the cloth to it, by the same bits again", "[release]") {
  const Desk desk("pull");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  CHECK(page.ask("pull", {{"vertex", 0}, {"to", {0, 0, 1}}}).at("refused").get<std::string>().find("Play") !=
        std::string::npos);
  const auto start = tests::positions(io::read_mesh(desk.folder / "sheet.ply"));
  std::size_t corner = 0;  // the lowest vertex
  for (std::size_t i = 0; i < start.size(); ++i)
    if (start[i].y() < start[corner].y()) corner = i;
  const Json to{start[corner].x(), start[corner].y() + 0.05, 0.15};
  const Json pulls{{{"time", 0.0}, {"vertex", corner}, {"to", to}}, {{"time", 0.3}}};
  for (int i = 0; i < 2; ++i) {
    REQUIRE(page.ask("play", {{"seconds", 12 / 60.0}, {"pulls", pulls}}).contains("done"));
    REQUIRE(page.ask("undo").contains("done"));
  }
  REQUIRE(page.ask("play", {{"seconds", 12 / 60.0}}).contains("done"));
  CHECK(played(desk, "run-1.ply") == played(desk, "run-2.ply"));
  CHECK(played(desk, "run-1.ply")[corner].z() > 0.08);
  CHECK(played(desk, "run-3.ply")[corner].z() < 0.02);
  CHECK(page.ask("play", {{"pulls", {{{"time", -1}}}}}).contains("refused"));
  CHECK(page.ask("play", {{"pulls", 3}}).contains("refused"));
}

TEST_CASE("studio cloth: wind takes the cloth along", "[release]") {
  const Desk desk("wind");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("play", {{"seconds", 12 / 60.0}}).contains("done"));
  REQUIRE(page.ask("undo").contains("done"));
  REQUIRE(page.ask("wind", {{"velocity", {0, 0, 6}}}).contains("done"));
  CHECK(page.status.at("wind") == Json{0.0, 0.0, 6.0});
  REQUIRE(page.ask("play", {{"seconds", 12 / 60.0}}).contains("done"));
  const auto farthest = [&](const std::string& file) {
    double z = 0;
    for (const auto& p : played(desk, file)) z = std::max(z, p.z());
    return z;
  };
  CHECK(farthest("run-2.ply") > farthest("run-1.ply") + 0.03);
  CHECK(page.ask("wind", {{"velocity", {0, 0, 600}}}).contains("refused"));
  CHECK(page.ask("wind", {{"velocity", {0, 0}}}).contains("refused"));
}

TEST_CASE("studio cloth: it is given away in four formats, also on the vertices that it came with") {
  const Desk desk("give");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  const Json bare = page.ask("give", {{"as", "original"}});  // before anything was done to it
  INFO(bare.dump());
  CHECK(tests::positions(io::read_mesh(bare.at("done").at("file").get<std::string>())) ==
        tests::positions(io::read_mesh(desk.folder / "sheet.ply")));
  REQUIRE(page.ask("draw", line_at(0.0)).contains("done"));
  page.ask("show");
  for (const std::string as : {"ply", "obj", "glb"}) {
    const Json answer = page.ask("give", {{"as", as}});
    INFO(answer.dump());
    const std::string file = answer.at("done").at("file");
    CHECK(io::read_mesh(file).mesh->number_of_faces() == head_of(page.cloth, 3));
  }
  for (int i = 0; i < 2; ++i) {  // again: it is replaced
    const Json answer = page.ask("give", {{"as", "original"}});
    INFO(answer.dump());
    const auto moved = tests::positions(io::read_mesh(answer.at("done").at("file").get<std::string>()));
    const auto start = tests::positions(io::read_mesh(desk.folder / "sheet.ply"));
    REQUIRE(moved.size() == start.size());
    CHECK(moved != start);
  }
  CHECK(page.ask("give", {{"as", "../x"}}).contains("refused"));
}

TEST_CASE("studio cloth: what was draped without a line goes onto its own vertices, too", "[release]") {
  const Desk desk("give_draped");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("drape").contains("done"));
  const Json given = page.ask("give", {{"as", "original"}});
  INFO(given.dump());
  const auto moved = tests::positions(io::read_mesh(given.at("done").at("file").get<std::string>())),
             start = tests::positions(io::read_mesh(desk.folder / "sheet.ply"));
  REQUIRE(moved.size() == start.size());
  double farthest = 0;  // it hung before
  for (std::size_t i = 0; i < moved.size(); ++i)
    farthest = std::max(farthest, std::sqrt(CGAL::squared_distance(moved[i], start[i])));
  CHECK(farthest < 0.05);
  CHECK(moved != start);
}

TEST_CASE("studio cloth: how it moved is given away as an animation, but not what was pulled at",
          "[release]") {
  const Desk desk("animation");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  CHECK(page.ask("give", {{"as", "pc2"}}).at("refused").get<std::string>().find("nothing has moved yet") ==
        0);
  REQUIRE(page.ask("play", {{"seconds", 0.2}}).contains("done"));
  for (const std::string as : {"moving glb", "pc2"}) {
    const Json answer = page.ask("give", {{"as", as}});
    INFO(answer.dump());
    REQUIRE(answer.contains("done"));
    CHECK(std::filesystem::file_size(answer["done"].at("file").get<std::string>()) > 5000);
  }
  CHECK(tests::names_in(desk.project() / "give") == std::set<std::string>{"sheet-moving.glb", "sheet.pc2"});
  REQUIRE(page.ask("play",
                   {{"seconds", 0.05}, {"pulls", {{{"time", 0.2}, {"vertex", 3}, {"to", {0.0, 0.1, 0.2}}}}}})
              .contains("done"));
  CHECK(page.ask("give", {{"as", "pc2"}}).at("refused").get<std::string>().find("cannot be done again") !=
        std::string::npos);
}

TEST_CASE("studio cloth: maps need texture coordinates, and say so") {
  const Desk desk("maps");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("draw", line_at(0.0)).contains("done"));
  CHECK(page.ask("give", {{"as", "maps"}}).at("refused").get<std::string>().find("texture coordinates") !=
        std::string::npos);
}

}  // namespace furrow
