// SPDX-License-Identifier: GPL-3.0-or-later
// What no page of ours would send: each is refused in words, and changes nothing, in memory or on disk.
#include <catch2/catch.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/studio/visitor.h"

namespace furrow {
namespace {

namespace fs = std::filesystem;
using jobs::Json;
using tests::Desk;
using tests::line_at;
using tests::Visitor;

/// Texts that are no message at all.
std::vector<std::string> no_messages() {
  std::vector<std::string> texts{"",
                                 " ",
                                 "{",
                                 "}",
                                 "[]",
                                 "7",
                                 "null",
                                 "true",
                                 "\"undo\"",
                                 "{}",
                                 "{]",
                                 "undo",
                                 "{\"id\":1}",
                                 "{\"do\":\"undo\"}",
                                 "{'id':1,'do':'undo'}",
                                 "{\"id\":1,\"do\":\"undo\"",
                                 "{\"id\":1,\"do\":\"undo\"}}",
                                 "{\"id\":1,\"do\":\"undo\",}",
                                 "{\"id\":NaN,\"do\":\"undo\"}",
                                 "{\"id\":1 \"do\":\"undo\"}",
                                 "\x01\x02\x03",
                                 "GET / HTTP/1.1",
                                 "<script>alert(1)</script>",
                                 std::string(100, '['),
                                 std::string(5000, '{'),
                                 std::string(100000, 'a'),
                                 std::string(2000, ' ') + "{",
                                 "{\"id\":1,\"do\":\"draw\",\"points\":" + std::string(9, '[')};
  for (const char* id : {"null", "[]", "{}", "1.5", "true", "1e999"})
    texts.push_back(std::string(R"({"id":)") + id + R"(,"do":"undo"})");
  texts.push_back(R"({"id":")" + std::string(65, 'x') + R"(","do":"undo"})");
  for (const char* what : {"7", "null", "[]", "{}", "true", "\"\"", "\"rm\"", "\"Draw\"", "\"undo \"",
                           "\"__proto__\"", "\"../save\"", "\"shape_bits\"", "\"constructor\""})
    texts.push_back(std::string(R"({"id":1,"do":)") + what + "}");
  texts.push_back(R"({"id":1,"do":")" + std::string(33, 'x') + R"("})");
  return texts;
}

/// What a key of an intention may not be, as JSON texts.
struct Key {
  std::string intention, key;
  Json good;  ///< the whole message, but for the key
  std::vector<std::string> bad;
};

const std::vector<std::string> no_numbers{"null", "true", "\"1\"", "[]", "{}", "1e300", "-1e300", "1e999"};
const std::vector<std::string> no_indices{
    "null", "true", "\"0\"", "[0]", "{}", "-1", "0.5", "99", "18446744073709551615"};
const std::vector<std::string> no_points{"null",
                                         "7",
                                         "\"a\"",
                                         "{}",
                                         "[]",
                                         "[[0,0.1,0]]",
                                         "[[0,0],[1,1]]",
                                         "[[0,0,0,0],[1,1,1,1]]",
                                         "[[\"a\",0,0],[1,1,1]]",
                                         "[[null,0,0],[1,1,1]]",
                                         "[[1e300,0,0],[1,1,1]]",
                                         "[[9,9,9],[9.1,9,9]]",
                                         "[[[0,0,0]],[[1,1,1]]]"};
const std::vector<std::string> no_places{"null",      "7",           "\"a\"",       "[]",       "[0,0]",
                                         "[0,0,0,0]", "[\"a\",0,0]", "[1e300,0,0]", "{\"x\":1}"};
const std::vector<std::string> no_texts{"null", "7", "true", "[]", "{}", "\"" + std::string(300, 'x') + "\""};

std::vector<std::string> with(std::vector<std::string> list, const std::vector<std::string>& more) {
  list.insert(list.end(), more.begin(), more.end());
  return list;
}

std::vector<Key> keys() {
  const Json line = line_at(0.1), first{{"line", 0}};
  const auto and_also = [](Json body, const char* key, Json value) {
    body[key] = std::move(value);
    return body;
  };
  return {{"draw", "height", line, with(no_numbers, {"1.1", "-1.1"})},
          {"draw", "width", line, with(no_numbers, {"0", "-0.1", "11"})},
          {"draw", "sharpness", line, with(no_numbers, {"-0.1", "1.1"})},
          {"draw", "points", line, no_points},
          {"draw", "closed", line, {"null", "1", "\"true\"", "[]"}},
          {"draw", "mirror", line, {"null", "1", "\"true\"", "[]"}},
          {"draw", "name", line, no_texts},
          {"set", "line", {{"height", 0.01}}, no_indices},
          {"set", "height", first, with(no_numbers, {"2"})},
          {"set", "width", first, {"true", "\"1\"", "[]", "{}", "0", "-1", "1e300"}},
          {"set", "press", first, with(no_numbers, {"0.5", "1e7"})},
          {"set", "gather", first, {"true", "\"1\"", "[]", "{}", "0", "0.05", "1.1", "1e300"}},
          {"set", "on", first, {"null", "1", "\"true\"", "[]"}},
          {"set", "live", and_also(first, "height", 0.01), {"null", "1", "\"true\"", "[]"}},
          {"set", "points", first, no_points},
          {"set",
           "lines",
           {{"height", 0.01}},
           {"[]", "{}", "3", "null", "[-1]", "[0.5]", "[\"0\"]", "[0,99]", "[0,0,0,0,0,0]"}},
          {"set", "name", {{"lines", {0}}}, {"\"a\""}},
          {"set", "name", first, no_texts},
          {"delete", "line", Json::object(), no_indices},
          {"duplicate", "line", Json::object(), no_indices},
          {"mirror", "line", Json::object(), no_indices},
          {"move", "line", {{"to", 0}}, no_indices},
          {"move", "to", first, no_indices},
          {"points", "line", Json::object(), no_indices},
          {"middle", "x", Json::object(), no_numbers},
          {"fabric", "name", Json::object(),
           with(no_texts, {"\"\"", "\"../../etc/passwd\"", "\"no such cloth\""})},
          {"wind", "velocity", Json::object(), with(no_places, {"[51,0,0]"})},
          {"pin", "at", Json::object(), with(no_places, {"[5,5,5]"})},
          {"pin",
           "vertices",
           {{"on", true}},
           {"null", "7", "[]", "[-1]", "[0.5]", "[\"0\"]", "[[0]]", "[4294967296]", "{}"}},
          {"pin", "on", {{"vertices", {0}}}, {"null", "1", "\"true\"", "[]"}},
          {"hold", "border", {{"on", true}}, no_indices},
          {"hold", "on", {{"border", 0}}, {"null", "1", "\"true\"", "[]"}},
          {"attach", "part", {{"on", true}}, no_indices},
          {"play", "seconds", Json::object(), with(no_numbers, {"0", "-1", "601"})},
          {"play",
           "pulls",
           {{"seconds", 0.01}},
           {"null", "7", "{}", "[7]", "[{}]", "[{\"time\":-1}]", "[{\"time\":0,\"vertex\":-1}]"}},
          {"play", "speed", {{"seconds", 0.01}}, with(no_numbers, {"0", "-1", "101"})},
          {"fit", "by", Json::object(), with(no_texts, {"\"ease\"", "\"\""})},
          {"give", "as", Json::object(), with(no_texts, {"\"\"", "\"exe\"", "\"../ply\"", "\"moving glb\""})},
          {"open", "item", Json::object(), with(no_texts, {"\"\"", "\"../skirt\"", "\"/etc/passwd\""})},
          {"open", "garment", Json::object(), with(no_texts, {"\"\"", "\"1\"", "\"/etc/passwd\""})},
          {"open", "figures", {{"garment", "1"}}, {"7", "[]", "{\"garment\":7}", "null"}},
          {"pull", "vertex", {{"to", {0, 0, 0}}}, {"0", "-1", "\"0\"", "null"}}};
}

/// All files below a folder, and how long they are.
std::map<std::string, std::uintmax_t> files_below(const fs::path& folder) {
  std::map<std::string, std::uintmax_t> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files[entry.path().string()] = entry.is_regular_file() ? fs::file_size(entry) : 0;
  return files;
}

}  // namespace

TEST_CASE("studio hostile: more than two hundred messages are refused in words, and change nothing") {
  const Desk desk("hostile");
  const studio::Studio studio(desk.scene, desk.project(), 0, {{}, desk.folder});
  Visitor page(studio);
  REQUIRE(page.ask("draw", line_at(0.2)).contains("done"));
  page.ask("show");
  const std::string before = page.cloth;
  const Json status = page.status;
  const auto files = files_below(desk.folder);
  int sent = 0;
  const auto refused = [&](const std::string& text) {
    INFO(text.substr(0, 160));
    page.send(text);
    const Json answer = page.answer();
    CHECK(answer.contains("refused"));
    CHECK(answer.value("refused", "").size() > 10);
    ++sent;
  };
  for (const std::string& text : no_messages()) refused(text);
  for (Key key : keys()) {
    key.good.erase(key.key);
    const std::string good = key.good.dump(), rest = good.size() > 2 ? "," + good.substr(1) : "}";
    for (const std::string& bad : key.bad)
      refused(R"({"id":1,"do":")" + key.intention + R"(",")" + key.key + "\":" + bad + rest);
  }
  CHECK(sent >= 200);
  CHECK(files_below(desk.folder) == files);
  page.ask("show");
  CHECK(page.cloth == before);
  CHECK(page.status == status);
}

TEST_CASE("studio hostile: a stroke of too many points, and a message that is too long, are refused") {
  const Desk desk("long");
  const studio::Studio studio(desk.scene, desk.project());
  Visitor page(studio);
  Json many = line_at(0.2);
  many["points"] = Json::array();
  for (int i = 0; i < 20001; ++i) many["points"].push_back({0.1, 0.1, 0.0});
  CHECK(page.ask("draw", many).contains("refused"));
  CHECK(page.ask("draw", {{"name", std::string((8 << 20) + 100, 'x')}}).contains("refused"));
  CHECK(page.ask("draw", line_at(0.2)).contains("done"));
}

}  // namespace furrow
