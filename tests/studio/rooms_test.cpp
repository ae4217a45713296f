// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/rooms.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "geometry/figure/shape_body.h"
#include "tests/io/mesh/seam.h"
#include "tests/studio/visitor.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

namespace furrow {
namespace {

namespace http = boost::beast::http;
namespace fs = std::filesystem;
using jobs::Json;
using tests::line_at;
using tests::Visitor;

struct Sent {
  std::string name, bytes;
  std::string token = {}, origin = {};  ///< "": the right ones
};

/// Sends a file as the page does; its status and answer.
http::response<http::string_body> put(const studio::Studio& studio, const Sent& sent) {
  const std::string host = "127.0.0.1:" + std::to_string(studio.port());
  const std::string token = sent.token.empty() ? studio.token() : sent.token;
  http::request<http::string_body> request(http::verb::put, "/upload?token=" + token + "&name=" + sent.name,
                                           11);
  request.set(http::field::host, host);
  request.set(http::field::origin, sent.origin.empty() ? "http://" + host : sent.origin);
  request.body() = sent.bytes;
  return tests::answer_to(studio, request);
}

std::string number_of(const studio::Studio& studio, const std::string& name, const std::string& bytes) {
  const auto response = put(studio, {name, bytes});
  REQUIRE(response.result() == http::status::ok);
  return response.body();
}

/// A sheet of 0.4 m in the xy plane as OBJ, in another unit, or lying in xz.
std::string sheet_text(double scale, bool level = false) {
  std::string text;
  for (int j = 0; j <= 10; ++j)
    for (int i = 0; i <= 8; ++i) {
      const std::string x = std::to_string(0.05 * i * scale), y = std::to_string(0.05 * j * scale);
      text += level ? "v " + x + " 0 " + y + "\n" : "v " + x + " " + y + " 0\n";
    }
  for (int j = 0; j < 10; ++j)
    for (int i = 1; i <= 8; ++i) {
      const int a = 9 * j + i;
      text += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(a + 10) + " " +
              std::to_string(a + 9) + "\n";
    }
  return text;
}

/// A folder with a gallery of one scene, and room for drawings.
struct House {
  explicit House(const std::string& name) : desk(name) {
    fs::create_directories(desk.folder / "gallery");
    fs::create_directories(desk.folder / "drawings");
    std::ofstream(desk.folder / "gallery/hung.toml")
        << "title = \"A sheet\"\n[garment]\nmesh = \"../sheet.ply\"\n[[pins]]\nbox = [-1, 0.35, -1, 1, 1, "
           "1]\n";
    std::ofstream(desk.folder / "gallery/untitled.toml") << "[garment]\nmesh = \"../sheet.ply\"\n";
  }
  studio::Places places() const { return {desk.folder / "gallery", desk.folder / "drawings"}; }
  std::set<std::string> drawings() const { return tests::names_in(desk.folder / "drawings"); }
  tests::Desk desk;
};

/// Our skirt, made for our mannequin, and a taller figure that stands elsewhere.
struct MadeForAnother {
  explicit MadeForAnother(const fs::path& folder) {
    skirt = io::read_mesh(tests::source_dir() / "meshes/skirt.obj");
    skirt_text = tests::bytes_of(tests::source_dir() / "meshes/skirt.obj");
    anna_text = tests::bytes_of(tests::source_dir() / "meshes/mannequin.obj");
    io::MeshFile berta = io::read_mesh(tests::source_dir() / "meshes/mannequin.obj");
    geometry::shape_body(berta.mesh, {1.86, 0.92, 0, 0});
    for (const geometry::Vertex v : berta.mesh->vertices())
      berta.mesh->point(v) = berta.mesh->point(v) + geometry::Vector(0.7, 0, -0.3);
    io::write_mesh(folder / "berta.obj", berta);
    berta_text = tests::bytes_of(folder / "berta.obj");
  }
  /// What a page sends to open it. All of the files may have one name.
  Json words(const studio::Studio& studio, const std::string& name = "") const {
    const auto sent = [&](const char* own, const std::string& text) {
      return number_of(studio, name.empty() ? own : name, text);
    };
    return {{"garment", sent("skirt.obj", skirt_text)},
            {"body", sent("berta.obj", berta_text)},
            {"made_for", sent("anna.obj", anna_text)}};
  }
  /// A ridge at the front, as a page draws it.
  Json ridge() const {
    std::vector<geometry::Point> front;
    for (const geometry::Point& p : skirt.mesh->points())
      if (std::abs(p.x()) < 0.012 && p.z() > 0 && p.y() < 0.8) front.push_back(p);
    std::sort(front.begin(), front.end(), [](const auto& a, const auto& b) { return a.y() > b.y(); });
    Json points = Json::array();
    for (const geometry::Point& p : front) points.push_back({p.x(), p.y(), p.z()});
    return {{"height", 0.015}, {"width", 0.08}, {"points", points}};
  }
  io::MeshFile skirt;
  std::string skirt_text, anna_text, berta_text;
};

/// The mean x of what a frame shows [m].
double middle_of(const std::string& frame) {
  std::uint32_t count = 0;
  std::memcpy(&count, frame.data() + 8, 4);
  double sum = 0;
  for (std::uint32_t v = 0; v < count; ++v) {
    float x = 0;
    std::memcpy(&x, frame.data() + 24 + 12 * std::size_t(v), 4);
    sum += x;
  }
  return sum / count;
}

/// The working directory is another one while this lives.
class Within {
 public:
  explicit Within(const fs::path& folder) : before_(fs::current_path()) { fs::current_path(folder); }
  ~Within() { fs::current_path(before_); }

