// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/studio.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "jobs/chain/wrinkle.h"
#include "jobs/move/simulate.h"
#include "jobs/sketch/play_sketch.h"
#include "tests/studio/visitor.h"
#include "tests/test_meshes.h"

namespace furrow {
namespace {

namespace http = boost::beast::http;
namespace fs = std::filesystem;
using jobs::Json;
using tests::Desk;
using tests::line_at;
using tests::Visitor;

/// The status of a request, and its body.
http::response<http::string_body> get(const studio::Studio& studio, const std::string& target,
                                      std::string host = "") {
  if (host.empty()) host = "127.0.0.1:" + std::to_string(studio.port());
  http::request<http::string_body> request(http::verb::get, target, 11);
  request.set(http::field::host, host);
  return tests::answer_to(studio, request);
}

}  // namespace

TEST_CASE("studio: a line is drawn, changed, switched off, undone and drawn again, to the same bytes") {
  const Desk desk("draw");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("take").contains("done"));
  const std::string bare = page.cloth;
  REQUIRE(page.ask("draw", line_at(0.2)).contains("done"));
  page.ask("show");
  const std::string drawn = page.cloth;
  CHECK(drawn.size() > bare.size());
  CHECK(page.status.at("lines").at(0).at("name") == "ridge 1");
  CHECK(page.status.at("undo") == "draw ridge 1");
  REQUIRE(page.ask("set", {{"line", 0}, {"height", 0.03}}).contains("done"));
  page.ask("show");
  CHECK(page.cloth != drawn);
  REQUIRE(page.ask("set", {{"line", 0}, {"on", false}}).contains("done"));
  page.ask("show");
  CHECK(page.cloth == bare);
  page.ask("undo");
  page.ask("undo");
  page.ask("show");
  CHECK(page.cloth == drawn);
  page.ask("undo");
  page.ask("show");
  CHECK(page.cloth == bare);
  CHECK(page.ask("undo").at("refused") == "there is nothing to undo");
  for (int i = 0; i < 3; ++i) CHECK(page.ask("redo").contains("done"));
  CHECK(page.ask("redo").at("refused") == "there is nothing to do again");
}

TEST_CASE("studio: its history tells what each step was, also of those undone") {
  const Desk desk("history");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("draw", line_at(0.2)).contains("done"));
  REQUIRE(page.ask("set", {{"line", 0}, {"height", 0.03}}).contains("done"));
  REQUIRE(page.ask("undo").contains("done"));
  const Json told = page.ask("history").at("done");
  CHECK(told.at("first") == 0);
  CHECK(told.at("at") == 1);
  CHECK(told.at("steps") == Json::array({"the beginning", "draw ridge 1", "change the height of ridge 1"}));
  REQUIRE(page.ask("draw", line_at(0.1)).contains("done"));
  CHECK(page.ask("history").at("done").at("steps") ==
        Json::array({"the beginning", "draw ridge 1", "draw ridge 2"}));
}

TEST_CASE("studio: what is saved is what furrow wrinkle draws") {
  const Desk desk("save");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  for (const Json& line : {line_at(0.05), line_at(0.15, -0.02)}) {
    const Json answer = page.ask("draw", line);
    INFO(answer.dump());
    REQUIRE(answer.contains("done"));
  }
  const Json saved = page.ask("save");
  INFO(saved.dump());
  REQUIRE(saved.at("done").at("written").size() == 3);
  REQUIRE(tests::saved_strokes(desk.project()).size() == 2);
  tests::empty_folder("studio_other");
  jobs::WrinkleJob job;
  job.garment = (desk.folder / "sheet.ply").string();
  job.strokes = (desk.project() / "strokes.json").string();
  struct : jobs::Listener {
  } nobody;
  const jobs::WrinkleReport report = jobs::wrinkle(job, nobody);
  CHECK(tests::positions(report.garment) == tests::positions(io::read_mesh(desk.project() / "shape.ply")));
}

TEST_CASE("studio: a project is gone on with where it was, and its folder is not taken for another drawing") {
  const Desk desk("again");
  std::string drawn;
  {
    const studio::Studio studio(desk.scene, desk.project());
    Visitor page(studio);
    page.ask("draw", line_at(0.2));
    page.ask("show");
    drawn = page.cloth;
  }
  REQUIRE(studio::Studio::is_project(desk.project()));
  {
    const studio::Studio studio(desk.project());
    Visitor page(studio);
    page.ask("show");
    CHECK(page.cloth == drawn);
    CHECK(page.ask("undo").contains("done"));
  }
  jobs::SceneInput other = desk.scene;
  io::set_value(other.settings, "material.preset", "denim", "test");
  CHECK_THROWS_AS(studio::Studio(other, desk.project()), std::invalid_argument);
  CHECK_THROWS_AS(studio::Studio(desk.scene, desk.folder), std::invalid_argument);  // there, and no project
}

