// SPDX-License-Identifier: GPL-3.0-or-later
// A project's folder that is not as we left it: locked, damaged, or made to lead elsewhere.
#include "studio/project.h"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "studio/replay.h"
#include "studio/session.h"
#include "tests/studio/visitor.h"

namespace furrow {
namespace {

namespace fs = std::filesystem;
using jobs::Json;
using studio::Project;
using tests::Desk;
using tests::line_at;
using tests::Visitor;

/// Hears the last answer.
struct LastAnswer : studio::Outbox {
  void tell(studio::Client, const Json& message) override {
    if (message.contains("id")) answer = message;
  }
  void show(studio::Client, studio::Bytes) override {}
  Json answer;
};

/// What a program says that opens the folder; "": it is open.
std::string refusal_to_open(const fs::path& folder) {
  LastAnswer out;
  try {
    const studio::Session session(folder, out);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

/// A project with two lines, of which the second is undone.
void draw_two(const Desk& desk) {
  LastAnswer out;
  studio::Session session(desk.scene, desk.project(), out);
  for (const double x : {-0.1, 0.1}) {
    Json draw = line_at(x);
    draw["do"] = "draw";
    session.handle(1, {1, "draw", draw});
  }
  session.handle(1, {1, "undo", {{"do", "undo"}}});
}

/// Such a project, which can be had again as it was.
class Drawn {
 public:
  explicit Drawn(const Desk& desk) : folder_(desk.project()), sound_(tests::empty_folder("studio_sound")) {
    draw_two(desk);
    fs::copy(folder_, sound_, fs::copy_options::recursive);
  }
  void restore() const {
    fs::remove_all(folder_);
    fs::copy(sound_, folder_, fs::copy_options::recursive);
  }

 private:
  const fs::path folder_, sound_;
};

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

/// Asks for one of each kind of thing that writes; what is refused is no matter here.
void do_all(studio::Session& session, bool drapes) {
  const std::vector<Json> asked{{{"do", "draw"}, {"height", 0.01}, {"points", line_at(0.05).at("points")}},
                                {{"do", "undo"}},
                                {{"do", "redo"}},
                                {{"do", "save"}},
                                {{"do", "give"}, {"as", "obj"}},
                                {{"do", "play"}, {"seconds", 1 / 60.0}},
                                {{"do", "save"}},
                                {{"do", "give"}, {"as", "pc2"}},
                                {{"do", "drape"}},
                                {{"do", "history"}}};
  for (const Json& body : asked) {
    if (body.at("do") == "drape" && !drapes) continue;
    session.allow();
    session.handle(1, {1, body.at("do"), body});
  }
}

std::string nested(int levels) { return std::string(levels, '[') + std::string(levels, ']'); }

}  // namespace

TEST_CASE(
    "studio project: while a studio has it a second one is refused and says so, while replays may read it") {
  const Desk desk("second");
  {
    const studio::Studio first(desk.scene, desk.project());
    Visitor page(first);
    REQUIRE(page.ask("draw", line_at(0.1)).contains("done"));
    CHECK(refusal_to_open(desk.project()).find("is open in another studio") != std::string::npos);
    CHECK_THROWS_AS(studio::Studio(desk.scene, desk.project()), std::runtime_error);
    CHECK(page.ask("draw", line_at(-0.1)).contains("done"));
    CHECK(studio::replay(desk.project(), desk.folder / "again", [](auto, auto) { return true; }).difference ==
          "");
  }
  CHECK(refusal_to_open(desk.project()) == "");
  REQUIRE(fs::exists(desk.project() / "lock"));  // left by the first, it shuts nobody out
  CHECK(refusal_to_open(desk.project()) == "");
}

TEST_CASE("studio project: what a start that was broken off has left is begun anew, and nothing else is") {
  const Desk desk("broken_off");
  fs::create_directories(desk.project() / "history");
  write_text(desk.project() / "history/0.json", "{");
  write_text(desk.project() / "lock", "");
  LastAnswer out;
  { const studio::Session session(desk.scene, desk.project(), out); }
  CHECK(refusal_to_open(desk.project()) == "");
  const fs::path other = desk.folder / "other";
  fs::create_directories(other / "history");
  write_text(other / "history/thesis.txt", "mine");
  CHECK_THROWS_AS(studio::Session(desk.scene, other, out), std::invalid_argument);
  CHECK(tests::bytes_of(other / "history/thesis.txt") == "mine");
}

TEST_CASE("studio project: files that are nested deep, no JSON, or of another form are refused in words") {
  const Desk desk("damaged");
  const fs::path state = desk.project() / "project.json", step = desk.project() / "history/1.json",
                 undone = desk.project() / "history/2.json";
  const Drawn drawn(desk);
  const std::string deep = nested(200000);
  const std::vector<std::pair<fs::path, std::string>> damages{
      {state, deep},
      {state, R"({"furrow_studio":1,"opened_with":)" + deep + "}"},
      {state, "{"},
      {state, "[]"},
      {state, ""},
      {state, R"({"furrow_studio":2})"},
      {state, R"({"furrow_studio":1,"at":"1"})"},
      {state, R"({"furrow_studio":1,"at":-1})"},
      {state, R"({"furrow_studio":1,"at":7,"count":3})"},
      {state, R"({"furrow_studio":1,"at":0,"count":18446744073709551615})"},
      {step, deep},
      {step, R"({"what":"x","drawing":)" + deep + "}"},
      {step, R"({"what":"x"})"},
      {step, R"({"what":7,"drawing":{"settings":{},"lines":[]}})"},
      {step, R"({"what":"x","drawing":{"settings":{},"lines":[{"stroke":7}]}})"},
      {step, R"({"what":"x","drawing":{"settings":{},"lines":[],"middle":"x"}})"},
      {step, R"({"what":"x","drawing":{"settings":{},"lines":[],"motion":{"again":true}}})"},
      {step, R"({"what":"x","drawing":{"settings":{"garment":{"mesh":7}},"lines":[]}})"},
      {undone, deep}};
  for (const auto& [file, text] : damages) {
    INFO(file << " " << text.substr(0, 80));
    drawn.restore();
    write_text(file, text);
    CHECK(refusal_to_open(desk.project()).size() > 20);
  }
  drawn.restore();
  const std::string log = tests::bytes_of(desk.project() / "log.jsonl");
  for (const std::string& line : {deep, std::string("{"), std::string("[]"), std::string(R"({"do":7})")}) {
    write_text(desk.project() / "log.jsonl", line.substr(0, log.size() - 1) + "\n");
    CHECK_THROWS_AS(studio::replay(desk.project(), desk.folder / "again", [](auto, auto) { return true; }),
                    geometry::ContentError);
  }
}

TEST_CASE("studio project: a step back to what is damaged is refused, and the drawing stays as it is") {
  const Desk desk("damaged_step");
  draw_two(desk);
  LastAnswer out;
  studio::Session session(desk.project(), out);
  write_text(desk.project() / "history/0.json", R"({"what":"x","drawing":{"settings":{},"lines":7}})");
  write_text(desk.project() / "history/2.json", nested(200000));
  const Json before = session.project().now().drawing;
  for (const char* what : {"undo", "redo", "history"}) {
    session.handle(1, {1, what, {{"do", what}}});
    CHECK(out.answer.value("refused", "it was done").find("history/") != std::string::npos);
  }
  CHECK(session.project().at() == 1);
  CHECK(session.project().now().drawing == before);
}

TEST_CASE("studio project: a frame that is none is drawn anew, and one that is a pipe holds nobody up") {
  const Desk desk("frames");
  draw_two(desk);
  const fs::path frame = desk.project() / "history/1.frame";
  const std::string sound = tests::bytes_of(frame);
  REQUIRE(sound.size() > 100);
  std::string counts = sound;
  counts[10] = '\x7f';
  std::uint32_t vertices = 0;
  std::memcpy(&vertices, sound.data() + 8, 4);
  std::string face = sound;
  face[24 + 24 * std::size_t(vertices) + 3] = '\x7f';  // of the first face's first vertex
  for (const std::string& bytes :
       {std::string(), std::string("rubbish"), sound.substr(0, 200), counts, face}) {
    write_text(frame, bytes);
    const studio::Studio studio(desk.project());
    Visitor page(studio);
    page.ask("show");
    CHECK(page.cloth == sound);
  }
  fs::remove(frame);
  REQUIRE(mkfifo(frame.c_str(), 0600) == 0);
  const studio::Studio studio(desk.project());
  Visitor page(studio);
  page.ask("show");
  CHECK(page.cloth == sound);
}

TEST_CASE("studio project: no link in it is written over, whatever is asked for", "[release]") {
  const Desk desk("links");
  const Drawn drawn(desk);
  const std::vector<std::string> places{"project.json",    "log.jsonl",       "lock",
                                        "history",         "history/2.json",  "history/2.new",
                                        "history/2.frame", "history/1.frame", "scene.toml",
                                        "strokes.json",    "shape.ply",       "give",
                                        "give/sheet.obj",  "run-1.ply",       "run-1-state.ply",
                                        "rest-1.ply",      "motion.toml",     "motion-strokes-1.json"};
  for (const std::string& place : places)
    for (const bool dangles : {false, true}) {
      INFO(place << (dangles ? ", to nothing" : ""));
      drawn.restore();
      const fs::path outside = tests::empty_folder("studio_outside"), link = desk.project() / place;
      const bool is_folder = place == "history" || place == "give";
      if (is_folder && !dangles && place == "history")
        fs::copy(link, outside / "target");
      else if (is_folder && !dangles)
        fs::create_directory(outside / "target");
      else if (!dangles)
        write_text(outside / "target", fs::exists(link) ? tests::bytes_of(link) : "mine");
      const auto files = [&] {
        std::map<std::string, std::string> found;
        for (const auto& entry : fs::recursive_directory_iterator(outside))
          found[entry.path().string()] = entry.is_regular_file() ? tests::bytes_of(entry.path()) : "";
        return found;
      };
      const auto before = files();
      fs::remove_all(link);
      fs::create_directories(link.parent_path());
      fs::create_symlink(outside / "target", link);
      LastAnswer out;
      try {
        studio::Session session(desk.project(), out);
        do_all(session, place == "rest-1.ply");
      } catch (const std::runtime_error& e) {
        CHECK(std::string(e.what()).size() > 20);
      }
      CHECK(files() == before);
    }
}

TEST_CASE("studio project: another name of the log's file, elsewhere, keeps what it held") {
  const Desk desk("hard_link");
  draw_two(desk);
  const fs::path outside = desk.folder / "outside.txt";
  fs::create_hard_link(desk.project() / "log.jsonl", outside);
  const std::string before = tests::bytes_of(outside);
  LastAnswer out;
  studio::Session session(desk.project(), out);
  session.handle(1, {1, "redo", {{"do", "redo"}}});
  CHECK(out.answer.contains("done"));
  CHECK(tests::bytes_of(outside) == before);
  CHECK(tests::bytes_of(desk.project() / "log.jsonl").find(before) == 0);
}

TEST_CASE(
    "studio project: pipes in place of its files, or of what it names, are refused and not waited for") {
  const Desk desk("pipes");
  const std::string sheet = tests::bytes_of(desk.folder / "sheet.ply");
  const Drawn drawn(desk);
  for (const std::string place : {"project.json", "log.jsonl", "history/1.json", "lock", "../sheet.ply"}) {
    INFO(place);
    drawn.restore();
    fs::remove(desk.folder / "sheet.ply");
    write_text(desk.folder / "sheet.ply", sheet);
    const fs::path pipe = desk.project() / place;
    fs::remove(pipe);
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    LastAnswer out;
    std::string why;
    try {
      studio::Session session(desk.project(), out);
      session.handle(1, {1, "undo", {{"do", "undo"}}});
      why = out.answer.value("refused", "");
    } catch (const std::exception& e) {
      why = e.what();
    }
    CHECK(why.size() > 20);
  }
}

TEST_CASE("studio project: files with a few other bytes are opened or refused, and never break anything",
          "[release]") {
  const Desk desk("bytes");
  draw_two(desk);
  std::map<std::string, std::string> sound;
  for (const std::string name :
       {"project.json", "log.jsonl", "history/0.json", "history/1.json", "history/2.json"})
    sound[name] = tests::bytes_of(desk.project() / name);
  std::mt19937_64 random(53);
  const std::vector<std::string> words{"null",
                                       "-1",
                                       "1e999",
                                       "[",
                                       "]",
                                       "{",
                                       "}",
                                       "\"",
                                       "\"../../x\"",
                                       "true",
                                       "99999999999999999999",
                                       ":",
                                       ",",
                                       std::string(1, '\0'),
                                       "\xff"};
  for (int i = 0; i < 100; ++i) {
    for (const auto& [name, bytes] : sound) write_text(desk.project() / name, bytes);
    auto hit = std::next(sound.begin(), std::ptrdiff_t(random() % sound.size()));
    std::string bytes = hit->second;
    for (std::uint64_t n = 1 + random() % 3; n > 0; --n)
      bytes.replace(random() % bytes.size(), random() % 12, words[random() % words.size()]);
    write_text(desk.project() / hit->first, bytes);
    LastAnswer out;
    try {
      studio::Session session(desk.project(), out);
      for (const char* what : {"undo", "redo", "history", "points", "save"})
        session.handle(1, {1, what, {{"do", what}, {"line", 0}}});
    } catch (const std::exception& e) {
      CHECK(std::string(e.what()).size() > 10);
    }
  }
  CHECK(tests::names_in(desk.folder) == std::set<std::string>{"drawing", "sheet.ply"});
}

}  // namespace furrow