 private:
  fs::path before_;
};

std::string refusal_of(Visitor& page, const std::string& what, const Json& body = Json::object()) {
  return page.ask(what, body).value("refused", "it was done");
}

}  // namespace

TEST_CASE(
    "studio rooms: with nothing open a garment of the gallery is chosen, drawn on, and left for another") {
  const House house("gallery");
  const studio::Studio studio(house.places());
  Visitor page(studio);
  CHECK(page.ask("draw", line_at(0.2)).at("refused").get<std::string>().find("nothing is open yet") == 0);
  CHECK(page.ask("pull").contains("refused"));
  CHECK(page.ask("open", {{"item", "untitled"}}).contains("refused"));
  const Json opened = page.ask("open", {{"item", "hung"}});
  REQUIRE(opened.contains("done"));
  CHECK(house.drawings() == std::set<std::string>{"hung-studio"});
  REQUIRE(page.ask("draw", line_at(0.2)).contains("done"));
  CHECK(page.status.at("lines").size() == 1);

  Visitor other(studio);
  CHECK(other.ask("open", {{"item", "hung"}})
            .at("refused")
            .get<std::string>()
            .find("another page is drawing") == 0);
  REQUIRE(page.ask("open", {{"item", "hung"}}).contains("done"));
  CHECK(house.drawings() == std::set<std::string>{"hung-studio", "hung-studio-2"});
  page.ask("show");
  CHECK(page.status.at("lines").empty());
  const studio::Studio again(house.desk.folder / "drawings/hung-studio");
  Visitor back(again);
  back.ask("show");
  CHECK(back.status.at("lines").size() == 1);
}

TEST_CASE(
    "studio rooms: the picture of a scene of the gallery lies beside it, and is none where it is too large") {
  const House house("pictures");
  const fs::path folder = house.desk.folder / "gallery";
  CHECK(studio::gallery(folder).at(0).picture.empty());
  std::ofstream(folder / "hung.png") << "abc";
  CHECK(studio::gallery(folder).at(0).picture == "data:image/png;base64,YWJj");
  std::ofstream(folder / "hung.png") << std::string((256 << 10) + 1, 'a');
  CHECK(studio::gallery(folder).at(0).picture.empty());
}

TEST_CASE("studio rooms: what was written is shown in its folder, and no other folder is") {
  const House house("folders");
  std::vector<std::string> shown;
  studio::Places places = house.places();
  places.show_folder = [&](const fs::path& folder) { shown.push_back(folder.string()); };
  const studio::Studio studio(places);
  Visitor page(studio);
  CHECK(refusal_of(page, "folder", {{"of", "give"}}).find("nothing is open yet") == 0);
  REQUIRE(page.ask("open", {{"item", "hung"}}).contains("done"));
  CHECK(refusal_of(page, "folder", {{"of", "give"}}).find("no folder any more") != std::string::npos);
  REQUIRE(page.ask("give", {{"as", "obj"}}).contains("done"));
  CHECK(refusal_of(page, "folder", {{"of", "give"}}) == "it was done");
  CHECK(refusal_of(page, "folder", {{"of", "project"}}) == "it was done");
  CHECK(refusal_of(page, "folder", {{"of", "/etc"}}) == "of: there is no '/etc'");
  CHECK(refusal_of(page, "folder", {{"of", "../.."}}) == "of: there is no '../..'");
  Visitor other(studio);
  CHECK(refusal_of(other, "folder", {{"of", "give"}}).find("another page") == 0);
  const fs::path project = house.desk.folder / "drawings/hung-studio";
  CHECK(shown ==
        std::vector<std::string>{fs::absolute(project / "give").string(), fs::absolute(project).string()});
}

TEST_CASE("studio rooms: the page is told of edges where the texture is parted, as lines may end there") {
  const House house("seams");
  const studio::Studio studio(house.places());
  Visitor page(studio);
  // Two squares side by side, each with a chart of its own.
  const std::string text =
      "v 0 0 0\nv 0.3 0 0\nv 0.6 0 0\nv 0 0.3 0\nv 0.3 0.3 0\nv 0.6 0.3 0\n"
      "vt 0 0\nvt 0.4 0\nvt 0.6 0\nvt 1 0\nvt 0 0.4\nvt 0.4 0.4\nvt 0.6 0.4\nvt 1 0.4\n"
      "f 1/1 2/2 5/6\nf 1/1 5/6 4/5\nf 2/3 3/4 6/8\nf 2/3 6/8 5/7\n";
  REQUIRE(page.ask("open", {{"garment", number_of(studio, "two.obj", text)}, {"unit", "m"}, {"up", "y"}})
              .contains("done"));
  page.ask("show");
  std::vector<std::uint32_t> words(page.cloth.size() / 4);
  std::memcpy(words.data(), page.cloth.data(), 4 * words.size());
  REQUIRE(words.at(4) == 1);
  const std::size_t at = 6 + 6 * words[2] + 3 * words[3];
  CHECK(std::set<std::uint32_t>{words[at], words[at + 1]} == std::set<std::uint32_t>{1, 4});
  CHECK(words[at + 2] == 0x80000000u);
}

TEST_CASE("studio rooms: of a file with several figures one is opened by its name") {
  const House house("figures");
  const studio::Studio studio(house.places());
  Visitor page(studio);
  tests::Seam seam;
  seam.scene["nodes"].push_back({{"mesh", 0}, {"name", "cuff \"left\""}, {"translation", {0, 3, 0}}});
  seam.scene["scenes"][0]["nodes"] = {0, 1};
  const auto open = [&](const std::string& figure) {
    return page.ask("open", {{"garment", number_of(studio, "avatar.glb", seam.glb())},
                             {"figures", {{"garment", figure}}},
                             {"unit", "m"},
                             {"up", "y"}});
  };
  CHECK(open("hood").at("refused").get<std::string>().find(
            "it has no figure 'hood'; it has 'sleeve', 'cuff") != std::string::npos);
  REQUIRE(open("cuff \"left\"").contains("done"));
  page.ask("show");
  std::vector<std::uint32_t> words(page.cloth.size() / 4);
  std::memcpy(words.data(), page.cloth.data(), 4 * words.size());
  CHECK(words.at(2) == 4);  // vertices: of the one figure
}

TEST_CASE(
    "studio rooms: a drawing in a folder of the working directory is kept, moved and moved on with its lines",
    "[release]") {
  const House house("relative");
  const Within here(house.desk.folder);
  const std::string drawings = GENERATE(".", "drawings", "./gallery/../drawings");
  INFO(drawings);
  const studio::Studio studio(studio::Places{house.desk.folder / "gallery", drawings});
  Visitor page(studio);
  REQUIRE(page.ask("open", {{"item", "hung"}}).contains("done"));
  REQUIRE(page.ask("draw", line_at(0.1)).contains("done"));
  CHECK(refusal_of(page, "keep") == "it was done");
  CHECK(refusal_of(page, "undo") == "it was done");
  CHECK(refusal_of(page, "play", {{"seconds", 2 / 60.0}}) == "it was done");
  CHECK(refusal_of(page, "draw", line_at(-0.1)) == "it was done");
  CHECK(refusal_of(page, "play", {{"seconds", 1 / 60.0}}) == "it was done");
  CHECK(refusal_of(page, "drape") == "it was done");
}

TEST_CASE(
    "studio rooms: a file from the page becomes a drawing, in the unit and axis of its size and shape") {
  const House house("upload");
  const studio::Studio studio(house.places());
  Visitor page(studio);
  const Json metres = page.ask("open", {{"garment", number_of(studio, "my-sheet.obj", sheet_text(1))}});
  REQUIRE(metres.contains("done"));
  CHECK(metres["done"].at("told").at(0).get<std::string>().find("Taken as m with y upwards") == 0);
  CHECK(house.drawings() == std::set<std::string>{"my-sheet-studio"});
  REQUIRE(page.ask("draw", line_at(0.2)).contains("done"));

  const Json other = page.ask("open", {{"garment", number_of(studio, "level.obj", sheet_text(100, true))}});
  CHECK(other["done"].at("told").at(0).get<std::string>().find(
            "Taken as cm with z upwards, so the garment is 0.50 m") == 0);
  const Json said = page.ask(
      "open", {{"garment", number_of(studio, "level.obj", sheet_text(100))}, {"unit", "m"}, {"up", "y"}});
  REQUIRE(said.contains("refused"));  // of 50 m; nothing is left of it
  CHECK(house.drawings() == std::set<std::string>{"level-studio", "my-sheet-studio"});
  REQUIRE(page.ask("draw", line_at(0.2)).contains("refused") == false);  // the one before is open still

  const studio::Studio again(house.desk.folder / "drawings/my-sheet-studio");
  Visitor back(again);
  back.ask("show");
  CHECK(back.status.at("lines").size() == 1);
}

TEST_CASE("studio rooms: a garment comes with its body, also under one name") {
  const House house("body");
  const studio::Studio studio(house.places());
  Visitor page(studio);
  const std::string box =
      "v 0 0 -0.3\nv 0.3 0 -0.3\nv 0.3 1.7 -0.3\nv 0 1.7 -0.3\nv 0 0 -0.1\nv 0.3 0 -0.1\nv 0.3 1.7 -0.1\nv 0 "
      "1.7 "
      "-0.1\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const std::string garment = number_of(studio, "a.obj", sheet_text(1)),
                    body = number_of(studio, "a.obj", box);
  const Json opened = page.ask("open", {{"garment", garment}, {"body", body}});
  INFO(opened.dump());
  REQUIRE(opened.contains("done"));
  page.ask("show");
  CHECK(page.status.at("has_body") == true);
  CHECK(tests::names_in(house.desk.folder / "drawings/a-studio/files") ==
        std::set<std::string>{"a.obj", "body-a.obj"});
}

TEST_CASE(
    "studio rooms: what was made for another body is shown about that one, and not moved or judged there") {
  const House house("made_for");
  const MadeForAnother made(house.desk.folder);
  const studio::Studio studio(house.places());
  Visitor page(studio);
  const Json opened = page.ask("open", made.words(studio, "a.obj"));
  INFO(opened.dump());
  REQUIRE(opened.contains("done"));
  page.ask("show");
  CHECK(page.status.at("made_for_another") == true);
  CHECK(page.status.at("can_drape") == true);
  CHECK(tests::names_in(house.desk.folder / "drawings/a-studio/files") ==
        std::set<std::string>{"a.obj", "body-a.obj", "made-for-a.obj"});
  CHECK(std::abs(middle_of(page.body)) < 0.02);
  CHECK(std::abs(page.status.at("middle").get<double>()) < 0.02);
  for (const char* what : {"play", "keep", "fit"})
    CHECK(refusal_of(page, what, {{"by", "strain"}}).find("drape it first") != std::string::npos);
  CHECK(page.ask("save").at("done").at("told").dump().find("scene.toml") != std::string::npos);
  CHECK(page.ask("fabric", {{"name", "denim"}}).contains("done"));
  CHECK(page.status.at("made_for_another") == true);
}

TEST_CASE("studio rooms: a body that a garment cannot come from is refused, and nothing is left of it") {
  const House house("made_for_bad");
  const MadeForAnother made(house.desk.folder);
  const studio::Studio studio(house.places());
  Visitor page(studio);
  io::MeshFile ball;
  ball.mesh = tests::icosphere(3, 0.8);
  io::write_mesh(house.desk.folder / "ball.obj", ball);
  const auto open_with = [&](const char* key, const Json& value) {
    Json words = made.words(studio);
    words[key] = value;
    if (value.is_null()) words.erase(key);
    return refusal_of(page, "open", words);
  };
  const std::string round = tests::bytes_of(house.desk.folder / "ball.obj");
  CHECK(open_with("made_for", number_of(studio, "ball.obj", round)).find("ball.obj: the body has no") !=
        std::string::npos);
  CHECK(open_with("made_for", number_of(studio, "rubbish.obj", "v 1 2\nf 7 8 9\n")).find("rubbish.obj") !=
        std::string::npos);
  CHECK(open_with("made_for", "999").find("has not arrived") != std::string::npos);
  CHECK(open_with("made_for", 7).find("made_for: is no text") == 0);
  CHECK(open_with("body", nullptr).find("choose the other one as its body") != std::string::npos);
  CHECK(house.drawings().empty());
}

TEST_CASE(
    "studio rooms: a drape brings what was made for another body, undo takes it back, and a replay ends "
    "alike",
    "[release]") {
  const House house("brought");
  const MadeForAnother made(house.desk.folder);
  const fs::path project = house.desk.folder / "drawings/skirt-studio";
  const bool drawn = GENERATE(false, true);
  {
    const studio::Studio studio(house.places());
    Visitor page(studio);
    REQUIRE(page.ask("open", made.words(studio)).contains("done"));
    if (drawn) REQUIRE(page.ask("draw", made.ridge()).contains("done"));
    page.ask("show");
    const std::string before = page.cloth, anna = page.body;
    const Json draped = page.ask("drape");
    INFO(draped.dump());
    REQUIRE(draped.contains("done"));
    CHECK(draped["done"].at("outcome") == "at rest");
    CHECK(page.status.at("made_for_another") == false);
    CHECK(middle_of(page.cloth) == Approx(0.7).margin(0.02));
    CHECK(middle_of(page.body) == Approx(0.7).margin(0.02));
    REQUIRE(page.ask("undo").contains("done"));
    CHECK(page.status.at("made_for_another") == true);
    CHECK(page.cloth == before);
    CHECK(page.body == anna);
    REQUIRE(page.ask("redo").contains("done"));
    CHECK(page.status.at("made_for_another") == false);
    CHECK(page.ask("fit", {{"by", "distance"}}).contains("done"));
    const double settled = middle_of(page.cloth);
    REQUIRE(page.ask("drape").contains("done"));  // from where it lies, and not from the other body again
    CHECK(middle_of(page.cloth) == Approx(settled).margin(0.01));
  }
  const studio::ReplayReport again =
      studio::replay(project, house.desk.folder / "again", [](std::size_t, std::size_t) { return true; });
  CHECK(again.difference == "");
  CHECK(again.intentions == (drawn ? 5u : 4u));
  const studio::Studio reopened(project);
  Visitor page(reopened);
  while (page.ask("undo").contains("done")) {
  }
  CHECK(page.status.at("made_for_another") == true);
}

TEST_CASE("studio rooms: files that are none, too large, from elsewhere or of a bad name are refused") {
  const House house("bad");
  const studio::Studio studio(house.places());
  Visitor page(studio);
  const std::string sheet = sheet_text(1);
  CHECK(put(studio, {"a.obj", sheet, std::string(64, '0')}).result() == http::status::forbidden);
  CHECK(put(studio, {"a.obj", sheet, "", "http://furrow.example"}).result() == http::status::forbidden);
  const std::vector<std::string> bad_names{"",     "a",        "a.exe",
                                           ".obj", "a.obj.sh", std::string(300, 'a') + ".obj"};
  for (const std::string& name : bad_names)
    CHECK(put(studio, {name, sheet}).result() == http::status::unsupported_media_type);
  CHECK(put(studio, {"a.obj", std::string((std::size_t{64} << 20) + 1, ' ')}).result() ==
        http::status::payload_too_large);
  const std::string out = number_of(studio, "../../../a%2f..%2fescape.obj", sheet);
  REQUIRE(page.ask("open", {{"garment", out}}).contains("done"));
  CHECK(house.drawings() == std::set<std::string>{"a-2f---2fescape-studio"});
  for (const std::string& rubbish :
       {std::string(), std::string("v 1 2\nf 7 8 9\n"), std::string(4096, '\0'), std::string("ply\n")})
    CHECK(page.ask("open", {{"garment", number_of(studio, "rubbish.obj", rubbish)}}).contains("refused"));
  CHECK(page.ask("open", {{"garment", out}}).contains("refused"));  // it was taken
  CHECK(house.drawings().size() == 1);
  CHECK(tests::names_in(house.desk.folder) == std::set<std::string>{"drawings", "gallery", "sheet.ply"});
}

}  // namespace furrow