TEST_CASE("studio: it drapes, and the lines that are on are in the cloth then", "[release]") {
  const Desk desk("drape");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  page.ask("draw", line_at(0.2));
  REQUIRE(page.ask("draw", line_at(0.1)).contains("done"));
  REQUIRE(page.ask("set", {{"line", 1}, {"on", false}}).contains("done"));
  const Json answer = page.ask("drape");
  INFO(answer.dump());
  REQUIRE(answer.at("done").at("outcome") == "at rest");
  CHECK(page.status.at("earlier") == Json::array({"ridge 1"}));
  REQUIRE(page.status.at("lines").size() == 1);
  CHECK(page.status.at("lines")[0].at("name") == "ridge 2");
  CHECK(page.status.at("lines")[0].at("on") == false);
  CHECK(page.ask("undo").contains("done"));
  page.ask("show");
  CHECK(page.status.at("lines").size() == 2);
}

TEST_CASE("studio: play moves the cloth as furrow simulate does, goes on to the same bits, and can be undone",
          "[release]") {
  const Desk desk("play");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("draw", line_at(0.2)).contains("done"));
  page.ask("show");
  const std::string drawn = page.cloth;
  REQUIRE(page.ask("save").contains("done"));
  const Json first = page.ask("play", {{"seconds", 6 / 60.0}});
  INFO(first.dump());
  REQUIRE(first.at("done").at("time") == Approx(0.1));
  CHECK(page.moved >= 1);
  CHECK(page.status.at("earlier") == Json::array({"ridge 1"}));
  REQUIRE(page.ask("play", {{"seconds", 6 / 60.0}}).at("done").at("time") == Approx(0.2));
  struct : jobs::Listener {
  } nobody;
  jobs::SimulateJob job;
  job.scene = jobs::scene_from_file(desk.project() / "scene.toml");
  io::set_value(job.scene.settings, "output.mesh", "-", "test");
  io::set_value(job.scene.settings, "simulation.seconds", jobs::longest_play, "test");
  for (const auto& [seconds, file] : {std::pair{6 / 60.0, "run-1.ply"}, {12 / 60.0, "run-2.ply"}}) {
    io::set_value(job.scene.settings, "simulation.stop_at", seconds - 1e-6, "test");
    const bool same = tests::positions(jobs::simulate(job, nobody).garment) ==
                      tests::positions(io::read_mesh(desk.project() / file));
    CHECK(same);
  }
  CHECK(page.ask("undo").contains("done"));
  CHECK(page.ask("undo").contains("done"));
  page.ask("show");
  CHECK(page.cloth == drawn);
  CHECK(page.status.at("time") == 0);
}

TEST_CASE("studio: a play at a tenth of the clock's pace takes ten times as long, to the same bits",
          "[release]") {
  const Desk slow("slow"), fast("fast");
  std::vector<std::string> reached;
  double took = 0;
  for (const Desk* desk : {&slow, &fast}) {
    const studio::Studio studio(desk->scene, desk->project());
    Visitor page(studio);
    const auto begun = std::chrono::steady_clock::now();
    Json play{{"seconds", 6 / 60.0}};
    if (desk == &slow) play["speed"] = 0.1;
    REQUIRE(page.ask("play", play).contains("done"));
    if (desk == &slow) took = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    page.ask("show");
    reached.push_back(page.cloth);
  }
  CHECK(took > 0.8);
  CHECK(reached[0] == reached[1]);
}

TEST_CASE("studio: a line that is drawn into moving cloth leaves it its velocities", "[release]") {
  Desk desk("more");
  io::set_value(desk.scene.settings, "forces.gravity", {0.0, 0.0, -9.81}, "test");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("play", {{"seconds", 5 / 60.0}}).contains("done"));
  const auto lowest = [&](const std::string& file) {
    double z = 1;
    for (const auto& p : tests::positions(io::read_mesh(desk.project() / file))) z = std::min(z, p.z());
    return z;
  };
  Json line = line_at(0.2);
  line["points"] = {{-0.1, 0.33, 0.0}, {0.0, 0.33, 0.0}, {0.1, 0.33, 0.0}};
  const Json drawn = page.ask("draw", line);
  INFO(drawn.dump());
  REQUIRE(drawn.contains("done"));
  const Json more = page.ask("play", {{"seconds", 3 / 60.0}});
  INFO(more.dump());
  REQUIRE(more.at("done").at("time") == Approx(8 / 60.0));
  const double drawn_moving = lowest("run-2.ply");
  for (int i = 0; i < 2; ++i) REQUIRE(page.ask("undo").contains("done"));
  REQUIRE(page.ask("play", {{"seconds", 3 / 60.0}}).contains("done"));
  const double undrawn = lowest("run-3.ply");
  CHECK(undrawn < lowest("run-1.ply"));
  CHECK(std::abs(drawn_moving - undrawn) < 0.25 * std::abs(undrawn - lowest("run-1.ply")));
}

