// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/replay.h"

#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "jobs/move/simulate.h"
#include "jobs/sketch/play_sketch.h"
#include "tests/studio/visitor.h"

namespace furrow {
namespace {

using jobs::Json;
using tests::Desk;
using tests::line_at;
using tests::Visitor;
namespace fs = std::filesystem;

const auto go_on = [](std::size_t, std::size_t) { return true; };

/// Thirty things that a person does, of all kinds, two of them refused; returns how many were logged.
std::size_t thirty_intentions(Visitor& page) {
  const auto ask = [&](const std::string& what, const Json& body = Json::object()) {
    const Json answer = page.ask(what, body);
    INFO(what << " " << answer.dump());
    CHECK(answer.contains("done"));
  };
  ask("draw", line_at(-0.1));
  ask("draw", line_at(0.1, -0.015));
  ask("set", {{"line", 0}, {"height", 0.012}});
  ask("set", {{"line", 1}, {"sharpness", 0.9}});
  ask("undo");
  ask("redo");
  ask("duplicate", {{"line", 0}});
  ask("delete", {{"line", 2}});
  ask("set", {{"line", 1}, {"on", false}});
  ask("set", {{"line", 1}, {"on", true}});
  ask("move", {{"line", 1}, {"to", 0}});
  ask("set", {{"line", 0}, {"name", "left"}});
  ask("set", {{"line", 0}, {"points", line_at(0.11).at("points")}});
  ask("pin", {{"at", {0.1, 0.0, 0.0}}});
  ask("pin", {{"at", {-0.1, 0.0, 0.0}}});
  ask("pin", {{"at", {0.1, 0.0, 0.0}}});
  ask("fabric", {{"name", "denim"}});
  ask("wind", {{"velocity", {0.5, 0, 1}}});
  ask("play", {{"seconds", 3 / 60.0}});
  ask("play", {{"seconds", 4 / 60.0}, {"pulls", {{{"time", 0.06}, {"vertex", 5}, {"to", {0.0, 0.1, 0.1}}}}}});
  CHECK(page.ask("draw", {{"height", 0.01}, {"points", {{9, 9, 9}, {9, 9, 8}}}}).contains("refused"));
  CHECK(page.ask("delete", {{"line", 7}}).contains("refused"));
  ask("draw", line_at(0.0, 0.01));
  ask("play", {{"seconds", 2 / 60.0}});
  ask("undo");
  ask("undo");
  ask("draw", line_at(0.02, 0.01));
  ask("wind", {{"velocity", {0, 0, 0}}});
  ask("drape");
  ask("draw", line_at(0.05, -0.01));
  return 28;
}

/// A studio in a process of its own, which can be killed.
struct Child {
  explicit Child(const Desk& desk) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    pid = fork();
    if (pid == 0) {
      const studio::Studio studio(desk.scene, desk.project());
      const std::string said = std::to_string(studio.port()) + " " + studio.token() + "\n";
      if (write(ends[1], said.data(), said.size()) < 0) _exit(1);
      for (;;) pause();
    }
    close(ends[1]);
    std::string said;
    for (char c; read(ends[0], &c, 1) == 1 && c != '\n';) said += c;
    close(ends[0]);
    port = static_cast<unsigned short>(std::stoi(said));
    token = said.substr(said.find(' ') + 1);
  }
  ~Child() { end(); }
  void end() {
    if (pid <= 0) return;
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
    pid = 0;
  }
  pid_t pid = 0;
  unsigned short port = 0;
  std::string token;
};

}  // namespace

TEST_CASE("studio replay: thirty intentions done again end in the same bits", "[release]") {
  const Desk desk("thirty");
  std::size_t logged = 0;
  {
    const studio::Studio studio(desk.scene, desk.project());
    Visitor page(studio);
    logged = thirty_intentions(page);
  }
  const fs::path into = desk.folder / "again";
  const studio::ReplayReport report = studio::replay(desk.project(), into, go_on);
  CHECK(report.difference == "");
  CHECK(report.intentions == logged);
  CHECK_THROWS_AS(studio::replay(desk.project(), into, go_on), std::invalid_argument);  // it is there
  fs::remove_all(into);
  // A log that says something else ends elsewhere, and that is told.
  std::string log = tests::bytes_of(desk.project() / "log.jsonl");
  const std::size_t at = log.find("0.012");
  REQUIRE(at != std::string::npos);
  log.replace(at, 5, "0.013");
  std::ofstream(desk.project() / "log.jsonl", std::ios::binary) << log;
  CHECK(studio::replay(desk.project(), into, go_on).difference != "");
}

TEST_CASE("studio replay: a killed studio reopens, and has lost at most the step that it was at",
          "[release]") {
  const Desk desk("kill");
  std::mt19937 random(7);
  std::size_t acknowledged = 0;
  for (int round = 0; round < 12; ++round) {
    Child child(desk);
    std::size_t asked = acknowledged;
    std::jthread killer;
    const int first_steps = int(random() % 6);
    const auto kill_soon = [&, after = int(random() % 60)] {
      std::this_thread::sleep_for(std::chrono::milliseconds(after));
      kill(child.pid, SIGKILL);
    };
    try {
      Visitor page(child.port, child.token);
      page.ask("take");
      REQUIRE(page.status.at("step") >= acknowledged);
      acknowledged = asked = page.status.at("step");
      for (int i = 0;; ++i) {  // until it is killed
        if (i == first_steps) killer = std::jthread(kill_soon);
        ++asked;
        const double x = 0.004 * double(random() % 80) - 0.16;
        const bool has = !page.status.at("lines").empty();
        const Json answer = has ? page.ask("set", {{"line", 0}, {"points", line_at(x).at("points")}})
                                : page.ask("draw", line_at(x));
        if (!answer.contains("done")) throw std::runtime_error(answer.dump());
        acknowledged = page.status.at("step");
      }
    } catch (const boost::system::system_error&) {
      // it was killed
    }
    REQUIRE(killer.joinable());
    killer.join();
    child.end();
    const studio::Studio reopened(desk.project());
    Visitor page(reopened);
    page.ask("show");
    const std::size_t step = page.status.at("step");
    CHECK(step >= acknowledged);
    CHECK(step <= asked);
    acknowledged = step;
  }
  CHECK(acknowledged > 5);
  const studio::ReplayReport report = studio::replay(desk.project(), desk.folder / "again", go_on);
  CHECK(report.difference == "");
}

TEST_CASE("studio replay: the saved motion, run by furrow simulate, has the bits of the studio",
          "[release]") {
  const Desk desk("motion");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  REQUIRE(page.ask("draw", line_at(0.1)).contains("done"));
  REQUIRE(page.ask("play", {{"seconds", 3 / 60.0}}).contains("done"));
  REQUIRE(page.ask("draw", line_at(-0.1, -0.01)).contains("done"));
  REQUIRE(page.ask("play", {{"seconds", 3 / 60.0}}).contains("done"));
  REQUIRE(page.ask("play", {{"seconds", 2 / 60.0}}).contains("done"));
  const Json saved = page.ask("save");
  INFO(saved.dump());
  REQUIRE(saved.at("done").at("written").dump().find("motion.toml") != std::string::npos);
  struct : jobs::Listener {
  } nobody;
  jobs::SimulateJob job;
  job.scene = jobs::scene_from_file(desk.project() / "motion.toml");
  io::set_value(job.scene.settings, "output.mesh", "-", "test");
  const auto run = jobs::simulate(job, nobody);
  const bool same =
      tests::positions(run.garment) == tests::positions(io::read_mesh(desk.project() / "run-3.ply"));
  CHECK(same);
}

}  // namespace furrow