TEST_CASE("studio: a play lasts until it is paused, and what was reached is kept", "[release]") {
  const Desk desk("pause");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  page.ask("take");
  page.send(R"({"id":"on","do":"play"})");
  REQUIRE(page.sees_motion());
  page.send(R"({"id":"stop","do":"pause"})");
  Json answer = page.answer();
  while (answer.at("id") != "on") answer = page.answer();
  REQUIRE(answer.contains("done"));
  CHECK(answer.at("done").at("time") > 0);
  CHECK(page.status.at("time") == answer["done"]["time"]);
  CHECK(page.status.at("undo").get<std::string>().find("move to ") == 0);
  REQUIRE(page.ask("drape").contains("done"));
  CHECK(page.status.at("time") == 0);
}

TEST_CASE("studio: a line is mirrored, and both lie as far from the middle") {
  const Desk desk("mirror");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("draw", line_at(0.12, -0.02)).contains("done"));
  REQUIRE(page.ask("mirror", {{"line", 0}}).contains("done"));
  CHECK(page.ask("mirror", {{"line", 2}}).contains("refused"));
  REQUIRE(page.status.at("lines").size() == 2);
  CHECK(page.status["lines"][1].at("name") == "valley 2");
  CHECK(page.status.at("undo") == "mirror valley 1");
  REQUIRE(page.ask("save").contains("done"));
  const Json strokes = tests::saved_strokes(desk.project());
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(strokes.at(1).at("points").at(i).at(0).get<double>() == Approx(-0.12));
    CHECK(strokes[1]["points"][i].at(1) == strokes.at(0).at("points").at(i).at(1));
  }
  CHECK(strokes[1].at("height") == strokes[0].at("height"));
}

TEST_CASE("studio: it colours the cloth by its fit, in the words of furrow fit, and changes nothing") {
  const Desk desk("fit");
  jobs::SceneInput scene = desk.scene;
  const studio::Studio bare(scene, desk.project());
  {
    Visitor page(bare);
    CHECK(page.ask("fit", {{"by", "strain"}}).at("refused").get<std::string>().find("no body") !=
          std::string::npos);
  }
  io::MeshFile ball;
  ball.mesh = tests::icosphere(3, 0.15, {0, 0.2, -0.2});
  io::write_mesh(desk.folder / "ball.ply", ball);
  io::set_value(scene.settings, "body.mesh", "ball.ply", "test");
  const studio::Studio studio(scene, desk.folder / "dressed");
  Visitor page(studio);
  CHECK(
      page.ask("fit", {{"by", "strain"}}).contains("done"));  // also as it was made, which is without strain
  REQUIRE(page.ask("draw", line_at(0.1)).contains("done"));
  page.ask("show");
  const std::string before = page.cloth;
  const Json status = page.status;
  for (const std::string by : {"distance", "strain"}) {
    const Json answer = page.ask("fit", {{"by", by}});
    INFO(answer.dump());
    REQUIRE(answer.contains("done"));
    CHECK(answer["done"].at("words").get<std::string>().find(
              by == "strain" ? "strained over" : "nearer than") != std::string::npos);
    REQUIRE(page.colours.size() > 16);
    std::uint32_t vertices = 0;
    std::memcpy(&vertices, page.cloth.data() + 8, 4);
    CHECK(page.colours.size() == 16 + 3 * std::size_t(vertices));
    CHECK(std::set<char>(page.colours.begin() + 16, page.colours.end()).size() > 2);
  }
  CHECK(page.ask("fit", {{"by", "ease"}}).contains("refused"));
  page.ask("show");
  CHECK(page.cloth == before);
  CHECK(page.status == status);
}

TEST_CASE("studio: the body is sent again only where it has moved") {
  const Desk desk("body");
  jobs::SceneInput scene = desk.scene;
  io::MeshFile ball;
  ball.mesh = tests::icosphere(2, 0.15, {0, 0.2, -0.4});
  io::write_mesh(desk.folder / "ball.ply", ball);
  io::set_value(scene.settings, "body.mesh", "ball.ply", "test");
  io::set_value(scene.settings, "body.motion.spin",
                Json{{"axis", {0, 1, 0}}, {"rate", 1}, {"start", 0}, {"ramp", 0.1}}, "test");
  const studio::Studio studio(scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("draw", line_at(0.2)).contains("done"));
  REQUIRE(page.ask("set", {{"line", 0}, {"height", 0.03}}).contains("done"));
  REQUIRE(page.ask("undo").contains("done"));
  REQUIRE(page.ask("fabric", {{"name", "silk"}}).contains("done"));
  page.ask("show");
  CHECK(page.bodies == 1);
  const std::string as_begun = page.body;
  REQUIRE(page.ask("play", {{"seconds", 2 / 60.0}}).contains("done"));
  REQUIRE(page.ask("undo").contains("done"));
  page.ask("show");
  CHECK(page.bodies == 2);
  CHECK(page.body == as_begun);
}

TEST_CASE("studio: without its token, from another host or another page, nothing is told") {
  const Desk desk("doors");
  const studio::Studio studio(desk.scene, desk.project());
  const std::string with = "/?token=" + studio.token();
  CHECK(get(studio, with).result() == http::status::ok);
  CHECK(get(studio, "/").result() == http::status::forbidden);
  CHECK(get(studio, "/app.js").result() == http::status::forbidden);
  std::string wrong = with;
  wrong.back() = wrong.back() == '0' ? '1' : '0';
  CHECK(get(studio, wrong).result() == http::status::forbidden);
  CHECK(get(studio, with, "furrow.example").result() == http::status::misdirected_request);
  CHECK(get(studio, "/../project.json?token=" + studio.token()).result() == http::status::not_found);
  CHECK_THROWS_AS(Visitor(studio, "http://furrow.example"), boost::system::system_error);
  const auto page = get(studio, with);
  CHECK(std::string(page["Content-Security-Policy"]).find("default-src 'none'") == 0);
  CHECK(page["X-Content-Type-Options"] == "nosniff");
  CHECK(page["Cache-Control"] == "no-store");
}

TEST_CASE("studio: connections that ask for nothing keep nobody out") {
  namespace asio = boost::asio;
  const Desk desk("silent");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor before(studio);
  asio::io_context io;
  std::vector<asio::ip::tcp::socket> silent;
  const auto connect = [&](const std::string& said) {
    silent.emplace_back(io);
    silent.back().connect({asio::ip::address_v4::loopback(), studio.port()});
    asio::write(silent.back(), asio::buffer(said));
  };
  for (int i = 0; i < 100; ++i) connect(i % 2 ? "" : "GET /?token=");
  CHECK(get(studio, "/?token=" + studio.token()).result() == http::status::ok);
  for (int i = 0; i < 10; ++i) {
    connect("");
    Visitor page(studio);
    CHECK(page.ask("take").contains("done"));
  }
  CHECK(before.ask("take").contains("done"));
  CHECK(before.ask("draw", line_at(0.1)).contains("done"));
}

TEST_CASE("studio: one page more than it bears is refused in words, and the others go on") {
  const Desk desk("crowd");
  const studio::Studio studio(desk.scene, desk.project());
  std::vector<std::unique_ptr<Visitor>> pages;
  for (int i = 0; i < 32; ++i) pages.push_back(std::make_unique<Visitor>(studio));
  CHECK(pages.back()->ask("take").contains("done"));
  CHECK_THROWS_AS(Visitor(studio), boost::system::system_error);
  pages.erase(pages.begin());
  CHECK(pages.back()->ask("draw", line_at(0.1)).contains("done"));
}

TEST_CASE("studio: one page draws, another watches until it takes the pen") {
  const Desk desk("two");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor first(studio);
  first.ask("take");
  Visitor second(studio);
  CHECK(second.ask("draw", line_at(0.2)).at("refused").get<std::string>().find("another page") == 0);
  CHECK(second.ask("take").contains("done"));
  CHECK(second.ask("draw", line_at(0.2)).contains("done"));
  CHECK(first.ask("draw", line_at(0.1)).contains("refused"));
}

TEST_CASE("studio: a page that reads nothing holds nobody up") {
  const Desk desk("deaf");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  page.ask("show");
  const Visitor deaf(studio);  // what is sent to it waits, and gives way to what is newer
  for (int i = 0; i < 80; ++i) REQUIRE(page.ask("show").contains("done"));
  REQUIRE(page.ask("draw", line_at(0.2)).contains("done"));
  CHECK(page.status.at("lines").size() == 1);
}

}  // namespace furrow
